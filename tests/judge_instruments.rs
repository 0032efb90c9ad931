//! Diagnosis and identification of screws, force sensors, cutting forces and cubes before data by a judge of its own
//! (`tests/judge`).
//!
//! `IDENT_BLIND_SEED` and `IDENT_JUDGE_CASES` choose other cases, `IDENT_DEBUG=1` prints the misses (2: everything),
//! `IDENT_JUDGE_KEEP` names a folder for the files. `cargo test --test suite judge_instruments:: -- --nocapture` prints the rates.

use crate::common::{few_or_all, is_thorough};
use crate::judge;

use crate::judge::intervals::{Known, held};
use crate::judge::{Floors, conclude, judged};
use ident::ground::random::Random;

/// Seeds 101 to 110, 400 cases: clean 91 of 91, single 133 of 139, pair 94 of 108, outside 59 of 59, untrue names in 10 of 338.
/// Seed 121, 100 cases, as a cause is weighed where it acts: 24 of 24, 35 of 37, 27 of 29, 10 of 10, none of 90.
#[test]
fn screws_by_strangers_are_judged_rightly() {
    let rates = conclude("screw", &judged(judge::screw::draw, few_or_all(12, 24)));
    let floors = Floors {
        clean: 0.8,
        single: 0.6,
        pair: 0.4,
        outside: 0.1,
        wrong: 0.1,
    };
    floors.hold(&rates);
}

/// Seeds 101 to 105, 150 cases: clean 26 of 26, single 78 of 80, pair 26 of 31, outside 10 of 11, untrue names in 2 of 137.
/// Seed 121, 100 cases, as a cause is weighed where it acts: 16 of 16, 58 of 60, 11 of 16, 5 of 5, 2 of 92.
#[test]
fn force_sensors_by_strangers_are_judged_rightly() {
    let rates = conclude(
        "force-sensor",
        &judged(judge::force_sensor::draw, few_or_all(6, 18)),
    );
    let floors = Floors {
        clean: 0.5,
        single: 0.6,
        pair: 0.0,
        outside: 0.0,
        wrong: 0.2,
    };
    floors.hold(&rates);
}

/// Seeds 411 to 416, 120 cases (misses of 411 to 413 were seen meanwhile, nothing was set on them), before all that is uncertain rang with the sensor, a stated
/// runout was turned where it fits, what was found was kept as it was found and laws had errors of their own, and after:
/// clean 23 / 23 of 23, single 60 / 61 of 63, pair 16 / 20 of 31, outside 2 / 2 of 3, untrue names in 8 / 5 of 117. On
/// seeds 401 to 405, which set the errors: pair 16 / 24 of 30. Seeds 417 to 420, at which nobody had looked, after: 13 of 14,
/// 37 of 39, 12 of 19, 6 of 8, 4 of 72. Seeds 433 to 436, 160 cases, before hums, speeds, offsets and drifts were mended on them, and
/// after: clean 33 / 34 of 35, single 71 / 71 of 74, pair 24 / 25 of 32, outside 14 / 18 of 18, untrue names in 12 / 5 of 160.
/// Seeds 451 to 453, 150 cases, on which one drift was mended: 39 / 39 of 40, 55 / 57 of 63, 19 / 19 of 28, 12 / 16 of 18,
/// 15 / 9 of 150. Seeds 461 to 464, at which nobody had looked, after: 33 of 35, 70 of 76, 25 of 29, 19 of 20, 9 of 160.
/// Seeds 471 to 474, at which nobody had looked, once coefficients followed and companions had to be needed (mended on 461 to 464):
/// 37 of 37, 72 of 80, 20 of 27, 15 of 15, 6 of 160.
/// Noise of half a milliradian in the angle of the teeth was tried on the last two: 8 of 160 and 11 of 150, so it was left out.
/// Seeds 505 to 508, of which only counts were seen, before noise had a colour, depths a doubt and companions were outweighed (mended on
/// 501 to 504), and after: clean 31 / 31 of 31, single 75 / 74 of 79, pair 27 / 26 of 36, outside 13 / 13 of 14, untrue names in 9 / 4 of
/// 160.
#[test]
fn cutting_forces_by_strangers_are_judged_rightly() {
    let rates = conclude(
        "milling-force",
        &judged(judge::milling_force::draw, few_or_all(1, 4)),
    );
    let floors = Floors {
        clean: 0.5,
        single: 0.6,
        pair: 0.5,
        outside: 0.0,
        wrong: 0.3,
    };
    floors.hold(&rates);
}

/// The first of several cases that one mistake spoilt; all of them where more is asked for.
fn some<T, const N: usize>(cases: [T; N]) -> impl Iterator<Item = T> {
    let more = is_thorough() || std::env::var_os("IDENT_JUDGE_CASES").is_some();
    cases.into_iter().take(if more { N } else { 1 })
}

fn names(seed: u64) -> Vec<String> {
    let found = judge::answer(judge::milling_force::draw(seed));
    found.causes.into_iter().map(|c| c.0).collect()
}

/// A channel that hums in every cut is no chatter, though chatter in every cut is the next best story: it was named in
/// both, and in two more like them.
#[test]
fn a_hum_is_no_chatter() {
    for seed in some([43_400_021, 43_500_008]) {
        assert_eq!(names(seed), Vec::<String>::new(), "{seed}");
    }
}

/// What the straight line of a cause misses on its way is no second cause: a runout was named beside worn edges, a width
/// and another channel's gain in the place of one gain.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_bend_is_no_companion() {
    for (seed, name) in some([
        (46_400_025, "edge_coefficients"),
        (46_400_024, "force_gain"),
    ]) {
        assert_eq!(names(seed), [name], "{seed}");
    }
}

/// A depth stood beside what rings and a width: it fitted only where all that is uncertain moved against it, and tripled the error of the
/// simulation as it is used. A drift does that as well where it is all that is wrong, and unseen rows tell of it.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_companion_that_makes_the_simulation_worse_is_none() {
    for (seed, expected) in some([
        (50_100_009, vec!["sensor_resonance", "width_of_cut"]),
        (50_300_018, vec!["thermal_drift"]),
    ]) {
        let mut all = names(seed);
        all.sort();
        assert_eq!(all, expected, "{seed}");
    }
}

/// A speed that is accounted for turns no tooth: the angles were sought again as if it were not, and a depth was named in the
/// one, a drift in the other.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn an_offset_beside_a_wrong_speed_is_found() {
    for seed in some([43_300_012, 43_400_012]) {
        let mut all = names(seed);
        all.sort();
        assert_eq!(all, ["sensor_offset", "spindle_speed"], "{seed}");
    }
}

/// Seeds 113 and 114, 240 cases, which chose the share below which a cause is none: clean 52 of 52, single 111 of 116, pair
/// 46 of 48, outside 15 of 16, untrue names in none of 216. Seeds 115 and 116, at which nobody had looked, before a cube of the
/// foundation moved with it, that share was a tenth of the others' and what is probable is kept, and after: 61 / 61 of 61,
/// 97 / 99 of 101, 31 / 40 of 44, 28 / 28 of 28, 3 / 1 of 206.
#[test]
fn cubes_by_strangers_are_judged_rightly() {
    let rates = conclude("cubes", &judged(judge::cubes::draw, few_or_all(8, 16)));
    let floors = Floors {
        clean: 0.4,
        single: 0.4,
        pair: 0.15,
        outside: 0.0,
        wrong: 0.2,
    };
    floors.hold(&rates);
}

/// The file as if the cube of the foundation stood still: its readings are noise of 1 um and 6 urad.
fn on_the_floor(text: &str, random: &mut Random) -> String {
    let mut still = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        if cells.get(7) != Some(&"foot") {
            return line.to_string();
        }
        let noise = |(k, cell): (usize, &&str)| match cell.is_empty() {
            true => String::new(),
            false => format!("{:.6}", if k < 3 { 0.001 } else { 0.006 } * random.normal()),
        };
        let own: Vec<String> = cells[8..].iter().enumerate().map(noise).collect();
        format!("{},{}", cells[..8].join(","), own.join(","))
    };
    let lines: Vec<String> = text.lines().map(&mut still).collect();
    lines.join("\n") + "\n"
}

/// A cube of the foundation may sit on the foot, which a soft foundation lets move, or on the floor beside it: it is loose in
/// neither case.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_cube_on_the_floor_is_not_loose() {
    let is_soft =
        |case: &judge::Case| matches!(&case.truths[..], [t] if t.effect == "base_compliance");
    let cases = (200_000..).map(judge::cubes::draw).filter(is_soft).take(3);
    for mut case in cases {
        case.files[0].1 = on_the_floor(&case.files[0].1, &mut Random::new(case.seed));
        let found = judge::answer(case);
        let named: Vec<&str> = found.causes.iter().map(|c| c.0.as_str()).collect();
        assert_eq!(
            named,
            ["base_compliance"],
            "{} {:?}",
            found.case.seed,
            found.groups
        );
    }
}

type Files = Vec<(String, String)>;

fn named(truth: Vec<(&'static str, f64)>) -> Vec<Known> {
    let one = |(name, value): (&str, f64)| (name.to_string(), None, value);
    truth.into_iter().map(one).collect()
}

fn sensor(seed: u64) -> (Files, Vec<Known>) {
    let (text, truth) = judge::force_sensor::known(seed);
    (vec![("weights.csv".into(), text)], named(truth))
}

fn force(seed: u64) -> (Files, Vec<Known>) {
    let (text, truth) = judge::milling_force::known(seed);
    (vec![("cuts.csv".into(), text)], named(truth))
}

fn cubes(seed: u64) -> (Files, Vec<Known>) {
    let (case, truth) = judge::cubes::known(seed);
    let stiffness = |(site, value)| ("stiffness".to_string(), Some(site), value);
    (case.files, truth.into_iter().map(stiffness).collect())
}

/// Intervals of 95 % should hold 92 to 98; the floor leaves what chance takes from a sample of this size.
fn at_least(share: f64, (held, all): (usize, usize)) {
    assert!(held as f64 >= share * all as f64, "{held} of {all}");
}

/// 30 files: 423 of 450.
#[test]
fn intervals_of_sensors_hold_the_truth() {
    at_least(0.9, held("sensor", sensor, 20).conclude("sensor"));
}

/// 88 files that were not looked at while the fit was mended (seeds 1, 3, 5): 557 of 603, runout 70 of 75; 40 files that
/// it was mended on (seed 7): 245 of 274, runout 28 of 34.
#[test]
fn intervals_of_cutting_forces_hold_the_truth() {
    at_least(0.75, held("force", force, 4).conclude("force"));
}

/// 13 files that were read: 150 of 158.
#[test]
fn intervals_of_cubes_hold_the_truth() {
    at_least(0.88, held("stiffness", cubes, 20).conclude("stiffness"));
}
