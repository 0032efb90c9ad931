//! The diagnosis of one load-cycle file: from the screen to the verdict.

use super::case::Case;
use super::imposed::diagnose_imposed;
use super::present::Present;
use crate::effects::{Composite, EFFECTS, Effect};
use crate::findings::answer::Answer;
use crate::findings::engine::Judgement;
use crate::fit::imposed::is_imposed;
use crate::fit::observation::Observation;
use crate::fit::suitability::load_cycle::doubts;
use crate::measurement::load_cycle::LoadCycle;

/// What a diagnosis found: the answer, and the models and data behind it.
pub struct Diagnosis {
    /// The answer.
    pub answer: Answer,
    /// The extended model.
    pub model: Composite,
    /// Its parameters, SI.
    pub p: Vec<f64>,
    /// Reduced data.
    pub data: Observation,
    /// Reading that the present simulation predicts.
    pub simulated: Vec<f64>,
    /// Reading that the extended model predicts.
    pub extended: Vec<f64>,
    /// Whether the displacement was imposed: `data` then holds it as the load, and predicts force.
    pub imposed: bool,
    /// The numbers that decided; none: another program, which has none of them.
    pub judgement: Option<Judgement>,
}

impl std::ops::Deref for Diagnosis {
    type Target = Answer;

    fn deref(&self) -> &Answer {
        &self.answer
    }
}

/// How to diagnose.
#[derive(Clone)]
pub struct Settings {
    /// Effects to consider.
    pub library: Vec<&'static dyn Effect>,
    /// Rows beyond which neighbours are averaged.
    pub rows: usize,
    /// The present simulation, where it is more than a straight spring.
    pub present: Option<Present>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            library: EFFECTS.to_vec(),
            rows: 1000,
            present: None,
        }
    }
}

/// Diagnoses one file.
pub fn diagnose(file: &LoadCycle, settings: &Settings) -> Diagnosis {
    let mut found = undoubted(file, settings);
    found.answer = found.answer.doubted(doubts(file));
    found
}

/// The diagnosis as if the data were beyond doubt.
fn undoubted(file: &LoadCycle, settings: &Settings) -> Diagnosis {
    if is_imposed(file) {
        return diagnose_imposed(file);
    }
    let case = Case::of(file, settings);
    let chosen = case.laws(&case.chosen());
    let mut shapes = case.name(&chosen);
    let scales = case.scales(&chosen);
    if let Some(present) = &case.present {
        shapes = case.beyond(present, &chosen, shapes);
    }
    let mut others = case.name_scales(&scales, &chosen);
    others.extend(case.name_lattice());
    case.conclude(chosen, (shapes, others), !scales.is_empty())
}
