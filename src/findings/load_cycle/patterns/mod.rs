//! What is seen now and then and no cause of the library does: a level that jumps again and again, ringing after the corners
//! of the load, a slope that comes back. They compete with the causes, so that they take none of their names, and with the noise, which else
//! would take them for colour or for bursts; they are never named.

mod many_jumps;
mod ringing;
mod wandering_stiffness;

pub use many_jumps::{JUMPS, told};

use super::families::View;
use crate::findings::engine::{Member, Suspect};
use crate::findings::table::{self, Pattern};

/// What a pattern is sought in.
pub struct Seen<'a> {
    /// The record.
    pub view: &'a View,
    /// What the spring, curves of the load and a straight course of time leave of its readings.
    pub left: Vec<f64>,
}

/// A pattern, and what its search cost.
struct Sought {
    members: Vec<Member>,
    /// Logarithm of how many like it were looked through for every one that is kept.
    searched: f64,
}

/// One kind of pattern.
struct Kind {
    name: &'static str,
    summary: &'static str,
    seek: fn(&Seen) -> Sought,
}

const KINDS: &[Kind] = &[many_jumps::KIND, ringing::KIND, wandering_stiffness::KIND];

/// The patterns of a record.
pub fn patterns(view: &View, reading: &[f64]) -> Vec<Suspect> {
    let seen = Seen {
        left: view.left(reading),
        view,
    };
    KINDS.iter().flat_map(|kind| suspect(kind, &seen)).collect()
}

fn suspect(kind: &Kind, seen: &Seen) -> Vec<Suspect> {
    let sought = (kind.seek)(seen);
    let pattern = Pattern {
        name: kind.name,
        summary: kind.summary,
        members: |members: &Vec<Member>| members.clone(),
    };
    let mut own = table::patterns(&[pattern], &sought.members);
    own.iter_mut().for_each(|s| s.share -= sought.searched);
    own
}
