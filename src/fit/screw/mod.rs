//! A linear axis measured against a scale: figures of ISO 230-2, backlash, the error in groups of
//! quadratics, and the table that corrects it (source 003, section 3).

pub mod cyclic;
pub mod groups;
pub mod in_motion;
pub mod iso;
pub mod least_groups;
pub mod positions;

use crate::ground::problem::Outcome;
use crate::measurement::pitch_table::{PitchTable, Row};
use crate::measurement::screw::ScrewTest;
use cyclic::Sight;
use groups::{Group, Joint};
use iso::Figures;
use least_groups::least;
use positions::{Extremes, Target, in_mm, targets};

/// How a screw is judged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// Largest residual of a group, m.
    pub residual: f64,
    /// Factor of the standard deviation in the figures: 2 (ISO 230-2:2014) or 3 (1988, GB/T 17421.2).
    pub coverage: f64,
    /// Which readings a mean leaves out.
    pub extremes: Extremes,
    /// Whether neighbouring groups meet.
    pub joint: Joint,
    /// Whether the table follows the groups instead of the means at the targets.
    pub smooth: bool,
}

/// What was found.
#[derive(Debug, Clone)]
pub struct Account {
    /// Readings target by target, all of them.
    pub targets: Vec<Target>,
    /// Figures of ISO 230-2, of all readings.
    pub figures: Figures,
    /// Targets without the extremes: what means, backlash, groups and table rest on.
    pub kept: Vec<Target>,
    /// Readings that the means leave out.
    pub dropped: usize,
    /// Size of the lost motion, m: how far the backward mean lies from the forward mean, over all targets. A remark says where it
    /// lies below.
    pub backlash: Option<f64>,
    /// Greedy groups.
    pub groups: Vec<Group>,
    /// The least number of groups with the same limit, where it was sought.
    pub least: Option<Vec<Group>>,
    /// Largest residual that a group may have, µm.
    pub limit_um: f64,
    /// Travel per turn, m.
    pub pitch: Option<f64>,
    /// What the targets show of an error once per turn.
    pub sight: Sight,
}

/// Judges the readings of one axis, of all `tests` together.
///
/// # Errors
/// Files of different screws, or too few targets.
pub fn identify(tests: &[ScrewTest], request: &Request) -> Outcome<Account> {
    let pitch = positions::one_pitch(tests)?;
    let targets = targets(tests)?;
    let (kept, dropped) = request.extremes.without(&targets);
    let mean: Vec<[f64; 2]> = kept
        .iter()
        .filter_map(|t| Some([in_mm(t.at), t.mean()? * 1e6]))
        .collect();
    let limit = request.residual * 1e6;
    let at: Vec<f64> = targets.iter().map(|target| target.at).collect();
    Ok(Account {
        figures: Figures::of(&targets, request.coverage),
        backlash: Target::middle(&lost(&kept)).map(f64::abs),
        groups: groups::greedy(&mean, limit, request.joint),
        least: least(&mean, limit),
        limit_um: limit,
        sight: Sight::of(&at, pitch),
        pitch,
        targets,
        kept,
        dropped,
    })
}

/// Backward less forward at the targets that have both, m: above zero where motion is lost.
fn lost(kept: &[Target]) -> Vec<f64> {
    let both = |t: &Target| Some(Target::middle(&t.backward)? - Target::middle(&t.forward)?);
    kept.iter().filter_map(both).collect()
}

/// A mean is seen when it stands out of its standard error by this factor: noise does so once in 740.
const SEEN: f64 = 3.0;

impl Account {
    /// Largest residual of all groups, µm.
    pub fn max_residual_um(&self) -> f64 {
        self.groups
            .iter()
            .map(|g| g.max_residual_um)
            .fold(0.0, f64::max)
    }

    /// The table to be added to the command: less the mean error of each direction at every target, or less
    /// the groups with half the backlash of each target's neighbourhood. A direction that was not measured
    /// takes the other one's.
    pub fn table(&self, smooth: bool) -> PitchTable {
        let row = |t: &Target| {
            let (forward, backward) = self.errors(t, smooth)?;
            Some(Row {
                target_mm: in_mm(t.at),
                forward_um: -forward,
                backward_um: -backward,
            })
        };
        PitchTable {
            rows: self.kept.iter().filter_map(row).collect(),
            ..PitchTable::default()
        }
    }

    /// Errors of both directions at a target, µm.
    fn errors(&self, target: &Target, smooth: bool) -> Option<(f64, f64)> {
        let forward = Target::middle(&target.forward).map(|m| m * 1e6);
        let backward = Target::middle(&target.backward).map(|m| m * 1e6);
        let (forward, backward) = (forward.or(backward)?, backward.or(forward)?);
        if !smooth {
            return Some((forward, backward));
        }
        let group = groups::of(&self.groups, in_mm(target.at))?;
        let half = 0.5 * (forward - backward).signum() * self.backlash.unwrap_or(0.0) * 1e6;
        let middle = group.at(in_mm(target.at));
        Some((middle + half, middle - half))
    }

    /// What a reader should know, one sentence each.
    pub fn remarks(&self) -> Vec<String> {
        let mut said: Vec<String> = self.sight.sentence().into_iter().collect();
        let runs = self.targets.iter().map(Target::runs).min().unwrap_or(0);
        if runs < 2 {
            said.push("some target was met only once in a direction: figures that need a standard deviation are left out".into());
        } else if runs < 5 {
            said.push(format!(
                "ISO 230-2 asks for five runs in each direction; some target has {runs}"
            ));
        }
        if self
            .targets
            .iter()
            .any(|t| t.forward.is_empty() || t.backward.is_empty())
        {
            said.push(
                "some targets were approached from one side only: they tell nothing about backlash"
                    .into(),
            );
        }
        said.extend(self.gained());
        said
    }

    /// What a mean is of, in words.
    pub fn mean_of(&self) -> &'static str {
        match self.backlash {
            Some(_) => "mean of both directions",
            None => "mean of the one direction",
        }
    }

    /// That the way back lies below the way there, which no play makes.
    fn gained(&self) -> Option<String> {
        let lost = lost(&self.kept);
        let error = Target::deviation(&lost)? / (lost.len() as f64).sqrt();
        (Target::middle(&lost)? < -SEEN * error).then(|| {
            "the way back lies below the way there, which no play makes: the controller takes more away than is lost, or the directions are exchanged".into()
        })
    }
}
