//! What lies beyond proportion although nothing is wrong: springs that turn by finite angles, and forces
//! that were told on a coarse grid.

use crate::experiments::finite_turns::FiniteTurns;
use crate::fit::force_shapes::{Level, Shapes};
use crate::fit::told_force::{distinct, grid};
use crate::ground::spatial::{V3, norm, scale};
use crate::measurement::workspace_test::WorkspaceTest;
use crate::robot::Robot;

/// What turns do beyond proportion is known to this share: it goes with the square of compliances, which are known
/// to a tenth or two ...
const TURNS: f64 = 0.3;
/// ... and no displacement is in proportion to better than this share of itself: bearings harden, beams shorten.
const PROPORTION: f64 = 0.001;
/// Standard deviation of the share of it that is there, about all of it, before the data: none at all, as where
/// somebody simulated in proportion, lies two of these away.
const PRESENT: f64 = 0.5;

/// Slopes by set-up and component, m/N, and levels in standard deviations.
type Seen = (Vec<[Option<f64>; 3]>, Vec<f64>);

/// The even part of the displacement, and how well it is known.
pub(super) struct Beyond {
    turns: FiniteTurns,
    /// Standard deviation of a told force, N.
    rounding: f64,
    /// The sizes of force that were told, N, where they are few: what each is wrong by, all set-ups share.
    sizes: Vec<f64>,
}

/// Where more forces than this are told apart, weights were laid on by hand, and every reading is wrong by an
/// amount of its own: twice the levels of a half cycle that are told apart (`fit/force_rest`).
const MOST_SIZES: usize = 40;

impl Beyond {
    pub(super) fn of(robot: &Robot, test: &WorkspaceTest) -> Self {
        let forces = || test.steps.iter().map(|step| step.force);
        let rounding = grid(forces()).unwrap_or(0.0) / 12_f64.sqrt();
        let mut sizes = match rounding > 0.0 {
            true => distinct(forces()),
            false => Vec::new(),
        };
        if sizes.len() > MOST_SIZES {
            sizes.clear();
        }
        let largest = forces().fold(0.0_f64, |most, force| most.max(force.abs()));
        Self {
            turns: FiniteTurns::of(robot, &test.facts.joint_angles, largest),
            rounding,
            sizes,
        }
    }

    /// Slopes and levels with as much of what turns add as the levels that were `read` show: all of it in a
    /// laboratory, none in a simulation that was made in proportion.
    pub(super) fn added(&self, shapes: &Shapes, read: &[f64], (lines, left): Seen) -> Seen {
        let moved = |p: usize, d: usize, forces: &[f64]| -> Vec<V3> {
            let beyond = forces.iter().map(|force| self.turns.beyond((p, d), *force));
            beyond.collect()
        };
        let (more_lines, more_left) = shapes.seen(moved);
        let rest = read.iter().zip(&left).map(|(read, own)| read - own);
        let product: f64 = rest.zip(&more_left).map(|(rest, more)| rest * more).sum();
        let square: f64 = more_left.iter().map(|more| more * more).sum();
        let prior = PRESENT.powi(-2);
        let share = ((product + prior) / (square + prior)).clamp(0.0, 1.0);
        let line = |(own, more): (&[Option<f64>; 3], &[Option<f64>; 3])| {
            [0, 1, 2].map(|k| Some(own[k]? + share * more[k]?))
        };
        let levels = left.iter().zip(&more_left);
        (
            lines.iter().zip(&more_lines).map(line).collect(),
            levels.map(|(own, more)| own + share * more).collect(),
        )
    }

    /// Tells the shapes how well the levels can be predicted.
    pub(super) fn doubt(&self, shapes: &mut Shapes) {
        let alone = match self.sizes.is_empty() {
            true => self.rounding,
            false => 0.0,
        };
        let doubt = |level: &Level| {
            let place = (level.point, level.direction);
            let slope = slope(shapes, place);
            let turns = TURNS * self.turns.size(place, level.force);
            let told = alone * slope[level.component].abs();
            let straight = PROPORTION * norm(slope) * level.force.abs();
            turns.hypot(told).hypot(straight)
        };
        let doubts: Vec<f64> = shapes.levels().iter().map(doubt).collect();
        shapes.doubt(&doubts);
        let error = |size: &f64| self.misread(shapes, *size);
        let errors: Vec<Vec<f64>> = self.sizes.iter().map(error).collect();
        shapes.share(&errors);
    }

    /// What the levels would show if every force of this size (N) were told wrongly by one deviation.
    fn misread(&self, shapes: &Shapes, size: f64) -> Vec<f64> {
        let moved = |p: usize, d: usize, forces: &[f64]| -> Vec<V3> {
            let slope = slope(shapes, (p, d));
            let wrong = |force: &f64| match (force.abs() - size).abs() < 1e-6 * size {
                true => self.rounding.copysign(*force),
                false => 0.0,
            };
            let each = forces.iter().map(|force| scale(wrong(force), slope));
            each.collect()
        };
        shapes.seen(moved).1
    }
}

/// The measured slopes of a set-up, m/N; none: zero.
fn slope(shapes: &Shapes, (point, direction): (usize, usize)) -> V3 {
    let here = shapes.setup(point, direction);
    let lines = here.map_or([None; 3], |i| shapes.setups[i].lines);
    lines.map(|line| line.map_or(0.0, |line| line.slope))
}
