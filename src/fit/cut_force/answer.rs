//! What the wave forms say: parameters with intervals, or that the data do not fix them.

mod beside;

use super::layout::Layout;
use super::rounds::{descend, rms};
use super::{Averaged, CutData, averaged, cuts, misfit, remarks, speed};
use crate::cutting::LINEAR_EDGE;
use crate::experiments::milling_force::{PHASE, RUNOUT, SPEED, UNKNOWNS};
use crate::fit::parameter::{Identified, Status};
use crate::ground::spatial::V3;
use crate::measurement::milling_force::MillingForce;
use nalgebra::{DMatrix, Matrix2, Rotation2};
use std::f64::consts::TAU;

/// One cut, measured and fitted.
#[derive(Debug, Clone)]
pub struct CutFit {
    /// Its data.
    pub data: CutData,
    /// Its unknowns where the fit ended.
    pub p: [f64; UNKNOWNS],
    /// Measured less fitted, N.
    pub residual: Vec<V3>,
}

impl CutFit {
    /// What is left where samples count, and nothing where they do not, N.
    pub fn left(&self) -> impl Iterator<Item = V3> + '_ {
        let each = self.residual.iter().zip(&self.data.counts);
        each.map(|(left, counts)| if *counts { *left } else { [0.0; 3] })
    }
}

/// Everything that is reported.
#[derive(Debug, Clone)]
pub struct Account {
    /// Coefficients, runout, runout angle.
    pub parameters: Vec<Identified>,
    /// What had to be found along.
    pub nuisance: Vec<Identified>,
    /// Coefficients from mean forces, the textbook's way.
    pub averaged: Averaged,
    /// The cuts.
    pub cuts: Vec<CutFit>,
    /// Standard deviation of what is left, x, y, z, N.
    pub rms: V3,
    /// Noise stated, N.
    pub stated_noise: Option<f64>,
    /// Covariance of the parts of the runout, m²; nothing for a single tooth.
    pub runout_covariance: Option<[[f64; 2]; 2]>,
    /// Samples used.
    pub rows: usize,
    /// What the law leaves turn after turn, as a share of the force.
    pub repeating: f64,
    /// Relative standard deviation of the force that the coefficients predict at the mean chip; `None`
    /// where a coefficient is open.
    pub rel_std: Option<f64>,
    /// What the data cannot tell, and what was left out.
    pub remarks: Vec<String>,
}

/// A coefficient counts as fixed when its standard error is below this share of the size of its kind.
const FIXED: f64 = 0.25;
/// A runout counts as seen when it stands out of its standard error by this factor, in a single cut.
const SEEN: f64 = 3.0;
/// An angle counts as fixed when its standard error is below this, rad.
const FIXED_ANGLE: f64 = 0.6;

/// Share of the force that the law leaves turn after turn, beyond which these are no coefficients of the cut that the file states. A choice: teeth
/// that are miscounted left 0.65, channels that are exchanged 0.41 and 0.96, a helix that nobody states 0.11 (one record by a stranger), that record itself
/// 0.0004. No other value was tried.
const ANOTHER: f64 = 0.25;

/// Identifies the coefficients from files of one tool.
pub fn identify(files: &[MillingForce]) -> Account {
    let mut cuts = cuts(files);
    let layout = Layout::of(&cuts);
    let (fitted, covariance) = descend(&mut cuts, &layout);
    let p = name_teeth(&cuts, &layout, fitted.p.clone());
    let answer = Answer {
        cuts: &cuts,
        layout: &layout,
        p: &p,
        covariance: &covariance,
    };
    let averaged = averaged(&cuts);
    let parameters = answer.parameters();
    let rms = rms(cuts.iter().zip(&fitted.residuals));
    let stated_noise = files.iter().find_map(|f| f.facts.sensor_noise_n);
    let mut account = Account {
        rel_std: answer.rel_std(&parameters),
        nuisance: answer.nuisance(),
        parameters,
        averaged,
        rms,
        stated_noise,
        runout_covariance: runout_covariance(&layout, (&fitted.p, &p), &covariance),
        rows: cuts.iter().map(CutData::rows).sum(),
        repeating: 0.0,
        cuts: Vec::new(),
        remarks: Vec::new(),
    };
    let residuals = fitted.residuals.into_iter();
    let fit = |(i, (data, residual)): (usize, (CutData, Vec<V3>))| CutFit {
        data,
        p: layout.of_one(i, &p),
        residual,
    };
    account.cuts = cuts
        .clone()
        .into_iter()
        .zip(residuals)
        .enumerate()
        .map(fit)
        .collect();
    account.repeating = misfit::share(&account.cuts);
    account.remarks = remarks::remarks(files, &account);
    if account.is_another_cut() {
        account.withhold();
    }
    account
}

/// Times the stated noise of a channel, where one is, and share of the force, from which what the law leaves needs attention. Choices, no
/// measurement: laws of real cuts leave a tenth.
const MUCH: (f64, f64) = (10.0, 0.25);

impl Account {
    /// Whether the law leaves so much that its numbers are those of another cut, or the teeth pass at another speed: who
    /// states a wrong speed may state a wrong feed.
    pub fn is_another_cut(&self) -> bool {
        self.leaves_another_cut() || speed::off_speed(&self.cuts).is_some()
    }

    /// Whether the law does not fit.
    pub fn leaves_another_cut(&self) -> bool {
        self.repeating > ANOTHER
    }

    /// Whether it leaves far more than the stated noise, and a good share of the force.
    pub fn leaves_much(&self) -> bool {
        let size = |v: V3| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let forces = self.cuts.iter().map(|cut| (&cut.data, &cut.data.force));
        let of_one = size(self.rms) / 3.0_f64.sqrt();
        let is_noise = self.stated_noise.is_some_and(|n| of_one < MUCH.0 * n);
        !is_noise && size(self.rms) > MUCH.1 * size(rms(forces))
    }

    fn withhold(&mut self) {
        for all in [&mut self.parameters, &mut self.nuisance] {
            let open = all.drain(..).map(|p| Identified {
                limit95: None,
                ..p.without_value(Status::NotIdentifiable)
            });
            *all = open.collect();
        }
        self.averaged.coefficients = [None; 6];
        self.rel_std = None;
    }
}

/// Angle of tooth 1 when a cut begins in the file, rad.
fn at_begin(cut: &CutData, p: &[f64; UNKNOWNS]) -> f64 {
    p[PHASE] - cut.scene.cut.spindle_rad_s * (1.0 + p[SPEED]) * cut.begins_s
}

/// An angle within half a turn of 0, rad.
fn wrapped(angle: f64) -> f64 {
    (angle + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU
}

/// Calls that tooth the first which stands nearest to φ = 0 when the first cut begins.
fn name_teeth(cuts: &[CutData], layout: &Layout, mut p: Vec<f64>) -> Vec<f64> {
    if cuts.is_empty() {
        return p;
    }
    let pitch = cuts[0].scene.tool.pitch_rad();
    let begin = at_begin(&cuts[0], &layout.of_one(0, &p));
    let turn = -(begin / pitch).round() * pitch;
    for phase in layout.of_cut.iter().filter_map(|c| c[PHASE]) {
        p[phase] = wrapped(p[phase] + turn);
    }
    if let [Some(a), Some(b)] = [layout.of_cut[0][RUNOUT], layout.of_cut[0][RUNOUT + 1]] {
        let (sin, cos) = turn.sin_cos();
        (p[a], p[b]) = (p[a] * cos + p[b] * sin, p[b] * cos - p[a] * sin);
    }
    p
}

/// Covariance of the runout, m², turned as its names were: from `before` to `after`.
fn runout_covariance(
    layout: &Layout,
    (before, after): (&[f64], &[f64]),
    covariance: &DMatrix<f64>,
) -> Option<[[f64; 2]; 2]> {
    let own = layout.of_cut.first()?;
    let places = [own[RUNOUT]?, own[RUNOUT + 1]?];
    let angle = |p: &[f64]| p[places[1]].atan2(p[places[0]]);
    let turn = Rotation2::new(angle(after) - angle(before));
    let block = Matrix2::from_fn(|i, j| covariance[(places[i], places[j])]);
    let turned = turn.matrix() * block * turn.matrix().transpose();
    Some([0, 1].map(|i| [0, 1].map(|j| turned[(i, j)])))
}

struct Answer<'a> {
    cuts: &'a [CutData],
    layout: &'a Layout,
    p: &'a [f64],
    covariance: &'a DMatrix<f64>,
}

impl Answer<'_> {
    fn stderr(&self, j: usize) -> f64 {
        self.covariance[(j, j)].max(0.0).sqrt()
    }

    fn parameters(&self) -> Vec<Identified> {
        let mut all: Vec<Identified> = (0..6).map(|j| self.coefficient(j)).collect();
        all.extend(self.runout());
        all
    }

    fn coefficient(&self, j: usize) -> Identified {
        let c = &LINEAR_EDGE.card().coefficients[j];
        let (value, stderr) = (self.p[j] / c.factor, self.stderr(j) / c.factor);
        let found = Identified::new(c.name, "material", value, c.unit, stderr, c.meaning);
        match stderr < FIXED * self.size(j) / c.factor {
            true => found,
            false => found.without_value(Status::NotIdentifiable),
        }
    }

    /// Size of the coefficients of one kind; edges count at least a tenth of what the chip does.
    fn size(&self, j: usize) -> f64 {
        let norm = |from: usize| {
            self.p[from..from + 3]
                .iter()
                .map(|v| v * v)
                .sum::<f64>()
                .sqrt()
        };
        let chip = norm(0) * self.mean_feed();
        match j < 3 {
            true => norm(0),
            false => norm(3).max(0.1 * chip),
        }
    }

    fn mean_feed(&self) -> f64 {
        let feed = |c: &CutData| c.scene.cut.feed_per_tooth(c.scene.tool.teeth);
        self.cuts.iter().map(feed).sum::<f64>() / self.cuts.len().max(1) as f64
    }

    /// Spread of the resultant in the cutting plane at the mean chip, relative.
    fn rel_std(&self, parameters: &[Identified]) -> Option<f64> {
        let open = |p: &Identified| p.status != Status::Identified;
        if parameters[..6].iter().any(open) {
            return None;
        }
        let chip = 0.5 * self.mean_feed();
        let c = self.covariance;
        let (mut force2, mut variance) = (0.0, 0.0);
        for k in 0..2 {
            force2 += (self.p[k] * chip + self.p[k + 3]).powi(2);
            variance += c[(k, k)] * chip * chip + 2.0 * c[(k, k + 3)] * chip + c[(k + 3, k + 3)];
        }
        Some((variance / force2.max(f64::MIN_POSITIVE)).sqrt())
    }
}
