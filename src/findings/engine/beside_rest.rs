//! Names beside structure that nobody makes: it may make a part of theirs as well, the more, the less of the error they take away.

use super::diagnosis::Found;
use super::judgement::Judgement;
use super::rest::Rest;
use super::statement::{Blamed, Experiment};
use super::told::share_left;
use super::verdict::{Named, verdict};
use crate::findings::gain::Gain;

impl Named {
    /// Every name with its site; of what cannot be told apart the first.
    pub fn names(&self) -> Vec<(&'static str, String)> {
        let causes = self.causes.iter().map(|c| (c.effect, c.site.clone()));
        let groups = self.groups.iter().filter_map(|g| {
            let first = g.effects.first().zip(g.sites.first())?;
            Some((*first.0, first.1.clone()))
        });
        causes.chain(groups).collect()
    }

    /// Of the causes and groups the name that gains least.
    pub fn least(&self, among: &[(&'static str, String)]) -> Option<(&'static str, String)> {
        let causes = self.causes.iter().map(|c| c.gain);
        let gains = causes.chain(self.groups.iter().map(|g| g.gain));
        let own = self.names().into_iter().zip(gains);
        let own = own.filter(|(name, _)| among.contains(name));
        let least = own.min_by(|a, b| a.1.reduction_percent.total_cmp(&b.1.reduction_percent));
        least.map(|(name, _)| name)
    }

    /// Beside structure that nobody makes: without names that are less likely right than wrong, the other causes no more probable than that.
    /// The names that are none.
    pub fn beside_rest(&mut self, judgement: &Judgement) -> Vec<(&'static str, String)> {
        let mut dropped = self.names();
        for cause in &mut self.causes {
            cause.probability = cause.probability.min(judgement.beside_rest(&cause.gain));
        }
        let stands = |gain: &Gain| judgement.stands_beside_rest(gain);
        self.causes.retain(|c| stands(&c.gain));
        self.groups.retain(|g| stands(&g.gain));
        let kept = self.names();
        dropped.retain(|name| !kept.contains(name));
        dropped
    }
}

/// What was found without names that are less likely right than wrong beside what is left; the others are no more probable than
/// that. What was explained by the former is left as well; what is told of the latter stands beside them still. Scatter that is larger
/// than the noise stands for no cause.
pub(super) fn less_doubtful(
    experiment: &dyn Experiment,
    mut found: Found,
    judgement: &Judgement,
) -> Found {
    if !found.answer.is_open() || found.scatters {
        return found;
    }
    let answer = &mut found.answer;
    let mut named = Named {
        causes: std::mem::take(&mut answer.causes),
        groups: std::mem::take(&mut answer.groups),
    };
    let dropped = named.beside_rest(judgement);
    (answer.causes, answer.groups) = (named.causes, named.groups);
    if !dropped.is_empty() {
        let is_doubtful = |b: &Blamed| dropped.contains(&(b.effect, b.site.clone()));
        let blamed = std::mem::take(&mut found.blamed);
        (found.doubted, found.blamed) = blamed.into_iter().partition(is_doubtful);
        leave(experiment, &mut found, judgement);
    }
    found
}

impl Found {
    /// The same without any name: what was explained is left, for so many that leave something together imitate one that nobody
    /// knows ([`Judgement::several`]).
    #[must_use]
    pub fn without_names(mut self, experiment: &dyn Experiment, judgement: &Judgement) -> Self {
        self.answer.causes.clear();
        self.answer.groups.clear();
        self.doubted.append(&mut self.blamed);
        leave(experiment, &mut self, judgement);
        self.answer.unexplained.description = experiment.remaining(&self.left).description;
        self
    }
}

/// Leaves what doubtful causes explained.
fn leave(experiment: &dyn Experiment, found: &mut Found, judgement: &Judgement) {
    for doubtful in &found.doubted {
        let rows = found.left.iter_mut().zip(&mut found.explained);
        rows.zip(&doubtful.part).for_each(|((left, told), part)| {
            *left += part;
            *told -= part;
        });
    }
    if found.blamed.is_empty() {
        // what is uncertain is as it is without any cause
        found.left.clone_from(&found.missed);
        found.explained.fill(0.0);
    }
    let noise = found.answer.discrepancy.noise_rms;
    let (remaining, answer) = (experiment.remaining(&found.left), &mut found.answer);
    let unexplained = &mut answer.unexplained;
    unexplained.share_of_variance = share_left(&found.left, (noise, &found.missed));
    unexplained.shape = remaining.shape;
    unexplained.over_time = remaining.over_time;
    let named = Named {
        causes: answer.causes.clone(),
        groups: answer.groups.clone(),
    };
    let rest = Rest {
        share: unexplained.share_of_variance.sqrt(),
        is_left: true,
        ..Rest::default()
    };
    answer.verdict = verdict(&named, &rest, judgement);
}

#[cfg(test)]
mod tests {
    use crate::findings::Verdict;
    use crate::findings::engine::tests::{Toy, cycle, load};
    use crate::findings::engine::{Judgement, diagnose};
    use crate::findings::gain::Gain;

    /// A gap that takes most of the error beside a wave that nobody makes is there, though less surely than where nothing is left.
    /// Where such names have shown to be wrong, it is none, and what it explained is left.
    #[test]
    fn beside_structure_that_nobody_makes_names_are_as_probable_as_such_names_have_been() {
        let asked = Judgement::default();
        let [sure, wary] = [50.0, -4.0].map(|beside_rest| Judgement {
            beside_rest,
            ..asked
        });
        let mut kept = 0;
        for (seed, size) in
            (0..5).flat_map(|seed| (10..16).map(move |size| (seed, f64::from(size))))
        {
            let wave = |i: usize| 8.0 * (i as f64 * 0.031).sin();
            let gap = move |i: usize| size * (load(i) / 0.05).tanh();
            let toy = Toy::new(seed, 252, cycle, move |i| wave(i) + gap(i));
            let [before, found, none] = [&sure, &asked, &wary].map(|j| diagnose(&toy, j));
            if !before.answer.is_open() {
                continue;
            }
            let [cause] = &before.answer.causes[..] else {
                continue;
            };
            let likely = asked.beside_rest(&cause.gain);
            assert_eq!(
                found.answer.causes[0].probability,
                cause.probability.min(likely)
            );
            assert_eq!(found.left, before.left);
            assert!(none.answer.causes.is_empty() && none.blamed.is_empty());
            assert_eq!(none.answer.verdict, Verdict::UnknownCause);
            let whole = none.left.iter().zip(&none.missed);
            assert!(whole.into_iter().all(|(l, m)| (l - m).abs() < 1e-9));
            let taken = before.clone().without_names(&toy, &asked);
            assert_eq!(taken.answer.verdict, Verdict::UnknownCause);
            assert_eq!((taken.answer.named(), taken.blamed.len()), (0, 0));
            assert_eq!((&taken.left, taken.doubted.len()), (&none.left, 1));
            let shares = [&before, &none].map(|f| f.answer.unexplained.share_of_variance);
            assert!(shares[0] < shares[1], "{shares:?}");
            kept += 1;
        }
        assert!(kept > 4, "{kept}");
    }

    /// The share that a name takes away, and what is said of it.
    #[test]
    fn what_takes_little_is_more_likely_wrong() {
        let likely =
            |share: f64| Judgement::default().beside_rest(&Gain::of(1.0, 1.0 - share, 0.1));
        let even = Judgement::default().even_beside_rest;
        assert!(likely(0.1) < 0.2 && likely(0.3) < even && likely(0.4) > even);
        assert!((0.6..0.7).contains(&likely(0.5)) && likely(0.9) > 0.9);
        assert!(likely(-0.5) > 0.0 && likely(1.0 - 1e-12) < 1.0);
    }
}
