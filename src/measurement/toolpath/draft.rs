//! A path while it is read: the moves so far, and what was passed over.

use super::{Move, Nurbs, Orientation, PassedOver, Shape};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{Pose, V3};
use crate::ground::units::FARTHEST_M;
use std::path::PathBuf;

/// What a reader hands back.
#[derive(Debug, Default)]
pub(super) struct Draft {
    pub(super) moves: Vec<Move>,
    pub(super) curve: Option<Nurbs>,
    pub(super) base: Option<Pose>,
    pub(super) tool: Option<Pose>,
    pub(super) passed_over: Vec<PassedOver>,
    pub(super) inputs: Vec<(PathBuf, String)>,
    pub(super) synthetic: bool,
    /// It was corrected: its commands are not the part that was drawn.
    pub(super) corrected: bool,
}

/// Different words that are counted one by one; the others are counted together.
const WORDS: usize = 60;
/// Letters of a word that are kept.
const LETTERS: usize = 24;
/// Most moves of a path: what a file of the largest size can hold, and a stop to programs that call
/// each other.
const MOVES: usize = 20_000_000;
/// Slowest and fastest feed, m/s: others are a slip of the unit or the exponent.
const FEEDS: std::ops::RangeInclusive<f64> = 1e-9..=1e3;
/// Fastest spindle, rad/s: a million revolutions a minute.
const SPINDLE: f64 = 1.1e5;

impl Draft {
    /// Counts something that has no effect on the path.
    pub(super) fn pass_over(&mut self, what: &str, line: usize) {
        let what: String = what.chars().take(LETTERS).collect();
        let full = self.passed_over.len() >= WORDS;
        let other = "others";
        let known = |what: &str| self.passed_over.iter().position(|p| p.what == what);
        let at = known(&what).or_else(|| known(other).filter(|_| full));
        match at {
            Some(i) => self.passed_over[i].count += 1,
            None => self.passed_over.push(PassedOver {
                what: if full { other.into() } else { what },
                count: 1,
                line,
            }),
        }
    }

    /// Adds a move.
    ///
    /// # Errors
    /// A point that is not finite or kilometres away, a feed or speed that no machine has; too many
    /// moves.
    pub(super) fn push(&mut self, next: Move) -> Outcome<()> {
        within(next.to)?;
        possible(&next)?;
        if self.moves.len() >= MOVES {
            let remedy = "split the path into several files";
            return Err(Problem::new(format!("has more than {MOVES} moves"), remedy));
        }
        self.moves.push(next);
        Ok(())
    }

    /// The end of the last move, m.
    pub(super) fn here(&self) -> Option<V3> {
        self.moves.last().map(|last| last.to)
    }
}

/// Refuses a feed, an approximation distance or a spindle speed that no machine has.
fn possible(next: &Move) -> Outcome<()> {
    let feed = next.feed.is_none_or(|feed| FEEDS.contains(&feed));
    let mut blends = next.blend.iter().chain(&next.own_blend);
    let blend = blends.all(|blend| (0.0..=FARTHEST_M).contains(blend));
    let spindle = next.spindle.is_none_or(|speed| speed.abs() <= SPINDLE);
    let what = match (feed, blend, spindle) {
        (true, true, true) => return Ok(()),
        (false, ..) => "the feed is one that no machine has",
        (_, false, _) => "the approximation distance is one that no path has",
        _ => "the speed is one that no spindle has",
    };
    Err(Problem::new(
        what,
        "check the unit and the exponent of its last statement",
    ))
}

/// Refuses a point that is not finite or kilometres away.
pub(super) fn within(point: V3) -> Outcome<()> {
    match point.iter().all(|x| x.abs() <= FARTHEST_M) {
        true => Ok(()),
        false => Err(Problem::new(
            format!("the point is more than {} km away", FARTHEST_M * 1e-3),
            "check the unit and the exponents of the coordinates",
        )),
    }
}

impl Move {
    /// A line to a point, about which nothing else is said.
    pub(super) fn line(to: V3, orientation: Orientation, line: usize) -> Self {
        Self {
            to,
            orientation,
            feed: None,
            rapid: false,
            shape: Shape::Line,
            blend: None,
            own_blend: None,
            spindle: None,
            station: None,
            line,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_passed_over_is_counted_and_bounded() {
        let mut draft = Draft::default();
        for i in 0..1000 {
            draft.pass_over(&format!("word{i}"), i + 1);
            draft.pass_over("word0", i + 1);
        }
        assert_eq!(
            (draft.passed_over[0].count, draft.passed_over[0].line),
            (1001, 1)
        );
        assert_eq!(draft.passed_over.len(), WORDS + 1);
        assert_eq!(
            draft.passed_over.iter().map(|p| p.count).sum::<usize>(),
            2000
        );
    }

    #[test]
    fn points_that_are_nowhere_are_refused() {
        assert!(within([0.0, f64::NAN, 0.0]).is_err());
        assert!(within([0.0, 0.0, 1e9]).is_err());
    }
}
