//! A stated limit: the points of a test that are diagnosed. Columns and rows of the evidence both grow
//! with the points, so memory and time grow with their square.

use crate::fit::suitability::{Doubt, Weight};
use crate::measurement::workspace_test::WorkspaceTest;

/// Points that are diagnosed at most.
pub const MOST_POINTS: usize = 24;

/// The test with at most [`MOST_POINTS`] of its points, evenly spread over the file, and what to say of that.
pub fn thinned(test: &WorkspaceTest) -> Option<(WorkspaceTest, Doubt)> {
    let mut points: Vec<usize> = test.steps.iter().map(|s| s.point).collect();
    points.sort_unstable();
    points.dedup();
    let all = points.len();
    if all <= MOST_POINTS {
        return None;
    }
    let kept: Vec<usize> = (0..MOST_POINTS)
        .map(|i| points[i * all / MOST_POINTS])
        .collect();
    let steps = test
        .steps
        .iter()
        .filter(|s| kept.binary_search(&s.point).is_ok());
    let doubt = Doubt {
        rule: "many-points",
        weight: Weight::Note,
        what: format!(
            "of {all} points {MOST_POINTS}, evenly spread, are diagnosed: that is the limit"
        ),
        remedy: "give fewer points in a file to choose them yourself",
    };
    let thin = WorkspaceTest {
        steps: steps.copied().collect(),
        facts: test.facts.clone(),
        path: test.path.clone(),
        sha256: test.sha256.clone(),
        rows: test.rows,
        left_out: test.left_out,
    };
    Some((thin, doubt))
}
