//! How many modes: those of the stabilisation that pay, split or joined by others where the rest
//! still has structure, and without those that do not pay.

use super::modal_fit::{Fit, Task};
use super::modal_grid::Grid;
use super::modal_model::{damping, frequency};
use super::modal_structure::Structure;
use super::stabilisation::Candidate;
use nalgebra::{DMatrix, DVector};
use rustfft::num_complex::Complex64;

/// Most candidates of the stabilisation that are tried.
const MOST: usize = 40;
/// Most modes added one by one.
const ADDED: usize = 10;
/// Places tried per added mode.
const TRIES: usize = 3;
/// Highest damping ratio of any mode, also of those far above the band.
const MOST_DAMPED: f64 = 0.95;
/// Factor on the diagonal that holds a parameter.
const HELD: f64 = 1e6;
/// A mode is doubtful if its worth to first order would not pay for so many times its parameters.
const DOUBT: isize = 3;
/// Least gain of a mode fitted alone, in units of the criterion, for which all are refined with it.
const ALONE: f64 = 12.0;
/// Most steps and least gain per step of the last refinement, and of one during the search.
const LAST: (usize, f64) = (40, 1e-7);
const QUICK: (usize, f64) = (12, 3e-4);

/// The structure that the data support: reciprocal where that is possible and enough.
pub fn search(task: &Task, found: &[Candidate]) -> Fit {
    let poles = start(task, found);
    let empty = task.empty();
    let structure = task.with_poles(&poles, empty);
    let fit = task.refine(structure, QUICK);
    let fit = prune(task, grow(task, fit));
    let fit = tight(task, &fit).unwrap_or(fit);
    task.refine(fit.structure, LAST)
}

/// The fit with hammer and sensor in the same directions and of the same gain, if that is enough.
fn tight(task: &Task, fit: &Fit) -> Option<Fit> {
    let mut structure = fit.structure.clone();
    let (mixing, _) = structure.tie.as_mut()?;
    let gain = mixing[(0, 0)].abs();
    let signs = mixing.diagonal().map(|v| gain * v.signum());
    *mixing = DMatrix::from_diagonal(&signs);
    structure.loose = false;
    let tight = task.refine(structure, QUICK);
    let fewer = fit.structure.paid() as isize - tight.structure.paid() as isize;
    (!task.pays(tight.cost, fit.cost, fewer)).then_some(tight)
}

/// Takes candidates in the order of how often they were seen, as long as they lower the criterion
/// with free residues.
fn start(task: &Task, found: &[Candidate]) -> Vec<Complex64> {
    let most = found.first().map_or(0, |candidate| candidate.seen);
    let often = found.iter().filter(|c| c.seen * 6 >= most && c.seen > 2);
    let mut rest = task.target.clone();
    let mut spans: Vec<Vec<DVector<f64>>> = vec![Vec::new(); rest.len()];
    let mut chosen = Vec::new();
    let free = 2 + 2 * rest.len();
    for candidate in often.take(MOST) {
        if chosen.iter().any(|other| overlaps(candidate.pole, *other)) {
            continue;
        }
        let before: f64 = rest.iter().map(DVector::norm_squared).sum();
        let columns = added(task, &spans, candidate.pole);
        let gain: f64 = columns
            .iter()
            .zip(&rest)
            .flat_map(|(columns, rest)| columns.iter().map(|q| q.dot(rest).powi(2)))
            .sum();
        if task.pays(before, before - gain, free as isize) {
            chosen.push(candidate.pole);
            for ((span, rest), columns) in spans.iter_mut().zip(&mut rest).zip(columns) {
                columns.iter().for_each(|q| *rest -= q * q.dot(rest));
                span.extend(columns);
            }
        }
    }
    chosen
}

/// Whether two poles lie within half their decay rates: which of such candidates are modes shows
/// only when shapes are fitted too.
fn overlaps(a: Complex64, b: Complex64) -> bool {
    (a - b).norm() < 0.5 * a.re.abs().max(b.re.abs())
}

/// Orthonormal columns that a pole adds to the span of every channel.
fn added(task: &Task, spans: &[Vec<DVector<f64>>], pole: Complex64) -> Vec<Vec<DVector<f64>>> {
    let poles_columns = task.columns(&[pole]);
    let of = |(c, span): (usize, &Vec<DVector<f64>>)| {
        let basis = task.basis(c, &poles_columns, false);
        let mut new: Vec<DVector<f64>> = Vec::new();
        for column in basis.column_iter() {
            let size = column.norm();
            let mut column = column.into_owned();
            for q in span.iter().chain(&new) {
                column -= q * q.dot(&column);
            }
            let left = column.norm();
            if left > 1e-6 * size {
                new.push(column / left);
            }
        }
        new
    };
    spans.iter().enumerate().map(of).collect()
}

/// Adds modes where most is left, as long as they pay once all are refined together. A mode beside
/// another one splits it.
fn grow(task: &Task, mut fit: Fit) -> Fit {
    let grid = Grid::new(task);
    for _ in 0..ADDED {
        let rest = task.rest(&fit.structure);
        let places = grid.best(&fit.structure, &rest, TRIES);
        let mut more = places
            .into_iter()
            .map(|(pole, residue)| with(task, &fit, &rest, pole, &residue));
        match more.find_map(|more| more) {
            Some(more) => fit = more,
            None => break,
        }
    }
    fit
}

/// The fit with one more mode, if it pays: it is refined alone first, then with the others.
fn with(
    task: &Task,
    fit: &Fit,
    rest: &[DVector<f64>],
    pole: Complex64,
    residue: &[Complex64],
) -> Option<Fit> {
    let alone = Structure {
        poles: vec![pole],
        shapes: vec![fit.structure.shape(residue)],
        loose: false,
        ..fit.structure.clone()
    };
    let alone = task.of_rest(rest).refine(alone, QUICK).structure;
    let gain = (fit.cost / task.of_rest(rest).fit(alone.clone()).cost).ln();
    if gain * task.values() / task.correlated() < ALONE {
        return None;
    }
    let mode = (alone.poles[0], alone.shapes[0].clone());
    let more = task.refine(fit.structure.with(mode.0, mode.1), QUICK);
    let new = more.structure.paid() as isize - fit.structure.paid() as isize;
    let sound = more
        .structure
        .poles
        .iter()
        .all(|p| damping(*p) < MOST_DAMPED);
    (sound && task.pays(fit.cost, more.cost, new)).then_some(more)
}

/// Drops modes that do not pay.
fn prune(task: &Task, mut fit: Fit) -> Fit {
    while let Some(less) = weakest(task, &fit) {
        fit = less;
    }
    fit
}

/// The fit without one of the modes that are missed least, if that does not pay.
fn weakest(task: &Task, fit: &Fit) -> Option<Fit> {
    let worth = task.worth(&fit.structure)?;
    let new = fit.structure.per_mode() as isize;
    let doubtful = |r: &usize| !task.pays(fit.cost + worth[*r], fit.cost, DOUBT * new);
    let mut order: Vec<usize> = (0..worth.len()).filter(doubtful).collect();
    order.sort_by(|a, b| worth[*a].total_cmp(&worth[*b]));
    let mut less = order.into_iter().take(TRIES).map(|r| without(task, fit, r));
    less.find_map(|less| less)
}

/// The fit without mode `r`, if the mode does not pay.
fn without(task: &Task, fit: &Fit, r: usize) -> Option<Fit> {
    let less = fit.structure.without(r);
    let empty = Structure {
        poles: Vec::new(),
        shapes: Vec::new(),
        ..less.clone()
    };
    let anew = task.with_poles(&less.poles, empty.clone());
    let joined = task.with_poles(&joined(&less.poles, fit.structure.poles[r]), empty);
    let start = [less, anew, joined].map(|s| task.fit(s));
    let start = start.into_iter().min_by(|a, b| a.cost.total_cmp(&b.cost))?;
    let less = task.refine(start.structure, QUICK);
    let new = fit.structure.paid() as isize - less.structure.paid() as isize;
    (!task.pays(less.cost, fit.cost, new)).then_some(less)
}

/// The poles, the nearest of them moved half way to `gone`.
fn joined(poles: &[Complex64], gone: Complex64) -> Vec<Complex64> {
    let mut poles = poles.to_vec();
    let distance = |p: &Complex64| (p - gone).norm();
    let nearest = poles
        .iter_mut()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)));
    if let Some(nearest) = nearest {
        *nearest = (*nearest + gone) / 2.0;
    }
    poles
}

impl Task<'_> {
    /// Whether going from cost `before` to `after` pays for `new` parameters by Schwarz's criterion
    /// (1978), `n·ln(cost) + k·ln n`. An exponential window correlates `x·coth x` lines, `x = στ`:
    /// only n of N values are independent.
    pub fn pays(&self, before: f64, after: f64, new: isize) -> bool {
        let n = self.values() / self.correlated();
        n * (after / before).ln() + new as f64 * n.ln() < 0.0
    }

    /// By how much the cost would rise without the shape of each mode, to first order
    /// (Wald 1943); nothing for a mode that cannot be told from its neighbours.
    fn worth(&self, structure: &Structure) -> Option<Vec<f64>> {
        let mut normal = self.normal(structure, &self.rest(structure));
        for scale in structure.scales() {
            normal.matrix[(scale, scale)] *= HELD;
        }
        let inverse = normal.inverse()?;
        let (size, shape) = (structure.per_mode(), 2 * structure.outputs);
        let of = |r: usize| {
            let at = r * size + 2;
            let block = inverse.view((at, at), (shape, shape)).into_owned();
            let values = structure.shapes[r][0].iter();
            let values = DVector::from_vec(values.flat_map(|v| [v.re, v.im]).collect());
            let factor = block.cholesky();
            factor.map_or(0.0, |f| values.dot(&f.solve(&values)))
        };
        Some((0..structure.modes()).map(of).collect())
    }

    /// Number of real values.
    pub fn values(&self) -> f64 {
        (2 * self.channels.lines() * self.channels.frf.len()) as f64
    }

    /// How many lines the exponential window correlates.
    pub fn correlated(&self) -> f64 {
        let x = (self.channels.rate * self.channels.decay_s).max(1e-6);
        x / x.tanh()
    }
}

/// Whether two poles may be the same.
pub fn near(a: Complex64, b: Complex64) -> bool {
    (frequency(a) / frequency(b) - 1.0).abs() < 0.1
}
