//! Floor 8: the virtual laboratory. Campaigns with known truth, hidden effects, blind sets.

pub mod blind;
pub mod cubes_truth;
pub mod hammer_blow;
pub mod hammer_truth;
pub mod hide;
pub mod noise;
pub mod recording;
pub mod screw_truth;
pub mod sensor_truth;
pub mod truth;
pub mod workspace;
