//! What could make a number wrong by a power of ten: a unit, or a lever.

use crate::sheet::number::significant;

/// Distance from a whole power of ten, in decades, below which that power explains a ratio.
const NEAR: f64 = 0.12;
/// Units whose confusion gives a power of ten.
const CONFUSIONS: &[(i32, &str)] = &[
    (1, "a lever or a decimal point is off by one place"),
    (2, "two decimal places"),
    (
        3,
        "kN for N, mm for m, µm for mm, or one lever in millimetres",
    ),
    (6, "µm for m, or two units a thousand times off each"),
];

/// The power of ten that a ratio is, to within `NEAR`; `None` for 1 and for anything between.
pub fn power_of_ten(ratio: f64) -> Option<i32> {
    let decades = ratio.abs().log10();
    let whole = decades.round();
    (decades.is_finite() && whole != 0.0 && (decades - whole).abs() < NEAR).then_some(whole as i32)
}

/// `1000 times`, `2.3 times`, `1/10 of`.
pub fn times(ratio: f64) -> String {
    match ratio {
        r if r >= 1.0 => format!("{} times", significant(r, if r < 10.0 { 2 } else { 3 })),
        r => format!("1/{} of", significant(1.0 / r, 2)),
    }
}

/// What would explain a ratio that is a power of ten.
pub fn explanation(ratio: f64) -> Option<String> {
    let power = power_of_ten(ratio)?;
    let by = CONFUSIONS.iter().find(|(p, _)| *p == power.abs());
    let by = by.map_or("a unit is wrong", |(_, by)| by);
    Some(format!("a factor of 10^{power} would explain it ({by})"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_powers_and_nothing_between() {
        assert_eq!(power_of_ten(1020.0), Some(3));
        assert_eq!(power_of_ten(0.097), Some(-1));
        assert_eq!(power_of_ten(1.1), None);
        assert_eq!(power_of_ten(3.0), None);
        assert_eq!(power_of_ten(0.0), None);
    }
}
