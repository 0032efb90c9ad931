//! Workspace tests: deflection is linear in the compliances, so the evidence of every set of causes
//! is a closed form, and all of them can be compared.

mod adequacy;
mod beyond;
mod bound;
mod case;
mod choose;
mod columns;
mod diagnosis;
mod doubt;
mod field;
mod gram;
mod limits;
mod name;
mod next;
mod patterns;
mod play;
mod remains;
mod search;
mod seats;
mod set;
mod settled;
mod slide;
mod smooth;
mod strangers;
mod target;
mod thin;
mod told;
mod unseen;
mod weights;

pub use diagnosis::{WorkspaceDiagnosis, diagnose, judgement};
pub use limits::Limit;
