//! Data set 151: where the file comes from.

use super::fields::Record;

/// Header of a universal file. Times stay as written: programs differ in their form.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Header {
    /// Name of the model file.
    pub model: String,
    /// Description.
    pub description: String,
    /// Program that made the database.
    pub program: String,
    /// When the database was made.
    pub created: String,
    /// When it was last saved.
    pub saved: String,
    /// Program that wrote the file.
    pub writer: String,
    /// When the file was written.
    pub written: String,
}

/// Reads the records; missing ones are empty.
pub fn parse(records: &[Record]) -> Header {
    let text = |i: usize, to: usize| records.get(i).map_or(String::new(), |r| r.field(0, to));
    Header {
        model: text(0, 80),
        description: text(1, 80),
        program: text(2, 80),
        created: text(3, 20),
        saved: text(4, 20),
        writer: text(5, 80),
        written: text(6, 20),
    }
}
