//! The simulated force of a cut over one revolution as lines at the harmonics of the spindle, and what a
//! sensor that rings makes of them.

use super::setting::{Present, Setting};
use crate::experiments::milling_force::{BANDWIDTH, PHASE};
use crate::experiments::resonance::Resonance;
use crate::ground::spatial::V3;
use crate::signal::low_pass::butterworth2;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

/// Places of a revolution.
const GRID: usize = 720;

/// One cut over a revolution.
pub struct Revolution {
    /// Lines of each axis, N times the places.
    lines: [Vec<Complex64>; 3],
    spindle_hz: f64,
    /// Corner of the low pass that is stated, Hz.
    corner_hz: Option<f64>,
    /// Angle of tooth 1 at every sample, rad.
    angles: Vec<f64>,
}

impl Revolution {
    /// Of a cut at an offset from what is stated.
    pub fn new(present: &Present, setting: Setting) -> Self {
        let (scene, p) = present.moved(setting);
        let angles = scene.angles(&p);
        let (mut around, mut level) = (scene, p);
        let spindle = around.cut.spindle_rad_s;
        let step = TAU / GRID as f64 / spindle;
        around.time = (0..GRID).map(|i| i as f64 * step).collect();
        level[PHASE] = 0.0;
        let force = around.force(&level);
        let replaced = around
            .resonant
            .is_some_and(|resonant| resonant.resonance.instead);
        let passes = around.low_pass && !replaced;
        let plan = FftPlanner::new().plan_fft_forward(GRID);
        let lines = std::array::from_fn(|k| {
            let mut own: Vec<Complex64> = force.iter().map(|f| Complex64::new(f[k], 0.0)).collect();
            plan.process(&mut own);
            own
        });
        Self {
            lines,
            spindle_hz: spindle / TAU,
            corner_hz: passes.then(|| level[BANDWIDTH].exp()),
            angles,
        }
    }

    /// What a sensor that rings adds at every sample.
    pub fn ringing(&self, resonance: Resonance) -> Vec<V3> {
        let plan = FftPlanner::new().plan_fft_inverse(GRID);
        let around: [Vec<f64>; 3] = std::array::from_fn(|k| {
            let mut own: Vec<Complex64> = (0..GRID)
                .map(|i| self.lines[k][i] * self.added(i, resonance))
                .collect();
            plan.process(&mut own);
            own.iter().map(|c| c.re / GRID as f64).collect()
        });
        self.angles
            .iter()
            .map(|angle| read(&around, *angle))
            .collect()
    }

    /// Line of an order of the spindle and an axis: the force is the sum of its real parts, N.
    pub fn line(&self, order: usize, axis: usize) -> Complex64 {
        self.lines[axis][order] * (2.0 / GRID as f64)
    }

    /// Frequency of the spindle, Hz.
    pub fn spindle_hz(&self) -> f64 {
        self.spindle_hz
    }

    /// What it makes of a line of the spindle.
    pub fn rings(&self, order: f64, resonance: Resonance) -> Complex64 {
        let line_hz = order * self.spindle_hz;
        let instead = self.corner_hz.filter(|_| resonance.instead);
        let passed = instead.map_or(Complex64::new(1.0, 0.0), |hz| butterworth2(line_hz, hz));
        resonance.magnified(line_hz) / passed
    }

    fn added(&self, i: usize, resonance: Resonance) -> Complex64 {
        let order = match i < GRID / 2 {
            true => i as f64,
            false => i as f64 - GRID as f64,
        };
        if i == GRID / 2 {
            return Complex64::new(0.0, 0.0);
        }
        self.rings(order, resonance) - 1.0
    }
}

/// Between the places of a revolution.
fn read(around: &[Vec<f64>; 3], angle: f64) -> V3 {
    let at = angle.rem_euclid(TAU) / TAU * GRID as f64;
    let (i, u) = (at as usize % GRID, at.fract());
    std::array::from_fn(|k| around[k][i] + u * (around[k][(i + 1) % GRID] - around[k][i]))
}
