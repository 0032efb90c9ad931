//! `ident new robot --from FILE`: a robot file from a table of Denavit and Hartenberg or from URDF, with
//! guesses for what neither states, and a picture to check it by.

use super::absent;
use crate::cli::Ending;
use crate::cli::output::{print, print_result};
use crate::experiments::robot_picture::chart;
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::motion::skeleton::skeleton;
use crate::report::svg;
use crate::robot::builtin::BUILTINS;
use crate::robot::check::{self, Remark};
use crate::robot::dh::{self, Convention};
use crate::robot::guess::{Guess, Guessed, fill, reach};
use crate::robot::load::load;
use crate::robot::{Robot, urdf, write};
use crate::sheet::chart::Chart;
use crate::sheet::number::significant;
use clap::{Args, ValueEnum};
use serde_json::json;
use std::path::{Path, PathBuf};

/// What `ident new robot` takes besides.
#[derive(Debug, Args)]
pub struct FromFile {
    /// Robot from this table of Denavit and Hartenberg (CSV or TOML) or URDF, in place of the template
    #[arg(long, value_name = "FILE")]
    pub from: Option<PathBuf>,
    /// Where the a and α of a row stand, in place of what the table says
    #[arg(long, value_enum, requires = "from")]
    convention: Option<Word>,
    /// Robot whose springs and bodies are scaled to fill in what the file does not state [default: the
    /// first built-in one]
    #[arg(long, value_name = "ROBOT", requires = "from")]
    like: Option<String>,
    /// Relative standard deviation of stiffnesses that are not stated
    #[arg(long, value_name = "SHARE", default_value_t = 0.5)]
    spread: f64,
    /// Mass of all moving links, in place of what the table says
    #[arg(long, value_name = "KG", requires = "from")]
    mass_kg: Option<f64>,
}

/// Conventions as typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Word {
    /// Rz(θ)·Tz(d)·Tx(a)·Rx(α)
    Classic,
    /// Rx(α)·Tx(a)·Rz(θ)·Tz(d) (Craig)
    Modified,
}

/// Runs it.
pub fn run(arguments: &super::Arguments) -> Outcome<Ending> {
    if arguments.kind != "robot" {
        let problem = Problem::new("makes robots only", "write `ident new robot --from FILE`");
        return Err(problem.in_column("--from"));
    }
    let own = &arguments.robot;
    let from = own.from.clone().unwrap_or_default();
    let path = arguments
        .file
        .clone()
        .unwrap_or_else(|| PathBuf::from("robot.toml"));
    let (robot, guessed) = robot(own, &from)?;
    check::dynamics(&robot)?;
    let remarks = check::remarks(&robot);
    let picture = path.with_extension("svg");
    let text = write::write(&robot);
    if !arguments.dry_run {
        absent(&path)?;
        let drawn = svg::ink(&figure(&robot))?;
        files::replace_all(&[(&path, text.as_bytes()), (&picture, drawn.as_bytes())])?;
    }
    let written = (!arguments.dry_run).then(|| [&path, &picture].map(|p| p.display().to_string()));
    match arguments.json {
        true => {
            let input = (
                from.display().to_string(),
                files::sha256(&files::read_bytes(&from)?),
            );
            let body = json!({
                "kind": "robot", "file": written.as_ref().map(|w| &w[0]), "picture": written.as_ref().map(|w| &w[1]),
                "text": text, "guessed": guessed, "reach_m": reach(&robot), "tcp_m": robot.tool.tcp,
                "remarks": remarks.iter().map(said).collect::<Vec<_>>(),
            });
            print_result("new", &[input], body)?;
        }
        false if arguments.dry_run => print(&text)?,
        false => print(&account(&robot, &guessed, &remarks, [&path, &picture]))?,
    }
    Ok(Ending::done_if(remarks.is_empty()))
}

fn said(remark: &Remark) -> String {
    format!("{}: {}", remark.site, remark.text)
}

/// Reads the file and fills in what it does not state.
fn robot(own: &FromFile, from: &Path) -> Outcome<(Robot, Guessed)> {
    if !(own.spread > 0.0 && own.spread < 10.0) {
        let problem = Problem::new("is no spread", "give a share such as 0.5 for 50 %");
        return Err(problem.in_column("--spread"));
    }
    let like = own.like.as_deref().unwrap_or(BUILTINS[0].0);
    let like = load(like, None)?.robot;
    let bytes = files::read_bytes(from)?;
    let text = std::str::from_utf8(&bytes);
    let text =
        text.map_err(|_| Problem::new("is not UTF-8 text", "save it as UTF-8").in_file(from))?;
    let (mut robot, mass) = read(text, own).map_err(|problem| problem.in_text(from))?;
    if robot.source.trim().is_empty() {
        let name = files::name(from);
        robot.source = format!("geometry: {name}");
    }
    let mass_kg = own.mass_kg.or(mass);
    fill(
        robot,
        &Guess {
            like: &like,
            spread: own.spread,
            mass_kg,
        },
    )
    .map_err(|problem| problem.in_file(from))
}

fn read(text: &str, own: &FromFile) -> Outcome<(Robot, Option<f64>)> {
    if text.trim_start().starts_with('<') {
        return Ok((urdf::read(text)?, None));
    }
    let convention = own.convention.map(|word| match word {
        Word::Classic => Convention::Classic,
        Word::Modified => Convention::Modified,
    });
    let table = dh::read(text, convention)?;
    Ok((table.robot(), table.mass_kg))
}

fn account(
    robot: &Robot,
    guessed: &Guessed,
    remarks: &[Remark],
    [path, picture]: [&PathBuf; 2],
) -> String {
    let [x, y, z] = robot.tool.tcp.map(|v| significant(v, 4));
    let mut text = format!(
        "{}: {} joints, arm of {} m, every joint at zero the tool at ({x}, {y}, {z}) m\n",
        robot.name,
        robot.dof(),
        significant(reach(robot), 3)
    );
    for line in guessed {
        text += &format!("guessed: {line}\n");
    }
    for remark in remarks {
        text += &format!("{}\n", said(remark));
    }
    text + &format!(
        "wrote {0} and {1}: look whether the picture is the robot at zero, then `ident robot check {0}`\n",
        path.display(),
        picture.display()
    )
}

/// The robot at zero from the side and from above.
fn figure(robot: &Robot) -> Chart {
    let caption = "Every joint at zero. Links as straight lines between the points of the joints.";
    let title = format!("{} from the side and from above", robot.name);
    let zero = skeleton(robot, &vec![0.0; robot.dof()]);
    chart(Chart::new("robot", title, caption), &zero, None)
}
