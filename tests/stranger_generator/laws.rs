//! Laws of the literature for every mechanism, of arbitrary size: the case scales them.

use super::schedule::Schedule;
use ident::ground::random::Random;
use std::f64::consts::TAU;

/// What may be hidden.
pub const MECHANISMS: &[&str] = &[
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
];

/// What no library holds.
pub const OUTSIDE: &[&str] = &[
    "outside:teeth",
    "outside:bump",
    "outside:engine",
    "outside:chatter",
    "outside:sticking",
];

/// Mechanisms of one kind look alike.
pub fn kin(effect: &str) -> usize {
    match effect {
        "backlash" | "soft_zone" | "cubic_stiffness" => 0,
        "asymmetry" => 1,
        "hysteresis" | "coulomb_friction" | "creep" | "time_skew" => 2,
        "slip" | "sensor_offset" | "thermal_drift" => 3,
        _ => 4,
    }
}

type Drawn = (&'static str, Vec<f64>);

/// A law for an effect, and what it adds on the fine grid.
pub fn draw(effect: &str, s: &Schedule, random: &mut Random) -> Drawn {
    match effect {
        "backlash" => gap(s, random),
        "soft_zone" => soft(s, random),
        "cubic_stiffness" => stiffening(s, random),
        "asymmetry" => sides(s, random),
        "hysteresis" => hysteresis(s, random),
        "coulomb_friction" => friction(s, random),
        "creep" => creep(s, random),
        "loosening" => loosening(s, random),
        "slip" => slip(s, random),
        "sensor_offset" => ("constant", vec![1.0; s.load.len()]),
        "thermal_drift" => drift(s, random),
        "time_skew" => late(s, random),
        outside => unknown(outside, s, random),
    }
}

fn over_load(s: &Schedule, f: impl Fn(f64) -> f64) -> Vec<f64> {
    s.load.iter().map(|u| f(*u)).collect()
}

fn over_time(s: &Schedule, f: impl Fn(f64) -> f64) -> Vec<f64> {
    s.time.iter().map(|t| f(t / s.duration())).collect()
}

/// Flanks that close like Hertzian contacts, or along a logistic curve; some under a dead load.
fn gap(s: &Schedule, random: &mut Random) -> Drawn {
    let width = random.log_uniform(0.006, 0.03);
    let dead = match random.unit() < 0.3 {
        true => random.uniform(-0.15, 0.15),
        false => 0.0,
    };
    match random.unit() < 0.5 {
        true => {
            let closing = |u: f64| (u - dead).signum() * (1.0 - (-(u - dead).abs() / width).exp());
            ("exponential contact", over_load(s, closing))
        }
        false => {
            let closing = |u: f64| 2.0 / (1.0 + (-2.0 * (u - dead) / width).exp()) - 1.0;
            ("logistic contact", over_load(s, closing))
        }
    }
}

/// A softer spring about zero load, its ends rounded.
fn soft(s: &Schedule, random: &mut Random) -> Drawn {
    let (m, round) = (random.uniform(0.12, 0.5), random.uniform(0.005, 0.04));
    let plus = |x: f64| round * (x / round).min(500.0).exp().ln_1p().min(1e9);
    let own = |u: f64| match u.abs() / round > 400.0 {
        true => u.signum() * m,
        false => plus(u + m) - plus(u - m) - m,
    };
    ("softplus zone", over_load(s, own))
}

/// Hertz (power 2/3), Ramberg and Osgood's monotone curve, a geometric tangent, an arc of sinh.
fn stiffening(s: &Schedule, random: &mut Random) -> Drawn {
    let p = random.uniform(2.2, 4.5);
    let b = random.uniform(2.0, 5.0);
    match random.below(4) {
        0 => (
            "Hertz",
            over_load(s, |u| u.signum() * u.abs().powf(2.0 / 3.0)),
        ),
        1 => (
            "Ramberg-Osgood curve",
            over_load(s, |u| u.signum() * u.abs().powf(p)),
        ),
        2 => ("tangent", over_load(s, |u| (1.1 * u).tan())),
        _ => ("arc of sinh", over_load(s, |u| (b * u).asinh())),
    }
}

/// Pull unlike push.
fn sides(s: &Schedule, random: &mut Random) -> Drawn {
    let side = if random.unit() < 0.5 { 1.0 } else { -1.0 };
    let (p, at) = (random.uniform(1.3, 2.5), random.uniform(0.05, 0.3));
    match random.below(3) {
        0 => ("two stiffnesses", over_load(s, |u| (side * u).max(0.0))),
        1 => (
            "power on one side",
            over_load(s, |u| (side * u).max(0.0).powf(p)),
        ),
        _ => ("lift-off", over_load(s, |u| (side * u - at).max(0.0))),
    }
}

/// Ramberg and Osgood with Masing's rule, Preisach's relays, Dahl's equation of power one.
fn hysteresis(s: &Schedule, random: &mut Random) -> Drawn {
    match random.below(3) {
        0 => ("Ramberg-Osgood loop", masing(s, random.uniform(2.0, 3.5))),
        1 => ("Preisach", preisach(s, random)),
        _ => {
            let level = random.uniform(0.35, 0.9);
            ("Dahl", dahl(s, level, 1.0))
        }
    }
}

/// Branches (Δu/2)^p · 2 from each turning point, with the memory of nested loops.
fn masing(s: &Schedule, p: f64) -> Vec<f64> {
    // a stack of turning points (load, deflection); an empty one: the virgin curve
    let virgin = |u: f64| u.signum() * u.abs().powf(p);
    let mut stack: Vec<(f64, f64)> = Vec::new();
    let (mut before, mut last, mut rising) = (0.0, 0.0, true);
    let mut out = Vec::with_capacity(s.load.len());
    for u in &s.load {
        let up = if *u == before { rising } else { *u > before };
        if up != rising && (before != 0.0 || !stack.is_empty()) {
            stack.push((before, last));
        }
        rising = up;
        // close what the load has left behind
        while stack.len() >= 2 {
            let inner = stack[stack.len() - 2].0;
            let closed = if up { *u >= inner } else { *u <= inner };
            match closed {
                true => stack.truncate(stack.len() - 2),
                false => break,
            }
        }
        if stack.len() == 1 && u.abs() >= stack[0].0.abs() && up == (stack[0].0 < 0.0) {
            stack.clear();
        }
        let value = match stack.last() {
            None => virgin(*u),
            Some((from, start)) => start + 2.0 * virgin(0.5 * (u - from)),
        };
        out.push(value);
        (before, last) = (*u, value);
    }
    out
}

/// 40 × 40 relays with Gaussian weights over their switching loads (Preisach 1935; Mayergoyz 1986).
fn preisach(s: &Schedule, random: &mut Random) -> Vec<f64> {
    const N: usize = 40;
    let level = |i: usize| -1.0 + 2.0 * (i as f64 + 0.5) / N as f64;
    let (wide, mean) = (random.uniform(0.25, 0.5), random.uniform(0.1, 0.3));
    let mut relays = Vec::new();
    for a in 0..N {
        for b in 0..=a {
            let (half, centre) = (0.5 * (level(a) - level(b)), 0.5 * (level(a) + level(b)));
            let weight = (-0.5 * ((half - mean) / (0.5 * wide)).powi(2)
                - 0.5 * (centre / wide).powi(2))
            .exp();
            let state: f64 = if centre > 0.0 { -1.0 } else { 1.0 };
            relays.push((level(a), level(b), weight, state));
        }
    }
    let total: f64 = relays.iter().map(|r| r.2).sum();
    // relays switch one after the other; a fine dither of their levels is not needed at 40 levels
    let step = |u: f64, relays: &mut Vec<(f64, f64, f64, f64)>| {
        let mut sum = 0.0;
        for (up, down, weight, state) in relays.iter_mut() {
            // a relay's own switch is a ramp over one level, as a real one's would be
            if u >= *up {
                *state = 1.0;
            } else if u <= *down {
                *state = -1.0;
            }
            sum += *weight * *state;
        }
        sum / total
    };
    let raw: Vec<f64> = s.load.iter().map(|u| step(*u, &mut relays)).collect();
    let first = raw[0];
    // levels are 0.05 apart: smooth over that much load
    let mut out = vec![0.0; raw.len()];
    let half = smoothing(s);
    let mut sums = vec![0.0];
    raw.iter()
        .for_each(|v| sums.push(sums[sums.len() - 1] + v - first));
    for (i, o) in out.iter_mut().enumerate() {
        let (a, b) = (i.saturating_sub(half), (i + half + 1).min(raw.len()));
        *o = (sums[b] - sums[a]) / (b - a) as f64;
    }
    out
}

/// Fine points in which the load moves by a fortieth of its range.
fn smoothing(s: &Schedule) -> usize {
    let way: f64 = s.load.windows(2).map(|w| (w[1] - w[0]).abs()).sum();
    ((0.04 / way) * s.load.len() as f64) as usize
}

/// Dahl (1968): dz/du = (1 − sgn(du) z)^p over a load of `level`.
fn dahl(s: &Schedule, level: f64, p: f64) -> Vec<f64> {
    let (mut z, mut before) = (0.0_f64, 0.0);
    let step = |u: &f64| {
        let du = u - before;
        before = *u;
        // in small steps, so that no equation runs away
        for _ in 0..4 {
            let rate = (1.0 - du.signum() * z).max(0.0).powf(p);
            z += 0.25 * du / (0.3 * level) * rate;
        }
        -z
    };
    s.load.iter().map(step).collect()
}

/// LuGre's bristles with Stribeck's fall, Dahl's steep one, a friction-held contact.
fn friction(s: &Schedule, random: &mut Random) -> Drawn {
    let level = random.uniform(0.03, 0.12);
    match random.below(3) {
        0 => ("LuGre", lugre(s, level, random)),
        1 => ("Dahl, steep", dahl(s, level, random.uniform(0.3, 0.7))),
        _ => {
            let mut held = 0.0_f64;
            let stop = |u: &f64| {
                held = held.clamp(u - level, u + level);
                held - u
            };
            ("slider", s.load.iter().map(stop).collect())
        }
    }
}

/// Canudas de Wit et al. (1995), quasi-static: bristles that slip at a level that falls with the rate.
fn lugre(s: &Schedule, level: f64, random: &mut Random) -> Vec<f64> {
    let (fall, typical) = (random.uniform(0.05, 0.25), 4.0 * s.cycles as f64);
    let (mut z, mut before) = (0.0_f64, 0.0);
    let dt = 1.0 / s.load.len() as f64;
    let step = |u: &f64| {
        let du = u - before;
        before = *u;
        let rate = (du / dt).abs() / typical;
        let most = 1.0 + fall * (-(rate / 0.3).powi(2)).exp();
        for _ in 0..4 {
            z += 0.25 * du / level * (1.0 - du.signum() * z / most);
        }
        -z
    };
    s.load.iter().map(step).collect()
}

/// The standard linear solid, logarithmic creep, power-law creep (Boltzmann's superposition).
fn creep(s: &Schedule, random: &mut Random) -> Drawn {
    let period = s.duration() / s.cycles as f64;
    match random.below(3) {
        0 => {
            let tau = period * random.log_uniform(0.1, 1.0);
            ("standard linear solid", lagged(s, tau))
        }
        1 => {
            // log(1 + t/τ) has a flat spectrum of times from τ on
            let first = period * random.log_uniform(0.02, 0.1);
            let mut sum = vec![0.0; s.load.len()];
            for k in 0..9 {
                let own = lagged(s, first * 2.0_f64.powi(k));
                sum.iter_mut().zip(own).for_each(|(a, b)| *a += b);
            }
            ("logarithmic creep", sum)
        }
        _ => {
            // t^n: a spectrum that grows as τ^n
            let (n, first) = (random.uniform(0.2, 0.5), period * 0.01);
            let mut sum = vec![0.0; s.load.len()];
            for k in 0..13 {
                let own = lagged(s, first * 2.0_f64.powi(k));
                let weight = 2.0_f64.powf(n * f64::from(k));
                sum.iter_mut().zip(own).for_each(|(a, b)| *a += weight * b);
            }
            ("power-law creep", sum)
        }
    }
}

/// The load through one relaxation time, s.
fn lagged(s: &Schedule, tau: f64) -> Vec<f64> {
    let mut z = 0.0;
    let mut before = 0.0;
    let dt = s.time[1] - s.time[0];
    let keep = (-dt / tau).exp();
    let step = |u: &f64| {
        z = keep * z + (1.0 - keep) * 0.5 * (u + before);
        before = *u;
        z
    };
    s.load.iter().map(step).collect()
}

/// Compliance that grows: with time, with the logarithm of the cycles, at once.
fn loosening(s: &Schedule, random: &mut Random) -> Drawn {
    let cycles = s.cycles as f64;
    let (at, tau) = (random.uniform(0.3, 0.7), random.uniform(0.2, 0.6));
    let with = |f: &dyn Fn(f64) -> f64| over_time(s, f);
    let (name, grown) = match random.below(4) {
        0 => ("steady", with(&|x| x)),
        1 => ("by cycles", with(&|x| (1.0 + (x * cycles).floor()).ln())),
        2 => ("sudden", with(&|x| f64::from(u8::from(x > at)))),
        _ => ("settling", with(&|x| 1.0 - (-x / tau).exp())),
    };
    (
        name,
        grown.iter().zip(&s.load).map(|(g, u)| g * u).collect(),
    )
}

/// A fixture that moves once, at once or within moments; or twice.
fn slip(s: &Schedule, random: &mut Random) -> Drawn {
    let at = random.uniform(0.15, 0.85);
    let later = random.uniform(at, 0.9);
    let wide = random.uniform(0.003, 0.01);
    match random.below(3) {
        0 => ("jump", over_time(s, |x| f64::from(u8::from(x > at)))),
        1 => (
            "quick slide",
            over_time(s, |x| 1.0 / (1.0 + (-(x - at) / wide).exp())),
        ),
        _ => {
            let two = |x: f64| f64::from(u8::from(x > at)) + 0.5 * f64::from(u8::from(x > later));
            ("two jumps", over_time(s, two))
        }
    }
}

/// Warming, a daily wave, diffusion, a wander.
fn drift(s: &Schedule, random: &mut Random) -> Drawn {
    let (tau, periods, phase) = (
        random.uniform(0.2, 1.5),
        random.uniform(0.4, 1.3),
        random.uniform(0.0, TAU),
    );
    let weights = [random.normal(), random.normal(), random.normal()];
    match random.below(4) {
        0 => ("warming", over_time(s, |x| 1.0 - (-x / tau).exp())),
        1 => (
            "wave",
            over_time(s, |x| (TAU * periods * x + phase).sin() - phase.sin()),
        ),
        2 => ("diffusion", over_time(s, f64::sqrt)),
        _ => {
            let wander = |x: f64| {
                let own = weights.iter().enumerate();
                own.map(|(k, w)| {
                    let k = (k + 1) as f64;
                    w / (k * k) * ((std::f64::consts::PI * k * x).cos() - 1.0)
                })
                .sum()
            };
            ("wander", over_time(s, wander))
        }
    }
}

/// A dead time, a low pass, a clock that runs away: reading less what it would be on time.
fn late(s: &Schedule, random: &mut Random) -> Drawn {
    let delay = s.duration() / s.cycles as f64 * random.uniform(0.008, 0.03);
    let last = s.load.len() - 1;
    let dt = s.time[1] - s.time[0];
    let by = |d: &dyn Fn(f64) -> f64| -> Vec<f64> {
        let at = |i: usize| {
            let x = (i as f64 - d(s.time[i] / s.duration()) / dt).max(0.0);
            let (k, f) = (x as usize, x.fract());
            s.load[k] * (1.0 - f) + s.load[(k + 1).min(last)] * f - s.load[i]
        };
        (0..=last).map(at).collect()
    };
    match random.below(3) {
        0 => ("dead time", by(&|_| delay)),
        1 => ("clock runs away", by(&|x| delay * x)),
        _ => {
            let lagged = lagged(s, delay);
            let own = lagged.iter().zip(&s.load).map(|(a, u)| a - u);
            ("low pass", own.collect())
        }
    }
}

fn unknown(kind: &str, s: &Schedule, random: &mut Random) -> Drawn {
    let phase = random.uniform(0.0, TAU);
    match kind {
        "outside:teeth" => {
            let waves = random.uniform(3.0, 9.0);
            (
                "ripple over load",
                over_load(s, |u| (TAU * waves * u + phase).sin()),
            )
        }
        "outside:bump" => {
            let (at, wide) = (random.uniform(0.3, 0.75), random.uniform(0.03, 0.08));
            (
                "dent",
                over_load(s, |u| (-0.5 * ((u - at) / wide).powi(2)).exp()),
            )
        }
        "outside:engine" => {
            let waves = random.uniform(4.0, 11.0) * s.cycles as f64;
            (
                "slow vibration",
                over_time(s, |x| (TAU * waves * x + phase).sin()),
            )
        }
        "outside:chatter" => {
            let (mut level, mut next) = (0.0, 0.0);
            let jumps = |x: f64| {
                if x > next {
                    level = random.normal();
                    next = x + random.uniform(0.02, 0.06);
                }
                level
            };
            let mut jumps = jumps;
            let own = s.time.iter().map(|t| jumps(t / s.duration()));
            ("telegraph", own.collect())
        }
        _ => {
            // a needle that stays until the load has moved on, and its stay grows with the load
            let mut held = 0.0_f64;
            let needle = |u: &f64| {
                let stay = 0.02 + 0.15 * u.abs();
                if (u - held).abs() > stay {
                    held = *u;
                }
                held - u
            };
            ("sticking needle", s.load.iter().map(needle).collect())
        }
    }
}
