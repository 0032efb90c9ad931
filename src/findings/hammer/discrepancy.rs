//! How far a simulated accelerance is from the measured one, and where.

use super::data::Data;
use super::point::Point;
use super::prediction::Machine;
use crate::ground::problem::Outcome;
use crate::motion::frf::C64;

/// Accelerances per pair and line.
pub type Curves = Vec<Vec<C64>>;

/// What `point` would have shown.
///
/// # Errors
/// A robot that cannot be computed.
pub fn simulated(machine: &Machine, data: &Data, point: &Point) -> Outcome<Curves> {
    let nuisance = machine.nuisance(point)?;
    let mut point = point.clone();
    point.theta.resize(nuisance.len(), 0.0);
    let lines = machine.predict(&nuisance, &point, data)?;
    let pairs = data.pairs.iter();
    Ok(pairs
        .map(|p| lines.iter().map(|a| a[p.output][p.input]).collect())
        .collect())
}

/// Root mean square of measured less simulated over all pairs, and where it is largest.
pub fn between(data: &Data, simulated: &Curves) -> (f64, String) {
    let hz = data.hz();
    let (mut sum, mut largest) = (0.0, (0.0, 0, 0));
    for (p, (pair, curve)) in data.pairs.iter().zip(simulated).enumerate() {
        for (k, (m, s)) in pair.frf.iter().zip(curve).enumerate() {
            let square = (m - s).norm_sqr();
            sum += square;
            if square > largest.0 {
                largest = (square, p, k);
            }
        }
    }
    let count = (data.pairs.len() * hz.len()).max(1) as f64;
    let (_, pair, line) = largest;
    let place = match hz.get(line) {
        Some(hz) => format!("largest at {hz:.1} Hz in {}", data.name(pair)),
        None => "nowhere".into(),
    };
    ((sum / count).sqrt(), place)
}

/// Standard deviation of the measured values, root mean square over all.
pub fn noise(data: &Data) -> f64 {
    let weights = data.pairs.iter().flat_map(|p| &p.weight);
    let variances = weights.map(|w| 2.0 / (w * w) / data.correlated);
    let count = (data.pairs.len() * data.s.len()).max(1) as f64;
    (variances.sum::<f64>() / count).sqrt()
}

/// Root mean square over the pairs of measured less simulated, over frequency: [Hz, (m/s²)/N].
pub fn spectrum(data: &Data, simulated: &Curves) -> Vec<[f64; 2]> {
    let line = |(k, hz): (usize, f64)| {
        let pairs = data.pairs.iter().zip(simulated);
        let sum: f64 = pairs.map(|(p, s)| (p.frf[k] - s[k]).norm_sqr()).sum();
        [hz, (sum / data.pairs.len().max(1) as f64).sqrt()]
    };
    data.hz().into_iter().enumerate().map(line).collect()
}

/// Standard deviation of the measured values, root mean square over the pairs, over frequency.
pub fn noise_spectrum(data: &Data) -> Vec<[f64; 2]> {
    let line = |(k, hz): (usize, f64)| {
        let pairs = data.pairs.iter();
        let sum: f64 = pairs.map(|p| 2.0 / p.weight[k].powi(2)).sum();
        let count = data.correlated * data.pairs.len().max(1) as f64;
        [hz, (sum / count).sqrt()]
    };
    data.hz().into_iter().enumerate().map(line).collect()
}
