//! The facts of a file of kind `milling-force`.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::DEGREE;
use crate::measurement::front::Front;
use crate::measurement::known_keys::unknown_key;
use std::f64::consts::TAU;
use toml::{Table, Value};

/// Side on which a cut meets its stock.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CutSide {
    /// Full slot.
    Slot,
    /// Teeth enter at φ = 0.
    Up,
    /// Teeth leave at φ = 180°: climb milling.
    Down,
}

/// The words for [`CutSide`].
const SIDES: [(&str, CutSide); 3] = [
    ("slot", CutSide::Slot),
    ("up", CutSide::Up),
    ("down", CutSide::Down),
];

/// One cut, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutFacts {
    /// Speed of the spindle, rad/s.
    pub spindle_rad_s: f64,
    /// Feed, m/s.
    pub feed_m_s: f64,
    /// Depth along the axis, m.
    pub depth_m: f64,
    /// Width across the feed, m.
    pub width_m: f64,
    /// Where the stock is.
    pub side: CutSide,
}

/// The coefficients that the simulation uses at present.
#[derive(Debug, Clone, PartialEq)]
pub struct Nominal {
    /// Keys as in `[material]` with their values, in the units of the keys.
    pub coefficients: Vec<(String, f64)>,
    /// How well they are known.
    pub rel_std: f64,
}

/// The facts, SI.
#[derive(Debug, Clone)]
pub struct Facts {
    /// Diameter of the tool, m.
    pub diameter_m: f64,
    /// Its teeth.
    pub teeth: usize,
    /// Its helix angle, rad.
    pub helix_rad: f64,
    /// The cuts.
    pub cuts: Vec<CutFacts>,
    /// The file's forces act on the tool (else on the workpiece).
    pub on_tool: bool,
    /// Corner frequency of the dynamometer's second-order Butterworth low pass, Hz.
    pub bandwidth_hz: Option<f64>,
    /// What the simulation uses at present.
    pub nominal: Option<Nominal>,
    /// Data-sheet noise, N.
    pub sensor_noise_n: Option<f64>,
    /// Runout as measured by other means, m.
    pub runout_m: Option<f64>,
    /// True when the file says that it was simulated.
    pub synthetic: bool,
}

pub(in crate::measurement) const KEYS: &[&str] = &[
    "diameter_mm",
    "teeth",
    "helix_deg",
    "cuts",
    "force_on",
    "bandwidth_Hz",
    "nominal",
    "sensor_noise_N",
    "runout_um",
    "robot",
    "material",
];

/// Most teeth of a tool.
const MOST_TEETH: f64 = 64.0;

impl Facts {
    pub(super) fn of(front: &Front) -> Outcome<Self> {
        front.only(KEYS)?;
        let diameter_m = diameter(front)?;
        Ok(Self {
            diameter_m,
            teeth: teeth(front)?,
            helix_rad: helix(front)?,
            cuts: cuts(front, 1e3 * diameter_m)?,
            on_tool: on_tool(front)?,
            bandwidth_hz: front.positive("bandwidth_Hz")?,
            nominal: nominal(front)?,
            sensor_noise_n: front.positive("sensor_noise_N")?,
            runout_m: front.not_negative("runout_um")?.map(|um| um * 1e-6),
            synthetic: front.synthetic(),
        })
    }
}

/// No tool is wider, mm, nor longer: heads that face engine blocks have 500.
const WIDEST_MM: f64 = 2000.0;

fn diameter(front: &Front) -> Outcome<f64> {
    let mm = required(front, "diameter_mm", "16.0")?;
    match mm <= WIDEST_MM {
        true => Ok(1e-3 * mm),
        false => Err(front.problem(
            "diameter_mm",
            format!("is {mm}"),
            format!("give the diameter in millimetres, at most {WIDEST_MM}"),
        )),
    }
}

fn required(front: &Front, key: &str, example: &str) -> Outcome<f64> {
    front.positive(key)?.ok_or_else(|| {
        Problem::new(
            format!("the front matter does not say `{key}`"),
            format!("add `# {key} = {example}`"),
        )
        .in_column(key)
        .at_line(1)
    })
}

fn teeth(front: &Front) -> Outcome<usize> {
    let teeth = required(front, "teeth", "2")?;
    match teeth.fract() == 0.0 && teeth <= MOST_TEETH {
        true => Ok(teeth as usize),
        false => Err(front.problem(
            "teeth",
            format!("is {teeth}"),
            format!("give a whole number of teeth, at most {MOST_TEETH}"),
        )),
    }
}

fn helix(front: &Front) -> Outcome<f64> {
    let degrees = front.not_negative("helix_deg")?.unwrap_or(0.0);
    match degrees <= 75.0 {
        true => Ok(degrees * DEGREE),
        false => Err(front.problem(
            "helix_deg",
            format!("is {degrees}"),
            "give the helix angle between 0 and 75 degrees",
        )),
    }
}

fn on_tool(front: &Front) -> Outcome<bool> {
    match front.text("force_on")? {
        None | Some("workpiece") => Ok(false),
        Some("tool") => Ok(true),
        Some(other) => Err(front.problem(
            "force_on",
            format!("is `{other}`"),
            "write `workpiece` (what a dynamometer below it measures) or `tool`",
        )),
    }
}

const CUTS_EXAMPLE: &str = "write `# cuts = [{ spindle_rpm = 10000, feed_mm_min = 3000, depth_mm = 1, width_mm = 16, cut = \"slot\" }]`";

fn cuts(front: &Front, diameter_mm: f64) -> Outcome<Vec<CutFacts>> {
    let refuse = |what: &str| front.problem("cuts", what, CUTS_EXAMPLE);
    let list = match front.facts.get("cuts") {
        None => {
            return Err(refuse("the front matter does not say which cuts were made").at_line(1));
        }
        Some(Value::Array(list)) if !list.is_empty() => list,
        Some(_) => return Err(refuse("is not a list of cuts")),
    };
    let cut = |(i, value): (usize, &Value)| {
        let table = value
            .as_table()
            .ok_or_else(|| refuse("is not a list of cuts"))?;
        cut(table, diameter_mm).map_err(|problem| {
            let key = problem.column.clone().unwrap_or_default();
            let what = format!("cut {}: `{key}` {}", i + 1, problem.what);
            front.problem("cuts", what, problem.remedy)
        })
    };
    list.iter().enumerate().map(cut).collect()
}

const CUT_KEYS: [&str; 5] = ["spindle_rpm", "feed_mm_min", "depth_mm", "width_mm", "cut"];

fn cut(table: &Table, diameter_mm: f64) -> Outcome<CutFacts> {
    if let Some(key) = table.keys().find(|k| !CUT_KEYS.contains(&k.as_str())) {
        return Err(unknown_key(key, &CUT_KEYS));
    }
    let width_mm = number(table, "width_mm")?;
    if width_mm > diameter_mm * (1.0 + 1e-9) {
        let what = format!("is {width_mm}, wider than the tool");
        return Err(
            Problem::new(what, "give the width of cut, at most the diameter").in_column("width_mm"),
        );
    }
    let depth_mm = number(table, "depth_mm")?;
    if depth_mm > WIDEST_MM {
        let what = format!("is {depth_mm}, deeper than any edge is long");
        return Err(Problem::new(what, "give the depth in millimetres").in_column("depth_mm"));
    }
    Ok(CutFacts {
        spindle_rad_s: number(table, "spindle_rpm")? * TAU / 60.0,
        feed_m_s: number(table, "feed_mm_min")? * 1e-3 / 60.0,
        depth_m: depth_mm * 1e-3,
        width_m: width_mm * 1e-3,
        side: side(table)?,
    })
}

fn side(table: &Table) -> Outcome<CutSide> {
    let word = table.get("cut").and_then(Value::as_str).unwrap_or_default();
    let found = SIDES.iter().find(|(name, _)| *name == word);
    found.map(|(_, side)| *side).ok_or_else(|| {
        Problem::new(
            "is not a kind of cut",
            "write `cut = \"slot\"`, `\"up\"` or `\"down\"`",
        )
        .in_column("cut")
    })
}

/// Largest number that a fact of a cut may be.
const LARGEST: f64 = 1e9;

fn number(table: &Table, key: &str) -> Outcome<f64> {
    let value = match table.get(key) {
        Some(Value::Float(x)) => *x,
        Some(Value::Integer(i)) => *i as f64,
        _ => f64::NAN,
    };
    match value > 1e-9 && value < LARGEST {
        true => Ok(value),
        false => Err(
            Problem::new("is not a number above zero", format!("write `{key} = 1.5`"))
                .in_column(key),
        ),
    }
}

fn nominal(front: &Front) -> Outcome<Option<Nominal>> {
    let refuse = |what: String| {
        front.problem(
            "nominal",
            what,
            "write `# nominal = { Ktc_N_mm2 = 700, Krc_N_mm2 = 300, Kac_N_mm2 = 0, Kte_N_mm = 20, Kre_N_mm = 20, Kae_N_mm = 0, rel_std = 0.1 }`",
        )
    };
    let table = match front.facts.get("nominal") {
        None => return Ok(None),
        Some(Value::Table(table)) => table,
        Some(_) => return Err(refuse("is not a table of coefficients".into())),
    };
    let mut coefficients = Vec::new();
    for (key, value) in table.iter().filter(|(key, _)| *key != "name") {
        let number = value.as_float().or(value.as_integer().map(|i| i as f64));
        match number.filter(|v| v.is_finite() && v.abs() < LARGEST) {
            Some(number) => coefficients.push((key.clone(), number)),
            None => return Err(refuse(format!("`{key}` is not a number"))),
        }
    }
    let rel_std = coefficients.iter().find(|(key, _)| key == "rel_std");
    let rel_std = rel_std.map_or(NOMINAL_REL_STD, |(_, value)| *value);
    coefficients.retain(|(key, _)| key != "rel_std");
    if rel_std < 0.0 {
        return Err(refuse("`rel_std` is below zero".into()));
    }
    // a force along the cut that pulls would drive the spindle
    let pulls = |(key, value): &&(String, f64)| key.starts_with("Kt") && *value < 0.0;
    if let Some((key, value)) = coefficients.iter().find(pulls) {
        return Err(refuse(format!("`{key}` is {value}, below zero")));
    }
    Ok(Some(Nominal {
        coefficients,
        rel_std,
    }))
}

/// How well coefficients are known that nobody says it of.
const NOMINAL_REL_STD: f64 = 0.1;
