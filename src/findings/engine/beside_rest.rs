//! Names beside structure that nobody makes: it may make a part of theirs as well, the more, the less of the error they take away.

use super::diagnosis::Found;
use super::judgement::Judgement;
use super::statement::Experiment;
use super::told::share_left;
use crate::findings::answer::{Answer, Verdict};
use crate::findings::gain::Gain;

/// Below, a name is more likely wrong than right.
pub const EVEN: f64 = 0.5;

impl Answer {
    /// Whether something is left that no name makes.
    pub fn is_open(&self) -> bool {
        matches!(
            self.verdict,
            Verdict::UnknownCause | Verdict::PartlyExplained
        )
    }

    /// Without names that are less likely right than wrong beside what is left; the others are no more probable than that.
    pub fn doubting(&mut self, judgement: &Judgement) {
        let likely = |gain: &Gain| judgement.beside_rest(gain);
        for cause in &mut self.causes {
            cause.probability = cause.probability.min(likely(&cause.gain));
        }
        self.causes.retain(|c| likely(&c.gain) >= EVEN);
        self.groups.retain(|g| likely(&g.gain) >= EVEN);
        if self.causes.is_empty() && self.groups.is_empty() {
            self.verdict = Verdict::UnknownCause;
        }
    }

    fn names(&self) -> Vec<(&'static str, String)> {
        let causes = self.causes.iter().map(|c| (c.effect, c.site.clone()));
        let groups = self.groups.iter().filter_map(|g| {
            let first = g.effects.first().zip(g.sites.first())?;
            Some((*first.0, first.1.clone()))
        });
        causes.chain(groups).collect()
    }
}

/// What was found without names that what is left makes doubtful: what they explained is left as well.
pub(super) fn doubting(
    experiment: &dyn Experiment,
    mut found: Found,
    judgement: &Judgement,
) -> Found {
    if !found.answer.is_open() {
        return found;
    }
    let before = found.answer.names();
    found.answer.doubting(judgement);
    let after = found.answer.names();
    if before.len() == after.len() {
        return found;
    }
    let is_doubtful =
        |name: &(&'static str, String)| before.contains(name) && !after.contains(name);
    found.blamed.retain(|blamed| {
        let is_kept = !is_doubtful(&(blamed.effect, blamed.site.clone()));
        if !is_kept {
            let rows = found.left.iter_mut().zip(&mut found.explained);
            rows.zip(&blamed.part).for_each(|((left, told), part)| {
                *left += part;
                *told -= part;
            });
        }
        is_kept
    });
    let remaining = experiment.remaining(&found.left);
    let discrepancy = &found.answer.discrepancy;
    let share = share_left(&found.left, (discrepancy.noise_rms, &found.missed));
    let unexplained = &mut found.answer.unexplained;
    unexplained.share_of_variance = share;
    unexplained.shape = remaining.shape;
    unexplained.over_time = remaining.over_time;
    found
}

#[cfg(test)]
mod tests {
    use crate::findings::Verdict;
    use crate::findings::engine::tests::{Toy, cycle, load};
    use crate::findings::engine::{Judgement, diagnose};

    /// A gap that takes little of the error beside a wave that nobody makes may be what the wave makes; one that takes most of it is there,
    /// though less surely than where nothing is left. As gaps grow, they are silent, then doubtful, then named.
    #[test]
    fn beside_structure_that_nobody_makes_a_name_that_takes_little_is_none() {
        let asked = Judgement::default();
        let sure = Judgement {
            beside_rest: 50.0,
            ..asked
        };
        let [mut kept, mut dropped] = [0, 0];
        for (seed, size) in (0..5).flat_map(|seed| (2..16).map(move |size| (seed, f64::from(size))))
        {
            let wave = |i: usize| 8.0 * (i as f64 * 0.031).sin();
            let gap = move |i: usize| size * (load(i) / 0.05).tanh();
            let toy = Toy::new(seed, 252, cycle, move |i| wave(i) + gap(i));
            let [before, found] = [&sure, &asked].map(|judgement| diagnose(&toy, judgement));
            if !before.answer.is_open() {
                continue;
            }
            for cause in &before.answer.causes {
                let likely = asked.beside_rest(&cause.gain);
                let told = found
                    .answer
                    .causes
                    .iter()
                    .find(|c| c.effect == cause.effect);
                match told {
                    Some(told) => assert_eq!(told.probability, cause.probability.min(likely)),
                    None => assert!(likely < 0.5, "{likely}"),
                }
                kept += usize::from(told.is_some());
                dropped += usize::from(told.is_none());
            }
            let names = found.answer.causes.len() + found.answer.groups.len();
            assert_eq!(found.blamed.len(), names);
            if found.blamed.is_empty() {
                assert_eq!(found.answer.verdict, Verdict::UnknownCause);
                assert!(found.explained.iter().all(|e| e.abs() < 1e-9));
            }
        }
        assert!(kept > 4 && dropped > 0, "{kept} {dropped}");
    }
}
