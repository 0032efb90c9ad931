//! Floor 0: what knows no robots and no measurements. Units, problems with a remedy, scalars that
//! carry derivatives, seeded random numbers.

pub mod dual;
pub mod files;
pub mod problem;
pub mod random;
pub mod units;
