//! `ident damping`: from hammer tests to the damping constants of the robot.

mod account;
mod figures;
mod input;
mod page;
mod remarks;
mod result;
mod write;

use super::chapter::Chapter;
use super::output::{print, tell};
use super::{Ending, Verb, arguments, from_words, parsed};
use crate::experiments::hammer_force::ForceWindow;
use crate::experiments::hammer_frf::Settings;
use crate::fit::damping::{Account, Request, identify};
use crate::fit::frf_robot::Released;
use crate::fit::frf_tuning::Residuals;
use crate::fit::parameter::{Identified, Status};
use crate::fit::suitability::is_fatal;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::workspace::Place;
use crate::report::json;
use crate::robot::Robot;
use clap::{ArgMatches, Args, ValueEnum};
use result::Damped;
use std::path::PathBuf;

/// The verb.
pub const VERB: Verb = Verb {
    name: "damping",
    about: "Tune damping constants until simulated FRFs meet those of hammer tests",
    arguments: arguments::<Arguments>,
    run,
};

/// Arguments of `ident damping`.
#[derive(Debug, Args)]
struct Arguments {
    /// Hammer tests (CSV of kind hammer, universal files), several poses at once; without a file
    /// those of the campaign
    #[arg(long, value_name = "FILE", num_args = 0.., required = true)]
    frf: Vec<PathBuf>,
    /// Campaign under measurements/, if there are several
    #[arg(long, value_name = "NAME")]
    campaign: Option<String>,
    /// Robot (built-in name or file) instead of the identified one or the one the files name
    #[arg(long, value_name = "ROBOT")]
    robot: Option<String>,
    /// Pose of the files that state none, as universal files do: joint angles in degrees, A1 first
    #[arg(
        long,
        value_name = "Q1,..,Q6",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    joints_deg: Option<Vec<f64>>,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Report and write every stiffness too, tuned within its interval (else 0.7 to 1.4 times, prior
    /// 10 %); without this it is fitted along within what the robot or the test says of it
    #[arg(long)]
    release_stiffness: bool,
    /// Tune the mass of the tool too (0.7 to 1.4 times, prior 10 %)
    #[arg(long)]
    release_mass: bool,
    /// Regularise: prior of every damping about the robot's value, one standard deviation being this
    /// factor either way
    #[arg(long, value_name = "FACTOR")]
    prior: Option<f64>,
    /// Terms per direction pair for what the model leaves out
    #[arg(long, value_enum, default_value_t = Terms::None)]
    residuals: Terms,
    /// Lower end of the band
    #[arg(long = "from-Hz", value_name = "HZ", default_value_t = 2.0)]
    from_hz: f64,
    /// Upper end of the band
    #[arg(long = "to-Hz", value_name = "HZ", default_value_t = 50.0)]
    to_hz: f64,
    /// Exponential window on force and response that ends at this value; 1: none
    #[arg(long, value_name = "VALUE", default_value_t = 0.01)]
    exponential_end: f64,
    /// Starts of the search, the first at the robot's values
    #[arg(long, default_value_t = 8, value_name = "N")]
    starts: usize,
    /// Write no fit, no robot and no report
    #[arg(long)]
    dry_run: bool,
}

/// Residual terms as typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Terms {
    /// The model alone
    None,
    /// Stiffness of modes above the band
    Upper,
    /// That, and mass of motion below it
    Both,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let damped = act(&arguments)?;
    let notes = [damped.remarks(), damped.passed_over()].concat();
    notes.iter().for_each(|note| tell(&format!("note: {note}")));
    let written = match arguments.dry_run {
        true => Vec::new(),
        false => write::all(&damped)?,
    };
    match arguments.json {
        true => print(&json::print(damped.json()))?,
        false => print(&account::text(&damped, &written))?,
    }
    Ok(damped.ending())
}

fn act(arguments: &Arguments) -> Outcome<Damped> {
    let request = request(arguments)?;
    let input = input::read(arguments, &request.settings)?;
    let mut account = identify(&input.tests, &input.robot.robot, &request)
        .map_err(|problem| problem.in_file(&PathBuf::from(&input.robot.path)))?;
    if is_fatal(&input.doubts) {
        withhold(&mut account, &input.robot.robot);
    }
    Ok(Damped {
        input,
        request,
        account,
    })
}

/// Takes back every number: the records cannot carry one.
fn withhold(account: &mut Account, robot: &Robot) {
    let none = |p: Identified| p.without_value(Status::NotIdentifiable);
    account.parameters = std::mem::take(&mut account.parameters)
        .into_iter()
        .map(none)
        .collect();
    account.supported = false;
    account.robot = robot.clone();
}

/// Tunes the dampings with every hammer test of a campaign, and writes what that found.
///
/// # Errors
/// A file that cannot be read, a robot that does not fit, results that cannot be written.
pub fn chapter(place: &Place) -> Outcome<Option<Chapter>> {
    if place.files_of("hammer")?.is_empty() {
        return Ok(None);
    }
    let words = ["--frf", "--campaign", &place.campaign].map(PathBuf::from);
    let damped = act(&from_words::<Arguments>(&words))?;
    write::all(&damped)?;
    let tests = damped.input.tests.iter();
    Ok(Some(Chapter {
        title: "The hammer tests".into(),
        ending: damped.ending(),
        inputs: tests
            .map(|t| (t.path.clone(), t.record.sha256.clone()))
            .collect(),
        page: page::page(&damped),
    }))
}

fn request(arguments: &Arguments) -> Outcome<Request> {
    let refuse =
        |name: &str, what: &str, remedy: &str| Err(Problem::new(what, remedy).in_column(name));
    let (from_hz, to_hz) = (arguments.from_hz, arguments.to_hz);
    if !(from_hz >= 0.0 && to_hz > from_hz && to_hz.is_finite()) {
        return refuse(
            "--to-Hz",
            "the band is empty",
            "give --from-Hz below --to-Hz, both positive",
        );
    }
    let end = arguments.exponential_end;
    if !(end > 0.0 && end <= 1.0) {
        return refuse(
            "--exponential-end",
            "lies outside 0 to 1",
            "give a value such as 0.01, or 1 for no window",
        );
    }
    if arguments
        .prior
        .is_some_and(|factor| !(factor > 1.0 && factor.is_finite()))
    {
        return refuse(
            "--prior",
            "is no factor above 1",
            "give for example 3: a third to three times",
        );
    }
    if !(1..=1000).contains(&arguments.starts) {
        return refuse(
            "--starts",
            "lies outside 1 to 1000",
            "give a small number such as 4",
        );
    }
    Ok(Request {
        settings: Settings {
            band_hz: to_hz,
            exponential_end: (end < 1.0).then_some(end),
            force_window: ForceWindow::Quiet,
            modes: true,
            ..Settings::default()
        },
        from_hz,
        released: Released {
            stiffness: arguments.release_stiffness,
            mass: arguments.release_mass,
            prior_ln_std: arguments.prior.map(f64::ln),
        },
        residuals: match arguments.residuals {
            Terms::None => Residuals::None,
            Terms::Upper => Residuals::Upper,
            Terms::Both => Residuals::Both,
        },
        starts: arguments.starts,
    })
}
