//! What vibrates: the modes of a file of kind modal, or the robot of a job at its start pose.

use super::{Arguments, CHIP, Case};
use crate::cutting::stability::TipMode;
use crate::cutting::wave::Side;
use crate::cutting::{Material, Tool};
use crate::ground::files::read_bytes;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::job::{self, Cutter, Job};
use crate::measurement::milling_force::CutSide;
use crate::measurement::modal::{Modal, SIDES};
use crate::process::Planned;
use crate::process::measured_tip::MeasuredTip;
use crate::process::tip_modes::{Station, carrier};
use crate::robot::check;
use crate::robot::load::{Loaded, load};
use std::f64::consts::TAU;
use std::path::Path;

/// Reads the file, whichever of the two it is, and what was measured at the tool's tip.
pub fn read(arguments: &Arguments) -> Outcome<Case> {
    let mut case = read_file(arguments)?;
    let measured = tool_modes(arguments, &mut case)?;
    case.modes.extend(measured);
    Ok(case)
}

/// The modes that were measured at the tip of the tool, where a file is given.
pub fn tool_modes(arguments: &Arguments, case: &mut Case) -> Outcome<Vec<TipMode>> {
    let Some(path) = &arguments.tool_frf else {
        return Ok(Vec::new());
    };
    let measured = MeasuredTip::read(path)?;
    case.inputs
        .push((path.display().to_string(), measured.sha256));
    case.remarks.extend(measured.remarks);
    Ok(measured.modes)
}

fn read_file(arguments: &Arguments) -> Outcome<Case> {
    let path = &arguments.file;
    let bytes = read_bytes(path)?;
    let text = String::from_utf8_lossy(&bytes);
    let table = text.parse::<toml::Table>().unwrap_or_default();
    match is_modal(&table) {
        true => modal(arguments, path),
        false => match arguments.station {
            Some(mm) => at_station(arguments, mm),
            None => at_start(arguments),
        },
    }
}

fn is_modal(table: &toml::Table) -> bool {
    table.get("kind").and_then(toml::Value::as_str) == Some("modal")
}

fn modal(arguments: &Arguments, path: &Path) -> Outcome<Case> {
    let asks = [
        ("--along", "has no path", arguments.along),
        ("--station", "has no path", arguments.station.is_some()),
        ("--cut", "states its own cut", arguments.cut.is_some()),
        (
            "--width-mm",
            "states its own cut",
            arguments.width_mm.is_some(),
        ),
    ];
    match asks.iter().find(|(.., is_asked)| *is_asked) {
        Some((option, what, _)) => Err(Problem::new(
            format!("a file of kind modal {what}"),
            format!("give a job, or leave {option} out"),
        )
        .in_file(path)),
        None => Ok(of_modal(path, &Modal::read(path)?)),
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
    Material::of(material.law, &material.coefficients)
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
        remarks: ignored(modal)
            .into_iter()
            .chain(counted(&modal.cutter, &material(&modal.material)))
            .collect(),
    }
}

/// What a file states that a slot does not have.
fn ignored(modal: &Modal) -> Option<String> {
    let is_narrow = modal.width < modal.cutter.diameter * (1.0 - 1e-9);
    (modal.side == CutSide::Slot && is_narrow).then(|| {
        "A slot is as wide as the tool: the file's width_mm is not used; cut = \"up\" or \"down\" has one."
            .into()
    })
}

/// What is counted otherwise than it is.
fn counted(cutter: &Cutter, material: &Material) -> Vec<String> {
    let round = (cutter.corner_radius > 0.0).then(|| {
        "The round end is counted as a square one: the limit is that of deeper cuts.".into()
    });
    let bent = (material.slope(CHIP) != material.slope(2.0 * CHIP)).then(|| {
        let (law, chip) = (material.law.card().name, 1e3 * CHIP);
        format!(
            "The law {law} is taken as straight about a chip of {chip} mm: thinner chips chatter at smaller depths, thicker ones at greater."
        )
    });
    round.into_iter().chain(bent).collect()
}

/// The job planned, and the cut at each of its places, without modes yet.
pub fn planned(arguments: &Arguments) -> Outcome<(Case, Planned)> {
    let bytes = read_bytes(&arguments.file)?;
    let table = String::from_utf8_lossy(&bytes).parse::<toml::Table>();
    if is_modal(&table.unwrap_or_default()) {
        modal(arguments, &arguments.file)?;
    }
    let planned = Planned::read(&arguments.file)?;
    let robot = &planned.plan.cell.robot;
    check::dynamics(robot).map_err(|p| p.in_file(&planned.job.path))?;
    let case = of_job(arguments, &planned.job, planned.inputs.clone())?;
    Ok((case, planned))
}

/// The cut of a job, what vibrates left open.
fn of_job(arguments: &Arguments, job: &Job, inputs: Vec<(String, String)>) -> Outcome<Case> {
    let cutter = job.cutter()?;
    let asked = arguments.cut.as_deref();
    let found = SIDES.iter().find(|(word, _)| Some(*word) == asked);
    let side_of_stock = found.map_or(CutSide::Slot, |s| s.1);
    Ok(Case {
        inputs,
        name: name(&job.path),
        modes: Vec::new(),
        tool: tool(cutter),
        material: material(job.material()?),
        width_m: width(arguments, side_of_stock, cutter)?,
        side: side(side_of_stock),
        spindle_rad_s: cutter.spindle,
        remarks: counted(cutter, &material(job.material()?)),
    })
}

fn at_station(arguments: &Arguments, mm: f64) -> Outcome<Case> {
    let (mut case, planned) = planned(arguments)?;
    let length_mm = 1e3 * planned.plan.path.length;
    if !(0.0..=length_mm).contains(&mm) {
        return Err(Problem::new(
            format!("is {mm}"),
            format!("give an arc length of the path: 0 to {length_mm:.3} mm"),
        )
        .in_column("--station"));
    }
    let station = Station::at(&planned.plan, 1e-3 * mm);
    case.modes = station.modes(&mut carrier(&planned.job, &planned.plan.cell.robot))?;
    case.remarks.push(format!(
        "The robot stands where the tool is after {mm} mm of the path, the feed goes along it."
    ));
    Ok(case)
}

fn at_start(arguments: &Arguments) -> Outcome<Case> {
    let job = Job::read(&arguments.file)?;
    let loaded = load(&job.robot, Some(&job.path))?;
    check::dynamics(&loaded.robot).map_err(|p| p.in_text(Path::new(&loaded.path)))?;
    let named = job.inputs.iter();
    let mut inputs = vec![
        (job.path.display().to_string(), job.sha256.clone()),
        loaded.input(),
    ];
    inputs.extend(named.map(|(p, hash)| (p.display().to_string(), hash.clone())));
    let mut case = of_job(arguments, &job, inputs)?;
    case.modes = start(&mut case, &job, &loaded)?;
    Ok(case)
}

fn width(arguments: &Arguments, side: CutSide, cutter: &Cutter) -> Outcome<f64> {
    let is_full = |mm: f64| (1e-3 * mm / cutter.diameter - 1.0).abs() < 1e-9;
    match arguments.width_mm {
        None => Ok(cutter.diameter),
        Some(mm) if side == CutSide::Slot && !is_full(mm) => Err(Problem::new(
            format!("is {mm}, and a slot is as wide as the tool"),
            "leave it out, or ask with --cut up or --cut down",
        )
        .in_column("--width-mm")),
        Some(mm) if mm > 0.0 && 1e-3 * mm <= cutter.diameter * (1.0 + 1e-9) => Ok(1e-3 * mm),
        Some(mm) => Err(Problem::new(
            format!("is {mm}"),
            "give a width above zero, at most the diameter of the tool",
        )
        .in_column("--width-mm")),
    }
}

/// The robot's modes at the start pose.
fn start(case: &mut Case, job: &Job, loaded: &Loaded) -> Outcome<Vec<TipMode>> {
    if job.start_joints.is_none() {
        return Err(Problem::new(
            "states no start_joints_deg",
            "add the pose at which the lobes are asked for, or ask with --station or --along",
        )
        .in_file(&job.path));
    }
    case.remarks.push(START.into());
    let (station, robot) = Station::start(job, &loaded.robot)?;
    station.modes(&mut carrier(job, &robot))
}

const START: &str =
    "The robot stands at start_joints_deg of the job; the feed goes along x of the workpiece.";
