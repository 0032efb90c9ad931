//! The dynamometer rings: a resonance of the second order between the force and its reading. It is found in
//! the lines of the tooth passing, then brought closer while what is uncertain moves along.

use super::Case;
use super::revolution::Revolution;
use super::ringing::{Lines, MOST_DAMPING, Ringing};
use super::setting::SENSOR;
use crate::experiments::resonance::{Resonance, Resonant};
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};
use crate::ground::spatial::{V3, rotate};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "sensor_resonance",
    summary: "The sensor rings: it magnifies forces near its own frequency.",
    mechanism: "resonance",
    // what carries a sensor has more than one mode
    law_error: 0.09,
    can_be: |_, _| true,
    places: |case| vec![Place::new("sensor", members(case))],
    parameters: |_, blamed| {
        let mut told = vec![
            ("frequency", blamed.shape[2], "Hz"),
            ("damping_ratio", blamed.shape[3], "1"),
            ("share", blamed.amounts[0], "1"),
        ];
        let axes = AXES[blamed.shape[1] as usize];
        match axes {
            [true, true, true] => {}
            _ => told.extend((0..3).filter(|k| axes[*k]).map(|k| ("axis", k as f64, "1"))),
        }
        told
    },
    would_tell: "strike the sensor with a hammer while the spindle stands",
};

/// Shares by which it is brought closer, one after the other.
const CLOSER: [f64; 4] = [0.006, 0.003, 0.0015, 0.0007];
/// Steps of the frequency, in these shares.
const STEPS_ABOUT: [f64; 3] = [-1.0, 0.0, 1.0];
/// Steps of the damping ratio, in these shares.
const SOFTER: [f64; 3] = [-12.0, 0.0, 12.0];
/// Rounds in which what is uncertain moves along.
const ROUNDS: usize = 3;
/// Axes that are looked at further.
const TRIED: usize = 2;
/// Squared noise deviations that a resonance must take of the lines to be looked at further.
const SEEN: f64 = 20.0;
/// Axes that ring: one, all, or those of the table, across which a plate on four cells is soft.
const AXES: [[bool; 3]; 5] = [
    [true, false, false],
    [false, true, false],
    [false, false, true],
    [true, true, true],
    [true, true, false],
];

/// The best of every axis and of all, brought closer.
fn members(case: &Case) -> Vec<Member> {
    let revolutions = revolutions(case, &vec![0.0; case.places().len()]);
    let lines = Lines::of(case, &revolutions);
    let silent = lines.silent();
    let passes = case.cuts().iter().any(|c| c.present.scene.low_pass);
    let ways: &[bool] = if passes { &[false, true] } else { &[false] };
    let tried = ways
        .iter()
        .flat_map(|w| (0..AXES.len()).map(|axes| (axes, *w)));
    let mut all: Vec<(usize, Ringing)> = tried
        .map(|(axes, instead)| (axes, lines.best(AXES[axes], instead)))
        .collect();
    all.retain(|(_, ringing)| ringing.misfit < silent - SEEN);
    all.sort_by(|a, b| a.1.misfit.total_cmp(&b.1.misfit));
    all.iter()
        .take(TRIED)
        .map(|(axes, ringing)| member(case, &lines, *axes, ringing))
        .filter(|m| m.columns[0].iter().any(|x| *x != 0.0))
        .collect()
}

fn revolutions(case: &Case, to: &[f64]) -> Vec<Revolution> {
    let there: Vec<f64> = case.offset.iter().zip(to).map(|(o, d)| o + d).collect();
    let one = |c: usize| Revolution::new(&case.cuts()[c].present, case.setting(c, &there));
    (0..case.cuts().len()).map(one).collect()
}

fn member(case: &Case, lines: &Lines, number: usize, ringing: &Ringing) -> Member {
    let axes = AXES[number];
    let (aim, places) = (case.aim(), case.places());
    let mut to = vec![0.0; places.len()];
    for (c, turn) in ringing.turns.iter().enumerate() {
        to[places.phase(c)] = *turn;
    }
    let mut resonance = ringing.resonance;
    let highest = lines.highest_hz();
    let beyond = |to: &[f64]| less(&case.step(to), &case.along(to));
    let ringing = added(case, axes, resonance, &revolutions(case, &to));
    let mut column = sum(&ringing, &beyond(&to));
    for _ in 0..ROUNDS {
        let amount = aim.amounts(std::slice::from_ref(&column))[0].clamp(0.2, 1.5);
        to = aim.uncertain(case, amount, &column);
        let (own, here) = (revolutions(case, &to), beyond(&to));
        let before = resonance;
        resonance = closer(case, axes, resonance, &own, &here);
        resonance.at[0] = resonance.at[0].min(highest);
        column = sum(&added(case, axes, resonance, &own), &here);
        if resonance == before {
            break;
        }
    }
    let mut shape = vec![SENSOR, number as f64, resonance.at[0], resonance.at[1]];
    shape.push(f64::from(u8::from(resonance.instead)));
    shape.extend((0..places.cuts).map(|c| case.offset[places.phase(c)] + to[places.phase(c)]));
    Member::free(column).positive().shaped(&shape)
}

/// How the sensor rings.
pub(super) fn resonant(blamed: &Blamed) -> Option<Resonant> {
    let [_, number, hz, damping, instead, ..] = blamed.shape[..] else {
        return None;
    };
    (blamed.effect == EFFECT.name).then(|| Resonant {
        resonance: Resonance {
            at: [hz, damping],
            instead: instead > 0.0,
        },
        axes: AXES.get(number as usize).copied().unwrap_or_default(),
        share: blamed.amounts[0],
    })
}

/// Angles of tooth 1 that go with it, rad from what is stated, by cut.
pub(super) fn angles(blamed: &Blamed) -> &[f64] {
    match resonant(blamed) {
        Some(_) => &blamed.shape[5..],
        None => &[],
    }
}

/// What the ringing adds.
fn added(
    case: &Case,
    axes: [bool; 3],
    resonance: Resonance,
    revolutions: &[Revolution],
) -> Vec<f64> {
    let map = case.sensor().map;
    let shown = |f: V3| rotate(&map, [0, 1, 2].map(|k| if axes[k] { f[k] } else { 0.0 }));
    let of = |r: &Revolution| r.ringing(resonance).into_iter().map(shown).collect();
    let ringing: Vec<Vec<V3>> = revolutions.iter().map(of).collect();
    case.column(|c, i, k| ringing[c][i][k])
}

/// A resonance a little better than this one.
fn closer(
    case: &Case,
    axes: [bool; 3],
    resonance: Resonance,
    own: &[Revolution],
    here: &[f64],
) -> Resonance {
    let fitness = |resonance: Resonance| {
        case.aim()
            .gain(&sum(&added(case, axes, resonance, own), here))
    };
    let mut best = (resonance, fitness(resonance));
    for width in CLOSER {
        let [hz, damping] = best.0.at;
        for f in STEPS_ABOUT {
            for d in SOFTER.iter().filter(|d| f != 0.0 || **d != 0.0) {
                let damping = (damping * (1.0 + d * width)).clamp(0.002, MOST_DAMPING);
                let tried = Resonance {
                    at: [hz * (1.0 + width * f), damping],
                    ..resonance
                };
                let own = fitness(tried);
                if own > best.1 {
                    best = (tried, own);
                }
            }
        }
    }
    best.0
}

fn sum(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + b).collect()
}

fn less(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
