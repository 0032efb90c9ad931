//! Speeds over the arc length: asked for in steps, kept with limited acceleration and jerk.

use super::double_s::{Limits, Phase};

/// A stretch on which one speed is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Arc length where it begins, m.
    pub begin: f64,
    /// Arc length where it ends, m.
    pub end: f64,
    /// Highest speed, m/s.
    pub speed: f64,
}

/// The phases over neighbouring steps, from rest to rest, from the time `begin` (s) on. Speeds rise
/// from where a faster step begins and have fallen where a slower one begins: no step is run through
/// faster than it asks. The acceleration is zero where steps meet.
pub fn profile(steps: &[Step], limits: &Limits, begin: f64) -> Vec<Phase> {
    let joints = joints(steps, limits);
    let mut phases = Vec::new();
    let mut t = begin;
    for (step, ends) in steps.iter().zip(joints.windows(2)) {
        t = run(&mut phases, step, [ends[0], ends[1]], limits, t);
    }
    phases
}

/// Speeds where steps meet, m/s: as high as the neighbours allow and the way to slow down.
fn joints(steps: &[Step], limits: &Limits) -> Vec<f64> {
    let mut joints = vec![0.0];
    joints.extend(steps.windows(2).map(|pair| pair[0].speed.min(pair[1].speed)));
    joints.push(0.0);
    for (k, step) in steps.iter().enumerate() {
        joints[k + 1] = limits.reachable(joints[k], step.end - step.begin, joints[k + 1]);
    }
    for (k, step) in steps.iter().enumerate().rev() {
        joints[k] = limits.reachable(joints[k + 1], step.end - step.begin, joints[k]);
    }
    joints
}

/// Up, along and down on one step; the time at its end, s.
fn run(
    phases: &mut Vec<Phase>,
    step: &Step,
    [from, to]: [f64; 2],
    limits: &Limits,
    begin: f64,
) -> f64 {
    let length = step.end - step.begin;
    let peak = limits.peak(from, to, length, step.speed);
    let (up, down) = (
        limits.change_length(from, peak),
        limits.change_length(peak, to),
    );
    let mut t = begin;
    if peak > from {
        limits.change(phases, [t, step.begin], from, peak);
        t += limits.change_time(from, peak);
    }
    let along = length - up - down;
    if along > 0.0 && peak > 0.0 {
        phases.push(Phase {
            begin: t,
            duration: along / peak,
            s: step.begin + up,
            v: peak,
            a: 0.0,
            j: 0.0,
        });
        t += along / peak;
    }
    if peak > to {
        limits.change(phases, [t, step.end - down], peak, to);
        t += limits.change_time(peak, to);
    }
    t
}

/// The lower of two step functions over the same stretch; equal neighbours become one.
pub fn lower(first: &[Step], second: &[Step]) -> Vec<Step> {
    let (mut i, mut j) = (0, 0);
    let mut all: Vec<Step> = Vec::with_capacity(first.len() + second.len());
    let mut at = first.first().map_or(0.0, |step| step.begin);
    while let (Some(a), Some(b)) = (first.get(i), second.get(j)) {
        let end = a.end.min(b.end);
        append(&mut all, [at, end], a.speed.min(b.speed));
        at = at.max(end);
        i += usize::from(a.end <= end);
        j += usize::from(b.end <= end);
    }
    all
}

/// Appends a step, or lengthens the last one if that asks for the same speed.
pub fn append(steps: &mut Vec<Step>, [begin, end]: [f64; 2], speed: f64) {
    match steps.last_mut() {
        _ if end <= begin => {}
        Some(last) if last.speed == speed => last.end = end,
        _ => steps.push(Step { begin, end, speed }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    #[test]
    fn random_steps_keep_every_limit_and_join() {
        let mut random = Random::new(11);
        for _ in 0..300 {
            let limits = Limits {
                acceleration: random.uniform(0.2, 3.0),
                jerk: random.uniform(2.0, 80.0),
            };
            let mut steps = Vec::new();
            let mut at = 0.0;
            for _ in 0..(1 + (random.uniform(0.0, 8.0) as usize)) {
                let long = 10_f64.powf(random.uniform(-5.0, -0.5));
                append(&mut steps, [at, at + long], random.uniform(0.005, 0.3));
                at = steps.last().unwrap().end;
            }
            let phases = profile(&steps, &limits, 0.0);
            let mut end = [0.0; 3];
            for phase in &phases {
                let begin = phase.at(phase.begin);
                for (k, digits) in [1e-12, 1e-9, 1e-9].into_iter().enumerate() {
                    assert!((begin[k] - end[k]).abs() < digits, "{phase:?} {end:?}");
                }
                end = phase.at(phase.begin + phase.duration);
                for i in 0..=20 {
                    let [s, v, a] = phase.at(phase.begin + phase.duration * f64::from(i) / 20.0);
                    let step = steps.iter().find(|step| s <= step.end + 1e-12).unwrap();
                    let next = steps.iter().find(|step| s <= step.end - 1e-12).unwrap_or(step);
                    assert!(v <= step.speed.max(next.speed) + 1e-9 && v > -1e-9);
                    assert!(a.abs() <= limits.acceleration * (1.0 + 1e-9));
                }
            }
            assert!((end[0] - at).abs() < 1e-12 && end[1].abs() < 1e-9);
        }
    }

    #[test]
    fn a_change_of_feed_takes_the_time_of_its_closed_form() {
        let limits = Limits {
            acceleration: 1.0,
            jerk: 20.0,
        };
        let mut steps = Vec::new();
        append(&mut steps, [0.0, 0.1], 0.05);
        append(&mut steps, [0.1, 0.2], 0.02);
        let phases = profile(&steps, &limits, 0.0);
        let last = phases.last().unwrap();
        // 0 to 0.05 in 0.1 s; 0.05 to 0.02 in 2√(0.03/20), done at 0.1 m; 0.02 to 0 in 2√(0.02/20).
        let (up, change, down) = (0.1, 2.0 * (0.0015_f64).sqrt(), 2.0 * (0.001_f64).sqrt());
        let fast = (0.1 - 0.025 * up - 0.035 * change) / 0.05;
        let slow = (0.1 - 0.01 * down) / 0.02;
        let duration = up + fast + change + slow + down;
        assert!((last.begin + last.duration - duration).abs() < 1e-13);
    }
}
