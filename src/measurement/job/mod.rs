//! The job file: which robot mills which path, where, with which tool, out of what
//! (`measurements/README.md`, section 5.2). One file per table.

mod cutter;
mod limits;
mod material;
mod spindle;
mod workpiece;

pub use cutter::Cutter;
pub use limits::Limits;
pub use material::Material;
pub use spindle::{Spindle, SpindleBody};
pub use workpiece::{Stock, Workpiece};

use super::keys::{Document, Keys};
use crate::ground::files::{read_bytes, sha256};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::DEGREE;
use std::path::{Path, PathBuf};

/// A job, SI. Lengths in m, angles in rad; path and stock in the workpiece frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Job {
    /// The file.
    pub path: PathBuf,
    /// SHA-256 of the file, 64 hex digits.
    pub sha256: String,
    /// The robot for `robot::load::load`: its file, where there is one (see [`beside`]), else the
    /// name as written.
    pub robot: String,
    /// The path file, looked up already.
    pub toolpath: PathBuf,
    /// Feed, m/s; `None`: the path's own.
    pub feed: Option<f64>,
    /// `feed = "adapt"`: the feed may be lowered where a joint would exceed its limit.
    pub adapt: bool,
    /// Speed of rapid motions, m/s; `None`: five times the feed.
    pub rapid: Option<f64>,
    /// Distance from a corner at which its blend begins, m; 0: stop. `None`: the path's own
    /// ([`super::toolpath::Move::blend`]), else 0.
    pub blend_radius: Option<f64>,
    /// How the orientation turns between points.
    pub orientation: Turning,
    /// How the free turn about the spindle is used.
    pub spin: Spin,
    /// Interpolation cycle of the controller, s.
    pub cycle: f64,
    /// Joint angles that pick the branch of the inverse kinematics, rad; one per joint.
    pub start_joints: Option<Vec<f64>>,
    /// Where the part stands, and what it is cut from.
    pub workpiece: Workpiece,
    /// The milling tool.
    pub cutter: Option<Cutter>,
    /// What is cut.
    pub material: Option<Material>,
    /// Limits of motion, and what the part allows.
    pub limits: Limits,
    /// A spindle other than the tool of the robot file.
    pub spindle: Option<Spindle>,
    /// True when the file says of itself that nobody made this part.
    pub synthetic: bool,
    /// Further files that were read for it (the material), with their SHA-256.
    pub inputs: Vec<(PathBuf, String)>,
}

/// Where the orientation turns from that of one point to that of the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Turning {
    /// Within the blends.
    Blend,
    /// Within this distance of the corner, m.
    Radius(f64),
    /// Over the whole line, proportional to the distance.
    Whole,
}

/// How the free turn about the spindle is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spin {
    /// The turn of the first point, carried along without twist.
    Fixed,
    /// Least sum of squared joint motion over the whole path.
    Smooth,
    /// Least mean compliance normal to the path.
    Stiffest,
}

/// Every key outside of the tables, and the tables.
const KEYS: &[&str] = &[
    "kind",
    "robot",
    "path",
    "feed_mm_min",
    "feed",
    "rapid_mm_min",
    "blend_radius_mm",
    "orientation",
    "orientation_radius_mm",
    "spin",
    "cycle_ms",
    "start_joints_deg",
    "workpiece",
    "tool",
    "material",
    "limits",
    "spindle",
    "source",
    "synthetic",
    "notes",
];

/// Cycle of a controller that is not stated, ms (KRC2, source 000).
const CYCLE_MS: f64 = 12.0;
/// No controller is slower, ms: between its points a joint moves as it likes.
const SLOWEST_MS: f64 = 100.0;
/// m/s per mm/min.
const MM_MIN: f64 = 1e-3 / 60.0;
/// Most joints that a robot may have.
const MOST_JOINTS: usize = 64;

impl Job {
    /// Reads a job file, and the material file that it may name.
    ///
    /// # Errors
    /// Whatever is unknown, missing or impossible, with file, line and remedy.
    pub fn read(path: &Path) -> Outcome<Self> {
        let bytes = read_bytes(path)?;
        Self::of_bytes(path, &bytes).map_err(|problem| problem.in_text(path))
    }

    /// Interprets the bytes of a job file that stands at `path`.
    ///
    /// # Errors
    /// As [`Job::read`].
    pub fn of_bytes(path: &Path, bytes: &[u8]) -> Outcome<Self> {
        let document = Document::parse(text_of(bytes)?)?;
        let keys = document.keys(KEYS)?;
        expect_job(&keys)?;
        let mut inputs = Vec::new();
        Ok(Self {
            path: path.to_path_buf(),
            sha256: sha256(bytes),
            robot: robot(&keys, path)?,
            toolpath: beside(path, required(&keys, "path", "path = \"part.cls\"")?),
            feed: keys.positive("feed_mm_min")?.map(|feed| feed * MM_MIN),
            adapt: adapts(&keys)?,
            rapid: keys.positive("rapid_mm_min")?.map(|rapid| rapid * MM_MIN),
            blend_radius: keys.not_negative("blend_radius_mm")?.map(|mm| mm * 1e-3),
            orientation: turning(&keys)?,
            spin: keys.choice("spin", SPINS)?.unwrap_or(Spin::Smooth),
            cycle: cycle(&keys)?,
            start_joints: start_joints(&keys)?,
            workpiece: Workpiece::of(&keys, path)?,
            cutter: Cutter::of(&keys)?,
            material: Material::of(&keys, path, &mut inputs)?,
            limits: Limits::of(&keys)?,
            spindle: Spindle::of(&keys)?,
            synthetic: keys.flag("synthetic")?,
            inputs,
        })
    }

    /// Refuses a file that the job names under `key` and that is not there.
    ///
    /// # Errors
    /// There is no such file, with the line that names it.
    pub fn expect_file(&self, key: &str, file: &Path) -> Outcome<()> {
        match file.exists() {
            true => Ok(()),
            false => Err(Problem::new(
                format!("names {}, and no such file is there", file.display()),
                "correct the name; it counts from the folder of the job",
            )
            .at_key(&self.path, key)),
        }
    }

    /// The milling tool.
    ///
    /// # Errors
    /// The job has none.
    pub fn cutter(&self) -> Outcome<&Cutter> {
        let example = "[tool] with diameter_mm, teeth, spindle_rpm ...";
        self.cutter
            .as_ref()
            .ok_or_else(|| self.without("tool", example))
    }

    /// What is cut.
    ///
    /// # Errors
    /// The job does not say.
    pub fn material(&self) -> Outcome<&Material> {
        let example = "[material] with Ktc_N_mm2, Krc_N_mm2 ..., or name a material file";
        self.material
            .as_ref()
            .ok_or_else(|| self.without("material", example))
    }

    fn without(&self, key: &str, example: &str) -> Problem {
        let remedy = format!("add {example}");
        let problem = Problem::new("is missing", remedy).in_column(key);
        problem.at_line(1).in_file(&self.path)
    }
}

const SPINS: &[(&str, Spin)] = &[
    ("smooth", Spin::Smooth),
    ("fixed", Spin::Fixed),
    ("stiffest", Spin::Stiffest),
];

fn text_of(bytes: &[u8]) -> Outcome<&str> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        let line = 1 + before.iter().filter(|byte| **byte == b'\n').count();
        Problem::new("is not UTF-8 text", "save the file as UTF-8").at_line(line)
    })?;
    Ok(text.trim_start_matches('\u{feff}'))
}

fn expect_job(keys: &Keys<'_>) -> Outcome<()> {
    match keys.text("kind")? {
        Some("job") => Ok(()),
        Some(other) => Err(keys.problem(
            "kind",
            format!("is `{other}`, not `job`"),
            "give this verb a job file, which says `kind = \"job\"`",
        )),
        None => Err(keys.missing("kind", "kind = \"job\"")),
    }
}

fn required<'a>(keys: &Keys<'a>, key: &str, example: &str) -> Outcome<&'a str> {
    let name = keys.name(key)?;
    name.ok_or_else(|| keys.missing(key, example))
}

/// A built-in name stays as it is.
fn robot(keys: &Keys<'_>, job: &Path) -> Outcome<String> {
    let name = required(keys, "robot", "robot = \"kr210\"")?;
    let file = beside(job, name);
    Ok(match file.is_file() {
        true => file.display().to_string(),
        false => name.to_string(),
    })
}

/// Cycle of the controller, s.
fn cycle(keys: &Keys<'_>) -> Outcome<f64> {
    let ms = keys.positive("cycle_ms")?.unwrap_or(CYCLE_MS);
    match ms <= SLOWEST_MS {
        true => Ok(1e-3 * ms),
        false => Err(keys.problem(
            "cycle_ms",
            format!("is {ms}, no cycle of a controller"),
            "write the interpolation cycle in milliseconds, at most 100: controllers have 1 to 20",
        )),
    }
}

/// `feed = "adapt"`, or `"keep"`, which is the same as leaving it out.
fn adapts(keys: &Keys<'_>) -> Outcome<bool> {
    let words = [("adapt", true), ("keep", false)];
    Ok(keys.choice("feed", &words)?.unwrap_or(false))
}

fn turning(keys: &Keys<'_>) -> Outcome<Turning> {
    let radius = keys.positive("orientation_radius_mm")?.map(|mm| mm * 1e-3);
    let words = [
        ("blend", Some(Turning::Blend)),
        ("whole", Some(Turning::Whole)),
        ("radius", radius.map(Turning::Radius)),
    ];
    let chosen = keys.choice("orientation", &words)?;
    let turning = chosen.unwrap_or(Some(Turning::Blend));
    turning.ok_or_else(|| keys.missing("orientation_radius_mm", "orientation_radius_mm = 5.0"))
}

fn start_joints(keys: &Keys<'_>) -> Outcome<Option<Vec<f64>>> {
    let Some(degrees) = keys.numbers("start_joints_deg")? else {
        return Ok(None);
    };
    if degrees.is_empty() || degrees.len() > MOST_JOINTS {
        let what = format!("has {} angles", degrees.len());
        let remedy = "write one angle per joint: `[0, -90, 90, 0, 0, 0]`";
        return Err(keys.problem("start_joints_deg", what, remedy));
    }
    Ok(Some(degrees.iter().map(|q| q * DEGREE).collect()))
}

/// Where a file is that a job names: beside the job; else, for `fits/...`, in the workspace that the
/// job lies in; else from the folder that `ident` runs in.
pub fn beside(job: &Path, name: &str) -> PathBuf {
    let plain = PathBuf::from(name);
    let folder = job.parent().unwrap_or(Path::new(""));
    let first = folder.join(&plain);
    let workspace = folder
        .ancestors()
        .find(|f| f.file_name().is_some_and(|n| n == "measurements"))
        .and_then(Path::parent)
        .map(|root| root.join(&plain));
    let places = [Some(first.clone()), workspace, Some(plain)];
    let found = places.into_iter().flatten().find(|place| place.is_file());
    found.unwrap_or(first)
}
