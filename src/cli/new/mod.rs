//! `ident new`: templates with their keys explained, to be filled in. A new one is one file and one line in
//! [`TEMPLATES`].

mod robot;

use super::output::{print, print_result};
use super::{Ending, Verb, arguments, parsed};
use crate::ground::files;
use crate::ground::nearest::nearest;
use crate::ground::problem::{Outcome, Problem};
use clap::{ArgMatches, Args};
use serde_json::json;
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "new",
    about: "Write a commented template: load-cycle, workspace, hammer, robot or job",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// What to write: load-cycle, workspace, hammer, robot or job
    kind: String,
    /// The file; left out: named after its kind, here
    file: Option<PathBuf>,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Print the template and write nothing
    #[arg(long)]
    dry_run: bool,
    #[command(flatten)]
    robot: robot::FromFile,
}

/// A file to be filled in.
#[derive(Clone, Copy)]
struct Template {
    kind: &'static str,
    file: &'static str,
    /// The words that look at it once it is filled in.
    next: &'static str,
    text: &'static str,
}

const TEMPLATES: &[Template] = &[
    Template {
        kind: "load-cycle",
        file: "load-cycle.csv",
        next: "inspect",
        text: include_str!("templates/load-cycle.csv"),
    },
    Template {
        kind: "workspace",
        file: "workspace.csv",
        next: "inspect",
        text: include_str!("templates/workspace.csv"),
    },
    Template {
        kind: "hammer",
        file: "hammer.csv",
        next: "inspect",
        text: include_str!("templates/hammer.csv"),
    },
    Template {
        kind: "robot",
        file: "robot.toml",
        next: "robot check",
        text: include_str!("templates/robot.toml"),
    },
    Template {
        kind: "job",
        file: "job.toml",
        next: "inspect",
        text: include_str!("templates/job.toml"),
    },
];

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let template = template(&arguments.kind)?;
    if arguments.robot.from.is_some() {
        return robot::run(&arguments);
    }
    let path = arguments
        .file
        .unwrap_or_else(|| PathBuf::from(template.file));
    if arguments.dry_run && !arguments.json {
        print(template.text)?;
        return Ok(Ending::Done);
    }
    absent(&path)?;
    if !arguments.dry_run {
        files::replace(&path, template.text.as_bytes())?;
    }
    match arguments.json {
        true => {
            let file = (!arguments.dry_run).then(|| path.display().to_string());
            print_result(
                "new",
                &[],
                json!({"kind": template.kind, "file": file, "text": template.text}),
            )?;
        }
        false => print(&format!(
            "wrote {0}: fill it in, then `ident {1} {0}`\n",
            path.display(),
            template.next
        ))?,
    }
    Ok(Ending::Done)
}

/// Refuses a file that is there.
fn absent(path: &Path) -> Outcome<()> {
    match path.exists() {
        false => Ok(()),
        true => {
            let remedy = "give another name, or move that file away";
            let problem = Problem::new("is there already; nothing is overwritten", remedy);
            Err(problem.in_file(path))
        }
    }
}

fn template(kind: &str) -> Outcome<Template> {
    let known: Vec<&str> = TEMPLATES.iter().map(|template| template.kind).collect();
    let found = TEMPLATES.iter().find(|template| template.kind == kind);
    found.copied().ok_or_else(|| {
        let what = match nearest(kind, &known) {
            Some(near) => format!("there is no template `{kind}`; `{near}` is one"),
            None => format!("there is no template `{kind}`"),
        };
        Problem::new(what, format!("give one of {}", known.join(", ")))
    })
}
