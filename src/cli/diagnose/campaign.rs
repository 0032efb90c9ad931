//! The diagnosis of a whole campaign.

use super::kind::{Diagnosed, KINDS, kind};
use super::{One, overview, page};
use crate::cli::chapter::Chapter;
use crate::cli::{Ending, progress::Progress};
use crate::findings::campaign::{Check, named, verdict};
use crate::findings::{Answer, Verdict, sentence::sentences};
use crate::fit::axis_tests;
use crate::fit::identified_robot::with_axis_tests;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::leading::fact_of;
use crate::measurement::workspace::Place;
use crate::robot::{Robot, write};
use crate::sheet::number::engineering;
use crate::sheet::page::{Block, Page};
use crate::sheet::table::Table;
use rayon::prelude::*;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// Role of a file that is measured only to be compared with another.
const COMPARISON: &str = "comparison";

/// Everything that a campaign's files say together.
pub struct Campaign {
    /// Where they are.
    pub place: Place,
    /// Every file, diagnosed by itself; whole-robot tests with what the axis tests found.
    pub files: Vec<One>,
    /// What one found, held against the others.
    pub checks: Vec<Check>,
    /// The robot with everything that was found; `None` if nothing changed it.
    pub robot: Option<Robot>,
    /// The verdict on all.
    pub verdict: Verdict,
}

/// Diagnoses every file of a campaign that can be diagnosed.
///
/// # Errors
/// A file that cannot be read, or none at all.
pub fn examine(place: &Place, progress: bool) -> Outcome<Campaign> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for (name, _) in KINDS {
        for path in place.files_of(name)? {
            let role = fact_of(&path, "role").map_err(|problem| problem.in_file(&path))?;
            paths.extend(role.is_none_or(|role| role != COMPARISON).then_some(path));
        }
    }
    if paths.is_empty() {
        let remedy = "put measurements there whose front matter says `kind`";
        return Err(
            Problem::new("holds no measurement that can be diagnosed", remedy)
                .in_file(&place.measurements()),
        );
    }
    let tests = axis_tests::read(&place.fits(), &place.measurements())?;
    let progress = Progress::new(paths.len(), progress);
    let files = paths.par_iter().map(|path| {
        let one = one(path, place, &tests);
        progress.done(&path.display().to_string());
        one
    });
    let files: Vec<Outcome<One>> = files.collect();
    progress.finish();
    let files = files.into_iter().collect::<Outcome<Vec<One>>>()?;
    let checks = checks(&files);
    Ok(Campaign {
        verdict: verdict(files.iter().map(|one| one.found.answer()), &checks),
        robot: extended(&files),
        place: place.clone(),
        checks,
        files,
    })
}

/// One file; a test of the whole robot is simulated with what the axis tests found.
///
/// # Errors
/// A file that cannot be read, or that nothing diagnoses.
pub fn one(path: &Path, place: &Place, tests: &[axis_tests::AxisTest]) -> Outcome<One> {
    let (kind, diagnose) = kind(path)?;
    let found = diagnose(path)?;
    let informed = found.robot().filter(|_| !tests.is_empty());
    let informed = informed.and_then(|robot| found.under(&stiffened(robot, tests)));
    Ok(One {
        kind,
        place: place.clone(),
        found: informed.unwrap_or(found),
    })
}

/// A robot with the stiffness that the axis tests found, their gaps left closed: weight presses each
/// joint to one side, and whether it does is what a test of the whole robot says.
fn stiffened(robot: &Robot, tests: &[axis_tests::AxisTest]) -> Robot {
    let mut informed = with_axis_tests(robot, tests);
    let gaps = robot.springs().map(|(_, spring)| spring.backlash.clone());
    let gaps: Vec<Vec<f64>> = gaps.collect();
    for ((_, spring), own) in informed.springs_mut().zip(gaps) {
        spring.backlash = own;
    }
    informed
}

/// Every pair of tests of the whole robot of which one changed the robot.
fn checks(files: &[One]) -> Vec<Check> {
    let pairs: Vec<(&One, &One)> = files
        .iter()
        .flat_map(|from| files.iter().map(move |against| (from, against)))
        .filter(|(from, against)| from.path() != against.path())
        .collect();
    let check = |(from, against): (&One, &One)| {
        let robot = from
            .found
            .extended()
            .filter(|r| Some(*r) != from.found.robot())?;
        let after = against.found.under(robot)?;
        let (a, b) = (from.found.answer(), against.found.answer());
        Some(Check::new(
            (&from.name(), a),
            (&against.name(), b),
            after.answer(),
        ))
    };
    pairs.into_par_iter().filter_map(check).collect()
}

/// The robot that all tests together extend, each starting from what those before it found.
fn extended(files: &[One]) -> Option<Robot> {
    let mut robot: Option<Robot> = None;
    let mut changed = false;
    for one in files {
        let again = robot.as_ref().and_then(|robot| one.found.under(robot));
        let found: &dyn Diagnosed = again.as_deref().unwrap_or(one.found.as_ref());
        if let (Some(before), Some(after)) = (found.robot(), found.extended()) {
            changed |= before != after;
            robot = Some(after.clone());
        }
    }
    robot.filter(|_| changed)
}

impl Campaign {
    /// Where the extended robot goes.
    pub fn robot_path(&self) -> PathBuf {
        self.place.fits().join("extended-robot.toml")
    }

    /// Everything that is written beside the files' own results.
    pub fn written(&self) -> Vec<(PathBuf, String)> {
        let robot = self.robot.as_ref().map(|robot| {
            let label = match self.synthetic() {
                true => "# synthetic: extended from simulated measurements\n",
                false => "",
            };
            (self.robot_path(), format!("{label}{}", write::write(robot)))
        });
        robot.into_iter().collect()
    }

    fn synthetic(&self) -> bool {
        self.files.iter().any(|one| one.found.source().synthetic)
    }

    /// How the verb ends.
    pub fn ending(&self) -> Ending {
        match self.verdict {
            Verdict::Sufficient => Ending::Done,
            _ => Ending::Attention,
        }
    }

    /// The story of the campaign, then each file's.
    pub fn page(&self) -> Page {
        let subtitle = format!("{} files", self.files.len());
        let mut page = Page::new(format!("Diagnosis of {}", self.place.campaign), subtitle);
        page.synthetic = self.synthetic();
        page = page
            .with(Block::verdict(page::tone(self.verdict), self.sentence()))
            .with(Block::heading("What is wrong, and why"));
        let figure = overview::figure(&self.files, self.synthetic());
        page = figure
            .into_iter()
            .fold(page, |page, chart| page.with(Block::Chart(chart)));
        page = page.with(Block::Table(self.overview()));
        if !self.checks.is_empty() {
            page = page.with(Block::Table(self.checked()));
        }
        let open: Vec<String> = self.open_questions();
        if !open.is_empty() {
            page = page.with(Block::heading("What to measure next"));
        }
        page = open
            .into_iter()
            .fold(page, |page, said| page.with(Block::text(said)));
        page = page.with(Block::heading("Experiment by experiment"));
        for one in &self.files {
            let inside = page::page(one.found.as_ref(), &one.stem()).blocks;
            let title = format!("{}: {}", one.stem(), one.found.answer().verdict.name());
            page = page.with(Block::details(title, inside));
        }
        page
    }

    fn open_questions(&self) -> Vec<String> {
        let groups = self.files.iter().flat_map(|one| {
            let groups = one.found.answer().groups.iter();
            groups.map(|g| {
                format!(
                    "{}, to tell {}: {}.",
                    one.stem(),
                    g.effects.join(" from "),
                    g.would_tell
                )
            })
        });
        groups.collect()
    }

    /// The verdict in one sentence.
    pub fn sentence(&self) -> String {
        let wrong = self
            .files
            .iter()
            .filter(|one| one.found.answer().verdict != Verdict::Sufficient);
        let wrong: Vec<String> = wrong.map(One::stem).collect();
        let said = match wrong.len() {
            0 => format!(
                "The simulation agrees with all {} experiments to within their noise.",
                self.files.len()
            ),
            n => format!(
                "The simulation misses {n} of {} experiments{}.",
                self.files.len(),
                match wrong.len() < self.files.len() {
                    true => format!(": {}", wrong.join(", ")),
                    false => String::new(),
                }
            ),
        };
        let count = |word: &str| {
            let checks = self.checks.iter();
            checks.filter(|check| check.word() == word).count()
        };
        match (count("confirmed"), count("contradicted")) {
            (0, 0) => said,
            (good, bad) => format!(
                "{said} Of what one experiment predicts for another, {good} predictions are confirmed and {bad} contradicted."
            ),
        }
    }

    /// One line per file.
    pub fn overview(&self) -> Table {
        let header = [
            "experiment",
            "verdict",
            "causes",
            "error",
            "noise",
            "with causes",
        ];
        let mut table = Table::new("What each experiment says", header).numeric([3, 4, 5]);
        for one in &self.files {
            table.push(line(&one.stem(), one.found.answer()));
        }
        table.noted("error: rms of measured − simulated; with causes: on data held out of the fit; groups that cannot be told apart stand with their first member and a question mark")
    }

    /// What one experiment found, held against the others.
    pub fn checked(&self) -> Table {
        let header = [
            "found in",
            "causes",
            "held against",
            "error before",
            "error after",
            "the prediction is",
        ];
        let mut table =
            Table::new("What one experiment found, predicted for another", header).numeric([3, 4]);
        for check in &self.checks {
            table.push([
                check.from.clone(),
                check.causes.join(", "),
                check.against.clone(),
                engineering(check.before, 3, check.unit),
                engineering(check.after, 3, check.unit),
                check.word().to_string(),
            ]);
        }
        table.noted("nothing was fitted to the experiment it is held against")
    }

    /// The body of the JSON document.
    pub fn json(&self, dry: bool) -> Outcome<Map<String, Value>> {
        let mut map = Map::new();
        map.insert("kind".into(), json!("campaign"));
        map.insert("campaign".into(), json!(self.place.campaign));
        map.insert("synthetic".into(), json!(self.synthetic()));
        map.insert("verdict".into(), json!(self.verdict.name()));
        map.insert("sentence".into(), json!(self.sentence()));
        let mut gathered = [Vec::new(), Vec::new()];
        let mut experiments = Vec::new();
        for one in &self.files {
            let body = one.body(dry)?;
            for (list, key) in gathered.iter_mut().zip(["causes", "cannot_separate"]) {
                let own = body.get(key).and_then(Value::as_array).cloned();
                list.extend(own.into_iter().flatten().map(|value| with_file(value, one)));
            }
            experiments.push(with_file(Value::Object(body), one));
        }
        let [mut causes, groups] = gathered;
        causes.sort_by(|a, b| gain(b).total_cmp(&gain(a)));
        map.insert("causes".into(), Value::Array(causes));
        map.insert("cannot_separate".into(), Value::Array(groups));
        map.insert(
            "checks".into(),
            self.checks.iter().map(check_json).collect(),
        );
        map.insert("experiments".into(), Value::Array(experiments));
        let robot = self
            .robot
            .as_ref()
            .filter(|_| !dry)
            .map(|_| self.robot_path());
        map.insert(
            "model".into(),
            json!(robot.map(|path| path.display().to_string())),
        );
        Ok(map)
    }
}

fn gain(cause: &Value) -> f64 {
    cause["gain"]["reduction_percent"].as_f64().unwrap_or(0.0)
}

fn with_file(mut value: Value, one: &One) -> Value {
    if let Value::Object(map) = &mut value {
        map.insert("file".into(), json!(one.path().display().to_string()));
    }
    value
}

fn check_json(check: &Check) -> Value {
    json!({
        "from": check.from,
        "causes": check.causes,
        "against": check.against,
        "rms_before": check.before,
        "rms_after": check.after,
        "unit": check.unit,
        "prediction": check.word(),
    })
}

fn line(stem: &str, answer: &Answer) -> [String; 6] {
    let after = overview::held_out(answer);
    let unsure = answer
        .groups
        .iter()
        .filter_map(|g| g.effects.first().map(|e| format!("{e}?")));
    let causes: Vec<String> = match answer.groups.is_empty() {
        true => named(answer),
        false => answer
            .causes
            .iter()
            .map(|c| format!("{} at {}", c.effect, c.site))
            .chain(unsure)
            .collect(),
    };
    [
        stem.to_string(),
        answer.verdict.name().to_string(),
        causes.join(", "),
        engineering(answer.discrepancy.rms, 3, answer.unit),
        engineering(answer.discrepancy.noise_rms, 2, answer.unit),
        after.map_or(String::new(), |after| engineering(after, 3, answer.unit)),
    ]
}

/// The account on the terminal.
pub fn account(campaign: &Campaign) -> String {
    use crate::report::text;
    let mut said = format!(
        "{}{}: {}\n",
        campaign.place.measurements().display(),
        if campaign.synthetic() {
            " (synthetic)"
        } else {
            ""
        },
        campaign.verdict.name()
    );
    said.push_str(&text::indented(&campaign.sentence(), 2));
    said.push_str(&format!("\n{}", text::table(&campaign.overview())));
    if !campaign.checks.is_empty() {
        said.push_str(&format!("\n{}", text::table(&campaign.checked())));
    }
    for one in &campaign.files {
        let answer = one.found.answer();
        if answer.verdict == Verdict::Sufficient {
            continue;
        }
        said.push_str(&format!("\n{}\n", one.stem()));
        said.extend(sentences(answer).iter().map(|s| text::indented(s, 2)));
    }
    said
}

/// Diagnoses a campaign, and writes what that found.
///
/// # Errors
/// A file that cannot be read, results that cannot be written.
pub fn chapter(place: &Place) -> Outcome<Option<Chapter>> {
    let campaign = examine(place, false)?;
    super::write(&campaign.files, campaign.written())?;
    let sources = campaign.files.iter().map(|one| one.found.source());
    Ok(Some(Chapter {
        title: "What the simulation gets wrong".into(),
        ending: campaign.ending(),
        inputs: sources
            .map(|s| (s.path.to_path_buf(), s.sha256.to_string()))
            .collect(),
        page: campaign.page(),
    }))
}
