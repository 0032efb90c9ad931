//! Proposed set-ups as they are printed (`formats.md`, section 3).

use super::{Chosen, Plan, Tells};
use crate::ground::units::DEGREE;
use crate::measurement::workspace_test::DIRECTIONS;
use serde::Serialize;

/// A set-up as it is printed; the rank counts from 1, the most telling first.
#[derive(Serialize)]
pub struct SetupDocument {
    rank: usize,
    joint_angles_deg: Vec<f64>,
    tool: &'static str,
    direction: &'static str,
    sensor: String,
    gain_nats: f64,
    tells: TellsDocument,
}

#[derive(Serialize)]
#[serde(untagged)]
enum TellsDocument {
    Apart {
        sites: [String; 2],
        correlation: [f64; 2],
    },
    Size {
        sites: [String; 1],
        relative_std: [f64; 2],
    },
}

impl SetupDocument {
    /// The set-ups of a plan, the most telling first.
    pub fn of(plan: &Plan) -> Vec<Self> {
        let numbered = plan.chosen.iter().enumerate();
        numbered.map(|(i, one)| Self::new(i + 1, one)).collect()
    }

    fn new(rank: usize, one: &Chosen) -> Self {
        let angles = one.setting.angles.iter();
        Self {
            rank,
            joint_angles_deg: angles.map(|q| rounded(q / DEGREE)).collect(),
            tool: one.setting.reach.word(),
            direction: DIRECTIONS[one.setting.direction],
            sensor: one.setting.seat.name(),
            gain_nats: one.gain,
            tells: told(&one.tells),
        }
    }
}

fn told(tells: &Tells) -> TellsDocument {
    match tells {
        Tells::Apart { sites, correlation } => TellsDocument::Apart {
            sites: sites.clone(),
            correlation: *correlation,
        },
        Tells::Size { site, std } => TellsDocument::Size {
            sites: [site.clone()],
            relative_std: *std,
        },
    }
}

/// Four decimals, as controllers show.
fn rounded(degrees: f64) -> f64 {
    (degrees * 1e4).round() / 1e4
}
