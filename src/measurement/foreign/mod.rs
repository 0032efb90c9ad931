//! Raw files of other programs: what stands beside them (facts, mapping of columns), how they are encoded,
//! where their table begins, and what their titles mean. A foreign file is translated into the form that
//! [`super::table`] reads; the file itself stays as it is.

pub mod binary;
pub mod encoding;
pub mod header;
pub mod sidecar;
pub mod titles;
pub mod translate;

pub use sidecar::Sidecar;
pub use translate::{Reading, translated};
