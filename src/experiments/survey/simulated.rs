//! The simulated modes of a robot at the points of a survey.

use super::assignment::Assignment;
use super::modes::SurveyMode;
use crate::ground::problem::Outcome;
use crate::measurement::survey::Survey;
use crate::motion::modes::{complex_modes, modal};
use crate::motion::on_links::swing_of_points;
use crate::motion::{Work, elastic, linearise};
use crate::robot::{Robot, check};
use crate::signal::mac;
use rustfft::num_complex::Complex64;

/// Damping ratio from which a mode does not swing.
const OVERDAMPED: f64 = 0.9;
/// Simulated modes are told up to so many times the highest measured one.
const BEYOND: f64 = 1.5;
/// Modal assurance from which two modes are told as a pair.
pub const PAIR: f64 = 0.7;

/// A simulated mode.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedMode {
    /// Natural frequency, Hz.
    pub frequency_hz: f64,
    /// Share of critical damping.
    pub damping_ratio: f64,
    /// At the responses in [`Beside::kept`].
    pub shape: Vec<Complex64>,
}

/// Measured beside simulated.
#[derive(Debug, Clone, PartialEq)]
pub struct Beside {
    /// The simulated modes.
    pub modes: Vec<SimulatedMode>,
    /// Responses (places in [`Survey::dofs`]) at points whose link is certain.
    pub kept: Vec<usize>,
    /// `mac[measured][simulated]` over those.
    pub mac: Vec<Vec<f64>>,
}

impl Beside {
    /// For every measured mode the simulated one that it is most alike, with the assurance, if that is a pair:
    /// each is also the other's best.
    pub fn pairs(&self) -> Vec<Option<(usize, f64)>> {
        let best = |values: &mut dyn Iterator<Item = f64>| {
            let all: Vec<f64> = values.collect();
            let order = |a: &usize, b: &usize| all[*a].total_cmp(&all[*b]);
            (0..all.len()).filter(|i| all[*i].is_finite()).max_by(order)
        };
        let pair = |(m, row): (usize, &Vec<f64>)| {
            let s = best(&mut row.iter().copied())?;
            let back = best(&mut self.mac.iter().map(|row| row[s]))?;
            (back == m && row[s] >= PAIR).then_some((s, row[s]))
        };
        self.mac.iter().enumerate().map(pair).collect()
    }
}

/// The simulated modes at joint angles (rad) beside the measured ones.
///
/// # Errors
/// A robot without bodies or springs.
pub fn beside(
    survey: &Survey,
    measured: &[SurveyMode],
    assignment: &Assignment,
    (robot, joints): (&Robot, &[f64]),
) -> Outcome<Beside> {
    check::dynamics(robot)?;
    let chain = elastic(robot);
    let linear = linearise(&chain, &mut Work::new(&chain), &chain.spread(joints))?;
    let top = measured
        .iter()
        .map(|m| m.mode.frequency_hz)
        .fold(0.0, f64::max);
    let kept: Vec<usize> = (0..survey.dofs.len())
        .filter(|d| assignment.links[survey.dofs[*d].0].is_some())
        .collect();
    let swings = complex_modes(&linear, &modal(&linear)?)
        .into_iter()
        .filter(|mode| mode.damping_ratio < OVERDAMPED && mode.frequency_hz <= BEYOND * top);
    let modes: Vec<SimulatedMode> = swings
        .map(|mode| SimulatedMode {
            frequency_hz: mode.frequency_hz,
            damping_ratio: mode.damping_ratio,
            shape: at_responses(survey, assignment, &kept, (robot, joints), &mode.shape),
        })
        .collect();
    let own = |m: &SurveyMode| kept.iter().map(|d| m.shape[*d]).collect();
    let own: Vec<Vec<Complex64>> = measured.iter().map(own).collect();
    let other: Vec<Vec<Complex64>> = modes.iter().map(|m| m.shape.clone()).collect();
    Ok(Beside {
        mac: mac::matrix(&own, &other),
        modes,
        kept,
    })
}

/// A simulated shape at the kept responses, along the axes of the survey.
fn at_responses(
    survey: &Survey,
    assignment: &Assignment,
    kept: &[usize],
    (robot, joints): (&Robot, &[f64]),
    shape: &[f64],
) -> Vec<Complex64> {
    let all = assignment.links.iter().zip(&assignment.places);
    let points: Vec<_> = all
        .map(|(link, at)| (link.map_or(0, |l| l.0), *at))
        .collect();
    let moved = swing_of_points(robot, joints, shape, &points);
    let along = |d: &usize| {
        let (point, axis) = survey.dofs[*d];
        Complex64::from(survey.placement.back(moved[point])[axis])
    };
    kept.iter().map(along).collect()
}
