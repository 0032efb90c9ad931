//! `ident run`: a whole campaign, from the raw files to the report.

use super::chapter::{Chapter, without_empty_sections};
use super::output::print;
use super::progress::Progress;
use super::{
    Ending, Verb, arguments, compensate, damping, diagnose, parsed, plan, screw, sensor, stiffness,
    validate,
};
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::leading::front_of;
use crate::measurement::workspace::Place;
use crate::report::{folder, json};
use crate::sheet::page::{APPENDIX, Block, Page, Tone};
use clap::{ArgMatches, Args, ValueEnum};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "run",
    about: "Run a whole campaign: identify, validate, tune, diagnose, and write one report",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Folder of the campaign, as measurements/kr210; without it the only one under measurements/
    folder: Option<PathBuf>,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// End with 1 where a step found something (a limit, a cause), not only where one could not do its work
    #[arg(long, value_name = "WHAT")]
    fail_on: Option<FailOn>,
    /// Report progress on standard error even without a terminal
    #[arg(long)]
    progress: bool,
}

/// What ends a run with 1 beside a file that no step took.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FailOn {
    /// Anything that a step found.
    Findings,
}

/// A step, by the name of its verb: its chapter, if the campaign has such files.
type Step = (&'static str, fn(&Place) -> Outcome<Option<Chapter>>);

/// Every step in the order of work: what one finds, the next ones use.
const STEPS: &[Step] = &[
    ("stiffness", stiffness::chapter),
    ("stiffness", stiffness::cubes_chapter),
    ("validate", validate::chapter),
    ("damping", damping::chapter),
    ("sensor", sensor::chapter),
    ("screw", screw::chapter),
    ("diagnose", diagnose::chapter),
    ("plan", plan::chapter),
    ("compensate", compensate::chapter),
];

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let place = place(arguments.folder.as_deref())?;
    let progress = Progress::new(STEPS.len(), arguments.progress);
    let mut chapters: Vec<(&str, Chapter)> = Vec::new();
    for (name, step) in STEPS {
        chapters.extend(step(&place)?.map(|chapter| (*name, chapter)));
        progress.done(name);
    }
    progress.finish();
    if chapters.is_empty() {
        return Err(nothing(&place));
    }
    let over = passed_over(&place);
    let found = chapters.iter().any(|c| c.1.ending == Ending::Attention);
    let attention = !over.is_empty() || (found && arguments.fail_on == Some(FailOn::Findings));
    let said = match arguments.json {
        true => as_json(&place, &chapters, &over),
        false => as_text(&place, &chapters, &over),
    };
    let page = page(&place, chapters, &over)?;
    folder::write_as(&place.reports(), "index.html", &page)?;
    print(&said)?;
    Ok(Ending::attention_if(attention))
}

/// The files of a campaign that no step takes, one clause each.
fn passed_over(place: &Place) -> Vec<String> {
    let kinds = crate::findings::kinds::kinds();
    let over = place.passed_over(&kinds).into_iter();
    over.map(|(path, why)| format!("{} {why}", path.display()))
        .collect()
}

/// The campaign that a folder holds.
///
/// # Errors
/// There is no such folder, it does not lie under `measurements/`, or there are several.
pub fn place(folder: Option<&Path>) -> Outcome<Place> {
    let Some(folder) = folder else {
        return Place::campaign(None);
    };
    if !folder.is_dir() {
        let remedy = "give the folder of a campaign, as measurements/kr210";
        return Err(Problem::new("is no folder", remedy).in_file(folder));
    }
    let place = Place::of(&folder.join("any.csv"));
    match place.campaign.is_empty() {
        false => Ok(place),
        true => Err(Problem::new(
            "does not lie under measurements/",
            "move it to measurements/<campaign>/: fits/ and reports/ are written beside that folder",
        )
        .in_file(folder)),
    }
}

fn nothing(place: &Place) -> Problem {
    let remedy = "put CSV files with front matter there; `ident inspect FILE` says how one is read";
    Problem::new("holds no measurement", remedy).in_file(&place.measurements())
}

/// Causes first, then what was identified.
fn page(place: &Place, chapters: Vec<(&str, Chapter)>, over: &[String]) -> Outcome<Page> {
    let inputs = chapters.iter().flat_map(|c| &c.1.inputs);
    let files: BTreeSet<&PathBuf> = inputs.map(|(path, _)| path).collect();
    let title = format!("Campaign {}", place.campaign);
    let subtitle = format!(
        "{}, {}, {}",
        counted(files.len(), "measurement file"),
        counted(chapters.len(), "step"),
        measured(&files)?
    );
    let mut page = Page::new(title, subtitle);
    page.synthetic = chapters.iter().any(|c| c.1.page.synthetic);
    let (causes, rest): (Vec<_>, Vec<_>) = chapters.into_iter().partition(|c| c.0 == "diagnose");
    let blocks = causes.into_iter().flat_map(|c| c.1.page.blocks);
    page.blocks.extend(blocks);
    page.blocks
        .extend(rest.into_iter().flat_map(|c| c.1.blocks()));
    if !over.is_empty() {
        page = page
            .with(Block::heading("Files that no step took"))
            .with(Block::text(format!("{}.", over.join("; "))));
    }
    page.blocks = summary_first(page.blocks);
    Ok(page)
}

/// What is folded away comes last, as the appendix: the pages before it are the summary that is printed.
fn summary_first(blocks: Vec<Block>) -> Vec<Block> {
    let folded = |block: &Block| matches!(block, Block::Details { .. });
    let (appendix, summary): (Vec<Block>, Vec<Block>) = blocks.into_iter().partition(folded);
    let mut all = without_empty_sections(summary);
    if !appendix.is_empty() {
        all.push(Block::heading(APPENDIX));
        all.extend(appendix);
    }
    all
}

/// When the files were measured, by their fact `date`.
fn measured(files: &BTreeSet<&PathBuf>) -> Outcome<String> {
    let mut dates = BTreeSet::new();
    for path in files {
        // jobs and robots have no front matter, and what a measurement's must hold was read before
        let Ok(front) = front_of(path) else { continue };
        dates.extend(front.date().map_err(|problem| problem.in_file(path))?);
    }
    Ok(match (dates.first(), dates.last()) {
        (Some(first), Some(last)) if first == last => format!("measured {first}"),
        (Some(first), Some(last)) => format!("measured {first} to {last}"),
        _ => "date of the measurement not stated".into(),
    })
}

/// `1 step`, `4 steps`.
fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        n => format!("{n} {what}s"),
    }
}

fn as_text(place: &Place, chapters: &[(&str, Chapter)], over: &[String]) -> String {
    let mut said = String::new();
    for (name, chapter) in chapters {
        let end = match chapter.ending {
            Ending::Done => "done",
            Ending::Attention => "needs attention",
        };
        let files = counted(chapter.inputs.len(), "file");
        said.push_str(&format!("{name}: {files}, {end}\n"));
        for (tone, sentence) in verdicts(&chapter.page) {
            let word = tone.word();
            said.push_str(&crate::report::text::indented(
                &format!("{word}: {sentence}"),
                2,
            ));
        }
    }
    for left in over {
        said.push_str(&format!("passed over: {left}\n"));
    }
    let index = place.reports().join("index.html");
    said + &format!("report {}\n", index.display())
}

fn verdicts(page: &Page) -> impl Iterator<Item = (Tone, &String)> {
    page.blocks.iter().filter_map(|block| match block {
        Block::Verdict { tone, sentence } => Some((*tone, sentence)),
        _ => None,
    })
}

fn as_json(place: &Place, chapters: &[(&str, Chapter)], over: &[String]) -> String {
    let mut inputs: Vec<(&Path, &str)> = chapters
        .iter()
        .flat_map(|c| c.1.inputs.iter().map(|(p, h)| (p.as_path(), h.as_str())))
        .collect();
    inputs.sort_unstable();
    inputs.dedup();
    let mut map = json::head("run", &inputs);
    map.insert("campaign".into(), json!(place.campaign));
    map.insert("passed_over".into(), json!(over));
    let step = |(name, chapter): &(&str, Chapter)| {
        let said: Vec<&String> = verdicts(&chapter.page).map(|v| v.1).collect();
        json!({
            "verb": name,
            "needs_attention": chapter.ending == Ending::Attention,
            "sentences": said,
        })
    };
    map.insert("steps".into(), chapters.iter().map(step).collect::<Value>());
    let index = place.reports().join("index.html");
    map.insert("report".into(), json!(index.display().to_string()));
    json::print(map)
}
