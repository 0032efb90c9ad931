//! What the uncertainty of springs and coefficients makes of the deviation at one station.
//!
//! Linearised: every spring and every coefficient is moved by one standard deviation, the part is
//! milled again with springs only, and the changes at the station are summed as independent.

use super::setup::{Setup, Support};
use crate::ground::problem::Outcome;
use crate::ground::spatial::{V3, dot, norm, scale, sub};
use crate::robot::Robot;
use rayon::prelude::*;

/// One number that is not known exactly.
#[derive(Debug, Clone, PartialEq)]
pub struct Doubt {
    /// Its name: `stiffness`, `Ktc`.
    pub name: String,
    /// Its site: `A2-tilt`; the material's for coefficients.
    pub site: String,
    /// Relative standard deviation.
    pub rel_std: f64,
    which: Which,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Which {
    Spring(usize),
    Coefficient(usize),
}

/// Half of a 95 % interval in standard deviations.
pub const NORMAL95: f64 = 1.959_964;

/// Everything whose uncertainty is stated: springs with intervals, and coefficients with these relative
/// standard deviations (`None`: not stated).
pub fn doubts(robot: &Robot, setup: &Setup, coefficients: &[Option<f64>]) -> Vec<Doubt> {
    let springs = robot
        .springs()
        .enumerate()
        .filter_map(|(i, (site, spring))| {
            let [low, high] = spring.ci95.stiffness?;
            let rel_std = (high - low) / (2.0 * NORMAL95 * spring.stiffness);
            Some(Doubt {
                name: "stiffness".into(),
                site,
                rel_std,
                which: Which::Spring(i),
            })
        });
    let card = setup.material.law.card();
    let coefficients = card.coefficients.iter().zip(coefficients).enumerate();
    let coefficients = coefficients.filter_map(|(i, (card, rel_std))| {
        Some(Doubt {
            name: card.name.into(),
            site: "material".into(),
            rel_std: (*rel_std)?,
            which: Which::Coefficient(i),
        })
    });
    springs
        .chain(coefficients)
        .filter(|d| d.rel_std > 0.0)
        .collect()
}

impl Doubt {
    /// The same job with this number one standard deviation larger.
    pub fn moved(&self, setup: &Setup) -> Setup {
        let mut setup = setup.clone();
        let factor = 1.0 + self.rel_std;
        match self.which {
            Which::Spring(i) => {
                if let Some((_, spring)) = setup.robot.springs_mut().nth(i) {
                    spring.stiffness *= factor;
                }
            }
            Which::Coefficient(i) => setup.material.coefficients[i] *= factor,
        }
        setup
    }
}

/// Changes of the deviation at some times (s) by one standard deviation of each doubt: one list per
/// doubt, m, workpiece frame.
///
/// # Errors
/// As the runs.
pub fn changes(setup: &Setup, doubts: &[Doubt], times: &[f64]) -> Outcome<Vec<Vec<V3>>> {
    let deviations = |setup: &Setup| -> Outcome<Vec<V3>> {
        let (out, _) = setup.run(Support::Static, |_| {})?;
        Ok(times.iter().map(|t| out.deviation_at(*t)).collect())
    };
    let runs = (0..=doubts.len()).into_par_iter().map(|i| match i {
        0 => deviations(setup),
        _ => deviations(&doubts[i - 1].moved(setup)),
    });
    let runs = runs
        .collect::<Vec<_>>()
        .into_iter()
        .collect::<Outcome<Vec<_>>>()?;
    let change = |moved: &Vec<V3>| {
        let pairs = moved.iter().zip(&runs[0]);
        pairs.map(|(a, b)| sub(*a, *b)).collect()
    };
    Ok(runs[1..].iter().map(change).collect())
}

/// Standard deviation of the length of `vector` at station `i`.
pub fn spread(changes: &[Vec<V3>], i: usize, vector: V3) -> f64 {
    let size = norm(vector);
    if size == 0.0 {
        return 0.0;
    }
    let along = scale(1.0 / size, vector);
    let squares = changes
        .iter()
        .map(|c| c.get(i).map_or(0.0, |v| dot(*v, along).powi(2)));
    squares.sum::<f64>().sqrt()
}
