//! The diagnosis of a whole campaign.

mod account;
mod errors;
mod examination;
mod json;
mod page;
mod remarks;
mod sentence;
mod tables;

pub use account::account;
pub use examination::{examine, one};
pub use json::body;
pub use page::story;

use super::next::Proposal;
use super::{One, extended};
use crate::cli::Ending;
use crate::cli::chapter::Chapter;
use crate::findings::belief;
use crate::findings::campaign::Check;
use crate::findings::joint::Joint;
use crate::findings::sentence::{candidates, place, probability, spoken};
use crate::findings::{Group, Verdict};
use crate::fit::suitability::is_odd;
use crate::ground::problem::Outcome;
use crate::measurement::workspace::Place;
use crate::robot::Robot;
use std::path::PathBuf;

/// Everything that a campaign's files say together.
pub struct Campaign {
    /// Where they are.
    pub place: Place,
    /// Every file, diagnosed by itself; whole-robot tests with what the axis tests found.
    pub files: Vec<One>,
    /// What one found, held against the others.
    pub checks: Vec<Check>,
    /// What the tests of the whole robot believe together; `None` for fewer than two.
    pub joint: Option<Joint>,
    /// The robot with everything that was found; `None` if nothing changed it.
    pub robot: Option<Robot>,
    /// The verdict on all.
    pub verdict: Verdict,
    /// What to measure next on the whole robot; `None` where no file names it.
    pub next: Option<Proposal>,
    /// What a reader should know beside the causes, one sentence each.
    pub remarks: Vec<String>,
}

impl Campaign {
    /// Where the extended robot goes.
    pub fn robot_path(&self) -> PathBuf {
        self.place.fits().join("extended-robot.toml")
    }

    /// Everything that is written beside the files' own results.
    pub fn written(&self) -> Vec<(PathBuf, String)> {
        let robot = self
            .robot
            .as_ref()
            .map(|robot| (self.robot_path(), extended::text(robot, self.synthetic())));
        robot.into_iter().collect()
    }

    /// What all tests believe together, if there is something to list.
    fn joined(&self) -> Option<&Joint> {
        self.joint.as_ref().filter(|joint| !joint.causes.is_empty())
    }

    /// Which member of a group all tests together tell from the others.
    fn told(&self, group: &Group) -> Option<(belief::Place, f64)> {
        self.joint.as_ref()?.told(group)
    }

    /// What one experiment cannot tell and all together can, one sentence each.
    fn settled(&self) -> Vec<String> {
        let groups = self.files.iter().flat_map(|one| {
            let groups = one.found.answer().groups.iter();
            groups.map(move |group| (one.stem(), group))
        });
        let said = groups.filter_map(|(stem, group)| {
            let ((effect, site), p) = self.told(group)?;
            Some(format!(
                "{stem} alone cannot tell {}; all tests of the robot together say {} at {} ({}).",
                candidates(group),
                spoken(effect),
                place(&site),
                probability(p)
            ))
        });
        said.collect()
    }

    fn synthetic(&self) -> bool {
        self.files.iter().any(|one| one.found.source().synthetic)
    }

    /// How the verb ends.
    pub fn ending(&self) -> Ending {
        let fine = self
            .files
            .iter()
            .all(|one| !is_odd(&one.found.answer().doubts));
        match self.verdict {
            Verdict::Sufficient if fine => Ending::Done,
            _ => Ending::Attention,
        }
    }

    /// The verdict in a sentence or three.
    pub fn sentence(&self) -> String {
        sentence::sentence(self)
    }
}

/// Diagnoses a campaign, and writes what that found.
///
/// # Errors
/// A file that cannot be read, results that cannot be written.
pub fn chapter(place: &Place) -> Outcome<Option<Chapter>> {
    let campaign = examine(place, false)?;
    super::write(&campaign.files, campaign.written())?;
    let sources = campaign.files.iter().map(|one| one.found.source());
    Ok(Some(Chapter {
        title: "What the simulation gets wrong".into(),
        ending: campaign.ending(),
        inputs: sources
            .map(|s| (s.path.to_path_buf(), s.sha256.to_string()))
            .collect(),
        page: story(&campaign),
    }))
}
