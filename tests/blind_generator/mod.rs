//! Blind load-cycle files with a known truth, for judging the diagnosis.
//!
//! Written independently of `src/effects`: other formulas for the same physics, other integration,
//! coloured noise, hand-pumped loads, outliers. Everything is a deterministic function of the seed.
//!
//! Offset, drift, skew, lattice and unknown effects act on both lasers alike; `lever_arm` and
//! `cosine_error` on laser 1 only. Sensors are set to zero before the first row in every case without
//! `sensor_offset`, and every hysteretic joint starts from its virgin state.
#![allow(dead_code)]

mod case;
mod instrument;
mod line;
mod noise;
mod outside;
mod physics;
pub mod random;
mod schedule;

use case::{Wanted, build};
use random::Random;

pub use outside::OUTSIDE;

/// An effect that is really in the data.
pub struct Truth {
    pub effect: &'static str,
    /// Peak of the part that the best straight line cannot absorb, over the noise; for `lever_arm`,
    /// `cosine_error` and `stiffness` the peak change of deflection, for `quantization` the step.
    pub strength: f64,
    pub parameters: Vec<(&'static str, f64)>,
}

/// A file and everything that is true about it.
pub struct Case {
    pub seed: u64,
    /// Empty: clean. Effects outside the library carry names starting with `outside:`.
    pub truths: Vec<Truth>,
    pub csv: String,
    pub schedule: &'static str,
    pub noise: &'static str,
    pub samples: usize,
    pub lasers: usize,
    pub outliers: usize,
    /// Noise-free angle observed by laser 1, all effects included, rad, per row.
    pub clean: Vec<f64>,
    /// What laser 1 would have shown of the same joint's plain spring under the reported load with
    /// none of the truths (of a joint with the truth `stiffness`: at the stated stiffness), rad, per
    /// row. The harmless deviations of stiffness and levers are in both, so `clean - straight` is
    /// what the truths do and nothing else.
    pub straight: Vec<f64>,
    /// Rms of the noise added to laser 1, outliers apart, rad.
    pub noise_rms: f64,
    /// Load cycle of each row; a rest belongs to the first.
    pub cycle: Vec<usize>,
}

/// The effects of the library.
pub const EFFECTS: &[&str] = &[
    "backlash",
    "soft_zone",
    "cubic_stiffness",
    "asymmetry",
    "hysteresis",
    "coulomb_friction",
    "creep",
    "loosening",
    "slip",
    "sensor_offset",
    "thermal_drift",
    "time_skew",
    "quantization",
    "lever_arm",
    "cosine_error",
    "stiffness",
];

/// Effects of one family look alike; those of the family `scale` are not combined at random.
pub fn family(effect: &str) -> &'static str {
    match effect {
        "backlash" | "soft_zone" | "cubic_stiffness" => "odd",
        "asymmetry" => "even",
        "hysteresis" | "coulomb_friction" | "creep" | "time_skew" => "loop",
        "sensor_offset" | "thermal_drift" | "slip" => "slow",
        "loosening" => "growth",
        "quantization" => "lattice",
        "lever_arm" | "cosine_error" | "stiffness" => "scale",
        _ => "outside",
    }
}

fn known(name: &str, names: &'static [&'static str]) -> &'static str {
    let found = names
        .iter()
        .find(|n| **n == name || n.strip_prefix("outside:") == Some(name));
    found.unwrap_or_else(|| panic!("no such effect: {name}"))
}

/// Log-uniform between 3 and 30 times the noise; a lattice between 3 and 8.
fn strength(effect: &'static str, random: &mut Random) -> Wanted {
    let most = if effect == "quantization" { 8.0 } else { 30.0 };
    (effect, random.log_uniform(3.0, most))
}

/// One effect, its strength drawn between 3 and 30 times the noise.
pub fn single(effect: &str, seed: u64) -> Case {
    let effect = known(effect, EFFECTS);
    build(|random| vec![strength(effect, random)], effect, seed)
}

/// One effect at the given strength.
pub fn single_at(effect: &str, strength: f64, seed: u64) -> Case {
    let effect = known(effect, EFFECTS);
    build(|_| vec![(effect, strength)], effect, seed)
}

/// Two given effects.
pub fn pair(a: &str, b: &str, seed: u64) -> Case {
    let (a, b) = (known(a, EFFECTS), known(b, EFFECTS));
    let both = |random: &mut Random| vec![strength(a, random), strength(b, random)];
    build(both, &format!("{a}+{b}"), seed)
}

/// Two different effects; one pair in ten is of one family, and never are both of scale.
pub fn random_pair(seed: u64) -> Case {
    let mut random = Random::new(seed, "random pair");
    let alike = random.chance(0.1);
    loop {
        let (a, b) = (random.choose(EFFECTS), random.choose(EFFECTS));
        let same = family(a) == family(b);
        if a != b && same == alike && !(same && family(a) == "scale") {
            return pair(a, b, seed);
        }
    }
}

/// A plain spring.
pub fn clean(seed: u64) -> Case {
    build(|_| Vec::new(), "clean", seed)
}

/// An effect that the library does not hold (with or without the prefix `outside:`), at 4 to 30
/// times the noise.
pub fn outside(kind: &str, seed: u64) -> Case {
    let kind = known(kind, OUTSIDE);
    build(
        |random| vec![(kind, random.log_uniform(4.0, 30.0))],
        kind,
        seed,
    )
}
