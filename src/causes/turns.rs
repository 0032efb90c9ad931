//! A compliance against turning about any axis through a point, or against shifting along any: a symmetric matrix
//! that is nowhere negative, as six amounts xx, yy, zz, yz, zx, xy. A loose corner bolt rocks a foundation about
//! its diagonal.

use super::contract::Amount;
use super::places::{Said, added, said_added};
use crate::ground::spatial::V3;
use crate::ground::stats::descending;
use nalgebra::{Matrix3, SymmetricEigen};

/// How many amounts one matrix takes.
pub const SIX: usize = 6;
/// Row and column of each of the six.
pub const PLACES: [(usize, usize); SIX] = [(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)];

/// The part of a compliance that two axes share: zero where the principal axes are those of the frame.
pub const fn shared(name: &'static str, meaning: &'static str) -> Amount {
    Amount {
        bounds: [-100.0, 100.0],
        ..added(name, meaning)
    }
}

/// Six amounts of ordinary size: with these as standard deviations a matrix is as likely in one frame as in any
/// other, for then its density depends on the sum of the squares of all nine entries alone.
pub fn sizes(own: f64) -> [f64; SIX] {
    let both = own * std::f64::consts::FRAC_1_SQRT_2;
    [own, own, own, both, both, both]
}

/// The matrix of as many of the six amounts as are given.
pub fn matrix(amounts: &[f64]) -> Matrix3<f64> {
    let mut all = Matrix3::zeros();
    for ((i, j), amount) in PLACES.into_iter().zip(amounts) {
        all[(i, j)] = *amount;
        all[(j, i)] = *amount;
    }
    all
}

/// Brings six amounts to the nearest matrix that is nowhere negative (Higham 1988).
pub fn not_negative(amounts: &mut [f64]) {
    if is_straight(amounts) {
        let straight = amounts.iter_mut().take(3);
        straight.for_each(|a| *a = a.max(0.0));
        return;
    }
    let mut own = SymmetricEigen::new(matrix(amounts));
    own.eigenvalues.apply(|x| *x = x.max(0.0));
    let all = own.recompose();
    for (amount, place) in amounts.iter_mut().zip(PLACES) {
        *amount = all[place];
    }
}

/// Row and column of each of the six numbers of a lower root, each at the place of the amount that it makes.
pub const LOWER: [(usize, usize); SIX] = [(0, 0), (1, 1), (2, 2), (2, 1), (2, 0), (1, 0)];

/// The six amounts of the matrix with this lower root: nowhere negative, whatever the root.
pub fn squared(root: &[f64]) -> [f64; SIX] {
    let mut lower = Matrix3::zeros();
    for (place, value) in LOWER.into_iter().zip(root) {
        lower[place] = *value;
    }
    let all = lower * lower.transpose();
    PLACES.map(|place| all[place])
}

/// Whether the axes of a matrix are those of its frame.
fn is_straight(amounts: &[f64]) -> bool {
    amounts.iter().skip(3).all(|a| *a == 0.0)
}

/// One axis of a compliance: direction, unit length, and amount.
pub type Axis = (V3, f64);

/// Three axes with the compliance of six amounts, each called after the axis of the frame that it starts from: LDLᵀ.
/// They change smoothly with the amounts, and without shared parts they are the axes of the frame.
pub fn axes(amounts: &[f64]) -> [Axis; 3] {
    let mut own = amounts.to_vec();
    not_negative(&mut own);
    let mut rest = matrix(&own);
    let least = 1e-12 * rest.trace();
    [0, 1, 2].map(|k| {
        let pivot = rest[(k, k)];
        let mut axis = [0.0; 3];
        axis[k] = 1.0;
        if pivot <= least {
            return (axis, 0.0);
        }
        let column = rest.column(k) / pivot;
        rest -= pivot * column * column.transpose();
        let length = column.norm();
        (
            [0, 1, 2].map(|i| column[i] / length),
            pivot * length * length,
        )
    })
}

/// How what is reported of a matrix is called: stiffnesses along the axes of the frame, those along its principal
/// axes, and the softest of these.
pub struct Names {
    /// Along x, y, z.
    pub straight: [&'static str; 3],
    /// Softest first.
    pub principal: [&'static str; 3],
    /// Its components in the frame, unit length.
    pub softest: [&'static str; 3],
}

/// Of turns.
pub const TURNS: Names = Names {
    straight: ["stiffness_x", "stiffness_y", "stiffness_z"],
    principal: ["stiffness_softest", "stiffness_second", "stiffness_third"],
    softest: ["softest_axis_x", "softest_axis_y", "softest_axis_z"],
};

/// What is reported of six amounts: stiffnesses about the axes of the frame; with shared parts those about the
/// principal axes, and the softest of these.
pub fn said_matrix(amounts: &[f64], names: &Names) -> Said {
    let said = |(name, amount): (&&'static str, f64)| said_added(name, amount);
    if is_straight(amounts) {
        let own = amounts.iter().copied();
        return names.straight.iter().zip(own).flat_map(said).collect();
    }
    let own = SymmetricEigen::new(matrix(amounts));
    let order = descending(own.eigenvalues.as_slice());
    let softest = own.eigenvalues[order[0]];
    let kept = order.iter().map(|k| own.eigenvalues[*k]);
    let kept = kept.filter(|amount| *amount > LEAST * softest);
    let stiffness = names.principal.iter().zip(kept).flat_map(said);
    let axis = own.eigenvectors.column(order[0]);
    let sign = axis[axis.iamax()].signum();
    let along = names.softest.into_iter().zip(axis.iter());
    let along = along.map(|(name, x)| (name, sign * x, "1"));
    stiffness.chain(along).collect()
}

/// A stiffness this many times that of the softest axis is none to speak of.
const LEAST: f64 = 1e-3;

#[cfg(test)]
mod tests {
    use super::*;

    /// Of one soft axis (0.6, 0, 0.8) with a compliance of 5, and 0.5 about all.
    const OBLIQUE: [f64; SIX] = [2.3, 0.5, 3.7, 0.0, 2.4, 0.0];

    #[test]
    fn axes_carry_the_whole_compliance() {
        let carried = axes(&OBLIQUE).iter().fold(Matrix3::zeros(), |sum, (u, a)| {
            let u = nalgebra::Vector3::from(*u);
            assert!((u.norm() - 1.0).abs() < 1e-12 && *a > 0.0);
            sum + *a * u * u.transpose()
        });
        assert!((carried - matrix(&OBLIQUE)).norm() < 1e-12);
    }

    #[test]
    fn straight_amounts_are_the_axes_of_the_frame() {
        let [x, y, z] = axes(&[1.0, 0.0, 2.0]);
        assert_eq!(x, ([1.0, 0.0, 0.0], 1.0));
        assert_eq!((y.1, z), (0.0, ([0.0, 0.0, 1.0], 2.0)));
    }

    #[test]
    fn no_axis_is_left_with_less_than_nothing() {
        let mut shared = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        not_negative(&mut shared);
        let own = SymmetricEigen::new(matrix(&shared)).eigenvalues;
        assert!(own.min() > -1e-12 && own.max() > 1.0, "{own}");
        let mut fine = OBLIQUE;
        not_negative(&mut fine);
        let moved = fine.iter().zip(OBLIQUE).map(|(a, b)| (a - b).abs());
        assert!(moved.fold(0.0, f64::max) < 1e-12);
    }

    #[test]
    fn what_a_root_makes_is_nowhere_negative() {
        let made = squared(&[1.0, 0.0, 0.5, -0.3, 2.0, 0.7]);
        assert_eq!(made[5], 0.7);
        let own = SymmetricEigen::new(matrix(&made)).eigenvalues;
        assert!(own.min() > -1e-12, "{own}");
    }

    #[test]
    fn the_softest_axis_is_told() {
        let said = said_matrix(&OBLIQUE, &TURNS);
        let of = |name: &str| said.iter().find(|s| s.0 == name).map_or(f64::NAN, |s| s.1);
        assert!(
            (of("stiffness_softest") - 1e7 / 5.5).abs() < 1.0,
            "{said:?}"
        );
        let axis = ["x", "y", "z"].map(|k| of(&format!("softest_axis_{k}")));
        let off = axis.iter().zip([0.6, 0.0, 0.8]).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-9, "{axis:?}");
    }
}
