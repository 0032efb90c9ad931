//! A plan of set-ups with what it starts from.

use super::DiagnosedFile;
use super::start::Start;
use crate::findings::Answer;
use crate::findings::next_setups::{Desk, Plan};
use crate::ground::problem::Outcome;
use crate::measurement::workspace::Place;

/// Set-ups that a campaign's own report proposes.
const COUNT: usize = 5;

/// A plan.
pub struct Proposal {
    /// What it starts from.
    pub start: Start,
    /// The set-ups.
    pub plan: Plan,
    /// Number of pairs of places that the diagnosis left open.
    pub open: usize,
}

impl Proposal {
    /// The `count` set-ups that tell most; `answer`: of the diagnosis of the points.
    pub fn new(start: Start, answer: Option<&Answer>, count: usize) -> Self {
        let open = answer.map_or_else(Vec::new, open);
        let desk = Desk::new(&start.base.robot, &start.tests, start.points.as_ref());
        let desk = desk.within(start.rig.clone());
        Self {
            plan: desk.plan(count, &open),
            open: open.len(),
            start,
        }
    }

    /// Of a file whose points are diagnosed first: what that leaves open counts more.
    ///
    /// # Errors
    /// Points that cannot be diagnosed.
    pub fn after_diagnosis(start: Start, count: usize) -> Outcome<Self> {
        let test = start.points.as_ref();
        let file =
            test.map(|test| DiagnosedFile::with_axis_tests(&test.path, &start.place, &start.tests));
        let file = file.transpose()?;
        let answer = file.as_ref().map(|file| file.found.answer());
        Ok(Self::new(start, answer, count))
    }

    /// For a campaign whose files are diagnosed already; `None` if none of them names a robot.
    ///
    /// # Errors
    /// Several workspace tests to choose from, or a robot that cannot be simulated.
    pub fn of_campaign(place: &Place, files: &[DiagnosedFile]) -> Outcome<Option<Self>> {
        let start = Start::campaign(place.clone())?;
        Ok(start.map(|start| {
            let points = start.points.as_ref().map(|test| &test.path);
            let own = files
                .iter()
                .find(|one| Some(one.path()) == points.map(|p| p.as_path()));
            Self::new(start, own.map(|one| one.found.answer()), COUNT)
        }))
    }
}

/// Pairs of places that a diagnosis cannot tell apart.
fn open(answer: &Answer) -> Vec<(String, String)> {
    let mut pairs = Vec::new();
    for group in &answer.groups {
        for (i, a) in group.sites.iter().enumerate() {
            let others = group.sites[..i].iter().filter(|b| *b != a);
            pairs.extend(others.map(|b| (b.clone(), a.clone())));
        }
    }
    pairs.sort();
    pairs.dedup();
    pairs
}
