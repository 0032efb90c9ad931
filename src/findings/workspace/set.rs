//! A set of causes with what the data say of it.

use super::field::Field;
use super::seats::{Form, Seats};
use crate::findings::engine::posterior::Weighed;

/// A set of seats, each in one form.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Set {
    /// The seats, ascending.
    pub seats: Vec<usize>,
    /// The best form of each.
    pub forms: Vec<usize>,
    /// Logarithm of evidence times odds, over all forms compared.
    pub score: f64,
    /// Misfit that the best forms explain, nats.
    pub nats: f64,
    /// Score of the best forms alone.
    pub best: f64,
}

impl Weighed for Set {
    fn suspects(&self) -> &[usize] {
        &self.seats
    }

    fn score(&self) -> f64 {
        self.score
    }
}

impl Set {
    /// Of one choice of forms, ascending.
    pub fn of(seats: &Seats, field: &Field, forms: &[usize]) -> Self {
        let own: Vec<&Form> = forms.iter().map(|f| &seats.forms[*f]).collect();
        let columns: Vec<usize> = own.iter().flat_map(|f| f.columns.clone()).collect();
        let widths: Vec<f64> = own
            .iter()
            .flat_map(|f| std::iter::repeat_n(f.width, f.columns.len()))
            .collect();
        let amounts = field.amounts(&columns, |i| widths[i]);
        let weight: f64 = own.iter().map(|form| form.weight).sum();
        let held: Vec<usize> = own.iter().map(|form| form.seat).collect();
        let score = amounts.evidence + weight + seats.odds(&held);
        Self {
            seats: held,
            forms: forms.to_vec(),
            score,
            nats: amounts.nats,
            best: score,
        }
    }
}
