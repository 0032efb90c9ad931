//! Friction of the drive as the torque itself shows it.

use super::channels::Channels;
use super::projection::partial;
use crate::ground::stats::mean;

/// What the torque shows: N·m, and N·m·s/rad.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Friction {
    /// Dry.
    pub dry: f64,
    /// Viscous.
    pub viscous: f64,
    /// Standard error of the viscous one.
    pub viscous_std: f64,
}

/// Share of the top speed over which dry friction changes its sign.
const SIGN_WIDTH: f64 = 0.03;
/// Pieces of the record that are left out in turn for the error of a friction.
const PIECES: usize = 8;

/// Smooth sign of the speed.
pub fn sign(data: &Channels) -> Vec<f64> {
    let width = SIGN_WIDTH * data.top_speed().max(f64::MIN_POSITIVE);
    data.speed.iter().map(|v| (v / width).tanh()).collect()
}

/// What inertia and the weight of the link make of a torque, the zero of its reading with them: one column each.
pub(super) fn inertia_and_weight(data: &Channels) -> Vec<Vec<f64>> {
    let wave = |f: fn(f64) -> f64| data.motor.iter().map(|q| f(*q)).collect();
    vec![
        vec![1.0; data.rows()],
        data.acceleration.clone(),
        wave(f64::sin),
        wave(f64::cos),
    ]
}

impl Friction {
    /// Beside inertia and what depends on the angle.
    pub fn of(data: &Channels) -> Self {
        let beside = inertia_and_weight(data);
        let with = |more: &[f64]| {
            let mut all = beside.clone();
            all.push(more.to_vec());
            all
        };
        let sign = sign(data);
        let (for_speed, n) = (with(&sign), data.rows());
        let viscous = |skip: usize| {
            let kept = |c: &[f64]| -> Vec<f64> {
                let rows = (0..n).filter(|i| i * PIECES / n != skip);
                rows.map(|i| c[i]).collect()
            };
            let others: Vec<Vec<f64>> = for_speed.iter().map(|c| kept(c)).collect();
            partial(&others, &kept(&data.speed), &kept(&data.torque)).slope
        };
        let parts: Vec<f64> = (0..PIECES).map(viscous).collect();
        let middle = mean(&parts);
        let spread: f64 = parts.iter().map(|v| (v - middle) * (v - middle)).sum();
        Self {
            dry: partial(&with(&data.speed), &sign, &data.torque)
                .slope
                .max(0.0),
            viscous: viscous(PIECES),
            viscous_std: (spread * (PIECES - 1) as f64 / PIECES as f64).sqrt(),
        }
    }

    /// A torque less this friction.
    pub fn less(&self, data: &Channels, torque: &[f64]) -> Vec<f64> {
        self.added(data, torque, -1.0)
    }

    /// A torque with this friction.
    pub fn with(&self, data: &Channels, torque: &[f64]) -> Vec<f64> {
        self.added(data, torque, 1.0)
    }

    fn added(&self, data: &Channels, torque: &[f64], times: f64) -> Vec<f64> {
        let sign = sign(data);
        let viscous = self.viscous.max(0.0);
        let sum = |i: usize| torque[i] + times * (self.dry * sign[i] + viscous * data.speed[i]);
        (0..data.rows()).map(sum).collect()
    }
}
