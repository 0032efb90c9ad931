//! Cases: truth, physics, instrument and noise put together into a file.

use super::instrument::{Instrument, Wishes};
use super::noise::Colour;
use super::outside;
use super::physics::{self, Drawn, Sized};
use super::random::Random;
use super::schedule::Schedule;
use super::{Case, Truth};
use std::fmt::Write;

/// An effect asked for, with its strength in noise standard deviations.
pub type Wanted = (&'static str, f64);

/// Builds a case; what cannot be built with one draw is drawn again.
pub fn build(wanted: impl Fn(&mut Random) -> Vec<Wanted>, label: &str, seed: u64) -> Case {
    let mut random = Random::new(seed, label);
    for _ in 0..1000 {
        let wanted = wanted(&mut random);
        if let Some(plan) = Plan::draw(&wanted, &mut random) {
            return plan.carry_out(&wanted, seed, &mut random);
        }
    }
    panic!("no joint can show {label} at this strength");
}

/// Everything decided before the readings are taken.
struct Plan {
    schedule: Schedule,
    instrument: Instrument,
    effects: Vec<Sized>,
    /// Largest spring deflection read by laser 1, over the noise.
    range: f64,
    outliers: usize,
}

fn has(wanted: &[Wanted], names: &[&str]) -> Option<f64> {
    let found = wanted.iter().find(|(name, _)| names.contains(name));
    found.map(|(_, strength)| *strength)
}

/// The instrument on which the wanted effects can be told.
fn wishes(wanted: &[Wanted]) -> Wishes {
    let laser = has(wanted, &["lever_arm", "cosine_error"]);
    let stiffness = has(wanted, &["stiffness"]);
    Wishes {
        fewest_lasers: usize::from(laser.is_some()),
        two_lasers: if laser.is_some() { 0.75 } else { 0.45 },
        lever_rel_std: laser.map_or(0.005, |s| (s / 640.0).clamp(0.002, 0.005)),
        stiffness_rel_std: stiffness.map_or(0.05, |s| (s / 500.0).clamp(0.01, 0.05)),
    }
}

fn draw_effect(name: &str, schedule: &Schedule, random: &mut Random) -> Drawn {
    physics::draw(name, schedule, random)
        .or_else(|| outside::draw(name, schedule, random))
        .unwrap_or_else(|| panic!("no such effect: {name}"))
}

/// The range (deflection over noise) at which every effect has its strength and a believable size:
/// 100 to 2000 where possible.
fn draw_range(bounds: &[(f64, f64)], random: &mut Random) -> Option<f64> {
    let least = bounds.iter().fold(0.0, |m: f64, b| m.max(b.0));
    let most = bounds.iter().fold(2000.0, |m: f64, b| m.min(b.1));
    if least > most {
        return None;
    }
    let low = if most >= 100.0 { 100.0 } else { 0.7 * most };
    Some(random.log_uniform(least.max(low), most.max(least * 1.000_001)))
}

impl Plan {
    fn draw(wanted: &[Wanted], random: &mut Random) -> Option<Self> {
        let fancy = wanted
            .first()
            .and_then(|(name, _)| outside::schedule_for(name, random));
        let spoilt = random.chance(0.25);
        let rows = random.log_uniform(if spoilt { 340.0 } else { 200.0 }, 2000.0) as usize;
        let schedule = Schedule::draw(fancy, rows, random);
        let mut instrument = Instrument::draw(&wishes(wanted), random);
        let draw = |(name, _): &Wanted| draw_effect(name, &schedule, random);
        let drawn: Vec<Drawn> = wanted.iter().map(draw).collect();
        let (lever, stiffness) = (instrument.lever_rel_std, instrument.stiffness_rel_std);
        let bound = |(effect, (_, strength)): (&Drawn, &Wanted)| {
            let (least, most) = physics::sizes(effect, &schedule, lever, stiffness);
            (strength / most, strength / least)
        };
        let bounds: Vec<(f64, f64)> = drawn.iter().zip(wanted).map(bound).collect();
        let range = draw_range(&bounds, random)?;
        let effects = drawn.into_iter().zip(wanted);
        let effects: Vec<Sized> = effects
            .map(|(effect, (_, strength))| physics::size(effect, &schedule, strength / range))
            .collect();
        let factor = effects
            .iter()
            .find(|e| e.stiffness != 1.0)
            .map(|e| e.stiffness);
        instrument.choose_stiffness(range, factor, random);
        let gain: f64 = effects.iter().map(|e| e.gain).product();
        if gain != 1.0 {
            instrument.misplace_laser(gain);
        }
        let outliers = match spoilt {
            true => random.integer(1, rows * 3 / 1000),
            false => 0,
        };
        Some(Self {
            schedule,
            instrument,
            effects,
            range,
            outliers,
        })
    }

    /// Load as the load cell reports it, fine grid, over the largest load.
    fn reported(&self) -> &[f64] {
        let effect = self.effects.iter().find_map(|e| e.reported.as_deref());
        effect.unwrap_or(&self.schedule.load)
    }

    /// True angle per row over the spring's peak angle, all effects of the joint included.
    fn angle(&self) -> Vec<f64> {
        let mut fine = self.schedule.load.clone();
        for part in self.effects.iter().filter_map(|e| e.added.as_ref()) {
            fine.iter_mut().zip(part).for_each(|(a, b)| *a += b);
        }
        let delay: f64 = self.effects.iter().map(|e| e.delay).sum();
        match delay {
            0.0 => self.schedule.sampled(&fine),
            _ => self.schedule.sampled_late(&fine, delay),
        }
    }

    /// What laser 1 would show of the plain spring if nothing wanted were wrong, per row, rad.
    fn straight(&self) -> Vec<f64> {
        let wrong: f64 = self.effects.iter().map(|e| e.gain / e.stiffness).product();
        let peak = self.instrument.peak_angle() * self.instrument.gain(0) / wrong;
        let rows = self.schedule.sampled(self.reported());
        rows.into_iter().map(|u| peak * u).collect()
    }

    fn carry_out(self, wanted: &[Wanted], seed: u64, random: &mut Random) -> Case {
        let peak = self.instrument.peak_angle();
        let noise_rms = peak * self.instrument.gain(0) / self.range;
        let colour = Colour::draw(random);
        let lattice = self.effects.iter().position(|e| e.lattice);
        let step = lattice.map(|i| wanted[i].1 * noise_rms);
        let taken = self.take(colour, noise_rms, step, random);
        let truths = self.effects.iter().zip(wanted);
        let truths = truths.map(|(e, w)| truth(e, w, peak, step)).collect();
        Case {
            seed,
            truths,
            csv: self.file(&taken, noise_rms, random),
            schedule: self.schedule.name,
            noise: colour.name(),
            samples: self.schedule.rows(),
            lasers: self.instrument.lasers.len(),
            outliers: self.outliers,
            clean: taken.clean,
            straight: self.straight(),
            noise_rms,
            cycle: self.schedule.cycle,
        }
    }

    /// Takes the readings of every laser, as angles over the stated levers. Noise and lattice are the
    /// same length on each laser, so their angles shrink with the lever.
    fn take(&self, colour: Colour, noise: f64, step: Option<f64>, random: &mut Random) -> Taken {
        let peak = self.instrument.peak_angle();
        let angle = self.angle();
        let levers = |i: usize| self.instrument.lasers.get(i).map_or(1.0, |l| l.stated);
        let sensors = self.instrument.lasers.len().max(1);
        let wild = self.wild_readings(sensors, random);
        let mut clean = Vec::new();
        let mut readings = Vec::new();
        for index in 0..sensors {
            let scale = levers(0) / levers(index);
            let gain = self.instrument.gain(index) * peak;
            let bare: Vec<f64> = angle.iter().map(|a| gain * a).collect();
            let mut noisy = colour.realise(bare.len(), random);
            let mine = wild.iter().filter(|w| w.1 == index);
            mine.for_each(|w| noisy[w.0] += w.2);
            let noisy = noisy.iter().zip(&bare).map(|(n, b)| b + n * noise * scale);
            readings.push(on_lattice(noisy.collect(), step.map(|s| s * scale)));
            if index == 0 {
                clean = on_lattice(bare, step);
            }
        }
        Taken { clean, readings }
    }

    /// Outliers: row, laser and size in noise standard deviations, rows all different.
    fn wild_readings(&self, sensors: usize, random: &mut Random) -> Vec<(usize, usize, f64)> {
        let mut wild: Vec<(usize, usize, f64)> = Vec::new();
        while wild.len() < self.outliers {
            let row = random.integer(0, self.schedule.rows() - 1);
            if wild.iter().all(|w| w.0 != row) {
                let size = random.sign() * random.log_uniform(8.0, 60.0);
                wild.push((row, random.integer(0, sensors - 1), size));
            }
        }
        wild
    }

    /// The text of the file.
    fn file(&self, taken: &Taken, noise: f64, random: &mut Random) -> String {
        let lasers = &self.instrument.lasers;
        let lever = lasers.first().map_or(1.0, |l| l.stated);
        let sheet = noise * lever * random.log_uniform(0.5, 2.0);
        let mut text = self.instrument.front_matter(self.schedule.rest, sheet);
        text.push_str(match lasers.len() {
            0 => "time_s,moment_Nm,angle_rad\n",
            1 => "time_s,force_N,displacement_mm\n",
            _ => "time_s,force_N,displacement_mm,displacement2_mm\n",
        });
        let full = match lasers.is_empty() {
            true => self.instrument.stated_moment(),
            false => self.instrument.force,
        };
        let cell = random.uniform(0.0002, 0.001).min(0.1 / self.range) * full;
        let time = self.schedule.sampled(&self.schedule.time);
        let load = self.schedule.sampled(self.reported());
        let unit = |i: usize| lasers.get(i).map_or(1.0, |l| l.stated * 1e3);
        let digits = (4.0 - (noise * unit(0)).log10()).ceil().clamp(4.0, 16.0) as usize;
        for row in 0..time.len() {
            let force = full * load[row] + cell * random.normal();
            let _ = write!(text, "{:.6},{force:.5}", time[row]);
            for (i, reading) in taken.readings.iter().enumerate() {
                let _ = write!(text, ",{:.digits$}", reading[row] * unit(i));
            }
            text.push('\n');
        }
        text
    }
}

/// Readings as angles: laser 1 without noise, and each laser with everything.
struct Taken {
    clean: Vec<f64>,
    readings: Vec<Vec<f64>>,
}

/// Rounds to whole steps, as a coarse converter does (Widrow, 1956); + 0.0 turns -0 into 0.
fn on_lattice(mut angles: Vec<f64>, step: Option<f64>) -> Vec<f64> {
    if let Some(step) = step {
        angles
            .iter_mut()
            .for_each(|a| *a = (*a / step).round() * step + 0.0);
    }
    angles
}

fn truth(effect: &Sized, wanted: &Wanted, peak: f64, step: Option<f64>) -> Truth {
    let mut parameters = effect.parameters.clone();
    parameters.extend(effect.amplitude.map(|(name, share)| (name, share * peak)));
    if effect.lattice {
        parameters.extend(step.map(|s| ("step_rad", s)));
    }
    Truth {
        effect: wanted.0,
        strength: wanted.1,
        parameters,
    }
}
