//! A level that jumps again and again: a loose plug, a magnetic foot that is touched, a rattling clamp.

use super::{Kind, Seen, Sought};
use crate::findings::load_cycle::families::View;
use crate::findings::table::flexible;
use crate::sheet::number::engineering;

/// What is seen, a phrase.
pub const JUMPS: &str = "a level that jumps again and again, whatever the load does";

pub(super) const KIND: Kind = Kind {
    name: "many jumps",
    summary: JUMPS,
    seek,
};

/// Jumps that are told with their place.
const TOLD: usize = 8;

fn seek(seen: &Seen) -> Sought {
    let (all, view) = (&seen.view.jumps, seen.view);
    let members = match all.is_few() {
        true => Vec::new(),
        false => flexible(all.many.iter().map(|jump| view.since(jump.row)).collect()),
    };
    Sought {
        members,
        searched: ln_choices(view.rows(), all.many.len()),
    }
}

/// How often, when and by how much; `time` in s, of every row.
pub fn told(view: &View, time: &[f64], unit: &str) -> String {
    let all = &view.jumps.counted;
    let each = all.iter().take(TOLD).map(|jump| {
        let by = engineering(jump.height, 2, unit);
        format!("at {:.1} s by {by}", time[jump.row])
    });
    let more = match all.len() > TOLD {
        true => format!(" and {} more", all.len() - TOLD),
        false => String::new(),
    };
    format!(
        "a level that jumps {} times, whatever the load does: {}{more}.",
        all.len(),
        each.collect::<Vec<_>>().join(", ")
    )
}

/// Logarithm of the ways to choose so many of so many, by Stirling's formula: every place was as likely as another.
fn ln_choices(of: usize, count: usize) -> f64 {
    let (n, k) = (of.max(1) as f64, count as f64);
    match count {
        0 => 0.0,
        _ => k * ((n / k).ln() + 1.0),
    }
}
