//! What instruments do to a signal: an anti-alias filter, an accelerometer that swings on its mount.

use super::robot::V3;

/// Half length of the anti-alias filter, samples.
const REACH: usize = 12;

/// Windowed sinc that passes 0.4 of the sampling rate, delayed by `late` samples.
pub fn filter(every: usize, late: f64) -> Vec<f64> {
    use std::f64::consts::{PI, TAU};
    let half = (REACH * every) as f64;
    let weight = |k: usize| {
        let x = (k as f64 - half) / every as f64 + late;
        let across = (x / (REACH as f64 + 1.0)).clamp(-1.0, 1.0);
        let bell = 0.42 + 0.5 * (PI * across).cos() + 0.08 * (TAU * across).cos();
        let phase = 0.8 * PI * x;
        bell * if phase.abs() < 1e-9 {
            1.0
        } else {
            phase.sin() / phase
        }
    };
    let weights: Vec<f64> = (0..=2 * REACH * every).map(weight).collect();
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|w| w / sum).collect()
}

/// What an accelerometer reads that swings on its own mount, stepped by its exact solution.
pub fn on_mount(base: &[V3], frequency: f64, ratio: f64) -> Vec<V3> {
    let (omega, dt) = (std::f64::consts::TAU * frequency, 1.0 / 4096.0);
    let (decay, swing) = (
        (-ratio * omega * dt).exp(),
        omega * (1.0 - ratio * ratio).sqrt(),
    );
    let (c, s) = ((swing * dt).cos() * decay, (swing * dt).sin() * decay);
    let (mut place, mut speed) = (V3::zeros(), V3::zeros());
    let step = |a: &V3| {
        let rest = -a / (omega * omega);
        let off = place - rest;
        let pushed = speed + off * (ratio * omega);
        place = rest + off * c + pushed * (s / swing);
        speed = speed * (c - ratio * omega * s / swing) - off * (omega * omega * s / swing);
        -place * (omega * omega) - speed * (2.0 * ratio * omega)
    };
    base.iter().map(step).collect()
}
