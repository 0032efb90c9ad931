//! The law of a hinge beside the laws of its effects, and its energy.

use super::*;
use crate::effects::{Composite, Scene, named};
use crate::ground::random::Random;
use crate::robot::joint_effect::JointEffect;

const STIFFNESS: f64 = 3.14e5;

fn joint(gap: f64) -> Spring {
    Spring {
        backlash: vec![gap; usize::from(gap > 0.0)],
        effects: vec![
            JointEffect::new("hysteresis", vec![9.7e-5, 348.0, 1.09, -0.377]).unwrap(),
            JointEffect::new("coulomb_friction", vec![2e-5, 60.0]).unwrap(),
        ],
        ..Spring::new(STIFFNESS, 0.0)
    }
}

/// Deflections that a random history of loads leaves behind, by the laws of the effects.
fn history(spring: &Spring, loads: &[f64]) -> Vec<f64> {
    let effects: Vec<_> = spring
        .effects
        .iter()
        .map(|e| named(&e.name).unwrap())
        .collect();
    let model = Composite::new(&effects);
    let time = (0..loads.len()).map(|i| i as f64).collect();
    let scene = Scene::new(time, loads.to_vec(), STIFFNESS, 1);
    let own = spring.effects.iter().flat_map(|e| e.values.clone());
    let p: Vec<f64> = [STIFFNESS].into_iter().chain(own).collect();
    model.predict(&p, &scene)
}

fn loads(seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    (0..200).map(|_| random.uniform(-500.0, 500.0)).collect()
}

/// A gap in series only adds its half.
#[test]
fn sliders_invert_the_laws_of_the_effects() {
    for (gap, seed) in [(0.0, 1), (2e-4, 2)] {
        let spring = joint(gap);
        let law = HingeLaw::of(&spring);
        let (mut memory, mut at) = (law.at_rest(0.0), 0.0);
        let loads = loads(seed);
        for (delta, load) in history(&spring, &loads).into_iter().zip(&loads) {
            let to = delta + 0.5 * gap * load.signum();
            law.advance(&mut memory, at, to);
            at = to;
            let found = memory.torque;
            assert!((found - load).abs() < 1e-9 * 500.0, "{found} {load}");
        }
    }
}

/// Work is what is stored plus what is lost; the loss is never negative; the slope is the
/// derivative of the mean.
#[test]
fn work_is_stored_or_lost() {
    let mut random = Random::new(3);
    for gap in [0.0, 2e-4] {
        let law = HingeLaw::of(&joint(gap));
        let (mut memory, mut at, mut lost) = (law.at_rest(0.0), 0.0, 0.0);
        for _ in 0..2000 {
            let to = random.uniform(-2e-3, 2e-3);
            let (before, mean) = (law.stored(&memory), law.mean(&memory, at, to));
            let near = law.mean(&memory, at, to + 1e-9).torque;
            let error = (near - mean.torque) / 1e-9 - mean.slope;
            assert!(error.abs() < 1e-3 * STIFFNESS, "{error}");
            law.advance(&mut memory, at, to);
            let loss = mean.torque * (to - at) - (law.stored(&memory) - before);
            assert!(loss > -1e-15, "{loss}");
            (at, lost) = (to, lost + loss);
        }
        assert!(lost > 0.1);
    }
}
