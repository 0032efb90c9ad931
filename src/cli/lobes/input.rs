//! What vibrates: the modes of a file of kind modal, or the robot of a job at its start pose.

use super::{Arguments, Case};
use crate::cutting::stability::TipMode;
use crate::cutting::wave::Side;
use crate::cutting::{Material, Tool};
use crate::ground::files::read_bytes;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::vector::{M3, V3, cross, dot, scale, sub};
use crate::measurement::job::{self, Cutter, Job};
use crate::measurement::milling_force::CutSide;
use crate::measurement::modal::{Modal, SIDES};
use crate::motion::kinematics::tcp;
use crate::motion::modes::modal;
use crate::motion::{Work, elastic, linearise};
use crate::robot::check;
use crate::robot::load::{Loaded, load};
use std::f64::consts::TAU;
use std::path::Path;

/// Reads the file, whichever of the two it is.
pub fn read(arguments: &Arguments) -> Outcome<Case> {
    let path = &arguments.file;
    let bytes = read_bytes(path)?;
    let text = String::from_utf8_lossy(&bytes);
    let table = text.parse::<toml::Table>().unwrap_or_default();
    match table.get("kind").and_then(toml::Value::as_str) {
        Some("modal") => Ok(of_modal(path, &Modal::read(path)?)),
        _ => of_job(arguments, &Job::read(path)?),
    }
}

fn name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    stem.to_string_lossy().to_string()
}

fn side(side: CutSide) -> Side {
    match side {
        CutSide::Slot => Side::Slot,
        CutSide::Up => Side::Up,
        CutSide::Down => Side::Down,
    }
}

fn tool(cutter: &Cutter) -> Tool {
    Tool {
        corner_radius_m: cutter.corner_radius,
        flute_m: cutter.flute.unwrap_or(f64::INFINITY),
        ..Tool::square(0.5 * cutter.diameter, cutter.teeth, cutter.helix)
    }
}

fn material(material: &job::Material) -> Material {
    Material {
        law: crate::cutting::LINEAR_EDGE,
        coefficients: [material.cutting, material.edge].concat(),
    }
}

fn of_modal(path: &Path, modal: &Modal) -> Case {
    let mode = |m: &crate::measurement::modal::TipMode| TipMode {
        direction: m.direction,
        omega: TAU * m.frequency_hz,
        damping_ratio: m.damping_ratio,
        stiffness: m.stiffness,
    };
    let input =
        |(path, hash): &(std::path::PathBuf, String)| (path.display().to_string(), hash.clone());
    Case {
        inputs: modal.inputs.iter().map(input).collect(),
        name: name(path),
        modes: modal.modes.iter().map(mode).collect(),
        tool: tool(&modal.cutter),
        material: material(&modal.material),
        width_m: modal.width,
        side: side(modal.side),
        spindle_rad_s: modal.cutter.spindle,
        remarks: round_end(&modal.cutter),
    }
}

fn round_end(cutter: &Cutter) -> Vec<String> {
    match cutter.corner_radius > 0.0 {
        true => vec![
            "The round end is counted as a square one: the limit is that of deeper cuts.".into(),
        ],
        false => Vec::new(),
    }
}

fn of_job(arguments: &Arguments, job: &Job) -> Outcome<Case> {
    let cutter = job.cutter()?;
    let loaded = load(&job.robot, Some(&job.path))?;
    check::dynamics(&loaded.robot).map_err(|p| p.in_text(Path::new(&loaded.path)))?;
    let width_m = match arguments.width_mm {
        Some(mm) if mm > 0.0 && 1e-3 * mm <= cutter.diameter * (1.0 + 1e-9) => 1e-3 * mm,
        Some(mm) => {
            return Err(Problem::new(
                format!("is {mm}"),
                "give a width above zero, at most the diameter of the tool",
            )
            .in_column("--width-mm"));
        }
        None => cutter.diameter,
    };
    let found = SIDES.iter().find(|(word, _)| *word == arguments.cut);
    let mut inputs = vec![
        (job.path.display().to_string(), job.sha256.clone()),
        loaded.input(),
    ];
    let further = job.inputs.iter();
    inputs.extend(further.map(|(p, hash)| (p.display().to_string(), hash.clone())));
    let mut remarks = vec![
        "The robot stands at start_joints_deg of the job; the feed goes along x of the workpiece."
            .to_string(),
    ];
    remarks.extend(round_end(cutter));
    Ok(Case {
        inputs,
        name: name(&job.path),
        modes: robot_modes(job, &loaded)?,
        tool: tool(cutter),
        material: material(job.material()?),
        width_m,
        side: side(found.map_or(CutSide::Slot, |s| s.1)),
        spindle_rad_s: cutter.spindle,
        remarks,
    })
}

/// The robot's modes at the start pose, cut frame.
fn robot_modes(job: &Job, loaded: &Loaded) -> Outcome<Vec<TipMode>> {
    let robot = &loaded.robot;
    let joints = job.start_joints.clone().unwrap_or_default();
    if joints.len() != robot.joints.len() {
        return Err(Problem::new(
            format!(
                "has {} angles, the robot {} joints",
                joints.len(),
                robot.joints.len()
            ),
            "write one angle per joint in the job: the pose at which the lobes are asked for",
        )
        .at_key(&job.path, "start_joints_deg"));
    }
    let chain = elastic(robot);
    let mut work = Work::new(&chain);
    let q = chain.spread(&joints);
    let linear = linearise(&chain, &mut work, &q)?;
    let modal = modal(&linear)?;
    let pose = tcp(&chain, &work);
    let axes = cut_frame(job, loaded, &pose.rotation);
    let mode = |i: usize| {
        let tau = modal.inertia[i].sqrt();
        TipMode {
            direction: std::array::from_fn(|k| dot(axes[k], modal.tool[i])),
            omega: 1.0 / tau,
            damping_ratio: 0.5 * modal.damping[i * modal.n + i] / tau,
            stiffness: 1.0,
        }
    };
    Ok((0..modal.n).map(mode).collect())
}

/// Axes of the cut frame in the base frame: feed along x of the workpiece, z the spindle axis.
fn cut_frame(job: &Job, loaded: &Loaded, rotation: &M3) -> [V3; 3] {
    let tool = &loaded.robot.tool;
    let unit = |v: V3| scale(1.0 / dot(v, v).sqrt().max(1e-12), v);
    let own = unit(sub(tool.flange, tool.tcp));
    let at_zero = transpose_times(&tool.rotation, own);
    let z = times(rotation, at_zero);
    let feed = feed(job);
    let across = cross(z, feed);
    let y = match dot(across, across) > 1e-6 {
        true => unit(across),
        false => unit(cross(z, [0.0, 1.0, 0.0])),
    };
    [cross(y, z), y, z]
}

/// The x axis of the workpiece.
fn feed(job: &Job) -> V3 {
    times(&job.workpiece.frame.rotation, [1.0, 0.0, 0.0])
}

fn times(m: &M3, v: V3) -> V3 {
    m.map(|row| dot(row, v))
}

fn transpose_times(m: &M3, v: V3) -> V3 {
    std::array::from_fn(|k| (0..3).map(|i| m[i][k] * v[i]).sum())
}
