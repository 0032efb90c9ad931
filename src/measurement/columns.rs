//! A CSV file with TOML front matter as named columns in SI: the little that `hammer` needs.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::{files, units};
use std::path::Path;

/// Columns of one file.
pub struct Columns {
    /// The facts in the `#` lines.
    pub front: toml::Table,
    /// 1-based line of each row.
    pub lines: Vec<usize>,
    text: Vec<(String, Vec<String>)>,
    numbers: Vec<(String, Vec<f64>)>,
}

/// Columns that hold words, not numbers with a unit.
const WORDS: [&str; 2] = ["direction", "hit"];

impl Columns {
    /// Reads `path`. Numbers come in SI under their name without the unit; empty cells are NaN.
    pub fn read(path: &Path) -> Outcome<Self> {
        let bytes = files::read_bytes(path)?;
        parse(&String::from_utf8_lossy(&bytes)).map_err(|problem| problem.in_file(path))
    }

    /// The words of a column, if the file has it.
    pub fn words(&self, name: &str) -> Option<&[String]> {
        find(&self.text, name).map(Vec::as_slice)
    }

    /// The numbers of a column in SI, if the file has it.
    pub fn numbers(&self, name: &str) -> Option<&[f64]> {
        find(&self.numbers, name).map(Vec::as_slice)
    }
}

fn find<'a, T>(columns: &'a [(String, T)], name: &str) -> Option<&'a T> {
    columns.iter().find(|(n, _)| n == name).map(|(_, c)| c)
}

fn parse(text: &str) -> Outcome<Columns> {
    let text = text.trim_start_matches('\u{feff}');
    let front_lines = text.lines().take_while(|line| line.starts_with('#'));
    let front: Vec<&str> = front_lines.map(|line| &line[1..]).collect();
    let mut columns = Columns {
        front: front_matter(&front.join("\n"))?,
        lines: Vec::new(),
        text: Vec::new(),
        numbers: Vec::new(),
    };
    let mut rows = text.lines().enumerate().skip(front.len());
    let (_, header) = rows.next().ok_or_else(empty)?;
    let delimiter = delimiter(header);
    let places = header
        .split(delimiter)
        .map(|name| {
            columns
                .place(name.trim())
                .map_err(|p| p.at_line(front.len() + 1))
        })
        .collect::<Outcome<Vec<_>>>()?;
    for (i, row) in rows.filter(|(_, row)| !row.trim().is_empty()) {
        columns
            .push(&places, row, delimiter)
            .map_err(|problem| problem.at_line(i + 1))?;
        columns.lines.push(i + 1);
    }
    Ok(columns)
}

fn empty() -> Problem {
    Problem::new(
        "holds no header row",
        "write the column names after the front matter",
    )
}

fn front_matter(text: &str) -> Outcome<toml::Table> {
    text.parse::<toml::Table>().map_err(|error| {
        let line = error.span().map(|s| text[..s.start].lines().count().max(1));
        let problem = Problem::new(
            format!("front matter is not TOML: {}", error.message()),
            "write each fact as `# key = value`, strings in quotes",
        );
        line.map_or(problem.clone(), |line| problem.at_line(line))
    })
}

fn delimiter(header: &str) -> char {
    let count = |d: &char| header.matches(*d).count();
    [',', ';', '\t']
        .into_iter()
        .max_by_key(count)
        .unwrap_or(',')
}

/// Where the cells of one column go.
enum Place {
    Text(usize),
    Number { index: usize, factor: f64 },
}

impl Columns {
    fn place(&mut self, name: &str) -> Outcome<Place> {
        if WORDS.contains(&name) {
            self.text.push((name.into(), Vec::new()));
            return Ok(Place::Text(self.text.len() - 1));
        }
        let (stem, unit) = units::split_name(name).ok_or_else(|| {
            Problem::new(
                "column without a known unit",
                format!("end its name in one of: {}", units::known_units()),
            )
            .in_column(name)
        })?;
        self.numbers.push((stem, Vec::new()));
        Ok(Place::Number {
            index: self.numbers.len() - 1,
            factor: unit.factor,
        })
    }

    fn push(&mut self, places: &[Place], row: &str, delimiter: char) -> Outcome<()> {
        let mut cells = row.split(delimiter).map(str::trim);
        for place in places {
            let cell = cells.next().ok_or_else(wrong_length)?;
            match place {
                Place::Text(i) => self.text[*i].1.push(cell.into()),
                Place::Number { index, factor } => {
                    let (name, column) = &mut self.numbers[*index];
                    let value = number(cell, delimiter).map_err(|p| p.in_column(name.clone()))?;
                    column.push(value * factor);
                }
            }
        }
        cells.next().map_or(Ok(()), |_| Err(wrong_length()))
    }
}

fn wrong_length() -> Problem {
    Problem::new(
        "row with another number of cells than the header",
        "give every row one cell per column; leave a missing value empty",
    )
}

fn number(cell: &str, delimiter: char) -> Outcome<f64> {
    if cell.is_empty() {
        return Ok(f64::NAN);
    }
    let parsed = match fast_float2::parse::<f64, _>(cell) {
        Err(_) if delimiter != ',' => fast_float2::parse(cell.replace(',', ".")),
        parsed => parsed,
    };
    match parsed {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(Problem::new(
            format!("`{cell}` is not a finite number"),
            "write a number, or leave the cell empty for a missing value",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_si_and_names_the_place_of_an_error() {
        let columns = parse("# a = 1\ndirection;time_ms;force_N\nx;1,5;2\n").unwrap();
        assert_eq!(columns.numbers("time").unwrap(), [1.5e-3]);
        assert_eq!(columns.words("direction").unwrap(), ["x"]);
        let problem = parse("time_s,force_N\n0,1\n0,x\n").err().unwrap();
        assert_eq!(
            (problem.line, problem.column.as_deref()),
            (Some(3), Some("force"))
        );
        assert!(parse("time_s,force\n").is_err());
        assert!(parse("time_s,force_N\n1\n").is_err());
    }
}
