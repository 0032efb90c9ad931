//! `ident force`: cutting coefficients and runout from records of a dynamometer.

mod answer;
mod figures;
mod material;
mod page;
mod tables;

use super::output::{located, print};
use super::{Ending, Verb, arguments, parsed};
use crate::fit::cut_force::{Account, identify};
use crate::fit::parameter::Status;
use crate::fit::suitability::{self, Doubt, is_odd};
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::milling_force::MillingForce;
use crate::measurement::workspace::Place;
use crate::report::{folder, text as terminal};
use clap::{ArgMatches, Args};
use std::path::PathBuf;

/// The verb.
pub const VERB: Verb = Verb {
    name: "force",
    about: "Identify cutting coefficients and runout from measured forces, and write a material",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Measurements of kind milling-force, all with one tool; a bare name is looked up under measurements/
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Name of the material that is written [default: that of the first file]
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Write no material and no report
    #[arg(long)]
    dry_run: bool,
}

/// Everything that is reported.
struct Found {
    files: Vec<MillingForce>,
    place: Place,
    name: String,
    account: Account,
    doubts: Vec<Doubt>,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let found = act(&arguments)?;
    let written = match arguments.dry_run {
        true => Vec::new(),
        false => write(&found)?,
    };
    match arguments.json {
        true => print(&answer::json(&found, arguments.dry_run))?,
        false => print(&account(&found, &written))?,
    }
    Ok(ending(&found))
}

fn act(arguments: &Arguments) -> Outcome<Found> {
    let mut files = Vec::new();
    for name in &arguments.files {
        files.push(MillingForce::read(&located(name)?)?);
    }
    one_tool(&files)?;
    let mut doubts = Vec::new();
    for file in &files {
        let own = suitability::milling_force::doubts(file);
        suitability::refuse(&file.path, &own)?;
        doubts.extend(own);
    }
    let name = match &arguments.name {
        Some(name) => plain(name)?,
        None => files[0].stem(),
    };
    Ok(Found {
        place: Place::of(&files[0].path),
        name,
        account: identify(&files),
        files,
        doubts,
    })
}

fn plain(name: &str) -> Outcome<String> {
    let good = !name.trim().is_empty() && !name.contains(['/', '\\']) && !name.starts_with('.');
    match good {
        true => Ok(name.to_string()),
        false => Err(Problem::new(
            format!("`{name}` is no name of a file"),
            "write a plain name such as al7075",
        )
        .in_column("--name")),
    }
}

fn one_tool(files: &[MillingForce]) -> Outcome<()> {
    let tool = |f: &MillingForce| (f.facts.diameter_m, f.facts.teeth, f.facts.helix_rad);
    match files.iter().find(|f| tool(f) != tool(&files[0])) {
        None => Ok(()),
        Some(other) => Err(Problem::new(
            format!("was cut with another tool than {}", files[0].path.display()),
            "give files of one tool at a time: coefficients belong to a tool and a material",
        )
        .in_file(&other.path)),
    }
}

impl Found {
    fn synthetic(&self) -> bool {
        self.files.iter().any(|f| f.facts.synthetic)
    }

    /// What is odd about the data, then what the fit remarks.
    fn remarks(&self) -> Vec<String> {
        let odd = self.doubts.iter().map(Doubt::sentence);
        odd.chain(self.account.remarks.iter().cloned()).collect()
    }

    /// Where the material goes; none where a coefficient is open.
    fn material_path(&self) -> Option<PathBuf> {
        self.account.rel_std?;
        Some(self.place.fits().join(format!("{}.toml", self.name)))
    }
}

fn ending(found: &Found) -> Ending {
    let open = |s: &Status| *s == Status::NotIdentifiable;
    let coefficients = &found.account.parameters[..6];
    let is_odd = is_odd(&found.doubts) || found.account.leaves_much();
    Ending::attention_if(is_odd || coefficients.iter().any(|p| open(&p.status)))
}

fn write(found: &Found) -> Outcome<Vec<PathBuf>> {
    let page = page::page(found);
    let material = found.material_path();
    let files = material
        .iter()
        .map(|path| (path.clone(), material::text(found)));
    let name = format!("force-{}.html", found.name);
    let report = folder::write_with(files.collect(), &found.place.reports(), &name, &page)?;
    Ok(material.into_iter().chain([report]).collect())
}

fn account(found: &Found, written: &[PathBuf]) -> String {
    let mut said = String::new();
    for (_, sentence) in tables::sentences(found) {
        said += &format!("{sentence}\n");
    }
    for table in [tables::parameters(found), tables::means(found)] {
        said += &format!("\n{}", terminal::table(&table));
    }
    said += "\n";
    for remark in found.remarks() {
        said += &format!("note: {remark}\n");
    }
    let ends = |end: &str| written.iter().find(|p| p.to_string_lossy().ends_with(end));
    if let Some(path) = ends(".toml") {
        said += &format!("\nmaterial {}", path.display());
    }
    if let Some(path) = ends(".html") {
        said += &format!("\nreport {}", path.display());
    }
    said.trim_end().to_string() + "\n"
}
