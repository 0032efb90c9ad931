//! Judges hits: each alone, then within its family of hits in one direction.

use super::clipping::{clipped, pulse_clipped};
use super::double_hit::second_pulse;
use super::fault::Fault;
use super::outliers::median;
use super::pulse::Pulse;
use super::spectrum::{Transform, lines_up_to};

/// Force spectrum at the upper end of the band against the lower end, dB, that is still enough
/// (ISO 7626-5 limits the band where the force spectrum has fallen by about as much).
const ENOUGH_DB: f64 = -20.0;
/// Factor from the median peak beyond which a hit is out of family.
const LEVEL: f64 = 3.0;
/// Share of the median length below which a record is out of family.
const LENGTH: f64 = 0.8;

/// Force beyond that of the heaviest sledge hammers, N: a broken digit, or a wrong unit.
pub const FORCE_N: f64 = 3e5;
/// Acceleration beyond that of shock accelerometers (10 000 g), m/s².
const ACCELERATION: f64 = 1e5;

/// A window is taken out of a force over so many samples on either side of its peak, for it would blow up the noise at the end of a
/// record; beyond them a plateau falls so slowly that it stays one. What is left then of the digits of a file, as a share of the peak: a
/// hundredth of a newton in a hit of a hundred, and far from the two hundredths that a smooth peak may be rounded to (`clipping`).
const NEAR: f64 = 64.0;
const DIGIT: f64 = 1e-4;

/// One hit as recorded.
#[derive(Debug, Clone, Copy)]
pub struct Hit<'a> {
    /// Force, N.
    pub force: &'a [f64],
    /// Acceleration per output, m/s².
    pub responses: &'a [Vec<f64>],
    /// Time between samples, s.
    pub interval_s: f64,
    /// Rate of the exponential window that was in the record, 1/s.
    pub window_rate: f64,
}

/// The faults of a hit seen alone, for use up to `to_hz`.
pub fn faults(hit: &Hit, to_hz: f64) -> Vec<Fault> {
    let Some(pulse) = Pulse::find(hit.force) else {
        return vec![Fault::NoPulse];
    };
    let checks = [
        cut_pulse(hit, &pulse),
        double(hit, &pulse),
        force_overload(hit, &pulse),
        low_energy(hit, &pulse, to_hz),
        beyond(hit),
    ];
    let overloads = response_overloads(hit.responses);
    checks.into_iter().flatten().chain(overloads).collect()
}

fn cut_pulse(hit: &Hit, pulse: &Pulse) -> Option<Fault> {
    (pulse.above(hit.force, 0) > 0.2 * pulse.peak.abs()).then_some(Fault::CutPulse)
}

fn double(hit: &Hit, pulse: &Pulse) -> Option<Fault> {
    second_pulse(hit.force, pulse).map(|second| Fault::DoubleHit {
        after_s: second.after as f64 * hit.interval_s,
        share: second.share,
    })
}

fn force_overload(hit: &Hit, pulse: &Pulse) -> Option<Fault> {
    let towards = (0..hit.force.len()).map(|i| pulse.above(hit.force, i));
    let mut towards: Vec<f64> = towards.collect();
    if hit.window_rate > 0.0 {
        unwound(&mut towards, pulse.at, hit.window_rate * hit.interval_s);
    }
    pulse_clipped(&towards).then_some(Fault::ForceOverload {
        at: hit.force[pulse.at],
    })
}

/// Takes a window that falls by `rate` per sample out of a pulse and of what is near: what it was cut off at is level again, but for the
/// digits that were written, and so is taken at [`DIGIT`].
fn unwound(record: &mut [f64], at: usize, rate: f64) {
    for (i, value) in record.iter_mut().enumerate() {
        let after = i as f64 - at as f64;
        *value *= (rate * after.clamp(-NEAR, NEAR)).exp();
    }
    let highest = record.iter().copied().fold(f64::MIN, f64::max);
    let digit = DIGIT * highest;
    for value in record {
        *value = highest - ((highest - *value) / digit).round() * digit;
    }
}

fn response_overloads(responses: &[Vec<f64>]) -> impl Iterator<Item = Fault> {
    let records = responses.iter().enumerate();
    records
        .filter(|(_, record)| clipped(record))
        .map(|(output, _)| Fault::ResponseOverload { output })
}

/// The first sample that nothing can have measured.
fn beyond(hit: &Hit) -> Option<Fault> {
    let far = |values: &[f64], most: f64| values.iter().copied().find(|v| v.abs() > most);
    let fault = |output, value| Fault::Beyond { output, value };
    let force = far(hit.force, FORCE_N).map(|value| fault(None, value));
    let mut responses = hit.responses.iter().enumerate();
    force.or_else(|| responses.find_map(|(o, r)| Some(fault(Some(o), far(r, ACCELERATION)?))))
}

/// Compares the force spectrum in the upper fifth of the band with its lower fifth and with noise.
fn low_energy(hit: &Hit, pulse: &Pulse, to_hz: f64) -> Option<Fault> {
    let n = hit.force.len();
    let last = lines_up_to(n, hit.interval_s, Some(to_hz)) - 1;
    if last < 10 {
        return None;
    }
    let pulse_only: Vec<f64> = hit.force.iter().map(|v| v - pulse.baseline).collect();
    let lines = Transform::new(n).of(pulse_only, last + 1);
    let power = |from: usize, to: usize| {
        let sum: f64 = lines[from..=to].iter().map(|f| f.norm_sqr()).sum();
        sum / (to + 1 - from) as f64
    };
    let from_hz = 0.8 * to_hz;
    let upper = power(last - last / 5, last);
    let level_db = 10.0 * (upper / power(1, last / 5)).log10();
    if level_db < ENOUGH_DB {
        return Some(Fault::LowEnergy { level_db, from_hz });
    }
    let noise = n as f64 * pulse.noise.powi(2);
    (upper < 4.0 * noise).then_some(Fault::BuriedForce { from_hz })
}

/// The faults that show only beside the other hits in the same direction: one list per hit.
pub fn family_faults(hits: &[Hit]) -> Vec<Vec<Fault>> {
    let lengths: Vec<f64> = hits.iter().map(|h| h.force.len() as f64).collect();
    let peaks: Vec<f64> = hits.iter().map(peak).collect();
    let (length, peak) = (median(&lengths), median(&peaks));
    (0..hits.len())
        .map(|i| {
            let short = (lengths[i] < LENGTH * length).then(|| Fault::ShortRecord {
                length_s: lengths[i] * hits[i].interval_s,
                others_s: length * hits[i].interval_s,
            });
            let ratio = peaks[i] / peak;
            let strange = hits.len() > 2 && !(1.0 / LEVEL..=LEVEL).contains(&ratio);
            let level = strange.then_some(Fault::Level { ratio });
            short.into_iter().chain(level).collect()
        })
        .collect()
}

fn peak(hit: &Hit) -> f64 {
    Pulse::find(hit.force).map_or(0.0, |pulse| pulse.peak.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hit cut off at a share of its peak, seen through a window of `rate` and written with so many digits.
    fn overloaded(cut_at: f64, rate: f64, digit: f64) -> bool {
        let interval_s = 1e-3;
        let force = |i: usize| {
            let phase = (i as f64 - 30.3) / 8.0;
            let pulse = match (0.0..=1.0).contains(&phase) {
                true => (std::f64::consts::PI * phase).sin(),
                false => 0.0,
            };
            let cut = 250.0 * pulse.min(cut_at);
            let seen = cut * (-rate * i as f64 * interval_s).exp();
            (seen / digit).round() * digit
        };
        let force: Vec<f64> = (0..2000).map(force).collect();
        let hit = Hit {
            force: &force,
            responses: &[],
            interval_s,
            window_rate: rate,
        };
        let all = faults(&hit, 50.0);
        all.iter().any(|f| matches!(f, Fault::ForceOverload { .. }))
    }

    #[test]
    fn an_overload_is_seen_through_a_declared_window() {
        for rate in [0.0, 0.5, 1.5, 5.0] {
            for digit in [1e-6, 0.01] {
                assert!(overloaded(0.8, rate, digit), "{rate} {digit}");
                assert!(!overloaded(1.1, rate, digit), "{rate} {digit}");
            }
        }
    }
}
