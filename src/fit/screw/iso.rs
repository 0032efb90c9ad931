//! Figures of ISO 230-2 (2014, section 4): means x̄, standard deviations s (n − 1) and reversal values B of
//! the deviations at every target, with the coverage factor k of s: 2, or 3 in the edition of 1988.

use super::positions::Target;

/// The figures, m. None where the readings do not give them.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Figures {
    /// k.
    pub coverage: f64,
    /// Accuracy, both directions: largest x̄ + k s less smallest x̄ − k s.
    pub a: Option<f64>,
    /// Accuracy forward.
    pub a_forward: Option<f64>,
    /// Accuracy backward.
    pub a_backward: Option<f64>,
    /// Repeatability, both directions: largest of k s↑ + k s↓ + |B|, R↑ and R↓ of a target.
    pub r: Option<f64>,
    /// Repeatability forward: largest 2 k s.
    pub r_forward: Option<f64>,
    /// Repeatability backward.
    pub r_backward: Option<f64>,
    /// Reversal value: largest |B| of a target, B = x̄↑ − x̄↓.
    pub b: Option<f64>,
    /// Mean of B, with its sign.
    pub b_mean: Option<f64>,
    /// Systematic error, both directions: largest less smallest x̄ of either direction.
    pub e: Option<f64>,
    /// Systematic error forward.
    pub e_forward: Option<f64>,
    /// Systematic error backward.
    pub e_backward: Option<f64>,
    /// Range of the mean of both directions.
    pub m: Option<f64>,
}

/// Mean and standard deviation of one direction at a target.
type Side = (Option<f64>, Option<f64>);

fn side(deviations: &[f64]) -> Side {
    (Target::middle(deviations), Target::deviation(deviations))
}

impl Figures {
    /// Of all readings at the targets, with the factor `coverage` of s.
    pub fn of(targets: &[Target], coverage: f64) -> Self {
        let forward: Vec<Side> = targets.iter().map(|t| side(&t.forward)).collect();
        let backward: Vec<Side> = targets.iter().map(|t| side(&t.backward)).collect();
        let both = [forward.clone(), backward.clone()].concat();
        let pairs: Vec<(Side, Side)> = forward
            .iter()
            .copied()
            .zip(backward.iter().copied())
            .collect();
        let reversal: Option<Vec<f64>> = pairs.iter().map(|(f, b)| Some(f.0? - b.0?)).collect();
        let middle: Option<Vec<f64>> = pairs
            .iter()
            .map(|(f, b)| Some(0.5 * (f.0? + b.0?)))
            .collect();
        let repeat = |(f, b): &(Side, Side)| {
            let (f, b) = ((f.0?, coverage * f.1?), (b.0?, coverage * b.1?));
            Some(
                (f.1 + b.1 + (f.0 - b.0).abs())
                    .max(2.0 * f.1)
                    .max(2.0 * b.1),
            )
        };
        let repeat: Option<Vec<f64>> = pairs.iter().map(repeat).collect();
        Self {
            coverage,
            a: accuracy(&both, coverage),
            a_forward: accuracy(&forward, coverage),
            a_backward: accuracy(&backward, coverage),
            r: repeat.as_deref().and_then(largest),
            r_forward: repeatability(&forward, coverage),
            r_backward: repeatability(&backward, coverage),
            b: reversal
                .as_deref()
                .and_then(|b| largest(&b.iter().map(|b| b.abs()).collect::<Vec<_>>())),
            b_mean: reversal.as_deref().and_then(Target::middle),
            e: systematic(&both),
            e_forward: systematic(&forward),
            e_backward: systematic(&backward),
            m: middle.as_deref().and_then(range),
        }
    }
}

fn accuracy(sides: &[Side], k: f64) -> Option<f64> {
    let ends: Option<Vec<[f64; 2]>> = sides
        .iter()
        .map(|(x, s)| Some([(*x)? - k * (*s)?, (*x)? + k * (*s)?]))
        .collect();
    range(ends?.as_flattened())
}

fn systematic(sides: &[Side]) -> Option<f64> {
    let means: Option<Vec<f64>> = sides.iter().map(|side| side.0).collect();
    range(&means?)
}

fn repeatability(sides: &[Side], k: f64) -> Option<f64> {
    let all: Option<Vec<f64>> = sides.iter().map(|side| Some(2.0 * k * side.1?)).collect();
    largest(&all?)
}

fn largest(values: &[f64]) -> Option<f64> {
    values.iter().copied().reduce(f64::max)
}

fn range(values: &[f64]) -> Option<f64> {
    Some(largest(values)? - values.iter().copied().reduce(f64::min)?)
}
