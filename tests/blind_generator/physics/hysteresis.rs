//! Elastic hysteresis by four laws, all driven by the load and read as slip beyond the elastic part.

use super::super::random::Random;
use super::super::schedule::Schedule;
use super::parallel::{Element, Slider, deflection};
use super::{Drawn, added, to_unit_peak};

/// Draws one of the four laws.
pub fn draw(schedule: &Schedule, random: &mut Random) -> Drawn {
    let load = &schedule.load;
    let (slip, mut parameters, law) = match random.integer(0, 3) {
        0 => with_law(bouc_wen(load, random), 0.0),
        1 => with_law(sliders(load, 15, Slider::Dahl, random), 1.0),
        2 => with_law(sliders(load, 40, Slider::Jenkins, random), 2.0),
        _ => with_law(rayleigh(load, random), 3.0),
    };
    parameters.push(("law", law));
    added(to_unit_peak(slip), 0.5, "slip_rad", parameters)
}

type Named = Vec<(&'static str, f64)>;

fn with_law((slip, parameters): (Vec<f64>, Named), law: f64) -> (Vec<f64>, Named, f64) {
    (slip, parameters, law)
}

/// u = a d + (1 - a) z, dz/dd = 1 - |z / z0|^n (beta + gamma sgn(z dd)), beta + gamma = 1
/// (Bouc, 1967; Wen, 1976), by the midpoint rule over load.
fn bouc_wen(load: &[f64], random: &mut Random) -> (Vec<f64>, Named) {
    let a = random.uniform(0.1, 0.5);
    let z0 = random.uniform(0.3, 0.9);
    let n = random.uniform(1.0, 1.8);
    let beta = random.uniform(0.5, 0.75);
    let rate = |z: f64, direction: f64| {
        let side = if z * direction >= 0.0 {
            1.0
        } else {
            2.0 * beta - 1.0
        };
        (1.0 - (z.abs() / z0).min(1.0).powf(n) * side).max(0.0)
    };
    let (mut d, mut z, mut last) = (0.0, 0.0, 0.0);
    let slip = load.iter().map(|&u| {
        let du = u - last;
        let first = rate(z, du);
        let half = 0.5 * du * first / (a + (1.0 - a) * first);
        let g = rate(z + half, du);
        let dd = du / (a + (1.0 - a) * g);
        d += dd;
        z += g * dd;
        last = u;
        d - u
    });
    let slip = slip.collect();
    (
        slip,
        vec![("alpha", a), ("z0", z0), ("n", n), ("beta", beta)],
    )
}

/// Many friction elements beside a spring, yield deflections spread by a power law: Dahl elements
/// (Dahl, 1968) or Jenkins elements (Iwan, 1966; Maxwell-slip).
fn sliders(load: &[f64], count: usize, slider: Slider, random: &mut Random) -> (Vec<f64>, Named) {
    let spring = random.uniform(0.2, 0.5);
    let widest = random.uniform(1.0, 2.2);
    let power = random.uniform(0.7, 1.5);
    let mut elements: Vec<Element> = (0..count)
        .map(|i| {
            let yields = widest * ((i as f64 + 0.5) / count as f64).powf(power);
            let stiffness = (1.0 - spring) / count as f64;
            Element {
                stiffness,
                threshold: stiffness * yields,
                force: 0.0,
            }
        })
        .collect();
    let x = deflection(load, spring, &mut elements, slider);
    let slip = x.iter().zip(load).map(|(x, u)| x - u).collect();
    (
        slip,
        vec![("alpha", spring), ("widest", widest), ("power", power)],
    )
}

/// Power-law virgin curve sgn(u) |u|^p (p = 2: Rayleigh, 1887), branches doubled after Masing (1926)
/// with a memory of open turning points (Madelung, 1905).
fn rayleigh(load: &[f64], random: &mut Random) -> (Vec<f64>, Named) {
    let power = random.uniform(1.7, 2.6);
    let virgin = |u: f64| u.abs().powf(power).copysign(u);
    let mut turns: Vec<(f64, f64)> = Vec::new();
    let (mut last, mut direction) = ((0.0, 0.0), 0.0);
    let slip = load.iter().map(|&u| {
        let step = u - last.0;
        if step != 0.0 {
            if step * direction < 0.0 {
                turns.push(last);
            }
            direction = step.signum();
            forget(&mut turns, u, direction);
            last = match turns.last() {
                None => (u, virgin(u)),
                Some(&(from, slip)) => (u, slip + 2.0 * virgin(0.5 * (u - from))),
            };
        }
        last.1
    });
    let slip = slip.collect();
    (slip, vec![("power", power)])
}

/// Drops the turning points of loops that have closed: an inner branch that passes the turn before
/// its own goes on along the outer one.
fn forget(turns: &mut Vec<(f64, f64)>, u: f64, direction: f64) {
    loop {
        let count = turns.len();
        let goal = match count {
            0 => return,
            1 => -turns[0].0,
            _ => turns[count - 2].0,
        };
        if (u - goal) * direction <= 0.0 {
            return;
        }
        turns.truncate(count.saturating_sub(2));
    }
}
