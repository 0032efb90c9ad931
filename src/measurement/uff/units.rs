//! Data set 164: units.

use super::axis::Axis;
use super::blocks::cut_off;
use super::fields::Record;
use super::function::{Abscissa, Function};
use crate::ground::problem::{Outcome, Problem};

/// Units of a universal file: `SI = value / factor`.
#[derive(Debug, Clone, PartialEq)]
pub struct Units {
    /// 1 SI, 2 ft lbf, 3 m kgf, 4 ft pdl, 5 mm mN, 6 cm cN, 7 in lbf, 8 mm kgf, 9 as given.
    pub code: i64,
    /// Their description.
    pub description: String,
    /// Factors of length, force and temperature.
    pub factors: [f64; 3],
    /// Offset of the temperature.
    pub temperature_offset: f64,
}

impl Default for Units {
    fn default() -> Self {
        Self {
            code: 1,
            description: "SI: Meter (newton)".into(),
            factors: [1.0; 3],
            temperature_offset: 273.15,
        }
    }
}

/// Reads the records.
pub fn parse(records: &[Record]) -> Outcome<Units> {
    let [first, second, ..] = records else {
        return Err(cut_off(records.first().map_or(1, |r| r.line)));
    };
    let factors = [
        second.number(0, 25)?,
        second.number(25, 50)?,
        second.number(50, 75)?,
    ];
    if factors[..2].iter().any(|f| !(*f > 0.0 && f.is_finite())) {
        return Err(Problem::new(
            "a unit factor is not positive",
            "correct the factors of length and force in data set 164",
        )
        .at_line(second.line));
    }
    Ok(Units {
        code: first.integer(0, 10)?,
        description: first.field(10, 30),
        factors,
        temperature_offset: records.get(2).map_or(Ok(0.0), |r| r.number(0, 25))?,
    })
}

impl Units {
    /// Factor from SI to the file for an axis.
    pub fn factor(&self, axis: &Axis) -> f64 {
        let exponents = axis.effective_exponents();
        let powers = self.factors.iter().zip(exponents).filter(|(_, e)| *e != 0);
        powers.map(|(f, e)| f.powi(e.clamp(-9, 9) as i32)).product()
    }

    /// The same function in SI.
    pub fn to_si(&self, function: &Function) -> Function {
        let mut si = function.clone();
        let [abscissa, ordinate, denominator, _] = &function.axes;
        si.values = function
            .values
            .scaled(self.factor(denominator) / self.factor(ordinate));
        let place = 1.0 / self.factor(abscissa);
        si.abscissa = match &function.abscissa {
            Abscissa::Even { start, step } => Abscissa::Even {
                start: start * place,
                step: step * place,
            },
            Abscissa::Uneven(places) => {
                Abscissa::Uneven(places.iter().map(|p| p * place).collect())
            }
        };
        si
    }
}
