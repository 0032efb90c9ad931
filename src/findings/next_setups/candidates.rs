//! The set-ups to choose from: poses within the limits of the joints, the same on every machine.

use super::sights::{Reach, Seat, Setting};
use crate::ground::random::Random;
use crate::ground::spatial::norm;
use crate::ground::units::DEGREE;
use crate::motion::kinematics::forward_kinematics;
use crate::motion::{Work, rigid};
use crate::robot::Robot;

/// Poses to choose from besides those measured already.
const POSES: usize = 120;
/// Poses drawn: some reach into the floor or the robot itself.
const DRAWN: usize = 2000;
/// Poses kept for being the most stretched, and for being the most folded.
const EXTREME: usize = 10;
/// Angles are round numbers, deg.
const GRID: f64 = 15.0;
/// The tool stays above this, m.
const FLOOR: f64 = 0.2;
/// The tool stays this far from the first axis, m.
const COLUMN: f64 = 0.6;

/// Every set-up to choose from; `measured`: poses that were measured already, rad.
pub fn candidates(robot: &Robot, measured: &[Vec<f64>]) -> Vec<Setting> {
    let own = measured.iter().filter(|row| row.len() == robot.dof());
    let poses = own.cloned().chain(poses(robot));
    let seats = Seat::of(robot);
    let mut settings = Vec::new();
    for angles in poses {
        for reach in Reach::ALL {
            for direction in 0..3 {
                settings.extend(seats.iter().map(|seat| Setting {
                    angles: angles.clone(),
                    reach,
                    direction,
                    seat: *seat,
                }));
            }
        }
    }
    settings
}

/// Stretched, folded, and anything between, the wrist turned at random.
fn poses(robot: &Robot) -> Vec<Vec<f64>> {
    let chain = rigid(robot);
    let mut work = Work::new(&chain);
    let random = &mut Random::new(6);
    let mut found: Vec<(f64, Vec<f64>)> = Vec::new();
    for _ in 0..DRAWN {
        let angles = draw(robot, random);
        let tip = forward_kinematics(&chain, &mut work, &angles).point;
        if tip[2] > FLOOR && tip[0].hypot(tip[1]) > COLUMN {
            found.push((norm(tip), angles));
        }
    }
    let middle = found.len().min(POSES.saturating_sub(2 * EXTREME));
    let mut rest = found.split_off(middle);
    rest.sort_by(|a, b| a.0.total_cmp(&b.0));
    let last = rest.len().saturating_sub(EXTREME);
    let extreme = rest.iter().enumerate();
    let extreme = extreme.filter(|(i, _)| *i < EXTREME || *i >= last);
    found.extend(extreme.map(|(_, pose)| pose.clone()));
    found.into_iter().map(|pose| pose.1).collect()
}

fn draw(robot: &Robot, random: &mut Random) -> Vec<f64> {
    let angle = |limits: [f64; 2]| {
        let low = (limits[0] / DEGREE).max(-180.0);
        let high = (limits[1] / DEGREE).min(180.0).max(low);
        let steps = [(low / GRID).ceil(), (high / GRID).floor()];
        match steps[1] >= steps[0] {
            true => {
                let count = (steps[1] - steps[0]) as usize + 1;
                GRID * (steps[0] + random.below(count) as f64)
            }
            false => 0.5 * (low + high),
        }
    };
    let limits = robot.joints.iter().map(|joint| joint.limits);
    limits.map(angle).map(|degrees| degrees * DEGREE).collect()
}
