//! Lists of numbers, vectors, matrices and tables under a key.

use super::{Keys, line_of, number_of};
use crate::ground::problem::Outcome;
use crate::ground::vector::V3;
use toml::Spanned;
use toml::de::DeValue;

impl Keys<'_> {
    /// A list of finite numbers, if given.
    ///
    /// # Errors
    /// Another type, or a member that is no finite number.
    pub fn numbers(&self, key: &str) -> Outcome<Option<Vec<f64>>> {
        let Some(value) = self.get(key) else {
            return Ok(None);
        };
        self.list(key, value).map(Some)
    }

    fn list(&self, key: &str, value: &DeValue<'_>) -> Outcome<Vec<f64>> {
        let wrong = || self.wrong_type(key, value, "a list of numbers", "[0.0, 1.5]");
        let members = value.as_array().ok_or_else(wrong)?;
        let number = |member: &Spanned<DeValue<'_>>| {
            let number = number_of(member.get_ref()).ok_or_else(|| {
                let remedy = format!("write `{key} = [0.0, 1.5]`");
                self.problem(key, "holds something that is no number", remedy)
            })?;
            self.finite(key, number)
        };
        members.iter().map(number).collect()
    }

    /// Exactly `N` finite numbers, if given.
    ///
    /// # Errors
    /// As [`Keys::numbers`], and another length.
    pub fn array<const N: usize>(&self, key: &str) -> Outcome<Option<[f64; N]>> {
        let Some(list) = self.numbers(key)? else {
            return Ok(None);
        };
        let found = list.len();
        let fitting = <[f64; N]>::try_from(list);
        fitting.map(Some).map_err(|_| {
            let what = format!("has {found} members instead of {N}");
            self.problem(key, what, format!("write {N} numbers in brackets"))
        })
    }

    /// A vector, if given.
    ///
    /// # Errors
    /// As [`Keys::array`].
    pub fn vector(&self, key: &str) -> Outcome<Option<V3>> {
        self.array::<3>(key)
    }

    /// Three rows of three finite numbers, if given.
    ///
    /// # Errors
    /// Another shape.
    pub fn matrix(&self, key: &str) -> Outcome<Option<[V3; 3]>> {
        let Some(value) = self.get(key) else {
            return Ok(None);
        };
        let wrong = || {
            let remedy = format!("write `{key} = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]`");
            self.problem(key, "is not three rows of three numbers", remedy)
        };
        let rows = value.as_array().ok_or_else(wrong)?;
        let row = |row: &Spanned<DeValue<'_>>| {
            let list = self.list(key, row.get_ref()).map_err(|_| wrong())?;
            V3::try_from(list).map_err(|_| wrong())
        };
        let rows: Vec<V3> = rows.iter().map(row).collect::<Outcome<_>>()?;
        <[V3; 3]>::try_from(rows).map(Some).map_err(|_| wrong())
    }
}

impl<'a> Keys<'a> {
    /// The tables under a key, as `[[key]]` writes them; none if left out. Their keys must be among `known`.
    ///
    /// # Errors
    /// Another type, or an unknown key.
    pub fn tables(&self, key: &str, known: &[&str]) -> Outcome<Vec<Keys<'a>>> {
        let Some(value) = self.get(key) else {
            return Ok(Vec::new());
        };
        let wrong = || self.wrong_type(key, value, "a list of tables", "[{ ... }]");
        let members = value.as_array().ok_or_else(wrong)?;
        let one = |member: &'a Spanned<DeValue<'a>>| {
            let table = member.get_ref().as_table().ok_or_else(wrong)?;
            let line = line_of(self.text.as_bytes(), member.span().start);
            let prefix = format!("{}{key}.", self.prefix);
            Keys::of(self.text, table, prefix, line, known)
        };
        members.iter().map(one).collect()
    }
}
