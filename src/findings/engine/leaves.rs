//! What a set of causes leaves of the readings, and what of that counts.

use super::bank::{Bank, Fit};
use super::judgement::Judgement;
use super::materiality::{explained_rms, in_noise, raw_parts};
use super::rest::{Rest, Span};
use super::search::Scored;
use super::statement::Statement;
use crate::ground::stats::rms;
use nalgebra::DVector;

/// The scales on which sets of causes of one statement are weighed.
pub(super) struct Weighing<'a> {
    pub statement: &'a Statement,
    pub bank: &'a Bank<'a>,
    pub span: Option<&'a Span<'a>>,
    pub judgement: &'a Judgement,
    /// What the present simulation misses, with the nuisances at their most probable: per row.
    pub missed: Vec<f64>,
    /// Rms of what is missed, noise deviations.
    whole: f64,
}

/// What a set leaves.
pub(super) struct Leaves {
    /// Of the readings, per row: nuisances and named causes at their most probable.
    pub left: Vec<f64>,
    /// Most probable amounts of the nuisances beside the set.
    pub uncertain: Vec<f64>,
    /// Nats that these cost by what is known of them.
    pub strain: f64,
    /// What patterns of the set look like.
    pub seen: Option<&'static str>,
    /// What counts of it.
    pub rest: Rest,
}

impl<'a> Weighing<'a> {
    /// Beside the fit of no cause.
    pub fn new(
        statement: &'a Statement,
        bank: &'a Bank,
        span: Option<&'a Span<'a>>,
        nothing: &Fit,
        judgement: &'a Judgement,
    ) -> Self {
        let mut own = Self {
            statement,
            bank,
            span,
            judgement,
            missed: Vec::new(),
            whole: 0.0,
        };
        own.missed = own.beside(nothing).0;
        own.whole = rms(&in_noise(statement, &own.missed));
        own
    }

    /// What a fit leaves of the readings, nuisances at their most probable, and the amounts of these.
    pub fn beside(&self, fit: &Fit) -> (Vec<f64>, Vec<f64>) {
        let mut left = self.statement.reading.clone();
        for part in raw_parts(self.bank, fit) {
            left.iter_mut().zip(part).for_each(|(l, p)| *l -= p);
        }
        let whitened = DVector::from_vec(self.statement.noise.whiten(&left));
        let amounts = self.bank.nuisances_in(&whitened);
        for (nuisance, amount) in self.statement.nuisances.iter().zip(&amounts) {
            left.iter_mut()
                .zip(&nuisance.column)
                .for_each(|(l, c)| *l -= amount * c);
        }
        (left, amounts)
    }

    /// Nats that amounts of what is uncertain cost by what is known of them.
    fn strain(&self, amounts: &[f64]) -> f64 {
        let each = self.statement.nuisances.iter().zip(amounts);
        let known = each.filter(|(nuisance, _)| nuisance.spread.is_finite());
        known
            .map(|(nuisance, amount)| 0.5 * (amount / nuisance.spread).powi(2))
            .sum()
    }

    /// What a set leaves, and, where it names nothing, the best `story` that anyone would tell.
    pub fn leaves(&self, set: &Scored, story: Option<&Scored>) -> Leaves {
        let (seen, pattern) = self.pattern(&set.fit);
        let (beside, uncertain) = self.beside(&set.fit);
        let rest = self.span.map_or(Rest::default(), |s| {
            let whole = (self.whole, self.beside_levels(&set.fit));
            s.rest(self.bank, &set.fit, whole, self.judgement)
        });
        let share = self.share(rms(&in_noise(self.statement, &pattern)));
        let noise = set.fit.posterior.noise_variance.sqrt();
        let rest = rest
            .with(share, self.judgement)
            .scattering(noise, self.judgement);
        Leaves {
            left: beside.iter().zip(&pattern).map(|(l, p)| l + p).collect(),
            strain: self.strain(&uncertain),
            uncertain,
            seen,
            rest: match story.filter(|_| set.suspects.is_empty()) {
                Some(story) => self.unnamed(story, rest),
                None => rest,
            },
        }
    }

    /// Rms of what is missed beside what a fit holds to be the same in every reading, noise deviations.
    fn beside_levels(&self, fit: &Fit) -> f64 {
        let mut missed = self.missed.clone();
        for (member, part) in fit.members.iter().zip(raw_parts(self.bank, fit)) {
            if self.bank.suspect(*member).is_level() {
                missed.iter_mut().zip(part).for_each(|(m, p)| *m -= p);
            }
        }
        rms(&in_noise(self.statement, &missed))
    }

    /// Of the whole misfit.
    fn share(&self, size: f64) -> f64 {
        size / self.whole.max(f64::MIN_POSITIVE)
    }

    /// What patterns of a set look like, and what they add to the readings, per row.
    fn pattern(&self, fit: &Fit) -> (Option<&'static str>, Vec<f64>) {
        let (mut seen, mut sum) = (None, vec![0.0; self.missed.len()]);
        for (member, part) in fit.members.iter().zip(raw_parts(self.bank, fit)) {
            let own = self.bank.suspect(*member);
            if !own.named {
                seen = seen.or(Some(own.summary));
                sum.iter_mut().zip(part).for_each(|(s, p)| *s += p);
            }
        }
        (seen, sum)
    }

    /// What is left where nothing is named. A story that fits far better than none, but of which no cause passes
    /// by itself, is no reason to call the simulation right.
    fn unnamed(&self, story: &Scored, rest: Rest) -> Rest {
        let judgement = self.judgement;
        let explained = explained_rms(self.statement, self.bank, &story.fit, judgement);
        let left = rms(&in_noise(self.statement, &self.beside(&story.fit).0));
        let share = told(
            [explained, left].map(|size| self.share(size)),
            judgement.taken_back,
        );
        match story.score > judgement.left_nats && share > judgement.left_share {
            true => Rest {
                nats: rest.nats.max(story.score),
                share: rest.share.max(share),
                is_left: true,
                scatter: None,
            },
            false => rest,
        }
    }
}

/// What a story explains, as a share of the misfit (rms): what is larger than all that is missed is mostly taken back by what is uncertain, and
/// then it explains no more than what it leaves less ([`Judgement::taken_back`]).
fn told([explained, left]: [f64; 2], taken_back: f64) -> f64 {
    let less = (1.0 - left * left).max(0.0).sqrt();
    let own = ((taken_back - explained) / (taken_back - 1.0)).clamp(0.0, 1.0);
    own * explained.min(1.0) + (1.0 - own) * less
}

#[cfg(test)]
mod tests {
    use super::told;

    fn worth(shares: [f64; 2]) -> f64 {
        told(shares, 1.5)
    }

    #[test]
    fn a_story_that_what_is_uncertain_takes_back_explains_what_it_leaves_less() {
        assert_eq!(worth([0.5, 0.9]), 0.5);
        assert!((worth([1.001, 0.9]) - worth([0.999, 0.9])).abs() < 3e-3);
        assert!((worth([17.0, 0.6]) - 0.8).abs() < 1e-12);
        assert_eq!(worth([17.0, 1.1]), 0.0);
    }
}
