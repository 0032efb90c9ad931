//! The joint or its fixture changes for good: loosening and slip.

use super::super::random::Random;
use super::super::schedule::Schedule;
use super::{Drawn, added};

/// Compliance grows with the work done: adds u W(t) / W(end), W the integral of |u|^p |du| with p = 0
/// (travel), 1 (work) or more, in half of the cases levelling off as 1 - exp(-c W) (energy-driven
/// self-loosening: Jiang, 2003; wear with work: Archard, 1953).
pub fn loosening(schedule: &Schedule, random: &mut Random) -> Drawn {
    let power = random.choose(&[0.0, 1.0, 1.0, 2.5]);
    let bend = if random.chance(0.5) {
        random.uniform(0.5, 2.0)
    } else {
        0.0
    };
    let work = accumulate(&schedule.load, power);
    let end = work[work.len() - 1];
    let grown = |w: f64| match bend {
        0.0 => w / end,
        c => (1.0 - (-c * w / end).exp()) / (1.0 - (-c).exp()),
    };
    let pairs = schedule.load.iter().zip(&work);
    let shape = pairs.map(|(u, &w)| u * grown(w)).collect();
    let parameters = vec![("work_power", power), ("levelling", bend)];
    added(shape, 0.4, "growth_at_full_load_rad", parameters)
}

fn accumulate(load: &[f64], power: f64) -> Vec<f64> {
    let mut sum = 0.0;
    let mut last = load[0];
    let mut step = |&u: &f64| {
        sum += (0.5 * (u + last)).abs().powf(power) * (u - last).abs();
        last = u;
        sum
    };
    load.iter().map(&mut step).collect()
}

/// The fixture gives way once, near a peak of the load and in its direction: a permanent step that
/// takes less than two rows (joint macro-slip: Gaul and Nitsche, 2001).
pub fn slip(schedule: &Schedule, random: &mut Random) -> Drawn {
    let at = instant(schedule, random);
    let length = random.uniform(0.01, 1.8) * schedule.stride as f64;
    let sign = schedule.load[at].signum();
    let ramp = |i: usize| ((i as f64 - at as f64) / length).clamp(0.0, 1.0);
    let shape = (0..schedule.load.len()).map(|i| sign * ramp(i)).collect();
    let parameters = vec![("instant_s", schedule.time[at])];
    added(shape, 0.3, "step_rad", parameters)
}

/// An instant in the middle of the record at which the load is above 70 % of its cycle's largest.
fn instant(schedule: &Schedule, random: &mut Random) -> usize {
    let count = schedule.load.len();
    let cycle = |i: usize| schedule.cycle[i / schedule.stride];
    let mut largest = vec![0.0_f64; cycle(count - 1) + 1];
    for (i, u) in schedule.load.iter().enumerate() {
        largest[cycle(i)] = largest[cycle(i)].max(u.abs());
    }
    loop {
        let i = random.integer(count * 15 / 100, count * 85 / 100);
        if schedule.load[i].abs() > 0.7 * largest[cycle(i)] {
            return i;
        }
    }
}
