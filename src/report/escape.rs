//! Text as XML and HTML want it.

use std::borrow::Cow;

/// Escapes text for element content and double-quoted attributes. Characters that XML forbids
/// become the replacement character, so no input can break the document.
pub(super) fn escape(text: &str) -> Cow<'_, str> {
    let clean = |c: char| !matches!(c, '<' | '>' | '&' | '"' | '\'') && !forbidden(c);
    if text.chars().all(clean) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c if forbidden(c) => out.push('\u{FFFD}'),
            c => out.push(c),
        }
    }
    Cow::Owned(out)
}

fn forbidden(c: char) -> bool {
    (c.is_control() && !matches!(c, '\t' | '\n' | '\r')) || matches!(c, '\u{FFFE}' | '\u{FFFF}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escapes_what_breaks_a_document() {
        assert_eq!(escape("N·m"), "N·m");
        assert_eq!(
            escape("<a b=\"c\">&'\u{0}"),
            "&lt;a b=&quot;c&quot;&gt;&amp;&#39;\u{FFFD}"
        );
    }
}
