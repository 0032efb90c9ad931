//! Routines of a program: those of its file, and files beside it that are called.

use super::super::source::{Source, lines};
use super::scan::without_comment;
use super::{END_FOLD, RAPID_FOLD};
use crate::ground::problem::{Outcome, Problem};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Name under which the first routine of the file is kept.
pub(super) const MAIN: &str = "";

/// One statement.
#[derive(Debug, Clone)]
pub(super) struct Statement {
    /// 1-based line.
    pub(super) line: usize,
    /// As written, without comment.
    pub(super) raw: String,
    /// In upper case.
    pub(super) upper: String,
}

/// A routine: the lines of its file between DEF and END.
#[derive(Debug, Clone)]
pub(super) struct Routine {
    pub(super) file: PathBuf,
    text: Rc<String>,
    /// Byte range of the body, and the 1-based line on which it begins.
    body: std::ops::Range<usize>,
    first_line: usize,
}

/// Longest statement, bytes.
const LONGEST: usize = 1 << 16;

impl Routine {
    pub(super) fn statements(&self) -> impl Iterator<Item = Statement> + use<> {
        let (text, body, first) = (self.text.clone(), self.body.clone(), self.first_line);
        let mut at = body.start;
        let mut line = first;
        std::iter::from_fn(move || {
            while at < body.end {
                let rest = &text[at..body.end];
                let length = rest.find('\n').map_or(rest.len(), |end| end + 1);
                let found = statement(&rest[..length], line);
                at += length;
                line += 1;
                if found.is_some() {
                    return found;
                }
            }
            None
        })
    }
}

/// The statement of a line, unless it is empty, a header, or a comment that is no fold of rapid motions.
fn statement(line: &str, number: usize) -> Option<Statement> {
    let fold = line.trim();
    let closes = fold.get(..END_FOLD.len());
    let closes = closes.is_some_and(|head| head.eq_ignore_ascii_case(END_FOLD));
    let raw = match closes || fold.eq_ignore_ascii_case(RAPID_FOLD) {
        true => fold,
        false => without_comment(line).trim(),
    };
    if raw.is_empty() || raw.starts_with('&') {
        return None;
    }
    let end = (0..=raw.len().min(LONGEST))
        .rev()
        .find(|i| raw.is_char_boundary(*i));
    let raw = &raw[..end.unwrap_or(0)];
    Some(Statement {
        line: number,
        raw: raw.to_string(),
        upper: raw.to_uppercase(),
    })
}

/// All routines that are known so far.
pub(super) struct Library {
    folder: PathBuf,
    routines: BTreeMap<String, Routine>,
    data: Vec<Statement>,
}

impl Library {
    /// The routines of a file, with the data list beside it.
    pub(super) fn of(source: &Source, inputs: &mut Vec<(PathBuf, String)>) -> Outcome<Self> {
        let mut library = Self {
            folder: source.path.parent().unwrap_or(Path::new("")).to_path_buf(),
            routines: BTreeMap::new(),
            data: Vec::new(),
        };
        library.take(source, MAIN)?;
        library.data_of(&source.path, inputs)?;
        Ok(library)
    }

    /// Statements of the data lists.
    pub(super) fn data(&self) -> Vec<Statement> {
        self.data.clone()
    }

    /// Whether a program of that name can be run.
    pub(super) fn knows(&self, name: &str) -> bool {
        self.routines.contains_key(&name.to_uppercase()) || self.file_of(name).is_some()
    }

    /// The routine of that name; a file beside is read when it is first called.
    pub(super) fn routine(
        &mut self,
        name: &str,
        inputs: &mut Vec<(PathBuf, String)>,
    ) -> Outcome<Routine> {
        let key = name.to_uppercase();
        if !self.routines.contains_key(&key)
            && let Some(file) = self.file_of(name)
        {
            let source = Source::read(&file)?;
            inputs.push((file.clone(), source.sha256.clone()));
            self.take(&source, &key)
                .map_err(|problem| problem.in_file(&file))?;
        }
        let found = self.routines.get(&key).cloned();
        found.ok_or_else(|| Problem::new("holds no program", "write it between DEF and END"))
    }

    fn file_of(&self, name: &str) -> Option<PathBuf> {
        let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        let spellings = [name.to_string(), name.to_lowercase(), name.to_uppercase()];
        let files = spellings
            .iter()
            .flat_map(|n| [format!("{n}.src"), format!("{n}.SRC")]);
        let mut paths = files.map(|file| self.folder.join(file));
        paths.find(|path| plain && !name.is_empty() && path.is_file())
    }

    /// Cuts a file into routines; the first one also answers to `name`.
    fn take(&mut self, source: &Source, name: &str) -> Outcome<()> {
        let text = Rc::new(source.text()?.replace("\r\n", "\n").replace('\r', "\n"));
        let mut open: Option<(String, usize, usize)> = None;
        let mut found = Vec::new();
        let mut at = 0;
        for (number, line) in lines(&text) {
            let next = (at + line.len() + 1).min(text.len());
            let upper = head(line);
            if let Some(called) = defined(&upper) {
                open = Some((called, next, number + 1));
            } else if ["END", "ENDFCT"].contains(&upper.trim())
                && let Some((called, start, first)) = open.take()
            {
                found.push((called, start..at, first));
            }
            at = next;
        }
        if let Some((called, start, first)) = open {
            found.push((called, start..text.len(), first));
        }
        if found.is_empty() {
            found.push((name.to_string(), 0..text.len(), 1));
        }
        for (i, (called, body, first_line)) in found.into_iter().enumerate() {
            let routine = Routine {
                file: source.path.clone(),
                text: text.clone(),
                body: body.start.min(body.end)..body.end,
                first_line,
            };
            if i == 0 {
                self.routines.insert(name.to_string(), routine.clone());
            }
            self.routines.insert(called, routine);
        }
        Ok(())
    }

    fn data_of(&mut self, program: &Path, inputs: &mut Vec<(PathBuf, String)>) -> Outcome<()> {
        let endings = ["dat", "DAT", "Dat"];
        let mut paths = endings.iter().map(|ending| program.with_extension(ending));
        let Some(path) = paths.find(|path| path.is_file()) else {
            return Ok(());
        };
        let source = Source::read(&path)?;
        let text = source.text().map_err(|problem| problem.in_file(&path))?;
        let statements = lines(&text).filter_map(|(number, line)| statement(line, number));
        self.data = statements.collect();
        inputs.push((path, source.sha256));
        Ok(())
    }
}

/// The start of a line in upper case: enough for a definition.
fn head(line: &str) -> String {
    let code = without_comment(line).trim();
    let start: String = code.chars().take(80).collect();
    start.to_uppercase()
}

/// The name of the routine that a line defines.
fn defined(upper: &str) -> Option<String> {
    let line = upper.strip_prefix("GLOBAL ").unwrap_or(upper).trim_start();
    let rest = line
        .strip_prefix("DEF ")
        .or_else(|| line.strip_prefix("DEFFCT "))?;
    let name = rest.split('(').next().unwrap_or_default();
    let name = name.split_whitespace().last().unwrap_or_default();
    Some(name.to_string())
}
