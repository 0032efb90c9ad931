//! The tool runs out of centre.

use super::Case;
use super::aim::is_wild;
use super::coefficients::moved;
use super::setting::PROCESS;
use crate::experiments::milling_force::RUNOUT;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "runout",
    summary: "The tool turns about another axis than its own: its teeth take unequal chips.",
    mechanism: "teeth",
    law_error: 0.03,
    can_be: |_, _| true,
    places: |case| {
        if case.places().teeth < 2 {
            return Vec::new();
        }
        vec![Place::new("tool", vec![whole(case)])]
    },
    parameters: |case, blamed| {
        let sum = moved(case, blamed);
        let stated = case.cuts()[0].present.p;
        let [x, y] = [0, 1].map(|k| stated[RUNOUT + k] + sum[RUNOUT + k]);
        vec![
            ("runout", x.hypot(y), "m"),
            ("runout_angle", y.atan2(x), "rad"),
        ]
    },
    would_tell: "put a dial gauge on the shank, and look at the teeth",
};

/// Unit of the amounts, m.
const UNIT: f64 = 1e-6;
/// No runout is larger, in that unit.
const MOST: f64 = 200.0;
/// Rounds in which its direction and its size are improved.
const ROUNDS: usize = 8;
/// Change of either, as a share, at which it has arrived.
const ARRIVED: f64 = 3e-3;

/// The way to where a runout fits best, and its slope across.
fn whole(case: &Case) -> Member {
    let towards = |angle: f64| {
        let mut direction = vec![0.0; case.places().len()];
        (direction[RUNOUT], direction[RUNOUT + 1]) = (UNIT * angle.cos(), UNIT * angle.sin());
        direction
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    let (mut angle, mut before) = (0.0, 0.0);
    let mut columns = vec![case.along(&towards(0.0)), case.along(&towards(quarter))];
    for _ in 0..ROUNDS {
        let amounts = case.aim().amounts(&columns);
        let size = amounts[0].hypot(amounts[1]).min(MOST);
        let turn = amounts[1].atan2(amounts[0]);
        if size < 1e-3 || (size / before - 1.0_f64).abs().max(turn.abs()) < ARRIVED {
            break;
        }
        before = size;
        let known: Vec<f64> = columns[0]
            .iter()
            .zip(&columns[1])
            .map(|(a, b)| a * turn.cos() + b * turn.sin())
            .collect();
        angle += turn;
        let slope = case.along(&towards(angle));
        let way = case.aim().reached(case, &towards(angle), size, &known);
        let is_wild = is_wild(&way, &slope);
        columns = vec![
            if is_wild { slope } else { way },
            case.along(&towards(angle + quarter)),
        ];
        if is_wild {
            break;
        }
    }
    let directions = [towards(angle), towards(angle + quarter)];
    Member {
        columns,
        size: Size::Free,
        positive: None,
        shape: std::iter::once(PROCESS)
            .chain(directions.into_iter().flatten())
            .collect(),
    }
}
