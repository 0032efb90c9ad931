//! The speed at which the teeth pass.

use super::CutFit;
use super::layout::SPEED_STD;
use crate::experiments::milling_force::SPEED;

/// Standard deviations by which the teeth may pass at another speed than stated, six tenths of a percent: it is no
/// longer sure then that table and spindle ran as stated. A choice.
const OFF: f64 = 6.0;

/// The cut, from 0, whose teeth pass farthest beside the stated speed, and by which share of it; none where all are near.
pub fn off_speed(cuts: &[CutFit]) -> Option<(usize, f64)> {
    let each = cuts.iter().map(|cut| cut.p[SPEED]).enumerate();
    let finite = each.filter(|(_, share)| share.is_finite());
    let farthest = finite.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    (farthest.1.abs() > OFF * SPEED_STD).then_some(farthest)
}
