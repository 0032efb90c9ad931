//! Uncertain numbers of bodies: mass, centre and inertia of every link and of the tool, and what each does
//! to the mass matrix of the elastic coordinates. That matrix is linear in mass, first moment and inertia
//! about a fixed point, so that a direction holds however far one goes along it.

use crate::ground::problem::Outcome;
use crate::ground::stats::descending;
use crate::motion::{Work, elastic, linearise};
use crate::robot::{Body, Robot};
use nalgebra::{DMatrix, DVector};

/// Uncertain numbers of a body: mass, three of its centre, six of its inertia.
pub const NUMBERS: usize = 10;

/// How well bodies are known: one standard deviation each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Of a mass, relative; the inertia goes with it.
    pub mass: f64,
    /// Of each coordinate of a centre, m.
    pub centre_m: f64,
    /// Of an inertia about the centre, relative; of a product of inertia, times the root of the two
    /// moments it belongs to.
    pub inertia: f64,
}

/// What one standard deviation of every uncertain number adds to the mass matrix of `robot` at the angles
/// `angles` of its hinges (rad): one row per number, links first, then the tool; each row the upper
/// triangle by rows. A row of zeros where there is no body.
///
/// # Errors
/// Nothing elastic.
pub fn directions(robot: &Robot, angles: &[f64], spread: &Spread) -> Outcome<DMatrix<f64>> {
    let mass = |robot: &Robot| -> Outcome<Vec<f64>> {
        let chain = elastic(robot);
        Ok(linearise(&chain, &mut Work::new(&chain), angles)?.mass)
    };
    let own = mass(robot)?;
    let n = own.len().isqrt();
    let mut out = DMatrix::zeros(NUMBERS * (robot.dof() + 1), n * (n + 1) / 2);
    for number in 0..out.nrows() {
        let mut other = robot.clone();
        let Some(body) = body(&mut other, number / NUMBERS) else {
            continue;
        };
        disturb(body, number % NUMBERS, spread);
        let moved = mass(&other)?;
        for (place, (i, j)) in triangle(n).enumerate() {
            out[(number, place)] = moved[i * n + j] - own[i * n + j];
        }
    }
    Ok(out)
}

/// Unit combinations of numbers, one per row, the best seen first: those that move what is measured by
/// more than `least` standard deviations of its noise, at most `most`. `information`: JᵀJ of the weighted
/// slopes in the numbers.
pub fn seen(information: DMatrix<f64>, least: f64, most: usize) -> DMatrix<f64> {
    let eigen = information.symmetric_eigen();
    let mut order = descending(eigen.eigenvalues.as_slice());
    order.retain(|i| eigen.eigenvalues[*i] > least * least);
    order.truncate(most);
    eigen.eigenvectors.select_columns(&order).transpose()
}

/// Adds the `amounts` (standard deviations) of the rows of `directions` to a mass matrix (n×n by rows).
pub fn add(mass: &mut [f64], directions: &DMatrix<f64>, amounts: impl Iterator<Item = f64>) {
    let n = mass.len().isqrt();
    let amounts = DVector::from_vec(amounts.collect());
    let rows = directions.rows(0, amounts.len());
    let more = rows.tr_mul(&amounts);
    for ((i, j), more) in triangle(n).zip(more.iter()) {
        mass[i * n + j] += more;
        if i != j {
            mass[j * n + i] += more;
        }
    }
}

/// Upper triangle by rows.
pub fn triangle(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i..n).map(move |j| (i, j)))
}

fn body(robot: &mut Robot, index: usize) -> Option<&mut Body> {
    match index < robot.dof() {
        true => robot.joints[index].link.as_mut(),
        false => robot.tool.body.as_mut(),
    }
}

fn disturb(body: &mut Body, number: usize, spread: &Spread) {
    let [xx, yy, zz, ..] = body.inertia;
    match number {
        0 => {
            body.mass *= 1.0 + spread.mass;
            body.inertia
                .iter_mut()
                .for_each(|i| *i *= 1.0 + spread.mass);
        }
        1..=3 => body.com[number - 1] += spread.centre_m,
        4..=6 => body.inertia[number - 4] *= 1.0 + spread.inertia,
        7 => body.inertia[3] += spread.inertia * (xx * yy).sqrt(),
        8 => body.inertia[4] += spread.inertia * (xx * zz).sqrt(),
        _ => body.inertia[5] += spread.inertia * (yy * zz).sqrt(),
    }
}
