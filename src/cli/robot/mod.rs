//! `ident robot show | check | convert | report | map`: look at a robot file, doubt it, rewrite it, draw it.

mod map;
mod report;

use super::output::{print, print_result, tell};
use super::{Ending, Verb, arguments};
use crate::ground::files::replace;
use crate::ground::problem::Outcome;
use crate::ground::units::DEGREE;
use crate::robot::check::{self, Remark};
use crate::robot::load::load;
use crate::robot::{JointEffect, Robot, Spring, write};
use clap::{ArgMatches, Args, Subcommand};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "robot",
    about: "Show, check, convert and draw robot files",
    arguments: arguments::<RobotVerb>,
    run,
};

/// Show, check, convert and draw robot files.
#[derive(Debug, Args)]
pub struct RobotVerb {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Joints, springs, bodies and where every number comes from
    Show(File),
    /// Look for impossible bodies, mixed-up units, mirrored signs
    Check(File),
    /// Write the robot as TOML
    Convert(Convert),
    /// Draw it in space, with what gives way how much and its modes as they swing
    Report(report::Report),
    /// Map how stiff it is at the tool over a plane of its workspace
    Map(map::Map),
}

#[derive(Debug, Args)]
struct File {
    /// Built-in name (kr210, kr300) or a robot file, TOML or URDF
    robot: String,
    /// Print one JSON document instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct Convert {
    /// Built-in name (kr210, kr300) or a robot file, TOML or URDF
    robot: String,
    /// File to write; without it the TOML goes to standard output
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print one JSON document: the TOML as `toml`, and the file written
    #[arg(long)]
    json: bool,
}

/// Runs `ident robot`.
///
/// # Errors
/// A robot that cannot be read, a file that cannot be written.
pub fn run(matches: &ArgMatches) -> Outcome<Ending> {
    match super::parsed::<RobotVerb>(matches).what {
        What::Show(file) => show(&file),
        What::Check(file) => check_file(&file),
        What::Convert(convert) => convert.run(),
        What::Report(report) => report.run(),
        What::Map(map) => map.run(),
    }
}

impl Convert {
    fn run(&self) -> Outcome<Ending> {
        let loaded = load(&self.robot, None)?;
        let text = write::write(&loaded.robot);
        if let Some(path) = &self.output {
            replace(path, text.as_bytes())?;
        }
        match (self.json, &self.output) {
            (true, output) => {
                let written = output.as_ref().map(|path| path.display().to_string());
                let body = json!({"name": loaded.robot.name, "toml": text, "written": written});
                print_result("robot convert", &[loaded.input()], body)?;
            }
            (false, None) => print(&text)?,
            (false, Some(_)) => {}
        }
        Ok(Ending::Done)
    }
}

fn show(file: &File) -> Outcome<Ending> {
    let loaded = load(&file.robot, None)?;
    match file.json {
        true => print_result("robot show", &[loaded.input()], show_json(&loaded.robot))?,
        false => print(&show_text(&loaded.robot))?,
    }
    Ok(Ending::Done)
}

fn show_json(robot: &Robot) -> Value {
    let spring = |(site, spring): (String, &Spring)| {
        json!({
            "site": site,
            "stiffness": {"value": spring.stiffness, "unit": "N·m/rad", "ci95": spring.ci95.stiffness},
            "damping": {"value": spring.damping, "unit": "N·m·s/rad", "ci95": spring.ci95.damping},
            "backlash": {"value": spring.gap(), "unit": "rad", "ci95": spring.ci95.backlash},
            "effects": spring.effects.iter().map(effect_json).collect::<Vec<_>>(),
            "source": spring.source,
        })
    };
    let joints = robot.joints.iter().enumerate().map(|(i, joint)| {
        let body = robot.link_body(i);
        json!({
            "name": joint.name,
            "axis": joint.axis,
            "point_m": joint.point,
            "limits_deg": joint.limits.map(|limit| limit / DEGREE),
            "mass_kg": body.map(|body| body.mass),
            "com_m": body.map(|body| body.com),
            "inertia_kgm2": body.map(|body| body.inertia),
        })
    });
    json!({
        "name": robot.name,
        "source": robot.source,
        "notes": robot.notes,
        "joints": joints.collect::<Vec<_>>(),
        "springs": robot.springs().map(spring).collect::<Vec<_>>(),
        "tool": {"flange_m": robot.tool.flange, "tcp_m": robot.tool.tcp, "rotation": robot.tool.rotation},
    })
}

fn effect_json(effect: &JointEffect) -> Value {
    let keys = effect.keys().into_iter();
    let values = keys.zip(effect.values.iter().map(|value| json!(value)));
    let named = [("name".to_string(), json!(effect.name))].into_iter();
    Value::Object(named.chain(values).collect())
}

fn show_text(robot: &Robot) -> String {
    let mut out = format!(
        "{}: {} joints\nsource: {}\n",
        robot.name,
        robot.dof(),
        robot.source
    );
    robot.notes.iter().for_each(|note| {
        let _ = writeln!(out, "  {note}");
    });
    let _ = writeln!(
        out,
        "\n{:<8}{:>10} .. {:<8}{:>22}{:>12}",
        "joint", "lowest", "highest deg", "point m", "link kg"
    );
    for (i, joint) in robot.joints.iter().enumerate() {
        let [low, high] = joint.limits.map(|limit| limit / DEGREE);
        let [x, y, z] = joint.point;
        let mass = robot
            .link_body(i)
            .map_or("unknown".into(), |body| format!("{:.2}", body.mass));
        let _ = writeln!(
            out,
            "{:<8}{low:>10.1} .. {high:<8.1}{:>25}{mass:>12}",
            joint.name,
            format!("({x:.3}, {y:.3}, {z:.3})")
        );
    }
    let _ = writeln!(
        out,
        "\n{:<16}{:>16}{:>18}{:>14}  source",
        "spring", "N·m/rad", "N·m·s/rad", "gap rad"
    );
    for (site, spring) in robot.springs() {
        let source = spring.source.as_deref().unwrap_or("");
        let _ = writeln!(
            out,
            "{site:<16}{:>16.5e}{:>18.4e}{:>14.3e}  {source}",
            spring.stiffness,
            spring.damping,
            spring.gap()
        );
        spring.effects.iter().for_each(|effect| {
            let _ = writeln!(out, "{:<16}  {}", "", effect.text());
        });
    }
    let [x, y, z] = robot.tool.tcp;
    let _ = writeln!(
        out,
        "\ntool centre point at zero: ({x:.4}, {y:.4}, {z:.4}) m"
    );
    out
}

fn check_file(file: &File) -> Outcome<Ending> {
    let loaded = load(&file.robot, None)?;
    let remarks = check::remarks(&loaded.robot);
    if let Err(problem) = check::dynamics(&loaded.robot) {
        let told = |remark: &Remark| tell(&remark_text(remark));
        remarks.iter().for_each(told);
        return Err(problem.in_text(Path::new(&loaded.path)));
    }
    match file.json {
        true => print_result("robot check", &[loaded.input()], check_json(&remarks))?,
        false => print(&check_text(&loaded.robot, &remarks))?,
    }
    Ok(if remarks.is_empty() {
        Ending::Done
    } else {
        Ending::Attention
    })
}

fn check_json(remarks: &[Remark]) -> Value {
    let remark = |remark: &Remark| json!({"site": remark.site, "text": remark.text});
    json!({"remarks": remarks.iter().map(remark).collect::<Vec<_>>()})
}

fn check_text(robot: &Robot, remarks: &[Remark]) -> String {
    let mut out = format!(
        "{}: every body is possible, every link has mass.\n",
        robot.name
    );
    remarks.iter().for_each(|remark| {
        let _ = writeln!(out, "{}", remark_text(remark));
    });
    out
}

fn remark_text(remark: &Remark) -> String {
    format!("{}: {}", remark.site, remark.text)
}
