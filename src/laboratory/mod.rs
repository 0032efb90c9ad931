//! Floor 8: the virtual laboratory. Campaigns with known truth, hidden effects, blind sets.

pub mod blind;
pub mod hammer_blow;
pub mod hammer_truth;
pub mod hide;
pub mod noise;
pub mod recording;
pub mod truth;
pub mod workspace;
