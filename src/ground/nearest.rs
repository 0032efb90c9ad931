//! The known word that a mistyped one is nearest to.

/// The nearest of `known` by the number of letters to change (Levenshtein 1966), if it is near at all.
pub fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let distance = |k: &&'a str| changes(&word.to_lowercase(), &k.to_lowercase());
    let best = known.iter().copied().min_by_key(|k| distance(k))?;
    let near = distance(&best) <= 2 + word.len() / 4 || best.contains(word) || word.contains(best);
    near.then_some(best)
}

/// Letters to insert, delete or replace.
fn changes(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().take(64).collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().take(64).enumerate() {
        let mut corner = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let replaced = corner + usize::from(x != *y);
            corner = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(corner + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_what_was_meant() {
        let known = ["rest_s", "sensor_delay_s", "joint"];
        assert_eq!(nearest("rest_S", &known), Some("rest_s"));
        assert_eq!(nearest("sensor_delay", &known), Some("sensor_delay_s"));
        assert_eq!(nearest("operator", &known), None);
    }
}
