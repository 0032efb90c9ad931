//! Causes that add no straight line: tried at several strengths, and told in between by what these say.

use super::engine::{Blamed, Member, Suspect};
use crate::causes::places::{LARGEST_START, LEAST_EXCESS};
use rayon::prelude::*;

/// A strength of a cause, in ordinary ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strength {
    /// Itself.
    pub value: f64,
    /// Between which amounts the columns of this strength are worth anything; none: anywhere.
    pub within: Option<[f64; 2]>,
}

/// The strength that is tried first, and the excess that it is: less than half as soft again. A choice, no measurement.
pub(super) const FIRST: f64 = 0.15;
/// Strengths at which it is asked whether others are worth a trial: a strong one swings otherwise than a weak one. Two of those that are
/// simulated then.
pub(super) const ASKED: [f64; 2] = [FIRST, 0.6];
/// Strengths at which the readings are simulated: between the softer ones the own frequency of a spring changes by less than a fifth ...
const NODES: [f64; 6] = [-0.3, -0.15, FIRST, 0.35, 0.6, 1.06];
/// ... and by which power of one more they are told in between: each softer than the one before by this factor.
const STEP: f64 = 1.12;
/// Steps to the softest and to the stiffest.
const SOFTER: i32 = 10;
const STIFFER: i32 = 6;
/// How far the amounts may be from the strength of their columns, as a factor. A choice, no measurement.
const REACH: f64 = 1.5;
/// Ordinary strengths that the softest and the stiffest stand for as well: what is found there is milled again.
const ENDS: [f64; 2] = [LEAST_EXCESS / LARGEST_START, 10.0];

impl Strength {
    /// A small one, which stands for any.
    pub fn small(value: f64) -> Self {
        Self {
            value,
            within: None,
        }
    }

    fn of(step: i32) -> Self {
        let value = (STEP.powi(step) - 1.0) / LARGEST_START;
        let ends = within(value);
        Self {
            value,
            within: Some(match step {
                SOFTER => [ends[0], ENDS[1]],
                1 => [0.0, ends[1]],
                -1 => [ends[0], 0.0],
                step if step == -STIFFER => [ENDS[0], ends[1]],
                _ => ends,
            }),
        }
    }

    /// The shape of a member of this strength, of a form.
    pub fn shape(&self, form: f64) -> Vec<f64> {
        let strength = self.within.map(|_| self.value);
        std::iter::once(form).chain(strength).collect()
    }
}

/// Between which amounts the columns of a strength are worth anything.
fn within(strength: f64) -> [f64; 2] {
    let ends = [strength / REACH, strength * REACH];
    [ends[0].min(ends[1]), ends[0].max(ends[1])]
}

/// Strengths at which a cause that adds no straight line is looked for.
pub(super) fn strengths(either_sign: bool) -> Vec<Strength> {
    let stiffer = if either_sign { STIFFER } else { 0 };
    let steps = (-stiffer..=SOFTER).filter(|step| *step != 0);
    steps.map(Strength::of).collect()
}

/// What one ordinary strength would add to the readings, by what each of these does; `changed`: what a strength adds.
pub(super) fn columns(
    strengths: &[Strength],
    changed: impl Fn(f64) -> Vec<f64> + Sync,
) -> Vec<Vec<f64>> {
    let per = |column: &[f64], strength: f64| -> Vec<f64> {
        column.iter().map(|x| x / strength).collect()
    };
    if strengths.iter().all(|s| s.within.is_none()) {
        return strengths
            .iter()
            .map(|s| per(&changed(s.value), s.value))
            .collect();
    }
    let least = strengths.iter().map(|s| s.value).fold(0.0, f64::min);
    let nodes: Vec<f64> = NODES.into_iter().filter(|n| *n > 1.5 * least).collect();
    let tried: Vec<Vec<f64>> = nodes.par_iter().map(|n| changed(*n)).collect();
    // a robot that cannot be milled at one strength is told by the others
    let tried = nodes.into_iter().zip(tried);
    let (nodes, tried): (Vec<f64>, Vec<Vec<f64>>) = tried.filter(|t| !t.1.is_empty()).unzip();
    let told = |s: &Strength| per(&between(&nodes, &tried, s.value), s.value);
    strengths.iter().map(told).collect()
}

/// Of a suspect that is blamed, what it adds about its amounts, to first order; its members end their shapes with the strength that
/// they are of.
pub(super) fn about(suspect: &Suspect, blamed: &Blamed) -> Option<Member> {
    // what was tried at one strength has no strength in its shape
    let (_, form) = blamed
        .shape
        .split_last()
        .filter(|(_, form)| !form.is_empty())?;
    let amounts = blamed.amounts.iter().copied();
    let amount = amounts.max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let strength = |m: &Member| m.shape.last().copied().unwrap_or(0.0);
    let is_own = |m: &&Member| m.shape.split_last().is_some_and(|(_, own)| own == form);
    let mut own: Vec<&Member> = suspect.members.iter().filter(is_own).collect();
    own.sort_by(|a, b| strength(a).total_cmp(&strength(b)));
    let last = own.len().checked_sub(1).filter(|last| *last > 0)?;
    let after = own.partition_point(|m| strength(m) < amount);
    let [a, b] = [0, 1].map(|i| own[after.clamp(1, last) - 1 + i]);
    let [low, high] = [a, b].map(strength);
    let slope = |(x, y): (&f64, &f64)| (high * y - low * x) / (high - low);
    let column = |(x, y): (&Vec<f64>, &Vec<f64>)| x.iter().zip(y).map(slope).collect();
    Some(Member {
        columns: a.columns.iter().zip(&b.columns).map(column).collect(),
        within: Some(within(amount)),
        shape: [form, &[amount]].concat(),
        ..a.clone()
    })
}

/// A member for each of some sizes of a cause, and for the middle between each two; its amount is a size, `usual` ordinary, its
/// shape `form` and its size. `changed`: what a size adds, none where that cannot be told.
pub(super) fn sized(
    sizes: &[f64],
    usual: f64,
    form: &[f64],
    changed: impl Fn(f64) -> Option<Vec<f64>> + Sync,
) -> Vec<Member> {
    let told = sizes.par_iter();
    let told: Vec<(f64, Vec<f64>)> = told.filter_map(|s| Some((*s, changed(*s)?))).collect();
    let middle = |pair: &[(f64, Vec<f64>)]| {
        let columns = pair[0].1.iter().zip(&pair[1].1);
        let column = columns.map(|(a, b)| 0.5 * (a + b)).collect();
        (0.5 * (pair[0].0 + pair[1].0), column)
    };
    let between: Vec<(f64, Vec<f64>)> = told.windows(2).map(middle).collect();
    let member = |(size, column): (f64, Vec<f64>)| Member {
        within: Some(within(size)),
        shape: [form, &[size]].concat(),
        ..Member::given(column.iter().map(|c| c / size).collect(), usual)
    };
    told.into_iter().chain(between).map(member).collect()
}

/// What a strength adds, by what others add: the polynomial through all of them, and nothing at none, of the logarithm of how much
/// softer they are (Lagrange).
fn between(nodes: &[f64], tried: &[Vec<f64>], strength: f64) -> Vec<f64> {
    let place = |strength: f64| (LARGEST_START * strength).ln_1p();
    let places: Vec<f64> = nodes.iter().map(|n| place(*n)).collect();
    let x = place(strength);
    let share = |i: usize| -> f64 {
        let own = places[i];
        let others = places.iter().enumerate().filter(|(j, _)| *j != i);
        let others: f64 = others.map(|(_, p)| (x - p) / (own - p)).product();
        others * x / own
    };
    let mut sum = vec![0.0; tried.iter().map(Vec::len).min().unwrap_or(0)];
    for (i, column) in tried.iter().enumerate() {
        let share = share(i);
        sum.iter_mut()
            .zip(column)
            .for_each(|(s, c)| *s += share * c);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::{about, columns, strengths};
    use crate::findings::engine::{Blamed, Member, Suspect};
    use nalgebra::DMatrix;

    /// About what was found, the column is the slope of what is added there, not the chord from nothing.
    #[test]
    fn about_an_amount_the_slope_there_counts() {
        let member = |strength: f64| Member {
            within: Some([0.0, 1.0]),
            ..Member::given(vec![strength], 1.0).shaped(&[0.0, strength])
        };
        let suspect = Suspect {
            effect: "drive_stiffness",
            site: "A1".into(),
            summary: "",
            mechanism: "",
            share: 0.0,
            members: [0.4, 0.6, 0.2].map(member).to_vec(),
            named: true,
            law_error: 0.0,
            can_be: |_, _| true,
        };
        let blamed = Blamed {
            effect: "drive_stiffness",
            site: "A1".into(),
            shape: vec![0.0, 0.4],
            amounts: vec![0.5],
            covariance: DMatrix::zeros(1, 1),
            part: Vec::new(),
        };
        let found = about(&suspect, &blamed).unwrap();
        // what x adds is x², between 0.4 and 0.6: (0.36 - 0.16) / 0.2
        assert!((found.columns[0][0] - 1.0).abs() < 1e-12);
        assert_eq!(found.shape, [0.0, 0.5]);
        assert!(found.allows(&[0.45]) && !found.allows(&[1.0]) && !found.allows(&[-0.5]));
    }

    /// What is told in between is what is simulated there, of a swing whose frequency follows the spring.
    #[test]
    fn a_swing_is_told_in_between() {
        let swing = |strength: f64| -> Vec<f64> {
            let soft = 1.0 + 2.0 * strength;
            let at = |k: i32| {
                let t = 0.1 * f64::from(k);
                soft * (1.0 - (-0.2 * t).exp() * (t / soft.sqrt()).cos())
            };
            let still = |k: i32| {
                let t = 0.1 * f64::from(k);
                1.0 - (-0.2 * t).exp() * t.cos()
            };
            (0..60).map(|k| at(k) - still(k)).collect()
        };
        for (strength, told) in strengths(true).iter().zip(columns(&strengths(true), swing)) {
            let right = swing(strength.value);
            let most = right.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            for (t, r) in told.iter().zip(&right) {
                assert!((t * strength.value - r).abs() < 0.02 * most, "{strength:?}");
            }
        }
    }
}
