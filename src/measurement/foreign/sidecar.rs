//! Facts beside a raw file: `STEM.ident.toml` for one file, `campaign.toml` for all files of a folder.
//! Front matter goes first, then the sidecar, then the folder.

use crate::ground::files::read_bytes;
use crate::ground::problem::{Outcome, Problem, line_of_toml};
use crate::measurement::known_keys::known_to_no_kind;
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
    /// Sheet, group or variable of a file that holds several tables.
    pub table: Option<String>,
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
        !self.columns.is_empty()
            || self.skip_rows.is_some()
            || self.encoding.is_some()
            || self.table.is_some()
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
        let encoding = word(&mut table, "encoding", "windows-1252")?;
        let sheet = word(&mut table, "table", "Messung")?;
        Ok(Self {
            facts: table,
            shared: Table::new(),
            columns,
            skip_rows,
            encoding,
            table: sheet,
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
        if let Some(sheet) = &self.table {
            table.insert("table".into(), Value::String(sheet.clone()));
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

/// Takes a text out of the table.
fn word(table: &mut Table, key: &str, example: &str) -> Outcome<Option<String>> {
    match table.remove(key) {
        None => Ok(None),
        Some(Value::String(text)) => Ok(Some(text)),
        Some(_) => Err(wrong(key, &format!("{key} = \"{example}\""))),
    }
}

fn wrong(key: &str, example: &str) -> Problem {
    Problem::new("is not understood", format!("write `{example}`"))
        .in_column(key)
        .at_line(1)
}

/// Keys of a file's own sidecar that are no facts.
const OF_THE_FILE: &[&str] = &["columns", "skip_rows", "encoding", "table"];

/// The table of a file; `None` where there is no such file.
fn read(path: &Path) -> Outcome<Option<Table>> {
    if !path.exists() {
        return Ok(None);
    }
    let refuse = |what: String, line: usize| {
        Problem::new(what, "write each fact as `key = value`, saved as UTF-8")
            .at_line(line)
            .in_file(path)
    };
    let text =
        String::from_utf8(read_bytes(path)?).map_err(|_| refuse("is not UTF-8 text".into(), 1))?;
    let table = text.parse::<Table>().map_err(|error| {
        let what = format!("is not TOML: {}", error.message().trim());
        refuse(what, line_of_toml(&text, &error))
    })?;
    let more = [OF_THE_FOLDER, OF_THE_FILE].concat();
    for key in table.keys() {
        if let Some(problem) = known_to_no_kind(key, &more) {
            let starts = |l: &str| {
                l.trim_start()
                    .trim_start_matches('[')
                    .starts_with(key.as_str())
            };
            let at = text.lines().position(starts).unwrap_or(0);
            return Err(problem.at_line(at + 1).in_file(path));
        }
    }
    Ok(Some(table))
}
