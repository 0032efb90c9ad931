//! Lines of the spectrum between the harmonics of the spindle, in what a fit of the whole cut leaves.

use super::case::CutSamples;
use super::noise::{self, Colour};
use crate::fit::cut_force::{Account, CutFit};
use crate::ground::stats::median;
use crate::signal::mains::off_mains;
use std::f64::consts::TAU;

/// A line of one cut.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// The cut.
    pub cut: usize,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Power over the typical one of the spectrum.
    pub height: f64,
    /// Whether it stands out of its neighbours as well: what comes and goes is broad.
    pub is_sharp: bool,
}

/// Height (over the median of the spectrum) from which a line is no noise: one in 10^9 frequencies.
const HIGH: f64 = 18.0;
/// Lines of a cut that are tried.
const MOST: usize = 2;
/// Resolutions within which a line belongs to a harmonic of the spindle: its place is told to a tenth of one.
const NEAR: f64 = 0.6;
/// Share of the rate of sampling from which a line may be a harmonic folded at half of it: farther beyond, none is high.
const FOLDED: f64 = 0.375;
/// Height over the number of readings of a line whose amplitude is the deviation of the noise, on both axes, by the window that the
/// spectrum is taken through: half the square over 1.68, the median of white noise on two axes, and two thirds of that.
const HEARD: f64 = 0.2;
/// Share of its frequency by which the mains may be off: 0.05 Hz of 50, as in most hours. A choice; no other value was tried.
const MAINS_SHARE: f64 = 1e-3;
/// Half the distance between the mains of either kind, Hz: a record that does not tell them apart tells no hum.
const BETWEEN_HZ: f64 = 5.0;
/// Periods within a cut from which an oscillation is told from a spell, as a harder place makes one: a choice; no other number was tried.
const PERIODS: f64 = 3.0;
/// Resolutions on either side within which neighbours of a line lie, from where it is itself no more. A choice; no other numbers were
/// tried.
const BESIDE: [usize; 2] = [3, 16];
/// Times by which the record is lengthened with zeros.
const FINER: usize = 4;

/// The lines of all cuts, by cut, the highest first; `colour`: that of the noise they stand out of, none where it is white.
pub fn lines(account: &Account, cuts: &[CutSamples], colour: Option<&Colour>) -> Vec<Line> {
    let each = account.cuts.iter().zip(cuts).enumerate();
    each.flat_map(|(i, (fit, cut))| of_cut(i, fit, cut, colour))
        .collect()
}

fn of_cut(number: usize, fit: &CutFit, cut: &CutSamples, colour: Option<&Colour>) -> Vec<Line> {
    let time = &fit.data.scene.time;
    let length = time.last().copied().unwrap_or(0.0);
    if length <= 0.0 {
        return Vec::new();
    }
    let spindle_hz = cut.present.scene.cut.spindle_rad_s / TAU;
    let (power, step_hz) = power(fit, length, colour);
    let is_off = |hz: f64| off_harmonic(hz, spindle_hz) > NEAR / length;
    // a harmonic beyond half the rate of sampling is folded back
    let rate = step_hz * (2 * power.len()) as f64;
    let between = |hz: f64| is_off(hz) && (hz < FOLDED * rate || is_off(rate - hz));
    let typical = median(&power).max(f64::MIN_POSITIVE);
    let record = (fit.residual.len() as f64, length);
    let mut found: Vec<Line> = (FINER..power.len().saturating_sub(1))
        .filter(|i| power[*i] >= power[i - 1] && power[*i] > power[i + 1])
        .map(|i| Line {
            cut: number,
            frequency_hz: peak(&power, i) * step_hz,
            height: power[i] / typical,
            is_sharp: power[i] > HIGH * beside(&power, i),
        })
        .filter(|line| line.height > HIGH && between(line.frequency_hz))
        .filter(|line| line.frequency_hz * length >= PERIODS && !is_hum(line, record))
        .collect();
    found.sort_by(|a, b| b.height.total_cmp(&a.height));
    found.truncate(MOST);
    found
}

/// Whether a line comes by the mains and is weaker than the noise, of a record of so many readings and seconds: noise of the amplifier.
fn is_hum(line: &Line, (readings, length): (f64, f64)) -> bool {
    let hz = line.frequency_hz;
    let near = (NEAR / length).max(MAINS_SHARE * hz);
    line.height < HEARD * readings && near < BETWEEN_HZ && off_mains(hz) < near
}

/// Typical power on either side of a place.
fn beside(power: &[f64], i: usize) -> f64 {
    let [near, far] = BESIDE.map(|n| n * FINER);
    let is_near = |j: &usize| j.abs_diff(i) >= near;
    let all = i.saturating_sub(far)..(i + far + 1).min(power.len());
    let own: Vec<f64> = all.filter(is_near).map(|j| power[j]).collect();
    median(&own)
}

/// Distance of a frequency from the nearest harmonic of another, Hz.
pub(super) fn off_harmonic(hz: f64, of_hz: f64) -> f64 {
    (hz - (hz / of_hz).round() * of_hz).abs()
}

fn peak(power: &[f64], i: usize) -> f64 {
    let [a, b, c] = [power[i - 1], power[i], power[i + 1]];
    let bend = a - 2.0 * b + c;
    match bend < 0.0 {
        true => i as f64 + 0.5 * (a - c) / bend,
        false => i as f64,
    }
}

/// Power of x and y together over that of their noise, and the step of its frequencies, Hz.
fn power(fit: &CutFit, length: f64, colour: Option<&Colour>) -> (Vec<f64>, f64) {
    let count = fit.residual.len();
    let padded = (FINER * count).next_power_of_two();
    let rate = (count.max(2) - 1) as f64 / length;
    let step_hz = rate / padded as f64;
    let mut power = vec![0.0; padded / 2];
    for k in 0..2 {
        let noise = |i: usize| {
            colour.map_or(1.0, |colour| {
                colour.power(k, i as f64 * step_hz, rate.recip())
            })
        };
        let own: Vec<f64> = fit.left().map(|left| left[k]).collect();
        let own = noise::power(&own, padded);
        let each = power.iter_mut().zip(own).enumerate();
        each.for_each(|(i, (all, own))| *all += own / noise(i));
    }
    (power, step_hz)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spectrum with one place that stands out, as wide as a line, or as what rings and is struck again and again.
    fn spectrum(wide: f64) -> Vec<f64> {
        let one = |i: usize| {
            let away = (i as f64 - 400.0) / (FINER as f64 * wide);
            1.0 + 200.0 / (1.0 + away.powi(6))
        };
        (0..1000).map(one).collect()
    }

    #[test]
    fn what_is_broad_stands_out_of_the_spectrum_but_not_of_its_neighbours() {
        let is_sharp = |power: &[f64]| power[400] > HIGH * beside(power, 400);
        assert!(is_sharp(&spectrum(0.7)));
        let broad = spectrum(12.0);
        assert!(broad[400] > HIGH * median(&broad) && !is_sharp(&broad));
    }

    #[test]
    fn neighbours_end_where_the_spectrum_does() {
        assert_eq!(beside(&[1.0; 30], 0), 1.0);
        assert_eq!(beside(&[1.0; 30], 29), 1.0);
    }

    #[test]
    fn a_weak_line_of_the_mains_is_a_hum_where_the_record_tells_which() {
        let line = |frequency_hz, height| Line {
            cut: 0,
            frequency_hz,
            height,
            is_sharp: true,
        };
        let record = (1000.0, 0.2);
        assert!(is_hum(&line(151.0, 150.0), record));
        // strong, beside the mains, and too short to tell
        assert!(!is_hum(&line(151.0, 250.0), record));
        assert!(!is_hum(&line(165.0, 150.0), record));
        assert!(!is_hum(&line(151.0, 150.0), (1000.0, 0.1)));
    }
}
