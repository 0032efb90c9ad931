//! The set-ups to choose from: poses within the limits of the joints, the same on every machine.

use super::sights::{Reach, Seat, Setting};
use super::skeleton::Skeleton;
use crate::ground::random::Random;
use crate::ground::spatial::norm;
use crate::ground::units::DEGREE;
use crate::measurement::rig::Rig;
use crate::motion::kinematics::forward_kinematics;
use crate::motion::{Work, rigid};
use crate::robot::Robot;

/// Poses to choose from besides those measured already.
const POSES: usize = 120;
/// Poses drawn: some reach into the floor or the robot itself.
const DRAWN: usize = 2000;
/// Poses drawn where the tool must stay in a box: most of them miss it.
const DRAWN_IN_A_BOX: usize = 100_000;
/// Poses kept for being the most stretched, and for being the most folded.
const EXTREME: usize = 10;
/// Angles are round numbers, deg.
const GRID: f64 = 15.0;
/// The tool stays above this, m.
const FLOOR: f64 = 0.2;
/// The tool stays this far from the first axis, m.
const COLUMN: f64 = 0.6;

/// Every set-up to choose from that the laboratory can build; `measured`: poses that were measured already, rad.
pub fn candidates(robot: &Robot, measured: &[Vec<f64>], rig: &Rig) -> Vec<Setting> {
    let own = measured.iter().filter(|row| row.len() == robot.dof());
    let poses = own.cloned().chain(poses(robot, rig));
    let mut seats = Seat::of(robot);
    seats.retain(|seat| rig.sees(&seat.name()));
    let mut settings = Vec::new();
    for angles in poses {
        for reach in reaches(robot, &angles, rig) {
            for direction in (0..3).filter(|direction| rig.pulls(*direction)) {
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

/// The tools with which the load acts where the laboratory can bring one.
fn reaches(robot: &Robot, angles: &[f64], rig: &Rig) -> Vec<Reach> {
    let tip = |reach: Reach| {
        let setting = Setting {
            angles: angles.to_vec(),
            reach,
            direction: 0,
            seat: Seat::Tool,
        };
        Skeleton::of(robot, &setting).tip()
    };
    let bars = rig.bars.unwrap_or(true);
    let all = Reach::ALL.into_iter();
    let all = all.filter(|reach| bars || *reach == Reach::Mounted);
    all.filter(|reach| rig.is_free() || rig.reaches(tip(*reach)))
        .collect()
}

/// Stretched, folded, and anything between, the wrist turned at random.
fn poses(robot: &Robot, rig: &Rig) -> Vec<Vec<f64>> {
    let chain = rigid(robot);
    let mut work = Work::new(&chain);
    let random = &mut Random::new(6);
    let mut found: Vec<(f64, Vec<f64>)> = Vec::new();
    let drawn = if rig.is_free() { DRAWN } else { DRAWN_IN_A_BOX };
    for _ in 0..drawn {
        let angles = draw(robot, random);
        let tip = forward_kinematics(&chain, &mut work, &angles).point;
        if tip[2] > FLOOR && tip[0].hypot(tip[1]) > COLUMN && rig.reaches(tip) {
            found.push((norm(tip), angles));
        }
        if found.len() == DRAWN {
            break;
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
