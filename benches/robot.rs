//! Speed of the robot's inner loops: `cargo bench --bench robot`.
//! Peer: Pinocchio 4.1.0 C++ needs 1.15 µs (6) and 4.26 µs (18) for CRBA + Cholesky, 1.78 and 4.92 for ABA.

use criterion::{Criterion, criterion_group, criterion_main};
use ident::motion::frf::{C64, FrfWork, accelerance, lines};
use ident::motion::modes::modal;
use ident::motion::{self, Chain, Work, linearise};
use ident::robot::builtin;
use std::f64::consts::TAU;
use std::hint::black_box;

const POSE: [f64; 6] = [0.3, -1.3, 1.6, 0.4, 0.7, -0.2];

fn robot() -> ident::robot::Robot {
    match builtin::named("kr210") {
        Some(Ok(robot)) => robot,
        _ => ident::robot::Robot::default(),
    }
}

/// Angles, speeds and torques that are nowhere zero: no short cut helps.
fn state(chain: &Chain) -> [Vec<f64>; 3] {
    let n = chain.len();
    let series = |a: f64, b: f64| (0..n).map(|i| a + b * i as f64).collect();
    [series(0.3, -0.11), series(0.2, 0.05), series(300.0, -20.0)]
}

fn dynamics(c: &mut Criterion) {
    for (label, chain) in [
        ("6", motion::rigid(&robot())),
        ("18", motion::elastic(&robot())),
    ] {
        let mut work = Work::new(&chain);
        let [q, v, tau] = state(&chain);
        c.bench_function(&format!("forward dynamics (ABA), {label} hinges"), |b| {
            b.iter(|| {
                motion::aba(
                    &chain,
                    &mut work,
                    black_box(&q),
                    black_box(&v),
                    black_box(&tau),
                )[0]
            });
        });
        c.bench_function(&format!("inverse dynamics (RNEA), {label} hinges"), |b| {
            b.iter(|| {
                motion::rnea(
                    &chain,
                    &mut work,
                    black_box(&q),
                    black_box(&v),
                    black_box(&tau),
                )[0]
            });
        });
        c.bench_function(&format!("mass matrix (CRBA), {label} hinges"), |b| {
            b.iter(|| motion::crba(&chain, &mut work, black_box(&q))[0]);
        });
        c.bench_function(&format!("tool pose, {label} hinges"), |b| {
            b.iter(|| motion::forward_kinematics(&chain, &mut work, black_box(&q)).point);
        });
    }
}

fn compliance(c: &mut Criterion) {
    let chain = motion::elastic(&robot());
    let mut work = Work::new(&chain);
    let q = chain.spread(&POSE);
    c.bench_function("compliance matrix 3x3, 18 hinges, pose included", |b| {
        b.iter(|| motion::statics::deflect(&chain, &mut work, black_box(&q), [1.0, 2.0, 3.0]));
    });
}

fn frf(c: &mut Criterion) {
    let mut coupled = robot();
    for (i, joint) in coupled.joints.iter_mut().enumerate() {
        joint
            .drive
            .iter_mut()
            .for_each(|drive| drive.damping *= 1.0 + 0.7 * i as f64);
    }
    let s: Vec<C64> = lines(50.0, 0.25)
        .iter()
        .map(|f| C64::new(0.0, TAU * f))
        .collect();
    for (label, robot) in [
        ("damping as built in", robot()),
        ("strongly coupled damping", coupled),
    ] {
        let chain = motion::elastic(&robot);
        let (mut work, mut space) = (Work::new(&chain), FrfWork::default());
        let q = chain.spread(&POSE);
        c.bench_function(
            &format!("FRF 200 lines x 9, 18 hinges, linearisation and modes included, {label}"),
            |b| {
                b.iter(|| {
                    let modal = linearise(&chain, &mut work, black_box(&q))
                        .and_then(|linear| modal(&linear));
                    modal.map(|modal| accelerance(&modal, &mut space, &s)).ok()
                });
            },
        );
    }
}

criterion_group!(benches, dynamics, compliance, frf);
criterion_main!(benches);
