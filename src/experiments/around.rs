//! A dynamometer's second-order low pass on waves that repeat with every revolution of the spindle.

use crate::ground::spatial::V3;
use crate::signal::low_pass::{butterworth2, butterworth2_slope};
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex64;
use std::cell::RefCell;
use std::f64::consts::PI;
use std::sync::Arc;

thread_local! {
    static PLANNER: RefCell<RealFftPlanner<f64>> = RefCell::new(RealFftPlanner::new());
}

/// The low pass for revolutions of some samples.
pub(super) struct LowPass {
    forward: Arc<dyn RealToComplex<f64>>,
    back: Arc<dyn ComplexToReal<f64>>,
    /// What every line of the spindle is multiplied with.
    plain: Vec<Complex64>,
    spindle_hz: f64,
    corner_hz: f64,
}

impl LowPass {
    /// For this many samples of a revolution.
    pub fn new(grid: usize, spindle_hz: f64, corner_hz: f64) -> Self {
        let (forward, back) = PLANNER.with_borrow_mut(|planner| {
            (
                planner.plan_fft_forward(grid),
                planner.plan_fft_inverse(grid),
            )
        });
        let mut pass = Self {
            forward,
            back,
            plain: Vec::new(),
            spindle_hz,
            corner_hz,
        };
        pass.plain = pass.factors(|hz, _| butterworth2(hz, corner_hz));
        pass
    }

    /// A function of frequency (Hz) and order, for all lines.
    fn factors(&self, of: impl Fn(f64, f64) -> Complex64) -> Vec<Complex64> {
        let grid = self.forward.len();
        let line = |order: usize| {
            let order = order as f64;
            // entries and exits are spread over a sample: undone here
            of(order * self.spindle_hz, order) / sinc(order / grid as f64) / grid as f64
        };
        let mut all: Vec<Complex64> = (0..grid / 2).map(line).collect();
        all.push(Complex64::new(0.0, 0.0));
        all
    }

    /// A wave behind the low pass.
    pub fn plain(&self, wave: &[V3]) -> Vec<V3> {
        let [passed] = self.turned(wave, [&self.plain]);
        passed
    }

    /// The same, with its slopes over the logarithm of the corner and over the angle.
    pub fn with_slopes(&self, wave: &[V3]) -> [Vec<V3>; 3] {
        let slower = self.factors(|hz, _| butterworth2_slope(hz, self.corner_hz));
        let turned =
            self.factors(|hz, order| Complex64::new(0.0, order) * butterworth2(hz, self.corner_hz));
        self.turned(wave, [&self.plain, &slower, &turned])
    }

    /// The waves whose lines are those of a wave times factors.
    fn turned<const N: usize>(&self, wave: &[V3], factors: [&Vec<Complex64>; N]) -> [Vec<V3>; N] {
        let mut all = [(); N].map(|()| vec![[0.0; 3]; wave.len()]);
        let mut lines = self.forward.make_output_vec();
        for k in 0..3 {
            let mut own: Vec<f64> = wave.iter().map(|v| v[k]).collect();
            // lengths are those of the plans
            let _ = self.forward.process(&mut own, &mut lines);
            for (to, factors) in all.iter_mut().zip(factors) {
                let each = lines.iter().zip(factors);
                let mut passed: Vec<Complex64> = each.map(|(l, f)| l * f).collect();
                passed[0].im = 0.0;
                let _ = self.back.process(&mut passed, &mut own);
                to.iter_mut().zip(&own).for_each(|(t, x)| t[k] = *x);
            }
        }
        all
    }
}

/// sin(πx) / πx.
fn sinc(x: f64) -> f64 {
    let y = PI * x;
    if y.abs() < 1e-6 { 1.0 } else { y.sin() / y }
}
