//! One column exported under two titles.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, said_if};
use crate::ground::stats::rms;
use crate::ground::units::DEGREE;

/// A deflection with the digits of the load is the load's own column, in another unit or not.
pub const RULE: Rule = Rule {
    name: "copied",
    remedy: "export the sensor's own channel",
    look,
};

/// Levels of the load from which on exact proportion is no chance of few digits.
const LEVELS: usize = 6;
/// What arithmetic of units leaves, of the whole.
const ROUNDING: f64 = 1e-12;

/// How near a factor is to a power of ten, decades.
const DECADE: f64 = 1e-9;

fn look(on: &Course) -> Said {
    let file = on.file;
    let mut levels = file.load.clone();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    if levels.len() < LEVELS {
        return Vec::new();
    }
    let factor = proportion(&file.load, &file.deflection);
    let levers = [file.facts.load_lever, file.facts.sensor_lever];
    said_if(
        factor.is_some_and(|factor| is_of_units(factor, levers)),
        Weight::Fatal,
        "the deflection has the digits of the load, without any error: one column was exported twice",
    )
}

/// Deflection over load, if that is one number for all rows.
fn proportion(load: &[f64], other: &[f64]) -> Option<f64> {
    let scale = rms(load).max(f64::MIN_POSITIVE);
    let own: f64 = load.iter().map(|l| (l / scale).powi(2)).sum();
    let cross: f64 = load.iter().zip(other).map(|(l, o)| l / scale * o).sum();
    let off = load.iter().zip(other);
    let off: Vec<f64> = off.map(|(l, o)| o - cross / own * l / scale).collect();
    let size = rms(other);
    (size > 0.0 && rms(&off) <= ROUNDING * size).then(|| cross / own / scale)
}

/// Whether a factor is made of units and the levers (m) alone: an ideal spring that somebody simulated without noise
/// has its own.
fn is_of_units(factor: f64, levers: [Option<f64>; 2]) -> bool {
    let [load, sensor] = levers.map(|lever| [1.0, lever.unwrap_or(1.0)]);
    let mut raw = load
        .into_iter()
        .flat_map(|l| sensor.map(|s| factor.abs() * l * s))
        .flat_map(|raw| [raw, raw / DEGREE]);
    raw.any(|raw| (raw.log10() - raw.log10().round()).abs() < DECADE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_in_another_unit_is_a_copy_and_an_ideal_spring_is_none() {
        let load: Vec<f64> = (0..50)
            .map(|i| 350.0 * (f64::from(i) * 0.3).sin())
            .collect();
        let levers = [Some(0.5), Some(0.4)];
        let told = |factor: f64| {
            let other: Vec<f64> = load.iter().map(|l| l * factor).collect();
            is_of_units(proportion(&load, &other).unwrap(), levers)
        };
        assert!(told(1e-3 / (0.5 * 0.4)) && told(DEGREE) && told(1.0));
        assert!(!told(1.0 / 314_030.0));
        let mut noisy: Vec<f64> = load.iter().map(|l| 1e-3 * l).collect();
        noisy[7] += 1e-9;
        assert_eq!(proportion(&load, &noisy), None);
    }
}
