//! `ident frf`: frequency response functions of any structure from hammer tests.

mod given;

use super::output::{print, tell};
use super::{Ending, Verb, arguments};
use crate::experiments::hammer_force::ForceWindow;
use crate::experiments::hammer_frf::{self, HammerFrf, InputFrf, Settings};
use crate::experiments::hammer_functions::universal_file;
use crate::experiments::hammer_given::{self, ScatterFrom};
use crate::experiments::hammer_modes::modes;
use crate::experiments::hammer_screen::ScreenedHit;
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::{hammer_uff, uff};
use crate::report::json;
use crate::sheet::number::fixed;
use crate::signal::coherence::random_error;
use crate::signal::frf::Estimator;
use crate::signal::jackknife;
use crate::signal::modes::Mode;
use clap::{ArgMatches, Args, ValueEnum};
use rustfft::num_complex::Complex64;
use serde_json::{Map, Value, json};
use std::path::PathBuf;

/// The verb.
pub const VERB: Verb = Verb {
    name: "frf",
    about: "Frequency response functions from hammer tests: hits judged, H1, H2, Hv, coherence",
    arguments: arguments::<FrfArgs>,
    run,
};

/// Arguments of `ident frf`.
#[derive(Debug, Args)]
pub struct FrfArgs {
    /// Hammer test: CSV of kind `hammer`, or a universal file (.uff, .unv) with time records or FRFs
    file: PathBuf,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Write the FRFs and coherences as universal file (data set 58b, SI)
    #[arg(long, value_name = "FILE")]
    uff: Option<PathBuf>,
    /// Write that universal file as text (data set 58) instead
    #[arg(long, requires = "uff")]
    uff_ascii: bool,
    /// Estimator for the account and the universal file (the JSON holds all three)
    #[arg(long, value_enum, default_value_t = Choice::H1)]
    estimator: Choice,
    /// Highest frequency reported [default: up to half the sampling rate]
    #[arg(long = "to-Hz", value_name = "HZ")]
    to_hz: Option<f64>,
    /// Upper end of the band that every hit must excite
    #[arg(long = "band-Hz", value_name = "HZ", default_value_t = 50.0)]
    band_hz: f64,
    /// Apply an exponential window to force and response that ends at this value (0 to 1); the
    /// result is H(jω + σ), and σ is reported
    #[arg(long, value_name = "VALUE")]
    exponential_end: Option<f64>,
    /// Identify the modes up to --band-Hz
    #[arg(long)]
    modes: bool,
    /// Set the force to zero outside its pulse
    #[arg(long)]
    force_window: bool,
}

/// Estimators as typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Choice {
    H1,
    H2,
    Hv,
}

impl Choice {
    fn estimator(self) -> Estimator {
        match self {
            Self::H1 => Estimator::H1,
            Self::H2 => Estimator::H2,
            Self::Hv => Estimator::Hv,
        }
    }
}

/// Runs the verb.
pub fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let args: FrfArgs = super::parsed(matches);
    let settings = settings(&args)?;
    let record = hammer_uff::read_any(&args.file)?;
    let in_file = |problem: Problem| problem.in_file(&args.file);
    let mut frf = hammer_frf::estimate(&record, &settings).map_err(in_file)?;
    for remark in &frf.remarks {
        tell(&format!("note: {remark}"));
    }
    if let Some(path) = &args.uff {
        let file = universal_file(&frf, args.estimator.estimator());
        let encoding = match args.uff_ascii {
            true => uff::Encoding::Ascii,
            false => uff::Encoding::Binary,
        };
        files::replace(path, &uff::write(&file, encoding))?;
    }
    let modes = args.modes.then(|| modes(&frf, args.band_hz));
    let lasting = hammer_given::undecayed(&frf, modes.as_deref().unwrap_or_default());
    lasting
        .iter()
        .for_each(|remark| tell(&format!("note: {remark}")));
    frf.remarks.extend(lasting);
    if args.json {
        print(&json::line(document(
            &args,
            &record.sha256,
            &frf,
            modes.as_deref(),
        )))?;
    } else {
        let account = account(&frf, args.estimator.estimator());
        print(&(account + &modes_account(&frf, modes.as_deref())))?;
    }
    Ok(ending(&frf))
}

fn settings(args: &FrfArgs) -> Outcome<Settings> {
    let positive = |value: f64, name: &str| {
        let good = value > 0.0 && value.is_finite();
        let problem = || Problem::new("is not a positive number", "give a number above 0");
        good.then_some(value)
            .ok_or_else(|| problem().in_column(name))
    };
    if args
        .exponential_end
        .is_some_and(|end| !(end > 0.0 && end < 1.0))
    {
        return Err(Problem::new(
            "lies outside 0 to 1",
            "give the value at the end, such as 0.01",
        )
        .in_column("--exponential-end"));
    }
    Ok(Settings {
        band_hz: positive(args.band_hz, "--band-Hz")?,
        to_hz: args.to_hz.map(|hz| positive(hz, "--to-Hz")).transpose()?,
        force_window: match args.force_window {
            true => ForceWindow::Always,
            false => ForceWindow::Never,
        },
        exponential_end: args.exponential_end,
        modes: args.modes,
        ..Settings::default()
    })
}

fn ending(frf: &HammerFrf) -> Ending {
    let rejected = frf.screened.iter().any(|hit| !hit.used());
    if rejected || !frf.remarks.is_empty() {
        Ending::Attention
    } else {
        Ending::Done
    }
}

fn document(
    args: &FrfArgs,
    sha256: &str,
    frf: &HammerFrf,
    modes: Option<&[Mode]>,
) -> Map<String, Value> {
    let mut document = json::head("frf", &[(&args.file, sha256)]);
    document.insert("resolution_Hz".into(), json::number(1.0 / frf.length_s));
    document.insert("exponential_rate_1_s".into(), json::number(frf.rate));
    document.insert("remarks".into(), json!(frf.remarks));
    document.insert("hits".into(), frf.screened.iter().map(hit).collect());
    document.insert("scatter".into(), json!(frf.scatter_from.sentence()));
    let inputs = frf.inputs.iter();
    let channels = inputs.flat_map(|input| (0..frf.outputs.len()).map(|o| channel(frf, input, o)));
    document.insert("channels".into(), channels.collect());
    if let Some(modes) = modes {
        document.insert("modes".into(), modes.iter().map(mode).collect());
    }
    document
}

fn hit(hit: &ScreenedHit) -> Value {
    let label = hit.hit.parse::<u64>().map_or(json!(hit.hit), |n| json!(n));
    json!({"direction": hit.direction, "hit": label, "used": hit.used(), "why": hit.why()})
}

/// A mode with its intervals, null where there is none.
pub(super) fn mode(mode: &Mode) -> Value {
    let interval = |value: f64, half: f64| {
        let bounds = [value - half, value + half];
        half.is_finite().then(|| json::numbers(&bounds))
    };
    json!({
        "frequency_Hz": json::number(mode.frequency_hz),
        "frequency_ci95_Hz": interval(mode.frequency_hz, mode.half_width[0]),
        "damping_ratio": json::number(mode.damping_ratio),
        "damping_ratio_ci95": interval(mode.damping_ratio, mode.half_width[1]),
    })
}

fn modes_account(frf: &HammerFrf, modes: Option<&[Mode]>) -> String {
    let Some(modes) = modes else {
        return String::new();
    };
    let row = |m: &Mode| {
        let [f, d] = m.half_width;
        let (hz, percent) = (m.frequency_hz, 100.0 * m.damping_ratio);
        format!(
            "{hz:>9.3} ± {f:.3} Hz  damping {percent:>6.3} ± {:.3} %\n",
            100.0 * d
        )
    };
    let rows: String = modes.iter().map(row).collect();
    let how = match frf.scatter_from {
        ScatterFrom::Hits => "by jackknife over hits",
        _ => "by what the fit leaves; what differs from hit to hit is not in the file",
    };
    format!("{} modes (95 % intervals {how})\n{rows}", modes.len())
}

fn channel(frf: &HammerFrf, input: &InputFrf, output: usize) -> Value {
    if frf.scatter_from != ScatterFrom::Hits {
        return given::channel(frf, input, output);
    }
    let estimate = |estimator| complex(&input.frf(output, estimator));
    let lines: Vec<usize> = (0..frf.frequency_hz.len()).collect();
    let variance = jackknife::frf_variance(&input.sums, &input.hits, output, Estimator::H1, &lines);
    let deviation: Vec<f64> = variance.iter().map(|v| v.sqrt()).collect();
    json!({
        "input": input.input,
        "output": frf.outputs[output],
        "unit": "(m/s²)/N",
        "hits": input.hits.len(),
        "frequency_Hz": frf.frequency_hz,
        "h1": estimate(Estimator::H1),
        "h2": estimate(Estimator::H2),
        "hv": estimate(Estimator::Hv),
        "coherence": json::numbers(&input.sums.coherence(output)),
        "h1_jackknife_stderr": json::numbers(&deviation),
    })
}

pub(super) fn complex(values: &[Complex64]) -> Value {
    let pair = |h: &Complex64| json!([json::number(h.re), json::number(h.im)]);
    values.iter().map(pair).collect()
}

fn account(frf: &HammerFrf, estimator: Estimator) -> String {
    if frf.scatter_from != ScatterFrom::Hits {
        return given::account(frf);
    }
    let mut text = String::new();
    for hit in &frf.screened {
        let verdict = hit
            .why()
            .map_or("used".into(), |why| format!("left out: {why}"));
        text += &format!("hit {} {}: {verdict}\n", hit.direction, hit.hit);
    }
    let last = frf.frequency_hz.last().copied().unwrap_or(0.0);
    let resolution = 1.0 / frf.length_s;
    text += &format!("FRF ({estimator:?}) every {resolution:.4} Hz up to {last:.1} Hz\n");
    if frf.rate > 0.0 {
        text += &format!(
            "exponential window: the FRF is H(jω + σ), σ = {:.4} 1/s\n",
            frf.rate
        );
    }
    text += "where the force is within 20 dB of its highest:\n";
    text += "in  out  hits  highest at Hz  (m/s²)/N  coherence  random error %\n";
    for input in &frf.inputs {
        for output in 0..frf.outputs.len() {
            text += &row(frf, input, output, estimator);
        }
    }
    text
}

/// The lines from 1 on at which the force spectrum is within 20 dB of its highest.
fn excited(input: &InputFrf, output: usize) -> Vec<usize> {
    let lines = &input.sums.lines[output];
    let highest = lines.iter().skip(1).map(|line| line.ff).fold(0.0, f64::max);
    let strong = |k: &usize| lines[*k].ff > 0.01 * highest;
    (1..lines.len()).filter(strong).collect()
}

fn row(frf: &HammerFrf, input: &InputFrf, output: usize, estimator: Estimator) -> String {
    let h = input.frf(output, estimator);
    let size = |k: &usize| h[*k].norm();
    let excited = excited(input, output);
    let peak = excited.iter().copied();
    let peak = peak.max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(0);
    let coherence = input.sums.coherence(output);
    let coherence: Vec<f64> = excited.iter().map(|k| coherence[*k]).collect();
    let middle = crate::signal::outliers::median(&coherence);
    let error = 100.0 * random_error(middle, input.hits.len());
    format!(
        "{:<3} {:<4} {:>4} {:>14} {:>9} {:>10} {:>15}\n",
        input.input,
        frf.outputs[output],
        input.hits.len(),
        fixed(frf.frequency_hz[peak], 3),
        fixed(h[peak].norm(), 4),
        fixed(middle, 4),
        fixed(error, 2)
    )
}
