//! Laws of one value: gaps, gears that stiffen, sides that differ.

use super::super::{chance, pick};
use super::memory::play;
use super::programme::Programme;
use ident::ground::random::Random;

/// A gap in series.
pub fn backlash(p: &Programme, random: &mut Random) -> (Vec<f64>, &'static str) {
    let wide = random.log_uniform(0.003, 0.03);
    match random.below(4) {
        0 => (p.of_load(|u| (u / wide).tanh()), "gap of rounded corners"),
        1 => (
            p.of_load(|u| (u / wide).clamp(-1.0, 1.0)),
            "gap with compliance in it",
        ),
        2 => {
            // The weight of the arm holds one flank: the gap opens at another load.
            let at = random.uniform(-0.15, 0.15);
            let step = move |u: f64| ((u - at) / wide).tanh();
            (p.of_load(move |u| step(u) - step(0.0)), "gap under weight")
        }
        _ => {
            let held = random.uniform(0.01, 0.06);
            let behind = play(&p.u, |_| held);
            (
                behind.iter().map(|u| (u / wide).tanh()).collect(),
                "gap that grease holds",
            )
        }
    }
}

/// Softer near no load.
pub fn soft(p: &Programme, random: &mut Random) -> (Vec<f64>, &'static str) {
    let m = random.uniform(0.15, 0.55);
    match random.below(4) {
        0 => (p.of_load(|u| (u / m).clamp(-1.0, 1.0)), "two slopes"),
        1 => (p.of_load(|u| (u / m).tanh()), "smooth"),
        2 => {
            let share = random.uniform(0.5, 0.8);
            let half = |u: f64, m: f64| (u / m).clamp(-1.0, 1.0);
            (
                p.of_load(move |u| share * half(u, m) + (1.0 - share) * half(u, 1.6 * m)),
                "three slopes (catalogue)",
            )
        }
        _ => (
            p.of_load(|u| u.signum() * (1.0 - (-u.abs() / (0.6 * m)).exp())),
            "exponential",
        ),
    }
}

/// Stiffer, or softer, as the load grows.
pub fn stiffening(p: &Programme, random: &mut Random) -> (Vec<f64>, &'static str) {
    let minus = |v: Vec<f64>| v.iter().map(|x| -x).collect::<Vec<f64>>();
    match random.below(4) {
        0 => {
            // load = d + c d^3.
            let c = random.log_uniform(0.1, 1.5);
            let solve = move |u: f64| {
                let mut d = u;
                for _ in 0..60 {
                    d -= (d + c * d.powi(3) - u) / (1.0 + 3.0 * c * d * d);
                }
                d
            };
            (p.of_load(solve), "cubic")
        }
        1 => (p.of_load(|u| u.signum() * u.abs().powf(2.0 / 3.0)), "Hertz"),
        2 => {
            let power = random.uniform(1.6, 3.2);
            let table: Vec<f64> = (0..=10)
                .map(|i| (f64::from(i) / 10.0).powf(power))
                .collect();
            let read = |x: f64| {
                let at = (10.0 * x).min(9.999);
                let i = at as usize;
                table[i] + (at - i as f64) * (table[i + 1] - table[i])
            };
            let all = p.of_load(|u| u.signum() * read(u.abs()));
            (
                if chance(random, 0.8) { minus(all) } else { all },
                "table of eleven",
            )
        }
        _ => {
            let power = random.uniform(1.8, 3.5);
            let all = p.of_load(|u| u.signum() * u.abs().powf(power));
            (
                if chance(random, 0.8) { minus(all) } else { all },
                "power of the load",
            )
        }
    }
}

/// One side unlike the other.
pub fn sides(p: &Programme, random: &mut Random) -> (Vec<f64>, &'static str) {
    let s = *pick(random, &[1.0, -1.0]);
    match random.below(4) {
        0 => (p.of_load(|u| s * (s * u).max(0.0)), "two springs"),
        1 => (p.of_load(|u| s * u * u), "square of the load"),
        2 => {
            let round = random.uniform(0.02, 0.1);
            let bend = move |u: f64| round * (1.0 + (u / round).exp()).ln();
            (p.of_load(|u| bend(s * u) - bend(0.0)), "flange that opens")
        }
        _ => {
            let at = random.uniform(0.05, 0.3);
            (
                p.of_load(|u| s * (s * u - at).max(0.0)),
                "a stop that lets go",
            )
        }
    }
}
