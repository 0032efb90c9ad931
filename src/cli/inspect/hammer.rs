//! The account of hammer tests.

use super::{Account, degrees, range, span, title};
use crate::fit::suitability::Doubt;
use crate::fit::suitability::hammer::doubts;
use crate::ground::problem::Outcome;
use crate::ground::stats::largest;
use crate::measurement::hammer::{HammerRecord, HammerRun};
use crate::measurement::hammer_uff::read_any;
use crate::report::json;
use serde_json::{Value, json};
use std::path::Path;

/// Fewer hits than this average nothing and tell nothing of their scatter.
const FEWEST_HITS: usize = 3;

/// The records of one direction.
struct Direction<'a> {
    name: &'a str,
    runs: Vec<&'a HammerRun>,
}

/// Reads and tells.
pub fn account(path: &Path) -> Outcome<Account> {
    let record = read_any(path)?;
    let directions = directions(&record);
    Ok(Account {
        lines: lines(path, &record, &directions),
        json: document(path, &record, &directions),
        odd: odd(&record, &directions),
    })
}

fn directions(record: &HammerRecord) -> Vec<Direction<'_>> {
    let mut found: Vec<Direction> = Vec::new();
    for run in &record.runs {
        match found.iter_mut().find(|d| d.name == run.direction) {
            Some(own) => own.runs.push(run),
            None => found.push(Direction {
                name: &run.direction,
                runs: vec![run],
            }),
        }
    }
    found
}

impl Direction<'_> {
    /// Records that hold one hit; the others are continuous.
    fn hits(&self) -> usize {
        self.runs.iter().filter(|run| run.hit.is_some()).count()
    }

    fn length(&self, interval: f64) -> [f64; 2] {
        range(
            self.runs
                .iter()
                .map(|run| run.force.len() as f64 * interval),
        )
    }

    /// Largest force of each record, N.
    fn peak(&self) -> [f64; 2] {
        range(self.runs.iter().map(|run| largest(&run.force)))
    }
}

fn lines(path: &Path, record: &HammerRecord, directions: &[Direction]) -> Vec<String> {
    let robot = record
        .robot
        .as_deref()
        .unwrap_or("a structure, no robot named");
    let mut lines = title(path, &format!("hammer test of {robot}"), record.synthetic);
    if record.comparison {
        lines.push("a comparison: taken only when it is named".into());
    }
    if let Some(angles) = &record.joint_angles {
        lines.push(format!("joint angles: {:?} deg", degrees(angles)));
    }
    lines.push(format!(
        "sampled at {} Hz; accelerations measured along {}",
        rounded(1.0 / record.interval_s),
        record.outputs.join(", ")
    ));
    lines.extend(
        directions
            .iter()
            .map(|own| direction_line(own, record.interval_s)),
    );
    let noise = record.accelerometer_noise;
    let window = record.exponential_window_s;
    lines.push(format!(
        "noise of the accelerometer: {}; exponential window: {}",
        noise.map_or("not stated".into(), |x| format!("{x} m/s²")),
        window.map_or("none stated".into(), |x| format!("{x} s")),
    ));
    lines
}

/// `hits along x: 10 records of 4.096 s, peak force 310 to 520 N`.
fn direction_line(own: &Direction, interval: f64) -> String {
    let what = match own.hits() == own.runs.len() {
        true => "one hit each",
        false => "continuous, hits are found by trigger",
    };
    let [short, long] = own.length(interval).map(rounded);
    let [low, high] = own.peak();
    format!(
        "force along {}: {} records of {} s ({what}), peak force {} N",
        own.name,
        own.runs.len(),
        span(short, long),
        span(format!("{low:.1}"), format!("{high:.1}"))
    )
}

fn rounded(x: f64) -> f64 {
    (x * 1e6).round() / 1e6
}

fn document(
    path: &Path,
    record: &HammerRecord,
    directions: &[Direction],
) -> serde_json::Map<String, Value> {
    let direction = |own: &Direction| {
        json!({
            "direction": own.name, "records": own.runs.len(), "hits": own.hits(),
            "length_s": own.length(record.interval_s), "peak_force_N": own.peak(),
        })
    };
    let mut map = json::head("inspect", &[(path, &record.sha256)]);
    map.insert("kind".into(), json!("hammer"));
    map.insert("robot".into(), json!(record.robot));
    map.insert("synthetic".into(), json!(record.synthetic));
    let angles = record.joint_angles.as_deref().map(degrees);
    map.insert("joint_angles_deg".into(), json!(angles));
    map.insert("sampling_s".into(), json!(record.interval_s));
    map.insert("responses".into(), json!(record.outputs));
    map.insert(
        "directions".into(),
        directions.iter().map(direction).collect(),
    );
    map.insert(
        "accelerometer_noise_m_s2".into(),
        json!(record.accelerometer_noise),
    );
    map.insert(
        "exponential_window_s".into(),
        json!(record.exponential_window_s),
    );
    map
}

fn odd(record: &HammerRecord, directions: &[Direction]) -> Vec<String> {
    let mut odd = Vec::new();
    if record.robot.is_some() && record.joint_angles.is_none() {
        odd.push(
            "a robot is named, but no `joint_angles_deg`: `ident damping` needs the pose".into(),
        );
    }
    for own in directions {
        if own.hits() == own.runs.len() && own.hits() < FEWEST_HITS {
            odd.push(format!(
                "fewer than 3 hits along {1} ({0}): their scatter says little",
                own.hits(),
                own.name
            ));
        }
        let [short, long] = own.length(record.interval_s);
        if own.hits() == own.runs.len() && short < 0.5 * long {
            odd.push(format!(
                "the records along {} differ in length: {short} to {long} s",
                own.name
            ));
        }
        if own.peak()[0] == 0.0 {
            odd.push(format!("a record along {} holds no force", own.name));
        }
    }
    odd.extend(doubts(record).iter().map(Doubt::sentence));
    odd
}
