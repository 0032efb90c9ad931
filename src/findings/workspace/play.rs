//! Play between flange and tool: a pattern that no cause of the library has, and that takes the name of a gap in a joint.

use super::slide::{FAR, slide};
use crate::causes::contract::{Amount, Blame, Card, Cause, Sight};
use crate::effects::Family;
use crate::experiments::drive_law::Law;
use crate::ground::spatial::V3;
use crate::robot::{Robot, Spring};

/// The tool has play along a line that goes with the hand.
pub(super) struct Play;

const CARD: Card = Card {
    name: "play",
    family: Family::Physics,
    summary: "has play along a line of its own, wherever the joints stand",
    equation: "δ = ½ s·clip(v·F/F₁) v, v fixed to the hand, F₁ the force within which it is crossed",
    source: "dead zone: Nordin and Gutman 2002, along a line instead of about a joint",
    shows: &[(
        Sight::Workspace,
        "a jump along a line of the hand, of the same size at every point",
    )],
    amounts: &[
        along("tight_x"),
        along("tight_y"),
        along("tight_z"),
        along("tight_yz"),
        along("tight_zy"),
        along("tight_zx"),
        along("tight_xz"),
        along("tight_xy"),
        along("tight_yx"),
        along("tight_xyz"),
        along("tight_yzx"),
        along("tight_zxy"),
        along("tight_against"),
        along("wide_x"),
        along("wide_y"),
        along("wide_z"),
        along("wide_yz"),
        along("wide_zy"),
        along("wide_zx"),
        along("wide_xz"),
        along("wide_xy"),
        along("wide_yx"),
        along("wide_xyz"),
        along("wide_yzx"),
        along("wide_zxy"),
        along("wide_against"),
    ],
};

const fn along(name: &'static str) -> Amount {
    Amount::new(name, "m", "play from stop to stop", [0.0, 0.01], &[1e-4])
}

const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
const THIRD: f64 = 0.577_350_269_189_625_8;

/// The lines, with every joint at zero: along the axes, and between two and three of them.
const LINES: [V3; 13] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, HALF, HALF],
    [0.0, HALF, -HALF],
    [HALF, 0.0, HALF],
    [-HALF, 0.0, HALF],
    [HALF, HALF, 0.0],
    [HALF, -HALF, 0.0],
    [THIRD, THIRD, THIRD],
    [-THIRD, THIRD, THIRD],
    [THIRD, -THIRD, THIRD],
    [THIRD, THIRD, -THIRD],
];

/// Forces within which it is crossed, N: no more than a sliding fit rubs, and some percent of the 500 to 1500 N of a test,
/// where flanks close one after the other. No other values were tried.
const WITHIN: [f64; 2] = [10.0, 50.0];

/// Stiff enough to be none beside the play, N·m/rad: 2.5e-13 m/N along the line.
const STIFF: f64 = 1e20;

impl Cause for Play {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, _robot: &Robot) -> Vec<String> {
        vec!["tool".into()]
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        (0..CARD.amounts.len()).map(|k| vec![k]).collect()
    }

    fn law(&self, amounts: &[f64]) -> Law {
        let wide = amounts.iter().position(|a| *a > 0.0);
        let within = WITHIN[usize::from(wide.is_some_and(|k| k >= LINES.len()))];
        Law::Unpressed(within * FAR)
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        for (k, amount) in amounts.iter().enumerate().filter(|(_, a)| **a > 0.0) {
            let mut spring = Spring::new(STIFF, 0.0);
            spring.backlash.push(amount / FAR);
            let (name, line) = (format!("{site}-play-{k}"), LINES[k % LINES.len()]);
            robot.elastic.push(slide(name, robot.dof(), line, spring));
        }
    }
}
