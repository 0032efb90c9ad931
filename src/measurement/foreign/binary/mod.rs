//! Raw files that are no text: spreadsheets, NumPy, MATLAB, LabVIEW. One file per format, one line in
//! [`FORMATS`]. Each is laid out as lines of cells, so that titles, units and mappings are understood as
//! in a text.

mod bytes;
mod grid;
mod mat;
mod npy;
mod tdms;
mod xlsx;

use crate::ground::problem::{Outcome, Problem};

/// Between the cells of a line.
pub const DELIMITER: char = '\t';

/// A table of a binary file.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Sheet, group or variable.
    pub name: String,
    /// Its lines, cells between [`DELIMITER`]s.
    pub text: String,
}

/// A format that is no text.
pub struct Format {
    /// Its name.
    pub name: &'static str,
    /// Endings of its files, lower case, without the dot.
    pub endings: &'static [&'static str],
    recognises: fn(&[u8]) -> bool,
    read: fn(&[u8]) -> Outcome<Vec<Sheet>>,
}

/// Every format. A new one is one file and one line here.
pub const FORMATS: &[Format] = &[
    Format {
        name: "xlsx",
        endings: &["xlsx", "xlsm"],
        recognises: xlsx::recognises,
        read: xlsx::read,
    },
    Format {
        name: "npy",
        endings: &["npy"],
        recognises: npy::recognises,
        read: npy::read,
    },
    Format {
        name: "mat",
        endings: &["mat"],
        recognises: mat::recognises,
        read: mat::read,
    },
    Format {
        name: "tdms",
        endings: &["tdms"],
        recognises: tdms::recognises,
        read: tdms::read,
    },
];

/// The format of these bytes, if it is one of them.
pub fn format_of(bytes: &[u8]) -> Option<&'static Format> {
    FORMATS.iter().find(|format| (format.recognises)(bytes))
}

impl Format {
    /// The tables of a file; at least one, none of them empty.
    ///
    /// # Errors
    /// A file that is cut, or holds no numbers.
    pub fn read(&self, bytes: &[u8]) -> Outcome<Vec<Sheet>> {
        let sheets = (self.read)(bytes).map_err(|problem| problem.at_line(1))?;
        match sheets.is_empty() {
            false => Ok(sheets),
            true => Err(Problem::new(
                format!("is a file of {} without a table of numbers", self.name),
                "export the channels with their titles, as columns of one table",
            )
            .at_line(1)),
        }
    }
}
