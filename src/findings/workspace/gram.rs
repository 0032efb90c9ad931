//! Products of every two columns less what the springs take of both. Columns of two points share no
//! row, so that only the part of the springs is left: it is not stored, but multiplied when asked for.

use super::columns::{Columns, Rows};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// Where a column stands.
#[derive(Debug, Clone, Copy)]
enum Place {
    /// Among those that act everywhere.
    Wide(usize),
    /// Among those of one point; its row in `beside`.
    Local {
        point: usize,
        own: usize,
        row: usize,
    },
}

/// The products.
#[derive(Debug, Clone)]
pub struct Gram {
    places: Vec<Place>,
    /// Of those that act everywhere.
    wide: DMatrix<f64>,
    /// Of those of points (rows) with those that act everywhere.
    beside: DMatrix<f64>,
    /// Of those of one point, by point.
    points: BTreeMap<usize, DMatrix<f64>>,
    /// What the springs take, one column each; none: no springs.
    taken: Option<DMatrix<f64>>,
}

impl Gram {
    /// Of columns and what the springs take of them.
    pub fn of(columns: &Columns, taken: Option<DMatrix<f64>>) -> Self {
        let mut places: Vec<Place> = Vec::new();
        let mut locals: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        let (mut wide, mut count) = (Vec::new(), 0);
        for (j, rows) in columns.all().iter().enumerate() {
            places.push(match rows {
                Rows::Wide(..) => {
                    wide.push(j);
                    Place::Wide(wide.len() - 1)
                }
                Rows::Local(point, _) => {
                    let own = locals.entry(*point).or_default();
                    own.push(j);
                    count += 1;
                    let (point, own, row) = (*point, own.len() - 1, count - 1);
                    Place::Local { point, own, row }
                }
            });
        }
        let mut gram = Self {
            wide: products(columns, &wide),
            beside: DMatrix::zeros(count, wide.len()),
            points: BTreeMap::new(),
            places,
            taken,
        };
        gram.take_from_wide(&wide);
        gram.lay_beside(columns, &wide);
        gram.lay_points(columns, &locals);
        gram
    }

    /// The product of two columns.
    pub fn of_both(&self, i: usize, j: usize) -> f64 {
        match (self.places[i], self.places[j]) {
            (Place::Wide(a), Place::Wide(b)) => self.wide[(a, b)],
            (Place::Wide(a), Place::Local { row, .. })
            | (Place::Local { row, .. }, Place::Wide(a)) => self.beside[(row, a)],
            (
                Place::Local {
                    point: p, own: a, ..
                },
                Place::Local {
                    point: q, own: b, ..
                },
            ) => match p == q {
                true => self.points[&p][(a, b)],
                false => -self.shared(i, j),
            },
        }
    }

    /// What the springs take of both.
    fn shared(&self, i: usize, j: usize) -> f64 {
        let taken = self.taken.as_ref();
        taken.map_or(0.0, |taken| taken.column(i).dot(&taken.column(j)))
    }

    fn take_from_wide(&mut self, wide: &[usize]) {
        if let Some(taken) = &self.taken {
            let own = taken.select_columns(wide);
            self.wide -= squared(&own);
        }
    }

    fn lay_beside(&mut self, columns: &Columns, wide: &[usize]) {
        for j in 0..self.places.len() {
            let (Place::Local { row, .. }, Rows::Local(_, own)) =
                (self.places[j], &columns.all()[j])
            else {
                continue;
            };
            for (a, i) in wide.iter().enumerate() {
                let Rows::Wide(slopes, _) = &columns.all()[*i] else {
                    continue;
                };
                let product: f64 = own.iter().map(|(r, x)| x * slopes[*r]).sum();
                self.beside[(row, a)] = product - self.shared(*i, j);
            }
        }
    }

    fn lay_points(&mut self, columns: &Columns, locals: &BTreeMap<usize, Vec<usize>>) {
        for (point, own) in locals {
            let product = |a: usize, b: usize| {
                let (Rows::Local(_, x), Rows::Local(_, y)) =
                    (&columns.all()[own[a]], &columns.all()[own[b]])
                else {
                    return 0.0;
                };
                let both = x.iter().zip(y).map(|((_, x), (_, y))| x * y);
                both.sum::<f64>() - self.shared(own[a], own[b])
            };
            let block = DMatrix::from_fn(own.len(), own.len(), product);
            self.points.insert(*point, block);
        }
    }
}

/// Products of columns that act everywhere, over slopes and levels.
fn products(columns: &Columns, wide: &[usize]) -> DMatrix<f64> {
    let mut heads: Vec<&DVector<f64>> = Vec::new();
    let mut tails: Vec<(usize, &DVector<f64>)> = Vec::new();
    for (a, j) in wide.iter().enumerate() {
        if let Rows::Wide(slopes, tail) = &columns.all()[*j] {
            heads.push(slopes);
            tails.extend(tail.as_ref().map(|tail| (a, tail)));
        }
    }
    let head = DMatrix::from_fn(columns.slopes(), heads.len(), |i, j| heads[j][i]);
    let mut gram = squared(&head);
    for (at, (a, x)) in tails.iter().enumerate() {
        for (b, y) in &tails[..=at] {
            let both = x.dot(y);
            gram[(*a, *b)] += both;
            if a != b {
                gram[(*b, *a)] += both;
            }
        }
    }
    gram
}

/// AᵀA of a tall matrix: a product of two matrices is blocked, `tr_mul` is not.
pub fn squared(a: &DMatrix<f64>) -> DMatrix<f64> {
    a.transpose() * a
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    /// Three columns over all 12 rows, then two for each of three points with 3 rows.
    fn columns(random: &mut Random) -> Columns {
        let mut draw = |n: usize| DVector::from_fn(n, |_, _| random.uniform(-1.0, 1.0));
        let wide: Vec<Rows> = (0..3)
            .map(|k| Rows::Wide(draw(9), (k != 1).then(|| draw(3))))
            .collect();
        let local = (0..6).map(|k| {
            let rows = (0..3).map(|r| (3 * (k / 2) + r, draw(1)[0]));
            Rows::Local(k / 2, rows.collect())
        });
        let local: Vec<Rows> = local.collect();
        Columns::new(wide.into_iter().chain(local).collect(), [9, 3])
    }

    #[test]
    fn products_are_those_of_the_full_columns() {
        let mut random = Random::new(4);
        let columns = columns(&mut random);
        let full = DMatrix::from_columns(&(0..9).map(|j| columns.column(j)).collect::<Vec<_>>());
        let springs = DMatrix::from_fn(12, 2, |i, _| match i < 9 {
            true => random.uniform(-1.0, 1.0),
            false => 0.0,
        });
        let inner = springs.tr_mul(&springs) + DMatrix::identity(2, 2);
        let root = inner.clone().cholesky().unwrap();
        let cross = springs.tr_mul(&full);
        let wanted = full.tr_mul(&full) - cross.tr_mul(&root.solve(&cross));
        let gram = Gram::of(&columns, Some(columns.taken(&springs, &root)));
        for i in 0..9 {
            for j in 0..9 {
                let apart = (gram.of_both(i, j) - wanted[(i, j)]).abs();
                assert!(apart < 1e-13, "{i} {j}: {apart}");
            }
        }
        let readings = DVector::from_fn(12, |_, _| random.uniform(-1.0, 1.0));
        let apart = columns.gradient(&readings) - full.tr_mul(&readings);
        assert!(apart.amax() < 1e-14);
    }
}
