//! The diagnosis of a whole campaign: every file by itself, each held against the others, and what all tests
//! of the robot believe together.
//!
//! ```
//! use ident::findings::campaign::{Campaign, DiagnosedFile};
//! use ident::measurement::workspace::Place;
//! use std::path::Path;
//!
//! let path = Path::new("measurements/kr210/axis2.csv");
//! let file = DiagnosedFile::read(path)?;
//! println!("{}: {}", file.name(), file.found.answer().verdict.name());
//!
//! let place = Place::of(path);
//! let paths = Campaign::files(&place)?;
//! let told = |path: &Path| println!("{}", path.display());
//! let campaign = Campaign::diagnose(&place, &paths[..3], &told)?;
//! println!("{}", campaign.sentence());
//! # Ok::<(), ident::ground::problem::Problem>(())
//! ```

mod check;
mod document;
mod file;
mod proposal;
mod remarks;
mod robot;
mod sentence;
mod start;
mod verdict;

pub use check::{Agreement, Check};
pub use document::CampaignDocument;
pub use file::{DiagnosedFile, FileDocument};
pub use proposal::Proposal;
pub use start::Start;

use super::belief;
use super::joint::Joint;
use super::kinds::KINDS;
use super::sentence::{candidates, place, probability, spoken};
use super::{Group, Verdict};
use crate::fit::axis_tests;
use crate::fit::suitability::is_odd;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::hammer_uff::without_hits;
use crate::measurement::leading::fact_of;
use crate::measurement::workspace::Place;
use crate::robot::Robot;
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Role of a file that is measured only to be compared with another.
const COMPARISON: &str = "comparison";

/// Everything that a campaign's files say together.
pub struct Campaign {
    /// Where they are.
    pub place: Place,
    /// Every file, diagnosed by itself; whole-robot tests with what the axis tests found.
    pub files: Vec<DiagnosedFile>,
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
    /// Which stored fits were not used as they stand, one sentence each.
    pub warnings: Vec<String>,
}

impl Campaign {
    /// The files of a campaign that can be diagnosed, kind by kind; those measured only for comparison are
    /// left out, and hammer tests without their hits.
    ///
    /// # Errors
    /// A file that cannot be read, or none at all.
    pub fn files(place: &Place) -> Outcome<Vec<PathBuf>> {
        let mut paths: Vec<PathBuf> = Vec::new();
        for (name, ..) in KINDS {
            for path in place.files_of(name)? {
                let role = fact_of(&path, "role").map_err(|problem| problem.in_file(&path))?;
                let compared = role.is_some_and(|role| role == COMPARISON);
                paths.extend((!compared && !without_hits(&path)).then_some(path));
            }
        }
        if paths.is_empty() {
            let remedy = "put measurements there whose front matter says `kind`";
            let problem = Problem::new("holds no measurement that can be diagnosed", remedy);
            return Err(problem.in_file(&place.measurements()));
        }
        Ok(paths)
    }

    /// Diagnoses files of a campaign; `done` is called after each, from any thread. Nothing is written.
    ///
    /// # Errors
    /// A file that cannot be read or that nothing diagnoses, a stored fit that cannot be read.
    pub fn diagnose(
        place: &Place,
        paths: &[PathBuf],
        done: &(dyn Fn(&Path) + Sync),
    ) -> Outcome<Self> {
        let found = axis_tests::read(&place.fits(), &place.measurements())?;
        let tests = found.tests;
        let files = paths.par_iter().map(|path| {
            let file = DiagnosedFile::with_axis_tests(path, place, &tests);
            done(path);
            file
        });
        let files: Vec<Outcome<DiagnosedFile>> = files.collect();
        let files = files.into_iter().collect::<Outcome<Vec<DiagnosedFile>>>()?;
        let closed = remarks::closed_gaps(&files, &tests);
        let mut campaign = Self::together(place, files);
        campaign.warnings = found.remarks;
        let passed_over = remarks::passed_over(place)?;
        campaign.remarks = closed.into_iter().chain(passed_over).collect();
        campaign.plan();
        Ok(campaign)
    }

    /// What diagnosed files say together.
    fn together(place: &Place, files: Vec<DiagnosedFile>) -> Self {
        let checks = robot::checks(&files);
        let believed = files
            .iter()
            .filter_map(|file| Some((file.stem(), file.found.belief()?)));
        let joint = Joint::of(&believed.collect::<Vec<_>>());
        let answers = files.iter().map(|file| file.found.answer());
        Self {
            verdict: verdict::verdict(answers, &checks, joint.as_ref()),
            robot: robot::extended(&files, joint.as_ref()),
            place: place.clone(),
            next: None,
            remarks: Vec::new(),
            warnings: Vec::new(),
            checks,
            joint,
            files,
        }
    }

    /// Plans what to measure next; where that is refused, the reason is a remark.
    fn plan(&mut self) {
        match Proposal::of_campaign(&self.place, &self.files) {
            Ok(next) => {
                self.warnings
                    .extend(next.iter().flat_map(|next| next.start.warnings.clone()));
                self.next = next;
            }
            Err(problem) => self
                .remarks
                .push(format!("No set-ups are planned: {problem}")),
        }
    }

    /// Where the extended robot goes.
    pub fn robot_path(&self) -> PathBuf {
        self.place.fits().join("extended-robot.toml")
    }

    /// What all tests believe together, if there is something to list.
    pub fn joined(&self) -> Option<&Joint> {
        self.joint.as_ref().filter(|joint| !joint.causes.is_empty())
    }

    /// Which member of a group all tests together tell from the others.
    pub fn told(&self, group: &Group) -> Option<(belief::Place, f64)> {
        self.joint.as_ref()?.told(group)
    }

    /// What one experiment cannot tell and all together can, one sentence each.
    pub fn settled(&self) -> Vec<String> {
        let groups = self.files.iter().flat_map(|file| {
            let groups = file.found.answer().groups.iter();
            groups.map(move |group| (file.stem(), group))
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

    /// Whether any of its files was simulated.
    pub fn synthetic(&self) -> bool {
        self.files.iter().any(|file| file.found.source().synthetic)
    }

    /// Whether the simulation is right everywhere, and nothing is odd about the data.
    pub fn is_fine(&self) -> bool {
        let odd = |file: &DiagnosedFile| is_odd(&file.found.answer().doubts);
        self.verdict == Verdict::Sufficient && !self.files.iter().any(odd)
    }

    /// The verdict in a sentence or three.
    pub fn sentence(&self) -> String {
        sentence::sentence(self)
    }
}
