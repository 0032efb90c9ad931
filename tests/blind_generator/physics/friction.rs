//! Coulomb friction in the load path: one sharp threshold.

use super::super::random::Random;
use super::super::schedule::Schedule;
use super::parallel::{Element, Slider, deflection};
use super::{Drawn, added, to_unit_peak};

/// Lost motion held by friction: the play operator x = max(u - h, min(u + h, x)) (Prandtl, 1928), in
/// half of the cases slightly rounded, as one stiff Dahl element (1968) beside a spring.
pub fn draw(schedule: &Schedule, random: &mut Random) -> Drawn {
    let threshold = random.uniform(0.05, 0.35);
    let rounded = random.chance(0.5);
    let slip = if rounded {
        dahl(&schedule.load, threshold, random.uniform(0.03, 0.08))
    } else {
        play(&schedule.load, threshold)
    };
    let parameters = vec![
        ("threshold_of_max", threshold),
        ("rounded", f64::from(u8::from(rounded))),
    ];
    added(to_unit_peak(slip), 0.5, "slip_rad", parameters)
}

fn play(load: &[f64], h: f64) -> Vec<f64> {
    let mut x = 0.0_f64;
    let step = |&u: &f64| {
        x = x.min(u + h).max(u - h);
        x
    };
    load.iter().map(step).collect()
}

/// Slip beyond the elastic part of u = a x + f, f a Dahl force with threshold (1 - a) h: beyond the
/// rounding it is the play operator of threshold h.
fn dahl(load: &[f64], h: f64, a: f64) -> Vec<f64> {
    let mut one = [Element {
        stiffness: 1.0 - a,
        threshold: (1.0 - a) * h,
        force: 0.0,
    }];
    let x = deflection(load, a, &mut one, Slider::Dahl);
    x.iter().zip(load).map(|(x, u)| x - u).collect()
}
