//! Where causes fit best that change the forces along no straight line: amounts of all that were found and all that is merely
//! uncertain, together, by the slopes of the forces where they stand.

use super::aim::Loose;
use super::anew::{add_to, combined, map};
use super::setting::PROCESS;
use super::{Case, EFFECTS, chipped_tooth, engagement, runout, sensor_resonance};
use crate::findings::engine::{Arrival, Blamed, Noise};
use crate::ground::products::gram;
use crate::ground::spatial::{M3, rotate};
use crate::inference::descent::{Landscape, Linear, Stop, descend};
use crate::inference::gaussian::Reading;
use nalgebra::{DMatrix, DVector, Matrix3};

/// Effects whose amounts change the forces along no straight line.
pub(super) const BENT: [&str; 4] = [
    engagement::WIDTH.name,
    engagement::DEPTH.name,
    chipped_tooth::EFFECT.name,
    runout::EFFECT.name,
];

/// When it has arrived.
const STOP: Stop = Stop {
    gain: 0.02,
    promise: 0.02,
    ..Stop::at_share(12, 0.0)
};

/// What moves.
enum Unknown {
    /// What is uncertain although nothing is wrong: how far it goes, with its spread before the data.
    Loose(Vec<f64>, f64),
    /// An amount of a cause of the process: its direction.
    Process(Vec<f64>),
    /// All amounts of another cause, in proportion.
    Share,
}

/// A file with the causes that were found in it.
struct Arriving<'a> {
    case: &'a Case,
    found: &'a [Blamed],
    noise: Box<dyn Noise>,
    unknowns: Vec<Unknown>,
    /// Of every amount of the unknowns: the cause and which of its amounts.
    owners: Vec<Option<(usize, usize)>>,
    /// Whether the causes stay as they were found.
    holds: bool,
}

/// How far everything has gone, what the forces are there, and what is left, in noise deviations.
struct Stand {
    amounts: Vec<f64>,
    case: Case,
    left: DVector<f64>,
    /// Units of the amounts in the descent.
    units: DVector<f64>,
}

/// The bent ones of the causes that were found, where they fit best beside all others. None: nothing is bent, or a sensor rings, whose
/// frequency is no amount.
pub(super) fn arrived(case: &Case, found: &[Blamed]) -> Vec<Arrival> {
    let is_bent = |b: &Blamed| BENT.contains(&b.effect);
    let rings = found
        .iter()
        .any(|b| sensor_resonance::resonant(b).is_some());
    if rings || !found.iter().any(is_bent) {
        return Vec::new();
    }
    let mut arriving = Arriving::new(case, found);
    let Some(start) = arriving.stand(arriving.start()) else {
        return Vec::new();
    };
    // what is uncertain first: beside angles that are off, a cause would go astray
    arriving.holds = true;
    let start = descend(&arriving, start, STOP);
    arriving.holds = false;
    let end = descend(&arriving, start, STOP);
    let Some(covariance) = arriving.covariance(&end) else {
        return Vec::new();
    };
    let numbers = (0..found.len()).filter(|n| is_bent(&found[*n]));
    numbers
        .filter_map(|n| arriving.arrival(n, &end, &covariance))
        .collect()
}

impl<'a> Arriving<'a> {
    fn new(case: &'a Case, found: &'a [Blamed]) -> Self {
        let loose = case.loose_beside(found);
        let places = case.places();
        let mut unknowns: Vec<Unknown> = loose
            .iter()
            .map(|l: &Loose| Unknown::Loose(l.direction(places), l.spread))
            .collect();
        let mut owners = vec![None; unknowns.len()];
        for (n, cause) in found.iter().enumerate() {
            let own: Vec<Unknown> = match cause.shape[0] == PROCESS {
                true => cause.shape[1..]
                    .chunks(places.len())
                    .map(|direction| Unknown::Process(direction.to_vec()))
                    .collect(),
                false => vec![Unknown::Share],
            };
            owners.extend((0..own.len()).map(|k| Some((n, k))));
            unknowns.extend(own);
        }
        Self {
            noise: case.noise_of_rows(),
            case,
            found,
            unknowns,
            owners,
            holds: false,
        }
    }

    /// Where the causes are as they were found.
    fn start(&self) -> Vec<f64> {
        let of = |owner: &Option<(usize, usize)>| match owner {
            None => 0.0,
            Some((n, k)) if self.found[*n].shape[0] == PROCESS => self.found[*n].amounts[*k],
            Some(_) => 1.0,
        };
        self.owners.iter().map(of).collect()
    }

    /// The causes of these amounts.
    fn causes(&self, amounts: &[f64]) -> Vec<Blamed> {
        let mut causes = self.found.to_vec();
        for (owner, amount) in self.owners.iter().zip(amounts) {
            match owner {
                Some((n, k)) if causes[*n].shape[0] == PROCESS => causes[*n].amounts[*k] = *amount,
                Some((n, _)) => {
                    causes[*n].amounts.iter_mut().for_each(|a| *a *= amount);
                    causes[*n].part.iter_mut().for_each(|p| *p *= amount);
                }
                None => {}
            }
        }
        causes
    }

    /// The forces of these amounts; none where a cause cannot be of them.
    fn stand(&self, amounts: Vec<f64>) -> Option<Stand> {
        let causes = self.causes(&amounts);
        causes.iter().all(is_possible).then(|| {
            let mut by = vec![0.0; self.case.places().len()];
            for (unknown, amount) in self.unknowns.iter().zip(&amounts) {
                if let Unknown::Loose(direction, _) = unknown {
                    add_to(&mut by, direction, *amount);
                }
            }
            let case = combined(self.case, &by, &causes, "");
            let left = DVector::from_vec(self.noise.whiten(&case.reading()));
            Stand {
                units: DVector::from_element(amounts.len(), 1.0),
                amounts,
                case,
                left,
            }
        })
    }

    /// What one unit of an unknown adds there.
    fn slope(&self, number: usize, stand: &Stand) -> Vec<f64> {
        match &self.unknowns[number] {
            Unknown::Loose(direction, _) | Unknown::Process(direction) => {
                stand.case.along(direction)
            }
            Unknown::Share => {
                let cause = self.owners[number].map(|(n, _)| &self.found[n]);
                cause.map_or_else(Vec::new, |cause| match map(cause) {
                    Some(map) => mapped(&stand.case, &map),
                    None => cause.part.clone(),
                })
            }
        }
    }

    /// Amounts of the bent cause of this number where it stands.
    fn arrival(&self, n: usize, end: &Stand, covariance: &DMatrix<f64>) -> Option<Arrival> {
        let own = |owner: &&(usize, Option<(usize, usize)>)| owner.1.is_some_and(|o| o.0 == n);
        let numbered: Vec<(usize, Option<(usize, usize)>)> =
            self.owners.iter().copied().enumerate().collect();
        let at: Vec<usize> = numbered.iter().filter(own).map(|(at, _)| *at).collect();
        let blamed = Blamed {
            covariance: DMatrix::from_fn(at.len(), at.len(), |i, j| covariance[(at[i], at[j])]),
            ..self.causes(&end.amounts).swap_remove(n)
        };
        let size = |b: &Blamed| b.amounts.iter().map(|a| a * a).sum::<f64>().sqrt();
        let grown = size(&blamed) / size(&self.found[n]);
        let effect = EFFECTS.iter().find(|e| e.name == blamed.effect)?;
        (LIKE.recip()..LIKE).contains(&grown).then_some(Arrival {
            law_error: effect.law_error,
            can_be: effect.can_be,
            rows: self.noise.rows() + end.left.len() as f64,
            blamed,
        })
    }

    /// Of all amounts, by the noise that is left.
    fn covariance(&self, end: &Stand) -> Option<DMatrix<f64>> {
        let (normal, _) = self.normal(end);
        let inverse = normal.cholesky()?.inverse();
        let reading = Reading {
            square: end.left.norm_squared(),
            rows: end.left.len() as f64,
            noise_rows: self.noise.rows(),
        };
        let variance = reading.noise_variance(reading.square);
        Some(inverse * variance)
    }

    fn normal(&self, stand: &Stand) -> (DMatrix<f64>, DVector<f64>) {
        let columns: Vec<DVector<f64>> = (0..self.unknowns.len())
            .map(|k| DVector::from_vec(self.noise.whiten(&self.slope(k, stand))))
            .collect();
        let columns = DMatrix::from_columns(&columns);
        let (mut normal, mut slope) = (gram(&columns), columns.tr_mul(&stand.left));
        for (k, unknown) in self.unknowns.iter().enumerate() {
            if let Unknown::Loose(_, spread) = unknown {
                let weight = (spread * spread).recip();
                normal[(k, k)] += weight + TOUCH * normal[(k, k)];
                slope[k] -= weight * stand.amounts[k];
            }
        }
        (normal, slope)
    }
}

/// Times by which an amount may differ from the one that was found: one that is farther off has gone elsewhere. A choice; chords of cuts by
/// strangers were a third off.
const LIKE: f64 = 2.0;

/// Share by which what shows of something uncertain weighs more than it does: two that are one do no harm.
const TOUCH: f64 = 1e-10;

impl Landscape for Arriving<'_> {
    type Place = Stand;

    fn height(&self, place: &Stand) -> f64 {
        let priors = self.unknowns.iter().zip(&place.amounts);
        let priors = priors.map(|(unknown, amount)| match unknown {
            Unknown::Loose(_, spread) => (amount / spread).powi(2),
            _ => 0.0,
        });
        place.left.norm_squared() + priors.sum::<f64>()
    }

    /// In unknowns of which one changes what is left by one.
    fn linear(&self, place: &mut Stand) -> Option<Linear> {
        let (normal, slope) = self.normal(place);
        place.units = normal
            .diagonal()
            .map(|n| if n > 0.0 { n.sqrt().recip() } else { 0.0 });
        Some(Linear {
            normal: DMatrix::from_fn(normal.nrows(), normal.ncols(), |i, j| {
                normal[(i, j)] * place.units[i] * place.units[j]
            }),
            slope: slope.component_mul(&place.units),
        })
    }

    fn held(&self, _at: &Stand, i: usize, _slope: f64) -> bool {
        self.holds && self.owners[i].is_some()
    }

    fn step(&self, from: &Stand, step: &DVector<f64>) -> Option<Stand> {
        let step = step.component_mul(&from.units);
        let amounts = from.amounts.iter().zip(step.iter());
        self.stand(amounts.map(|(a, s)| a + s).collect())
    }
}

/// Whether a cause can be of its amounts: a tooth that is broken is shorter.
fn is_possible(cause: &Blamed) -> bool {
    let own = EFFECTS.iter().find(|e| e.name == cause.effect);
    let is_broken = cause.effect == chipped_tooth::EFFECT.name;
    own.is_none_or(|e| (e.can_be)(&cause.shape, &cause.amounts))
        && (!is_broken || cause.amounts.iter().all(|a| *a > 0.0))
}

/// What one unit of a map of forces adds to what a sensor shows.
fn mapped(case: &Case, map: &M3) -> Vec<f64> {
    let shown = case.sensor().map;
    let shown = Matrix3::from_fn(|i, j| shown[i][j]);
    let Some(back) = shown.try_inverse() else {
        return case.column(|_, _, _| 0.0);
    };
    let map = Matrix3::from_fn(|i, j| map[i][j]) * back;
    let map = [0, 1, 2].map(|i| [0, 1, 2].map(|j| map[(i, j)]));
    case.column(|c, i, k| rotate(&map, case.simulated(c, i))[k])
}
