//! Laws of elements that remember: friction, hysteresis, creep. Everything on the raster of a programme, driven by load.

use super::super::chance;
use super::programme::Programme;
use ident::ground::random::Random;

/// Play of half width `half(u)`: what a spring behind a slider does.
pub fn play(u: &[f64], half: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut z = 0.0_f64;
    let step = |u: &f64| {
        let r = half(*u);
        z = z.clamp(u - r, u + r);
        z
    };
    u.iter().map(step).collect()
}

/// First-order lag.
pub fn lag(p: &Programme, tau: f64) -> Vec<f64> {
    let mut z = 0.0;
    let mut all = vec![0.0];
    for i in 1..p.u.len() {
        let (dt, a, b) = (p.t[i] - p.t[i - 1], p.u[i - 1], p.u[i]);
        // Exact for a load that runs straight between two places.
        let x = dt / tau;
        if x > 1e-9 {
            let e = (-x).exp();
            let rate = (b - a) / x;
            z = b - rate + (z - a + rate) * e;
        }
        all.push(z);
    }
    all
}

/// A spring beside a dry element of the rate `slope(z, direction)`: the way under the load, and from it what is beyond the spring.
fn beside(u: &[f64], stiff: f64, slope: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let (mut x, mut z) = (0.0, 0.0_f64);
    let mut all = vec![0.0];
    for pair in u.windows(2) {
        let parts = 1 + ((pair[1] - pair[0]).abs() / 0.002) as usize;
        for _ in 0..parts {
            let force = (pair[1] - pair[0]) / parts as f64;
            let own = slope(z, force.signum()).max(0.0);
            let way = force / (1.0 + stiff * own);
            x += way;
            z += own * way;
        }
        all.push(x);
    }
    all
}

/// LuGre: Stribeck's fall of the friction with speed, and a little of damping; implicit in every step.
fn lugre(p: &Programme, breakaway: f64, rest: f64, slow: f64, bristle: f64) -> Vec<f64> {
    let (mut x, mut z) = (0.0_f64, 0.0_f64);
    let mut all = vec![0.0];
    for i in 1..p.u.len() {
        let dt = (p.t[i] - p.t[i - 1]).max(1e-9);
        let bent = |way: f64| {
            let limit = breakaway * (rest + (1.0 - rest) * (-(way / dt / slow).powi(2)).exp());
            let end = way.signum() * limit;
            end + (z - end) * (-bristle * way.abs() / limit).exp()
        };
        let (mut low, mut high) = (-1.0, 1.0);
        for _ in 0..50 {
            let way = 0.5 * (low + high);
            if x + way + bent(way) > p.u[i] {
                high = way
            } else {
                low = way
            }
        }
        let way = 0.5 * (low + high);
        z = bent(way);
        x += way;
        all.push(x);
    }
    all
}

/// Friction in the way of the load.
pub fn friction(p: &Programme, random: &mut Random) -> (Vec<f64>, &'static str) {
    let r = random.log_uniform(0.04, 0.35);
    match random.below(4) {
        0 => (play(&p.u, |_| r), "Jenkins"),
        1 => {
            let share = random.uniform(0.15, 0.5);
            (
                play(&p.u, |u| r * (share + (1.0 - share) * u.abs())),
                "friction of the teeth, by load",
            )
        }
        2 => {
            let sharp = random.uniform(6.0, 15.0) / r;
            (
                beside(&p.u, 1.0, |z, s| sharp * (1.0 - s * z / r).max(0.0)),
                "Dahl",
            )
        }
        _ => {
            let rest = random.uniform(0.75, 0.95);
            let slow = random.uniform(0.3, 3.0) / p.last();
            (lugre(p, r, rest, slow, 8.0 + 10.0 * random.unit()), "LuGre")
        }
    }
}

/// Elastic hysteresis of joints, belts and teeth that slip part by part.
pub fn hysteresis(p: &Programme, random: &mut Random) -> (Vec<f64>, &'static str) {
    let widths = 24;
    let sum = |weight: &dyn Fn(f64) -> f64, reach: f64| {
        let mut all = vec![0.0; p.u.len()];
        for k in 0..widths {
            let r = reach * (k as f64 + 0.5) / f64::from(widths);
            let own = play(&p.u, |_| r);
            let w = weight(r / reach);
            all.iter_mut().zip(own).for_each(|(a, o)| *a += w * o);
        }
        all
    };
    match random.below(5) {
        0 => {
            // Bouc and Wen with an exponent between one and two.
            let (n, share) = (random.uniform(1.0, 2.0), random.uniform(0.2, 0.9));
            let limit = random.uniform(0.2, 0.8);
            let slope = |z: f64, s: f64| {
                let full = (z / limit).abs().powf(n);
                1.0 - full * (share * (s * z).signum() + 1.0 - share)
            };
            (beside(&p.u, random.uniform(0.5, 2.0), slope), "Bouc-Wen")
        }
        1 => (sum(&|_| 1.0, random.uniform(0.3, 1.2)), "Iwan, even"),
        2 => {
            let power = random.uniform(-0.8, -0.2);
            (
                sum(&|r| r.powf(power), random.uniform(0.4, 1.5)),
                "Iwan, power (Segalman)",
            )
        }
        3 => (
            sum(
                &|r| (-8.0 * (r - 0.35).powi(2) / 0.3).exp(),
                random.uniform(0.3, 0.9),
            ),
            "Iwan, bell",
        ),
        _ => {
            // Rayleigh: parabolic branches, the loop grows with the cube of the amplitude.
            (sum(&|r| 1.0 - 0.5 * r, 1.0), "Rayleigh")
        }
    }
}

/// What goes on under a standing load.
pub fn creep(p: &Programme, random: &mut Random) -> (Vec<f64>, &'static str) {
    let last = p.last();
    let many = |weight: &dyn Fn(f64) -> f64, from: f64, to: f64| {
        let count = 12;
        let mut all = vec![0.0; p.u.len()];
        for k in 0..count {
            let tau = from * (to / from).powf(f64::from(k) / f64::from(count - 1));
            let w = weight(tau / last);
            all.iter_mut()
                .zip(lag(p, tau))
                .for_each(|(a, o)| *a += w * o);
        }
        all
    };
    match random.below(4) {
        0 => (many(&|_| 1.0, 0.01 * last, 2.0 * last), "logarithm"),
        1 => {
            let n = random.uniform(0.15, 0.4);
            (
                many(&|tau: f64| tau.powf(n), 0.005 * last, 5.0 * last),
                "power of time",
            )
        }
        2 => {
            let (one, two) = (
                random.log_uniform(0.02, 0.1) * last,
                random.log_uniform(0.15, 0.6) * last,
            );
            let share = random.uniform(0.3, 0.7);
            let both = lag(p, one)
                .iter()
                .zip(lag(p, two))
                .map(|(a, b)| share * a + (1.0 - share) * b)
                .collect();
            (both, "two Kelvin elements")
        }
        _ => (
            lag(p, random.log_uniform(0.03, 0.4) * last),
            "one Kelvin element",
        ),
    }
}

/// A spring that gives more and more: bolts that work loose.
pub fn loosening(p: &Programme, random: &mut Random) -> (Vec<f64>, &'static str) {
    let work = p.work();
    let grown: (Vec<f64>, &'static str) = match random.below(4) {
        0 => {
            // A bolt gives at one instant under a high load.
            let from = random.uniform(0.2, 0.7);
            let high = 0.75
                * p.u
                    .iter()
                    .zip(&work)
                    .filter(|(_, w)| **w > from)
                    .map(|(u, _)| u.abs())
                    .fold(0.0, f64::max);
            let at =
                p.u.iter()
                    .zip(&work)
                    .position(|(u, w)| *w > from && u.abs() > high)
                    .unwrap_or(p.u.len() / 2);
            (
                (0..p.u.len())
                    .map(|i| f64::from(u8::from(i >= at)))
                    .collect(),
                "a bolt lets go",
            )
        }
        1 => {
            let soon = random.uniform(0.15, 0.6);
            (
                work.iter().map(|w| 1.0 - (-w / soon).exp()).collect(),
                "settles with work",
            )
        }
        2 => {
            let power = random.uniform(0.7, 2.0);
            (
                work.iter().map(|w| w.powf(power)).collect(),
                "wears with work",
            )
        }
        _ => {
            let power = random.uniform(0.5, 1.2);
            (p.of_time(|t| t.powf(power)), "softens with time")
        }
    };
    (
        grown.0.iter().zip(&p.u).map(|(g, u)| g * u).collect(),
        grown.1,
    )
}

/// Whether a law is the border between friction and hysteresis.
pub fn border(law: &str) -> bool {
    !matches!(law, "Jenkins")
}

/// One of both signs.
pub fn sign(random: &mut Random) -> f64 {
    if chance(random, 0.5) { 1.0 } else { -1.0 }
}
