//! What each cause would add to the difference of the encoders: curves with free amplitudes.

use super::channels::{Channels, largest};

/// What an atom describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Proportional to speed: a delay between the encoders, or viscous friction.
    Rate,
    /// Dry friction between motor and spring: torque that never twists the spring.
    Coulomb,
    /// A free gap: the twist jumps where the torque changes sign.
    Backlash,
    /// Elastic hysteresis.
    Hysteresis,
    /// A zero that jumps.
    Offset,
    /// Periodic in the angle of an encoder.
    Ripple,
    /// Periodic in the angle but no encoder's own: named by nobody, only described.
    Mesh,
    /// Slow over the joint angle: named by nobody, only described.
    Position,
}

impl Kind {
    /// Whether it is only described, never named.
    pub fn is_silent(self) -> bool {
        matches!(self, Self::Mesh | Self::Position)
    }
}

/// A candidate with its shapes fixed: one column, or several of free amplitude.
#[derive(Debug, Clone)]
pub struct Atom {
    /// What it describes.
    pub kind: Kind,
    /// Its columns.
    pub columns: Vec<Vec<f64>>,
    /// Whether its amplitude must be positive.
    pub one_signed: bool,
    /// Its shape: an instant, an order, a width.
    pub shape: f64,
    /// How many shapes of its kind were tried.
    pub tried: usize,
}

impl Atom {
    fn one(kind: Kind, column: Vec<f64>, shape: f64, tried: usize) -> Self {
        Self {
            kind,
            columns: vec![column],
            one_signed: matches!(kind, Kind::Coulomb | Kind::Backlash | Kind::Hysteresis),
            shape,
            tried,
        }
    }
}

/// Columns that every model has: zero, torque, and the inertia of the rotor.
pub fn base(data: &Channels) -> Vec<Vec<f64>> {
    vec![
        vec![1.0; data.rows()],
        data.torque.clone(),
        data.acceleration.clone(),
    ]
}

/// All candidates but the periodic ones.
pub fn atoms(data: &Channels) -> Vec<Atom> {
    let mut all = vec![Atom::one(Kind::Rate, data.speed.clone(), 0.0, 1)];
    all.extend(friction(data));
    all.extend(gaps(data));
    all.extend(loops(data));
    all.extend(steps(data));
    all.push(position(data));
    all
}

/// Shares of the top speed over which friction changes sign.
const SIGN_WIDTHS: [f64; 3] = [0.005, 0.03, 0.1];

fn friction(data: &Channels) -> Vec<Atom> {
    let top = data.top_speed().max(f64::MIN_POSITIVE);
    let smooth = SIGN_WIDTHS
        .map(|w| -> Vec<f64> { data.speed.iter().map(|v| (v / (w * top)).tanh()).collect() });
    let mut all = smooth.to_vec();
    all.push(held_sign(&data.speed, 0.01 * top));
    let both_ways = |c: &Vec<f64>| share(c, |v| v > 0.5) > 0.04 && share(c, |v| v < -0.5) > 0.04;
    all.retain(both_ways);
    all.into_iter()
        .map(|c| Atom::one(Kind::Coulomb, c, 0.0, SIGN_WIDTHS.len() + 1))
        .collect()
}

/// Sign of the last motion: friction that holds through a rest.
fn held_sign(speed: &[f64], still: f64) -> Vec<f64> {
    let mut sign = 0.0;
    let of = |v: &f64| {
        if v.abs() > still {
            sign = v.signum();
        }
        sign
    };
    speed.iter().map(of).collect()
}

fn share(values: &[f64], keep: impl Fn(f64) -> bool) -> f64 {
    values.iter().filter(|v| keep(**v)).count() as f64 / values.len() as f64
}

/// Shares of the largest torque over which a gap closes.
const GAP_WIDTHS: [f64; 3] = [0.01, 0.04, 0.12];

fn gaps(data: &Channels) -> Vec<Atom> {
    let scale = largest(&data.torque).max(f64::MIN_POSITIVE);
    let both =
        |t: &[f64]| share(t, |v| v > 0.05 * scale) > 0.04 && share(t, |v| v < -0.05 * scale) > 0.04;
    let transmitted = super::stiffness::transmitted(data);
    let mut all = Vec::new();
    for torque in [&data.torque, &transmitted].into_iter().filter(|t| both(t)) {
        for w in GAP_WIDTHS {
            let column = torque.iter().map(|t| -(t / (w * scale)).tanh()).collect();
            all.push(Atom::one(Kind::Backlash, column, w, 2 * GAP_WIDTHS.len()));
        }
    }
    all
}

/// Shares of the torque's range over which elastic hysteresis saturates.
const LOOP_WIDTHS: [f64; 5] = [0.03, 0.08, 0.2, 0.45, 0.9];

/// Single loops, and means of two and three of neighbouring widths: a smooth spread of sliders.
fn loops(data: &Channels) -> Vec<Atom> {
    let (low, high) = range(&data.torque);
    let scale = (high - low).max(f64::MIN_POSITIVE);
    let single: Vec<Vec<f64>> = LOOP_WIDTHS
        .iter()
        .map(|w| slid(&data.torque, w * scale))
        .collect();
    let tried = 3 * LOOP_WIDTHS.len() - 3;
    let mean = |of: &[Vec<f64>]| {
        let at = |i: usize| of.iter().map(|c| c[i]).sum::<f64>() / of.len() as f64;
        Atom::one(
            Kind::Hysteresis,
            (0..data.rows()).map(at).collect(),
            0.0,
            tried,
        )
    };
    (1..=3)
        .flat_map(|many| single.windows(many).map(mean))
        .collect()
}

/// Smallest and largest value.
pub fn range(values: &[f64]) -> (f64, f64) {
    let wider = |(l, h): (f64, f64), v: &f64| (l.min(*v), h.max(*v));
    values.iter().fold((f64::MAX, f64::MIN), wider)
}

/// Bouc's hysteresis driven by the torque, from −1 to 1: the share that lags, so that the twist is
/// larger on the way back.
fn slid(torque: &[f64], width: f64) -> Vec<f64> {
    let mut z = 0.0_f64;
    let mut before = torque[0];
    let lag = |t: &f64| {
        let d = (t - before) / width;
        before = *t;
        // dz = d (1 − z sgn d), in closed form over the step
        let goal = d.signum();
        z = goal + (z - goal) * (-d.abs()).exp();
        z
    };
    torque.iter().map(lag).collect()
}

/// Instants of an even grid at which a zero may have jumped.
const INSTANTS: usize = 10;
/// Sharpest instants of a residual that are tried besides.
const SHARPEST: usize = 3;

fn steps(data: &Channels) -> Vec<Atom> {
    let at = |k: usize| data.rows() * (k + 1) / (INSTANTS + 1);
    (0..INSTANTS).map(|k| step(data, at(k))).collect()
}

/// Steps where the means of a residual before and after differ most.
pub fn sharp_steps(data: &Channels, residual: &[f64]) -> Vec<Atom> {
    let (n, w) = (residual.len(), (residual.len() / 40).max(4));
    let mut sums = vec![0.0];
    residual
        .iter()
        .for_each(|r| sums.push(sums[sums.len() - 1] + r));
    let jump = |i: usize| (sums[i + w] - 2.0 * sums[i] + sums[i - w]).abs();
    let mut order: Vec<usize> = (w..n - w).collect();
    order.sort_by(|a, b| jump(*b).total_cmp(&jump(*a)));
    let mut kept: Vec<usize> = Vec::new();
    for row in order {
        if kept.len() < SHARPEST && kept.iter().all(|k| k.abs_diff(row) > 2 * w) {
            kept.push(row);
        }
    }
    kept.into_iter().map(|row| step(data, row)).collect()
}

/// A zero that jumps at a row.
pub fn step(data: &Channels, row: usize) -> Atom {
    let column = (0..data.rows()).map(|i| if i < row { 0.0 } else { 1.0 });
    Atom::one(Kind::Offset, column.collect(), row as f64, data.rows() / 20)
}

/// Rows about a candidate for a step in which the best is sought.
pub fn step_reach(data: &Channels) -> usize {
    data.rows() / 80
}

fn position(data: &Channels) -> Atom {
    let (low, high) = range(&data.motor);
    let scaled = |q: &f64| (2.0 * q - low - high) / (high - low).max(f64::MIN_POSITIVE);
    let x: Vec<f64> = data.motor.iter().map(scaled).collect();
    Atom {
        kind: Kind::Position,
        columns: vec![x.clone(), x.iter().map(|x| x * x).collect()],
        one_signed: false,
        shape: 0.0,
        tried: 1,
    }
}

/// Sine and cosine of an order of an angle.
pub fn periodic(kind: Kind, angle: &[f64], order: f64, tried: usize) -> Atom {
    let wave = |f: fn(f64) -> f64| angle.iter().map(|q| f(order * q)).collect::<Vec<f64>>();
    Atom {
        kind,
        columns: vec![wave(f64::sin), wave(f64::cos)],
        one_signed: false,
        shape: order,
        tried,
    }
}
