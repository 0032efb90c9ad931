//! `ident inspect`: what was understood of a measurement file, and what looks odd.

use super::output::{print, tell};
use super::{Ending, Verb, arguments, parsed};
use crate::fit::inspection::{Inspection, inspect};
use crate::ground::problem::Outcome;
use crate::measurement::load_cycle::LoadCycle;
use crate::measurement::workspace::resolve;
use crate::report::json;
use clap::{ArgMatches, Args};
use serde_json::json;
use std::path::PathBuf;

/// The verb.
pub const VERB: Verb = Verb {
    name: "inspect",
    about: "Show what was understood of a measurement file, and what looks odd",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// A measurement file
    file: PathBuf,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let (path, said) = resolve(&arguments.file)?;
    said.iter().for_each(|s| tell(s));
    let file = LoadCycle::read(&path)?;
    let found = inspect(&file);
    print(&if arguments.json {
        as_json(&file, &found)
    } else {
        as_text(&file, &found)
    })?;
    Ok(if found.odd.is_empty() {
        Ending::Done
    } else {
        Ending::Attention
    })
}

fn as_text(file: &LoadCycle, found: &Inspection) -> String {
    let mut lines = vec![format!(
        "{}: load-cycle of {}",
        file.path.display(),
        file.site()
    )];
    if file.facts.synthetic {
        lines.push("synthetic: simulated, not measured".into());
    }
    lines.push(format!(
        "{} rows, {} left out for an empty cell; {}",
        file.rows, file.left_out, file.dialect
    ));
    lines.extend(file.conversions.iter().cloned());
    lines.extend(
        found
            .lines
            .iter()
            .map(|(name, value)| format!("{name}: {value}")),
    );
    for odd in &found.odd {
        lines.push(format!("odd: {odd}"));
    }
    lines.join("\n") + "\n"
}

fn as_json(file: &LoadCycle, found: &Inspection) -> String {
    let mut map = json::head("inspect", &[(&file.path, &file.sha256)]);
    map.insert("kind".into(), json!("load-cycle"));
    map.insert("site".into(), json!(file.site()));
    map.insert("synthetic".into(), json!(file.facts.synthetic));
    map.insert("rows".into(), json!(file.rows));
    map.insert("rows_left_out".into(), json!(file.left_out));
    map.insert("dialect".into(), json!(file.dialect));
    map.insert("channels".into(), json!(file.conversions));
    map.insert("sampling_s".into(), json!(found.step));
    map.insert("cycles".into(), json!(found.cycles));
    map.insert("turning_points".into(), json!(found.turning));
    map.insert("unloaded_start_s".into(), json!(found.rest));
    map.insert("noise".into(), json!(found.noise));
    map.insert("odd".into(), json!(found.odd));
    json::print(map)
}
