//! What stands behind the points of a motion: approximation, frame, angle of a circle.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::DEGREE;
use crate::measurement::toolpath::krl::scan::{head_of, operand};
use crate::measurement::toolpath::krl::shown;
use crate::measurement::toolpath::source::number;
use std::f64::consts::TAU;

/// What stands behind the points of a motion.
#[derive(Debug, Default)]
pub(super) struct Tail {
    pub(super) blends: bool,
    pub(super) in_tool: bool,
    pub(super) circular_angle: Option<f64>,
}

impl Tail {
    pub(super) fn of(text: &str) -> Outcome<Self> {
        let mut tail = Self::default();
        let mut rest = text.trim().trim_start_matches(',').trim_start();
        while !rest.is_empty() {
            let (word, behind) = match rest.strip_prefix('#') {
                Some(named) => head_of(named),
                None => head_of(rest),
            };
            rest = behind.trim_start();
            match word {
                "C_DIS" | "C_SPL" => tail.blends = true,
                "BASE" => tail.in_tool = false,
                "TOOL" => tail.in_tool = true,
                "CA" => rest = tail.angle(rest)?,
                _ => return Err(strange_tail(word)),
            }
            rest = rest.trim_start_matches(',').trim_start();
        }
        Ok(tail)
    }

    fn angle<'a>(&mut self, rest: &'a str) -> Outcome<&'a str> {
        let (text, behind) = operand(rest);
        let angle = number(text).map(|degrees| degrees * DEGREE);
        let angle = angle.filter(|angle| angle.abs() > 1e-9 && angle.abs() <= 100.0 * TAU);
        self.circular_angle = Some(angle.ok_or_else(|| {
            let remedy = "write CA and the angle in degrees";
            Problem::new(format!("`{}` is no angle of a circle", shown(text)), remedy)
        })?);
        Ok(behind)
    }

    pub(super) fn and(self, other: Self) -> Self {
        Self {
            blends: self.blends || other.blends,
            in_tool: self.in_tool || other.in_tool,
            circular_angle: self.circular_angle.or(other.circular_angle),
        }
    }
}

fn strange_tail(word: &str) -> Problem {
    let what = match word {
        "" => "something behind the point is not understood".to_string(),
        _ => format!("`{}` behind the point is not understood", shown(word)),
    };
    Problem::new(
        what,
        "approximate with C_DIS and $APO.CDIS; frames are not computed with `:`",
    )
}
