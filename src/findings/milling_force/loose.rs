//! What of the process is uncertain although nothing is wrong.

use super::setting::Places;

/// A direction of the vector that is uncertain although nothing is wrong.
#[derive(Debug, Clone, PartialEq)]
pub struct Loose {
    /// Its places, with how far each goes.
    pub along: Vec<(usize, f64)>,
    /// Its standard deviation before the data; infinite: nothing is known.
    pub spread: f64,
}

impl Loose {
    /// One place.
    pub fn place(place: usize, spread: f64) -> Self {
        Self {
            along: vec![(place, 1.0)],
            spread,
        }
    }

    /// A direction of the vector of which nothing is known.
    pub fn along(direction: &[f64]) -> Self {
        let each = direction.iter().copied().enumerate();
        Self {
            along: each.filter(|(_, d)| *d != 0.0).collect(),
            spread: f64::INFINITY,
        }
    }

    /// One unit of it.
    pub fn direction(&self, places: Places) -> Vec<f64> {
        let mut to = vec![0.0; places.len()];
        self.add_to(&mut to, 1.0);
        to
    }

    /// Adds an amount of it to a vector.
    pub fn add_to(&self, to: &mut [f64], amount: f64) {
        let each = self.along.iter();
        each.for_each(|(place, factor)| to[*place] += factor * amount);
    }
}
