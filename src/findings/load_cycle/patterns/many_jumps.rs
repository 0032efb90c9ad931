//! A level that jumps again and again: a loose plug, a magnetic foot that is touched, a rattling clamp.

use super::{Kind, Seen, Sought};
use crate::findings::load_cycle::families::{Jump, View};
use crate::findings::table::flexible;
use crate::sheet::number::engineering;
use crate::signal::steps::window;

/// What is seen, a phrase.
pub const JUMPS: &str = "a level that jumps again and again, whatever the load does";

pub(super) const KIND: Kind = Kind {
    name: "many jumps",
    summary: JUMPS,
    seek,
};

/// Jumps that are many: one or two are a slip.
const MANY: usize = 3;
/// Share of the largest that a jump must have to count: a slip that runs on has smaller ones after it.
const LIKE: f64 = 0.25;
/// Share of the rows within which jumps of one sign may be one change that takes its time.
const SLOW: usize = 12;
/// Jumps that are told with their place.
const TOLD: usize = 8;

fn seek(seen: &Seen) -> Sought {
    let (all, view) = (&seen.view.jumps.many, seen.view);
    let members = match counted(view).len() < MANY {
        true => Vec::new(),
        false => flexible(all.iter().map(|jump| view.since(jump.row)).collect()),
    };
    Sought {
        members,
        searched: ln_choices(view.rows(), all.len()),
    }
}

/// The changes of level that are like in size, each once: what is averaged of several rows may need two steps for one.
fn counted(view: &View) -> Vec<Jump> {
    let all = &view.jumps.many;
    let largest = all.iter().fold(0.0_f64, |m, jump| m.max(jump.height.abs()));
    let (near, slow) = (window(view.rows()), view.rows() / SLOW);
    let mut kept: Vec<Jump> = Vec::new();
    let mut end = 0;
    for jump in all.iter().filter(|j| j.height.abs() >= LIKE * largest) {
        let is_one = |last: &Jump| {
            let within = match last.height * jump.height > 0.0 {
                true => slow,
                false => near,
            };
            jump.row - end < within.max(near)
        };
        match kept.last_mut().filter(|last| is_one(last)) {
            Some(last) => last.height += jump.height,
            None => kept.push(*jump),
        }
        end = jump.row;
    }
    kept.retain(|jump| jump.height.abs() >= LIKE * largest);
    kept
}

/// How often, when and by how much; `time` in s, of every row.
pub fn told(view: &View, time: &[f64], unit: &str) -> String {
    let all = counted(view);
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
