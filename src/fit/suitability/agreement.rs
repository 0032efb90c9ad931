//! Whether the slopes of separate pieces agree beyond chance: Student's test, weighed.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// Slope of the response over the drive in one piece, and the squares of the drive about its mean.
pub fn slope((a, b): (usize, usize), drive: &[f64], response: &[f64]) -> (f64, f64) {
    let n = (b - a + 1) as f64;
    let (x, y) = (&drive[a..=b], &response[a..=b]);
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let (mut xx, mut xy) = (0.0, 0.0);
    for (x, y) in x.iter().zip(y) {
        xx += (x - mx) * (x - mx);
        xy += (x - mx) * (y - my);
    }
    (if xx > 0.0 { xy / xx } else { 0.0 }, xx)
}

/// Mean of slopes, each with its weight, and the probability that chance makes it differ so from zero.
pub fn of_slopes(slopes: &[(f64, f64)]) -> (f64, f64) {
    let total: f64 = slopes.iter().map(|s| s.1).sum();
    if total <= 0.0 || !total.is_finite() {
        return (0.0, 1.0);
    }
    let mean = slopes.iter().map(|(b, w)| b * w).sum::<f64>() / total;
    let squares: f64 = slopes.iter().map(|(_, w)| (w / total).powi(2)).sum();
    let count = 1.0 / squares;
    let scatter = slopes.iter().map(|(b, w)| (w / total * (b - mean)).powi(2));
    let error = (scatter.sum::<f64>() * count / (count - 1.0)).sqrt();
    if count < 1.5 || !mean.is_finite() {
        return (mean, 1.0);
    }
    let p = match StudentsT::new(0.0, 1.0, count - 1.0) {
        Ok(student) if error > 0.0 => 2.0 * student.sf((mean / error).abs()),
        _ if mean != 0.0 => 0.0,
        _ => 1.0,
    };
    (mean, p)
}
