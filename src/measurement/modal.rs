//! Kind `modal`: the modes of a tool tip by numbers, with tool, material and cut: chatter without a robot.

use super::job::{Cutter, Material};
use super::keys::{Document, Keys};
use super::milling_force::CutSide;
use crate::ground::files::{read_bytes, sha256};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::stats::length;
use crate::ground::vector::V3;
use std::path::{Path, PathBuf};

/// One mode, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipMode {
    /// Unit vector along which the tip moves: x along the feed, z the spindle axis.
    pub direction: V3,
    /// Undamped frequency, Hz.
    pub frequency_hz: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Modal stiffness, N/m.
    pub stiffness: f64,
}

/// A file of this kind.
#[derive(Debug, Clone)]
pub struct Modal {
    /// Where it came from, and every further file that it named, each with its SHA-256.
    pub inputs: Vec<(PathBuf, String)>,
    /// The modes.
    pub modes: Vec<TipMode>,
    /// The tool.
    pub cutter: Cutter,
    /// What is cut.
    pub material: Material,
    /// Width of cut, m; a slot may leave it out.
    pub width: f64,
    /// Where the stock is.
    pub side: CutSide,
}

const KEYS: &[&str] = &[
    "kind",
    "modes",
    "tool",
    "material",
    "cut",
    "name",
    "source",
    "synthetic",
    "notes",
];
const MODE: &[&str] = &[
    "direction",
    "frequency_Hz",
    "damping_ratio",
    "stiffness_N_m",
    "name",
];
const CUT: &[&str] = &["width_mm", "cut", "feed_per_tooth_mm"];

/// The words for [`CutSide`].
pub const SIDES: &[(&str, CutSide)] = &[
    ("down", CutSide::Down),
    ("up", CutSide::Up),
    ("slot", CutSide::Slot),
];

impl Modal {
    /// Reads a file of kind `modal`.
    ///
    /// # Errors
    /// Whatever is unknown, missing or impossible, with file, line and remedy.
    pub fn read(path: &Path) -> Outcome<Self> {
        Self::of_bytes(path, &read_bytes(path)?).map_err(|problem| problem.in_text(path))
    }

    fn of_bytes(path: &Path, bytes: &[u8]) -> Outcome<Self> {
        let text = std::str::from_utf8(bytes)
            .map_err(|_| Problem::new("is not UTF-8 text", "save the file as UTF-8"))?;
        let document = Document::parse(text.trim_start_matches('\u{feff}'))?;
        let keys = document.keys(KEYS)?;
        let mut inputs = vec![(path.to_path_buf(), sha256(bytes))];
        let modes = keys.tables("modes", MODE)?;
        let modes = modes.iter().map(mode).collect::<Outcome<Vec<_>>>()?;
        if modes.is_empty() {
            return Err(keys.missing("modes", "[[modes]]"));
        }
        let cutter = Cutter::of(&keys)?;
        let cutter = cutter.ok_or_else(|| keys.missing("tool", "[tool]"))?;
        let material = Material::of(&keys, path, &mut inputs)?;
        let (width, side) = cut(&keys, cutter.diameter)?;
        Ok(Self {
            inputs,
            modes,
            cutter,
            material: material.ok_or_else(|| keys.missing("material", "[material]"))?,
            width,
            side,
        })
    }
}

fn mode(keys: &Keys<'_>) -> Outcome<TipMode> {
    let positive = |key: &str| {
        let value = keys.positive(key)?;
        value.ok_or_else(|| keys.missing(key, &format!("{key} = 1.0")))
    };
    let direction = keys.vector("direction")?;
    let direction = direction.ok_or_else(|| keys.missing("direction", "direction = [1, 0, 0]"))?;
    let length = length(&direction);
    if length < 1e-9 {
        return Err(keys.problem("direction", "has no length", "write for example [1, 0, 0]"));
    }
    let damped = |z: f64| (0.0..1.0).contains(&z);
    let remedy = "write the share of critical damping, as in 0.02";
    let damping = keys.judged("damping_ratio", damped, "not between 0 and 1", remedy)?;
    Ok(TipMode {
        direction: direction.map(|v| v / length),
        frequency_hz: positive("frequency_Hz")?,
        damping_ratio: damping
            .ok_or_else(|| keys.missing("damping_ratio", "damping_ratio = 0.02"))?,
        stiffness: positive("stiffness_N_m")?,
    })
}

fn cut(keys: &Keys<'_>, diameter: f64) -> Outcome<(f64, CutSide)> {
    let cut = keys.table("cut", CUT)?;
    let cut = cut.ok_or_else(|| keys.missing("cut", "[cut] with width_mm and cut = \"slot\""))?;
    let side = cut.choice("cut", SIDES)?;
    let side = side.ok_or_else(|| cut.missing("cut", "cut = \"slot\""))?;
    let width = cut.positive("width_mm")?.map(|mm| 1e-3 * mm);
    match (width, side) {
        (None, CutSide::Slot) => Ok((diameter, side)),
        (None, _) => Err(cut.missing("width_mm", "width_mm = 4.0")),
        (Some(width), _) if width > diameter * (1.0 + 1e-9) => Err(cut.problem(
            "width_mm",
            "is wider than the tool",
            "give the width of cut, at most the diameter",
        )),
        (Some(width), side) => Ok((width, side)),
    }
}
