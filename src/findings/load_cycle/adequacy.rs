//! Whether anything is left.

/// What the test of a residual says.
#[derive(Debug, Clone)]
pub struct Adequacy {
    /// Probability that chance leaves so much.
    pub p_value: f64,
    /// Share of the misfit's variance that is unexplained.
    pub unexplained: f64,
    /// Which test spoke.
    pub test: &'static str,
}
