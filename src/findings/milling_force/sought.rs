//! A frequency or a time that suits the readings best: the best of several, brought closer step by step.

use super::Case;

/// What suits best.
pub(super) struct Sought {
    /// Where it stands, in the unit of the starts.
    pub at: f64,
    /// Its columns.
    pub columns: Vec<Vec<f64>>,
    /// What it lowers the misfit by.
    nats: f64,
}

impl Sought {
    /// The best of `starts`; then, for every one of `nearer`, what stands to either side of it if that is better. None that is
    /// not worth `least` nats to begin with.
    pub(super) fn of(
        case: &Case,
        starts: impl Iterator<Item = f64>,
        columns: impl Fn(f64) -> Vec<Vec<f64>>,
        (least, nearer): (f64, &[impl Fn(f64) -> [f64; 2]]),
    ) -> Option<Self> {
        let at = |at: f64| {
            let columns = columns(at);
            let nats = case.aim().fitted(&columns).1;
            Self { at, columns, nats }
        };
        let better = |a: Self, b: Self| if b.nats > a.nats { b } else { a };
        let first = starts.map(at).reduce(better)?;
        let closer = |found: Self, nearer: &dyn Fn(f64) -> [f64; 2]| {
            nearer(found.at).map(at).into_iter().fold(found, better)
        };
        (first.nats >= least).then(|| nearer.iter().fold(first, |f, n| closer(f, n)))
    }
}
