//! What a dynamometer makes of waves that repeat with every revolution of the spindle: its second-order low pass, and
//! its ringing.

use super::resonance::Resonant;
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

/// A dynamometer for revolutions of some samples.
pub(super) struct Passage {
    forward: Arc<dyn RealToComplex<f64>>,
    back: Arc<dyn ComplexToReal<f64>>,
    /// What every line of the spindle is multiplied with, by axis.
    plain: Factors,
    spindle_hz: f64,
    corner_hz: Option<f64>,
    resonant: Option<Resonant>,
}

/// A factor of every line, by axis.
type Factors = [Vec<Complex64>; 3];

impl Passage {
    /// For this many samples of a revolution.
    pub fn new(
        grid: usize,
        spindle_hz: f64,
        corner_hz: Option<f64>,
        resonant: Option<Resonant>,
    ) -> Self {
        let (forward, back) = PLANNER.with_borrow_mut(|planner| {
            (
                planner.plan_fft_forward(grid),
                planner.plan_fft_inverse(grid),
            )
        });
        let mut pass = Self {
            forward,
            back,
            plain: Factors::default(),
            spindle_hz,
            corner_hz,
            resonant,
        };
        pass.plain = pass.factors(|hz, _, axis| pass.at(hz, axis));
        pass
    }

    /// What it makes of a line.
    fn at(&self, hz: f64, axis: usize) -> Complex64 {
        let low = self
            .corner_hz
            .map_or(1.0.into(), |corner| butterworth2(hz, corner));
        self.resonant
            .map_or(low, |resonant| resonant.through(low, hz, axis))
    }

    /// Its derivative over the logarithm of the corner.
    fn slower(&self, hz: f64, axis: usize) -> Complex64 {
        let low = self
            .corner_hz
            .map_or(0.0.into(), |corner| butterworth2_slope(hz, corner));
        self.resonant
            .map_or(low, |resonant| resonant.slope(low, hz, axis))
    }

    /// A function of frequency (Hz), order and axis, for all lines.
    fn factors(&self, of: impl Fn(f64, f64, usize) -> Complex64) -> Factors {
        let grid = self.forward.len();
        let line = |order: usize, axis: usize| {
            let order = order as f64;
            // entries and exits are spread over a sample: undone here
            of(order * self.spindle_hz, order, axis) / sinc(order / grid as f64) / grid as f64
        };
        let all = |axis: usize| {
            let mut all: Vec<Complex64> = (0..grid / 2).map(|order| line(order, axis)).collect();
            all.push(Complex64::new(0.0, 0.0));
            all
        };
        if self
            .resonant
            .is_none_or(|resonant| resonant.axes == [true; 3])
        {
            let alike = all(0);
            return [alike.clone(), alike.clone(), alike];
        }
        [0, 1, 2].map(all)
    }

    /// A wave as it is read.
    pub fn plain(&self, wave: &[V3]) -> Vec<V3> {
        let [passed] = self.turned(wave, [&self.plain]);
        passed
    }

    /// The same, with its slopes over the logarithm of the corner and over the angle.
    pub fn with_slopes(&self, wave: &[V3]) -> [Vec<V3>; 3] {
        let slower = self.factors(|hz, _, axis| self.slower(hz, axis));
        let turned = self.factors(|hz, order, axis| Complex64::new(0.0, order) * self.at(hz, axis));
        self.turned(wave, [&self.plain, &slower, &turned])
    }

    /// The waves whose lines are those of a wave times factors.
    fn turned<const N: usize>(&self, wave: &[V3], factors: [&Factors; N]) -> [Vec<V3>; N] {
        let mut all = [(); N].map(|()| vec![[0.0; 3]; wave.len()]);
        let mut lines = self.forward.make_output_vec();
        for k in 0..3 {
            let mut own: Vec<f64> = wave.iter().map(|v| v[k]).collect();
            // lengths are those of the plans
            let _ = self.forward.process(&mut own, &mut lines);
            for (to, factors) in all.iter_mut().zip(factors) {
                let each = lines.iter().zip(&factors[k]);
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
