//! Coefficients from wave forms that another dynamometer recorded: intervals hold the truth, and what
//! cuts cannot tell is not told.

use crate::milling_bench::{Cutter, Pass, Recording, csv, record};
use ident::fit::cut_force::{Account, identify};
use ident::fit::parameter::Status;
use ident::ground::random::Random;
use ident::measurement::milling_force::MillingForce;
use ident::measurement::table::Table;

fn read(text: &str) -> MillingForce {
    let bytes = text.len() as u64;
    let table = Table::from_reader("cuts.csv".as_ref(), text.as_bytes(), bytes).unwrap();
    MillingForce::from_table(table).unwrap()
}

const MATERIALS: [[f64; 6]; 4] = [
    [1319.41, 788.83, 48.75, 19.65, 26.77, 2.05],
    [951.365, 262.597, 323.33, 11.115, 11.314, 1.105],
    [767.01, 168.8, 222.0, 27.7, 26.6, 0.7],
    [631.0, 99.0, 273.0, 13.0, 10.0, 2.8],
];

fn passes(random: &mut Random, diameter: f64) -> Vec<Pass> {
    let rpm = random.uniform(4000.0, 9000.0);
    let fz = |s: f64| (s * rpm * 100.0).round() / 100.0;
    let depth = random.uniform(1.0, 2.0);
    let pass = |feed: f64, depth: f64, width: f64, side: &'static str| Pass {
        rpm,
        feed: fz(feed),
        depth,
        width,
        side,
    };
    vec![
        pass(0.12, depth, diameter, "slot"),
        pass(0.24, depth, diameter, "slot"),
        pass(0.2, 1.5 * depth, 0.3 * diameter, "down"),
        pass(0.3, 1.5 * depth, 0.5 * diameter, "up"),
    ]
}

/// What is told of a record of these cuts.
fn told(
    (cutter, passes): (&Cutter, &[Pass]),
    truth: &[f64; 6],
    recording: &Recording,
    random: &mut Random,
) -> Account {
    let rows = record(cutter, passes, truth, recording, random);
    identify(&[read(&csv(cutter, passes, recording, &rows))])
}

struct Case {
    truth: [f64; 6],
    cutter: Cutter,
    account: Account,
}

fn case(seed: u64, recording: &Recording) -> Case {
    let mut random = Random::new(seed);
    let teeth = 2 + random.below(3);
    let cutter = Cutter {
        radius: 8e-3,
        teeth,
        helix: [0.0, 0.35, 0.5235987755982988, 0.7][random.below(4)],
        runout: random.uniform(3e-6, 12e-6),
        runout_angle: random.uniform(-3.0, 3.0),
        chip: 0.0,
    };
    let truth = MATERIALS[random.below(4)];
    let passes = passes(&mut random, 16.0);
    let account = told((&cutter, &passes), &truth, recording, &mut random);
    Case {
        truth,
        cutter,
        account,
    }
}

fn recording(bandwidth_hz: Option<f64>, noise: f64, colour: f64) -> Recording {
    Recording {
        rate_hz: 20_000.0,
        turns: 8.0,
        bandwidth_hz,
        noise,
        colour,
        clipped: true,
        ring: None,
    }
}

const RECORDS: u64 = 12;

/// Cases of several seeds, side by side.
fn together(seeds: std::ops::Range<u64>, recording: &Recording) -> Vec<Case> {
    std::thread::scope(|scope| {
        let spawn = |seed| scope.spawn(move || case(seed, recording));
        let running: Vec<_> = seeds.map(spawn).collect();
        running.into_iter().map(|t| t.join().unwrap()).collect()
    })
}

/// Intervals that hold the truth, intervals given, and the mean square of their errors in standard errors.
fn coverage(cases: &[Case]) -> (usize, usize, f64) {
    let (mut hit, mut given, mut square) = (0, 0, 0.0);
    for case in cases {
        for (found, truth) in case.account.parameters.iter().zip(case.truth) {
            let (Some([low, high]), Some(value), Some(s)) = (found.ci95, found.value, found.stderr)
            else {
                continue;
            };
            given += 1;
            hit += usize::from(low <= truth && truth <= high);
            square += ((value - truth) / s).powi(2);
        }
    }
    (hit, given, square / given.max(1) as f64)
}

/// How often intervals hold the truth, with a word on it.
fn held(name: &str, recording: &Recording) -> f64 {
    let cases = together(100..100 + RECORDS, recording);
    let (hit, given, square) = coverage(&cases);
    println!("{name}: {hit} of {given} intervals, mean square error {square:.2}");
    assert!(given >= 5 * cases.len());
    hit as f64 / given as f64
}

#[test]
fn intervals_hold_the_truth_under_white_noise() {
    let share = held("white, 1500 Hz", &recording(Some(1500.0), 4.0, 0.0));
    assert!(share > 0.91, "{share}");
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn intervals_hold_the_truth_under_coloured_noise() {
    let share = held("coloured, 800 Hz", &recording(Some(800.0), 4.0, 0.6));
    assert!(share > 0.91, "{share}");
}

#[test]
fn intervals_hold_the_truth_without_a_low_pass() {
    let share = held("ideal", &recording(None, 4.0, 0.0));
    assert!(share > 0.91, "{share}");
}

#[test]
fn a_border_cut_off_at_its_nominal_angle_is_met_by_the_width() {
    let nominal = Recording {
        clipped: false,
        ..recording(Some(1500.0), 4.0, 0.0)
    };
    let share = held("nominal border", &nominal);
    assert!(share > 0.88, "{share}");
}

#[test]
fn the_runout_is_found_but_for_the_name_of_the_first_tooth() {
    let cases = together(200..206, &recording(Some(1500.0), 2.0, 0.0));
    let many = cases.iter().filter(|c| c.cutter.teeth > 2);
    for case in many {
        let [runout, angle] = [6, 7].map(|i| case.account.parameters[i].value.unwrap());
        assert!(
            (runout * 1e-6 / case.cutter.runout - 1.0).abs() < 0.05,
            "{runout}"
        );
        let pitch = 360.0 / case.cutter.teeth as f64;
        let off = (angle - case.cutter.runout_angle.to_degrees()).rem_euclid(pitch);
        assert!(off.min(pitch - off) < 3.0, "{off} of {pitch}");
    }
}

/// Rows are left out until a low pass has settled; the angle that is told is that of the first one in the file all the same.
#[test]
fn the_angle_of_a_tooth_is_that_at_the_first_sample_of_the_file() {
    let mut random = Random::new(31);
    let cutter = Cutter {
        radius: 8e-3,
        teeth: 2,
        helix: 0.35,
        runout: 6e-6,
        runout_angle: 1.0,
        chip: 0.0,
    };
    let passes = passes(&mut random, 16.0);
    let recording = recording(Some(300.0), 2.0, 0.0);
    let mut same = random.clone();
    let account = told((&cutter, &passes), &MATERIALS[0], &recording, &mut random);
    assert!(account.cuts[0].data.settling > 0);
    let rate = passes[0].rpm / 60.0;
    let warm = (2.0 / rate * recording.rate_hz).floor() / recording.rate_hz;
    let begin = 360.0 * (same.uniform(0.0, 1.0) + rate * warm);
    let told = account.nuisance.iter().find(|p| p.name == "tooth_angle");
    let off = (told.unwrap().value.unwrap() - begin).rem_euclid(180.0);
    assert!(off.min(180.0 - off) < 1.0, "{off}");
}

/// The names of the teeth are chosen in every cut so that the runouts point one way: noise must not pass for one by that. At
/// three deviations, however many names there are, it did on these of the seeds 300 to 399.
#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn noise_alone_shows_no_runout() {
    let cutter = Cutter {
        radius: 6e-3,
        teeth: 4,
        helix: 0.5,
        runout: 0.0,
        runout_angle: 0.0,
        chip: 0.0,
    };
    let pass = |feed: f64, width: f64, side: &'static str| Pass {
        rpm: 3000.0,
        feed,
        depth: 2.0,
        width,
        side,
    };
    let passes = [
        pass(300.0, 12.0, "slot"),
        pass(600.0, 12.0, "slot"),
        pass(600.0, 3.0, "up"),
        pass(600.0, 3.0, "down"),
    ];
    let recording = Recording {
        rate_hz: 10_000.0,
        turns: 6.0,
        ..recording(None, 25.0, 0.0)
    };
    for seed in [319, 335, 336, 350, 368, 379, 383, 399] {
        let mut random = Random::new(seed);
        let account = told((&cutter, &passes), &MATERIALS[1], &recording, &mut random);
        let runout = &account.parameters[6];
        assert_eq!(runout.status, Status::AtBound, "{seed}: {runout:?}");
    }
}

#[test]
fn one_tooth_shows_no_runout() {
    let mut random = Random::new(5);
    let cutter = Cutter {
        radius: 5e-3,
        teeth: 1,
        helix: 0.5,
        runout: 8e-6,
        runout_angle: 1.0,
        chip: 0.0,
    };
    let passes = passes(&mut random, 10.0);
    let recording = recording(Some(2000.0), 1.0, 0.0);
    let account = told((&cutter, &passes), &MATERIALS[1], &recording, &mut random);
    assert_eq!(account.parameters[6].status, Status::NotIdentifiable);
    assert!(account.parameters[6].value.is_none() && account.parameters[7].value.is_none());
    assert!((account.parameters[0].value.unwrap() / 951.365 - 1.0).abs() < 0.02);
}
