//! Shared by the tests of hammer tests: a generator that knows nothing of the FRF code. It steps
//! the modal oscillators through time, filters against aliasing, samples, and spoils.
#![allow(dead_code)]

use ident::ground::random::Random;
use ident::measurement::hammer::{HammerRecord, HammerRun};
use rustfft::num_complex::Complex64;
use std::f64::consts::{PI, TAU};
use std::path::PathBuf;

/// Whether everything is asked, as `.ci/thorough` does; `cargo test` has five minutes.
pub fn is_thorough() -> bool {
    std::env::var_os("IDENT_THOROUGH").is_some()
}

/// How many: `few` where minutes count, `all` in a thorough run.
pub fn few_or_all(few: u64, all: u64) -> u64 {
    if is_thorough() { all } else { few }
}

/// The shared data, where they are; `None` says that they are absent.
pub fn shared(name: &str) -> Option<PathBuf> {
    let root = std::env::var_os("IDENT_SHARED_DATA").map(PathBuf::from);
    let beside = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let path = root.unwrap_or_else(beside).join(name);
    if !path.exists() {
        println!("passed over: {name} is not in the shared data");
        return None;
    }
    Some(path)
}

/// One mode: frequency, damping ratio, mass-normalised shape at the tool (1/√kg).
#[derive(Debug, Clone, Copy)]
pub struct Mode {
    pub hz: f64,
    pub damping: f64,
    pub shape: [f64; 3],
}

/// Modes of a soft milling robot below 50 Hz, and what lies above.
pub fn robot() -> Vec<Mode> {
    let mode = |hz, damping, shape| Mode { hz, damping, shape };
    vec![
        mode(8.2, 0.035, [0.02, 0.075, 0.01]),
        mode(10.9, 0.030, [0.06, -0.02, 0.04]),
        mode(17.5, 0.028, [-0.03, 0.03, 0.06]),
        mode(23.8, 0.025, [0.05, 0.03, -0.02]),
        mode(31.6, 0.022, [0.02, -0.06, 0.03]),
        mode(41.0, 0.020, [-0.05, 0.02, 0.05]),
        mode(78.0, 0.020, [0.06, 0.05, 0.04]),
        mode(131.0, 0.020, [-0.05, 0.06, 0.05]),
        mode(260.0, 0.015, [0.08, 0.08, 0.08]),
    ]
}

/// Accelerance of output `o` to input `i` at `s`, (m/s²)/N.
pub fn accelerance(modes: &[Mode], o: usize, i: usize, s: Complex64) -> Complex64 {
    let part = |m: &Mode| {
        let w = TAU * m.hz;
        m.shape[o] * m.shape[i] * s * s / (s * s + 2.0 * m.damping * w * s + w * w)
    };
    modes.iter().map(part).sum()
}

/// How one hit is made.
#[derive(Debug, Clone, Copy)]
pub struct Blow {
    pub rate_hz: f64,
    pub length_s: f64,
    pub pretrigger_s: f64,
    /// Duration of the half-sine, s.
    pub width_s: f64,
    pub peak_n: f64,
    /// Unit vector of the force.
    pub axis: [f64; 3],
    /// Delay, s, and share of a second pulse.
    pub second: Option<(f64, f64)>,
    pub force_noise_n: f64,
    pub noise_m_s2: f64,
    /// Force is cut off at this share of its peak.
    pub clip_force: Option<f64>,
    /// Response is cut off at this share of its extreme; both sides or only above.
    pub clip_response: Option<(f64, bool)>,
    /// Step of the digitiser as a share of the peak.
    pub quantum: f64,
    /// Rate of an exponential window, 1/s, put on both channels by the analyser.
    pub window_rate: f64,
}

impl Default for Blow {
    fn default() -> Self {
        Self {
            rate_hz: 2048.0,
            length_s: 4.0,
            pretrigger_s: 0.05,
            width_s: 5e-3,
            peak_n: 400.0,
            axis: [1.0, 0.0, 0.0],
            second: None,
            force_noise_n: 0.1,
            noise_m_s2: 0.003,
            clip_force: None,
            clip_response: None,
            quantum: 0.0,
            window_rate: 0.0,
        }
    }
}

impl Blow {
    fn force(&self, t: f64) -> f64 {
        let half_sine = |t: f64| {
            let inside = t > 0.0 && t < self.width_s;
            if inside {
                self.peak_n * (PI * t / self.width_s).sin()
            } else {
                0.0
            }
        };
        let first = half_sine(t - self.pretrigger_s);
        let second = self.second.map_or(0.0, |(delay, share)| {
            share * half_sine(t - self.pretrigger_s - delay)
        });
        first + second
    }

    /// Force and three accelerations as the analyser stores them.
    pub fn strike(&self, modes: &[Mode], random: &mut Random) -> (Vec<f64>, Vec<Vec<f64>>) {
        let over = (20.0 / (self.width_s * self.rate_hz)).ceil().max(4.0) as usize;
        let samples = (self.length_s * self.rate_hz).round() as usize;
        let margin = 8 * over;
        let step = 1.0 / (self.rate_hz * over as f64);
        let fine = samples * over + 2 * margin;
        let time = |i: usize| (i as f64 - margin as f64) * step;
        let force: Vec<f64> = (0..=fine).map(|i| self.force(time(i))).collect();
        let response = simulate(modes, &force, self.axis, step);
        let decimate = |record: &[f64]| decimated(record, over, samples);
        let mut force = decimate(&force);
        let mut response: Vec<Vec<f64>> = response.iter().map(|r| decimate(r)).collect();
        self.spoil(&mut force, &mut response, random);
        (force, response)
    }

    fn spoil(&self, force: &mut [f64], responses: &mut [Vec<f64>], random: &mut Random) {
        let extreme = |r: &[f64]| r.iter().fold(0.0, |a: f64, v| a.max(v.abs()));
        force
            .iter_mut()
            .for_each(|v| *v += self.force_noise_n * random.normal());
        if let Some(share) = self.clip_force {
            let top = share * extreme(force);
            force.iter_mut().for_each(|v| *v = v.clamp(-top, top));
        }
        for response in responses.iter_mut() {
            response
                .iter_mut()
                .for_each(|v| *v += self.noise_m_s2 * random.normal());
            if let Some((share, both)) = self.clip_response {
                let top = share * extreme(response);
                let low = if both { -top } else { f64::NEG_INFINITY };
                response.iter_mut().for_each(|v| *v = v.clamp(low, top));
            }
        }
        for record in std::iter::once(force).chain(responses.iter_mut().map(Vec::as_mut_slice)) {
            let step = self.quantum * extreme(record);
            for (i, v) in record.iter_mut().enumerate() {
                if step > 0.0 {
                    *v = (*v / step).round() * step;
                }
                *v *= (-self.window_rate * i as f64 / self.rate_hz).exp();
            }
        }
    }
}

/// Accelerations of the modal oscillators, each stepped exactly for a force linear in each step.
fn simulate(modes: &[Mode], force: &[f64], axis: [f64; 3], step: f64) -> Vec<Vec<f64>> {
    let mut response = vec![vec![0.0; force.len()]; 3];
    for mode in modes {
        let w = TAU * mode.hz;
        let pole = Complex64::new(-mode.damping * w, w * (1.0 - mode.damping.powi(2)).sqrt());
        let gain: f64 = (0..3).map(|a| axis[a] * mode.shape[a]).sum();
        // q = Im(z)/Im(p) with z' = p z + f.
        let e = (pole * step).exp();
        let a = (e - 1.0) / pole;
        let b = (a - step) / (pole * step);
        let mut z = Complex64::new(0.0, 0.0);
        for n in 1..force.len() {
            let (f0, f1) = (gain * force[n - 1], gain * force[n]);
            z = e * z + a * f0 + b * (f1 - f0);
            let acceleration = (pole * (pole * z + f1)).im / pole.im;
            for (o, record) in response.iter_mut().enumerate() {
                record[n] += mode.shape[o] * acceleration;
            }
        }
    }
    response
}

/// Low-pass (windowed sinc, cut-off 0.4 of the new rate) and every `over`-th sample.
fn decimated(record: &[f64], over: usize, samples: usize) -> Vec<f64> {
    let half = 8 * over as isize;
    let taps: Vec<f64> = (-half..=half)
        .map(|k| {
            let x = 0.8 * k as f64 / over as f64;
            let sinc = if k == 0 {
                1.0
            } else {
                (PI * x).sin() / (PI * x)
            };
            let hann = 0.5 * (1.0 + (PI * k as f64 / (half + 1) as f64).cos());
            sinc * hann
        })
        .collect();
    let sum: f64 = taps.iter().sum();
    (0..samples)
        .map(|n| {
            let part = &record[n * over..n * over + taps.len()];
            part.iter().zip(&taps).map(|(v, t)| v * t).sum::<f64>() / sum
        })
        .collect()
}

/// A record of kind `hammer` from (direction, blow) pairs, each one hit.
pub fn record(modes: &[Mode], blows: &[(&str, Blow)], seed: u64) -> HammerRecord {
    let mut random = Random::new(seed);
    let runs = blows.iter().enumerate().map(|(i, (direction, blow))| {
        let (force, responses) = blow.strike(modes, &mut random);
        HammerRun {
            direction: (*direction).into(),
            hit: Some((i + 1).to_string()),
            force,
            responses,
        }
    });
    HammerRecord {
        interval_s: 1.0 / blows[0].1.rate_hz,
        outputs: ["x", "y", "z"].map(String::from).to_vec(),
        runs: runs.collect(),
        ..HammerRecord::default()
    }
}

/// The axis of a direction name.
pub fn axis(direction: &str) -> [f64; 3] {
    ["x", "y", "z"].map(|name| f64::from(name == direction))
}

/// The record as a file of kind `hammer`.
pub fn csv(record: &HammerRecord) -> String {
    let mut text =
        String::from("# kind = \"hammer\"\ndirection,hit,time_s,force_N,ax_m_s2,ay_m_s2,az_m_s2\n");
    for run in &record.runs {
        let hit = run.hit.as_deref().unwrap_or("");
        for (i, force) in run.force.iter().enumerate() {
            let [x, y, z] = [0, 1, 2].map(|o| run.responses[o][i]);
            let time = i as f64 * record.interval_s;
            text += &format!(
                "{},{hit},{time:.8},{force:.9e},{x:.9e},{y:.9e},{z:.9e}\n",
                run.direction
            );
        }
    }
    text
}
