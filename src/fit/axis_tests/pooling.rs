//! Repeats of one site as one test.

use super::AxisTest;
use crate::ground::stats::Z95;

/// Differences between repeats beyond this many standard deviations contradict each other.
const CONTRADICTS: f64 = 4.0;

/// Repeats of one site that contradict each other.
pub(super) fn contradiction(own: &[AxisTest]) -> Option<String> {
    let (first, last) = (
        own.iter()
            .min_by(|a, b| a.stiffness.0.total_cmp(&b.stiffness.0))?,
        own.iter()
            .max_by(|a, b| a.stiffness.0.total_cmp(&b.stiffness.0))?,
    );
    let apart = last.stiffness.0 - first.stiffness.0;
    let spread = first.stiffness.1.hypot(last.stiffness.1);
    (apart > CONTRADICTS * spread).then(|| {
        format!(
            "{}: {} and {} contradict each other ({:.0} and {:.0} N·m/rad, {:.1} standard deviations apart); \
             they are pooled with the scatter between them",
            first.site,
            first.input.0,
            last.input.0,
            first.stiffness.0,
            last.stiffness.0,
            apart / spread
        )
    })
}

/// Repeats of one site as one test: the mean weighed by their own errors and the scatter between them
/// (DerSimonian and Laird 1986), all else from the one with the smallest interval.
pub(super) fn pooled(own: &[AxisTest]) -> Option<AxisTest> {
    let width = |test: &&AxisTest| test.stiffness.1 / test.stiffness.0;
    let best = own.iter().min_by(|a, b| width(a).total_cmp(&width(b)))?;
    if own.len() < 2 {
        return Some(best.clone());
    }
    let between = between(own);
    let weight = |test: &AxisTest| 1.0 / (test.stiffness.1.powi(2) + between);
    let total: f64 = own.iter().map(weight).sum();
    let mean = own.iter().map(|t| weight(t) * t.stiffness.0).sum::<f64>() / total;
    let stderr = (1.0 / total).sqrt();
    let names: Vec<&str> = own.iter().map(|t| t.input.0.as_str()).collect();
    Some(AxisTest {
        stiffness: (mean, stderr),
        ci95: [mean - Z95 * stderr, mean + Z95 * stderr],
        input: (names.join(" + "), best.input.1.clone()),
        ..best.clone()
    })
}

/// Variance between repeats beyond their own errors.
fn between(own: &[AxisTest]) -> f64 {
    let weights: Vec<f64> = own.iter().map(|t| t.stiffness.1.powi(-2)).collect();
    let total: f64 = weights.iter().sum();
    let pairs = || own.iter().zip(&weights);
    let mean = pairs().map(|(t, w)| w * t.stiffness.0).sum::<f64>() / total;
    let misfit: f64 = pairs()
        .map(|(t, w)| w * (t.stiffness.0 - mean).powi(2))
        .sum();
    let squares: f64 = weights.iter().map(|w| w * w).sum();
    ((misfit - (own.len() as f64 - 1.0)) / (total - squares / total)).max(0.0)
}
