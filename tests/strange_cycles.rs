//! Load cycles that once were judged by the wrong kind of answer: many jumps, ringing, a gap off centre, weights put on once.

use ident::effects::Composite;
use ident::findings::{Diagnosis, Settings, Verdict, diagnose};
use ident::fit::parameter::Identified;
use ident::fit::stiffness::{DEFAULT_EFFECTS, Request, identify};
use ident::fit::suitability::is_fatal;
use ident::ground::random::Random;
use ident::measurement::load_cycle::LoadCycle;
use ident::measurement::table::Table;
use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::Path;

/// Stiffness, N·m/rad; largest moment, N·m; noise of a reading as a share of the largest deflection.
const STIFFNESS: f64 = 1e6;
const LARGEST: f64 = 1000.0;
const NOISE: f64 = 1.0 / 400.0;

/// A file of loads and deflections as shares of the largest, a row every `step` seconds.
fn file(load: &[f64], deflection: &[f64], step: f64, seed: u64) -> LoadCycle {
    let mut random = Random::new(seed);
    let mut text = format!(
        "# kind = \"load-cycle\"\n# joint = 2\n# axis = \"rotation\"\n# nominal_stiffness_Nm_rad = {STIFFNESS}\n\
         # nominal_stiffness_rel_std = 0.05\ntime_s,moment_Nm,angle_urad\n"
    );
    for (i, (u, y)) in load.iter().zip(deflection).enumerate() {
        let read = (y + NOISE * random.normal()) * LARGEST / STIFFNESS * 1e6;
        let (time, moment) = (i as f64 * step, u * LARGEST);
        writeln!(text, "{time:.4},{moment:.4},{read:.5}").unwrap();
    }
    let bytes = text.as_bytes();
    let table = Table::from_reader(Path::new("case.csv"), bytes, bytes.len() as u64).unwrap();
    LoadCycle::from_table(table).unwrap()
}

fn judged(file: &LoadCycle) -> Diagnosis {
    diagnose(file, &Settings::default())
}

/// Three triangles from zero load.
fn triangles(rows: usize) -> Vec<f64> {
    let at = |i: usize| (3.0 * i as f64 / rows as f64 + 0.25).fract();
    (0..rows).map(|i| 1.0 - 4.0 * (at(i) - 0.5).abs()).collect()
}

/// Six of them.
fn more_triangles(rows: usize) -> Vec<f64> {
    let at = |i: usize| (6.0 * i as f64 / rows as f64 + 0.25).fract();
    (0..rows).map(|i| 1.0 - 4.0 * (at(i) - 0.5).abs()).collect()
}

/// Six levels up and five down, twelve readings on each.
fn weights() -> Vec<f64> {
    let levels = (0..6).chain((0..5).rev());
    levels
        .flat_map(|level| [f64::from(level) / 5.0; 12])
        .collect()
}

fn with(load: &[f64], beside: impl Fn(usize, f64) -> f64) -> Vec<f64> {
    let each = load.iter().enumerate();
    each.map(|(i, u)| u + beside(i, *u)).collect()
}

#[test]
fn what_jumps_many_times_is_no_drift() {
    let load = triangles(900);
    let jumps = [
        (110, 0.03),
        (260, -0.04),
        (420, 0.035),
        (640, 0.04),
        (760, -0.03),
    ];
    let level = |i: usize, _: f64| -> f64 {
        let before = jumps.iter().filter(|(row, _)| *row <= i);
        before.map(|(_, height)| height).sum()
    };
    let found = judged(&file(&load, &with(&load, level), 0.3, 7));
    let said = &found.unexplained.description;
    assert_eq!(found.verdict, Verdict::UnknownCause, "{:?}", found.causes);
    assert!(said.contains("jumps 5 times"), "{said}");
    assert!(said.contains("at 78.0 s by -40"), "{said}");
}

fn named(found: &Diagnosis) -> Vec<&'static str> {
    found.causes.iter().map(|cause| cause.effect).collect()
}

/// A slope that falls and rises again does not loosen; one that only falls does.
#[test]
fn what_loosens_does_not_come_back() {
    let load = more_triangles(900);
    let time = |i: usize| i as f64 / 900.0;
    let swings = |i: usize, u: f64| 0.05 * u * (1.7 * TAU * time(i) + 0.4).sin();
    let found = judged(&file(&load, &with(&load, swings), 0.3, 13));
    let said = &found.unexplained.description;
    assert_eq!(found.verdict, Verdict::UnknownCause, "{:?}", found.causes);
    assert!(said.contains("falls and rises again"), "{said}");
    let loosens = |i: usize, u: f64| 0.05 * u * time(i).sqrt();
    let found = judged(&file(&load, &with(&load, loosens), 0.3, 14));
    assert_eq!(named(&found), ["loosening"], "{}", found.verdict.name());
}

#[test]
fn what_slips_a_few_times_has_slipped() {
    let load = triangles(900);
    let slips = [(190, 0.04), (470, 0.055), (705, 0.03)];
    let level = |i: usize, _: f64| -> f64 {
        let before = slips.iter().filter(|(row, _)| *row <= i);
        before.map(|(_, height)| height).sum()
    };
    let found = judged(&file(&load, &with(&load, level), 0.3, 11));
    assert_eq!(named(&found), ["slip"], "{}", found.verdict.name());
}

#[test]
fn a_gap_that_a_weight_holds_open_shows_under_a_load_of_one_sign() {
    let load: Vec<f64> = triangles(900).iter().map(|u| u.abs()).collect();
    let step = |u: f64| ((u - 0.3) / 0.008).tanh() + 1.0;
    let found = judged(&file(&load, &with(&load, |_, u| 0.03 * step(u)), 0.3, 12));
    assert_eq!(named(&found), ["backlash"], "{}", found.verdict.name());
}

#[test]
fn a_drift_that_begins_steeply_is_no_zero_that_is_off() {
    let load = triangles(900);
    let drift = |i: usize, _: f64| {
        let t = i as f64 / 900.0;
        -0.05 * (5.0 * t).sin() - 0.03 * (9.0 * t).sin()
    };
    let found = judged(&file(&load, &with(&load, drift), 0.3, 13));
    assert_eq!(named(&found), ["thermal_drift"], "{}", found.verdict.name());
}

/// `formats.md`, section 3: an `explained` may carry groups; then one member of each stands among the causes.
#[test]
fn of_what_cannot_be_told_apart_one_stands_among_the_causes() {
    let load = triangles(900);
    let slip = |i: usize, u: f64| 0.35 * u + if i < 500 { 0.0 } else { 0.06 };
    let found = judged(&file(&load, &with(&load, slip), 0.3, 14));
    assert_eq!(found.verdict, Verdict::Explained);
    let said = serde_json::to_value(&found.answer).unwrap();
    let effects = said["cannot_separate"][0]["effects"].as_array().unwrap();
    let causes = said["causes"].as_array().unwrap().iter();
    let standing = causes.filter(|cause| effects.contains(&cause["effect"]));
    assert_eq!(standing.count(), 1, "{said}");
}

#[test]
fn ringing_after_the_corners_is_no_noise() {
    let load = triangles(900);
    let corners = [
        (75, 1.0),
        (225, -1.0),
        (375, 1.0),
        (525, -1.0),
        (675, 1.0),
        (825, -1.0),
    ];
    let ring = |i: usize, _: f64| -> f64 {
        let past = corners.iter().filter(|(row, _)| *row <= i);
        past.map(|(row, sign)| {
            let at = (i - row) as f64;
            0.04 * sign * (-at / 18.0).exp() * (0.8 * at).sin()
        })
        .sum()
    };
    let found = judged(&file(&load, &with(&load, ring), 0.3, 8));
    assert_eq!(found.verdict, Verdict::UnknownCause, "{:?}", found.causes);
    let knock = |i: usize, _: f64| match i >= 300 {
        true => 0.05 * (-((i - 300) as f64) / 15.0).exp() * (0.9 * (i - 300) as f64).sin(),
        false => 0.0,
    };
    let found = judged(&file(&load, &with(&load, knock), 0.3, 9));
    assert_eq!(found.verdict, Verdict::UnknownCause, "{:?}", found.causes);
}

#[test]
fn a_gap_off_centre_has_its_size_and_its_stiffness() {
    let load = triangles(2000);
    let step = |u: f64| ((u - 0.15) / 0.02).tanh() + 1.0;
    let file = file(&load, &with(&load, |_, u| 0.04 * step(u)), 0.2, 10);
    let found = judged(&file);
    let gap = found
        .causes
        .iter()
        .find(|c| c.effect == "backlash")
        .unwrap();
    let [low, high] = gap.interval("gap").unwrap();
    assert!((low..=high).contains(&80e-6), "{low} to {high}");
    assert!(high - low < 8e-6, "{low} to {high}");
    let request = Request {
        model: Composite::named(DEFAULT_EFFECTS).unwrap(),
        bootstrap: 0,
        seed: 1,
    };
    let account = identify(&file, &request);
    let [low, high] = account.parameters[0].ci95.unwrap();
    assert!(
        (0.998..1.002).contains(&(0.5 * (low + high) / STIFFNESS)),
        "{low} to {high}"
    );
}

#[test]
fn weights_put_on_and_taken_off_once_tell_a_spring() {
    let load = weights();
    let clean = judged(&file(&load, &load, 5.0, 11));
    assert_eq!(clean.verdict, Verdict::Sufficient, "{:?}", clean.doubts);
    assert!(clean.doubts.iter().any(|d| d.rule == "part-of-a-cycle"));
    let mut random = Random::new(12);
    let mut at = 0.0;
    let walk: Vec<f64> = load
        .iter()
        .map(|_| {
            at += 0.1 * random.normal();
            at
        })
        .collect();
    assert!(is_fatal(&judged(&file(&load, &walk, 5.0, 13)).doubts));
}

/// Three times the noise of the reading, 900 rows: a filter of the readings of the load would explain it.
#[test]
fn noise_of_the_load_cell_is_no_cause() {
    let truth = triangles(900);
    for seed in 1..4 {
        let mut random = Random::new(100 + seed);
        let noisy = |u: &f64| u + 3.0 * NOISE * random.normal();
        let load: Vec<f64> = truth.iter().map(noisy).collect();
        let found = judged(&file(&load, &truth, 0.05, seed));
        assert_eq!(found.verdict, Verdict::Sufficient, "seed {seed}");
    }
}

#[test]
fn a_zero_of_any_size_hides_no_gap() {
    let load = triangles(900);
    for zero in [0.1, 1.0, 10.0] {
        let read = with(&load, |_, u| zero + 0.03 * (u / 0.015).tanh());
        let found = judged(&file(&load, &read, 0.05, 7));
        let named = |effect: &str| found.causes.iter().any(|c| c.effect == effect);
        assert!(named("backlash") && named("sensor_offset"), "zero {zero}");
    }
}

/// Loads in equal steps put the readings on a lattice, and no converter does: each lies on it within the noise, which is far
/// less than rounding to it would be.
#[test]
fn equal_steps_of_load_are_no_coarse_converter() {
    let load = triangles(54);
    let found = judged(&file(&load, &load, 5.0, 11));
    assert_eq!(found.verdict, Verdict::Sufficient, "{:?}", found.causes);
}

/// What `stiffness` tells of a joint that bends so under three triangles of load.
fn told(bent: impl Fn(f64) -> f64) -> Vec<Identified> {
    let load = triangles(900);
    let deflection: Vec<f64> = load.iter().map(|u| bent(*u)).collect();
    let request = Request {
        model: Composite::named(DEFAULT_EFFECTS).unwrap(),
        bootstrap: 0,
        seed: 1,
    };
    identify(&file(&load, &deflection, 0.3, 3), &request).parameters
}

fn interval(told: &[Identified], name: &str) -> Option<[f64; 2]> {
    told.iter().find(|p| p.name == name).unwrap().ci95
}

/// A joint that stiffens by a cube of its deflection, by contacts that flatten, or whose second spring gives way up to a
/// load, has no gap; its stiffness is that of the spring. All three came back with one.
#[test]
fn what_stiffens_without_a_gap_is_told_without_one() {
    let cube = |u: f64| {
        let step = |x: f64| x - (x + 0.4 * x.powi(3) - u) / (1.0 + 1.2 * x * x);
        (0..60).fold(u, |x, _| step(x))
    };
    let contact = |u: f64| u + 0.3 * u.signum() * u.abs().powf(2.0 / 3.0);
    let second = |u: f64| u + 0.2 * (u / 0.3).tanh();
    let laws: [&dyn Fn(f64) -> f64; 3] = [&cube, &contact, &second];
    for (law, bent) in laws.iter().enumerate() {
        let told = told(bent);
        assert_eq!(interval(&told, "backlash"), None, "law {law}");
        let [low, high] = interval(&told, "stiffness").unwrap();
        assert!(
            low < STIFFNESS && STIFFNESS < high,
            "law {law}: {low:e} {high:e}"
        );
    }
}

/// A gap beside a joint that stiffens, and one alone, are told.
#[test]
fn a_gap_beside_a_curve_is_told() {
    let gap = |u: f64| 0.04 * (u / 0.004).tanh();
    let stiffened = |u: f64| {
        let step = |x: f64| x - (x + 0.4 * x.powi(3) - u) / (1.0 + 1.2 * x * x);
        (0..60).fold(u, |x, _| step(x)) + gap(u)
    };
    let straight = |u: f64| u + gap(u);
    let laws: [&dyn Fn(f64) -> f64; 2] = [&straight, &stiffened];
    let hidden = 0.08 * LARGEST / STIFFNESS;
    for (law, bent) in laws.iter().enumerate() {
        let [low, high] = interval(&told(bent), "backlash").unwrap();
        assert!(low < hidden && hidden < high, "law {law}: {low:e} {high:e}");
    }
}

/// A joint that ripples over its load, to a verb that knows no such law: the interval of the stiffness reaches as far as the
/// law is wrong, or none is told.
#[test]
fn a_law_that_does_not_fit_widens_what_it_tells() {
    let told = told(|u| u + 0.04 * (9.0 * u).sin());
    let wide = |[low, high]: [f64; 2]| (high - low) / (high + low) > 0.04;
    let stiffness = interval(&told, "stiffness");
    assert!(stiffness.is_none_or(wide), "{stiffness:?}");
}
