//! Where the discrepancy of a joint is largest, and what is left, in words.

use super::channels::{Channels, largest};
use super::columns::{Atom, Kind};
use crate::sheet::number::{engineering, significant};

/// Where a residual is largest.
pub fn place(residual: &[f64], data: &Channels) -> &'static str {
    let (top, load) = (data.top_speed(), largest(&data.torque));
    let square = |keep: &dyn Fn(usize) -> bool| {
        let inside: Vec<usize> = (0..data.rows()).filter(|i| keep(*i)).collect();
        let sum: f64 = inside.iter().map(|i| residual[*i] * residual[*i]).sum();
        match inside.len() * 20 < data.rows() {
            true => 0.0,
            false => sum / inside.len() as f64,
        }
    };
    let all = square(&|_| true).max(f64::MIN_POSITIVE);
    let places: [(&str, f64); 4] = [
        (
            "largest in fast motion",
            square(&|i| data.speed[i].abs() > 0.6 * top),
        ),
        (
            "largest in slow motion and at rest",
            square(&|i| data.speed[i].abs() < 0.1 * top),
        ),
        (
            "largest at high torque",
            square(&|i| data.torque[i].abs() > 0.7 * load),
        ),
        (
            "largest near zero torque",
            square(&|i| data.torque[i].abs() < 0.15 * load),
        ),
    ];
    let best = places.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    best.filter(|b| b.1 > 1.4 * all)
        .map_or("spread over the motion", |b| b.0)
}

/// What is seen in a residual that no cause explains: the silent terms that were found in it.
pub fn left(silent: &[(&Atom, f64)], ratio: Option<f64>) -> Option<String> {
    let said: Vec<String> = silent
        .iter()
        .map(|(atom, size)| of_atom(atom, *size, ratio))
        .collect();
    (!said.is_empty()).then(|| said.join(" and "))
}

fn of_atom(atom: &Atom, size: f64, ratio: Option<f64>) -> String {
    let size = engineering(size, 2, "rad");
    if atom.kind == Kind::Position {
        return format!("a slow change over the joint angle ({size} rms)");
    }
    let per_motor = ratio.map_or(String::new(), |r| {
        format!(", {} per turn of the motor", significant(atom.shape / r, 3))
    });
    format!(
        "a ripple of {size} rms in step with the joint ({:.0} per turn of the link{per_motor}): no encoder's own order or not steady over the speed, as meshing teeth make it",
        atom.shape
    )
}
