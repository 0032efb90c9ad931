//! One diagnosis for every kind of measurement.
//!
//! A kind implements [`Experiment`]: it states its readings less the simulation, the noise, what is
//! uncertain although nothing is wrong (nuisances), who may be to blame ([`Suspect`], each a *family* of
//! [`Member`]s: shapes of one mechanism) and how rows are held out. The engine brings the rest, in the
//! order of [`diagnose`]:
//!
//! 1. [`bank`]: columns whitened, nuisances integrated out (Woodbury), products cached;
//! 2. [`search`]: the evidence of sets of causes, singles by a rank-one scan, then partners, then the
//!    subsets of what leads;
//! 3. [`materiality`]: a cause must be of a size that matters before it takes part in the choice;
//! 4. [`posterior`]: probabilities of sets and of causes, tempered, and who can stand in for whom ([`rivals`]);
//! 5. [`unseen`]: the gain on rows that were not fitted, and `carried`, the same as it is told: for the simulation as it
//!    is used;
//! 6. [`rest`]: whether structure is left that no named cause makes;
//! 7. [`verdict`]: causes, groups, the verdict;
//! 8. `beside_rest`: names that what is left makes doubtful.
//!
//! Kinds that are not linear go this way again and again (`rounds`), as long as what was found is bent (`bend`), and their rivals too
//! (`peers`), and what is bent is told by where it fits best (`arrival`).
//!
//! Every number that decides stands in [`Judgement`], with its reason.

mod arrival;
mod aspect;
pub mod bank;
mod bend;
mod beside_rest;
mod blamed;
mod carried;
mod choice;
pub mod diagnosis;
mod entry;
mod intervals;
pub mod judgement;
mod leaves;
pub mod materiality;
pub mod noise;
mod nuisances;
mod peers;
mod picked;
pub mod posterior;
pub mod rest;
pub mod rivals;
mod rounds;
pub mod search;
pub mod statement;
mod told;
pub mod unseen;
pub mod verdict;

#[cfg(test)]
mod tests;

pub use arrival::Arrival;
pub use aspect::Aspects;
pub use diagnosis::{Found, diagnose};
pub use judgement::Judgement;
pub use noise::{Noise, White};
pub use nuisances::{ALLOWED, Alone, unblamed};
pub use statement::{
    Blamed, CanBe, Experiment, LEVEL, Member, Nuisance, Peers, Remaining, Statement, Suspect,
};
