//! Where a sensor that rings has its resonance, from the lines of the tooth passing: what rings shifts them,
//! so that the angle of the tooth is sought along, over a whole pitch.

use super::Case;
use super::revolution::Revolution;
use crate::experiments::resonance::Resonance;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

/// Multiples of the tooth passing that are compared.
const LINES: usize = 14;
/// Places of the angle over a pitch, at first.
const ANGLES: usize = 40;
/// Steps in which the angle is brought closer, each a third of the last.
const CLOSER: usize = 4;
/// Frequencies and damping ratios at first.
const STEPS: usize = 40;
const DAMPING: [f64; 4] = [0.01, 0.03, 0.08, 0.2];
/// Shares by which a resonance is brought closer, one after the other.
const WIDTHS: [f64; 6] = [0.05, 0.03, 0.015, 0.008, 0.004, 0.002];

/// A resonance and the angles of the teeth that go with it.
#[derive(Debug, Clone)]
pub struct Ringing {
    /// The resonance.
    pub resonance: Resonance,
    /// Angle of tooth 1 of every cut, from where it is now, rad.
    pub turns: Vec<f64>,
    /// What it leaves of the lines, squared noise deviations.
    pub misfit: f64,
}

/// Lines of one cut.
struct Cut<'a> {
    /// Order, measured and simulated by axis: of the tooth passing, and of all its multiples in turn.
    lines: Vec<(usize, [Complex64; 3], [Complex64; 3])>,
    revolution: &'a Revolution,
    /// Samples that a line is the mean of.
    samples: f64,
}

/// The lines of a file.
pub struct Lines<'a> {
    cuts: Vec<Cut<'a>>,
    weight: [f64; 3],
    pitch: f64,
    range: [f64; 2],
}

impl<'a> Lines<'a> {
    /// Of a case; `revolutions` of its cuts as simulated.
    pub fn of(case: &Case, revolutions: &'a [Revolution]) -> Self {
        let teeth = case.places().teeth;
        let cuts = revolutions
            .iter()
            .enumerate()
            .map(|(c, r)| cut(case, c, r, teeth));
        Self {
            cuts: cuts.collect(),
            weight: std::array::from_fn(|k| case.noise()[k].powi(-2)),
            pitch: TAU / teeth as f64,
            range: range(case),
        }
    }

    /// Highest frequency that the samples can show, Hz.
    pub fn highest_hz(&self) -> f64 {
        self.range[1]
    }

    /// The best resonance of some axes, beside the low pass that is stated or in its place.
    pub fn best(&self, axes: [bool; 3], instead: bool) -> Ringing {
        let [low, high] = self.range;
        let hz = |i: usize| low * (high / low).powf(i as f64 / (STEPS - 1) as f64);
        let grid = (0..STEPS).flat_map(|i| DAMPING.map(|d| [hz(i), d]));
        let fitted = |at: [f64; 2]| self.fitted(axes, Resonance { at, instead });
        let all = grid.map(fitted);
        let least = |a: Ringing, b: Ringing| if b.misfit < a.misfit { b } else { a };
        let mut best = all
            .reduce(least)
            .unwrap_or_else(|| fitted([low, DAMPING[0]]));
        for width in WIDTHS {
            for _ in 0..3 {
                let [hz, damping] = best.resonance.at;
                let about = [-1.0, 0.0, 1.0].map(|f| {
                    [-1.0, 0.0, 1.0].map(|d| {
                        let damping = damping * (1.0 + 8.0 * width * d).max(0.3);
                        [hz * (1.0 + width * f), damping.clamp(0.003, MOST_DAMPING)]
                    })
                });
                let found = about.into_iter().flatten().map(fitted);
                best = found.fold(best, least);
            }
        }
        best
    }

    /// What nothing that rings leaves of the lines, squared noise deviations.
    pub fn silent(&self) -> f64 {
        let resonance = Resonance {
            at: [f64::INFINITY, 0.0],
            instead: false,
        };
        self.fitted([false; 3], resonance).misfit
    }

    fn fitted(&self, axes: [bool; 3], resonance: Resonance) -> Ringing {
        let mut found = Ringing {
            resonance,
            turns: Vec::new(),
            misfit: 0.0,
        };
        for cut in &self.cuts {
            let (turn, misfit) = self.turn(cut, axes, resonance);
            found.turns.push(turn);
            // a line's parts scatter by twice the noise over the root of its samples
            found.misfit += 0.25 * cut.samples * misfit;
        }
        found
    }

    /// Angle that suits a cut best, and what it leaves.
    fn turn(&self, cut: &Cut, axes: [bool; 3], resonance: Resonance) -> (f64, f64) {
        let parts: Vec<(f64, Complex64)> = cut
            .lines
            .iter()
            .map(|(order, measured, simulated)| {
                let rings = cut.revolution.rings(*order as f64, resonance);
                let mut square = 0.0;
                let mut cross = Complex64::new(0.0, 0.0);
                for k in 0..3 {
                    let own = match axes[k] {
                        true => simulated[k] * rings,
                        false => simulated[k],
                    };
                    square += self.weight[k] * (measured[k].norm_sqr() + own.norm_sqr());
                    cross += measured[k] * own.conj() * self.weight[k];
                }
                (square, cross)
            })
            .collect();
        let misfit = |turn: f64| {
            let pitch = Complex64::from_polar(1.0, -TAU / self.pitch * turn);
            let one = |(sum, back): (f64, Complex64), (square, cross): &(f64, Complex64)| {
                (sum + square - 2.0 * (cross * back).re, back * pitch)
            };
            parts.iter().fold((0.0, pitch), one).0
        };
        let mut step = self.pitch / ANGLES as f64;
        let first = (0..ANGLES).map(|i| (i as f64 - 0.5 * ANGLES as f64) * step);
        let best = |a: (f64, f64), b: (f64, f64)| if b.1 < a.1 { b } else { a };
        let mut found = first
            .map(|t| (t, misfit(t)))
            .fold((0.0, f64::INFINITY), best);
        for _ in 0..CLOSER {
            step /= 3.0;
            let about = [-2.0, -1.0, 1.0, 2.0].map(|f| found.0 + f * step);
            found = about.map(|t| (t, misfit(t))).into_iter().fold(found, best);
        }
        found
    }
}

/// Damping ratio above which nothing rings.
pub(super) const MOST_DAMPING: f64 = 0.3;

fn cut<'a>(case: &Case, number: usize, revolution: &'a Revolution, teeth: usize) -> Cut<'a> {
    let samples = &case.cuts()[number];
    let angles = samples.present.scene.angles(&samples.present.p);
    let count = angles.len() as f64;
    let mean = |k: usize| samples.measured.iter().map(|f| f[k]).sum::<f64>() / count;
    let means = [mean(0), mean(1), mean(2)];
    let highest = HIGHEST * sampling_hz(case) / revolution.spindle_hz();
    let map = case.sensor().map;
    let line = |order: usize| {
        let mut sums = [Complex64::new(0.0, 0.0); 3];
        for (angle, force) in angles.iter().zip(&samples.measured) {
            let back = Complex64::from_polar(2.0 / count, -(order as f64) * angle);
            (0..3).for_each(|k| sums[k] += back * (force[k] - means[k]));
        }
        let lines = [0, 1, 2].map(|k| revolution.line(order, k));
        let simulated = map.map(|row| (0..3).map(|k| lines[k] * row[k]).sum());
        (order, sums, simulated)
    };
    let orders = (1..=LINES).map(|m| m * teeth);
    Cut {
        lines: orders.filter(|o| (*o as f64) < highest).map(line).collect(),
        revolution,
        samples: count,
    }
}

/// Share of the rate of sampling up to which lines and resonances are looked for.
const HIGHEST: f64 = 0.4;

fn sampling_hz(case: &Case) -> f64 {
    let steps = case.cuts().iter().flat_map(|c| c.time.windows(2));
    let shortest = steps.map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
    shortest.max(1e-9).recip()
}

/// From a little above the slowest spindle to what the samples can show, Hz.
fn range(case: &Case) -> [f64; 2] {
    let cuts = case.cuts().iter();
    let spindles = cuts.map(|c| c.present.scene.cut.spindle_rad_s / TAU);
    let low = 1.5 * spindles.fold(f64::INFINITY, f64::min);
    [
        low,
        (HIGHEST * sampling_hz(case)).clamp(2.0 * low, 200.0 * low),
    ]
}
