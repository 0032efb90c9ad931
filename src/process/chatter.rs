//! Whether robot and cut drive one another: then the force grows to a multiple of what the same cut takes where springs follow without swinging,
//! until teeth leave the part.

use super::run::Outcome as Milled;
use super::setup::{Setup, Support};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::norm;
use crate::sheet::number::significant;

/// Largest force over that of the same cut with springs alone, from which on it is chatter. On 44 jobs by a stranger it was 3.6 to 22 where his
/// own plant chattered (seven), at most 1.7 elsewhere.
const TIMES: f64 = 2.5;
/// Share of the latter's impulse (mean force times time in the cut) below which teeth leave the part: on those seven jobs it was 0.33 to 0.77. What
/// swings from the motion alone into a part that it should only skim has the larger force too, but no less of it.
const LEAVES: f64 = 0.9;

/// A part that chatters.
#[derive(Debug, Clone, PartialEq)]
pub struct Chatter {
    /// Its largest force over that of the same cut with springs alone.
    pub times: f64,
    /// What of the stock is gone without a force in the latter, in sentences: what chatters leaves the part, and comes back where nothing
    /// should be left.
    pub not_cut: Vec<String>,
}

/// Whether a milled part chatters; only where robot and cut are coupled in time.
///
/// # Errors
/// As the run.
pub fn chatter(setup: &Setup, support: Support, milled: &Milled) -> Outcome<Option<Chatter>> {
    if support != Support::Coupled || milled.removed_m3 == 0.0 {
        return Ok(None);
    }
    let (springs, _) = setup.run(Support::Static, |_| {})?;
    let impulse = |of: &Milled| norm(of.mean_n) * of.cutting_s;
    let leaves = impulse(milled) < LEAVES * impulse(&springs);
    let times = milled.peak_n / springs.peak_n;
    Ok((leaves && times > TIMES).then(|| Chatter {
        times,
        not_cut: springs.not_cut(),
    }))
}

/// Why a part cannot be milled: what was said, or chatter, where the cut is well with springs alone.
pub fn or_chatter(setup: &Setup, support: Support, problem: Problem) -> Problem {
    let is_well = || setup.run(Support::Static, |_| {}).is_ok();
    match support == Support::Coupled && is_well() {
        false => problem,
        true => Problem::new(
            format!(
                "{}; with springs alone it does not: robot and cut drive one another (chatter)",
                problem.what
            ),
            format!(
                "{}; `ident lobes` with --along says how deep one may cut",
                problem.remedy
            ),
        ),
    }
}

impl Chatter {
    /// What the reader should know.
    pub fn remarks(&self) -> Vec<String> {
        let said = format!(
            "the force grows to {} times what it is where springs follow without swinging: robot and cut drive one another (chatter), so that neither force nor deviation says more; `ident lobes` with --along says how deep one may cut",
            significant(self.times, 2)
        );
        [said].into_iter().chain(self.not_cut.clone()).collect()
    }
}
