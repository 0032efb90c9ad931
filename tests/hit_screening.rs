//! Bad hits are found, good ones kept: simulated hits with known truth.

use crate::common::{Blow, axis, record, robot};
use ident::experiments::hammer_frf::{Settings, estimate};
use ident::experiments::hammer_screen::{ScreenedHit, screen};
use ident::signal::fault::Fault;

const RATES: [f64; 5] = [1000.0, 2048.0, 5120.0, 12_800.0, 25_600.0];
const WIDTHS: [f64; 6] = [0.3e-3, 1e-3, 2e-3, 3e-3, 5e-3, 8e-3];

fn screened(blows: &[Blow], seed: u64) -> Vec<ScreenedHit> {
    let named: Vec<_> = blows.iter().map(|blow| ("x", *blow)).collect();
    screen(&record(&robot(), &named, seed), 50.0)
}

/// Short records are enough to judge a pulse.
fn blow(rate_hz: f64, width_s: f64) -> Blow {
    Blow {
        rate_hz,
        width_s,
        length_s: 1.0,
        ..Blow::default()
    }
}

fn each_condition(mut check: impl FnMut(f64, f64, u64)) {
    let mut seed = 1;
    for rate in RATES {
        for width in WIDTHS {
            check(rate, width, seed);
            seed += 1;
        }
    }
}

#[test]
fn no_good_hit_is_rejected() {
    each_condition(|rate, width, seed| {
        for quantum in [0.0, 1e-4, 1e-3, 1e-2] {
            for noise in [0.0, 0.05, 0.5] {
                let good = Blow {
                    quantum,
                    force_noise_n: noise,
                    noise_m_s2: 0.02 * noise,
                    ..blow(rate, width)
                };
                for hit in screened(&[good], seed) {
                    assert!(
                        hit.used(),
                        "{rate} Hz, {width} s, quantum {quantum}, noise {noise}: {:?}",
                        hit.faults
                    );
                }
            }
        }
    });
}

#[test]
fn double_hits_are_found() {
    let (mut found, mut all) = (0, 0);
    let mut missed = Vec::new();
    each_condition(|rate, width, seed| {
        for delay in [0.010, 0.015, 0.03, 0.06, 0.12] {
            for share in [0.05, 0.1, 0.3, 1.0] {
                let double = Blow {
                    second: Some((delay, share)),
                    ..blow(rate, width)
                };
                let hit = &screened(&[double], seed)[0];
                let seen = hit
                    .faults
                    .iter()
                    .any(|f| matches!(f, Fault::DoubleHit { .. }));
                found += usize::from(seen);
                all += 1;
                if !seen {
                    missed.push((rate, width, delay, share));
                }
            }
        }
    });
    println!("double hits found: {found} of {all}; missed (Hz, s, s, share): {missed:?}");
    // Two pulses of 8 ms with 2 ms between them are two samples apart at 1 kHz.
    assert!(found as f64 >= 0.99 * all as f64);
}

#[test]
fn overloads_are_found_on_either_side() {
    let (mut found, mut all) = (0, 0);
    each_condition(|rate, width, seed| {
        // A plateau needs three samples to be one.
        if rate * width < 10.0 {
            return;
        }
        for quantum in [0.0, 1e-4, 1e-3] {
            let base = Blow {
                quantum,
                ..blow(rate, width)
            };
            let force = Blow {
                clip_force: Some(0.8),
                ..base
            };
            let both = Blow {
                clip_response: Some((0.6, true)),
                ..base
            };
            let one = Blow {
                clip_response: Some((0.6, false)),
                ..base
            };
            for (blow, on_force) in [(force, true), (both, false), (one, false)] {
                let hit = &screened(&[blow], seed)[0];
                let seen = hit.faults.iter().any(|f| match f {
                    Fault::ForceOverload { .. } => on_force,
                    Fault::ResponseOverload { .. } => !on_force,
                    _ => false,
                });
                found += usize::from(seen);
                all += 1;
                if !seen {
                    println!("missed: {rate} Hz {width} s quantum {quantum} force {on_force}");
                }
            }
        }
    });
    println!("overloads found: {found} of {all}");
    assert!(found as f64 >= 0.97 * all as f64);
}

#[test]
fn too_soft_and_buried_hits_are_rejected() {
    let soft = Blow {
        width_s: 0.035,
        ..Blow::default()
    };
    let weak = Blow {
        peak_n: 10.0,
        force_noise_n: 1.0,
        width_s: 1e-3,
        ..Blow::default()
    };
    let why = |blow| screened(&[blow], 5)[0].faults.clone();
    assert!(
        matches!(why(soft)[..], [Fault::LowEnergy { .. }]),
        "{:?}",
        why(soft)
    );
    assert!(!why(weak).is_empty());
}

#[test]
fn strangers_in_the_family_are_rejected() {
    let good = Blow::default();
    let hard = Blow {
        peak_n: 5000.0,
        ..good
    };
    let short = Blow {
        length_s: 1.5,
        ..good
    };
    let hits = screened(&[good, hard, good, short, good], 3);
    let used: Vec<bool> = hits.iter().map(ScreenedHit::used).collect();
    assert_eq!(used, [true, false, true, false, true]);
    assert!(matches!(hits[1].faults[..], [Fault::Level { .. }]));
    assert!(matches!(hits[3].faults[..], [Fault::ShortRecord { .. }]));
}

#[test]
fn off_axis_hits_are_rejected() {
    let mut blows = Vec::new();
    for direction in ["x", "y", "z"] {
        blows.extend(
            [(
                direction,
                Blow {
                    axis: axis(direction),
                    ..Blow::default()
                },
            ); 3],
        );
    }
    let angle = 25f64.to_radians();
    blows[1].1.axis = [angle.cos(), angle.sin(), 0.0];
    let hits = screen(&record(&robot(), &blows, 9), 50.0);
    for (i, hit) in hits.iter().enumerate() {
        assert_eq!(hit.used(), i != 1, "hit {}: {:?}", i + 1, hit.faults);
    }
    let Fault::OffAxis { angle: found } = hits[1].faults[0] else {
        panic!("{:?}", hits[1].faults);
    };
    assert!((found - angle).abs() < 0.05);
}

#[test]
fn hits_are_found_in_one_long_record() {
    let mut long = record(&robot(), &[("x", Blow::default()); 3], 4);
    let mut joined = long.runs[0].clone();
    for run in &long.runs[1..] {
        joined.force.extend(&run.force);
        for (all, part) in joined.responses.iter_mut().zip(&run.responses) {
            all.extend(part);
        }
    }
    joined.hit = None;
    long.runs = vec![joined];
    let hits = screen(&long, 50.0);
    assert_eq!(hits.len(), 3);
    assert!(hits.iter().all(ScreenedHit::used));
}

fn remarks(spoil: impl Fn(&mut ident::measurement::hammer::HammerRecord)) -> Vec<String> {
    let mut blows = Vec::new();
    for direction in ["x", "y", "z"] {
        let blow = Blow {
            axis: axis(direction),
            ..Blow::default()
        };
        blows.extend((0..4).map(|i| {
            (
                direction,
                Blow {
                    peak_n: 300.0 + 120.0 * f64::from(i),
                    ..blow
                },
            )
        }));
    }
    let mut record = record(&robot(), &blows, 21);
    spoil(&mut record);
    estimate(&record, &Settings::default()).unwrap().remarks
}

#[test]
fn a_sound_test_has_no_remarks() {
    assert!(remarks(|_| ()).is_empty(), "{:?}", remarks(|_| ()));
}

#[test]
fn a_sensor_upside_down_is_named() {
    let found = remarks(|record| {
        for run in &mut record.runs {
            run.responses[2].iter_mut().for_each(|v| *v = -*v);
        }
    });
    assert!(
        found
            .iter()
            .any(|r| r.starts_with("az:") && r.contains("upside down")),
        "{found:?}"
    );
}

#[test]
fn a_channel_of_zeros_is_named() {
    let found = remarks(|record| {
        for run in &mut record.runs {
            run.responses[1].fill(0.0);
        }
    });
    let named = |r: &String| r.starts_with("ay:") && r.contains("nothing but zeros");
    assert!(found.iter().any(named), "{found:?}");
}

#[test]
fn a_response_that_grows_less_than_the_force_is_named() {
    let found = remarks(|record| {
        for run in record.runs.iter_mut().filter(|run| run.direction == "y") {
            let peak = run.force.iter().copied().fold(0.0, f64::max);
            let gain = (300.0 / peak).powf(0.3);
            run.responses.iter_mut().flatten().for_each(|v| *v *= gain);
        }
    });
    assert!(
        found
            .iter()
            .any(|r| r.contains("direction y") && r.contains("not linear")),
        "{found:?}"
    );
}
