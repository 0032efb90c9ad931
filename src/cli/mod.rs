//! Floor 10: one file per verb. A new verb is one file, one `mod` line and one line in [`VERBS`].

mod chapter;
mod compare;
mod compensate;
mod completions;
mod damping;
mod diagnose;
mod effects;
mod force;
mod frf;
mod import;
mod inspect;
mod lab;
mod lobes;
mod mill;
mod new;
mod output;
mod part_map;
mod plan;
mod progress;
mod report;
mod robot;
mod run;
mod screw;
mod sensor;
mod simulate;
mod stiffness;
mod survey;
mod validate;

pub use output::tell;

use crate::ground::problem::Outcome;
use clap::{ArgMatches, Args, Command, FromArgMatches};

/// How a verb ended; the number is the exit status of `formats.md`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// 0: done.
    Done,
    /// 1: done, and something needs attention.
    Attention,
}

impl Ending {
    /// Done if all is fine.
    pub fn done_if(fine: bool) -> Self {
        if fine { Self::Done } else { Self::Attention }
    }

    /// Attention if something is odd.
    pub fn attention_if(odd: bool) -> Self {
        Self::done_if(!odd)
    }
}

/// One verb of the command line.
pub struct Verb {
    /// Its name as typed.
    pub name: &'static str,
    /// One line for the list of verbs.
    pub about: &'static str,
    /// Adds its arguments to a command.
    pub arguments: fn(Command) -> Command,
    /// Runs it.
    pub run: fn(&ArgMatches) -> Outcome<Ending>,
}

/// Every verb, in the order of the help text.
pub const VERBS: &[Verb] = &[
    inspect::VERB,
    import::VERB,
    stiffness::VERB,
    damping::VERB,
    screw::VERB,
    sensor::VERB,
    force::VERB,
    lobes::VERB,
    diagnose::VERB,
    mill::VERB,
    compensate::VERB,
    run::VERB,
    report::VERB,
    frf::VERB,
    survey::VERB,
    validate::VERB,
    plan::VERB,
    robot::VERB,
    simulate::VERB,
    effects::VERB,
    lab::VERB,
    compare::VERB,
    new::VERB,
    completions::VERB,
];

/// Adds the arguments of a derived `Args` type: the usual [`Verb::arguments`].
pub fn arguments<A: Args>(command: Command) -> Command {
    A::augment_args(command)
}

/// Reads a derived `Args` type back. The matches were made by the same type.
pub fn parsed<A: FromArgMatches>(matches: &ArgMatches) -> A {
    A::from_arg_matches(matches).unwrap_or_else(|error| error.exit())
}

/// A derived `Args` type as if only these words had been typed.
pub fn from_words<A: Args + FromArgMatches>(words: &[std::path::PathBuf]) -> A {
    let command = A::augment_args(Command::new("ident").no_binary_name(true));
    parsed(&command.get_matches_from(words))
}

/// The whole command line.
pub fn command() -> Command {
    let root = Command::new("ident")
        .version(env!("CARGO_PKG_VERSION"))
        .about("Identify soft milling robots from measurements, and name what the simulation gets wrong")
        .subcommand_required(true)
        .arg_required_else_help(true);
    VERBS.iter().fold(root, |root, verb| {
        root.subcommand((verb.arguments)(Command::new(verb.name)).about(verb.about))
    })
}

/// Runs the verb that was typed.
pub fn dispatch(matches: &ArgMatches) -> Outcome<Ending> {
    let (name, matches) = matches.subcommand().expect("clap requires a verb");
    let verb = VERBS.iter().find(|verb| verb.name == name);
    (verb.expect("clap knows only the verbs of the table").run)(matches)
}
