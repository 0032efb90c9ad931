//! Hammer tests: the exponential window through which their records are seen.

use super::hammer_force::ForceWindow;
use super::hammer_frf::Settings;
use super::hammer_screen::ScreenedHit;
use crate::ground::stats::{mean, median};
use crate::signal::pulse::{self, Pulse};
use crate::signal::window::{Exponential, Force};

/// What a window leaves at the end of a record of its noise, and of the response. Of a mode of 7 Hz damped by 0.8 % in a record of two
/// seconds, cut off at 4e-4, 0.04 % of the root mean square of its FRF stand beside the mode, a fifth of what a diagnosis puts up
/// with there (`findings/hammer/data`); cut off at 5e-3, which a hundredth leaves, 0.4 %.
const LEFT: [f64; 2] = [0.01, 4e-4];

/// The window asked for, of records of `length_s` that hold one of `recorded` (1/s) already.
pub fn window(
    settings: &Settings,
    hits: &[&ScreenedHit],
    length_s: f64,
    recorded: f64,
) -> Exponential {
    let falls = |left: f64| Exponential::with_end(left, length_s).rate;
    let rate = match (settings.least_rate, settings.exponential_end) {
        (Some(least), _) => {
            let ring = hits.iter().map(|hit| hit.ring).fold(0.0, f64::max);
            let ring = falls((LEFT[1] / ring.max(LEFT[1])).min(1.0));
            let noise = falls(LEFT[0]).max(least) - recorded;
            noise.max(ring).max(0.0)
        }
        (None, end) => end.map_or(0.0, falls),
    };
    Exponential { rate }
}

/// Offset removed (pre-trigger mean), force window, exponential window on both channels. An offset went through the window that was
/// recorded, as everything did.
pub fn treated(
    hit: &ScreenedHit,
    (samples, interval_s): (usize, f64),
    [recorded, window]: [Exponential; 2],
    force_window: ForceWindow,
) -> (Vec<f64>, Vec<Vec<f64>>) {
    let found = Pulse::find(&hit.force);
    let start = found.map_or(0, |pulse| pulse.start);
    let longest = hit.responses.iter().map(Vec::len).max();
    let mut faded = vec![1.0; hit.force.len().max(longest.unwrap_or(0))];
    recorded.apply(&mut faded, interval_s);
    let clean = |record: &[f64], offset: f64, otherwise: fn(&[f64]) -> f64| {
        let share = offset / pulse::baseline(&faded, start, otherwise(&faded[..record.len()]));
        let each = record[..samples].iter().zip(&faded);
        let mut record: Vec<f64> = each.map(|(v, left)| v - share * left).collect();
        window.apply(&mut record, interval_s);
        record
    };
    let baseline = found.map_or(0.0, |pulse| pulse.baseline);
    let mut force = clean(&hit.force, baseline, median);
    if let Some(pulse) = found.filter(|p| force_window.suits(&hit.force, p)) {
        Force::around(&pulse).apply(&mut force);
    }
    let responses = hit.responses.iter();
    let responses = responses.map(|r| clean(r, pulse::baseline(r, start, mean(r)), mean));
    (force, responses.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hit(ring: f64) -> ScreenedHit {
        ScreenedHit {
            direction: "x".into(),
            hit: "1".into(),
            force: Vec::new(),
            responses: Vec::new(),
            faults: Vec::new(),
            ring,
        }
    }

    fn rate(least: f64, ring: f64, length_s: f64, recorded: f64) -> f64 {
        let settings = Settings {
            least_rate: Some(least),
            exponential_end: Some(0.5),
            ..Settings::default()
        };
        window(&settings, &[&hit(0.0), &hit(ring)], length_s, recorded).rate
    }

    #[test]
    fn a_window_leaves_nothing_of_noise_and_of_a_decay() {
        // to a hundredth over two seconds, but no slower than asked for
        assert!((rate(0.5, 0.0, 2.0, 0.0) - 0.5 * 100f64.ln()).abs() < 1e-12);
        assert_eq!(rate(7.0, 0.0, 2.0, 0.0), 7.0);
        // a fifth of the response left after two seconds: to a five-hundredth of that
        assert!((rate(0.5, 0.2, 2.0, 0.0) - 0.5 * 500f64.ln()).abs() < 1e-12);
        // what was in the records counts, and the decay was seen through it
        assert_eq!(rate(1.5, 0.0, 6.0, 1.0), 0.5);
        assert_eq!(rate(1.5, 0.0, 6.0, 2.0), 0.0);
        assert!((rate(1.5, 0.2, 2.0, 9.0) - 0.5 * 500f64.ln()).abs() < 1e-12);
    }

    #[test]
    fn a_window_that_is_asked_for_is_that_one() {
        let settings = Settings {
            exponential_end: Some(0.5),
            ..Settings::default()
        };
        let asked = window(&settings, &[&hit(0.2)], 2.0, 1.0).rate;
        assert!((asked - 0.5 * 2f64.ln()).abs() < 1e-12);
        assert_eq!(
            window(&Settings::default(), &[&hit(0.2)], 2.0, 1.0).rate,
            0.0
        );
    }

    /// A channel's zero goes through a window that was recorded: it is not there at the end of the record.
    #[test]
    fn an_offset_fades_with_the_recorded_window() {
        let recorded = Exponential { rate: 3.0 };
        let hit = |offset: f64| {
            let through = |own: fn(f64) -> f64, offset: f64| {
                let mut record: Vec<f64> = (0..1000).map(|i| own(f64::from(i)) + offset).collect();
                recorded.apply(&mut record, 1e-3);
                record
            };
            let pulse = |i: f64| (100.0 - (i - 205.0).powi(2)).max(0.0);
            let ring = |i: f64| if i > 200.0 { (0.2 * i).sin() } else { 0.0 };
            ScreenedHit {
                direction: "x".into(),
                hit: "1".into(),
                force: through(pulse, 4.0 * offset),
                responses: vec![through(ring, offset)],
                faults: Vec::new(),
                ring: 0.0,
            }
        };
        let windows = [recorded, Exponential { rate: 0.0 }];
        let seen = |offset: f64| treated(&hit(offset), (1000, 1e-3), windows, ForceWindow::Never);
        let (with, without) = (seen(0.5), seen(0.0));
        let apart = |a: &[f64], b: &[f64]| {
            let each = a.iter().zip(b).map(|(a, b)| (a - b).abs());
            each.fold(0.0, f64::max)
        };
        assert!(apart(&with.1[0], &without.1[0]) < 1e-9);
        assert!(apart(&with.0, &without.0) < 1e-9);
    }
}
