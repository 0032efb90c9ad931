//! Floor 0: what knows no robots and no measurements. Units, problems with a remedy, scalars that
//! carry derivatives, 6-D spatial algebra, seeded random numbers.

pub mod cholesky;
pub mod dual;
pub mod files;
pub mod problem;
pub mod random;
pub mod spatial;
pub mod trig;
pub mod units;
pub mod vector;
pub mod words;
