//! Priors of stiffnesses that are fitted along with dampings, widened until the data agree with them.

use super::frf_nuisance::{Pull, along, widened};
use super::frf_solved::{Begun, begin, finish, solve};
use super::frf_tuning::{Parameter, Tuned, Tuning};
use crate::ground::problem::Outcome;

/// How often priors are widened at most.
const WIDENINGS: usize = 4;

/// The task begun, its priors widened until the stiffnesses that are fitted along agree with them on the
/// lines that the search begins with.
pub(super) fn widened_first(task: &Tuning) -> Outcome<(Tuning, Begun)> {
    let mut wide = task.clone();
    let mut begun = begin(&wide)?;
    for _ in 0..WIDENINGS {
        if begun.worse_than_nothing() {
            break;
        }
        let Some(wider) = widened(&wide.parameters, &begun.pulls()) else {
            break;
        };
        wide.parameters = wider;
        begun = begin(&wide)?;
    }
    Ok((wide, begun))
}

/// The tuning on all lines, priors widened until they agree there, and where the stiffnesses that are fitted
/// along went against what was stated of them.
pub(super) fn solved(task: &Tuning, mut wide: Tuning, begun: Begun) -> Outcome<(Tuned, Vec<Pull>)> {
    let mut solved = finish(&wide, begun)?;
    for _ in 0..WIDENINGS {
        if solved.worse_than_nothing(&wide) {
            break;
        }
        let Some(wider) = widened(&wide.parameters, &solved.pulls(&wide)) else {
            break;
        };
        wide.parameters = wider;
        solved = solve(&wide)?;
    }
    let tuned = solved.told(&wide);
    let stated = task.parameters.iter().filter(|p| along(p));
    let against = |(pull, stated): (&Pull, &Parameter)| Pull {
        prior_ln_std: stated.prior_ln_std.unwrap_or(pull.prior_ln_std),
        ..pull.clone()
    };
    let pulls = tuned.pulls.iter().zip(stated).map(against).collect();
    Ok((tuned, pulls))
}
