//! Noise first: what a span of everybody cannot explain, and its colour. Torque has noise too, which smoothing makes
//! slow, so that the colour is of no family: it is the spectrum itself, in bands.

use super::projection::{orthonormal, without};
use crate::findings::engine;
use crate::signal::cosine::Cosine;
use nalgebra::DVector;
use std::f64::consts::PI;
use std::sync::Arc;

/// Readings without any noise leave nothing to divide by, rad.
const LEAST: f64 = 1e-12;
/// Rounds in which colour and what the span leaves under it are found in turn.
const ROUNDS: usize = 3;
/// Lines that a band must have beyond what the span takes ...
const FREE: f64 = 16.0;
/// ... and its upper edge over its lower one, at least.
const WIDE: f64 = 1.3;
/// Rows per column of the span, at least.
const ROOM: usize = 4;
/// Correlation of neighbours that is told.
const CORRELATED: f64 = 0.1;

/// The noise of a joint's record.
#[derive(Clone)]
pub struct Coloured {
    /// Standard deviation of every cosine coefficient, rad.
    sigma: Vec<f64>,
    cosine: Arc<Cosine>,
    spread: Vec<f64>,
    worth: f64,
}

impl Coloured {
    /// White noise of one radian.
    pub fn unit(rows: usize) -> Self {
        Self {
            sigma: vec![1.0; rows],
            cosine: Arc::new(Cosine::new(rows)),
            spread: vec![1.0; rows],
            worth: 0.0,
        }
    }

    /// Of readings, from what the span of these columns leaves; short records have room for the first of them only.
    /// No line is taken to be quieter than `least` says: a channel among the columns has noise too, and where it has
    /// nothing else, its column would take that for the reading's.
    pub fn of(reading: &[f64], span: &[Vec<f64>], least: &[f64]) -> Self {
        let span = &span[..span.len().min(reading.len() / ROOM)];
        let mut noise = Self::unit(reading.len());
        for _ in 0..ROUNDS {
            let white: Vec<Vec<f64>> = span.iter().map(|c| noise.white(c)).collect();
            let basis = orthonormal(&white);
            let left = without(&basis, DVector::from_vec(noise.white(reading)));
            let taken = |k: usize| basis.iter().map(|b| b[k] * b[k]).sum::<f64>();
            let line = |k: usize| {
                (
                    (left[k] * noise.sigma[k]).powi(2),
                    (1.0 - taken(k)).max(0.0),
                )
            };
            let lines: Vec<(f64, f64)> = (0..reading.len()).map(line).collect();
            noise.sigma = coloured(&lines);
            let each = noise.sigma.iter_mut().zip(least);
            each.for_each(|(sigma, least)| *sigma = sigma.max(*least));
            noise.worth = (reading.len() - basis.len()) as f64;
        }
        let square = noise.sigma.iter().map(|s| s * s).sum::<f64>() / reading.len() as f64;
        noise.spread.fill(square.sqrt());
        noise
    }

    fn white(&self, column: &[f64]) -> Vec<f64> {
        let mut column = column.to_vec();
        self.cosine.transform(&mut column);
        column
            .iter_mut()
            .zip(&self.sigma)
            .for_each(|(c, s)| *c /= s);
        column
    }

    fn correlation(&self) -> f64 {
        let n = self.sigma.len() as f64;
        let (mut whole, mut next) = (f64::MIN_POSITIVE, 0.0);
        for (k, s) in self.sigma.iter().enumerate() {
            whole += s * s;
            next += s * s * (PI * k as f64 / n).cos();
        }
        next / whole
    }
}

/// Deviations from squares of lines and how free each was: means over bands, between them straight over the logarithm.
fn coloured(lines: &[(f64, f64)]) -> Vec<f64> {
    let mut bands: Vec<[f64; 2]> = Vec::new();
    let (mut first, mut square, mut free) = (0, 0.0, 0.0);
    for (k, line) in lines.iter().enumerate() {
        (square, free) = (square + line.0, free + line.1);
        let (low, high) = (first as f64 + 1.0, k as f64 + 1.0);
        if free >= FREE && high >= WIDE * low {
            bands.push([
                0.5 * (low.ln() + high.ln()),
                0.5 * (square / free).max(LEAST * LEAST).ln(),
            ]);
            (first, square, free) = (k + 1, 0.0, 0.0);
        }
    }
    if bands.is_empty() {
        bands.push([0.0, 0.5 * (square / free.max(1.0)).max(LEAST * LEAST).ln()]);
    }
    let at = |k: usize| {
        let x = (k as f64 + 1.0).ln();
        let above = bands.iter().position(|b| b[0] > x).unwrap_or(bands.len());
        let (a, b) = (bands.get(above.saturating_sub(1)), bands.get(above));
        match (a, b) {
            (Some(a), Some(b)) if above > 0 => a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]),
            (Some(end), _) => end[1],
            (None, _) => LEAST.ln(),
        }
    };
    (0..lines.len()).map(|k| at(k).exp()).collect()
}

impl engine::Noise for Coloured {
    fn whiten(&self, column: &[f64]) -> Vec<f64> {
        self.white(column)
    }

    fn spread(&self) -> &[f64] {
        &self.spread
    }

    fn rows(&self) -> f64 {
        self.worth
    }

    fn describe(&self) -> String {
        match self.correlation() {
            r if r > CORRELATED => format!("correlated (neighbours {r:.2})"),
            _ => "white".into(),
        }
    }
}
