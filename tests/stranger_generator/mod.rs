//! Load cycles as a stranger would record them: other laws, other noise, other schedules.
//!
//! Written from the literature of each mechanism before the diagnosis that it judges, and without the
//! formulas of `src/effects` or of `tests/blind_generator`: Ramberg and Osgood, Preisach, Dahl, LuGre,
//! Hertz, the standard linear solid, logarithmic and power-law creep, low-pass sensors; dead weights,
//! one-sided and single cycles; noise that grows with the load, bursts, a mains line, a coarse load cell;
//! files with decimal commas. Everything is a deterministic function of the seed.
#![allow(dead_code)]

mod laws;
mod noise;
mod schedule;

use ident::ground::random::Random;
use schedule::Schedule;
use std::fmt::Write;

/// A file and what is true about it.
pub struct Case {
    /// Seed that it came from.
    pub seed: u64,
    /// What is hidden; empty: nothing. Names starting with `outside:` are in no library.
    pub truths: Vec<&'static str>,
    /// The law of every truth, by its usual name.
    pub laws: Vec<&'static str>,
    /// Peak of each truth that no straight line takes over, over the noise.
    pub strengths: Vec<f64>,
    /// The file.
    pub csv: String,
    /// Schedule.
    pub schedule: &'static str,
    /// Noise.
    pub noise: &'static str,
    /// Rows.
    pub rows: usize,
}

/// What the cases of a suite are, by share: single 50 %, pair 12 %, clean 25 %, outside 13 %.
pub fn draw(seed: u64) -> Case {
    let mut random = Random::new(seed.wrapping_mul(0x9e37_79b9) ^ 0x5712_a4c3);
    let kind = random.unit();
    loop {
        let wanted: Vec<&'static str> = match kind {
            x if x < 0.50 => vec![one(&mut random, laws::MECHANISMS)],
            x if x < 0.62 => pair(&mut random),
            x if x < 0.87 => Vec::new(),
            _ => vec![one(&mut random, laws::OUTSIDE)],
        };
        if let Some(case) = build(seed, &wanted, &mut random) {
            return case;
        }
    }
}

fn one<T: Copy>(random: &mut Random, of: &[T]) -> T {
    of[random.below(of.len())]
}

/// Two mechanisms that are not of one kind.
fn pair(random: &mut Random) -> Vec<&'static str> {
    loop {
        let (a, b) = (one(random, laws::MECHANISMS), one(random, laws::MECHANISMS));
        if laws::kin(a) != laws::kin(b) && a != "quantization" && b != "quantization" {
            return vec![a, b];
        }
    }
}

/// A case, if this schedule and these laws can show the wanted effects.
fn build(seed: u64, wanted: &[&'static str], random: &mut Random) -> Option<Case> {
    let schedule = Schedule::draw(random);
    if !wanted.iter().all(|w| schedule.shows(w)) {
        return None;
    }
    // elastic deflection at the largest load in noise deviations
    let range = random.log_uniform(60.0, 1500.0);
    let mut angle: Vec<f64> = schedule.load.clone();
    let (mut strengths, mut names) = (Vec::new(), Vec::new());
    let mut step = None;
    for effect in wanted {
        let strength = random.log_uniform(4.0, 30.0);
        strengths.push(strength);
        if *effect == "quantization" {
            step = Some(strength.min(10.0) / range);
            names.push("lattice");
            continue;
        }
        let (law, shape) = laws::draw(effect, &schedule, random);
        let peak = beyond_line(&schedule, &shape);
        let amount = strength / range / peak;
        let largest = shape.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if !(peak > 0.02 * largest && amount * largest < 0.6) {
            return None;
        }
        angle
            .iter_mut()
            .zip(&shape)
            .for_each(|(a, s)| *a += amount * s);
        names.push(law);
    }
    let (noise, mut added) = noise::draw(&schedule, random);
    added.iter_mut().for_each(|n| *n /= range);
    let mut rows = schedule.sampled(&angle);
    rows.iter_mut().zip(&added).for_each(|(r, n)| *r += n);
    if let Some(step) = step {
        rows.iter_mut()
            .for_each(|r| *r = (*r / step).round() * step + 0.0);
    }
    Some(Case {
        seed,
        truths: wanted.to_vec(),
        laws: names,
        strengths,
        csv: file(&schedule, &rows, (range, secant(&schedule, &angle)), random),
        schedule: schedule.name,
        noise,
        rows: rows.len(),
    })
}

/// Slope of the straight line through all readings, deflection over load: what a maker's value rests on.
fn secant(schedule: &Schedule, angle: &[f64]) -> f64 {
    let (u, y) = (schedule.sampled(&schedule.load), schedule.sampled(angle));
    u.iter().zip(&y).map(|(u, y)| u * y).sum::<f64>() / u.iter().map(|u| u * u).sum::<f64>()
}

/// Peak of what the best straight line through the origin leaves of a shape at the rows.
fn beyond_line(schedule: &Schedule, shape: &[f64]) -> f64 {
    let (u, y) = (schedule.sampled(&schedule.load), schedule.sampled(shape));
    let slope =
        u.iter().zip(&y).map(|(u, y)| u * y).sum::<f64>() / u.iter().map(|u| u * u).sum::<f64>();
    let left: Vec<f64> = u
        .iter()
        .zip(&y)
        .map(|(u, y)| (y - slope * u).abs())
        .collect();
    let mut sorted = left;
    sorted.sort_by(f64::total_cmp);
    sorted[(0.98 * (sorted.len() - 1) as f64) as usize]
}

/// The text of the file, in English or in German habits.
fn file(
    schedule: &Schedule,
    rows: &[f64],
    (range, secant): (f64, f64),
    random: &mut Random,
) -> String {
    let (moment, stiffness) = (
        random.log_uniform(200.0, 2000.0),
        random.log_uniform(2e5, 5e6),
    );
    let spread = random.uniform(0.02, 0.06);
    let nominal = stiffness / secant * (1.0 + 0.5 * spread * random.normal().clamp(-2.0, 2.0));
    let joint = 1 + random.below(6);
    let mut text = String::from("# kind = \"load-cycle\"\n# robot = \"kr210\"\n");
    let _ = writeln!(text, "# joint = {joint}\n# axis = \"rotation\"");
    let _ = writeln!(text, "# nominal_stiffness_Nm_rad = {nominal:.1}");
    let _ = writeln!(text, "# nominal_stiffness_rel_std = {spread:.4}");
    let german = random.unit() < 0.3;
    let separator = if german { ';' } else { ',' };
    let _ = writeln!(text, "time_s{separator}moment_Nm{separator}angle_rad");
    let cell = (random.uniform(0.05, 0.3) / range).min(0.001);
    let coarse = (random.unit() < 0.15).then(|| random.uniform(0.3, 1.0) / range);
    let (time, load) = (
        schedule.sampled(&schedule.time),
        schedule.sampled(&schedule.load),
    );
    let angle = moment / stiffness;
    for i in 0..rows.len() {
        let mut u = load[i] + cell * random.normal();
        if let Some(step) = coarse {
            u = (u / step).round() * step + 0.0;
        }
        let line = format!(
            "{:.5}{separator}{:.5}{separator}{:.6e}\n",
            time[i],
            u * moment,
            rows[i] * angle
        );
        text.push_str(&match german {
            true => line.replace('.', ","),
            false => line,
        });
    }
    text
}
