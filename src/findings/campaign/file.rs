//! One file of a campaign, diagnosed.

use super::robot::stiffened;
use crate::findings::Answer;
use crate::findings::kinds::{Diagnosed, kind};
use crate::fit::axis_tests::AxisTest;
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::measurement::workspace::Place;
use serde::Serialize;
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};

/// One file, diagnosed.
pub struct DiagnosedFile {
    /// Its kind, as in its front matter.
    pub kind: &'static str,
    /// Where its results go.
    pub place: Place,
    /// What was found.
    pub found: Box<dyn Diagnosed>,
}

impl DiagnosedFile {
    /// Reads and diagnoses a file by itself.
    ///
    /// # Errors
    /// The file cannot be read, or is of a kind that nothing diagnoses.
    pub fn read(path: &Path) -> Outcome<Self> {
        let (kind, diagnose) = kind(path)?;
        Ok(Self {
            kind,
            place: Place::of(path),
            found: diagnose(path)?,
        })
    }

    /// As [`Self::read`]; a test of the whole robot is simulated with what the axis tests found.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn with_axis_tests(path: &Path, place: &Place, tests: &[AxisTest]) -> Outcome<Self> {
        let mut file = Self::read(path)?;
        file.place = place.clone();
        let robot = file.found.robot().filter(|_| !tests.is_empty());
        let informed = robot.and_then(|robot| file.found.under(&stiffened(robot, tests)));
        if let Some(informed) = informed {
            file.found = informed;
        }
        Ok(file)
    }

    /// Where it was read from.
    pub fn path(&self) -> &Path {
        self.found.source().path
    }

    /// File name without its ending.
    pub fn stem(&self) -> String {
        let stem = self.path().file_stem().unwrap_or_default();
        stem.to_string_lossy().to_string()
    }

    /// File name.
    pub fn name(&self) -> String {
        files::name(self.path())
    }

    /// Where the extended model goes, and its text; none if nothing was extended.
    ///
    /// # Errors
    /// A model that no file can hold.
    pub fn model(&self) -> Outcome<Option<(PathBuf, String)>> {
        if self.found.answer().is_withheld() {
            return Ok(None);
        }
        let path = format!("{}-extended.toml", self.stem());
        let path = self.place.fits().join(path);
        Ok(self.found.model()?.map(|text| (path, text)))
    }

    /// What is printed; `written`: whether models are written, so that their path is named.
    ///
    /// # Errors
    /// As [`Self::model`].
    pub fn document(&self, written: bool) -> Outcome<FileDocument<'_>> {
        let model = match written {
            true => self.model()?.map(|(path, _)| path.display().to_string()),
            false => None,
        };
        Ok(FileDocument {
            synthetic: self.found.source().synthetic,
            answer: self.found.answer(),
            model,
            kind: self.kind,
            more: self.found.more(),
        })
    }
}

/// A diagnosed file as it is printed (`formats.md`, section 3).
#[derive(Serialize)]
pub struct FileDocument<'a> {
    synthetic: bool,
    #[serde(flatten)]
    answer: &'a Answer,
    model: Option<String>,
    kind: &'static str,
    #[serde(flatten)]
    more: Map<String, Value>,
}
