//! Whether a motion fixes the stiffness of a joint at all: twist that follows the torque must not be
//! twist that follows speed, direction, acceleration or angle, and every piece of time must say the same.

use super::channels::{Channels, rms};
use super::columns::{Atom, Kind, base};
use super::noise::{Noise, orthonormal, without};
use super::unseen::{amplitudes, residual};

/// A compliance with the interval that all pieces and all nuisances support.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compliance {
    /// Twist per torque, rad/(N·m).
    pub value: f64,
    /// Its standard deviation, disagreement of the pieces included.
    pub std: f64,
}

/// Friction of the drive as the torque itself shows it: N·m, and N·m·s/rad.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Friction {
    /// Dry.
    pub dry: f64,
    /// Viscous.
    pub viscous: f64,
    /// Standard error of the viscous one.
    pub viscous_std: f64,
}

/// Share of the top speed over which dry friction changes its sign.
const SIGN_WIDTH: f64 = 0.03;
/// Pieces of the record that are left out in turn for the error of a friction.
const PIECES: usize = 8;
/// Largest relative standard deviation of a compliance that is printed.
const TIGHT: f64 = 0.1;
/// The torque's own part of the twist must stand so far above what is left.
const STANDS_OUT: f64 = 1.5;
/// Nats that slow structure over the angle must gain to be reckoned with.
const STRUCTURE: f64 = 8.0;

/// Columns of friction: smooth sign of the speed, and the speed.
fn friction_columns(data: &Channels) -> [Vec<f64>; 2] {
    let width = SIGN_WIDTH * data.top_speed().max(f64::MIN_POSITIVE);
    let sign = data.speed.iter().map(|v| (v / width).tanh()).collect();
    [sign, data.speed.clone()]
}

/// Friction that the torque channel shows beside inertia and what depends on the angle.
pub fn friction(data: &Channels) -> Friction {
    let [sign, speed] = friction_columns(data);
    let ones = vec![1.0; data.rows()];
    let wave = |f: fn(f64) -> f64| data.motor.iter().map(|q| f(*q)).collect::<Vec<f64>>();
    let (sine, cosine) = (wave(f64::sin), wave(f64::cos));
    let columns: [&[f64]; 6] = [&sign, &speed, &ones, &data.acceleration, &sine, &cosine];
    let n = data.rows();
    let on = |skip: usize| {
        let rows: Vec<usize> = (0..n).filter(|i| i * PIECES / n != skip).collect();
        amplitudes(&columns, &data.torque, &rows)
    };
    let whole = on(PIECES);
    let parts: Vec<f64> = (0..PIECES).map(|skip| on(skip)[1]).collect();
    let middle = super::channels::mean(&parts);
    let spread: f64 = parts.iter().map(|v| (v - middle) * (v - middle)).sum();
    Friction {
        dry: whole[0].max(0.0),
        viscous: whole[1],
        viscous_std: (spread * (PIECES - 1) as f64 / PIECES as f64).sqrt(),
    }
}

/// The torque less the friction that it shows.
pub fn transmitted(data: &Channels) -> Vec<f64> {
    let friction = friction(data);
    let [sign, speed] = friction_columns(data);
    let less =
        |i: usize| data.torque[i] - friction.dry * sign[i] - friction.viscous.max(0.0) * speed[i];
    (0..data.rows()).map(less).collect()
}

/// The compliance, or why there is none. `chosen`: what else is in the twist; `structure`: nats that
/// slow structure over the angle would gain.
///
/// # Errors
/// The reason, a clause.
pub fn compliance(
    data: &Channels,
    noise: &Noise,
    chosen: &[&Atom],
    structure: f64,
    atoms: &[Atom],
) -> Result<Compliance, &'static str> {
    let nuisances = nuisances(data, chosen, structure, atoms);
    let fullest = nuisances.last().cloned().unwrap_or_default();
    let (value, stderr, own) = whitened(data, noise, &fullest);
    if value <= 0.0 {
        return Err("the twist does not grow with the torque once speed is accounted for");
    }
    let spread = spread(data, &nuisances, value);
    let std = stderr.hypot(spread);
    if std > TIGHT * value {
        return Err(
            "pieces of the record and the terms for friction and angle do not agree on one",
        );
    }
    if value * rms(&own) < STANDS_OUT * left(data, &fullest) {
        return Err("the torque's own part of the twist does not stand out from what is left");
    }
    Ok(Compliance { value, std })
}

/// Columns beside the torque: as few as chosen, with friction, and with all that the data ask for.
fn nuisances(
    data: &Channels,
    chosen: &[&Atom],
    structure: f64,
    atoms: &[Atom],
) -> Vec<Vec<Vec<f64>>> {
    let mut first: Vec<Vec<f64>> = base(data);
    first.remove(1);
    let has = |kind| chosen.iter().any(|a| a.kind == kind);
    first.extend(chosen.iter().flat_map(|a| a.columns.iter().cloned()));
    let mut all = vec![first.clone()];
    let [sign, speed] = friction_columns(data);
    if !has(Kind::Coulomb) {
        first.push(sign);
    }
    if !has(Kind::Rate) {
        first.push(speed);
    }
    all.push(first.clone());
    if structure > STRUCTURE && !has(Kind::Position) {
        let position = atoms.iter().filter(|a| a.kind == Kind::Position);
        first.extend(position.flat_map(|a| a.columns.iter().cloned()));
        all.push(first);
    }
    all
}

/// Compliance by weighted least squares, its standard error, and the torque's own part in time.
fn whitened(data: &Channels, noise: &Noise, nuisance: &[Vec<f64>]) -> (f64, f64, Vec<f64>) {
    let basis = orthonormal(nuisance.iter().map(|c| noise.whiten(c)).collect());
    let torque = without(&basis, noise.whiten(&data.torque));
    let twist = without(&basis, noise.whiten(&data.twist));
    let square = torque.norm_squared().max(f64::MIN_POSITIVE);
    let mut own: Vec<f64> = torque
        .iter()
        .zip(&noise.colour.sigma)
        .map(|(t, s)| t * s)
        .collect();
    noise.cosine.restore(&mut own);
    (-torque.dot(&twist) / square, 1.0 / square.sqrt(), own)
}

fn slices(columns: &[Vec<f64>]) -> Vec<&[f64]> {
    columns.iter().map(Vec::as_slice).collect()
}

/// What the fullest model leaves.
fn left(data: &Channels, nuisance: &[Vec<f64>]) -> f64 {
    let mut columns = slices(nuisance);
    columns.push(&data.torque);
    let rows: Vec<usize> = (0..data.rows()).collect();
    let a = amplitudes(&columns, &data.twist, &rows);
    rms(&residual(&columns, &a, &data.twist))
}

/// Root mean square deviation from `value` of what every set of nuisances says of every piece of
/// time, each weighted by how much torque of its own the piece has.
fn spread(data: &Channels, nuisances: &[Vec<Vec<f64>>], value: f64) -> f64 {
    let n = data.rows();
    let piece = |k: usize, of: usize| (n * k / of..n * (k + 1) / of).collect::<Vec<usize>>();
    let pieces: Vec<Vec<usize>> = [(0, 1), (0, 2), (1, 2), (0, 3), (1, 3), (2, 3)]
        .iter()
        .map(|(k, of)| piece(*k, *of))
        .collect();
    let (mut sum, mut weight) = (0.0, f64::MIN_POSITIVE);
    for nuisance in nuisances {
        for rows in &pieces {
            let (c, information) = plain(data, nuisance, rows);
            sum += information * (c - value) * (c - value);
            weight += information;
        }
    }
    (sum / weight).sqrt()
}

/// Compliance by plain least squares on some rows, and the sum of squares of the torque's own part.
fn plain(data: &Channels, nuisance: &[Vec<f64>], rows: &[usize]) -> (f64, f64) {
    let columns = slices(nuisance);
    let own = residual(
        &columns,
        &amplitudes(&columns, &data.torque, rows),
        &data.torque,
    );
    let (mut tt, mut ty) = (f64::MIN_POSITIVE, 0.0);
    for i in rows {
        tt += own[*i] * own[*i];
        ty += own[*i] * data.twist[*i];
    }
    (-ty / tt, tt)
}
