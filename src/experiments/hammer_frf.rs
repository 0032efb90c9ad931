//! Hammer tests: from a record to frequency response functions with their scatter.

use super::hammer_force::{ForceNoise, ForceWindow, force_noise};
use super::hammer_given::{self, ScatterFrom};
use super::hammer_screen::{ScreenedHit, directions, screen};
use super::hammer_window::{treated, window};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::stats::mean;
use crate::measurement::hammer::HammerRecord;
use crate::signal::fault::Fault;
use crate::signal::frf::{CrossSpectra, Estimator, HitSpectra};
use crate::signal::pulse::{self, Pulse};
use crate::signal::spectrum::{frequencies, lines_up_to};
use crate::signal::window::Exponential;

/// Share of the response that may be left at the end of the record without a remark.
const ENOUGH_DECAY: f64 = 0.1;

/// How hits become FRFs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Upper end of the band that the hits must excite, Hz.
    pub band_hz: f64,
    /// Highest line kept, Hz; none: up to Nyquist.
    pub to_hz: Option<f64>,
    /// Where the force is set to zero outside its pulse.
    pub force_window: ForceWindow,
    /// Whether doubled hits are used where a direction has fewer than two others: their whole force
    /// was recorded.
    pub keep_double: bool,
    /// Value of an exponential window at the end of the record; none: no window is applied.
    pub exponential_end: Option<f64>,
    /// Instead of that a window at least so fast, 1/s, those in the records counted, and so fast that of neither noise nor
    /// response anything is left at the end.
    pub least_rate: Option<f64>,
    /// Whether modes will be sought.
    pub modes: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            band_hz: 50.0,
            to_hz: None,
            force_window: ForceWindow::Never,
            keep_double: false,
            exponential_end: None,
            least_rate: None,
            modes: false,
        }
    }
}

/// The FRFs of one direction of the force.
#[derive(Debug, Clone, PartialEq)]
pub struct InputFrf {
    /// The direction.
    pub input: String,
    /// Spectra of every hit that was used.
    pub hits: Vec<HitSpectra>,
    /// Their sums.
    pub sums: CrossSpectra,
    /// Mean power of the noise of every output per line of one hit, by the samples before the pulse,
    /// ((m/s²)·samples)²; 0 where they are too few.
    pub noise_power: Vec<f64>,
    /// What the noise of the force does where every hit has a force window.
    pub force_noise: Option<ForceNoise>,
    /// Variance per output and line, `var(Re) + var(Im)`, where there are no hits to show it.
    pub scatter: Option<Vec<Vec<f64>>>,
}

/// A hammer test as FRFs.
#[derive(Debug, Clone, PartialEq)]
pub struct HammerFrf {
    /// Time between samples, s.
    pub interval_s: f64,
    /// Length of every record, s.
    pub length_s: f64,
    /// Mean instant of the impulse from the start of the records, s.
    pub impulse_s: f64,
    /// Total rate σ of the exponential windows, 1/s: the FRFs are `H(jω + σ)`.
    pub rate: f64,
    /// The part of it that was in the records, 1/s.
    pub recorded_rate: f64,
    /// Frequencies of the lines, Hz, from 0.
    pub frequency_hz: Vec<f64>,
    /// Names of the outputs.
    pub outputs: Vec<String>,
    /// Every hit, with the reasons of those left out.
    pub screened: Vec<ScreenedHit>,
    /// FRFs per direction of the force.
    pub inputs: Vec<InputFrf>,
    /// The same for modes, if asked for: without the window of [`Settings::exponential_end`], as a
    /// model that knows the end of the record loses nothing there, and with the force windows of
    /// [`ForceWindow::Quiet`].
    pub for_modes: Option<Vec<InputFrf>>,
    /// What the user should know, each with its remedy.
    pub remarks: Vec<String>,
    /// Where their scatter comes from.
    pub scatter_from: ScatterFrom,
}

/// Screens the hits of `record` and estimates the FRFs from the good ones, or takes those that it holds.
pub fn estimate(record: &HammerRecord, settings: &Settings) -> Outcome<HammerFrf> {
    if let Some(given) = &record.given {
        return Ok(hammer_given::frf(record, given, settings));
    }
    let mut screened = screen(record, settings.band_hz);
    if settings.keep_double {
        readmit_doubled(&mut screened);
    }
    let used: Vec<&ScreenedHit> = screened.iter().filter(|hit| hit.used()).collect();
    let samples = used.iter().map(|hit| hit.force.len()).min();
    let samples = samples.ok_or_else(|| no_hit(&screened))?;
    let length_s = samples as f64 * record.interval_s;
    let recorded_rate = record.exponential_window_s.map_or(0.0, f64::recip);
    let window = window(settings, &used, length_s, recorded_rate);
    let lines = lines_up_to(samples, record.interval_s, settings.to_hz);
    let inputs = |window: Exponential, force: ForceWindow| {
        let recorded = Exponential {
            rate: recorded_rate,
        };
        let span = (samples, record.interval_s);
        let treat = |hit: &ScreenedHit| treated(hit, span, [recorded, window], force);
        let rate = window.rate + recorded_rate;
        let power = Exponential { rate }.power(samples, record.interval_s);
        inputs(&screened, lines, power, force, treat)
    };
    let mut frf = HammerFrf {
        interval_s: record.interval_s,
        length_s,
        impulse_s: impulse(&used, record.interval_s),
        rate: window.rate + recorded_rate,
        recorded_rate,
        frequency_hz: frequencies(samples, record.interval_s, lines),
        outputs: record.outputs.clone(),
        inputs: inputs(window, settings.force_window),
        for_modes: settings
            .modes
            .then(|| inputs(Exponential { rate: 0.0 }, ForceWindow::Quiet)),
        screened: Vec::new(),
        remarks: Vec::new(),
        scatter_from: ScatterFrom::Hits,
    };
    frf.remarks = remarks(&frf, &screened, settings);
    frf.screened = screened;
    Ok(frf)
}

/// FRFs per direction from the used hits, each made ready by `treat`.
fn inputs(
    screened: &[ScreenedHit],
    lines: usize,
    power: f64,
    window: ForceWindow,
    treat: impl Fn(&ScreenedHit) -> (Vec<f64>, Vec<Vec<f64>>),
) -> Vec<InputFrf> {
    let spectra = |hit: &&ScreenedHit| {
        let (force, responses) = treat(hit);
        HitSpectra::new(force, responses, lines)
    };
    let inputs = directions(screened).into_iter().filter_map(|input| {
        let own = screened.iter().filter(|h| h.used() && h.direction == input);
        let own: Vec<&ScreenedHit> = own.collect();
        let hits: Vec<_> = own.iter().map(spectra).collect();
        (!hits.is_empty()).then(|| InputFrf {
            input,
            sums: CrossSpectra::of(&hits),
            hits,
            noise_power: noise_power(&own, power),
            force_noise: force_noise(&own, window),
            scatter: None,
        })
    });
    inputs.collect()
}

/// Mean power per line of the noise of every output, `power` being that of the windows.
fn noise_power(hits: &[&ScreenedHit], power: f64) -> Vec<f64> {
    let starts = hits.iter().map(|hit| Pulse::find(&hit.force));
    let starts: Vec<usize> = starts.map(|p| p.map_or(0, |pulse| pulse.start)).collect();
    let of = |output: usize| {
        let stds = hits
            .iter()
            .zip(&starts)
            .filter_map(|(hit, start)| pulse::noise_before(&hit.responses[output], *start));
        stds.map(|std| std.powi(2)).sum::<f64>() / hits.len() as f64 * power
    };
    let outputs = hits.first().map_or(0, |hit| hit.responses.len());
    (0..outputs).map(of).collect()
}

/// Takes doubled hits back where a direction is left with fewer than two hits.
fn readmit_doubled(screened: &mut [ScreenedHit]) {
    for direction in directions(screened) {
        let own = |hit: &&mut ScreenedHit| hit.direction == direction;
        let count = screened.iter_mut().filter(own).filter(|h| h.used()).count();
        if count < 2 {
            let own = screened.iter_mut().filter(own);
            own.for_each(|hit| hit.faults.retain(|f| !matches!(f, Fault::DoubleHit { .. })));
        }
    }
}

fn no_hit(screened: &[ScreenedHit]) -> Problem {
    let why = screened
        .iter()
        .filter_map(|hit| Some(format!("{} {}: {}", hit.direction, hit.hit, hit.why()?)));
    let why: Vec<String> = why.take(5).collect();
    let what = if why.is_empty() {
        "no hit was found".to_string()
    } else {
        format!("no usable hit ({})", why.join("; "))
    };
    Problem::new(what, "repeat the hits with these faults in mind")
}

fn impulse(hits: &[&ScreenedHit], interval_s: f64) -> f64 {
    let centroid = |hit: &ScreenedHit| Some(Pulse::find(&hit.force)?.centroid(&hit.force));
    let instants: Vec<f64> = hits.iter().filter_map(|hit| centroid(hit)).collect();
    mean(&instants) * interval_s
}

fn remarks(frf: &HammerFrf, screened: &[ScreenedHit], settings: &Settings) -> Vec<String> {
    let mut remarks = Vec::new();
    let used = screened.iter().filter(|hit| hit.used());
    let ring = used.map(|hit| hit.ring).fold(0.0, f64::max);
    let ring = ring * (-frf.rate * frf.length_s).exp();
    if ring > ENOUGH_DECAY && settings.exponential_end.is_none() && settings.least_rate.is_none() {
        remarks.push(format!(
            "the records end before the decay ({:.0} % of the response left): record longer, or use --exponential-end 0.01",
            100.0 * ring
        ));
    }
    for input in &frf.inputs {
        if input.hits.len() < 2 {
            remarks.push(format!(
                "direction {}: a single hit has no coherence and no interval: give three to five",
                input.input
            ));
        }
    }
    remarks.extend(super::hammer_checks::remarks(frf, settings.band_hz));
    remarks
}

impl InputFrf {
    /// The FRF of one output, DC not a number.
    pub fn frf(&self, output: usize, estimator: Estimator) -> Vec<rustfft::num_complex::Complex64> {
        self.sums.estimate(output, estimator)
    }
}
