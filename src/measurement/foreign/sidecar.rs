//! Facts beside a raw file: `STEM.ident.toml` for one file, `campaign.toml` for all files of a folder.
//! Front matter goes first, then the sidecar, then the folder.

use crate::ground::problem::{Outcome, Problem};
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// What stands beside a file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sidecar {
    /// Facts of the file.
    pub facts: Table,
    /// Facts of all files of the folder: a kind that does not know one passes it over.
    pub shared: Table,
    /// Name here, and the title there or the number of the column from 1.
    pub columns: Vec<(String, Source)>,
    /// Lines before the titles that do not count.
    pub skip_rows: Option<usize>,
    /// Encoding of the raw file.
    pub encoding: Option<String>,
}

/// Where a column is found in the raw file.
#[derive(Debug, Clone, PartialEq)]
pub enum Source {
    /// By its title.
    Title(String),
    /// By its number from 1.
    Number(usize),
}

/// Keys of a folder that are no facts of a file.
const OF_THE_FOLDER: &[&str] = &["rig", "notes"];

/// Where the sidecar of a file stands.
pub fn place(path: &Path) -> PathBuf {
    path.with_extension("ident.toml")
}

impl Sidecar {
    /// What stands beside a file; empty where nothing does.
    ///
    /// # Errors
    /// A sidecar that is no TOML, or says what cannot be.
    pub fn beside(path: &Path) -> Outcome<Self> {
        let own = read(&place(path))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let shared = read(&folder.join("campaign.toml"))?;
        let mut all = match own {
            Some(table) => Self::of(table).map_err(|p| p.in_file(&place(path)))?,
            None => Self::default(),
        };
        for (key, value) in shared.unwrap_or_default() {
            if !OF_THE_FOLDER.contains(&key.as_str()) {
                all.shared.insert(key, value);
            }
        }
        Ok(all)
    }

    /// Whether the raw file is to be translated whatever it looks like.
    pub fn maps(&self) -> bool {
        !self.columns.is_empty() || self.skip_rows.is_some() || self.encoding.is_some()
    }

    fn of(mut table: Table) -> Outcome<Self> {
        let columns = match table.remove("columns") {
            None => Vec::new(),
            Some(Value::Table(columns)) => {
                columns.into_iter().map(column).collect::<Outcome<_>>()?
            }
            Some(_) => {
                return Err(wrong(
                    "columns",
                    "[columns]\\ntime_s = \"Zeit [s]\"\\nforce_N = 2",
                ));
            }
        };
        let skip_rows = match table.remove("skip_rows") {
            None => None,
            Some(Value::Integer(n)) if (0..=100_000).contains(&n) => Some(n as usize),
            Some(_) => return Err(wrong("skip_rows", "skip_rows = 12")),
        };
        let encoding = match table.remove("encoding") {
            None => None,
            Some(Value::String(name)) => Some(name),
            Some(_) => return Err(wrong("encoding", "encoding = \"windows-1252\"")),
        };
        Ok(Self {
            facts: table,
            shared: Table::new(),
            columns,
            skip_rows,
            encoding,
        })
    }

    /// As the text of a sidecar file.
    pub fn text(&self) -> String {
        let mut table = Table::new();
        if let Some(rows) = self.skip_rows {
            table.insert("skip_rows".into(), Value::Integer(rows as i64));
        }
        if let Some(encoding) = &self.encoding {
            table.insert("encoding".into(), Value::String(encoding.clone()));
        }
        table.extend(self.facts.clone());
        let columns = self.columns.iter().map(|(name, source)| {
            let value = match source {
                Source::Title(title) => Value::String(title.clone()),
                Source::Number(n) => Value::Integer(*n as i64),
            };
            (name.clone(), value)
        });
        let columns: Table = columns.collect();
        if !columns.is_empty() {
            table.insert("columns".into(), Value::Table(columns));
        }
        toml::to_string(&table).unwrap_or_default()
    }
}

fn column((name, value): (String, Value)) -> Outcome<(String, Source)> {
    match value {
        Value::String(title) => Ok((name, Source::Title(title))),
        Value::Integer(n) if n >= 1 => Ok((name, Source::Number(n as usize))),
        _ => Err(wrong(
            "columns",
            "force_N = \"Kraft [N]\", or the number of the column from 1",
        )),
    }
}

fn wrong(key: &str, example: &str) -> Problem {
    Problem::new("is not understood", format!("write `{example}`"))
        .in_column(key)
        .at_line(1)
}

/// The table of a file; `None` where there is no such file.
fn read(path: &Path) -> Outcome<Option<Table>> {
    let Ok(text) = std::fs::read_to_string(path) else {
        return Ok(None);
    };
    let parsed = text.parse::<Table>().map_err(|error| {
        let start = error.span().map_or(0, |span| span.start.min(text.len()));
        let line = 1 + text.as_bytes()[..start]
            .iter()
            .filter(|b| **b == b'\n')
            .count();
        let what = format!("is not TOML: {}", error.message().trim());
        Problem::new(what, "write each fact as `key = value`")
            .at_line(line)
            .in_file(path)
    });
    parsed.map(Some)
}
