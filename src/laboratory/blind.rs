//! Blind sets: files with hidden effects, their truths in a separate folder.

use super::hide::{Hidden, hide};
use super::recording::Recording;
use super::truth::LoadCycleTruth;
use crate::effects::{EFFECTS, Effect, contract::Role};
use crate::experiments::schedule::SCHEDULES;
use crate::ground::problem::Outcome;
use crate::ground::random::Random;
use crate::measurement::load_cycle::LoadCycle;
use std::fmt::Write;

/// One blind file.
pub struct Blind {
    /// Text of the measurement.
    pub csv: String,
    /// Text of its truth, TOML.
    pub truth: String,
}

/// Makes blind file number `index` of a set. `folder` is scratch space for the intermediate file.
pub fn make(index: u64, seed: u64, folder: &std::path::Path) -> Outcome<Blind> {
    let random = &mut Random::new(seed.wrapping_mul(7919).wrapping_add(index));
    let test = test(random);
    let plain = test.record("blind", "blind set of `ident lab`", random.bits())?;
    let scratch = folder.join(format!(".blind-{index}.csv"));
    crate::ground::files::replace(&scratch, plain.text().as_bytes())?;
    let file = LoadCycle::read(&scratch);
    let _ = std::fs::remove_file(&scratch);
    let file = file?;
    let mut hidden = Vec::new();
    for effect in effects(random) {
        hidden.extend(hide(effect, random.log_uniform(3.0, 30.0), &file, random).ok());
    }
    let truth = truth(&test, &hidden);
    Ok(Blind {
        csv: add(plain, &test, &hidden).text(),
        truth,
    })
}

fn test(random: &mut Random) -> LoadCycleTruth {
    let stiffness = random.log_uniform(3e5, 2e7);
    let sensor_lever = random.uniform(0.4, 1.2);
    let (lever, force) = (random.uniform(0.5, 1.5), random.uniform(600.0, 1500.0));
    let deflection_mm = 1e3 * force * lever / stiffness * sensor_lever;
    LoadCycleTruth {
        file: "blind.csv".into(),
        joint: 1 + random.below(6),
        axis: if random.unit() < 0.5 {
            "rotation"
        } else {
            "tilt"
        }
        .into(),
        stiffness,
        nominal: Some(stiffness * (1.0 + 0.01 * random.normal())),
        nominal_stiffness_rel_std: 0.03,
        load_lever_m: lever,
        sensor_lever_m: sensor_lever,
        sensor2_lever_m: (random.unit() < 0.5).then_some(sensor_lever * 0.6),
        force,
        schedule: SCHEDULES[random.below(4)].name.into(),
        cycles: 3,
        cycle_s: random.uniform(5.0, 30.0),
        rest_s: random.uniform(0.5, 2.0),
        step_s: 0.05,
        sensor_noise_mm: deflection_mm / random.log_uniform(150.0, 1500.0),
        noise_correlation: random.uniform(0.0, 0.8),
        effects: Default::default(),
    }
}

/// None, one or two effects that show by their shape.
fn effects(random: &mut Random) -> Vec<&'static dyn Effect> {
    let shapes: Vec<_> = EFFECTS
        .iter()
        .copied()
        .filter(|e| e.role() == Role::Shape)
        .collect();
    let count = [0, 1, 1, 1, 2][random.below(5)];
    let mut chosen: Vec<&'static dyn Effect> = Vec::new();
    while chosen.len() < count {
        let effect = shapes[random.below(shapes.len())];
        if chosen.iter().all(|e| e.card().cause != effect.card().cause) {
            chosen.push(effect);
        }
    }
    chosen
}

/// Adds the hidden deflections to the lasers of a recording.
fn add(mut plain: Recording, test: &LoadCycleTruth, hidden: &[Hidden]) -> Recording {
    let levers = [Some(test.sensor_lever_m), test.sensor2_lever_m];
    for (column, lever) in plain.values[2..]
        .iter_mut()
        .zip(levers.into_iter().flatten())
    {
        for one in hidden {
            for (value, extra) in column.iter_mut().zip(&one.addition) {
                *value += 1e3 * lever * extra;
            }
        }
    }
    plain
}

/// The truth as TOML.
fn truth(test: &LoadCycleTruth, hidden: &[Hidden]) -> String {
    let mut text = format!("stiffness_Nm_rad = {:?}\n", test.stiffness);
    for one in hidden {
        let card = one.effect.card();
        let _ = writeln!(
            text,
            "\n[[effects]]\neffect = \"{}\"\nlaw = \"{}\"",
            card.cause, card.name
        );
        for (parameter, value) in card.parameters.iter().zip(&one.p) {
            let _ = writeln!(text, "{} = {value:?}", parameter.name);
        }
    }
    text
}
