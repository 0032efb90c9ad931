//! The colour of the noise of a dynamometer, from what a fit of everything leaves between the harmonics of the spindle: a charge
//! amplifier is the noisier the slower one looks.

use super::case::CutSamples;
use super::lines::off_harmonic;
use crate::findings::engine::Noise;
use crate::fit::cut_force::{Account, CutFit};
use crate::ground::products::{gram, tr_mul};
use crate::ground::stats::median;
use crate::signal::relaxation::{Band, Relaxations, Whitening};
use crate::signal::spectrum::Transform;
use nalgebra::DMatrix;
use std::f64::consts::{LN_2, TAU};
use std::sync::Arc;

/// Resolutions of a record on either side of a harmonic of the spindle that belong to it: the harmonics themselves are taken out, and
/// the window makes one of a line that is missing as far as its next neighbour.
const LOBE: f64 = 1.5;
/// Revolutions from which there is something between them.
const TURNS: f64 = 3.5;
/// Ratio of the ends of a band of frequencies: a choice, fine enough for a slope and with lines enough for a median.
const RATIO: f64 = 1.5;
/// Share of its lines that a band is worth: a window makes neighbours alike, and a median knows less than a mean.
const WORTH: f64 = 0.3;
/// Share of the rate of sampling up to which waves are taken out: at half of it a wave has one phase alone.
const HIGHEST: f64 = 0.49;
/// Steps of the clocks of two cuts that differ by more than this share are two.
const EVEN: f64 = 0.02;
/// Waves over the turn of the spindle that are taken out at most: what a law misses is small in higher ones, and a window without edges
/// keeps it near them.
const WAVES: usize = 64;

/// Noise that rises towards low frequencies, channel by channel: amplifiers differ.
#[derive(Debug, Clone)]
pub struct Colour {
    noise: [Relaxations; 3],
    step_s: f64,
}

impl Colour {
    /// From what a fit leaves; `None`: nothing speaks against white noise. Medians over bands of frequencies see no line, whoever
    /// makes it: what stands out of its neighbours is for causes.
    pub fn of(account: &Account, cuts: &[CutSamples]) -> Option<Self> {
        let step = |fit: &CutFit| fit.data.scene.step_s();
        let step_s = account.cuts.iter().find_map(step)?;
        let mut lines: [Vec<[f64; 2]>; 3] = Default::default();
        for (fit, cut) in account.cuts.iter().zip(cuts) {
            let same = step(fit).is_some_and(|s| (s / step_s - 1.0).abs() < EVEN);
            let spindle_hz = cut.present.scene.cut.spindle_rad_s / TAU;
            if same && spindle_hz * step_s * fit.residual.len() as f64 > TURNS {
                let own = between(fit, spindle_hz, step_s);
                lines.iter_mut().zip(own).for_each(|(all, l)| all.extend(l));
            }
        }
        let length = length(cuts);
        let noise = lines.map(|own| {
            let found = Relaxations::of(&bands(own), step_s);
            found.map_or_else(Relaxations::white, |(noise, _)| noise.slower(length))
        });
        let any = noise.iter().any(|n| !n.is_white());
        any.then_some(Self { noise, step_s })
    }

    /// Power of a channel at a frequency, Hz, of readings a step (s) apart, one in the mean over all but for what is slower than the
    /// records.
    pub fn power(&self, channel: usize, hz: f64, step_s: f64) -> f64 {
        self.noise[channel].power(hz, step_s)
    }

    /// Deviation of a channel's second differences over that of white noise of the same size.
    pub fn rough(&self, channel: usize) -> f64 {
        self.noise[channel].rough(self.step_s).sqrt()
    }

    /// In words.
    fn words(&self) -> String {
        let own = self.noise.iter().zip(["x", "y", "z"]);
        let own = own.filter(|(noise, _)| !noise.is_white());
        let corner = |noise: &Relaxations| noise.corner_hz(self.step_s);
        let each = own.map(|(n, name)| format!("below about {:.0} Hz on {name}", corner(n)));
        let each: Vec<String> = each.collect();
        format!(
            "coloured: it rises towards low frequencies, {}",
            each.join(", ")
        )
    }

    /// The filter of samples at these times, s.
    pub fn filter(self, times: &[f64]) -> Filter {
        Filter {
            words: self.words(),
            whitening: self.noise.map(|noise| noise.whitening(times)),
        }
    }
}

/// From the first sample to the last, s.
fn length(cuts: &[CutSamples]) -> f64 {
    let times = || cuts.iter().flat_map(|c| &c.time).copied();
    times().fold(f64::MIN, f64::max) - times().fold(f64::MAX, f64::min)
}

/// Frequency and power, in that of a typical line, of what is left of a cut off the harmonics of the spindle; by channel.
fn between(fit: &CutFit, spindle_hz: f64, step_s: f64) -> [Vec<[f64; 2]>; 3] {
    let count = fit.residual.len();
    let resolution = (count as f64 * step_s).recip();
    let is_between = |hz: f64| off_harmonic(hz, spindle_hz) > LOBE * resolution;
    // the lowest lines are those of what was taken out: a level and a slope
    let kept = |i: &usize| *i >= 2 && is_between(*i as f64 * resolution);
    let kept: Vec<usize> = (0..count / 2).filter(kept).collect();
    let left = levelled(fit, spindle_hz, step_s);
    [0, 1, 2].map(|k| {
        let Some(left) = &left else {
            return Vec::new();
        };
        let power = power(left.column(k).as_slice(), count);
        let own: Vec<f64> = kept.iter().map(|i| power[*i]).collect();
        let typical = median(&own).max(f64::MIN_POSITIVE);
        let each = kept.iter().zip(own);
        each.map(|(i, p)| [*i as f64 * resolution, p / typical])
            .collect()
    })
}

/// What is left of the channels, less a level, a slope and all waves over the turn of the spindle: what a law misses is far
/// larger than the noise, and would leak.
fn levelled(fit: &CutFit, spindle_hz: f64, step_s: f64) -> Option<DMatrix<f64>> {
    let count = fit.residual.len();
    let orders = ((HIGHEST / (step_s * spindle_hz)) as usize).min(WAVES);
    let column = |row: usize, at: usize| {
        let turn = TAU * spindle_hz * step_s * row as f64 * (at / 2) as f64;
        match at {
            0 => 1.0,
            1 => row as f64 / count as f64 - 0.5,
            _ if at.is_multiple_of(2) => turn.cos(),
            _ => turn.sin(),
        }
    };
    let columns = DMatrix::from_fn(count, 2 + 2 * orders, column);
    let left: Vec<_> = fit.left().collect();
    let left = DMatrix::from_fn(count, 3, |row, k| left[row][k]);
    let mut inner = gram(&columns);
    (0..inner.nrows()).for_each(|i| inner[(i, i)] *= 1.0 + 1e-9);
    let taken = inner.cholesky()?.solve(&tr_mul(&columns, &left));
    Some(left - columns * taken)
}

/// Power under a window without edges, of values with zeros behind them up to a length.
pub(super) fn power(values: &[f64], length: usize) -> Vec<f64> {
    let count = values.len() as f64;
    let window = |i: usize| 0.5 - 0.5 * (TAU * (i as f64 + 0.5) / count).cos();
    let each = values.iter().enumerate();
    let mut record: Vec<f64> = each.map(|(i, value)| window(i) * value).collect();
    record.resize(length, 0.0);
    let lines = Transform::new(length).of(record, length / 2);
    lines.iter().map(|line| line.norm_sqr()).collect()
}

/// Medians of lines (frequency, power) in bands, by frequency.
fn bands(mut lines: Vec<[f64; 2]>) -> Vec<Band> {
    lines.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let band = |lines: &[[f64; 2]]| {
        let powers: Vec<f64> = lines.iter().map(|l| l[1]).collect();
        let frequencies: Vec<f64> = lines.iter().map(|l| l[0]).collect();
        Band {
            hz: median(&frequencies),
            // of exponentially distributed numbers of mean one
            power: median(&powers) / LN_2,
            lines: WORTH * lines.len() as f64,
        }
    };
    pieces(&lines).into_iter().map(band).collect()
}

/// Pieces of ascending frequencies, none wider than the ratio of a band.
fn pieces(lines: &[[f64; 2]]) -> Vec<&[[f64; 2]]> {
    let (mut pieces, mut first) = (Vec::new(), 0);
    while first < lines.len() {
        let end = RATIO * lines[first][0];
        let next = lines.partition_point(|l| l[0] < end).max(first + 1);
        pieces.push(&lines[first..next]);
        first = next;
    }
    pieces
}

/// The filter that whitens the samples of all cuts, channel by channel.
#[derive(Debug, Clone)]
pub struct Filter {
    whitening: [Whitening; 3],
    words: String,
}

/// Coloured noise of rows that are samples by axes x, y, z.
pub struct Coloured {
    /// Standard deviation of every row, N.
    pub spread: Vec<f64>,
    /// See [`Noise::rows`].
    pub rows: f64,
    /// Its colour.
    pub filter: Arc<Filter>,
}

impl Noise for Coloured {
    fn whiten(&self, column: &[f64]) -> Vec<f64> {
        let mut white = vec![0.0; column.len()];
        for k in 0..3 {
            let own = column.iter().zip(&self.spread).skip(k).step_by(3);
            let own = self.filter.whitening[k].apply(own.map(|(c, s)| c / s));
            let places = white.iter_mut().skip(k).step_by(3);
            places.zip(own).for_each(|(w, o)| *w = o);
        }
        white
    }

    fn spread(&self) -> &[f64] {
        &self.spread
    }

    fn rows(&self) -> f64 {
        self.rows
    }

    fn describe(&self) -> String {
        self.filter.words.clone()
    }
}
