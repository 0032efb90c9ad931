//! The experiment that would tell.
