//! Modes of simulated hammer tests against the modes they were made from.

use crate::common::{Blow, Mode, axis, record, robot};
use ident::experiments::hammer_frf::{Settings, estimate};
use ident::experiments::hammer_modes::modes;
use ident::ground::random::Random;
use ident::signal::modes::Mode as Found;

struct Score {
    lost: usize,
    spurious: usize,
    frequency: f64,
    damping: Vec<f64>,
    inside: usize,
    all: usize,
}

fn hammered(truth: &[Mode], blow: Blow, settings: &Settings, seed: u64) -> Vec<Found> {
    let mut random = Random::new(seed);
    let mut blows = Vec::new();
    for direction in ["x", "y", "z"] {
        for _ in 0..4 {
            let peak_n = blow.peak_n * random.uniform(0.7, 1.4);
            let width_s = blow.width_s * random.uniform(0.85, 1.2);
            blows.push((
                direction,
                Blow {
                    axis: axis(direction),
                    peak_n,
                    width_s,
                    ..blow
                },
            ));
        }
    }
    let mut record = record(truth, &blows, seed);
    if blow.window_rate > 0.0 {
        record.exponential_window_s = Some(1.0 / blow.window_rate);
    }
    let settings = Settings {
        modes: true,
        ..*settings
    };
    let frf = estimate(&record, &settings).unwrap();
    assert!(frf.screened.iter().all(|hit| hit.used()));
    modes(&frf, 50.0)
}

fn score(truth: &[Mode], found: &[Found]) -> Score {
    let mut score = Score {
        lost: 0,
        spurious: found.len(),
        frequency: 0.0,
        damping: vec![],
        inside: 0,
        all: 0,
    };
    for mode in truth.iter().filter(|mode| mode.hz < 45.0) {
        let off = |f: &&Found| (f.frequency_hz / mode.hz - 1.0).abs();
        let near = found.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        let Some(near) = near.filter(|f| off(f) < 0.03) else {
            score.lost += 1;
            continue;
        };
        score.spurious -= 1;
        score.frequency = score.frequency.max(off(&near));
        score
            .damping
            .push((near.damping_ratio / mode.damping - 1.0).abs());
        score.all += 2;
        score.inside += usize::from((near.frequency_hz - mode.hz).abs() <= near.half_width[0]);
        score.inside +=
            usize::from((near.damping_ratio - mode.damping).abs() <= near.half_width[1]);
    }
    score
}

/// How many structures per condition: 3, or as many as `IDENT_HAMMER_SEEDS` says.
fn seeds() -> u64 {
    let asked = std::env::var("IDENT_HAMMER_SEEDS").ok();
    asked.and_then(|n| n.parse().ok()).unwrap_or(3)
}

fn check(name: &str, blow: Blow, settings: Settings) {
    let (mut damping, mut inside, mut all, mut spurious) = (Vec::new(), 0, 0, 0);
    let mut frequency: f64 = 0.0;
    for seed in 1..=seeds() {
        let truth = varied(seed);
        let found = hammered(&truth, blow, &settings, seed);
        let score = score(&truth, &found);
        if score.lost > 0 {
            let list: Vec<_> = found
                .iter()
                .map(|f| (f.frequency_hz, f.damping_ratio))
                .collect();
            let wanted: Vec<_> = truth.iter().map(|f| (f.hz, f.damping)).collect();
            panic!(
                "{name}, seed {seed}: {} lost of {wanted:?}; found {list:?}",
                score.lost
            );
        }
        frequency = frequency.max(score.frequency);
        damping.extend(score.damping);
        inside += score.inside;
        all += score.all;
        spurious += score.spurious;
    }
    damping.sort_by(f64::total_cmp);
    let (median, worst) = (damping[damping.len() / 2], damping[damping.len() - 1]);
    println!(
        "{name}: frequency worst {:.4} %, damping median {:.3} % worst {:.3} %, inside 95 % {inside}/{all}, spurious {spurious}",
        100.0 * frequency,
        100.0 * median,
        100.0 * worst
    );
    assert!(
        inside as f64 >= 0.85 * all as f64,
        "{name}: intervals cover {inside} of {all}"
    );
    assert!(frequency < 0.005 && median < 0.03 && worst < 0.10, "{name}");
}

/// The robot with frequencies and dampings varied by seed.
fn varied(seed: u64) -> Vec<Mode> {
    let mut random = Random::new(100 + seed);
    let vary = |m: Mode| Mode {
        hz: m.hz * random.uniform(0.96, 1.04),
        damping: m.damping * random.uniform(0.7, 1.5),
        ..m
    };
    robot().into_iter().map(vary).collect()
}

#[test]
fn modes_without_window() {
    check("4 s", Blow::default(), Settings::default());
}

#[test]
fn modes_with_exponential_window() {
    let settings = Settings {
        exponential_end: Some(0.01),
        ..Settings::default()
    };
    check("4 s, exponential 1 %", Blow::default(), settings);
}

#[test]
fn modes_with_a_window_of_the_analyser() {
    let blow = Blow {
        window_rate: 1.5,
        ..Blow::default()
    };
    check("4 s, window in the record", blow, Settings::default());
}

#[test]
fn modes_of_short_records() {
    let blow = Blow {
        length_s: 1.5,
        rate_hz: 4096.0,
        ..Blow::default()
    };
    check("1.5 s", blow, Settings::default());
}

#[test]
fn modes_under_heavy_noise() {
    let blow = Blow {
        force_noise_n: 1.0,
        noise_m_s2: 0.05,
        ..Blow::default()
    };
    check("4 s, heavy noise", blow, Settings::default());
}

#[test]
fn close_modes_are_kept_apart() {
    let mut truth = varied(9);
    truth[1].hz = truth[0].hz * 1.04;
    let found = hammered(&truth, Blow::default(), &Settings::default(), 9);
    let score = score(&truth, &found);
    assert_eq!((score.lost, score.spurious), (0, 0));
    assert!(score.damping.iter().all(|d| *d < 0.1));
}

#[test]
fn one_direction_and_one_hit_give_modes_without_intervals() {
    let truth = varied(2);
    let blow = Blow {
        axis: [0.6, 0.64, 0.48],
        ..Blow::default()
    };
    let frf = estimate(&record(&truth, &[("x", blow)], 2), &Settings::default()).unwrap();
    let found = modes(&frf, 50.0);
    assert_eq!(score(&truth, &found).lost, 0);
    assert!(found.iter().all(|mode| mode.half_width[0].is_nan()));
}

/// Ten modes at random places, 1 to 5 % damped, with random shapes.
fn crowded(seed: u64) -> Vec<Mode> {
    let mut random = Random::new(500 + seed);
    let mut hz = 5.0;
    let mut modes: Vec<Mode> = Vec::new();
    for _ in 0..10 {
        hz *= random.uniform(1.06, 1.4);
        let shape: [f64; 3] = std::array::from_fn(|_| random.normal());
        // What hardly moves the tool cannot be seen there.
        let size = random.uniform(0.04, 0.1) / shape.iter().map(|v| v * v).sum::<f64>().sqrt();
        let shape = shape.map(|v| v * size);
        modes.push(Mode {
            hz,
            damping: random.uniform(0.01, 0.05),
            shape,
        });
    }
    modes.extend(robot().into_iter().filter(|mode| mode.hz > 60.0));
    modes
}

#[test]
fn crowded_structures_keep_their_modes() {
    let (mut lost, mut all, mut spurious, mut damping) = (0, 0, 0, Vec::new());
    let mut frequency: f64 = 0.0;
    for seed in 1..=6 {
        let truth = crowded(seed);
        let found = hammered(&truth, Blow::default(), &Settings::default(), seed);
        let score = score(&truth, &found);
        if score.lost > 0 {
            let list: Vec<_> = found
                .iter()
                .map(|f| (f.frequency_hz, f.damping_ratio))
                .collect();
            println!(
                "seed {seed} lost {} truth {truth:?} found {list:?}",
                score.lost
            );
        }
        lost += score.lost;
        all += score.damping.len() + score.lost;
        spurious += score.spurious;
        frequency = frequency.max(score.frequency);
        damping.extend(score.damping);
    }
    damping.sort_by(f64::total_cmp);
    let worst = damping[damping.len() - 1];
    println!(
        "crowded: lost {lost} of {all}, spurious {spurious}, frequency {:.4} %, damping median {:.3} % worst {:.3} %",
        100.0 * frequency,
        100.0 * damping[damping.len() / 2],
        100.0 * worst
    );
    assert!(lost == 0 && frequency < 0.005 && worst < 0.1);
}
