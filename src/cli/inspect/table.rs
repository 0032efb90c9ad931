//! The account of a kind that has none of its own: its facts, columns and ranges.

use super::{Account, range, title};
use crate::fit::suitability::{self, Doubt};
use crate::ground::problem::Outcome;
use crate::measurement::cubes::CubeTest;
use crate::measurement::force_sensor::SensorTest;
use crate::measurement::joint_motion::JointMotion;
use crate::measurement::milled_part::PartTest;
use crate::measurement::milling_force::MillingForce;
use crate::measurement::screw::ScrewTest;
use crate::measurement::table::{Cells, Column, Table};
use crate::report::json;
use crate::robot::load;
use crate::sheet::number::significant;
use serde_json::{Value, json};
use std::path::Path;

/// What is odd about a file of a kind.
type Gate = fn(&Path) -> Outcome<Vec<Doubt>>;

/// The gates of these kinds.
const GATES: &[(&str, Gate)] = &[
    ("joint-motion", |path| {
        let file = JointMotion::read(path)?;
        Ok(suitability::joint_motion::doubts(&file, |joint| {
            joint.nominal_stiffness
        }))
    }),
    ("cubes", |path| {
        let test = CubeTest::read(path)?;
        let robot = load(&test.facts.robot, Some(path))?;
        Ok(suitability::cubes::doubts(&test, &robot.robot))
    }),
    ("force-sensor", |path| {
        Ok(suitability::force_sensor::doubts(&SensorTest::read(path)?))
    }),
    ("screw", |path| {
        Ok(suitability::screw::doubts(&ScrewTest::read(path)?))
    }),
    ("milled-part", |path| {
        Ok(suitability::milled_part::doubts(&PartTest::read(path)?))
    }),
    ("milling-force", |path| {
        Ok(suitability::milling_force::doubts(&MillingForce::read(
            path,
        )?))
    }),
];

/// What the gate of the kind finds odd, or why its reader refuses the file.
fn doubted(kind: &str, path: &Path) -> Vec<String> {
    let gate = GATES.iter().find(|(name, _)| *name == kind);
    match gate.map(|(_, gate)| gate(path)) {
        None => Vec::new(),
        Some(Ok(doubts)) => doubts.iter().map(Doubt::sentence).collect(),
        Some(Err(problem)) => vec![format!("{}: {}", problem.what, problem.remedy)],
    }
}

/// Reads and tells.
pub fn account(path: &Path) -> Outcome<Account> {
    let table = Table::read(path)?;
    let kind = table.front.text("kind")?.unwrap_or("unnamed").to_string();
    let columns = table.columns.iter().filter_map(odd);
    Ok(Account {
        lines: lines(&table, &kind),
        odd: columns.chain(doubted(&kind, path)).collect(),
        json: document(&table, &kind),
    })
}

fn lines(table: &Table, kind: &str) -> Vec<String> {
    let what = format!(
        "{kind}, {} rows of {} columns",
        table.rows,
        table.columns.len()
    );
    let mut lines = title(&table.path, &what, table.front.synthetic());
    let facts = table
        .front
        .facts
        .iter()
        .filter(|(key, _)| *key != "kind" && *key != "synthetic");
    lines.extend(facts.map(|(key, value)| format!("  {key} = {value}")));
    lines.extend(table.columns.iter().map(|c| format!("  {}", of_column(c))));
    lines
}

fn of_column(column: &Column) -> String {
    match &column.cells {
        Cells::Numbers(numbers) => {
            let [low, high] = range(numbers.iter().copied().filter(|x| !x.is_nan()));
            let said = match column.missing {
                0 => String::new(),
                n => format!(", {n} missing"),
            };
            match low <= high {
                true => format!(
                    "{}: {} to {} (SI){said}",
                    column.name,
                    significant(low, 5),
                    significant(high, 5)
                ),
                false => format!("{}: empty", column.name),
            }
        }
        Cells::Words(_, words) => format!("{}: {}", column.name, words.join(", ")),
    }
}

/// A channel that never changes, or holds nothing.
fn odd(column: &Column) -> Option<String> {
    let numbers = column.numbers()?;
    let [low, high] = range(numbers.iter().copied().filter(|x| !x.is_nan()));
    match () {
        () if low > high => Some(format!("{} holds no number", column.name)),
        () if low == high && numbers.len() > 2 && column.dimension.is_some() => {
            Some(format!("{} never changes", column.name))
        }
        () => None,
    }
}

fn document(table: &Table, kind: &str) -> serde_json::Map<String, Value> {
    let mut map = json::head("inspect", &[(&table.path, &table.sha256)]);
    map.insert("kind".into(), json!(kind));
    map.insert("rows".into(), json!(table.rows));
    let column = |c: &Column| {
        let bounds = c
            .numbers()
            .map(|n| range(n.iter().copied().filter(|x| !x.is_nan())));
        json!({"name": c.name, "range": bounds.filter(|b| b[0] <= b[1])})
    };
    let columns: Vec<Value> = table.columns.iter().map(column).collect();
    map.insert("columns".into(), columns.into());
    map
}
