//! `ident simulate frf`.

use super::robot_args::{RobotArgs, elastic_chain, ending, limit_warnings};
use crate::cli::Ending;
use crate::cli::output::{print, print_result};
use crate::ground::problem::{Outcome, Problem};
use crate::motion::frf::{C64, FrfWork, Response, accelerance, lines};
use crate::motion::linear::Linear;
use crate::motion::modes::{Mode, complex_modes, modal};
use crate::motion::{Work, linearise};
use crate::robot::check;
use clap::Args;
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::Path;

/// More lines than anybody can look at: a mistyped step.
const MOST_LINES: f64 = 1e6;

/// Accelerance of the tool and the natural modes.
#[derive(Debug, Args)]
pub struct Frf {
    #[command(flatten)]
    robot: RobotArgs,
    /// Highest frequency
    #[arg(long = "to-Hz", value_name = "HZ", default_value_t = 50.0)]
    to: f64,
    /// Distance of the lines
    #[arg(long = "step-Hz", value_name = "HZ", default_value_t = 0.25)]
    step: f64,
    /// Leave the elastic bearings out
    #[arg(long)]
    without_tilt: bool,
}

struct Answer {
    frequency: Vec<f64>,
    accelerance: Vec<Response>,
    linear: Linear,
    modes: Vec<Mode>,
}

impl Frf {
    /// Computes and prints.
    ///
    /// # Errors
    /// A robot or frequency range that is refused.
    pub fn run(&self) -> Outcome<Ending> {
        let frequency = self.frequencies()?;
        let (loaded, q) = self.robot.load()?;
        check::dynamics(&loaded.robot)
            .map_err(|problem| problem.in_text(Path::new(&loaded.path)))?;
        let chain = elastic_chain(&loaded, self.without_tilt)?;
        let linear = linearise(&chain, &mut Work::new(&chain), &chain.spread(&q))?;
        let modal = modal(&linear)?;
        let s: Vec<C64> = frequency.iter().map(|f| C64::new(0.0, TAU * f)).collect();
        let accelerance = accelerance(&modal, &mut FrfWork::default(), &s);
        let modes = complex_modes(&linear, &modal);
        let answer = Answer {
            frequency,
            accelerance,
            linear,
            modes,
        };
        match self.robot.json {
            true => print_result("simulate frf", &[loaded.input()], answer.json())?,
            false => print(&answer.text(self.to))?,
        }
        Ok(ending(&limit_warnings(&loaded, &self.robot.joints_deg)))
    }

    fn frequencies(&self) -> Outcome<Vec<f64>> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        if !(positive(self.to) && positive(self.step) && self.to >= self.step) {
            return Err(Problem::new(
                "the frequency range is empty",
                "write for example --to-Hz 50 --step-Hz 0.25, both positive",
            )
            .in_column("--to-Hz"));
        }
        if self.to / self.step > MOST_LINES {
            return Err(Problem::new(
                format!("more than {MOST_LINES:e} lines asked for"),
                "choose a larger step",
            )
            .in_column("--step-Hz"));
        }
        Ok(lines(self.to, self.step))
    }
}

impl Answer {
    fn json(&self) -> Value {
        let mut channels = Map::new();
        for (a, output) in ["x", "y", "z"].iter().enumerate() {
            for (b, input) in ["x", "y", "z"].iter().enumerate() {
                let line = |response: &Response| json!([response[a][b].re, response[a][b].im]);
                channels.insert(
                    format!("{output}{input}"),
                    self.accelerance.iter().map(line).collect(),
                );
            }
        }
        let modes = self.modes.iter().map(|mode| {
            json!({
                "frequency_Hz": mode.frequency_hz,
                "damping_ratio": mode.damping_ratio,
                "shape": mode.shape,
                "tool_m": mode.tool,
            })
        });
        json!({
            "frequency_Hz": self.frequency,
            "accelerance": channels,
            "accelerance_unit": "m/s²/N",
            "modes": modes.collect::<Vec<_>>(),
            "shape_sites": self.linear.names,
        })
    }

    fn text(&self, to: f64) -> String {
        let shown: Vec<&Mode> = self
            .modes
            .iter()
            .filter(|mode| mode.frequency_hz <= to)
            .collect();
        let mut out = format!(
            "{} of {} modes lie below {to} Hz:\n",
            shown.len(),
            self.modes.len()
        );
        for mode in shown {
            let site = self.largest(mode);
            let _ = writeln!(
                out,
                "{:>9.3} Hz  damping {:>6.3} %  mostly {site}",
                mode.frequency_hz,
                100.0 * mode.damping_ratio
            );
        }
        for (axis, name) in ["xx", "yy", "zz"].iter().enumerate() {
            let peak = self
                .frequency
                .iter()
                .zip(&self.accelerance)
                .map(|(f, r)| (*f, r[axis][axis].norm()));
            if let Some((f, size)) = peak.max_by(|a, b| a.1.total_cmp(&b.1)) {
                let _ = writeln!(
                    out,
                    "{name}: largest accelerance {size:.4e} m/s²/N at {f} Hz"
                );
            }
        }
        out.push_str("The whole response is in --json.\n");
        out
    }

    /// Site with the largest share in a mode.
    fn largest(&self, mode: &Mode) -> &str {
        let sites = mode.shape.iter().zip(&self.linear.names);
        sites
            .max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))
            .map_or("", |(_, name)| name)
    }
}
