//! A simulated measurement file as text: front matter, header, rows.

use crate::measurement::front::quoted;
use std::fmt::Write;

/// What a simulated sensor wrote.
pub struct Recording {
    /// Front matter, TOML lines without the `#`.
    pub facts: Vec<String>,
    /// Column names with units.
    pub columns: Vec<&'static str>,
    /// Words of the first column, one per row; empty: all columns are numbers.
    pub words: Vec<&'static str>,
    /// Decimals of each column of numbers.
    pub decimals: Vec<usize>,
    /// Values in the columns' units, one vector per column of numbers.
    pub values: Vec<Vec<f64>>,
}

/// The facts that every simulated file begins with.
pub fn head(kind: &str, robot: &str, source: &str) -> Vec<String> {
    vec![
        format!("kind = {}", quoted(kind)),
        "synthetic = true   # simulated by `ident lab`; nobody measured this".to_string(),
        format!("source = {}", quoted(source)),
        format!("robot = {}", quoted(robot)),
    ]
}

impl Recording {
    /// The file's text.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for fact in &self.facts {
            let _ = writeln!(text, "# {fact}");
        }
        let mut writer = csv::Writer::from_writer(Vec::new());
        let rows = self.values.first().map_or(0, Vec::len);
        // writing into memory cannot fail
        let _ = writer.write_record(&self.columns);
        for row in 0..rows {
            let word = self.words.get(row).map(ToString::to_string);
            let numbers = self.values.iter().zip(&self.decimals);
            let cells = numbers.map(|(values, decimals)| format!("{:.*}", *decimals, values[row]));
            let _ = writer.write_record(word.into_iter().chain(cells));
        }
        let body = writer.into_inner().unwrap_or_default();
        text + &String::from_utf8_lossy(&body)
    }
}
