//! The way to the cut, slowed: a soft robot that comes with its rapid speed still swings when it cuts.

use crate::ground::problem::Outcome;
use crate::measurement::toolpath::{Move, Toolpath};
use crate::process::Planned;

/// The job with its rapid motions at the feed of its cuts; `None` where it has none. The path itself stays:
/// a rapid motion that does not blend into a cut still does not.
///
/// # Errors
/// As the planner's.
pub fn calm(planned: &Planned) -> Outcome<Option<Planned>> {
    let moves = &planned.toolpath.moves;
    if !moves.iter().skip(1).any(|one| one.rapid) {
        return Ok(None);
    }
    let feeds = moves.iter().skip(1).filter(|one| !one.rapid);
    let own = feeds.filter_map(|one| one.feed).fold(0.0, f64::max);
    let feed = planned.job.feed.or((own > 0.0).then_some(own));
    let next = moves.iter().skip(1).chain(moves.last());
    let slowed = moves.iter().zip(next).map(|(one, next)| match one.rapid {
        false => *one,
        true => Move {
            rapid: false,
            feed: feed.or(one.feed),
            own_blend: if next.rapid { one.own_blend } else { Some(0.0) },
            ..*one
        },
    });
    let toolpath = Toolpath {
        moves: slowed.collect(),
        ..planned.toolpath.clone()
    };
    let planned = Planned::of(planned.job.clone(), toolpath)?;
    planned.map(Some).map_err(|unplanned| unplanned.problem)
}
