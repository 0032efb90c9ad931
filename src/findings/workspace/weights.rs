//! A gap stands where the weight presses it, and no weight is known exactly: where force and
//! displacement are out of proportion, the weights fit along, point by point.

use super::patterns::{Pattern, Scene, Slopes};
use super::seats::{Seat, Seats};
use crate::fit::force_shapes::Shapes;
use crate::ground::spatial::M3;
use crate::motion::{Work, elastic, gravity_torque};
use crate::robot::Robot;

/// Masses are known to this share ...
const MASS: f64 = 0.02;
/// ... and centres of mass to this, m.
const CENTRE: f64 = 0.005;
/// Standard deviations of a weight that are tried.
const TRIED: [f64; 11] = [0.0, -0.5, 0.5, -1.0, 1.0, -1.5, 1.5, -2.0, 2.0, -2.5, 2.5];
/// Rounds of sizes and weights in turn.
const ROUNDS: usize = 4;

/// Fits the weights of every gap to the levels that the lines leave.
pub fn weigh(seats: &mut Seats, scene: &Scene, shapes: &Shapes, left: &[f64]) {
    let doubts = doubts(scene.robot, scene.points);
    let places: Vec<usize> = shapes.levels().iter().map(|level| level.point).collect();
    let tuned = |seat: &Seat, step: (usize, f64)| {
        let joint = scene
            .robot
            .joints
            .iter()
            .position(|j| j.name == seat.site)?;
        let doubt: Vec<f64> = doubts.iter().map(|d| d[joint]).collect();
        (!seat.stranger && doubt.iter().any(|d| *d > 0.0)).then_some(())?;
        let more = |t: &f64| doubt.iter().map(|d| t * d).collect();
        let mores: Vec<Vec<f64>> = TRIED.iter().map(more).collect();
        let tried = scene.heavier(seat.cause, &seat.site, step, &mores, shapes);
        let picked = pick(&tried, left, &places, doubt.len());
        let price = picked.iter().map(|t| 0.5 * TRIED[*t].powi(2)).sum();
        Some((mixed(&tried, &picked, &places), price))
    };
    seats.weigh_again(tuned);
}

/// Which weight fits best at every point with one size for all.
fn pick(tried: &[Pattern], left: &[f64], places: &[usize], points: usize) -> Vec<usize> {
    let mut sums = vec![vec![[0.0; 2]; tried.len()]; points];
    for (t, pattern) in tried.iter().enumerate() {
        for ((own, read), point) in pattern.left.iter().zip(left).zip(places) {
            sums[*point][t][0] += own * own;
            sums[*point][t][1] += own * read;
        }
    }
    let alone = |[own, both]: [f64; 2]| 0.5 * both.max(0.0).powi(2) / own.max(1e-300);
    let best = |value: &dyn Fn(usize, usize) -> f64| -> Vec<usize> {
        let at = |p: usize| {
            let pays = |t: &usize| value(p, *t) - 0.5 * TRIED[*t].powi(2);
            (0..tried.len()).fold(0, |b, t| if pays(&t) > pays(&b) + 1e-9 { t } else { b })
        };
        (0..points).map(at).collect()
    };
    let mut picked = best(&|p, t| alone(sums[p][t]));
    for _ in 0..ROUNDS {
        let all = |k: usize| (0..points).map(|p| sums[p][picked[p]][k]).sum::<f64>();
        let size = (all(1) / all(0).max(1e-300)).max(0.0);
        picked = best(&|p, t| size * sums[p][t][1] - 0.5 * size * size * sums[p][t][0]);
    }
    picked
}

/// The pattern with the picked weight at every point.
fn mixed(tried: &[Pattern], picked: &[usize], places: &[usize]) -> Pattern {
    let slopes: Vec<M3> = (0..picked.len())
        .map(|p| tried[picked[p]].slopes.at(p))
        .collect();
    let rows = places.iter().enumerate();
    let left = rows.map(|(row, p)| tried[picked[*p]].left[row]).collect();
    let slopes = Slopes::Everywhere(slopes);
    Pattern { slopes, left }
}

/// Standard deviation of the torque of the weight on every drive, N·m, by point and joint.
fn doubts(robot: &Robot, points: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let before = torques(robot, points);
    let mut squares = vec![vec![0.0; robot.dof()]; points.len()];
    for body in 0..=robot.dof() {
        for k in 0..4 {
            let mut other = robot.clone();
            let own = match other.joints.get_mut(body) {
                Some(joint) => joint.link.as_mut(),
                None => other.tool.body.as_mut(),
            };
            let Some(own) = own else { continue };
            match k {
                0 => own.mass *= 1.0 + MASS,
                k => own.com[k - 1] += CENTRE,
            }
            let after = torques(&other, points);
            for (squares, (a, b)) in squares.iter_mut().zip(after.iter().zip(&before)) {
                for (s, (a, b)) in squares.iter_mut().zip(a.iter().zip(b)) {
                    *s += (a - b).powi(2);
                }
            }
        }
    }
    let root = |row: Vec<f64>| row.into_iter().map(f64::sqrt).collect();
    squares.into_iter().map(root).collect()
}

fn torques(robot: &Robot, points: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let chain = elastic(robot);
    let mut work = Work::new(&chain);
    let at = |q: &Vec<f64>| {
        let all = gravity_torque(&chain, &mut work, &chain.spread(q));
        chain.drives.iter().map(|i| all[*i]).collect()
    };
    points.iter().map(at).collect()
}
