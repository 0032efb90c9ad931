//! A simulated measurement file as text: front matter, header, rows.

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

impl Recording {
    /// The file's text.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for fact in &self.facts {
            let _ = writeln!(text, "# {fact}");
        }
        let _ = writeln!(text, "{}", self.columns.join(","));
        let rows = self.values.first().map_or(0, Vec::len);
        for row in 0..rows {
            let word = self.words.get(row).copied().unwrap_or("");
            text.push_str(word);
            for (column, values) in self.values.iter().enumerate() {
                let comma = if column == 0 && word.is_empty() {
                    ""
                } else {
                    ","
                };
                let _ = write!(text, "{comma}{:.*}", self.decimals[column], values[row]);
            }
            text.push('\n');
        }
        text
    }
}
