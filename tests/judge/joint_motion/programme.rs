//! How a laboratory moves a joint.

use super::super::pick;
use ident::ground::random::Random;
use std::f64::consts::TAU;

/// Motion of the motor on the link's side: s, rad, rad/s, rad/s².
pub struct Programme {
    pub name: &'static str,
    pub time: Vec<f64>,
    pub angle: Vec<f64>,
    pub speed: Vec<f64>,
    pub acceleration: Vec<f64>,
}

impl Programme {
    /// Series of Fourier, moves from rest to rest, slow strokes back and forth, or short steps along a way.
    pub fn draw(random: &mut Random, seconds: f64, cycle: f64) -> Self {
        let rows = (seconds / cycle) as usize;
        let (name, angle) = match random.below(4) {
            0 => ("Fourier series", fourier(random, rows, cycle)),
            1 => ("moves and rests", moves(random, rows, cycle)),
            2 => ("slow strokes", strokes(random, rows, cycle)),
            _ => ("steps along a way", steps(random, rows, cycle)),
        };
        let speed = slope(&angle, cycle);
        Self {
            name,
            time: (0..rows).map(|i| i as f64 * cycle).collect(),
            acceleration: slope(&speed, cycle),
            angle,
            speed,
        }
    }
}

/// Central differences.
fn slope(v: &[f64], cycle: f64) -> Vec<f64> {
    let last = v.len() - 1;
    let at = |i: usize| {
        let (a, b) = (i.saturating_sub(1), (i + 1).min(last));
        (v[b] - v[a]) / ((b - a) as f64 * cycle)
    };
    (0..v.len()).map(at).collect()
}

/// Five harmonics of a slow tone (Swevers et al. 1997).
fn fourier(random: &mut Random, rows: usize, cycle: f64) -> Vec<f64> {
    let base = TAU * random.uniform(0.08, 0.2);
    let tone = |k: usize| {
        let size = random.uniform(0.1, 0.4) / (k as f64).sqrt();
        (base * k as f64, size, random.uniform(0.0, TAU))
    };
    let tones: Vec<_> = (1..=5).map(tone).collect();
    let start = random.uniform(-0.5, 0.5);
    let at = |t: f64| {
        tones
            .iter()
            .map(|(w, a, p)| a * (w * t + p).sin())
            .sum::<f64>()
    };
    (0..rows).map(|i| start + at(i as f64 * cycle)).collect()
}

/// Corners of a path over time, rounded by two moving means: acceleration and jerk are bounded.
fn rounded(corners: &[(f64, f64)], rows: usize, cycle: f64, width: f64) -> Vec<f64> {
    let at = |t: f64| {
        let after = corners
            .iter()
            .position(|c| c.0 > t)
            .unwrap_or(corners.len() - 1);
        let (a, b) = (corners[after.max(1) - 1], corners[after.max(1)]);
        a.1 + (b.1 - a.1) * ((t - a.0) / (b.0 - a.0)).clamp(0.0, 1.0)
    };
    let half = (width / cycle / 2.0).ceil() as i64;
    let mean = |v: &[f64]| -> Vec<f64> {
        let last = v.len() as i64 - 1;
        let window = |i: i64| {
            (i - half..=i + half)
                .map(|k| v[k.clamp(0, last) as usize])
                .sum::<f64>()
        };
        (0..=last)
            .map(|i| window(i) / (2 * half + 1) as f64)
            .collect()
    };
    let raw: Vec<f64> = (0..rows).map(|i| at(i as f64 * cycle)).collect();
    mean(&mean(&raw))
}

fn moves(random: &mut Random, rows: usize, cycle: f64) -> Vec<f64> {
    let (mut corners, mut t) = (vec![(0.0, random.uniform(-0.8, 0.8))], 0.5);
    while t < rows as f64 * cycle + 3.0 {
        let from = corners[corners.len() - 1].1;
        let to = random.uniform(-1.0, 1.0);
        let speed = random.uniform(0.3, 1.3);
        corners.push((t, from));
        t += f64::max((to - from).abs() / speed, 0.2);
        corners.push((t, to));
        t += *pick(random, &[0.3, 0.6, 1.5]);
    }
    rounded(&corners, rows, cycle, random.uniform(0.15, 0.5))
}

fn strokes(random: &mut Random, rows: usize, cycle: f64) -> Vec<f64> {
    let (middle, half) = (random.uniform(-0.6, 0.6), random.uniform(0.2, 0.9));
    let leg = random.uniform(1.5, 5.0);
    let corner = |k: usize| {
        (
            k as f64 * leg,
            middle + if k.is_multiple_of(2) { half } else { -half },
        )
    };
    let corners: Vec<_> = (0..(rows as f64 * cycle / leg) as usize + 3)
        .map(corner)
        .collect();
    rounded(&corners, rows, cycle, random.uniform(0.2, 0.6))
}

fn steps(random: &mut Random, rows: usize, cycle: f64) -> Vec<f64> {
    let (mut t, mut corners) = (0.0, vec![(0.0, random.uniform(-1.0, 0.0))]);
    while t < rows as f64 * cycle + 2.0 {
        let from = corners[corners.len() - 1].1;
        let step = random.uniform(0.05, 0.45) * if random.unit() < 0.65 { 1.0 } else { -1.0 };
        t += random.uniform(0.3, 1.1);
        corners.push((t, (from + step).clamp(-1.3, 1.3)));
    }
    rounded(&corners, rows, cycle, random.uniform(0.12, 0.3))
}
