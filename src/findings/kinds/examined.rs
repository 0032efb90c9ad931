//! A kind behind the common engine, as every verb wants it: what was measured, its figures, its model.

use super::{Diagnosed, Source};
use crate::findings::Answer;
use crate::findings::engine::{Experiment, Found, Judgement, diagnose};
use crate::fit::suitability::Doubt;
use crate::ground::problem::Outcome;
use crate::sheet::chart::Chart;
use serde_json::{Map, Value};

/// An experiment with its file: what a kind adds to [`Experiment`] to be shown and stored.
pub trait Measured: Experiment + Send {
    /// Where it comes from.
    fn source(&self) -> Source<'_>;
    /// What was measured, as `screw of the x axis`.
    fn about(&self) -> String;
    /// Figures of what was measured and simulated, before and after.
    fn before_and_after(&self, found: &Found) -> Vec<Chart>;
    /// Figures of what no named cause explains.
    fn remaining_figures(&self, found: &Found) -> Vec<Chart>;
    /// The extended model as a file; `None` where nothing was extended.
    ///
    /// # Errors
    /// The model cannot be written as text.
    fn model(&self, _found: &Found) -> Outcome<Option<String>> {
        Ok(None)
    }
    /// What a reader should know beside the causes, one sentence each.
    fn remarks(&self, _found: &Found) -> Vec<String> {
        Vec::new()
    }
    /// What this kind adds to the common JSON.
    fn more(&self, _found: &Found) -> Map<String, Value> {
        Map::new()
    }
    /// What is odd about the data: what is fatal there withholds every cause.
    fn doubts(&self) -> Vec<Doubt>;
    /// The numbers that decide, where this kind has a reason of its own.
    fn judgement(&self) -> Judgement {
        Judgement::default()
    }
}

struct Examined<M> {
    measured: M,
    found: Found,
    judgement: Judgement,
}

/// Diagnoses an experiment.
pub fn examined<M: Measured + 'static>(measured: M) -> Box<dyn Diagnosed> {
    let found = diagnose(&measured, &measured.judgement());
    found_of(measured, found)
}

/// An experiment with what was found in it.
pub fn found_of<M: Measured + 'static>(measured: M, mut found: Found) -> Box<dyn Diagnosed> {
    let judgement = measured.judgement();
    found.answer = found.answer.doubted(measured.doubts());
    Box::new(Examined {
        measured,
        found,
        judgement,
    })
}

impl<M: Measured> Diagnosed for Examined<M> {
    fn answer(&self) -> &Answer {
        &self.found.answer
    }

    fn source(&self) -> Source<'_> {
        self.measured.source()
    }

    fn about(&self) -> String {
        self.measured.about()
    }

    fn before_and_after(&self) -> Vec<Chart> {
        self.measured.before_and_after(&self.found)
    }

    fn remaining(&self) -> Vec<Chart> {
        self.measured.remaining_figures(&self.found)
    }

    fn model(&self) -> Outcome<Option<String>> {
        self.measured.model(&self.found)
    }

    fn remarks(&self) -> Vec<String> {
        self.measured.remarks(&self.found)
    }

    fn more(&self) -> Map<String, Value> {
        let mut map = self.measured.more(&self.found);
        let judgement = serde_json::to_value(self.judgement).unwrap_or_default();
        map.insert("judgement".into(), judgement);
        map
    }
}
