//! A measurement file as text that can be corrupted: front matter, header, cells.

use std::path::PathBuf;

/// Front lines, titles, rows of cells.
#[derive(Clone)]
pub struct File {
    pub front: Vec<String>,
    pub titles: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl File {
    /// An example of the repository.
    pub fn example(name: &str) -> Self {
        let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        let path = root.join("measurements/kr210").join(name);
        Self::of(&std::fs::read_to_string(&path).unwrap())
    }

    /// The parts of a text.
    pub fn of(text: &str) -> Self {
        let front = text.lines().take_while(|l| l.starts_with('#'));
        let front: Vec<String> = front.map(str::to_string).collect();
        let mut rest = text.lines().skip(front.len());
        let cells = |line: &str| line.split(',').map(str::to_string).collect::<Vec<_>>();
        let titles = cells(rest.next().unwrap());
        Self {
            front,
            titles,
            rows: rest.map(cells).collect(),
        }
    }

    pub fn text(&self) -> String {
        let line = |cells: &Vec<String>| cells.join(",") + "\n";
        let front: String = self.front.iter().map(|l| l.clone() + "\n").collect();
        front + &line(&self.titles) + &self.rows.iter().map(line).collect::<String>()
    }

    pub fn column(&self, title: &str) -> usize {
        let found = self.titles.iter().position(|t| t.starts_with(title));
        found.unwrap_or_else(|| panic!("no column {title}"))
    }

    pub fn number(&self, row: usize, column: usize) -> f64 {
        self.rows[row][column].parse().unwrap_or(f64::NAN)
    }

    /// Numbers of a column by a rule of row and value.
    pub fn map(mut self, title: &str, of: impl Fn(usize, f64) -> f64) -> Self {
        let k = self.column(title);
        for i in 0..self.rows.len() {
            let value = of(i, self.number(i, k));
            self.rows[i][k] = format!("{value:e}");
        }
        self
    }

    pub fn title(mut self, title: &str, new: &str) -> Self {
        let k = self.column(title);
        self.titles[k] = new.into();
        self
    }

    pub fn swap(mut self, a: &str, b: &str) -> Self {
        let (a, b) = (self.column(a), self.column(b));
        self.rows.iter_mut().for_each(|row| row.swap(a, b));
        self
    }

    /// Another value of a fact.
    pub fn fact(mut self, key: &str, value: &str) -> Self {
        let start = format!("# {key} ");
        self.front.retain(|l| !l.starts_with(&start));
        self.front.push(format!("# {key} = {value}"));
        self
    }

    pub fn without(mut self, key: &str) -> Self {
        let start = format!("# {key} ");
        self.front.retain(|l| !l.starts_with(&start));
        self
    }

    pub fn rows(mut self, keep: impl Fn(usize) -> bool) -> Self {
        let mut i = 0;
        self.rows.retain(|_| {
            i += 1;
            keep(i - 1)
        });
        self
    }

    /// Smallest and largest of a column.
    pub fn range(&self, title: &str) -> (f64, f64) {
        let k = self.column(title);
        let values = (0..self.rows.len()).map(|i| self.number(i, k));
        values.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)))
    }

    /// A column cut off at this share of its largest and smallest value.
    pub fn clip(self, title: &str, above: f64, below: f64) -> Self {
        let (low, high) = self.range(title);
        self.map(title, |_, v| v.clamp(below * low, above * high))
    }
}

/// Noise of unit spread without a generator of its own: a hash of the row.
pub fn noise(row: usize, seed: u64) -> f64 {
    let mut random =
        ident::ground::random::Random::new(seed ^ (row as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15));
    random.normal()
}
