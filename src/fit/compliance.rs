//! Re-identification from a workspace test: all compliances at once by a convex programme,
//! non-negative, with what is already known of each as a Gaussian prior.

use super::convex::non_negative;
use super::force_steps::Setup;
use super::parameter::{Identified, Status, Z95};
use super::weighing::Weighing;
use crate::experiments::workspace::{Response, Site};
use crate::ground::problem::Outcome;
use nalgebra::DMatrix;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// What is known of a site before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prior {
    /// Stiffness, N·m/rad.
    pub stiffness: f64,
    /// Its relative standard deviation.
    pub rel_std: f64,
    /// True if an axis test measured it, false for a nominal value with a stated spread.
    pub measured: bool,
}

/// The fitted compliances.
#[derive(Debug, Clone)]
pub struct Refit {
    /// The sites with the compliance of their prior.
    pub sites: Vec<Site>,
    /// What was known before.
    pub priors: Vec<Prior>,
    /// Compliance over that of the prior.
    pub ratio: Vec<f64>,
    /// Standard deviation of the ratio after the fit.
    pub std: Vec<f64>,
    /// What the points and the priors together fix.
    pub status: Vec<Status>,
    /// How badly model, priors and measurement contradict each other.
    pub chi_squared: f64,
    /// Measured slopes.
    pub slopes: usize,
    /// Probability of so large a contradiction by chance.
    pub p_value: f64,
    /// The weights of the slopes at the solution.
    pub weighing: Weighing,
}

/// A nominal value counts as identified if the points shrink its spread below this share: two sites
/// that only act as a sum keep 1/√2 each.
const LEARNED: f64 = 0.65;
/// Above this relative standard deviation nothing is fixed.
const UNSUPPORTED: f64 = 0.5;
/// A contradiction less likely than this widens the intervals (Birge's ratio).
const CONTRADICTION: f64 = 0.05;
/// The weights follow the solution; they settle within few rounds.
const ROUNDS: usize = 4;

/// Fits all sites of `response` to the lines of a test.
///
/// # Errors
/// The convex programme does not converge.
pub fn refit(
    response: &Response,
    priors: Vec<Prior>,
    setups: &[Setup],
    repeatability: f64,
) -> Outcome<Refit> {
    let prior_compliance = |(site, prior): (&Site, &Prior)| Site {
        compliance: 1.0 / prior.stiffness,
        ..site.clone()
    };
    let sites: Vec<Site> = response
        .sites
        .iter()
        .zip(&priors)
        .map(prior_compliance)
        .collect();
    let mut weighing = Weighing::new(setups, repeatability);
    let mut step = Step::of(response, &sites, &priors, &weighing)?;
    for _ in 1..ROUNDS {
        weighing.about_model(response, &compliances(&step.ratio, &sites));
        step = Step::of(response, &sites, &priors, &weighing)?;
    }
    let slopes = weighing.len();
    let p_value = ChiSquared::new(slopes.max(1) as f64).map_or(1.0, |d| d.sf(step.chi_squared));
    let widen = match p_value < CONTRADICTION {
        true => (step.chi_squared / slopes.max(1) as f64).sqrt().max(1.0),
        false => 1.0,
    };
    let std: Vec<f64> = step.std.iter().map(|s| s * widen).collect();
    let status = (0..sites.len()).map(|i| judge(step.ratio[i], std[i], &priors[i]));
    Ok(Refit {
        status: status.collect(),
        sites,
        priors,
        std,
        chi_squared: step.chi_squared,
        ratio: step.ratio,
        slopes,
        p_value,
        weighing,
    })
}

fn judge(ratio: f64, std: f64, prior: &Prior) -> Status {
    let learned = std < LEARNED * prior.rel_std;
    match ratio {
        0.0 => Status::AtBound,
        _ if Z95 * std >= ratio || std > UNSUPPORTED * ratio => Status::NotIdentifiable,
        _ if prior.measured || learned => Status::Identified,
        _ => Status::NotIdentifiable,
    }
}

/// One solution for fixed weights.
struct Step {
    ratio: Vec<f64>,
    std: Vec<f64>,
    chi_squared: f64,
}

impl Step {
    fn of(
        response: &Response,
        sites: &[Site],
        priors: &[Prior],
        weighing: &Weighing,
    ) -> Outcome<Self> {
        let design = weighing.design(response, sites);
        let slopes = weighing.measured();
        let mut hessian = design.transpose() * &design;
        let mut gradient = design.transpose() * &slopes;
        for (i, prior) in priors.iter().enumerate() {
            hessian[(i, i)] += prior.rel_std.powi(-2);
            gradient[i] += prior.rel_std.powi(-2);
        }
        let minimum = non_negative(&hessian, &gradient)?;
        let misfit = (slopes - design * &minimum.x).norm_squared();
        let pulls = priors.iter().zip(minimum.x.iter());
        let pulls: f64 = pulls.map(|(p, x)| ((x - 1.0) / p.rel_std).powi(2)).sum();
        Ok(Self {
            std: deviations(&hessian, &minimum.free),
            ratio: minimum.x.iter().copied().collect(),
            chi_squared: misfit + pulls,
        })
    }
}

/// Compliances of sites, rad/(N·m), by their ratios to the nominal ones.
fn compliances(ratio: &[f64], sites: &[Site]) -> Vec<f64> {
    let each = ratio.iter().zip(sites);
    each.map(|(r, site)| r * site.compliance).collect()
}

/// Standard deviations of the free ratios; zero for those at the bound.
fn deviations(hessian: &DMatrix<f64>, free: &[bool]) -> Vec<f64> {
    let index: Vec<usize> = (0..free.len()).filter(|i| free[*i]).collect();
    let inner = hessian.select_rows(&index).select_columns(&index);
    let inverse = inner.cholesky().map(|root| root.inverse());
    let mut std = vec![0.0; free.len()];
    for (a, i) in index.iter().enumerate() {
        std[*i] = inverse
            .as_ref()
            .map_or(f64::INFINITY, |c| c[(a, a)].max(0.0).sqrt());
    }
    std
}

impl Refit {
    /// The fitted compliances of the sites, rad/(N·m).
    pub fn compliances(&self) -> Vec<f64> {
        compliances(&self.ratio, &self.sites)
    }

    /// The stiffness of every site as it is reported, N·m/rad.
    pub fn parameters(&self) -> Vec<Identified> {
        (0..self.sites.len()).map(|i| self.parameter(i)).collect()
    }

    fn parameter(&self, i: usize) -> Identified {
        let (ratio, std) = (self.ratio[i], self.std[i]);
        let stiffness = self.priors[i].stiffness;
        let meaning =
            "moment per angle, from the workspace points together with what was known before";
        let mut parameter = Identified::new(
            "stiffness",
            &self.sites[i].name,
            stiffness / ratio,
            "N·m/rad",
            stiffness * std / (ratio * ratio),
            meaning,
        );
        parameter.ci95 = Some([
            stiffness / (ratio + Z95 * std),
            stiffness / (ratio - Z95 * std),
        ]);
        match self.status[i] {
            Status::Identified => parameter,
            other => {
                parameter.ci95 = None;
                parameter.without_value(other)
            }
        }
    }

    /// Share of the prior's variance that the points took away, 0 to 1.
    pub fn learned(&self, i: usize) -> f64 {
        (1.0 - (self.std[i] / self.priors[i].rel_std).powi(2)).clamp(0.0, 1.0)
    }

    /// Distance of the fitted compliance from the prior in standard deviations of the prior.
    pub fn pull(&self, i: usize) -> f64 {
        (self.ratio[i] - 1.0) / self.priors[i].rel_std
    }
}
