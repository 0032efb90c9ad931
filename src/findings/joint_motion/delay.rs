//! The delay between the encoders with an interval that holds for every account of the rest.

use super::channels::{Channels, mean};
use super::columns::{Atom, Kind, base};
use super::noise::{Noise, orthonormal, without};
use super::stiffness::Friction;
use super::unseen::amplitudes;

/// A delay of the link encoder behind the motor encoder, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Delay {
    /// Value.
    pub value: f64,
    /// Standard deviation, disagreement between the accounts included.
    pub std: f64,
    /// What the twist has in proportion to the speed, friction in the torque included, s.
    pub rate: f64,
    /// The part of it that friction in the torque channel would make, s, and its standard error.
    pub friction: [f64; 2],
}

/// Estimates it with `chosen` beside the speed; other accounts add friction and slow structure.
pub fn delay(
    data: &Channels,
    noise: &Noise,
    chosen: &[&Atom],
    atoms: &[Atom],
    friction: Friction,
) -> Delay {
    let has = |kind| chosen.iter().any(|a| a.kind == kind);
    let extra = |kind: Kind| atoms.iter().find(|a| a.kind == kind && !has(kind));
    let plain: Vec<&Atom> = chosen
        .iter()
        .copied()
        .filter(|a| a.kind != Kind::Rate)
        .collect();
    let mut accounts = vec![plain.clone()];
    for more in [
        vec![Kind::Coulomb],
        vec![Kind::Position],
        vec![Kind::Coulomb, Kind::Position],
    ] {
        let mut account = plain.clone();
        account.extend(more.into_iter().filter_map(extra));
        accounts.push(account);
    }
    let estimates: Vec<[f64; 2]> = accounts.iter().map(|a| rate(data, a)).collect();
    let corrected = |[v, t]: &[f64; 2]| -v + (-t).max(0.0) * friction.viscous.max(0.0);
    let values: Vec<f64> = estimates.iter().map(corrected).collect();
    let value = mean(&values);
    let spread = values
        .iter()
        .map(|v| (v - value) * (v - value))
        .sum::<f64>()
        / 3.0;
    Delay {
        value,
        std: spread.sqrt().hypot(stderr(data, noise, &plain)),
        rate: estimates[0][0],
        friction: [friction.viscous, friction.viscous_std].map(|f| f * (-estimates[0][1]).max(0.0)),
    }
}

/// Amplitudes of speed and torque.
fn rate(data: &Channels, account: &[&Atom]) -> [f64; 2] {
    let base = base(data);
    let mut columns: Vec<&[f64]> = vec![&data.speed, &data.torque];
    columns.extend([base[0].as_slice(), base[2].as_slice()]);
    let more = account
        .iter()
        .flat_map(|a| a.columns.iter().map(Vec::as_slice));
    columns.extend(more);
    let rows: Vec<usize> = (0..data.rows()).collect();
    let a = amplitudes(&columns, &data.twist, &rows);
    [a[0], a[1]]
}

fn stderr(data: &Channels, noise: &Noise, account: &[&Atom]) -> f64 {
    let mut columns = base(data);
    columns.extend(account.iter().flat_map(|a| a.columns.iter().cloned()));
    let basis = orthonormal(columns.iter().map(|c| noise.whiten(c)).collect());
    let own = without(&basis, noise.whiten(&data.speed));
    1.0 / own.norm().max(f64::MIN_POSITIVE)
}
