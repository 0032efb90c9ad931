//! Where the descent begins: the angle of the tooth in each cut from its mean revolution, then the
//! coefficients, then which tooth of one cut is which tooth of another, from the runout they show.

use super::CutData;
use super::layout::{Layout, RUNOUT_STD};
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
/// Weight of the runout's prior here: what is left still holds the runout itself.
const PRIOR: f64 = 10.0;
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
            for (k, left) in left.iter().enumerate() {
                let slope = |j: usize| self.predicted.slopes[kinds[j]][at][k];
                total += left * left;
                for a in 0..n {
                    right[a] += slope(a) * left;
                    for b in 0..=a {
                        normal[(a, b)] += slope(a) * slope(b);
                    }
                }
            }
        }
        normal.fill_upper_triangle_with_lower_triangle();
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
    let shown: Vec<Shown> = folded.iter().map(|one| shown(one, &coefficients)).collect();
    let strength = |s: &Shown| s.solution().dot(&s.right);
    let strongest = shown
        .iter()
        .max_by(|a, b| strength(a).total_cmp(&strength(b)));
    let Some(lead) = strongest.map(Shown::solution) else {
        return;
    };
    let pitch = cuts[0].scene.tool.pitch_rad();
    let mut joint = Shown::nothing();
    for (places, own) in layout.of_cut.iter().zip(&shown) {
        let along = |m: &usize| own.turned(*m as f64 * pitch).right.dot(&lead);
        let m = (0..cuts[0].scene.tool.teeth).max_by(|a, b| along(a).total_cmp(&along(b)));
        let turn = m.unwrap_or(0) as f64 * pitch;
        if let Some(place) = places[PHASE] {
            p[place] += turn;
        }
        joint.add(&own.turned(turn));
    }
    let runout = joint.solution();
    for k in 0..2 {
        if let Some(place) = layout.of_cut[0][RUNOUT + k] {
            p[place] = runout[k];
        }
    }
}

/// Turns the names of the teeth of single cuts where that leaves less; true if any was turned.
pub fn improve_teeth(cuts: &[CutData], layout: &Layout, p: &mut [f64]) -> bool {
    let mut any = false;
    for (i, cut) in cuts.iter().enumerate() {
        let Some(place) = layout.of_cut[i][PHASE] else {
            continue;
        };
        let (first, pitch) = (p[place], cut.scene.tool.pitch_rad());
        let mut left = |m: usize| {
            p[place] = first + m as f64 * pitch;
            let predicted = cut.scene.force(&layout.of_one(i, p));
            let pairs = cut.force.iter().zip(&predicted);
            let square = |(a, b): (&V3, &V3)| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>();
            pairs.map(square).sum::<f64>()
        };
        let all: Vec<f64> = (0..cut.scene.tool.teeth).map(&mut left).collect();
        let best = (0..all.len()).min_by(|a, b| all[*a].total_cmp(&all[*b]));
        let best = best.unwrap_or(0);
        p[place] = first + best as f64 * pitch;
        any |= best > 0;
    }
    any
}

/// What a cut shows of the runout by itself: normal equations, the prior apart.
struct Shown {
    normal: DMatrix<f64>,
    right: DVector<f64>,
    prior: f64,
}

impl Shown {
    fn nothing() -> Self {
        Self {
            normal: DMatrix::zeros(2, 2),
            right: DVector::zeros(2),
            prior: 0.0,
        }
    }

    fn solution(&self) -> DVector<f64> {
        let mut normal = self.normal.clone();
        (0..2).for_each(|k| normal[(k, k)] += self.prior);
        solved(normal, &self.right)
    }

    /// The same with tooth 1 a turn further in the sense of rotation.
    fn turned(&self, turn: f64) -> Self {
        let (sin, cos) = turn.sin_cos();
        let back = DMatrix::from_row_slice(2, 2, &[cos, sin, -sin, cos]);
        Self {
            normal: &back * &self.normal * back.transpose(),
            right: &back * &self.right,
            prior: self.prior,
        }
    }

    fn add(&mut self, other: &Self) {
        self.normal += &other.normal;
        self.right += &other.right;
        self.prior = self.prior.max(other.prior);
    }
}

fn shown(one: &Folded, coefficients: &[f64; 6]) -> Shown {
    let left = |f: &V3, at: usize| {
        let model = modelled(one, at, coefficients);
        std::array::from_fn(|k| f[k] - model[k])
    };
    let (normal, right, total) = one.normal(&[RUNOUT, RUNOUT + 1], one.shift, left);
    let readings = 3.0 * one.seen(one.shift).count() as f64;
    Shown {
        normal,
        right,
        prior: PRIOR * total / readings.max(1.0) / RUNOUT_STD.powi(2),
    }
}
