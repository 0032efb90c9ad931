//! What `ident damping` remarks about its tests and about the model it tuned.

use super::result::Damped;
use crate::fit::damping::{Pair, Test};
use crate::fit::damping_statement::{MISFIT, good};
use crate::fit::frf_nuisance::Pull;
use crate::ground::files;
use crate::sheet::number::significant;

/// How many stiffnesses a remark names.
const NAMED: usize = 4;

impl Damped {
    /// Remarks on all tests, with their file where there are several, then those on the model.
    pub fn remarks(&self) -> Vec<String> {
        let tests = &self.input.tests;
        let named = |test: &Test, remark: &String| match tests.len() {
            1 => remark.clone(),
            _ => format!("{}: {remark}", files::name(&test.path)),
        };
        let of_tests = tests
            .iter()
            .flat_map(|test| test.frf.remarks.iter().map(|r| named(test, r)));
        of_tests.chain(self.of_model()).collect()
    }

    /// Remarks on the model; of one that tells nothing, only that.
    pub fn of_model(&self) -> Vec<String> {
        let all = match self.account.supported {
            true => [self.contradicted(), self.misfit(), self.unmoved()],
            false => [None, self.misfit(), None],
        };
        all.into_iter().flatten().collect()
    }

    /// Stiffnesses that the FRFs want elsewhere than the robot has them.
    fn contradicted(&self) -> Option<String> {
        let pulls = self.account.pulls.iter();
        let far: Vec<&Pull> = pulls.filter(|pull| pull.contradicts()).collect();
        let said = listed(far)?;
        Some(format!(
            "the FRFs contradict the robot's stiffness: {said}; its uncertainty was taken as larger, so that the dampings hold it. Tune the stiffness with --release-stiffness, find the cause with `ident diagnose`"
        ))
    }

    /// A misfit beyond noise, with the stiffnesses that moved most.
    fn misfit(&self) -> Option<String> {
        let chi_square = self.account.tuned.reduced_chi_square;
        if chi_square <= MISFIT {
            return None;
        }
        let moved = listed(self.account.pulls.iter().collect());
        let moved = moved.map_or(String::new(), |said| format!(" (moved most: {said})"));
        let what = match self.account.supported {
            true => format!(
                "intervals are {} times wider",
                significant(chi_square.sqrt(), 2)
            ),
            false => "no constant is told".into(),
        };
        Some(format!(
            "the simulation misses the FRFs by more than noise, reduced chi-square {}: {what}. Look for a wrong stiffness{moved} with --release-stiffness, for mass, play or friction with `ident diagnose`",
            significant(chi_square, 3)
        ))
    }

    /// Dampings that meet the FRFs only with other stiffnesses and bodies than the robot keeps.
    fn unmoved(&self) -> Option<String> {
        let pairs = || self.account.pairs.iter().flatten();
        let apart = |pair: &Pair| good(&pair.matches[1]) && !good(&pair.unmoved);
        let worst = pairs().map(|pair| pair.unmoved.frac).fold(1.0, f64::min);
        pairs().any(apart).then(|| {
            format!(
                "the robot keeps its stiffnesses and bodies, with which the tuned dampings do not meet the FRFs (FRAC down to {worst:.3}): both were fitted along within what is known of them; --release-stiffness writes the stiffnesses"
            )
        })
    }
}

/// The stiffnesses that moved most, with how far; none where there are none.
fn listed(mut pulls: Vec<&Pull>) -> Option<String> {
    pulls.sort_by(|a, b| b.deviations().abs().total_cmp(&a.deviations().abs()));
    let one = |pull: &&Pull| {
        format!(
            "{} {:+.1} % ({} standard deviations)",
            pull.site,
            100.0 * (pull.times - 1.0),
            significant(pull.deviations().abs(), 2)
        )
    };
    let said: Vec<String> = pulls.iter().take(NAMED).map(one).collect();
    let more = match pulls.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    (!said.is_empty()).then(|| said.join(", ") + &more)
}
