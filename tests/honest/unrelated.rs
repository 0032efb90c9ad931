//! Records whose displacement has nothing to do with the force.

use crate::common::few_or_all;
use ident::effects::Composite;
use ident::findings::Verdict;
use ident::findings::load_cycle::{Settings, diagnose};
use ident::fit::parameter::Status;
use ident::fit::stiffness::{DEFAULT_EFFECTS, Request, identify};
use ident::ground::random::Random;
use ident::measurement::load_cycle::LoadCycle;
use ident::measurement::table::Table;
use rayon::prelude::*;
use std::path::Path;

const KINDS: [&str; 5] = ["white", "walk", "sine", "first order", "pink"];
const ROWS: usize = 600;
const PERIOD: usize = 200;

/// How many records; more by `IDENT_UNRELATED`.
fn count() -> u64 {
    let asked = std::env::var("IDENT_UNRELATED").ok();
    asked
        .and_then(|n| n.parse().ok())
        .unwrap_or_else(|| few_or_all(6, 40))
}

fn displacement(kind: usize, random: &mut Random) -> Vec<f64> {
    let (memory, speed, phase) = (
        0.8 + 0.19 * random.unit(),
        0.1 + 9.9 * random.unit(),
        std::f64::consts::TAU * random.unit(),
    );
    let poles = [0.9_f64, 0.97, 0.99, 0.997, 0.999];
    let (mut at, mut slow) = (0.0, [0.0; 5]);
    let mut next = |i: usize| {
        let noise = random.normal();
        at = match kind {
            0 => noise,
            1 => at + noise,
            2 => {
                (std::f64::consts::TAU * speed * i as f64 / PERIOD as f64 + phase).sin()
                    + 0.02 * noise
            }
            3 => memory * at + noise,
            _ => {
                for (s, p) in slow.iter_mut().zip(poles) {
                    *s = p * *s + (1.0 - p * p).sqrt() * random.normal();
                }
                slow.iter().sum::<f64>()
            }
        };
        at
    };
    let all: Vec<f64> = (0..ROWS).map(&mut next).collect();
    let size = all.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    all.iter().map(|v| 0.5 * v / size).collect()
}

fn record(seed: u64) -> LoadCycle {
    let mut random = Random::new(seed);
    let moved = displacement((seed % 5) as usize, &mut random);
    let triangle = random.unit() < 0.5;
    let mut text = "# kind = \"load-cycle\"\n# joint = 6\n# axis = \"rotation\"\n# load_lever_m = 0.5\n# sensor_lever_m = 0.4\n".to_string();
    if seed % 2 == 1 {
        text += "# nominal_stiffness_Nm_rad = 300000.0\n";
    }
    text += "time_s,force_N,displacement_mm\n";
    for (i, d) in moved.iter().enumerate() {
        let phase = i as f64 / PERIOD as f64;
        let force = match triangle {
            true => 1.0 - 4.0 * ((phase + 0.25).fract() - 0.5).abs(),
            false => (std::f64::consts::TAU * phase).sin(),
        };
        let force = 1000.0 * force + 0.1 * random.normal();
        text += &format!("{:.2},{force:.3},{d:.5}\n", 0.05 * i as f64);
    }
    let table = Table::from_reader(Path::new("u.csv"), text.as_bytes(), text.len() as u64);
    LoadCycle::from_table(table.unwrap()).unwrap()
}

#[test]
fn unrelated_records_give_neither_a_stiffness_nor_a_cause() {
    let model = || Composite::named(DEFAULT_EFFECTS).unwrap();
    let told = |seed: &u64| {
        let file = record(*seed);
        let request = Request {
            model: model(),
            bootstrap: 0,
            seed: 1,
        };
        let fitted = identify(&file, &request).parameters[0].status == Status::Identified;
        let found = diagnose(&file, &Settings::default());
        let named = !found.causes.is_empty()
            || matches!(found.verdict, Verdict::Explained | Verdict::Sufficient);
        let told = fitted || named;
        if told {
            println!(
                "seed {seed} ({}): identified {fitted}, named {named}",
                KINDS[(*seed % 5) as usize]
            );
        }
        told
    };
    let n = count();
    let false_ones = (0..n).into_par_iter().filter(told).count();
    println!("{false_ones} of {n} unrelated records were taken for a response");
    assert!(false_ones as f64 <= 0.01 * n as f64);
}
