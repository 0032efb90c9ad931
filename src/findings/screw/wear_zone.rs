//! A zone where the screw is worn: the error has a bump there, and the ways forth and back differ more than
//! elsewhere. Zones of several widths and places, with soft and with steep ends.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place, together};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "wear_zone",
    summary: "A zone of the travel is worn: error or lost motion have a bump there.",
    mechanism: "wear",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| vec![Place::new("screw", members(case))],
    parameters: |case, blamed| {
        let [centre, width] = [blamed.shape[0], blamed.shape[1]];
        let middle = case.test.readings[0].target - case.at[0];
        vec![
            ("centre", middle + centre, "m"),
            ("half_width", width, "m"),
            ("bump", blamed.amounts[0], "m"),
            (
                "extra_gap",
                blamed.amounts.get(1).copied().unwrap_or(0.0),
                "m",
            ),
        ]
    },
    would_tell: "measure at more targets in and beside the zone",
};

/// Widest zone, half width over half of the travel, and none has its middle outside: where most of the travel is worn there is
/// no zone, but a lead that changes. Above the widest of [`WIDTHS`] by one step of what is sought about a zone; no other
/// value was tried.
const WIDEST: f64 = 0.6;
/// Half widths over half of the travel.
const WIDTHS: [f64; 6] = [0.05, 0.08, 0.14, 0.22, 0.33, 0.5];
/// Steepness of the ends: 2 is a bell, 8 nearly a box.
const POWERS: [f64; 2] = [2.0, 8.0];
/// Steps about a zone that was found: of its centre, in half widths, of its width and its steepness, factors.
const SHIFTS: [f64; 7] = [-0.4, -0.15, -0.05, 0.0, 0.05, 0.15, 0.4];
const STRETCHES: [f64; 5] = [0.75, 0.92, 1.0, 1.09, 1.33];
const STEEPER: [f64; 3] = [0.8, 1.0, 1.25];

/// Shapes about one that was found: a strong zone leaves more than noise where its place is not met.
pub(super) fn about(case: &Case, shape: &[f64]) -> Vec<Member> {
    let [centre, width, power] = [shape[0], shape[1], shape[2]];
    let mut members = Vec::new();
    for shift in SHIFTS {
        for stretch in STRETCHES {
            let place = centre + shift * width;
            if width * stretch > WIDEST * case.half || place.abs() > case.half {
                continue;
            }
            let steep = STEEPER.map(|s| member(case, place, width * stretch, power * s));
            members.extend(steep);
        }
    }
    members
}

fn members(case: &Case) -> Vec<Member> {
    let mut members = Vec::new();
    for width in WIDTHS {
        // places half a width apart: a zone between two of them still looks like a zone
        let count = (3.6 / width).ceil() as i32;
        for k in 0..=count {
            let centre = case.half * (-0.9 + 1.8 * f64::from(k) / f64::from(count));
            members.extend(
                POWERS
                    .iter()
                    .map(|power| member(case, centre, width * case.half, *power)),
            );
        }
    }
    members
}

fn member(case: &Case, centre: f64, width: f64, power: f64) -> Member {
    let bump = |i: usize| {
        (-std::f64::consts::LN_2 * ((case.at[i] - centre) / width).abs().powf(power)).exp()
    };
    let mut columns = vec![case.column(bump)];
    if case.both_ways() {
        columns.push(case.column(|i| case.side[i] * bump(i)));
    }
    together(columns, &[centre, width, power])
}
