//! `ident simulate motion`.

use super::record::Record;
use super::robot_args::{RobotArgs, elastic_chain, ending, limit_warnings};
use crate::cli::Ending;
use crate::cli::output::{print, print_result};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;
use crate::ground::units::{DEGREE, Dimension};
use crate::motion::Chain;
use crate::motion::swing::{State, SwingWork, step, tool_offset};
use crate::robot::check;
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};

const MOST_STEPS: f64 = 1e8;

/// Time response to a force record or a joint path, as CSV.
#[derive(Debug, Args)]
pub struct Motion {
    #[command(flatten)]
    robot: RobotArgs,
    /// Force at the tool, base frame: CSV with time_s and any of fx_N, fy_N, fz_N
    #[arg(long, value_name = "FILE")]
    force: Option<PathBuf>,
    /// Commanded joint angles: CSV with time_s and angle_deg_1 .. angle_deg_6
    #[arg(long, value_name = "FILE")]
    path: Option<PathBuf>,
    /// Time step of the integration
    #[arg(long = "step-s", value_name = "S", default_value_t = 2e-4)]
    step: f64,
    /// Duration; otherwise the length of the longer record
    #[arg(long = "to-s", value_name = "S")]
    to: Option<f64>,
    /// Write every Nth step
    #[arg(long, value_name = "N", default_value_t = 5)]
    every: usize,
    /// Leave the elastic bearings out
    #[arg(long)]
    without_tilt: bool,
}

/// One written row: time, displacement of the tool, all joint angles.
struct Row {
    time: f64,
    moved: V3,
    joints: Vec<f64>,
}

impl Motion {
    /// Computes and prints.
    ///
    /// # Errors
    /// A robot, record or step that is refused.
    pub fn run(&self) -> Outcome<Ending> {
        let (loaded, start) = self.robot.load()?;
        check::dynamics(&loaded.robot)
            .map_err(|problem| problem.in_text(Path::new(&loaded.path)))?;
        let chain = elastic_chain(&loaded, self.without_tilt)?;
        let force = self.force.as_deref().map(Record::read).transpose()?;
        let path = self.path.as_deref().map(Record::read).transpose()?;
        let steps = self.steps(force.as_ref(), path.as_ref())?;
        let rows = self.integrate(&chain, &start, force.as_ref(), path.as_ref(), steps)?;
        let names: Vec<&str> = loaded
            .robot
            .joints
            .iter()
            .map(|joint| joint.name.as_str())
            .collect();
        match self.robot.json {
            true => {
                let mut inputs = vec![loaded.input()];
                inputs.extend(force.iter().chain(&path).map(Record::input));
                print_result("simulate motion", &inputs, json_body(&rows, &names))?;
            }
            false => print(&csv_text(&rows, &names))?,
        }
        Ok(ending(&limit_warnings(&loaded, &self.robot.joints_deg)))
    }

    fn steps(&self, force: Option<&Record>, path: Option<&Record>) -> Outcome<usize> {
        let given = force
            .iter()
            .chain(&path)
            .map(|record| record.end())
            .fold(0.0, f64::max);
        let end = self.to.unwrap_or(given);
        if !(self.step > 0.0 && self.step.is_finite() && end > 0.0 && end.is_finite()) {
            return Err(Problem::new(
                "there is nothing to simulate",
                "give --force or --path, or a positive --to-s, and a positive --step-s",
            ));
        }
        if end / self.step > MOST_STEPS {
            return Err(Problem::new(
                format!("more than {MOST_STEPS:e} steps asked for"),
                "choose a larger --step-s",
            )
            .in_column("--step-s"));
        }
        Ok((end / self.step).ceil() as usize)
    }

    fn integrate(
        &self,
        chain: &Chain,
        start: &[f64],
        force: Option<&Record>,
        path: Option<&Record>,
        steps: usize,
    ) -> Outcome<Vec<Row>> {
        let commands = Commands::new(path, start)?;
        let force_at = |t: f64| force.map_or([0.0; 3], |record| force_of(record, t));
        let mut space = SwingWork::new(chain);
        let mut state = State::settled(chain, &commands.at(0.0))?;
        let rest = tool_offset(chain, &mut space, &state);
        let mut rows = Vec::new();
        for k in 0..=steps {
            if k % self.every.max(1) == 0 || k == steps {
                rows.push(row(chain, &mut space, &state, rest));
            }
            if k < steps {
                let t = k as f64 * self.step;
                step(
                    chain,
                    &mut space,
                    &mut state,
                    self.step,
                    force_at(t + 0.5 * self.step),
                    &commands.at(t + self.step),
                )?;
            }
        }
        Ok(rows)
    }
}

fn row(chain: &Chain, space: &mut SwingWork, state: &State, rest: V3) -> Row {
    let offset = tool_offset(chain, space, state);
    let angles = state.angles();
    Row {
        time: state.time,
        moved: [0, 1, 2].map(|k| offset[k] - rest[k]),
        joints: chain.drives.iter().map(|i| angles[*i]).collect(),
    }
}

fn force_of(record: &Record, t: f64) -> V3 {
    if t > record.end() {
        return [0.0; 3];
    }
    ["fx", "fy", "fz"].map(|stem| {
        record
            .column(stem, Dimension::Force)
            .map_or(0.0, |column| record.at(column, t))
    })
}

/// Commanded angles over time: the path's columns, and the starting angles where it has none.
struct Commands<'a> {
    record: Option<&'a Record>,
    columns: Vec<Option<&'a [f64]>>,
    start: &'a [f64],
}

impl<'a> Commands<'a> {
    fn new(record: Option<&'a Record>, start: &'a [f64]) -> Outcome<Self> {
        let find = |i: usize| {
            let stems =
                ["angle", "link_angle", "motor_angle", "a"].map(|stem| format!("{stem}_{i}"));
            record.and_then(|record| {
                stems
                    .iter()
                    .find_map(|stem| record.column(stem, Dimension::Angle))
            })
        };
        let columns: Vec<Option<&[f64]>> = (1..=start.len()).map(find).collect();
        if record.is_some() && columns.iter().all(Option::is_none) {
            return Err(Problem::new(
                "the path has no joint angles",
                "name its columns time_s, angle_deg_1, .. angle_deg_6",
            )
            .in_column("--path"));
        }
        Ok(Self {
            record,
            columns,
            start,
        })
    }

    fn at(&self, t: f64) -> Vec<f64> {
        let angle = |(column, start): (&Option<&[f64]>, &f64)| match (self.record, column) {
            (Some(record), Some(column)) => record.at(column, t),
            _ => *start,
        };
        self.columns.iter().zip(self.start).map(angle).collect()
    }
}

fn csv_text(rows: &[Row], names: &[&str]) -> String {
    let joints: Vec<String> = (1..=names.len())
        .map(|i| format!("link_angle_deg_{i}"))
        .collect();
    let mut out = format!(
        "# kind = \"motion\"\n# displacement of the tool from its place at rest, base frame\ntime_s,dx_mm,dy_mm,dz_mm,{}\n",
        joints.join(",")
    );
    for row in rows {
        let [x, y, z] = row.moved.map(|d| d * 1e3);
        let joints: Vec<String> = row
            .joints
            .iter()
            .map(|q| format!("{:.9}", q / DEGREE))
            .collect();
        let _ = writeln!(
            out,
            "{:.6},{x:.9},{y:.9},{z:.9},{}",
            row.time,
            joints.join(",")
        );
    }
    out
}

fn json_body(rows: &[Row], names: &[&str]) -> Value {
    let column = |k: usize| rows.iter().map(|row| row.moved[k]).collect::<Vec<f64>>();
    json!({
        "time_s": rows.iter().map(|row| row.time).collect::<Vec<f64>>(),
        "displacement_m": {"x": column(0), "y": column(1), "z": column(2)},
        "joints": names,
        "link_angle_rad": rows.iter().map(|row| row.joints.clone()).collect::<Vec<_>>(),
    })
}
