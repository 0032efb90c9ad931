//! Two sensors at two levers: their ratio is information.

use crate::measurement::load_cycle::LoadCycle;

/// Logarithm of the second sensor's deflection over the first's, and its standard error, by total
/// least squares through the means. `None` without a second sensor.
pub fn log_ratio(file: &LoadCycle) -> Option<(f64, f64)> {
    let second = file.second.as_ref()?;
    let pairs: Vec<(f64, f64)> = file
        .deflection
        .iter()
        .zip(second)
        .filter(|(_, b)| b.is_finite())
        .map(|(a, b)| (*a, *b))
        .collect();
    let n = pairs.len() as f64;
    if pairs.len() < 4 {
        return None;
    }
    let (ma, mb) = (
        pairs.iter().map(|v| v.0).sum::<f64>() / n,
        pairs.iter().map(|v| v.1).sum::<f64>() / n,
    );
    let (mut aa, mut ab, mut bb) = (0.0, 0.0, 0.0);
    for (a, b) in &pairs {
        aa += (a - ma) * (a - ma);
        ab += (a - ma) * (b - mb);
        bb += (b - mb) * (b - mb);
    }
    let ratio = (bb - aa + ((bb - aa).powi(2) + 4.0 * ab * ab).sqrt()) / (2.0 * ab);
    let left = (bb - 2.0 * ratio * ab + ratio * ratio * aa).max(0.0) / n;
    // neighbouring rows share their noise: count one row in four
    let stderr = 2.0 * (left / aa).sqrt();
    (ratio > 0.0 && ratio.is_finite() && aa > 0.0).then(|| (ratio.ln(), stderr))
}
