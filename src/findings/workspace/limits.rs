//! What these points would not show: how far a spring may be off unnoticed.

use super::field::Field;
use super::seats::Seats;
use crate::causes::Blame;

/// A number that may be wrong by this much without a sign.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// The cause that would be missed.
    pub effect: &'static str,
    /// Where.
    pub site: String,
    /// Smallest relative excess of compliance that would be seen.
    pub unnoticed: f64,
}

/// No spring of a robot that still stands is this many times too soft.
const ANY: f64 = 1e3;

impl Limit {
    /// The excess from which on it would be seen; `None` if these points would never show it.
    pub fn known(&self) -> Option<f64> {
        (self.unnoticed < ANY).then_some(self.unnoticed)
    }
}

/// Nats that a cause must explain before it is named, besides its own price of freedom.
const NATS: f64 = 6.0;
/// Worth telling: a compliance may be this much too large unnoticed.
const WORTH: f64 = 1.0;

/// Every spring whose stiffness may be wrong by a factor of two and more unnoticed.
pub fn limits(seats: &Seats, field: &Field) -> Vec<Limit> {
    let numbers = seats.seats.iter();
    let numbers = numbers.filter(|s| s.cause.blame() == Blame::Parameter);
    let limit = |seat: &super::seats::Seat| {
        let precision = field.precision(seat.first).max(1e-12);
        let freedom = (1.0 + field.prior(seat.first) * precision).ln();
        Limit {
            effect: seat.cause.card().name,
            site: seat.site.clone(),
            unnoticed: (2.0 * (NATS + freedom)).sqrt() / precision,
        }
    };
    numbers.map(limit).filter(|l| l.unnoticed > WORTH).collect()
}
