//! Kind `workspace`: force steps at the tool, at several points and in several directions
//! (source 000, section 3.3: nine points, x, y and z, force and sensor at the tool).

mod unloaded;

use super::facts::{measured, stem};
use super::front::Front;
use super::table::Table;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::{DEGREE, Dimension};
use std::path::{Path, PathBuf};
use toml::Value;

/// Names of the base frame's axes, in the order of every vector of this kind.
pub const DIRECTIONS: [&str; 3] = ["x", "y", "z"];

/// The facts of a workspace file, SI.
#[derive(Debug, Clone, Default)]
pub struct Facts {
    /// Robot name, or a robot file beside the measurement.
    pub robot: String,
    /// Joint angles of each point, rad; all of equal length.
    pub joint_angles: Vec<Vec<f64>>,
    /// Relative standard deviation of the stiffnesses that the simulation uses.
    pub nominal_rel_std: Option<f64>,
    /// Relative standard deviation of a whole set-up (point and direction): its displacements share
    /// one factor, which repeating cycles does not average out.
    pub setup_repeatability: Option<f64>,
    /// Data-sheet noise of the displacement sensors, m.
    pub sensor_noise: Option<f64>,
    /// True when the file says that it was simulated.
    pub synthetic: bool,
}

/// One force step, SI, base frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Index of the point, from 0.
    pub point: usize,
    /// Direction of the force: 0 x, 1 y, 2 z.
    pub direction: usize,
    /// Number of the cycle as the file gives it, 0 without a cycle column.
    pub cycle: i64,
    /// Force along the direction, N.
    pub force: f64,
    /// Displacement of the tool, m; NaN where it was not measured.
    pub displacement: [f64; 3],
}

/// A workspace file, SI.
#[derive(Debug, Clone)]
pub struct WorkspaceTest {
    /// Where it came from.
    pub path: PathBuf,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Its facts.
    pub facts: Facts,
    /// The steps, in the order of the file; cycle by cycle, each after the unloaded robot, where
    /// [`WorkspaceTest::from_unloaded`].
    pub steps: Vec<Step>,
    /// Whether the file holds one force a cycle only, so that displacements count from the unloaded robot.
    pub from_unloaded: bool,
    /// Data rows of the file.
    pub rows: usize,
    /// Rows left out because point, direction, force or every displacement was empty.
    pub left_out: usize,
}

impl WorkspaceTest {
    /// Reads a file of kind `workspace`.
    ///
    /// # Errors
    /// Whatever cannot be understood, with file, line, column and remedy.
    pub fn read(path: &Path) -> Outcome<Self> {
        Self::from_table(Table::read(path)?).map_err(|problem| problem.in_text(path))
    }

    /// Interprets a table that was read already.
    ///
    /// # Errors
    /// As [`WorkspaceTest::read`].
    pub fn from_table(table: Table) -> Outcome<Self> {
        table.front.expect_kind("workspace")?;
        table.front.only(FACTS)?;
        let facts = Facts::of(&table.front)?;
        let steps = Channels::of(&table)?.steps(&table, facts.joint_angles.len())?;
        if steps.is_empty() {
            return Err(Problem::new(
                format!(
                    "holds no usable row ({} of {0} left out for an empty cell)",
                    table.rows
                ),
                "every force step needs point, direction, force and at least one displacement",
            )
            .at_line(table.first_line));
        }
        let counted = unloaded::with_unloaded(&steps);
        Ok(Self {
            left_out: table.rows - steps.len(),
            from_unloaded: counted.is_some(),
            steps: counted.unwrap_or(steps),
            rows: table.rows,
            sha256: table.sha256,
            path: table.path,
            facts,
        })
    }

    /// File name without its ending.
    pub fn stem(&self) -> String {
        stem(&self.path, "workspace")
    }
}

impl Facts {
    fn of(front: &Front) -> Outcome<Self> {
        let robot = front.text("robot")?.ok_or_else(|| {
            let remedy =
                "add `# robot = \"kr210\"`: a built-in robot, or a robot file beside this one";
            Problem::new("the fact `robot` is missing", remedy).at_line(1)
        })?;
        Ok(Self {
            robot: robot.to_string(),
            joint_angles: joint_angles(front)?,
            nominal_rel_std: front.fraction("nominal_stiffness_rel_std")?,
            setup_repeatability: front.fraction("setup_repeatability")?,
            sensor_noise: front.not_negative("sensor_noise_mm")?.map(|mm| mm * 1e-3),
            synthetic: front.synthetic(),
        })
    }
}

/// The facts of this kind, as they are written.
pub(super) const FACTS: &[&str] = &[
    ANGLES,
    "nominal_stiffness_rel_std",
    "setup_repeatability",
    "sensor_noise_mm",
];

const ANGLES: &str = "joint_angles_deg";

fn joint_angles(front: &Front) -> Outcome<Vec<Vec<f64>>> {
    let refuse = |what: String| {
        let remedy = "write one row of joint angles in degrees per point: `# joint_angles_deg = [[0, -90, 90, 0, 0, 0], [...]]`";
        front.problem(ANGLES, what, remedy)
    };
    let rows = match front.facts.get(ANGLES) {
        None => return Err(refuse(format!("the fact `{ANGLES}` is missing")).at_line(1)),
        Some(Value::Array(rows)) if !rows.is_empty() => rows,
        Some(other) => return Err(refuse(format!("is {} without rows", other.type_str()))),
    };
    let rows: Vec<Vec<f64>> = rows
        .iter()
        .enumerate()
        .map(|(i, row)| {
            angles(row).ok_or_else(|| refuse(format!("row {} is no list of finite numbers", i + 1)))
        })
        .collect::<Outcome<_>>()?;
    let wanted = rows[0].len();
    match rows.iter().position(|row| row.len() != wanted) {
        Some(i) => Err(refuse(format!(
            "row {} has {} angles, row 1 has {wanted}",
            i + 1,
            rows[i].len()
        ))),
        None => Ok(rows),
    }
}

fn angles(row: &Value) -> Option<Vec<f64>> {
    let number = |value: &Value| match value {
        Value::Float(x) => Some(*x),
        Value::Integer(i) => Some(*i as f64),
        _ => None,
    };
    let row: Option<Vec<f64>> = row.as_array()?.iter().map(number).collect();
    let row = row.filter(|row| !row.is_empty() && row.iter().all(|x| x.is_finite()))?;
    Some(row.iter().map(|x| x * DEGREE).collect())
}

/// The columns of the kind.
struct Channels<'a> {
    point: &'a [f64],
    direction: (&'a [u16], &'a [String]),
    cycle: Option<&'a [f64]>,
    force: &'a [f64],
    displacement: [Option<&'a [f64]>; 3],
}

impl<'a> Channels<'a> {
    fn of(table: &'a Table) -> Outcome<Self> {
        let header = table.first_line - 1;
        let missing = |name: &str| {
            Problem::new(
                format!("has no column `{name}`"),
                "the header of this kind is `point,direction,cycle,force_N,dx_mm,dy_mm,dz_mm`; displacements that were not measured may be left out",
            )
            .at_line(header)
        };
        let displacement = [
            measured(table, "dx", Dimension::Length)?,
            measured(table, "dy", Dimension::Length)?,
            measured(table, "dz", Dimension::Length)?,
        ];
        if displacement.iter().all(Option::is_none) {
            return Err(missing("dx_mm"));
        }
        let plain = |name: &str| table.column(name).and_then(|column| column.numbers());
        let words = table.column("direction").and_then(|column| column.words());
        Ok(Self {
            point: plain("point").ok_or_else(|| missing("point"))?,
            direction: words.ok_or_else(|| missing("direction"))?,
            cycle: plain("cycle"),
            force: measured(table, "force", Dimension::Force)?.ok_or_else(|| missing("force_N"))?,
            displacement,
        })
    }

    fn steps(&self, table: &Table, points: usize) -> Outcome<Vec<Step>> {
        let mut steps = Vec::with_capacity(table.rows);
        for row in 0..table.rows {
            let step = self.step(row, points);
            steps.extend(step.map_err(|problem| problem.at_line(table.line_of(row)))?);
        }
        Ok(steps)
    }

    /// The step of a row; `None` if a cell it needs is empty.
    fn step(&self, row: usize, points: usize) -> Outcome<Option<Step>> {
        let word = &self.direction.1[usize::from(self.direction.0[row])];
        let displacement = self.displacement.map(|d| d.map_or(f64::NAN, |d| d[row]));
        let unmeasured = displacement.iter().all(|d| d.is_nan());
        let cycle = self.cycle.map_or(0.0, |cycle| cycle[row]);
        let needed = self.point[row] + self.force[row] + cycle;
        if needed.is_nan() || unmeasured || word.is_empty() {
            return Ok(None);
        }
        Ok(Some(Step {
            point: point_of(self.point[row], points)?,
            direction: direction_of(word)?,
            cycle: cycle as i64,
            force: self.force[row],
            displacement,
        }))
    }
}

fn point_of(number: f64, points: usize) -> Outcome<usize> {
    if number.fract() == 0.0 && number >= 1.0 && number <= points as f64 {
        return Ok(number as usize - 1);
    }
    Err(Problem::new(
        format!("point {number} has no row in `{ANGLES}`, which has {points}"),
        "points count from 1 in the order of the rows; add the joint angles of this point",
    )
    .in_column("point"))
}

fn direction_of(word: &str) -> Outcome<usize> {
    let found = DIRECTIONS
        .iter()
        .position(|name| name.eq_ignore_ascii_case(word));
    found.ok_or_else(|| {
        Problem::new(
            format!("`{word}` is no direction"),
            "write x, y or z of the base frame; for a pull against it write a negative force",
        )
        .in_column("direction")
    })
}
