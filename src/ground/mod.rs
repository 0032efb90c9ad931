//! Floor 0: what knows no robots and no measurements. Units, problems with a remedy, scalars that
//! carry derivatives, 6-D spatial algebra, seeded random numbers, statistics.

pub mod arctangent;
pub mod cholesky;
pub mod dual;
pub mod files;
pub mod nearest;
pub mod problem;
pub mod products;
pub mod random;
pub mod spatial;
pub mod stats;
pub mod trig;
pub mod units;
pub mod vector;
