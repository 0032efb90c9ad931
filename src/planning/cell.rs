//! The robot, its spindle and the part, as a job puts them together.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{Pose, V3, add, product, rotate, rotate_back, sub, transpose};
use crate::ground::units::DEGREE;
use crate::measurement::job::{Job, Spindle};
use crate::motion::inverse::SphericalWrist;
use crate::motion::{self, Chain, Work, forward_kinematics};
use crate::path::Quaternion;
use crate::path::element::Holding;
use crate::robot::{Body, Robot};

/// Number of joints of the robots that can be planned for.
pub const JOINTS: usize = 6;

/// Robot and part in place.
#[derive(Debug, Clone)]
pub struct Cell {
    /// The robot with the job's spindle on it.
    pub robot: Robot,
    /// Its driven joints, everything rigid.
    pub chain: Chain,
    /// Closed-form inverse kinematics; `None`: another geometry, solved numerically.
    pub wrist: Option<SphericalWrist>,
    /// The workpiece frame in the base frame.
    pub workpiece: Pose,
    /// Unit vector from the tip into the spindle, in the tool frame.
    pub spindle: V3,
    /// Joint angles that pick the branch, rad.
    pub start: [f64; JOINTS],
}

impl Cell {
    /// Mounts the job's spindle and places its part.
    ///
    /// # Errors
    /// A robot without six joints, start angles that do not suit it, a spindle axis that nothing
    /// states.
    pub fn of(job: &Job, robot: &Robot) -> Outcome<Self> {
        let mut robot = robot.clone();
        if let Some(spindle) = &job.spindle {
            mount(&mut robot, spindle);
        }
        let chain = motion::build::rigid(&robot);
        let limits: Vec<[f64; 2]> = robot.joints.iter().map(|joint| joint.limits).collect();
        let spindle = robot.tool.spindle_in_tool().ok_or_else(no_axis)?;
        if robot.dof() != JOINTS {
            let remedy = "plan for a robot with six joints";
            return Err(Problem::new(
                format!("the robot has {} joints", robot.dof()),
                remedy,
            ));
        }
        Ok(Self {
            wrist: SphericalWrist::of(&chain, &limits),
            start: start(job, &limits).map_err(|problem| problem.in_file(&job.path))?,
            workpiece: job.workpiece.frame,
            spindle,
            chain,
            robot,
        })
    }

    /// A pose in the workpiece frame, in the base frame.
    pub fn in_base(&self, point: V3, orientation: Quaternion) -> Pose {
        let frame = &self.workpiece;
        Pose {
            rotation: product(&frame.rotation, &orientation.matrix()),
            point: add(frame.point, rotate(&frame.rotation, point)),
        }
    }

    /// A pose in the base frame, in the workpiece frame.
    pub fn in_workpiece(&self, pose: &Pose) -> Pose {
        let frame = &self.workpiece;
        Pose {
            rotation: product(&transpose(&frame.rotation), &pose.rotation),
            point: rotate_back(&frame.rotation, sub(pose.point, frame.point)),
        }
    }

    /// How the tool is held where the path gives only the spindle's direction: the tool frame of the
    /// start angles, brought to the first direction by the least rotation.
    pub fn holding(&self) -> Holding {
        let mut work = Work::new(&self.chain);
        let pose = forward_kinematics(&self.chain, &mut work, &self.start);
        Holding {
            axis: self.spindle,
            start: Quaternion::of(&self.in_workpiece(&pose).rotation),
        }
    }
}

fn no_axis() -> Problem {
    Problem::new(
        "the robot does not say where its spindle points: tool centre point and flange are one",
        "add `spindle_axis` to [tool] of the robot file, or `axis` to [spindle] of the job",
    )
}

/// The start angles, or the middle of the limits nearest to zero.
fn start(job: &Job, limits: &[[f64; 2]]) -> Outcome<[f64; JOINTS]> {
    let Some(given) = &job.start_joints else {
        let middle = |[low, high]: &[f64; 2]| 0.0_f64.clamp(*low, *high);
        let middle: Vec<f64> = limits.iter().map(middle).collect();
        return Ok(middle.try_into().unwrap_or([0.0; JOINTS]));
    };
    let here = |problem: Problem| problem.at_key(&job.path, "start_joints_deg");
    let start: [f64; JOINTS] = given.as_slice().try_into().map_err(|_| {
        let what = format!("has {} angles, the robot six joints", given.len());
        here(Problem::new(
            what,
            "write one angle per joint: `[0, -90, 90, 0, 0, 0]`",
        ))
    })?;
    let beyond = |k: &usize| !within(start[*k], limits[*k]);
    match (0..JOINTS.min(limits.len())).find(beyond) {
        None => Ok(start),
        Some(k) => {
            let [low, high] = limits[k].map(|q| q / DEGREE);
            let what = format!(
                "has {:.3} degrees for joint {}, which moves from {low:.1} to {high:.1}",
                start[k] / DEGREE,
                k + 1
            );
            Err(here(Problem::new(
                what,
                "check sign and order of the angles, and the limits of the robot file",
            )))
        }
    }
}

/// Whether an angle lies in a range, to within what is rounded in files.
fn within(q: f64, [low, high]: [f64; 2]) -> bool {
    (low - ROUNDING..=high + ROUNDING).contains(&q)
}

/// A hundredth of a degree, rad.
const ROUNDING: f64 = 0.01 * DEGREE;

fn mount(robot: &mut Robot, spindle: &Spindle) {
    let tool = &mut robot.tool;
    tool.flange = spindle.flange.unwrap_or(tool.flange);
    tool.tcp = spindle.tcp.unwrap_or(tool.tcp);
    tool.rotation = spindle.rotation.unwrap_or(tool.rotation);
    tool.spindle_axis = spindle.axis;
    if let Some(body) = &spindle.body {
        tool.body = Some(Body {
            mass: body.mass,
            com: body.com,
            inertia: body.inertia,
        });
    }
}
