use super::*;

fn refusal(text: &str, read: impl Fn(&Keys<'_>) -> Outcome<()>) -> Problem {
    let document = Document::parse(text).unwrap();
    read(&document.keys(&["a", "b", "feed_mm_min"]).unwrap()).unwrap_err()
}

#[test]
fn an_unknown_key_names_its_line_and_the_nearest_known_one() {
    let document = Document::parse("a = 1\n\nfed_mm_min = 2\n").unwrap();
    let problem = document.keys(&["a", "feed_mm_min"]).unwrap_err();
    assert_eq!(problem.line, Some(3));
    assert!(problem.remedy.contains("`feed_mm_min`"), "{problem}");
}

#[test]
fn numbers_in_every_spelling_are_read() {
    let document = Document::parse("a = 1_000\nb = 0x10\nfeed_mm_min = -1.5e-3").unwrap();
    let keys = document.keys(&["a", "b", "feed_mm_min"]).unwrap();
    assert_eq!(keys.number("a").unwrap(), Some(1000.0));
    assert_eq!(keys.number("b").unwrap(), Some(16.0));
    assert_eq!(keys.number("feed_mm_min").unwrap(), Some(-1.5e-3));
    assert_eq!(keys.number("c").unwrap(), None);
}

#[test]
fn what_is_no_number_is_refused_on_its_line() {
    for wrong in [
        "nan",
        "inf",
        "1e31",
        "-1e-320",
        "\"1\"",
        "[1]",
        "true",
        "2020-01-01",
    ] {
        let text = format!("a = 1\nb = {wrong}\n");
        let problem = refusal(&text, |keys| keys.number("b").map(drop));
        assert_eq!(
            (problem.line, problem.column.as_deref()),
            (Some(2), Some("b")),
            "{wrong}"
        );
    }
}

#[test]
fn broken_toml_names_its_line() {
    assert_eq!(
        Document::parse("a = 1\nb = = 2\n").unwrap_err().line,
        Some(2)
    );
    assert_eq!(Document::parse("a = 1\na = 2\n").unwrap_err().line, Some(2));
}
