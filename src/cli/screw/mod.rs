//! `ident screw`: positions of a worn linear axis become figures of ISO 230-2, backlash and a pitch table.

mod json;
mod motion;
mod page;
mod request;
mod tables;

use super::chapter::Chapter;
use super::output::{located, print, tell};
use super::{Ending, Verb, arguments, from_words, parsed};
use crate::fit::screw::in_motion::{Demand, Run, in_motion};
use crate::fit::screw::positions::Extremes;
use crate::fit::screw::{Account, identify};
use crate::fit::suitability::{self, Doubt, is_odd};
use crate::ground::problem::Outcome;
use crate::measurement::pitch_table::{EXPORTERS, Exporter, PitchTable, exporter};
use crate::measurement::screw::ScrewTest;
use crate::measurement::workspace::Place;
use crate::report::{folder, text};
use clap::{ArgMatches, Args, ValueEnum};
use request::{demand, request};
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "screw",
    about: "Figures of ISO 230-2, backlash and a pitch table from positions of a linear axis",
    arguments: |command| arguments::<Arguments>(command).after_help(formats()),
    run,
};

/// The forms of the table, for the help text.
fn formats() -> String {
    let lines = EXPORTERS
        .iter()
        .map(|e| format!("  {:<12} {}\n", e.name, e.about));
    format!(
        "Forms of the table (--format):\n{}",
        lines.collect::<String>()
    )
}

#[derive(Args)]
struct Arguments {
    /// Files of kind screw, all of one axis; a bare name is looked up under measurements/
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Largest residual of a group of targets, µm
    #[arg(long, default_value_t = 3.0, value_name = "UM")]
    residual_um: f64,
    /// Factor of the standard deviation: 2 (ISO 230-2:2014), 3 (1988, GB/T 17421.2)
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u8).range(2..=3))]
    coverage: u8,
    /// The same axis before it was corrected: its figures are shown beside
    #[arg(long, value_name = "FILE")]
    before: Option<PathBuf>,
    /// Which readings the means leave out (the figures of ISO 230-2 hold all)
    #[arg(long, value_enum, default_value_t = Left::Extremes)]
    leave_out: Left,
    /// Let each group start where the one before ended
    #[arg(long)]
    continuous: bool,
    /// What the table follows
    #[arg(long, value_enum, default_value_t = Follow::Targets)]
    follow: Follow,
    /// Speed of the work, m/min, at which the axis is simulated in motion with each correction
    #[arg(long, default_value_t = 5.0, value_name = "V")]
    speed_m_min: f64,
    /// Form of the table
    #[arg(long, default_value = EXPORTERS[0].name, value_name = "NAME")]
    format: String,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Write no table and no report
    #[arg(long)]
    dry_run: bool,
}

/// Readings left out, as typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Left {
    /// Highest and lowest of each target and direction
    Extremes,
    /// Those far from the median
    Wild,
    /// None
    None,
}

/// What the table follows, as typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Follow {
    /// The mean of each target and direction
    Targets,
    /// The groups of quadratics, half the backlash to either side: smooth speed at high gain
    Groups,
}

impl Left {
    fn extremes(self) -> Extremes {
        match self {
            Self::Extremes => Extremes::Dropped,
            Self::Wild => Extremes::Robust,
            Self::None => Extremes::Kept,
        }
    }
}

/// Everything that is reported.
struct Judged {
    tests: Vec<ScrewTest>,
    place: Place,
    account: Account,
    before: Option<(ScrewTest, Account)>,
    table: PitchTable,
    exporter: &'static Exporter,
    limit_um: f64,
    demand: Demand,
    motion: Vec<Run>,
    doubts: Vec<Doubt>,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let judged = judge(&arguments)?;
    if !arguments.dry_run {
        write(&judged)?;
    }
    match arguments.json {
        true => print(&json::document(&judged, arguments.dry_run))?,
        false => print(&account(&judged, arguments.dry_run))?,
    }
    for remark in judged.remarks() {
        tell(&format!("note: {remark}"));
    }
    Ok(judged.ending())
}

/// Judges every screw of a campaign by itself, and writes what that found.
///
/// # Errors
/// A file that cannot be read, results that cannot be written.
pub fn chapter(place: &Place) -> Outcome<Option<Chapter>> {
    let one = |file: PathBuf| {
        let judged = judge(&from_words::<Arguments>(&[file]))?;
        write(&judged)?;
        Ok(Chapter {
            title: judged.stem(),
            ending: judged.ending(),
            inputs: judged.tests.iter().map(ScrewTest::input).collect(),
            page: page::page(&judged),
        })
    };
    Chapter::of_each(place, "Linear axes", passed, one)
}

fn judge(arguments: &Arguments) -> Outcome<Judged> {
    let exporter = exporter(&arguments.format)?;
    let request = request(arguments)?;
    let demand = demand(arguments)?;
    let tests = arguments
        .files
        .iter()
        .map(|name| read(name))
        .collect::<Outcome<Vec<_>>>()?;
    let mut doubts = Vec::new();
    for test in &tests {
        doubts.extend(passed(test)?);
    }
    let account = identify(&tests, &request)?;
    let before = match &arguments.before {
        None => None,
        Some(name) => {
            let test = read(name)?;
            doubts.extend(passed(&test)?);
            let account = identify(std::slice::from_ref(&test), &request)?;
            Some((test, account))
        }
    };
    let table = PitchTable {
        inputs: tests.iter().map(ScrewTest::provenance).collect(),
        synthetic: tests.iter().any(|test| test.facts.synthetic),
        ..account.table(request.smooth)
    };
    Ok(Judged {
        place: Place::of(&tests[0].path),
        tests,
        before,
        table,
        exporter,
        limit_um: arguments.residual_um,
        motion: in_motion(&account, &demand),
        demand,
        account,
        doubts,
    })
}

/// What is odd about a test that can carry a number.
fn passed(test: &ScrewTest) -> Outcome<Vec<Doubt>> {
    let doubts = suitability::screw::doubts(test);
    suitability::refuse(&test.path, &doubts)?;
    Ok(doubts)
}

fn read(name: &Path) -> Outcome<ScrewTest> {
    ScrewTest::read(&located(name)?)
}

impl Judged {
    fn ending(&self) -> Ending {
        Ending::done_if(self.account.figures.a.is_some() && !is_odd(&self.doubts))
    }

    fn stem(&self) -> String {
        self.tests[0].stem()
    }

    fn table_path(&self) -> PathBuf {
        self.place
            .fits()
            .join(format!("{}-table{}", self.stem(), self.exporter.ending))
    }

    fn report(&self) -> String {
        format!("{}-screw.html", self.stem())
    }

    fn left_out(&self) -> usize {
        self.tests.iter().map(|test| test.left_out).sum()
    }

    fn remarks(&self) -> Vec<String> {
        let mut said: Vec<String> = self.doubts.iter().map(Doubt::sentence).collect();
        said.extend(self.account.remarks());
        if self.left_out() > 0 {
            said.push(format!(
                "{} rows were left out for an empty cell",
                self.left_out()
            ));
        }
        said
    }
}

fn write(judged: &Judged) -> Outcome<()> {
    let table = (judged.exporter.write)(&judged.table)?;
    let page = page::page(judged);
    let files = vec![(judged.table_path(), table)];
    folder::write_with(files, &judged.place.reports(), &judged.report(), &page)?;
    Ok(())
}

fn account(judged: &Judged, dry: bool) -> String {
    let mut said = format!("{}\n\n", tables::sentence(judged));
    said += &text::table(&tables::figures(judged));
    said += "\n";
    said += &text::table(&tables::groups(judged));
    said += "\n";
    said += &text::table(&motion::table(judged));
    if !dry {
        let report = judged.place.reports().join(judged.report());
        said += &format!(
            "\ntable {}, report {}\n",
            judged.table_path().display(),
            report.display()
        );
    }
    said
}
