//! One blow of an impulse hammer on a simulated robot, in time.

use crate::ground::problem::Outcome;
use crate::ground::random::Random;
use crate::ground::spatial::V3;
use crate::motion::kinematics::{column, place, tcp};
use crate::motion::swing::{State, SwingWork, step};
use crate::motion::{Chain, Work};
use serde::Deserialize;

/// What records a hit: force and triaxial acceleration at the tool. Both channels pass the same
/// filter, a mean over one sampling interval, so it drops out of their ratio.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Instrument {
    /// Time between samples, s.
    pub interval_s: f64,
    /// Length of a record, s.
    pub length_s: f64,
    /// Time before the blow, s.
    pub pretrigger_s: f64,
    /// Steps of the simulation per sample.
    pub steps: usize,
    /// Rms of the accelerometer noise, m/s².
    #[serde(rename = "accelerometer_noise_m_s2")]
    pub accelerometer_noise: f64,
    /// Rms of the force noise, N.
    #[serde(rename = "force_noise_N")]
    pub force_noise: f64,
}

/// One blow.
#[derive(Debug, Clone, PartialEq)]
pub struct Blow {
    /// Axis of the base frame along which it strikes, 0..3.
    pub axis: usize,
    /// Its number.
    pub hit: usize,
    /// Peak force, N.
    pub peak: f64,
    /// Length of the pulse, a raised cosine, s.
    pub pulse_s: f64,
    /// Whether the hammer bounces: a second pulse.
    pub double: bool,
    /// Whether the force channel clips at 70 % of the peak.
    pub overloaded: bool,
    /// Seed of its noise.
    pub seed: u64,
}

/// Delay, s, and relative height of the second pulse of a double hit.
const SECOND: (f64, f64) = (0.045, 0.25);
/// Where an overloaded force channel clips, relative to the peak.
const CLIP: f64 = 0.7;

impl Blow {
    /// Force at time `t` after the blow, N.
    fn force(&self, t: f64) -> f64 {
        let pulse = |t: f64| {
            let inside = t > 0.0 && t < self.pulse_s;
            let wave = (std::f64::consts::PI * t / self.pulse_s).sin().powi(2);
            if inside { self.peak * wave } else { 0.0 }
        };
        let second = if self.double { SECOND.1 } else { 0.0 };
        pulse(t) + second * pulse(t - SECOND.0)
    }
}

/// Rows of time (s), force (N) and acceleration of the tool (m/s², base axes) after a blow on the
/// robot that rests under its weight.
///
/// # Errors
/// No equilibrium, or a step that is too large.
pub fn strike(
    chain: &Chain,
    joints: &[f64],
    instrument: &Instrument,
    blow: &Blow,
) -> Outcome<Vec<[f64; 5]>> {
    let mut random = Random::new(blow.seed);
    let (mut state, mut space) = (State::settled(chain, joints)?, SwingWork::new(chain));
    let mut work = Work::new(chain);
    let h = instrument.interval_s / instrument.steps as f64;
    let samples = (instrument.length_s / instrument.interval_s).round() as usize;
    let mut rows = Vec::with_capacity(samples);
    let mut before = speed(chain, &mut work, &state);
    for sample in 0..samples {
        let start = sample as f64 * instrument.interval_s;
        let mut sum = 0.0;
        for k in 0..instrument.steps {
            let middle = start + (k as f64 + 0.5) * h;
            let force = blow.force(middle - instrument.pretrigger_s);
            let mut pushed = [0.0; 3];
            pushed[blow.axis] = force;
            step(chain, &mut space, &mut state, h, pushed, joints)?;
            sum += force;
        }
        let after = speed(chain, &mut work, &state);
        let force = sum / instrument.steps as f64 + instrument.force_noise * random.normal();
        let most = if blow.overloaded {
            CLIP * blow.peak
        } else {
            f64::INFINITY
        };
        let noise = instrument.accelerometer_noise;
        let [x, y, z] = [0, 1, 2]
            .map(|a| (after[a] - before[a]) / instrument.interval_s + noise * random.normal());
        rows.push([start, force.min(most), x, y, z]);
        before = after;
    }
    Ok(rows)
}

/// Velocity of the tool, m/s, base axes.
fn speed(chain: &Chain, work: &mut Work, state: &State) -> V3 {
    place(chain, work, &state.angles());
    let at = tcp(chain, work).point;
    let mut sum = [0.0; 3];
    for (i, v) in state.v.iter().enumerate() {
        let part = column(work, i, at).0;
        (0..3).for_each(|a| sum[a] += part[a] * v);
    }
    sum
}
