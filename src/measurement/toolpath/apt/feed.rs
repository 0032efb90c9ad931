//! Feeds: per minute, per second, per revolution of a spindle whose speed is stated.

use super::State;
use super::statement::Statement;
use crate::ground::problem::{Outcome, Problem};
use std::f64::consts::TAU;

/// Units of feed: word, m/s (or m) per unit if fixed, else the divisor of the file's unit, and
/// whether it is per revolution.
const FEED_UNITS: &[(&str, Option<f64>, f64, bool)] = &[
    ("MMPM", Some(1e-3 / 60.0), 1.0, false),
    ("MMPMIN", Some(1e-3 / 60.0), 1.0, false),
    ("MPM", Some(1.0 / 60.0), 1.0, false),
    ("MMPS", Some(1e-3), 1.0, false),
    ("IPM", Some(0.0254 / 60.0), 1.0, false),
    ("FPM", Some(0.3048 / 60.0), 1.0, false),
    ("PERMIN", None, 60.0, false),
    ("UPM", None, 60.0, false),
    ("MMPR", Some(1e-3), 1.0, true),
    ("IPR", Some(0.0254), 1.0, true),
    ("PERREV", None, 1.0, true),
    ("UPR", None, 1.0, true),
];

impl State {
    /// m/s, if stated.
    pub(super) fn feed(&self) -> Option<f64> {
        let turning = self.spindle.filter(|w| *w != 0.0);
        let per_turn = self.per_turn.zip(turning);
        per_turn.map(|(feed, w)| feed * w.abs() / TAU).or(self.feed)
    }

    /// FEDRAT.
    pub(super) fn feed_rate(&mut self, statement: &Statement) -> Outcome<()> {
        if let Some(circle) = &mut self.circle {
            circle.feed_changes();
        }
        if statement.says("RAPID") {
            self.rapid = true;
            return Ok(());
        }
        let value = statement.one_number()?;
        if value <= 0.0 {
            return Err(Problem::new(
                "the feed is not above zero",
                "write FEDRAT/1000.,MMPM",
            ));
        }
        let (scale, per_turn) = self.feed_unit(statement)?;
        (self.feed, self.per_turn) = match per_turn {
            true => (None, Some(value * scale)),
            false => (Some(value * scale), None),
        };
        if per_turn && !self.spindle.is_some_and(|w| w != 0.0) {
            let remedy =
                "state the speed of the spindle first (SPINDL/), or a feed per minute (MMPM, IPM)";
            return Err(Problem::new(
                "a feed per revolution of a spindle whose speed is not stated",
                remedy,
            ));
        }
        Ok(())
    }

    /// m/s, or m per revolution, in the unit of the statement.
    fn feed_unit(&self, statement: &Statement) -> Outcome<(f64, bool)> {
        let words = statement.words();
        let known = words.iter().find_map(|word| {
            let unit = FEED_UNITS.iter().find(|unit| unit.0 == *word);
            unit.map(|unit| (unit.1.unwrap_or(self.unit / unit.2), unit.3))
        });
        match (known, words.is_empty()) {
            (Some(found), _) => Ok(found),
            (None, true) => Ok((self.unit / 60.0, false)),
            (None, false) => Err(Problem::new(
                format!("`{}` is no unit of feed that is known", words.join(",")),
                "write MMPM, IPM, MMPR or IPR",
            )),
        }
    }
}
