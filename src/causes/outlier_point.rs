//! One point was measured wrong.

use super::contract::{Amount, Card, Cause, Sight, StepSeen};
use super::places::number_in;
use crate::effects::Family;
use crate::ground::spatial::V3;
use crate::ground::stats::length;
use crate::robot::Robot;

/// See the card.
pub struct OutlierPoint;

const CARD: Card = Card {
    name: "outlier_point",
    family: Family::Measurement,
    summary: "One point does not go with the others: its set-up slipped, or its posture is not the stated one.",
    equation: "d = (1 + g + gⱼ)·C·F + sⱼ·|C·F| at that point, j the direction of the force",
    source: "gross errors: Huber 1981",
    shows: &[(
        Sight::Workspace,
        "all displacements of one point off, and no other",
    )],
    amounts: &[
        share(
            "gain_error",
            "relative error of every displacement of the point",
        ),
        share("gain_error_x", "further relative error under force in x"),
        share("gain_error_y", "further relative error under force in y"),
        share("gain_error_z", "further relative error under force in z"),
        share(
            "stray_xx",
            "error in x under force in x, of the size of the displacement",
        ),
        share("stray_xy", "error in y under force in x"),
        share("stray_xz", "error in z under force in x"),
        share("stray_yx", "error in x under force in y"),
        share("stray_yy", "error in y under force in y"),
        share("stray_yz", "error in z under force in y"),
        share("stray_zx", "error in x under force in z"),
        share("stray_zy", "error in y under force in z"),
        share("stray_zz", "error in z under force in z"),
    ],
};

const fn share(name: &'static str, meaning: &'static str) -> Amount {
    Amount::new(name, "1", meaning, [-2.0, 10.0], &[0.4, -0.3])
}

impl Cause for OutlierPoint {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, _robot: &Robot) -> Vec<String> {
        Vec::new()
    }

    fn sites_at(&self, _robot: &Robot, points: usize) -> Vec<String> {
        (1..=points).map(|i| format!("point{i}")).collect()
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        let gains = [vec![0], vec![1], vec![2], vec![3], vec![0, 1, 2, 3]];
        let one = (0..3).map(|d| (4 + 3 * d..7 + 3 * d).collect());
        let all = (4..13).collect();
        gains.into_iter().chain(one).chain([all]).collect()
    }

    fn read_step(&self, site: &str, amounts: &[f64], _compliance: &[V3; 3], step: &mut StepSeen) {
        if number_in(site, "point") == Some(step.point + 1) {
            let factor = 1.0 + amounts[0] + amounts[1 + step.direction];
            let size = length(&step.displacement);
            let sign = step.force.signum();
            for (k, d) in step.displacement.iter_mut().enumerate() {
                *d = *d * factor + amounts[4 + 3 * step.direction + k] * size * sign;
            }
        }
    }
}
