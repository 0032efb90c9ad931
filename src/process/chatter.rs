//! Whether robot and cut drive one another: then the force grows to a multiple of what the same cut takes where nothing gives way, until
//! teeth leave the part.

use super::run::Outcome as Milled;
use super::setup::{Setup, Support};
use crate::ground::problem::{Outcome, Problem};
use crate::sheet::number::significant;

/// Largest force over that of the same cut where nothing gives way, from which on it is chatter. On 44 jobs by a stranger it was 3.7 to
/// 22 where his own plant chattered (seven), 1.3 to 1.7 near the limit (five), at most 1.3 elsewhere.
const TIMES: f64 = 2.5;

/// That many times, where a milled part chatters; only where robot and cut are coupled in time.
///
/// # Errors
/// As the run.
pub fn chatter(setup: &Setup, support: Support, milled: &Milled) -> Outcome<Option<f64>> {
    if support != Support::Coupled || milled.removed_m3 == 0.0 {
        return Ok(None);
    }
    let (rigid, _) = setup.run(Support::Rigid, |_| {})?;
    let times = milled.peak_n / rigid.peak_n.max(f64::MIN_POSITIVE);
    Ok((times > TIMES).then_some(times))
}

/// Why a part cannot be milled: what was said, or chatter, where the cut is well where nothing gives way.
pub(super) fn or_chatter(setup: &Setup, problem: Problem) -> Problem {
    match setup.run(Support::Rigid, |_| {}) {
        Err(_) => problem,
        Ok(_) => Problem::new(
            format!(
                "{}; where nothing gives way it does not: robot and cut drive one another (chatter)",
                problem.what
            ),
            "cut less deep: `ident lobes` with --along says how deep one may",
        ),
    }
}

/// What the reader should know of it.
pub fn sentence(times: f64) -> String {
    format!(
        "the force grows to {} times what it is where nothing gives way: robot and cut drive one another (chatter), so that neither force nor deviation says more; `ident lobes` with --along says how deep one may cut",
        significant(times, 2)
    )
}
