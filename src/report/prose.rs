//! Sentences and cells as HTML: what is typed as code, no line break within a number.

use super::escape::escape;

/// Text in which no line breaks between a number and its percent sign.
pub fn bound(text: &str) -> String {
    escape(text).replace(" %", "\u{a0}%")
}

/// A sentence; what stands in backticks is to be typed.
pub fn prose(text: &str) -> String {
    let text = bound(text);
    let pieces: Vec<&str> = text.split('`').collect();
    if pieces.len().is_multiple_of(2) {
        return text;
    }
    let typed = |(i, piece): (usize, &&str)| match i % 2 {
        1 => format!("<code>{piece}</code>"),
        _ => (*piece).to_string(),
    };
    pieces.iter().enumerate().map(typed).collect()
}

/// Whether a cell is one short word, as `A1-tilt`, that must not be broken.
pub fn is_word(text: &str) -> bool {
    (1..=12).contains(&text.len()) && !text.contains(' ')
}

/// Whether the first cell of a row is too long to stand on one line.
pub fn is_long(text: &str) -> bool {
    text.len() > 40
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_typed_is_code() {
        assert_eq!(
            prose("run `a < b`: 3 %"),
            "run <code>a &lt; b</code>: 3\u{a0}%"
        );
        assert_eq!(prose("a ` b"), "a ` b");
    }
}
