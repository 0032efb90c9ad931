//! Small steps over the text of a statement.

/// A line without what stands behind `;`, unless it stands in quotes.
pub(super) fn without_comment(line: &str) -> &str {
    let mut quoted = false;
    for (at, c) in line.char_indices() {
        match c {
            '"' => quoted = !quoted,
            ';' if !quoted => return &line[..at],
            _ => {}
        }
    }
    line
}

/// The first word (a name, with `$` and `_`) and the rest.
pub(super) fn head_of(text: &str) -> (&str, &str) {
    let text = text.trim_start();
    let end = text.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '$'));
    text.split_at(end.unwrap_or(text.len()))
}

/// What stands between the first `(` and the last `)`, cut at the commas.
pub(super) fn inner(text: &str) -> Vec<String> {
    let start = text.find('(').map_or(text.len(), |at| at + 1);
    let end = text.rfind(')').unwrap_or(text.len()).max(start);
    cut(&text[start..end])
        .iter()
        .map(|part| part.trim().to_string())
        .collect()
}

/// The parts between commas that stand in no brackets.
pub(super) fn cut(text: &str) -> Vec<&str> {
    let (mut depth, mut start, mut parts) = (0_i32, 0, Vec::new());
    for (at, c) in text.char_indices() {
        match c {
            '{' | '(' | '[' => depth += 1,
            '}' | ')' | ']' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&text[start..]);
    parts
}

/// The first operand of a motion, a frame in braces or a name, and the rest.
pub(super) fn operand(text: &str) -> (&str, &str) {
    let text = text.trim_start();
    let mut depth = 0_i32;
    for (at, c) in text.char_indices() {
        match c {
            '{' | '[' | '(' => depth += 1,
            '}' | ']' | ')' => {
                depth -= 1;
                if depth <= 0 && c == '}' {
                    return text.split_at(at + 1);
                }
            }
            ',' if depth == 0 => return text.split_at(at),
            _ if depth == 0 && c.is_whitespace() => return text.split_at(at),
            _ => {}
        }
    }
    (text, "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_cut_where_it_should_be() {
        assert_eq!(without_comment("LIN P ; there"), "LIN P ");
        assert_eq!(without_comment("A=\";\" ;x"), "A=\";\" ");
        assert_eq!(head_of(" $VEL.CP=1"), ("$VEL", ".CP=1"));
        assert_eq!(cut("{X 1, Y 2},B"), ["{X 1, Y 2}", "B"]);
        assert_eq!(operand(" {X 1,Y 2} C_DIS"), ("{X 1,Y 2}", " C_DIS"));
        assert_eq!(operand("XP1, XP2"), ("XP1", ", XP2"));
        assert_eq!(inner("(#CP_PARAMS, 0.05)"), ["#CP_PARAMS", "0.05"]);
        assert_eq!(inner(")("), [""]);
    }
}
