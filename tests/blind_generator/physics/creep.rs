//! Creep: Kelvin-Voigt elements in series with the spring.

use super::super::random::Random;
use super::super::schedule::Schedule;
use super::{Drawn, added};

/// T dx/dt + x = u, one element or two (Kelvin, 1865; Voigt, 1892; with the spring the standard linear
/// solid of Zener, 1948), exact for a load that is linear within a step.
pub fn draw(schedule: &Schedule, random: &mut Random) -> Drawn {
    let first = random.log_uniform(0.05, 0.6);
    let mut shape = lag(schedule, first * schedule.period);
    let mut parameters = vec![("time_constant_s", first * schedule.period)];
    if random.chance(0.4) {
        let second = random.log_uniform(0.3, 3.0) * schedule.period;
        let share = random.uniform(0.3, 0.6);
        let slow = lag(schedule, second);
        let mix = |(a, b): (&mut f64, f64)| *a = (1.0 - share) * *a + share * b;
        shape.iter_mut().zip(slow).for_each(mix);
        parameters.extend([("time_constant2_s", second), ("share2", share)]);
    }
    added(shape, 0.6, "creep_at_full_load_rad", parameters)
}

fn lag(schedule: &Schedule, constant: f64) -> Vec<f64> {
    let mut shape = vec![0.0; schedule.time.len()];
    for i in 1..shape.len() {
        let (t, u) = (&schedule.time[i - 1..=i], &schedule.load[i - 1..=i]);
        let step = t[1] - t[0];
        let behind = constant * (u[1] - u[0]) / step;
        let decay = (-step / constant).exp();
        shape[i] = u[1] - behind + (shape[i - 1] - u[0] + behind) * decay;
    }
    shape
}
