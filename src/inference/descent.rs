//! The least-squares descent of all fits (modes of spectra, floors below, keep their own): Levenberg (1944) and
//! Marquardt (1963) in Moré's form (1978), unknowns held where they push against a bound. What is minimised,
//! and what a place of it knows, is the caller's; a prior is a row like any other.

use nalgebra::{DMatrix, DVector};

/// The normal equations at a place, in unknowns of order one.
#[derive(Debug, Clone)]
pub struct Linear {
    /// JᵀJ, n × n.
    pub normal: DMatrix<f64>,
    /// Jᵀr, reading less model: downhill.
    pub slope: DVector<f64>,
}

/// What is minimised.
pub trait Landscape {
    /// Unknowns with what was worked out at them.
    type Place;

    /// What is to be lowered: the sum of squares there, or half of it.
    fn height(&self, place: &Self::Place) -> f64;

    /// The normal equations there; `None` where the model has none.
    fn linear(&self, place: &mut Self::Place) -> Option<Linear>;

    /// The place so far away, as near as bounds let; `None` where the model cannot be.
    fn step(&self, from: &Self::Place, step: &DVector<f64>) -> Option<Self::Place>;

    /// Whether unknown `i` stands on a bound that a step of the sign of `slope` would cross.
    fn held(&self, _at: &Self::Place, _i: usize, _slope: f64) -> bool {
        false
    }
}

/// When a descent ends: after so many steps, or once one lowers the sum of squares by no more than this.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Most steps.
    pub steps: usize,
    /// Least fall.
    pub gain: f64,
    /// Least fall as a share of the sum.
    pub share: f64,
    /// It ends before an unbraked step that promises no more by its slope, which is twice what half a sum of squares falls by.
    pub promise: f64,
}

impl Stop {
    /// After `steps`, or once a step lowers the sum by less than this share of it.
    pub const fn at_share(steps: usize, share: f64) -> Self {
        Self {
            steps,
            gain: 0.0,
            share,
            promise: 0.0,
        }
    }
}

impl Default for Stop {
    fn default() -> Self {
        Self::at_share(60, 1e-9)
    }
}

/// The brake at the start, what a good and a bad step make of it, its least value, and where no step is
/// looked for any more (Marquardt 1963).
const BRAKE: f64 = 1e-3;
const LOOSEN: f64 = 0.1;
const TIGHTEN: f64 = 10.0;
const LEAST: f64 = 1e-10;
const STUCK: f64 = 1e10;
/// A diagonal entry counts as no less than this share of the largest: an unknown that nothing shows stays.
const FAINT: f64 = 1e-12;

/// Goes down from `start`; the lowest place seen.
pub fn descend<L: Landscape>(landscape: &L, start: L::Place, stop: Stop) -> L::Place {
    let mut here = start;
    let mut brake = BRAKE;
    for _ in 0..stop.steps {
        let before = landscape.height(&here);
        let Some(linear) = landscape.linear(&mut here) else {
            break;
        };
        let Some(lower) = lower(landscape, &here, (&linear, stop.promise), &mut brake) else {
            break;
        };
        here = lower;
        brake = (brake * LOOSEN).max(LEAST);
        if before - landscape.height(&here) <= stop.gain.max(stop.share * before) {
            break;
        }
    }
    here
}

/// A lower place, the brake tightened until there is one; none where an unbraked step promises no more than `least`.
fn lower<L: Landscape>(
    landscape: &L,
    here: &L::Place,
    (linear, least): (&Linear, f64),
    brake: &mut f64,
) -> Option<L::Place> {
    let height = landscape.height(here);
    let held = |i: &usize| landscape.held(here, *i, linear.slope[*i]);
    let free: Vec<usize> = (0..linear.slope.len()).filter(|i| !held(i)).collect();
    while *brake < STUCK && !free.is_empty() {
        let step = braked(linear, &free, *brake);
        let promised = step.as_ref().map(|step| step.dot(&linear.slope));
        if *brake <= BRAKE && promised.is_some_and(|promised| promised <= least) {
            return None;
        }
        let trial = step.and_then(|step| landscape.step(here, &step));
        if let Some(place) = trial.filter(|place| landscape.height(place) < height) {
            return Some(place);
        }
        *brake *= TIGHTEN;
    }
    None
}

/// (JᵀJ + λ diag JᵀJ)⁻¹ Jᵀr over the free unknowns, nothing for the others.
fn braked(linear: &Linear, free: &[usize], brake: f64) -> Option<DVector<f64>> {
    let faint = FAINT * linear.normal.diagonal().max();
    let damped = DMatrix::from_fn(free.len(), free.len(), |i, j| {
        let entry = linear.normal[(free[i], free[j])];
        match i == j {
            true => entry + brake * entry.max(faint) + f64::MIN_POSITIVE,
            false => entry,
        }
    });
    let right = DVector::from_fn(free.len(), |i, _| linear.slope[free[i]]);
    let solved = damped.cholesky()?.solve(&right);
    let mut step = DVector::zeros(linear.slope.len());
    let parts = free.iter().zip(solved.iter());
    parts.for_each(|(i, part)| step[*i] = *part);
    Some(step)
}

/// Whether a value on a bound is pushed against it.
pub fn pushed(value: f64, [low, high]: [f64; 2], slope: f64) -> bool {
    (value <= low && slope < 0.0) || (value >= high && slope > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley (1960), with the first unknown held below `top`.
    struct Valley {
        top: f64,
    }

    impl Landscape for Valley {
        type Place = [f64; 2];

        fn height(&self, [x, y]: &[f64; 2]) -> f64 {
            100.0 * (y - x * x).powi(2) + (1.0 - x).powi(2)
        }

        fn linear(&self, [x, y]: &mut [f64; 2]) -> Option<Linear> {
            let slopes = DMatrix::from_row_slice(2, 2, &[-20.0 * *x, 10.0, -1.0, 0.0]);
            let left = DVector::from_vec(vec![-10.0 * (*y - *x * *x), *x - 1.0]);
            Some(Linear {
                normal: slopes.tr_mul(&slopes),
                slope: slopes.tr_mul(&left),
            })
        }

        fn step(&self, [x, y]: &[f64; 2], step: &DVector<f64>) -> Option<[f64; 2]> {
            Some([(x + step[0]).min(self.top), y + step[1]])
        }

        fn held(&self, at: &[f64; 2], i: usize, slope: f64) -> bool {
            i == 0 && pushed(at[0], [f64::NEG_INFINITY, self.top], slope)
        }
    }

    #[test]
    fn the_valley_is_walked_to_its_end() {
        let found = descend(&Valley { top: 5.0 }, [-1.2, 1.0], Stop::default());
        assert!((found[0] - 1.0).abs() < 1e-6 && (found[1] - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_bound_holds() {
        let found = descend(&Valley { top: 0.5 }, [-1.2, 1.0], Stop::default());
        assert!(found[0] == 0.5 && (found[1] - 0.25).abs() < 1e-6);
    }
}
