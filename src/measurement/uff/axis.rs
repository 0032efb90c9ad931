//! Records 8 to 11 of data set 58: what an axis measures, and in which unit.

use super::fields::Record;
use crate::ground::problem::Outcome;

/// Physical quantity of an axis, with its code in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// 0 and every code that has no unit of its own here.
    Other(i64),
    /// 1: given by the exponents.
    General,
    /// 2
    Stress,
    /// 5
    Temperature,
    /// 8
    Displacement,
    /// 9
    ReactionForce,
    /// 11
    Velocity,
    /// 12
    Acceleration,
    /// 13
    ExcitationForce,
    /// 15
    Pressure,
    /// 16
    Mass,
    /// 17
    Time,
    /// 18
    Frequency,
}

/// Code and exponents of length, force, temperature per quantity.
const QUANTITIES: &[(Quantity, i64, [i64; 3])] = &[
    (Quantity::General, 1, [0, 0, 0]),
    (Quantity::Stress, 2, [-2, 1, 0]),
    (Quantity::Temperature, 5, [0, 0, 1]),
    (Quantity::Displacement, 8, [1, 0, 0]),
    (Quantity::ReactionForce, 9, [0, 1, 0]),
    (Quantity::Velocity, 11, [1, 0, 0]),
    (Quantity::Acceleration, 12, [1, 0, 0]),
    (Quantity::ExcitationForce, 13, [0, 1, 0]),
    (Quantity::Pressure, 15, [-2, 1, 0]),
    (Quantity::Mass, 16, [-1, 1, 0]),
    (Quantity::Time, 17, [0, 0, 0]),
    (Quantity::Frequency, 18, [0, 0, 0]),
];

impl Quantity {
    /// The quantity with this code.
    pub fn of(code: i64) -> Self {
        let found = QUANTITIES.iter().find(|row| row.1 == code);
        found.map_or(Self::Other(code), |row| row.0)
    }

    /// Its code in the file.
    pub fn code(self) -> i64 {
        let found = QUANTITIES.iter().find(|row| row.0 == self);
        match (self, found) {
            (Self::Other(code), _) => code,
            (_, row) => row.map_or(0, |row| row.1),
        }
    }

    fn exponents(self) -> [i64; 3] {
        let found = QUANTITIES.iter().find(|row| row.0 == self);
        found.map_or([0; 3], |row| row.2)
    }
}

/// One axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What it measures.
    pub quantity: Quantity,
    /// Exponents of length, force and temperature; they count for [`Quantity::General`] only.
    pub exponents: [i64; 3],
    /// Its label.
    pub label: String,
    /// Label of its unit.
    pub unit: String,
}

impl Axis {
    /// An axis of a known quantity.
    pub fn new(quantity: Quantity, label: &str, unit: &str) -> Self {
        Self {
            quantity,
            exponents: [0; 3],
            label: label.into(),
            unit: unit.into(),
        }
    }

    /// An axis that is not used.
    pub fn none() -> Self {
        Self::new(Quantity::Other(0), "NONE", "NONE")
    }

    /// Reads the record.
    pub fn parse(record: &Record) -> Outcome<Self> {
        Ok(Self {
            quantity: Quantity::of(record.integer(0, 10)?),
            exponents: [
                record.integer(10, 15)?,
                record.integer(15, 20)?,
                record.integer(20, 25)?,
            ],
            label: record.field(26, 46),
            unit: record.field(47, 67),
        })
    }

    /// The effective exponents of length, force and temperature.
    pub fn effective_exponents(&self) -> [i64; 3] {
        if self.quantity == Quantity::General {
            self.exponents
        } else {
            self.quantity.exponents()
        }
    }
}
