//! Hammer tests whose hits are not there: frequency responses of another program, with the scatter that
//! they show themselves.

use super::hammer_checks;
use super::hammer_frf::{HammerFrf, InputFrf, Settings};
use crate::measurement::frf_uff::{Given, GivenPair};
use crate::measurement::hammer::HammerRecord;
use crate::signal::frf::{CrossSpectra, Line};
use crate::signal::local_rational;
use crate::signal::modes::Mode;
use crate::signal::outliers::median;
use rayon::prelude::*;
use rustfft::num_complex::Complex64;

/// Least coherence that is taken for one: digits end there.
const INCOHERENT: f64 = 1e-9;
/// Share of a mode that may be left at the end of a record without a remark.
const ENOUGH_DECAY: f64 = 0.05;

/// Where the scatter of frequency responses comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ScatterFrom {
    /// The hits.
    #[default]
    Hits,
    /// Coherence and a stated number of averages.
    Coherence,
    /// Coherence, its level by what a local model leaves.
    Level,
    /// What a local model leaves.
    Local,
}

impl ScatterFrom {
    /// In words.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::Hits => "the scatter of the hits",
            Self::Coherence => "the coherences in the file and the stated number of averages",
            Self::Level => {
                "the coherences in the file, their level by what a local smooth model leaves (the number of averages is not stated)"
            }
            Self::Local => "what a local smooth model of the responses leaves",
        }
    }
}

/// Takes the responses up to the highest line asked for.
pub fn frf(record: &HammerRecord, given: &Given, settings: &Settings) -> HammerFrf {
    let lead = usize::from(given.frequency_hz.first().is_some_and(|f| *f > 0.0));
    let inside = |f: &&f64| settings.to_hz.is_none_or(|top| **f <= top);
    let kept: Vec<f64> = given.frequency_hz.iter().filter(inside).copied().collect();
    let step = match given.frequency_hz[..] {
        [first, second, ..] => second - first,
        _ => 1.0,
    };
    let frequency_hz = [vec![0.0; lead], kept].concat();
    let from = scatter_from(given);
    let input = |(name, row): (&String, &Vec<GivenPair>)| {
        let scatter: Vec<Vec<f64>> = row
            .par_iter()
            .map(|pair| scatter(pair, given, from, step))
            .collect();
        let cut = |mut values: Vec<f64>| {
            values.truncate(frequency_hz.len() - lead);
            [vec![0.0; lead], values].concat()
        };
        InputFrf {
            input: name.clone(),
            hits: Vec::new(),
            sums: sums(row, given, (lead, frequency_hz.len())),
            noise_power: vec![0.0; row.len()],
            force_noise: None,
            scatter: Some(scatter.into_iter().map(cut).collect()),
        }
    };
    let top = frequency_hz.last().copied().unwrap_or(step);
    let mut found = HammerFrf {
        interval_s: 0.5 / top.max(step),
        length_s: 1.0 / step,
        impulse_s: 0.0,
        rate: given.rate,
        recorded_rate: given.rate,
        outputs: record.outputs.clone(),
        screened: Vec::new(),
        inputs: given.inputs.iter().zip(&given.pairs).map(input).collect(),
        for_modes: None,
        remarks: given.remarks.clone(),
        scatter_from: from,
        frequency_hz,
    };
    let checks = hammer_checks::remarks(&found, settings.band_hz);
    found.remarks.extend(checks);
    found
}

/// The values as spectra of a force of one newton.
fn sums(row: &[GivenPair], given: &Given, (lead, lines): (usize, usize)) -> CrossSpectra {
    let whole = row.iter().all(|pair| pair.coherence.is_some());
    let line = |pair: &GivenPair, k: usize| {
        let h = pair.accelerance[k];
        let coherence = pair.coherence.as_ref().map_or(1.0, |all| all[k]);
        Line {
            ff: 1.0,
            xx: h.norm_sqr() / coherence.max(INCOHERENT),
            fx: h,
        }
    };
    let nothing = Line {
        ff: 1.0,
        ..Line::default()
    };
    let all = |pair: &GivenPair| {
        let values = (0..lines - lead).map(|k| line(pair, k));
        std::iter::repeat_n(nothing, lead).chain(values).collect()
    };
    CrossSpectra {
        hits: match whole {
            true => given.averages.unwrap_or(2).max(2),
            false => 1,
        },
        lines: row.iter().map(all).collect(),
    }
}

fn scatter_from(given: &Given) -> ScatterFrom {
    let mut pairs = given.pairs.iter().flatten();
    let whole = pairs.all(|pair| pair.coherence.is_some());
    match (whole, given.averages) {
        (true, Some(2..)) => ScatterFrom::Coherence,
        (true, _) => ScatterFrom::Level,
        (false, _) => ScatterFrom::Local,
    }
}

/// Variance `var(Re) + var(Im)` per line of the file.
fn scatter(pair: &GivenPair, given: &Given, from: ScatterFrom, step_hz: f64) -> Vec<f64> {
    let x = given.rate / step_hz;
    let first = usize::from(given.frequency_hz.first().is_some_and(|f| *f <= 0.0));
    let local = || {
        let values = local_rational::variance(&pair.accelerance[first..], x);
        known([vec![f64::NAN; first], values].concat())
    };
    let Some(coherence) = pair
        .coherence
        .as_ref()
        .filter(|_| from != ScatterFrom::Local)
    else {
        return local();
    };
    let shape = pair.accelerance.iter().zip(coherence);
    let shape: Vec<f64> = shape.map(|(h, g)| incoherent(*h, *g)).collect();
    let level = match (from, given.averages) {
        // As the coherence of few averages is too high by one of them (Bendat and Piersol 2010, 9.2).
        (ScatterFrom::Coherence, Some(n)) => 1.0 / (n as f64 - 1.0),
        _ => level(&local(), &shape),
    };
    shape.iter().map(|s| s * level).collect()
}

/// Variance of the response of one average that the force does not explain: `|H|²(1 − γ²)/γ²`
/// (Bendat and Piersol 2010, eq. 9.90).
fn incoherent(h: Complex64, coherence: f64) -> f64 {
    let coherence = coherence.max(INCOHERENT);
    h.norm_sqr() * (1.0 - coherence) / coherence
}

/// Median ratio of what is left to what the coherence says.
fn level(local: &[f64], shape: &[f64]) -> f64 {
    let told = local.iter().zip(shape).filter(|(_, s)| **s > 0.0);
    let ratios: Vec<f64> = told.map(|(l, s)| l / s).collect();
    median(&ratios).max(0.0)
}

/// Lines whose window tells nothing take the median of the others.
fn known(variance: Vec<f64>) -> Vec<f64> {
    let told: Vec<f64> = variance.iter().filter(|v| v.is_finite()).copied().collect();
    let middle = median(&told);
    let or = |v: f64| if v.is_finite() { v } else { middle };
    variance.into_iter().map(or).collect()
}

/// Modes that outlast the records behind the responses: their damping may be wrong.
pub fn undecayed(frf: &HammerFrf, modes: &[Mode]) -> Option<String> {
    let left = |mode: &Mode| ((mode.pole.re - frf.rate) * frf.length_s).exp();
    let lasting = modes.iter().filter(|mode| left(mode) > ENOUGH_DECAY);
    let named: Vec<String> = lasting
        .map(|mode| format!("{:.1} Hz", mode.frequency_hz))
        .collect();
    (frf.scatter_from != ScatterFrom::Hits && !named.is_empty()).then(|| {
        format!(
            "lines every {:.3} Hz come of records of {:.2} s, which end before the modes at {} have decayed: state `exponential_window_s` if a window was applied, or record longer",
            1.0 / frf.length_s,
            frf.length_s,
            named.join(", ")
        )
    })
}
