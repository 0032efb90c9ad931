//! Floor 7: the virtual laboratory.
