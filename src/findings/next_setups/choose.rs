//! The choice: one set-up after the other, each the most telling after those before it.

use super::belief::Belief;
use super::sights::Setting;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// What a set-up mainly tells.
#[derive(Debug, Clone, PartialEq)]
pub enum Tells {
    /// Two places from each other: the magnitude of their correlation falls most.
    Apart {
        /// The sites.
        sites: [String; 2],
        /// Magnitude of the correlation before and after.
        correlation: [f64; 2],
    },
    /// How soft one place is: its spread falls most.
    Size {
        /// The site.
        site: String,
        /// Standard deviation before and after, of the reference compliance.
        std: [f64; 2],
    },
}

/// A chosen set-up.
#[derive(Debug, Clone, PartialEq)]
pub struct Chosen {
    /// The set-up.
    pub setting: Setting,
    /// Information that it brings after those before it, nats.
    pub gain: f64,
    /// What it mainly tells.
    pub tells: Tells,
}

/// A smaller fall of a correlation is no separation.
const NOTICEABLE: f64 = 0.1;

/// How much more a nat about an open direction counts: what a diagnosis asks comes first.
const OPEN: f64 = 5.0;

/// Chooses `count` set-ups; what is known after them comes second. `open`: directions that count
/// more.
pub fn choose(
    belief: &Belief,
    settings: &[Setting],
    rows: &[DMatrix<f64>],
    count: usize,
    open: &[DVector<f64>],
) -> (Vec<Chosen>, Belief) {
    let mut belief = belief.clone();
    let mut taken = vec![false; settings.len()];
    let mut chosen = Vec::new();
    for _ in 0..count.min(settings.len()) {
        let worth = |(i, rows): (usize, &DMatrix<f64>)| match taken[i] {
            true => f64::NEG_INFINITY,
            false => worth(&belief, rows, open),
        };
        let worths: Vec<f64> = rows.par_iter().enumerate().map(worth).collect();
        let Some(best) = first_largest(&worths) else {
            break;
        };
        taken[best] = true;
        let before = belief.clone();
        let gain = belief.expect(&rows[best]);
        chosen.push(Chosen {
            setting: settings[best].clone(),
            gain,
            tells: tells(&before, &belief),
        });
    }
    (chosen, belief)
}

fn first_largest(values: &[f64]) -> Option<usize> {
    let better = |best: Option<usize>, i: usize| match best {
        Some(b) if values[i] <= values[b] => best,
        _ if values[i].is_finite() => Some(i),
        _ => best,
    };
    (0..values.len()).fold(None, better)
}

/// Nats of a set-up, and [`OPEN`] times those about every open direction.
fn worth(belief: &Belief, rows: &DMatrix<f64>, open: &[DVector<f64>]) -> f64 {
    let carried = rows * &belief.covariance;
    let spread = &carried * rows.transpose() + DMatrix::identity(rows.nrows(), rows.nrows());
    let Some(root) = spread.cholesky() else {
        return 0.0;
    };
    let gain: f64 = root.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
    let about = |direction: &DVector<f64>| {
        let before = (direction.transpose() * &belief.covariance * direction)[(0, 0)];
        let seen = &carried * direction;
        let less = seen.dot(&root.solve(&seen));
        -0.5 * (1.0 - less / before).max(1e-12).ln()
    };
    gain + OPEN * open.iter().map(about).sum::<f64>()
}

fn tells(before: &Belief, after: &Belief) -> Tells {
    let n = before.sites.len();
    let pairs = (0..n).flat_map(|i| (0..i).map(move |j| (j, i)));
    let size = |belief: &Belief, (i, j): (usize, usize)| belief.correlation(i, j).abs();
    let fall = |pair: (usize, usize)| size(before, pair) - size(after, pair);
    let best = pairs.max_by(|a, b| fall(*a).total_cmp(&fall(*b)));
    if let Some(pair) = best.filter(|pair| fall(*pair) > NOTICEABLE) {
        return Tells::Apart {
            sites: [before.sites[pair.0].clone(), before.sites[pair.1].clone()],
            correlation: [size(before, pair), size(after, pair)],
        };
    }
    let ratio = |i: &usize| after.std(*i) / before.std(*i).max(1e-300);
    let site = (0..n).min_by(|a, b| ratio(a).total_cmp(&ratio(b)));
    let site = site.unwrap_or(0);
    Tells::Size {
        site: before.sites.get(site).cloned().unwrap_or_default(),
        std: [before.std(site), after.std(site)],
    }
}
