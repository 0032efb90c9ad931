//! A table: header, rows of cells, notes below.

/// Cells are text that is already formatted (see [`super::number`]).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Table {
    /// What it lists.
    pub title: String,
    /// Name of each column, unit included.
    pub header: Vec<String>,
    /// One cell for each column; the first one names the row.
    pub rows: Vec<Vec<String>>,
    /// Sentences below the table.
    pub notes: Vec<String>,
    /// Columns set flush right: numbers with equal decimals.
    pub right: Vec<usize>,
}

impl Table {
    /// A table without rows.
    pub fn new<S: Into<String>>(
        title: impl Into<String>,
        header: impl IntoIterator<Item = S>,
    ) -> Self {
        Self {
            title: title.into(),
            header: header.into_iter().map(Into::into).collect(),
            ..Self::default()
        }
    }

    /// The same table with these columns set flush right.
    #[must_use]
    pub fn numeric(mut self, columns: impl IntoIterator<Item = usize>) -> Self {
        self.right.extend(columns);
        self
    }

    /// The same table with one more row.
    #[must_use]
    pub fn with<S: Into<String>>(mut self, row: impl IntoIterator<Item = S>) -> Self {
        self.push(row);
        self
    }

    /// Adds a row.
    pub fn push<S: Into<String>>(&mut self, row: impl IntoIterator<Item = S>) {
        self.rows.push(row.into_iter().map(Into::into).collect());
    }

    /// The same table with a note below.
    #[must_use]
    pub fn noted(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// Number of columns: that of the longest line, header included.
    pub fn columns(&self) -> usize {
        let longest = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        longest.max(self.header.len())
    }

    /// Whether a column is set flush right.
    pub fn is_right(&self, column: usize) -> bool {
        self.right.contains(&column)
    }
}
