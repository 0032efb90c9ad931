//! ident's side of `beside_plan.py`: `cargo bench --bench beside_plan -- time-law|inverse CASES PASSES`.
//!
//! CASES is text, one case per line. `time-law`: length (m), speed (m/s), acceleration (m/s²), jerk (m/s³);
//! the answer is the duration (s) from rest to rest. `inverse`: six joint angles (rad) of the built-in
//! kr210; the answer is every posture that reaches the same pose. PASSES rounds are timed, the fastest counts.

use ident::ground::spatial::Pose;
use ident::motion::inverse::SphericalWrist;
use ident::motion::{Work, build, forward_kinematics};
use ident::path::double_s::Limits;
use ident::path::profile::{Step, profile};
use ident::robot::load::load;
use serde_json::{Value, json};
use std::hint::black_box;
use std::time::Instant;

fn main() {
    // `--bench` comes from cargo
    let typed: Vec<String> = std::env::args()
        .skip(1)
        .filter(|argument| argument != "--bench")
        .collect();
    let [work, cases, passes] = typed.as_slice() else {
        println!("usage: beside_plan time-law|inverse CASES PASSES (see benches/peers/README.md)");
        return;
    };
    let text = std::fs::read_to_string(cases).unwrap();
    let passes = passes.parse().unwrap();
    let answer = match work.as_str() {
        "time-law" => time_law(&rows(&text), passes),
        _ => inverse(&rows(&text), passes),
    };
    println!("{answer}");
}

fn rows<const N: usize>(text: &str) -> Vec<[f64; N]> {
    let numbers = |line: &str| {
        let numbers: Vec<f64> = line
            .split_whitespace()
            .map(|w| w.parse().unwrap())
            .collect();
        numbers.try_into().unwrap()
    };
    text.lines().map(numbers).collect()
}

fn duration(&[length, speed, acceleration, jerk]: &[f64; 4]) -> f64 {
    let step = Step {
        begin: 0.0,
        end: length,
        speed,
    };
    let phases = profile(&[step], &Limits { acceleration, jerk }, 0.0);
    phases.last().map_or(0.0, |last| last.begin + last.duration)
}

fn time_law(cases: &[[f64; 4]], passes: usize) -> Value {
    let durations: Vec<f64> = cases.iter().map(duration).collect();
    json!({ "answers": durations, "us": fastest(cases, passes, |case| { black_box(duration(case)); }) })
}

fn inverse(cases: &[[f64; 6]], passes: usize) -> Value {
    let robot = load("kr210", None).unwrap().robot;
    let chain = build::rigid(&robot);
    let limits: Vec<[f64; 2]> = robot.joints.iter().map(|joint| joint.limits).collect();
    let wrist = SphericalWrist::of(&chain, &limits).unwrap();
    let mut work = Work::new(&chain);
    let poses: Vec<(Pose, [f64; 6])> = cases
        .iter()
        .map(|q| (forward_kinematics(&chain, &mut work, q), *q))
        .collect();
    let all = |(pose, q): &(Pose, [f64; 6])| -> Vec<[f64; 6]> {
        let postures = wrist.solve(pose, q);
        postures
            .as_slice()
            .iter()
            .map(|posture| posture.q)
            .collect()
    };
    let answers: Vec<Vec<[f64; 6]>> = poses.iter().map(all).collect();
    let us = fastest(&poses, passes, |(pose, q)| {
        black_box(wrist.solve(black_box(pose), q));
    });
    json!({ "answers": answers, "us": us })
}

/// Microseconds per case, in the fastest of `passes` rounds over all of them.
fn fastest<T>(cases: &[T], passes: usize, mut call: impl FnMut(&T)) -> f64 {
    let mut round = || {
        let start = Instant::now();
        cases.iter().for_each(|case| call(black_box(case)));
        start.elapsed().as_secs_f64() * 1e6 / cases.len() as f64
    };
    (0..passes).map(|_| round()).fold(f64::INFINITY, f64::min)
}
