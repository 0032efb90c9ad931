//! The compliances of all sites by weighted least squares over non-negative numbers. A load turns the
//! structure by finite angles, so the linear problem is stated about the bent state and solved again.

use crate::experiments::cubes::Setup;
use crate::experiments::workspace::Site;
use crate::fit::convex::non_negative;
use crate::fit::parameter::{Status, Z95};
use crate::ground::problem::Outcome;
use crate::ground::products::gram;
use crate::measurement::cubes::CubeTest;
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// The solution.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The sites with the compliance that the robot has now.
    pub sites: Vec<Site>,
    /// Compliance over that of the robot now.
    pub ratio: DVector<f64>,
    /// Covariance of the ratios.
    pub covariance: DMatrix<f64>,
    /// What the cubes fix.
    pub status: Vec<Status>,
    /// Whether any cube moves with a site under these loads.
    pub seen: Vec<bool>,
    /// Noise of displacements, m, and rotations, rad.
    pub noise: [f64; 2],
    /// Whether it is what the residuals say (else what the files state).
    pub estimated: [bool; 2],
    /// Root mean square of the residuals: m and rad, before (the robot as it was) and after.
    pub rms: [[f64; 2]; 2],
    /// Numbers that were measured.
    pub readings: usize,
    /// Probability of so large a misfit by chance, with stated noise.
    pub p_value: f64,
    /// Whitened columns of the sites, for what cannot be told apart.
    pub design: DMatrix<f64>,
}

/// Prior standard deviation of a ratio of which the robot file states none: next to nothing is known.
const LOOSE: f64 = 30.0;
/// A site whose standard deviation the cubes did not bring below this share of what was stated is not
/// identified: the file said it before.
const LEARNED: f64 = 0.65;
/// Above this relative standard deviation a site is not fixed.
const UNSUPPORTED: f64 = 0.25;
/// A contradiction less likely than this widens the intervals (Birge's ratio).
const CONTRADICTION: f64 = 0.01;
/// Rounds of linearisation; finite angles are a percent, so each gains two digits.
const ROUNDS: usize = 5;
/// Noise to start from where none is stated: m and rad.
const START: [f64; 2] = [2e-6, 1e-5];

/// One measured number.
struct Entry {
    /// Displacement 0, rotation 1.
    kind: usize,
    /// Number of the translation of the frame that it shares, for displacements.
    frame: Option<usize>,
    /// Measured less predicted about the current compliances, m or rad.
    residual: f64,
    /// Slopes per ratio of every site.
    slopes: Vec<f64>,
}

impl Solved {
    /// Fits all `tests` together.
    ///
    /// # Errors
    /// No convergence.
    pub fn of(tests: &[CubeTest], setups: &[Setup]) -> Outcome<Self> {
        let sites = setups[0].sites.clone();
        let n = sites.len();
        let stated = [0, 1].map(|k| tests.iter().find_map(|t| t.facts.noise[k]));
        let frames: f64 = tests
            .iter()
            .filter_map(|t| t.facts.frame_std)
            .fold(0.0, f64::max);
        let mut noise = [stated[0].unwrap_or(START[0]), stated[1].unwrap_or(START[1])];
        let prior = DVector::from_iterator(n, setups[0].stated.iter().map(|s| s.unwrap_or(LOOSE)));
        let weight = prior.map(|std| 1.0 / (std * std));
        let mut ratio = DVector::from_element(n, 1.0);
        let mut entries = entries(tests, setups, &ratio);
        let before = rms(&entries);
        let mut covariance = DMatrix::identity(n, n);
        for _ in 0..ROUNDS {
            let (design, right) = whitened(&entries, noise, frames);
            let hessian = gram(&design) + DMatrix::from_diagonal(&weight);
            let target = right + &design * &ratio;
            let gradient = design.transpose() * target + &weight;
            // both times one number: the same minimum, in numbers of order one
            let size = hessian.diagonal().max().sqrt().max(1.0);
            ratio = non_negative(&(&hessian / size), &(gradient / size))?.x;
            covariance = hessian.cholesky().map_or_else(
                || DMatrix::from_diagonal(&weight.map(|w| 1.0 / w)),
                |c| c.inverse(),
            );
            entries = self::entries(tests, setups, &ratio);
            noise = noise_told(&entries, &covariance, noise, stated, frames);
        }
        let (design, right) = whitened(&entries, noise, frames);
        let free = (entries.len() as f64 - n as f64).max(1.0);
        let misfit = right.norm_squared();
        let p_value = ChiSquared::new(free).map_or(1.0, |d| d.sf(misfit));
        if p_value < CONTRADICTION {
            covariance *= (misfit / free).max(1.0);
        }
        let seen: Vec<bool> = (0..n).map(|i| design.column(i).norm() > 1e-6).collect();
        let status = (0..n)
            .map(|i| {
                let std = covariance[(i, i)].sqrt();
                judge(ratio[i], std, seen[i] && std < LEARNED * prior[i])
            })
            .collect();
        Ok(Self {
            readings: entries.len(),
            rms: [before, rms(&entries)],
            estimated: stated.map(|s| s.is_none()),
            sites,
            ratio,
            covariance,
            status,
            seen,
            noise,
            p_value,
            design,
        })
    }

    /// Compliance of a site, rad/(N·m).
    pub fn compliance(&self, i: usize) -> f64 {
        self.ratio[i] * self.sites[i].compliance
    }

    /// Its standard deviation, rad/(N·m).
    pub fn deviation(&self, i: usize) -> f64 {
        self.covariance[(i, i)].sqrt() * self.sites[i].compliance
    }
}

fn judge(ratio: f64, std: f64, told: bool) -> Status {
    match ratio {
        _ if !told => Status::NotIdentifiable,
        0.0 if std < UNSUPPORTED => Status::AtBound,
        _ if Z95 * std >= ratio || std > UNSUPPORTED * ratio => Status::NotIdentifiable,
        _ => Status::Identified,
    }
}

/// Everything measured, about the robot bent with these compliances.
fn entries(tests: &[CubeTest], setups: &[Setup], ratio: &DVector<f64>) -> Vec<Entry> {
    let mut entries = Vec::new();
    let mut frames: Vec<(usize, i64)> = Vec::new();
    for (file, (test, setup)) in tests.iter().zip(setups).enumerate() {
        let compliances: Vec<f64> = setup
            .sites
            .iter()
            .zip(ratio.iter())
            .map(|(s, r)| s.compliance * r)
            .collect();
        let mut bent = None;
        for reading in &test.readings {
            let same = |(load, _): &([f64; 6], _)| *load == loads(reading);
            if !bent.as_ref().is_some_and(same) {
                bent = Some((loads(reading), setup.bent(reading, &compliances)));
            }
            let Some((_, bent)) = &bent else { continue };
            let key = (file, reading.test);
            let frame = frames
                .iter()
                .position(|known| *known == key)
                .unwrap_or_else(|| {
                    frames.push(key);
                    frames.len() - 1
                });
            let model = setup.moved(bent, reading.cube);
            let slopes: Vec<[f64; 6]> = (0..setup.sites.len())
                .map(|s| setup.slope(bent, reading.cube, s))
                .collect();
            for c in (0..6).filter(|c| !reading.moved[*c].is_nan()) {
                entries.push(Entry {
                    kind: c / 3,
                    frame: (c < 3).then_some(3 * frame + c),
                    residual: reading.moved[c] - model[c],
                    slopes: slopes
                        .iter()
                        .zip(&setup.sites)
                        .map(|(s, site)| s[c] * site.compliance)
                        .collect(),
                });
            }
        }
    }
    entries
}

fn loads(reading: &crate::measurement::cubes::Reading) -> [f64; 6] {
    let ([a, b, c], [d, e, f]) = (reading.force, reading.moment);
    [a, b, c, d, e, f]
}

fn rms(entries: &[Entry]) -> [f64; 2] {
    [0, 1].map(|kind| {
        let own = || entries.iter().filter(|e| e.kind == kind);
        (own().map(|e| e.residual.powi(2)).sum::<f64>() / own().count().max(1) as f64).sqrt()
    })
}

/// Slopes and residuals with unit noise. The translation of the frame that n readings share has the
/// covariance f² 11ᵀ: with α = 1 − σ/√(σ² + n f²), what is left after α times their mean is white.
fn whitened(entries: &[Entry], noise: [f64; 2], frame_std: f64) -> (DMatrix<f64>, DVector<f64>) {
    let n = entries[0].slopes.len();
    let mut table = DMatrix::from_fn(entries.len(), n + 1, |i, j| {
        let entry = &entries[i];
        (if j < n {
            entry.slopes[j]
        } else {
            entry.residual
        }) / noise[entry.kind]
    });
    if frame_std > 0.0 {
        let groups = entries
            .iter()
            .filter_map(|e| e.frame)
            .max()
            .map_or(0, |last| last + 1);
        let mut members: Vec<Vec<usize>> = vec![Vec::new(); groups];
        entries
            .iter()
            .enumerate()
            .for_each(|(i, e)| members.extend_at(e.frame, i));
        for group in members.iter().filter(|group| !group.is_empty()) {
            let count = group.len() as f64;
            let alpha = 1.0 - noise[0] / (noise[0].powi(2) + count * frame_std.powi(2)).sqrt();
            for j in 0..=n {
                let mean = group.iter().map(|i| table[(*i, j)]).sum::<f64>() / count;
                group.iter().for_each(|i| table[(*i, j)] -= alpha * mean);
            }
        }
    }
    let right = table.column(n).into_owned();
    (table.columns(0, n).into_owned(), right)
}

/// Lists by number.
trait ExtendAt {
    fn extend_at(&mut self, list: Option<usize>, value: usize);
}

impl ExtendAt for Vec<Vec<usize>> {
    fn extend_at(&mut self, list: Option<usize>, value: usize) {
        if let Some(list) = list {
            self[list].push(value);
        }
    }
}

/// Noise where the files state none: what the residuals say, less what the fit took.
fn noise_told(
    entries: &[Entry],
    covariance: &DMatrix<f64>,
    noise: [f64; 2],
    stated: [Option<f64>; 2],
    frame_std: f64,
) -> [f64; 2] {
    let (design, right) = whitened(entries, noise, frame_std);
    [0, 1].map(|kind| {
        if let Some(stated) = stated[kind] {
            return stated;
        }
        let rows: Vec<usize> = (0..entries.len())
            .filter(|i| entries[*i].kind == kind)
            .collect();
        let squares: f64 = rows.iter().map(|i| right[*i].powi(2)).sum();
        let used: f64 = rows
            .iter()
            .map(|i| (design.row(*i) * covariance * design.row(*i).transpose())[0])
            .sum();
        let free = (rows.len() as f64 - used).max(1.0);
        (noise[kind] * (squares / free).sqrt()).max(1e-12)
    })
}
