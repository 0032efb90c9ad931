//! Numbers, names and comments as controllers take them.

use crate::ground::units::DEGREE;

/// A number with at most this many decimals, without zeros at its end and without `-0`.
pub(super) fn decimals(value: f64, most: usize) -> String {
    let text = format!("{value:.most$}");
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    match text {
        "-0" => "0".into(),
        text => text.into(),
    }
}

/// A length in mm, to a nanometre.
pub(super) fn mm(metres: f64) -> String {
    decimals(metres * 1e3, 6)
}

/// An angle in degrees, to 1e-8.
pub(super) fn degrees(radians: f64) -> String {
    decimals(radians / DEGREE, 8)
}

/// Letters, digits and `_` of a name, at most `most`, beginning with a letter.
pub(super) fn identifier(name: &str, most: usize) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let kept: String = name.chars().map(plain).collect();
    let kept = match kept.starts_with(|c: char| c.is_ascii_alphabetic()) {
        true => kept,
        false => format!("p{kept}"),
    };
    kept.chars().take(most).collect()
}

/// A comment that cannot end its line or itself.
pub(super) fn comment(text: &str) -> String {
    let plain = |c: char| match c {
        '(' | '[' => '<',
        ')' | ']' => '>',
        ' '..='~' => c,
        _ => '?',
    };
    text.chars().map(plain).take(200).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_exact() {
        assert_eq!(mm(0.1234567891), "123.456789");
        assert_eq!((mm(-1e-12), mm(0.5)), ("0".into(), "500".into()));
        assert_eq!(degrees(std::f64::consts::PI), "180");
    }

    #[test]
    fn names_and_comments_are_harmless() {
        assert_eq!(identifier("7 a/b\n", 10), "p7_a_b_");
        assert_eq!(comment("a)\nb;ü"), "a>?b;?");
    }
}
