//! Breaking text into lines.

/// Lines of at most `limit`, measured by `width`; a word that is wider stands alone.
pub(super) fn wrap(text: &str, limit: f64, width: impl Fn(&str) -> f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}")) <= limit => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_string()),
        }
    }
    lines
}

/// Lines of at most `columns` characters.
pub(super) fn wrap_columns(text: &str, columns: usize) -> Vec<String> {
    wrap(text, columns as f64, |line| line.chars().count() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn breaks_between_words() {
        assert_eq!(wrap_columns("one two three", 7), ["one two", "three"]);
        assert_eq!(
            wrap_columns("incomprehensible a", 4),
            ["incomprehensible", "a"]
        );
        assert!(wrap_columns("  ", 4).is_empty());
    }
}
