//! What a tremor of the tool at one frequency makes of the force: it thickens the chip along the ray of every
//! edge that cuts, so that the force has the tremor's own frequency and, beside it, those that lie multiples of
//! the spindle's apart.

use super::Case;
use crate::experiments::milling_force::{BANDWIDTH, SPEED};
use crate::signal::low_pass::butterworth2;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

/// Places of a revolution.
const GRID: usize = 720;
/// Multiples of the tooth passing on either side of the tremor.
const BESIDE: i64 = 12;

/// The force per tremor of one cut, as lines of the spindle.
pub struct Tremor {
    cut: usize,
    /// By direction and axis, N/m.
    lines: [[Vec<Complex64>; 3]; 2],
    /// Angle of tooth 1 at every sample, rad.
    angles: Vec<f64>,
    spindle_hz: f64,
    corner_hz: Option<f64>,
}

impl Tremor {
    /// Of a cut as it is simulated.
    pub fn new(case: &Case, cut: usize) -> Self {
        let present = &case.cuts()[cut].present;
        let (scene, p) = present.moved(case.setting(cut, &case.offset));
        let wave = scene.wave(&p, |value, _| value);
        let at = |i: usize| wave.stirred(i as f64 / GRID as f64 * TAU, [p[0], p[1], p[2]]);
        let around: Vec<_> = (0..GRID).map(at).collect();
        let plan = FftPlanner::new().plan_fft_forward(GRID);
        let lines = |way: usize, axis: usize| {
            let each = around.iter();
            let mut own: Vec<Complex64> = each
                .map(|f| Complex64::new(f[way][axis] / GRID as f64, 0.0))
                .collect();
            plan.process(&mut own);
            own
        };
        Self {
            cut,
            lines: [0, 1].map(|way| [0, 1, 2].map(|axis| lines(way, axis))),
            spindle_hz: scene.cut.spindle_rad_s * (1.0 + p[SPEED]) / TAU,
            angles: scene.angles(&p),
            corner_hz: scene.low_pass.then(|| p[BANDWIDTH].exp()),
        }
    }

    /// Frequency of the tooth passing, Hz.
    pub fn passing_hz(&self, case: &Case) -> f64 {
        self.spindle_hz * case.places().teeth as f64
    }

    /// What a tremor at `hz` adds to the readings, N per µm: along the feed and left of it, each in two phases.
    pub fn columns(&self, case: &Case, hz: f64) -> Vec<Vec<f64>> {
        let cut = &case.cuts()[self.cut];
        let waves = [0, 1].map(|way| {
            let each = self.angles.iter().zip(&cut.time);
            each.map(|(angle, t)| {
                let tone = Complex64::from_polar(1e-6, TAU * hz * t);
                self.around(case, way, hz, *angle).map(|d| d * tone)
            })
            .collect::<Vec<_>>()
        });
        let column = |way: usize, part: fn(Complex64) -> f64| {
            case.column(|c, i, k| match c == self.cut {
                true => part(waves[way][i][k]),
                false => 0.0,
            })
        };
        let both = [0, 1].map(|way| [column(way, |z| z.re), column(way, |z| z.im)]);
        both.into_iter().flatten().collect()
    }

    /// Force per tremor at an angle of tooth 1, as the sensor passes what is beside `hz`.
    fn around(&self, case: &Case, way: usize, hz: f64, angle: f64) -> [Complex64; 3] {
        let teeth = case.places().teeth as i64;
        let mut sums = [Complex64::new(0.0, 0.0); 3];
        for m in -BESIDE..=BESIDE {
            let order = m * teeth;
            let passed = self.corner_hz.map_or(Complex64::new(1.0, 0.0), |corner| {
                butterworth2(hz + order as f64 * self.spindle_hz, corner)
            });
            let turn = Complex64::from_polar(1.0, order as f64 * angle) * passed;
            let line = order.rem_euclid(GRID as i64) as usize;
            for (axis, sum) in sums.iter_mut().enumerate() {
                *sum += self.lines[way][axis][line] * turn;
            }
        }
        sums
    }
}
