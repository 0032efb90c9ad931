//! Words that were mistyped: the known one that is nearest.

/// The known word nearest to `word`, if it is near enough to be what was meant: at most a third of
/// its letters differ.
pub fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let far = word.chars().count().min(LONGEST).div_ceil(3);
    let distances = known.iter().map(|k| (distance(word, k), *k));
    let best = distances.min_by_key(|(apart, _)| *apart)?;
    (best.0 <= far).then_some(best.1)
}

/// Letters looked at: longer words are no keys.
const LONGEST: usize = 64;

/// Letters to insert, delete or replace (Levenshtein 1966), without regard to case.
fn distance(a: &str, b: &str) -> usize {
    let letters = |word: &str| -> Vec<char> {
        let lower = word.chars().flat_map(char::to_lowercase);
        lower.take(LONGEST).collect()
    };
    let (a, b) = (letters(a), letters(b));
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut corner = std::mem::replace(&mut row[0], i + 1);
        for (j, y) in b.iter().enumerate() {
            let replaced = corner + usize::from(x != y);
            corner = row[j + 1];
            row[j + 1] = replaced.min(corner + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_pen_is_understood_and_a_strange_word_is_not() {
        let known = ["feed_mm_min", "cycle_ms", "spin"];
        assert_eq!(nearest("fed_mm_min", &known), Some("feed_mm_min"));
        assert_eq!(nearest("Spin", &known), Some("spin"));
        assert_eq!(nearest("colour", &known), None);
        assert_eq!(nearest("x", &[]), None);
        assert_eq!(distance("kitten", "sitting"), 3);
    }
}
