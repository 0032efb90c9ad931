//! Round numbers along an axis, written without floating noise.

use super::letters::width;
use super::scale::Scale;

/// One tick; minor ones have no label.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    /// Coordinate on the scale.
    pub at: f64,
    pub label: String,
}

/// The ticks of an axis and the power of ten taken out of their labels.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Ticks {
    pub major: Vec<Tick>,
    pub minor: Vec<f64>,
    pub exponent: i32,
}

/// Ticks for an axis of this length whose labels stand side by side (x) or above each other (y).
pub(super) fn ticks(scale: &Scale, unit: &str, length: f64, size: f64, along: bool) -> Ticks {
    if !scale.filled {
        return Ticks::default();
    }
    let room = match (along, scale.log) {
        (true, _) => 65.0,
        (false, true) => 22.0,
        (false, false) => 34.0,
    };
    let most = (length / room).clamp(2.0, 10.0) as usize;
    let fits = |ticks: &Ticks| !overlaps(ticks, scale, length, size, along);
    let tries = (2..=most).rev().map(|count| make(scale, unit, count));
    let mut last = Ticks::default();
    for ticks in tries {
        if fits(&ticks) {
            return ticks;
        }
        last = ticks;
    }
    last
}

fn make(scale: &Scale, unit: &str, count: usize) -> Ticks {
    if scale.log {
        decades(scale, count)
    } else {
        linear(scale, unit, count)
    }
}

fn overlaps(ticks: &Ticks, scale: &Scale, length: f64, size: f64, along: bool) -> bool {
    let per_unit = length / (scale.high - scale.low);
    ticks.major.windows(2).any(|pair| {
        let gap = (pair[1].at - pair[0].at).abs() * per_unit;
        let room = match along {
            true => 0.5 * (width(&pair[0].label, size) + width(&pair[1].label, size)) + size,
            false => 1.4 * size,
        };
        gap < room
    })
}

/// A step of `digit` times ten to the `power`: what a tick label is computed from, in integers.
#[derive(Debug, Clone, Copy)]
struct Step {
    digit: i64,
    power: i32,
}

impl Step {
    fn value(self, times: i64) -> f64 {
        // Parsed, not multiplied: 3·0.1 must be 0.3.
        let text = format!("{}e{}", times * self.digit, self.power);
        text.parse().unwrap_or(0.0)
    }
}

fn linear(scale: &Scale, unit: &str, count: usize) -> Ticks {
    let span = scale.high - scale.low;
    let step = step(span, unit, count);
    let size = step.value(1);
    let first = (scale.low / size - 1e-9).ceil() as i64;
    let last = (scale.high / size + 1e-9).floor() as i64;
    let times: Vec<i64> = (first..=last).collect();
    let largest = times
        .iter()
        .map(|t| (t * step.digit).abs())
        .max()
        .unwrap_or(0);
    let exponent = factor(largest, step.power);
    let label = |t: &i64| decimal(t * step.digit, step.power - exponent);
    let tick = |t: &i64| Tick {
        at: step.value(*t),
        label: label(t),
    };
    Ticks {
        major: times.iter().map(tick).collect(),
        minor: Vec::new(),
        exponent,
    }
}

fn step(span: f64, unit: &str, count: usize) -> Step {
    let raw = span / count as f64;
    let degrees = [15, 30, 45, 90, 180, 360];
    if unit == "°" && raw > 10.0 {
        let digit = degrees.into_iter().find(|d| *d as f64 >= raw);
        return Step {
            digit: digit.unwrap_or(720),
            power: 0,
        };
    }
    let power = raw.log10().floor() as i32;
    let digit = raw / 10f64.powi(power);
    let round = [1, 2, 5].into_iter().find(|d| *d as f64 >= digit - 1e-9);
    match round {
        Some(digit) => Step { digit, power },
        None => Step {
            digit: 1,
            power: power + 1,
        },
    }
}

/// Power of ten, a multiple of three, to take out of numbers that are long to write.
fn factor(largest: i64, power: i32) -> i32 {
    if largest == 0 {
        return 0;
    }
    let size = largest.ilog10() as i32 + power;
    if (-2..5).contains(&size) {
        0
    } else {
        size.div_euclid(3) * 3
    }
}

/// `mantissa`·10^`power` in plain digits with a typographic minus.
fn decimal(mantissa: i64, power: i32) -> String {
    let sign = if mantissa < 0 { "−" } else { "" };
    let digits = mantissa.unsigned_abs().to_string();
    if mantissa == 0 {
        return match power {
            p if p < 0 => format!("0.{}", "0".repeat(p.unsigned_abs() as usize)),
            _ => "0".to_string(),
        };
    }
    if power >= 0 {
        return format!("{sign}{digits}{}", "0".repeat(power as usize));
    }
    let decimals = power.unsigned_abs() as usize;
    let digits = format!("{digits:0>width$}", width = decimals + 1);
    let (whole, part) = digits.split_at(digits.len() - decimals);
    format!("{sign}{whole}.{part}")
}

fn decades(scale: &Scale, count: usize) -> Ticks {
    let first = (scale.low - 1e-9).ceil() as i32;
    let last = (scale.high + 1e-9).floor() as i32;
    if last - first < 1 {
        return within_a_decade(scale, count);
    }
    let stride = ((last - first) as usize / count + 1) as i32;
    let plain = first >= -2 && last <= 4;
    let powers = (first..=last).filter(|power| power.rem_euclid(stride) == 0);
    let tick = |power: i32| Tick {
        at: f64::from(power),
        label: if plain {
            decimal(1, power)
        } else {
            format!("10{}", superscript(power))
        },
    };
    Ticks {
        major: powers.map(tick).collect(),
        minor: match stride {
            1 => ninths(scale),
            _ => (first..=last).map(f64::from).collect(),
        },
        exponent: 0,
    }
}

fn ninths(scale: &Scale) -> Vec<f64> {
    let decades = (scale.low.floor() as i32)..=(scale.high.floor() as i32);
    let all = decades.flat_map(|d| (2..10).map(move |k| f64::from(d) + f64::from(k).log10()));
    all.filter(|at| (scale.low..=scale.high).contains(at))
        .collect()
}

/// A log axis that spans less than two powers of ten is labelled at round numbers.
fn within_a_decade(scale: &Scale, count: usize) -> Ticks {
    let plain = Scale {
        log: false,
        low: 10f64.powf(scale.low),
        high: 10f64.powf(scale.high),
        filled: true,
    };
    let candidates = [count, 2 * count, 4 * count].map(|n| linear(&plain, "", n));
    let positive = |tick: &Tick| tick.at > 0.0;
    let mut ticks = candidates
        .into_iter()
        .find(|t| t.major.iter().filter(|t| positive(t)).count() > 1);
    let ticks = ticks.get_or_insert_with(Ticks::default);
    ticks.major.retain(positive);
    ticks
        .major
        .iter_mut()
        .for_each(|tick| tick.at = tick.at.log10());
    std::mem::take(ticks)
}

/// An integer in superscript characters.
pub(super) fn superscript(number: i32) -> String {
    let raise = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    number.to_string().chars().map(raise).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64, log: bool, unit: &str) -> (Vec<String>, i32) {
        let scale = Scale {
            log,
            low,
            high,
            filled: true,
        };
        let ticks = ticks(&scale, unit, 500.0, 14.0, true);
        (
            ticks.major.into_iter().map(|t| t.label).collect(),
            ticks.exponent,
        )
    }

    #[test]
    fn round_numbers_without_noise() {
        assert_eq!(
            labels(-0.31, 0.31, false, "").0,
            ["−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3"]
        );
        let (texts, exponent) = labels(-4e-5, 4.1e-5, false, "rad");
        assert_eq!((texts[0].as_str(), exponent), ("−40", -6));
        assert_eq!(labels(0.0, 2.5e6, false, "").1, 6);
        assert_eq!(labels(-185.0, 185.0, false, "°").0.first().unwrap(), "−180");
    }

    #[test]
    fn powers_of_ten() {
        assert_eq!(
            labels(-6.0, -2.0, true, "").0,
            ["10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²"]
        );
        assert_eq!(labels(0.0, 2.0, true, "").0, ["1", "10", "100"]);
        assert!(labels(0.1, 0.6, true, "").0.len() > 1);
    }

    #[test]
    fn labels_never_touch() {
        for power in -12..12 {
            for low in [-1.0, 0.0, 0.999] {
                let ten = 10f64.powi(power);
                let scale = Scale::of(false, [low * ten, ten].into_iter(), 0.02);
                let made = ticks(&scale, "", 300.0, 14.0, true);
                assert!(made.major.len() > 1, "{low} {power}");
                assert!(!overlaps(&made, &scale, 300.0, 14.0, true), "{made:?}");
            }
        }
    }
}
