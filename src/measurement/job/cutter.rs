//! `[tool]` of a job: the milling tool.

use crate::ground::problem::Outcome;
use crate::ground::units::DEGREE;
use crate::measurement::keys::Keys;
use std::f64::consts::TAU;

/// A milling tool, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cutter {
    /// Diameter, m.
    pub diameter: f64,
    /// Number of teeth, evenly spaced.
    pub teeth: usize,
    /// Helix angle, rad, positive right-handed; 0 if not stated.
    pub helix: f64,
    /// Corner radius, m: 0 square end, half the diameter ball end; 0 if not stated.
    pub corner_radius: f64,
    /// Length that cuts, m; `None`: not stated.
    pub flute: Option<f64>,
    /// Speed of the spindle, rad/s, positive clockwise seen from the spindle; `None`: the path's own.
    pub spindle: Option<f64>,
    /// Distance of the tool's axis from the spindle's, m; 0 if not stated.
    pub runout: f64,
    /// Direction of the run-out from tooth 1 at the tip, rad.
    pub runout_angle: f64,
}

const KEYS: &[&str] = &[
    "diameter_mm",
    "teeth",
    "helix_deg",
    "corner_radius_mm",
    "flute_mm",
    "spindle_rpm",
    "runout_um",
    "runout_angle_deg",
];

/// rad/s per revolution a minute.
const RPM: f64 = TAU / 60.0;
/// Steepest helix, degrees.
const STEEPEST: f64 = 89.0;

/// Least way along the circumference from tooth to tooth, m.
const CLOSEST: f64 = 1e-3;

impl Cutter {
    /// The table `[tool]`, if it is there; `modal` files hold the same table.
    ///
    /// # Errors
    /// An unknown, missing or impossible key, with its line.
    pub fn of(job: &Keys<'_>) -> Outcome<Option<Self>> {
        let keys = job.table("tool", KEYS)?;
        keys.map(|keys| Self::of_keys(&keys)).transpose()
    }

    fn of_keys(keys: &Keys<'_>) -> Outcome<Self> {
        let diameter = diameter(keys)?;
        let teeth = teeth(keys, diameter)?;
        Ok(Self {
            diameter,
            teeth: teeth.ok_or_else(|| keys.missing("teeth", "teeth = 2"))?,
            helix: helix(keys)?,
            corner_radius: corner_radius(keys, diameter)?,
            flute: keys.positive("flute_mm")?.map(|mm| mm * 1e-3),
            spindle: spindle(keys)?,
            runout: runout(keys, diameter)?,
            runout_angle: keys.number("runout_angle_deg")?.unwrap_or(0.0) * DEGREE,
        })
    }
}

/// No tool is wider, mm: heads that face engine blocks have 500.
const WIDEST_MM: f64 = 2000.0;

fn diameter(keys: &Keys<'_>) -> Outcome<f64> {
    let remedy = "give the diameter in millimetres, at most 2000";
    let is_tool = |mm: f64| mm > 0.0 && mm <= WIDEST_MM;
    let mm = keys.judged("diameter_mm", is_tool, "no diameter of a tool", remedy)?;
    let mm = mm.ok_or_else(|| keys.missing("diameter_mm", "diameter_mm = 16.0"))?;
    Ok(1e-3 * mm)
}

fn teeth(keys: &Keys<'_>, diameter: f64) -> Outcome<Option<usize>> {
    let teeth = keys.count("teeth", 1)?;
    let most = (std::f64::consts::PI * diameter / CLOSEST).floor().max(1.0);
    match teeth.filter(|n| *n as f64 > most) {
        None => Ok(teeth),
        Some(n) => {
            let what = format!("is {n}, more than stand around {} mm", diameter * 1e3);
            let remedy = format!("write how many teeth the tool has, at most {most} here");
            Err(keys.problem("teeth", what, remedy))
        }
    }
}

fn helix(keys: &Keys<'_>) -> Outcome<f64> {
    let remedy = "write the angle between edge and axis in degrees, for example 30.0";
    let helix = keys.judged(
        "helix_deg",
        |h| h.abs() <= STEEPEST,
        "no helix angle",
        remedy,
    )?;
    Ok(helix.unwrap_or(0.0) * DEGREE)
}

fn corner_radius(keys: &Keys<'_>, diameter: f64) -> Outcome<f64> {
    let radius = keys.not_negative("corner_radius_mm")?.unwrap_or(0.0) * 1e-3;
    if radius <= 0.5 * diameter * (1.0 + 1e-9) {
        return Ok(radius.min(0.5 * diameter));
    }
    let what = format!("is {} mm, more than half the diameter", radius * 1e3);
    let remedy = "write 0 for a square end, half the diameter for a ball end";
    Err(keys.problem("corner_radius_mm", what, remedy))
}

/// Share of the diameter that no runout reaches: the stock is taken by a tool that runs true.
const MOST_RUNOUT: f64 = 0.05;

fn runout(keys: &Keys<'_>, diameter: f64) -> Outcome<f64> {
    let is_one = |um: f64| um >= 0.0 && 1e-6 * um < MOST_RUNOUT * diameter;
    let remedy = "write how far the tool's axis is from the spindle's in micrometres: some 5 to 50, less than a twentieth of its diameter";
    let um = keys.judged("runout_um", is_one, "no runout of this tool", remedy)?;
    Ok(1e-6 * um.unwrap_or(0.0))
}

fn spindle(keys: &Keys<'_>) -> Outcome<Option<f64>> {
    let remedy = "write the speed, positive for M3 (clockwise seen from the spindle)";
    let rpm = keys.judged(
        "spindle_rpm",
        |rpm| rpm != 0.0,
        "no speed to cut with",
        remedy,
    )?;
    Ok(rpm.map(|rpm| rpm * RPM))
}
