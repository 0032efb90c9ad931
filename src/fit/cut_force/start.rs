//! Where the descent begins: the angle of the tooth in each cut from its mean revolution, then the
//! coefficients, then which tooth of one cut is which tooth of another, from the runout they show.

use super::CutData;
use super::layout::Layout;
use crate::experiments::milling_force::{PHASE, Predicted, RUNOUT, UNKNOWNS};
use crate::ground::spatial::V3;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Places of a revolution.
const PLACES: usize = 360;
/// Revolutions that are averaged: few, since the stated speed may be a little off.
const REVOLUTIONS: f64 = 8.0;
/// How often angles and coefficients are improved in turn.
const ROUNDS: usize = 4;
/// Share of a coefficient's information added so that it never blows up.
const RIDGE: f64 = 1e-6;

/// A cut folded onto one revolution, and what it should show there.
struct Folded {
    measured: Vec<Option<V3>>,
    predicted: Predicted,
    shift: usize,
}

/// Values to start from.
pub fn start(cuts: &[CutData], layout: &Layout) -> Vec<f64> {
    let mut p = layout.centre();
    let mut folded: Vec<Folded> = cuts
        .iter()
        .enumerate()
        .map(|(i, c)| fold(c, &layout.of_one(i, &p)))
        .collect();
    let pitch = PLACES / cuts.first().map_or(1, |c| c.scene.tool.teeth);
    for one in &mut folded {
        one.shift = best(pitch, |s| own_misfit(one, s));
    }
    for _ in 0..ROUNDS {
        let coefficients = coefficients(&folded);
        for one in &mut folded {
            one.shift = best(pitch, |s| misfit(one, s, &coefficients));
        }
    }
    p[..6].copy_from_slice(&coefficients(&folded));
    set_phases(&folded, layout, &mut p);
    if layout.of_cut[0][RUNOUT].is_some() {
        agree_on_teeth(cuts, layout, &mut folded, &mut p);
    }
    p
}

fn set_phases(folded: &[Folded], layout: &Layout, p: &mut [f64]) {
    for (one, places) in folded.iter().zip(&layout.of_cut) {
        if let Some(place) = places[PHASE] {
            p[place] = one.shift as f64 * TAU / PLACES as f64;
        }
    }
}

fn best(pitch: usize, misfit: impl Fn(usize) -> f64) -> usize {
    let all = (0..pitch.max(1)).map(|s| (s, misfit(s)));
    all.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |m| m.0)
}

fn fold(cut: &CutData, p: &[f64; UNKNOWNS]) -> Folded {
    let rate = cut.scene.cut.spindle_rad_s;
    let mut sums = vec![([0.0; 3], 0.0); PLACES];
    for (t, f) in cut.scene.time.iter().zip(&cut.force) {
        let turns = rate * t / TAU;
        if turns > REVOLUTIONS {
            break;
        }
        let place = (turns.fract() * PLACES as f64) as usize % PLACES;
        (0..3).for_each(|k| sums[place].0[k] += f[k]);
        sums[place].1 += 1.0;
    }
    let mean = |(sum, n): &(V3, f64)| (*n > 0.0).then(|| sum.map(|v| v / n));
    Folded {
        measured: sums.iter().map(mean).collect(),
        predicted: revolution(cut, p),
        shift: 0,
    }
}

/// One revolution in even steps, tooth 1 at φ = 0 in the middle of the first.
fn revolution(cut: &CutData, p: &[f64; UNKNOWNS]) -> Predicted {
    let mut scene = cut.scene.clone();
    let step = TAU / PLACES as f64 / scene.cut.spindle_rad_s;
    scene.time = (0..PLACES).map(|i| (i as f64 + 0.5) * step).collect();
    let mut p = *p;
    p[PHASE] = 0.0;
    scene.predict(&p)
}

impl Folded {
    /// Measured forces with the place of the revolution that they show under a shift.
    fn seen(&self, shift: usize) -> impl Iterator<Item = (V3, usize)> + '_ {
        let place = move |(i, m): (usize, &Option<V3>)| m.map(|f| (f, (i + shift) % PLACES));
        self.measured.iter().enumerate().filter_map(place)
    }

    /// Normal equations of some slopes against what `of` leaves.
    fn normal(
        &self,
        kinds: &[usize],
        shift: usize,
        left: impl Fn(&V3, usize) -> V3,
    ) -> (DMatrix<f64>, DVector<f64>, f64) {
        let n = kinds.len();
        let (mut normal, mut right) = (DMatrix::zeros(n, n), DVector::zeros(n));
        let mut total = 0.0;
        for (force, at) in self.seen(shift) {
            let left = left(&force, at);
            for k in 0..3 {
                let slope = |j: usize| self.predicted.slopes[kinds[j]][at][k];
                total += left[k] * left[k];
                for a in 0..n {
                    right[a] += slope(a) * left[k];
                    for b in 0..n {
                        normal[(a, b)] += slope(a) * slope(b);
                    }
                }
            }
        }
        (normal, right, total)
    }
}

const COEFFICIENTS: [usize; 6] = [0, 1, 2, 3, 4, 5];

fn solved(mut normal: DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    let scale: Vec<f64> = (0..normal.nrows())
        .map(|j| normal[(j, j)].max(f64::MIN_POSITIVE).sqrt())
        .collect();
    for i in 0..scale.len() {
        for j in 0..scale.len() {
            normal[(i, j)] /= scale[i] * scale[j];
        }
        normal[(i, i)] += RIDGE;
    }
    let scaled = DVector::from_fn(scale.len(), |j, _| right[j] / scale[j]);
    let zero = DVector::zeros(scale.len());
    let solution = normal.cholesky().map_or(zero, |c| c.solve(&scaled));
    DVector::from_fn(scale.len(), |j, _| solution[j] / scale[j])
}

fn own_misfit(one: &Folded, shift: usize) -> f64 {
    let (normal, right, total) = one.normal(&COEFFICIENTS, shift, |f, _| *f);
    let solution = solved(normal.clone(), &right);
    total - 2.0 * solution.dot(&right) + solution.dot(&(normal * &solution))
}

fn coefficients(folded: &[Folded]) -> [f64; 6] {
    let (mut normal, mut right) = (DMatrix::zeros(6, 6), DVector::zeros(6));
    for one in folded {
        let (n, r, _) = one.normal(&COEFFICIENTS, one.shift, |f, _| *f);
        normal += n;
        right += r;
    }
    let solution = solved(normal, &right);
    std::array::from_fn(|j| solution[j])
}

fn modelled(one: &Folded, at: usize, coefficients: &[f64; 6]) -> V3 {
    let of = |k: usize| {
        let part = |j: usize| coefficients[j] * one.predicted.slopes[j][at][k];
        (0..6).map(part).sum()
    };
    std::array::from_fn(of)
}

fn misfit(one: &Folded, shift: usize, coefficients: &[f64; 6]) -> f64 {
    let off = |(force, at): (V3, usize)| {
        let model = modelled(one, at, coefficients);
        (0..3).map(|k| (force[k] - model[k]).powi(2)).sum::<f64>()
    };
    one.seen(shift).map(off).sum()
}

/// Turns the names of the teeth in every cut until their runouts point one way.
fn agree_on_teeth(cuts: &[CutData], layout: &Layout, folded: &mut [Folded], p: &mut [f64]) {
    let coefficients: [f64; 6] = std::array::from_fn(|j| p[j]);
    for (i, one) in folded.iter_mut().enumerate() {
        one.predicted = revolution(&cuts[i], &layout.of_one(i, p));
    }
    let shown: Vec<([f64; 2], f64)> = folded.iter().map(|one| shown(one, &coefficients)).collect();
    let strongest = |a: &&([f64; 2], f64), b: &&([f64; 2], f64)| a.1.total_cmp(&b.1);
    let Some((lead, _)) = shown.iter().max_by(strongest).copied() else {
        return;
    };
    let teeth = cuts[0].scene.tool.teeth;
    let turned = |v: [f64; 2], m: usize| {
        let (sin, cos) = (TAU * m as f64 / teeth as f64).sin_cos();
        [v[0] * cos + v[1] * sin, v[1] * cos - v[0] * sin]
    };
    let (mut sum, mut weight) = ([0.0; 2], 0.0);
    for (i, (own, strength)) in shown.iter().enumerate() {
        let along = |m: &usize| {
            let v = turned(*own, *m);
            v[0] * lead[0] + v[1] * lead[1]
        };
        let m = (0..teeth).max_by(|a, b| along(a).total_cmp(&along(b)));
        let m = m.unwrap_or(0);
        if let Some(place) = layout.of_cut[i][PHASE] {
            p[place] += TAU * m as f64 / teeth as f64;
        }
        let v = turned(*own, m);
        (0..2).for_each(|k| sum[k] += strength * v[k]);
        weight += strength;
    }
    for k in 0..2 {
        if let Some(place) = layout.of_cut[0][RUNOUT + k] {
            p[place] = sum[k] / weight.max(f64::MIN_POSITIVE);
        }
    }
}

/// The runout that a cut shows by itself, and how strongly.
fn shown(one: &Folded, coefficients: &[f64; 6]) -> ([f64; 2], f64) {
    let left = |f: &V3, at: usize| {
        let model = modelled(one, at, coefficients);
        std::array::from_fn(|k| f[k] - model[k])
    };
    let (normal, right, _) = one.normal(&[RUNOUT, RUNOUT + 1], one.shift, left);
    let solution = solved(normal, &right);
    ([solution[0], solution[1]], solution.dot(&right).max(1e-30))
}
