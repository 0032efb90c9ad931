//! The noise of a record: how large each reading's is, and its colour.
//!
//! D: deviations grow with the load where speckle does, in bursts, in single wild readings. C: diagonal
//! after a cosine transform, chosen among families by the evidence of the sets of causes that lead (a
//! weak drift in white noise and nothing at all in pink noise look alike: only both together, cause and
//! colour, have a likelihood); lines far above their neighbours are raised.

mod growth;
mod swing;

use crate::findings::engine::{Noise, White};
use crate::findings::load_cycle::families::View;
use crate::ground::stats::{MEDIAN_OF_SQUARES, mean, median, rms};
use crate::signal::colour::Colour;
use crate::signal::cosine::Cosine;
use crate::signal::outliers;
use growth::{bursts, growth};
pub(super) use growth::{is_one_sided, windows};
use std::sync::Arc;
pub(super) use swing::is_swinging;

/// Noise of a record.
#[derive(Clone)]
pub struct Coloured {
    cosine: Arc<Cosine>,
    /// Standard deviation of every reading, rad or m.
    pub spread: Vec<f64>,
    /// Deviation of every cosine coefficient, mean square one.
    colour: Vec<f64>,
    /// What is said of it.
    words: Vec<String>,
    /// Tones that were taken off before.
    hums: usize,
    tint: Tint,
    rows: f64,
}

/// A family of colours: power over the frequency f in cycles per row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tint {
    /// Even.
    White,
    /// f^(−a).
    Power(f64),
    /// 1 + (c/f)^a: exponent a and corner c.
    Corner(f64, f64),
    /// Neighbours correlated by so much.
    Correlated(f64),
}

/// The colours that are tried.
pub const TINTS: [Tint; 14] = [
    Tint::White,
    Tint::Power(0.3),
    Tint::Power(0.6),
    Tint::Power(0.9),
    Tint::Corner(1.0, 0.01),
    Tint::Corner(1.0, 0.05),
    Tint::Corner(2.0, 0.01),
    Tint::Corner(2.0, 0.04),
    Tint::Correlated(0.3),
    Tint::Correlated(0.5),
    Tint::Correlated(0.65),
    Tint::Correlated(0.8),
    Tint::Correlated(0.9),
    Tint::Correlated(0.96),
];

impl Tint {
    fn power(self, f: f64) -> f64 {
        match self {
            Self::White => 1.0,
            Self::Power(a) => f.powf(-a),
            Self::Corner(a, c) => 1.0 + (c / f).powf(a),
            Self::Correlated(r) => {
                1.0 / (1.0 + r * r - 2.0 * r * (std::f64::consts::TAU * f).cos())
            }
        }
    }

    fn words(self) -> String {
        match self {
            Self::White => "white".into(),
            Self::Power(a) => format!("pink (1/f^{a:.1})"),
            Self::Corner(a, _) => format!("pink (1/f^{a:.1} over white)"),
            Self::Correlated(r) => format!("correlated (neighbours {r:.2})"),
        }
    }
}

/// What stated noise is worth, rows: data sheets are right within a factor of two.
const STATED: f64 = 2.0;

/// Distance of a wild reading from its neighbours, robust deviations.
const WILD: f64 = 6.5;
/// Power over that of its neighbours of a line that is raised, above the slow part of the band: below it may
/// be structure.
const LINE: f64 = 14.0;

impl Coloured {
    /// White noise of one deviation, in readings that so many tones were taken off.
    pub fn white(cosine: Arc<Cosine>, spread: f64, hums: usize) -> Self {
        let rows = cosine.len();
        Self {
            spread: vec![spread.max(f64::MIN_POSITIVE); rows],
            colour: vec![1.0; rows],
            words: Vec::new(),
            hums,
            tint: Tint::White,
            rows: STATED,
            cosine,
        }
    }

    /// With another colour.
    #[must_use]
    pub fn tinted(&self, tint: Tint) -> Self {
        let n = self.colour.len();
        let power = |k: usize| tint.power((k as f64 + 0.5) / (2.0 * n as f64));
        let powers: Vec<f64> = (0..n).map(power).collect();
        let level = mean(&powers);
        Self {
            colour: powers.iter().map(|p| (p / level).sqrt()).collect(),
            tint,
            ..self.clone()
        }
    }

    /// Its colour.
    pub fn tint(&self) -> Tint {
        self.tint
    }

    /// Logarithm of the determinant of its deviations, up to what all noises of a record share.
    pub fn ln_size(&self) -> f64 {
        let sum = |v: &[f64]| v.iter().map(|x| x.ln()).sum::<f64>();
        sum(&self.spread) + sum(&self.colour)
    }

    /// The deviations that a residual shows: growth with the load, bursts, wild readings.
    #[must_use]
    pub fn with_deviations(&self, residual: &[f64], view: &View) -> Self {
        let mut words = Vec::new();
        let mut shape = vec![1.0; residual.len()];
        if let Some(growth) = growth(residual, view) {
            let factors = view.u.iter().map(|u| 1.0 + growth * u.abs());
            shape.iter_mut().zip(factors).for_each(|(s, f)| *s *= f);
            words.push("growing with the load".into());
        }
        let flat: Vec<f64> = residual.iter().zip(&shape).map(|(r, s)| r / s).collect();
        let bursts = bursts(&flat);
        if bursts.iter().any(|b| *b > 1.0) {
            shape.iter_mut().zip(&bursts).for_each(|(s, b)| *s *= b);
            let loud: Vec<f64> = bursts.iter().copied().filter(|b| *b > 1.0).collect();
            let most = loud.iter().fold(1.0_f64, |m, b| m.max(*b));
            let share = 100.0 * loud.len() as f64 / bursts.len() as f64;
            words.push(format!(
                "in bursts ({share:.0} % of the rows, up to {most:.1} times the rest)"
            ));
        }
        let level = rms(&flat
            .iter()
            .zip(&bursts)
            .map(|(f, b)| f / b)
            .collect::<Vec<_>>());
        let mut spread: Vec<f64> = shape
            .iter()
            .map(|s| s * level.max(f64::MIN_POSITIVE))
            .collect();
        for i in outliers::lone(residual, WILD) {
            spread[i] = spread[i].max(residual[i].abs());
        }
        Self {
            spread,
            words,
            ..self.clone()
        }
    }

    /// Raises lines of the upper band that stand far above their neighbours.
    #[must_use]
    pub fn with_lines(mut self, residual: &[f64], view: &View) -> Self {
        let power: Vec<f64> = self.whiten(residual).iter().map(|c| c * c).collect();
        let n = power.len();
        let from = (view.slow * n as f64) as usize;
        if n < 100 {
            return self;
        }
        let near =
            |k: usize| median(&power[k.saturating_sub(20)..(k + 21).min(n)]) / MEDIAN_OF_SQUARES;
        let lines: Vec<usize> = (from..n)
            .filter(|k| power[*k] > LINE * near(*k).max(f64::MIN_POSITIVE))
            .collect();
        for k in &lines {
            (k.saturating_sub(1)..(k + 2).min(n)).for_each(|j| {
                let factor = (power[j] / near(j)).max(1.0).sqrt();
                self.colour[j] *= factor;
            });
        }
        if !lines.is_empty() {
            self.words.push("with a line".into());
        }
        self
    }

    /// As the colour of a fit, of this deviation per reading.
    pub fn colour(&self, factor: f64) -> Colour {
        let level = factor * rms(&self.spread);
        Colour {
            sigma: self.colour.iter().map(|c| c * level).collect(),
            rms: level,
            family: match self.tint {
                Tint::White => "white",
                Tint::Correlated(_) => "autoregressive",
                _ => "pink",
            },
            shape: match self.tint {
                Tint::White => [0.0, 0.0],
                Tint::Power(a) | Tint::Correlated(a) => [a, 0.0],
                Tint::Corner(a, c) => [a, c],
            },
        }
    }
}

impl Coloured {
    /// Cosine coefficients of a column, each reading in its own deviation.
    pub fn waves(&self, column: &[f64]) -> Vec<f64> {
        let each = column.iter().zip(&self.spread);
        let mut own: Vec<f64> = each.map(|(c, s)| c / s).collect();
        self.cosine.transform(&mut own);
        own
    }

    /// The noise of such coefficients: independent.
    pub fn of_waves(&self) -> White {
        White {
            spread: self.colour.clone(),
            rows: self.rows,
        }
    }

    /// Power of a residual over the frequency, each reading in its own deviation.
    pub fn spectrum(&self, residual: &[f64]) -> Vec<f64> {
        self.waves(residual).iter().map(|c| c * c).collect()
    }
}

impl Noise for Coloured {
    fn whiten(&self, column: &[f64]) -> Vec<f64> {
        let mut out = self.waves(column);
        out.iter_mut().zip(&self.colour).for_each(|(o, c)| *o /= c);
        out
    }

    fn spread(&self) -> &[f64] {
        &self.spread
    }

    fn rows(&self) -> f64 {
        self.rows
    }

    fn describe(&self) -> String {
        let mut words = vec![self.tint.words()];
        words.extend(self.words.iter().cloned());
        words.extend((self.hums > 0).then(|| "beside a hum that is taken off".into()));
        words.join(", ")
    }
}

/// Differences of neighbours: structure hardly shows in them.
pub(super) fn differences(residual: &[f64]) -> Vec<f64> {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    residual.windows(2).map(|w| half * (w[1] - w[0])).collect()
}

/// Deviation of a reading by its third differences, whatever smooth structure there is.
pub fn rough(reading: &[f64]) -> f64 {
    let third = outliers::third_differences(reading);
    match outliers::robust_std(&third) {
        s if s > 0.0 => s,
        _ => rms(&third),
    }
}

/// How many times the scatter of its neighbours a residual is, each reading in its own deviation.
pub fn above_neighbours(residual: &[f64], spread: &[f64]) -> f64 {
    let each = residual.iter().zip(spread);
    let own: Vec<f64> = each.map(|(r, s)| r / s).collect();
    rms(&own) / rough(&own).max(f64::MIN_POSITIVE)
}
