//! `ident lab`: campaigns with known truth, hidden effects, blind sets.

use super::output::{located, print};
use super::progress::Progress;
use super::{Ending, Verb, arguments, parsed};
use crate::effects;
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::random::Random;
use crate::laboratory::{blind, hide, truth::Truth};
use crate::measurement::load_cycle::LoadCycle;
use clap::{ArgMatches, Args};
use rayon::prelude::*;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "lab",
    about: "Simulate measurements with known truth: a campaign, a hidden effect, a blind set",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Truth file of a campaign (writes beside it), or the measurement to hide an effect in
    file: Option<PathBuf>,
    /// Hide this effect in FILE
    #[arg(long, value_name = "EFFECT", requires = "file")]
    hide: Option<String>,
    /// Strength of the hidden effect, in times the noise of FILE
    #[arg(long, default_value_t = 10.0, value_name = "TIMES")]
    strength: f64,
    /// Make a blind set of this many files
    #[arg(long, value_name = "N", conflicts_with_all = ["file", "hide"])]
    blind: Option<u64>,
    /// Seed; the same seed gives the same files
    #[arg(long)]
    seed: Option<u64>,
    /// Where to write: a file for --hide, a folder otherwise
    #[arg(long, value_name = "PATH")]
    out: Option<PathBuf>,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    match (&arguments.file, &arguments.hide, arguments.blind) {
        (None, _, Some(count)) => blind_set(&arguments, count)?,
        (Some(file), Some(effect), _) => hide_in(&arguments, file, effect)?,
        (Some(file), None, _) => campaign(&arguments, file)?,
        (None, _, None) => {
            return Err(Problem::new(
                "nothing to simulate",
                "give a truth file, `FILE --hide EFFECT`, or `--blind N`",
            ));
        }
    }
    Ok(Ending::Done)
}

fn campaign(arguments: &Arguments, path: &Path) -> Outcome<()> {
    let mut truth = Truth::read(path)?;
    truth.seed = arguments.seed.unwrap_or(truth.seed);
    let beside = path.parent().unwrap_or(Path::new(""));
    let folder = arguments.out.as_deref().unwrap_or(beside);
    let recordings = truth.record().map_err(|p| p.in_file(path))?;
    for (name, text) in &recordings {
        files::replace(&folder.join(name), text.as_bytes())?;
    }
    print(&format!(
        "{} synthetic files written under {}\n",
        recordings.len(),
        folder.display()
    ))
}

fn hide_in(arguments: &Arguments, file: &Path, name: &str) -> Outcome<()> {
    let path = located(file)?;
    let effect = effects::Composite::named(&[name])?
        .effects()
        .last()
        .copied()
        .unwrap_or(effects::SPRING);
    let measurement = LoadCycle::read(&path)?;
    if measurement.left_out > 0 {
        return Err(Problem::new(
            "has rows with empty cells",
            "hide effects in a complete file",
        )
        .in_file(&path));
    }
    let random = &mut Random::new(arguments.seed.unwrap_or(1));
    let hidden = hide::hide(effect, arguments.strength, &measurement, random)
        .map_err(|p| p.in_file(&path))?;
    let text = with_addition(&path, &measurement, &hidden)?;
    let default = path.with_file_name(format!("{}-{name}.csv", measurement.stem()));
    let out = arguments.out.clone().unwrap_or(default);
    files::replace(&out, text.as_bytes())?;
    print(&format!(
        "{} hidden at {} times the noise in {}\n",
        name,
        arguments.strength,
        out.display()
    ))
}

/// The measurement as SI columns with the hidden effect added to every deflection.
fn with_addition(path: &Path, file: &LoadCycle, hidden: &hide::Hidden) -> Outcome<String> {
    let original = String::from_utf8_lossy(&files::read_bytes(path)?).to_string();
    let mut text = String::new();
    for line in original.lines().take_while(|l| l.starts_with('#')) {
        if !line.contains("_lever_m") && !line.contains("synthetic") {
            let _ = writeln!(text, "{line}");
        }
    }
    let _ = writeln!(
        text,
        "# synthetic = true   # an effect was hidden by `ident lab`"
    );
    let (load, angle) = match file.port {
        crate::measurement::load_cycle::Port::Rotational => ("moment_Nm", "angle_rad"),
        crate::measurement::load_cycle::Port::Linear => ("force_N", "displacement_m"),
    };
    let second = file.second.as_ref().map(|_| angle.replacen('_', "2_", 1));
    let _ = writeln!(
        text,
        "time_s,{load},{angle}{}",
        second.map_or(String::new(), |s| format!(",{s}"))
    );
    for i in 0..file.load.len() {
        let extra = hidden.addition[i];
        let _ = write!(
            text,
            "{:?},{:?},{:e}",
            file.time[i],
            file.load[i],
            file.deflection[i] + extra
        );
        match file.second.as_ref().map(|s| s[i]) {
            Some(v) if v.is_nan() => text.push(','),
            Some(v) => {
                let _ = write!(text, ",{:e}", v + extra);
            }
            None => {}
        }
        text.push('\n');
    }
    Ok(text)
}

fn blind_set(arguments: &Arguments, count: u64) -> Outcome<()> {
    let folder = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from("blind"));
    let seed = arguments.seed.unwrap_or(1);
    let progress = Progress::new(count as usize, false);
    (0..count).into_par_iter().try_for_each(|index| {
        let one = blind::make(index, seed, &folder)?;
        files::replace(
            &folder.join(format!("case{index:04}.csv")),
            one.csv.as_bytes(),
        )?;
        progress.done("case");
        files::replace(
            &folder.join("truth").join(format!("case{index:04}.toml")),
            one.truth.as_bytes(),
        )
    })?;
    progress.finish();
    print(&format!(
        "{count} blind files under {0}, their truths under {0}/truth\n",
        folder.display()
    ))
}
