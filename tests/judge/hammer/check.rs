//! The judge's own dynamics against the program's, and its records against its dynamics.

use super::bench::{Bench, less, seen};
use super::dynamics::{C, Pairs, World};
use super::records::{estimated, records};
use ident::ground::random::Random;

/// Compares transfer functions of the sound robot with those of `ident simulate frf`, and with those of noise-free
/// records.
pub fn checked(seed: u64) {
    let mut random = Random::new(seed ^ 0x4a3e_0000);
    let bench = Bench::draw(&mut random);
    let folder = tempfile::tempdir().unwrap();
    let robot = folder.path().join("robot.toml");
    std::fs::write(&robot, bench.told.document(None)).unwrap();
    let world = World::new(bench.told.clone(), bench.world.joints);
    let angles: Vec<String> = world
        .joints
        .iter()
        .map(|q| format!("{:.1}", q.to_degrees()))
        .collect();
    let run = std::process::Command::new(env!("CARGO_BIN_EXE_ident"))
        .args([
            "simulate",
            "frf",
            "--json",
            "--to-Hz",
            "50",
            "--step-Hz",
            "2.5",
        ])
        .arg("--robot")
        .arg(&robot)
        .arg(format!("--joints-deg={}", angles.join(",")))
        .current_dir(folder.path())
        .output()
        .unwrap();
    let told: serde_json::Value = serde_json::from_slice(&run.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&run.stderr)));
    let plant = world.plant();
    let mut worst = 0.0_f64;
    for (i, f) in told["frequency_Hz"].as_array().unwrap().iter().enumerate() {
        let own = world.transfer(&plant, f.as_f64().unwrap());
        for r in 0..3 {
            for d in 0..3 {
                let name = format!("{}{}", ["x", "y", "z"][r], ["x", "y", "z"][d]);
                let z = &told["accelerance"][&name][i];
                let theirs = C::new(z[0].as_f64().unwrap(), z[1].as_f64().unwrap());
                let size = own[r][r].norm().max(own[d][d].norm());
                worst = worst.max((theirs - own[r][d]).norm() / size.max(1e-12));
            }
        }
    }
    println!(
        "# {seed} {}: simulate frf differs by {worst:.1e}",
        bench.described()
    );
    assert!(worst < 1e-4, "{worst}");
    let plant = bench.world.plant();
    let all = records(&bench.world, &bench.habit);
    let mut off = 0.0_f64;
    for k in 2..25 {
        let f = 2.0 * k as f64;
        let own = bench.world.transfer(&plant, f);
        let (h, _) = estimated(&all, f, bench.habit.interval);
        for d in bench.habit.directions() {
            for r in 0..3 {
                let size = own[r][r].norm().max(own[d][d].norm());
                off = off.max((h[r][d] - own[r][d]).norm() / size);
            }
        }
    }
    let sight = bench.sight(&[], None, &all);
    let truth = bench.answers(&[], None, &sight);
    let found = seen(&all, &bench.habit, &sight);
    let change: Vec<Pairs> = found.iter().zip(&truth).map(less).collect();
    let left = sight.of(&change, &[], ("", None), false);
    println!(
        "# {seed}: records differ by {off:.1e}, {:.1} sd in all, {:.2} at worst",
        left.sight, left.strength
    );
    assert!(left.sight < 4.0, "{}", left.sight);
}
