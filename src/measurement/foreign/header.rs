//! Where the table of a raw file begins: below titles of programs and instruments, its titles stand over
//! rows of numbers, perhaps with a row of units between.

use super::titles::{name_of, unit};

/// The head of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Head {
    /// Index of the line of titles.
    pub titles_line: usize,
    /// Index of the first line of numbers.
    pub first_line: usize,
    /// Delimiter.
    pub delimiter: char,
    /// Titles.
    pub titles: Vec<String>,
    /// Units below them; seconds over times of day.
    pub units: Option<Vec<String>>,
}

/// Lines in which titles are looked for.
const DEPTH: usize = 400;

/// The head, if one is found at or below a line; `wanted`: titles that a mapping names.
pub fn find(lines: &[&str], from: usize, wanted: &[String]) -> Option<Head> {
    let candidates = from..lines.len().min(from + DEPTH);
    candidates
        .flat_map(|at| ['\t', ';', ','].map(|d| head(lines, at, d)))
        .flatten()
        .find(|head| {
            let known = |i: usize| {
                let below = head
                    .units
                    .as_ref()
                    .and_then(|u| u.get(i))
                    .map(String::as_str);
                let title = &head.titles[i];
                wanted.contains(title) || name_of(title, below).is_some()
            };
            (0..head.titles.len()).filter(|i| known(*i)).count() >= 2
                || (!wanted.is_empty() && head.titles.len() >= 2)
        })
}

fn head(lines: &[&str], at: usize, delimiter: char) -> Option<Head> {
    let titles = cells(lines[at], delimiter);
    let words = titles
        .iter()
        .filter(|t| !t.is_empty() && number(t).is_none())
        .count();
    if titles.len() < 2 || words < 2 {
        return None;
    }
    let after = |k: usize| lines.get(at + k).map(|line| cells(line, delimiter));
    let is_units = |row: &Vec<String>| {
        row.len() == titles.len()
            && row.iter().any(|c| unit(c).is_some())
            && row.iter().all(|c| c.is_empty() || number(c).is_none())
    };
    let units = after(1).filter(is_units);
    let first = 1 + usize::from(units.is_some());
    let row = after(first).filter(|row| {
        let count = row.iter().filter(|c| number(c).is_some()).count();
        row.len() == titles.len() && count >= 2
    })?;
    let units = stamped(&row, units);
    Some(Head {
        titles_line: at,
        first_line: at + first,
        delimiter,
        titles,
        units,
    })
}

/// Units with seconds over cells that hold a time of day: these become seconds.
fn stamped(row: &[String], units: Option<Vec<String>>) -> Option<Vec<String>> {
    let is_clock = |cell: &String| cell.contains(':') && number(cell).is_some();
    if !row.iter().any(is_clock) {
        return units;
    }
    let own = units.unwrap_or_else(|| vec![String::new(); row.len()]);
    let cells = row.iter().zip(own);
    let unit = |(cell, own): (&String, String)| match is_clock(cell) {
        true => "s".into(),
        false => own,
    };
    Some(cells.map(unit).collect())
}

/// The cells of a line, without blanks and quotes.
pub fn cells(line: &str, delimiter: char) -> Vec<String> {
    let line = line.trim_end_matches(['\r', '\n']);
    line.split(delimiter)
        .map(|c| c.trim().trim_matches('"').trim().to_string())
        .collect()
}

/// A cell as a number with a point: decimal commas, and times of day as seconds; `None` for words.
pub fn number(cell: &str) -> Option<String> {
    let point = cell.replace(',', ".");
    if point.matches('.').count() <= 1 && point.parse::<f64>().is_ok_and(f64::is_finite) {
        return Some(point);
    }
    clock(&point)
}

/// `12:03:01.25`, with or without a date before it, in seconds since midnight.
fn clock(cell: &str) -> Option<String> {
    let time = cell.rsplit([' ', 'T']).next()?;
    let parts: Vec<&str> = time.split(':').collect();
    let [hours, minutes, seconds] = parts[..] else {
        return None;
    };
    let (h, m, s) = (
        hours.parse::<u32>().ok()?,
        minutes.parse::<u32>().ok()?,
        seconds.parse::<f64>().ok()?,
    );
    let valid = h < 24 && m < 60 && (0.0..61.0).contains(&s);
    valid.then(|| (f64::from(h * 3600 + m * 60) + s).to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_below_a_program_s_own_lines_are_found() {
        let lines = [
            "Messung 12",
            "Datum;3.4.2026",
            "",
            "Zeit;Kraft;Weg",
            "[s];[N];[µm]",
            "0,0;1,5;2,0",
            "0,1;2,5;3,0",
        ];
        let head = find(&lines, 0, &[]).unwrap();
        assert_eq!(
            (head.titles_line, head.first_line, head.delimiter),
            (3, 5, ';')
        );
        assert_eq!(number("12:00:01,5").as_deref(), Some("43201.5"));
        assert_eq!(number("1.234,5"), None);
    }
}
