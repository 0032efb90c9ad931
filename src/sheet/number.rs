//! Numbers as an engineer writes them: significant digits, intervals, SI prefixes. Same value, same text.

/// What stands where there is no number.
pub const ABSENT: &str = "–";

/// A value with `digits` significant digits: `3.140`, `0.0125`, `3.140e5`, `-2.0e-6`; never `-0`.
///
/// ```
/// use ident::sheet::number::significant;
/// assert_eq!(significant(314_000.0, 4), "3.140e5");
/// assert_eq!(significant(-0.0, 3), "0");
/// ```
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return ABSENT.to_string();
    }
    let (decimals, exponent) = frame(value, digits.max(1));
    scaled(value, decimals, exponent)
}

/// A value with its interval: `3.142 ± 0.020` if symmetric, else `3.14 [3.10, 3.35]`. The half width
/// has two significant digits and the value as many decimals.
///
/// ```
/// use ident::sheet::number::with_interval;
/// assert_eq!(with_interval(3.1416, 3.1216, 3.1616), "3.142 ± 0.020");
/// assert_eq!(with_interval(3.14e5, 3.12e5, 3.16e5), "(3.140 ± 0.020)e5");
/// ```
pub fn with_interval(value: f64, low: f64, high: f64) -> String {
    if !value.is_finite() {
        return ABSENT.to_string();
    }
    let (below, above) = (value - low, high - value);
    let half = 0.5 * (below + above);
    if !half.is_finite() || half <= 0.0 {
        return significant(value, 4);
    }
    let exponent = frame(value.abs().max(half), 1).1;
    let last = magnitude(half, 2) - 1;
    let decimals = (exponent - last).max(0) as usize;
    let write = |v: f64| fixed(v / ten(exponent), decimals);
    let wrap = |text: String| match exponent {
        0 => text,
        e => format!("({text})e{e}"),
    };
    if (below - above).abs() <= 0.1 * half {
        return wrap(format!("{} ± {}", write(value), write(half)));
    }
    let power = if exponent == 0 {
        String::new()
    } else {
        format!("e{exponent}")
    };
    let end = |v: f64| format!("{}{power}", write(v));
    format!("{} [{}, {}]", end(value), end(low), end(high))
}

/// A value with an SI prefix before its unit: `314.0 kN·m/rad`. Units that take none are left alone.
///
/// ```
/// use ident::sheet::number::engineering;
/// assert_eq!(engineering(3.14e5, 4, "N·m/rad"), "314.0 kN·m/rad");
/// ```
pub fn engineering(value: f64, digits: usize, unit: &str) -> String {
    let (factor, unit) = prefix(value, unit);
    let number = significant(value * factor, digits);
    if unit.is_empty() {
        number
    } else {
        format!("{number} {unit}")
    }
}

/// The factor and the unit in which a value of this size is best shown: `(1e6, "µrad")` for 3e-5 rad.
/// Give it the largest magnitude on an axis and multiply the data by the factor.
pub fn prefix(largest: f64, unit: &str) -> (f64, String) {
    let plain = (1.0, unit.to_string());
    if largest == 0.0 || !largest.is_finite() || !takes_prefix(unit) {
        return plain;
    }
    // A value that rounds up to 1000 belongs to the next prefix.
    let power = magnitude(largest, 4).div_euclid(3) * 3;
    match PREFIXES.iter().find(|(exponent, _)| *exponent == power) {
        Some((exponent, sign)) => {
            let inside = unit.trim_start_matches('(');
            let bracket = &unit[..unit.len() - inside.len()];
            (ten(-exponent), format!("{bracket}{sign}{inside}"))
        }
        None => plain,
    }
}

const PREFIXES: [(i32, &str); 6] = [
    (9, "G"),
    (6, "M"),
    (3, "k"),
    (-3, "m"),
    (-6, "µ"),
    (-9, "n"),
];

fn takes_prefix(unit: &str) -> bool {
    let starts = ["N", "m", "rad", "s", "Hz", "J", "W", "Pa", "V", "A"];
    let unit = unit.trim_start_matches('(');
    let first = unit.split(['·', '/', '²', '³']).next().unwrap_or("");
    // k(m²) is not km²: a squared first unit takes no prefix.
    let powered = unit[first.len()..].starts_with(['²', '³']);
    starts.contains(&first) && !powered
}

/// Decimal exponent of a value after rounding to `digits` significant digits.
fn magnitude(value: f64, digits: usize) -> i32 {
    let text = format!("{:.*e}", digits.saturating_sub(1), value.abs());
    let exponent = text.split_once('e').and_then(|(_, e)| e.parse().ok());
    exponent.unwrap_or(0)
}

/// Decimals and power of ten with which `value` shows `digits` significant digits.
fn frame(value: f64, digits: usize) -> (usize, i32) {
    if value == 0.0 {
        return (0, 0);
    }
    let size = magnitude(value, digits);
    let last = digits as i32 - 1;
    match size {
        -3..=4 => ((last - size).max(0) as usize, 0),
        _ => (last as usize, size),
    }
}

fn scaled(value: f64, decimals: usize, exponent: i32) -> String {
    if exponent == 0 {
        return fixed(value, decimals);
    }
    // The exponent format rounds exactly, a division would not.
    format!("{value:.decimals$e}")
}

/// Fixed decimals, never `-0`.
pub fn fixed(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return ABSENT.to_string();
    }
    if value.abs() >= LONG {
        return significant(value, 4);
    }
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_string(),
        _ => text,
    }
}

/// From here on a number is written with its power of ten.
const LONG: f64 = 1e9;

fn ten(exponent: i32) -> f64 {
    10f64.powi(exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits() {
        assert_eq!(significant(1.5, 3), "1.50");
        assert_eq!(significant(99_999.6, 4), "1.000e5");
        assert_eq!(significant(0.001234, 3), "0.00123");
        assert_eq!(significant(-2e-6, 2), "-2.0e-6");
        assert_eq!(significant(12345.0, 3), "12345");
        assert_eq!(significant(f64::NAN, 3), ABSENT);
        assert_eq!(fixed(-0.001, 2), "0.00");
    }

    #[test]
    fn intervals() {
        assert_eq!(with_interval(2.14, 2.10, 2.35), "2.14 [2.10, 2.35]");
        assert_eq!(
            with_interval(3.14e5, 3.1e5, 3.5e5),
            "3.14e5 [3.10e5, 3.50e5]"
        );
        assert_eq!(with_interval(2.0, f64::NEG_INFINITY, 3.0), "2.000");
        assert_eq!(with_interval(0.0, -0.01, 0.01), "0.000 ± 0.010");
        assert_eq!(with_interval(1234.0, 1034.0, 1434.0), "1234 ± 200");
        assert_eq!(with_interval(f64::NAN, 0.0, 1.0), ABSENT);
    }

    #[test]
    fn prefixes() {
        assert_eq!(engineering(3.1e-5, 2, "rad"), "31 µrad");
        assert_eq!(engineering(0.0, 2, "rad"), "0 rad");
        assert_eq!(engineering(2e-3, 2, "m"), "2.0 mm");
        assert_eq!(engineering(12.0, 2, "%"), "12 %");
        assert_eq!(engineering(0.02, 2, "m²"), "0.020 m²");
        assert_eq!(engineering(999.99, 3, "N"), "1.00 kN");
        assert_eq!(engineering(1e20, 3, "N"), "1.00e20 N");
    }
}
