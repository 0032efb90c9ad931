//! Text in a figure: kept as text, its width estimated, exponents raised.

use super::super::escape::escape;
use std::fmt::Write as _;

/// Regular text colour.
pub(super) const BLACK: &str = "#1a1a1a";
/// Text of the second rank.
pub(super) const GREY: &str = "#555555";

/// Where a text is anchored at its x.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// One line of text at a baseline.
#[derive(Debug, Clone)]
pub(super) struct Letters<'a> {
    pub text: &'a str,
    pub x: f64,
    pub y: f64,
    pub size: f64,
    pub anchor: Anchor,
    pub fill: &'a str,
    pub bold: bool,
    /// Degrees about (x, y), clockwise.
    pub turn: f64,
}

impl<'a> Letters<'a> {
    pub fn new(text: &'a str, x: f64, y: f64, size: f64) -> Self {
        Self {
            text,
            x,
            y,
            size,
            anchor: Anchor::Start,
            fill: BLACK,
            bold: false,
            turn: 0.0,
        }
    }

    pub fn anchored(mut self, anchor: Anchor) -> Self {
        self.anchor = anchor;
        self
    }

    pub fn filled(mut self, fill: &'a str) -> Self {
        self.fill = fill;
        self
    }

    pub fn bold(mut self) -> Self {
        self.bold = true;
        self
    }

    pub fn turned(mut self, degrees: f64) -> Self {
        self.turn = degrees;
        self
    }

    pub fn write(&self, out: &mut String) {
        let (x, y) = (px(self.x), px(self.y));
        let anchor = match self.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let bold = if self.bold {
            " font-weight=\"bold\""
        } else {
            ""
        };
        let turn = match self.turn {
            0.0 => String::new(),
            degrees => format!(" transform=\"rotate({} {x} {y})\"", px(degrees)),
        };
        let (size, fill) = (px(self.size), self.fill);
        let body = raised(self.text, self.size);
        // Some viewers drop a space where a part begins.
        let keep = if body.contains("<tspan") {
            " xml:space=\"preserve\""
        } else {
            ""
        };
        let _ = writeln!(
            out,
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{fill}\"{anchor}{bold}{turn}{keep}>{body}</text>"
        );
    }
}

/// The one place where numbers of a figure are rounded: two decimals at most, never `-0`.
pub(super) fn px(value: f64) -> String {
    let cents = (value * 100.0).round();
    if !cents.is_finite() {
        return "0".to_string();
    }
    let text = format!("{:.2}", (cents + 0.0) / 100.0);
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }.to_string()
}

const RAISED: [(char, char); 11] = [
    ('⁰', '0'),
    ('¹', '1'),
    ('²', '2'),
    ('³', '3'),
    ('⁴', '4'),
    ('⁵', '5'),
    ('⁶', '6'),
    ('⁷', '7'),
    ('⁸', '8'),
    ('⁹', '9'),
    ('⁻', '−'),
];

fn lowered(c: char) -> Option<char> {
    RAISED
        .iter()
        .find(|(high, _)| *high == c)
        .map(|(_, low)| *low)
}

/// Escaped text; superscripts become raised digits, which every font has.
fn raised(text: &str, size: f64) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(|c| lowered(c).is_some()) {
        let tail = &rest[start..];
        let end = tail.find(|c| lowered(c).is_none()).unwrap_or(tail.len());
        let digits: String = tail[..end].chars().filter_map(lowered).collect();
        out.push_str(&escape(&rest[..start]));
        let (up, small) = (0.36 * size, 0.72 * size);
        let _ = write!(
            out,
            "<tspan dy=\"{}\" font-size=\"{}\">{digits}</tspan>",
            px(-up),
            px(small)
        );
        rest = &tail[end..];
        if !rest.is_empty() {
            // Come back to the baseline with the next text.
            let end = rest.find(|c| lowered(c).is_some()).unwrap_or(rest.len());
            let text = escape(&rest[..end]).into_owned();
            let _ = write!(out, "<tspan dy=\"{}\">{text}</tspan>", px(up));
            rest = &rest[end..];
        }
    }
    out.push_str(&escape(rest));
    out
}

/// Estimated width of a text in Helvetica or one of its look-alikes.
pub(super) fn width(text: &str, size: f64) -> f64 {
    text.chars().map(advance).sum::<f64>() * size
}

fn advance(c: char) -> f64 {
    match c {
        'i' | 'j' | 'l' | '\'' | '|' => 0.22,
        '.' | ',' | ':' | ';' | ' ' | '/' | '!' | 't' | 'f' | 'I' | '[' | ']' | '·' => 0.28,
        '(' | ')' | '-' | 'r' | '"' | '°' => 0.34,
        'm' | 'w' | 'M' | '%' | '—' => 0.86,
        'W' | '@' => 0.98,
        '−' | '+' | '±' | '=' | '<' | '>' => 0.585,
        c if lowered(c).is_some() => 0.42,
        c if c.is_ascii_uppercase() => 0.69,
        c if c.is_ascii() || c.is_alphabetic() && (c as u32) < 0x2000 => 0.556,
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_in_one_place() {
        assert_eq!(px(1.0 / 3.0), "0.33");
        assert_eq!(px(-0.001), "0");
        assert_eq!(px(120.0), "120");
        assert_eq!(px(f64::NAN), "0");
    }

    #[test]
    fn raises_exponents_and_comes_back() {
        let text = raised("10⁻⁶ rad", 10.0);
        let up = "10<tspan dy=\"-3.6\" font-size=\"7.2\">−6</tspan>";
        assert_eq!(text, format!("{up}<tspan dy=\"3.6\"> rad</tspan>"));
    }
}
