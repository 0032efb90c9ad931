//! A robot at one frequency: its inverse, and what small and large changes of it do to the transfer functions.

use super::dynamics::{C, Pairs, Plant};
use nalgebra::DMatrix;

/// Everything known at a line.
pub struct Line {
    pub s: C,
    pub inverse: DMatrix<C>,
    /// Z⁻¹ times the hand, n by 3.
    pub hand: DMatrix<C>,
}

pub fn whole(a: &DMatrix<f64>) -> DMatrix<C> {
    a.map(|x| C::new(x, 0.0))
}

pub fn pairs_of(a: &DMatrix<C>) -> Pairs {
    std::array::from_fn(|r| std::array::from_fn(|d| a[(r, d)]))
}

impl Line {
    pub fn new(plant: &Plant, s: C) -> Self {
        let inverse = plant.inverse(s);
        let hand = &inverse * whole(&plant.hand.transpose());
        Self { s, inverse, hand }
    }

    /// The robot's own.
    pub fn transfer(&self, plant: &Plant) -> Pairs {
        pairs_of(&(whole(&plant.hand) * &self.hand * self.s.powi(2)))
    }

    /// First order in what is added to Z along some hinges.
    pub fn springs(&self, members: &[usize], each: C) -> Pairs {
        let mut sum = DMatrix::zeros(3, 3);
        for i in members {
            let row = self.hand.row(*i);
            sum += row.transpose() * row * (-each * self.s.powi(2));
        }
        pairs_of(&sum)
    }

    /// First order in the mass matrix.
    pub fn mass(&self, more: &DMatrix<C>) -> Pairs {
        pairs_of(&(self.hand.transpose() * more * &self.hand * (-self.s.powi(4))))
    }

    /// Whole change where a low rank is added to Z: columns and their weights.
    pub fn changed(&self, columns: &DMatrix<f64>, each: &[C]) -> Pairs {
        let e = whole(columns);
        let seen = self.hand.transpose() * &e;
        let n = each.len();
        let own = e.transpose() * &self.inverse * &e
            + DMatrix::from_fn(n, n, |i, j| {
                if i == j {
                    each[i].inv()
                } else {
                    C::new(0.0, 0.0)
                }
            });
        let inner = own.try_inverse().unwrap_or_else(|| DMatrix::zeros(n, n));
        pairs_of(&(&seen * inner * seen.transpose() * (-self.s.powi(2))))
    }
}
