//! Patterns that no cause of the library has, kept beside it so that they take no neighbour's name:
//! where one of them explains the error best, the cause is unknown, and this is what is seen.

use super::play::Play;
use super::slide::{FAR, slide};
use crate::causes::contract::{Amount, Blame, Card, Cause, Sight};
use crate::causes::places::{UNIT_COMPLIANCE, added, drives, number_in, soften};
use crate::effects::Family;
use crate::experiments::drive_law::Law;
use crate::ground::spatial::V3;
use crate::ground::stats::descending;
use crate::robot::{Robot, Spring};
use nalgebra::{DMatrix, DVector};

/// All of them.
pub const STRANGERS: &[&dyn Cause] = &[&Shift, &Uneven, &Wave, &Play];

/// Whether a cause is none of the library.
pub fn is_stranger(cause: &dyn Cause) -> bool {
    STRANGERS.iter().any(|s| s.card().name == cause.card().name)
}

/// A body that gives way along an axis instead of about one.
struct Shift;

const CARD: Card = Card {
    name: "shift",
    family: Family::Physics,
    summary: "moves along an axis of its own without turning",
    equation: "C = C₀ + Σ c·R eₖ eₖᵀ Rᵀ",
    source: "prismatic virtual axes",
    shows: &[(Sight::Workspace, "compliance that no lever changes")],
    amounts: &[
        added("along_x", "compliance along x, with every joint at zero"),
        added("along_y", "compliance along y, with every joint at zero"),
        added("along_z", "compliance along z, with every joint at zero"),
    ],
};

impl Cause for Shift {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        (1..=robot.dof()).map(|i| format!("link{i}")).collect()
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    fn scale(&self, _robot: &Robot, _site: &str) -> Vec<f64> {
        vec![3.0; 3]
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        vec![vec![0], vec![1], vec![2], vec![0, 1, 2]]
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        let after = number_in(site, "link").unwrap_or(0);
        for (k, amount) in amounts.iter().enumerate().filter(|(_, a)| **a > 0.0) {
            let line: V3 = std::array::from_fn(|i| f64::from(u8::from(i == k)));
            let spring = Spring::new(FAR * FAR / (amount * UNIT_COMPLIANCE), 0.0);
            let name = format!("{site}-along-{k}");
            robot.elastic.push(slide(name, after, line, spring));
        }
    }
}

/// A drive whose compliance depends on sign or size of its torque.
struct Uneven;

const UNEVEN: Card = Card {
    name: "uneven",
    family: Family::Physics,
    summary: "gives way more under some loads than under others",
    equation: "δ = τ/k·(1 + x·[τ > 0]), or δ = τ/k·(1 + x·(τ/τ₁)²)",
    source: "hardening and softening springs: Worden and Tomlinson 2001",
    shows: &[(
        Sight::Workspace,
        "curves of displacement over force that bend",
    )],
    amounts: &[
        share("forwards", "excess under load in the positive sense"),
        share("backwards", "excess under load in the negative sense"),
        share(
            "softening",
            "excess at 1 kN·m, growing with the square of the torque",
        ),
    ],
};

const fn share(name: &'static str, meaning: &'static str) -> Amount {
    Amount::new(name, "1", meaning, [0.0, 100.0], &[0.5])
}

const LAWS: [Law; 3] = [
    Law::OneSided(1.0),
    Law::OneSided(-1.0),
    Law::Softening(1000.0),
];

impl Cause for Uneven {
    fn card(&self) -> &'static Card {
        &UNEVEN
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        drives(robot)
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        vec![vec![0], vec![1], vec![2]]
    }

    fn law(&self, amounts: &[f64]) -> Law {
        let own = amounts.iter().zip(LAWS).find(|(a, _)| **a > 0.0);
        own.map_or(LAWS[0], |(_, law)| law)
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        if let Some((_, spring)) = robot.springs_mut().find(|(name, _)| name == site) {
            spring.backlash.push(amounts.iter().sum());
        }
    }
}

/// A drive whose compliance waves with its angle.
pub struct Wave;

const WAVE: Card = Card {
    name: "wave",
    family: Family::Physics,
    summary: "is softer at some angles than at others",
    equation: "1/k = (1 + x(q))/k₀, x a smooth function of the angle of that axis",
    source: "teeth in mesh: Tuttle and Seering 1996; Gaussian process: Rasmussen and Williams 2006",
    shows: &[(
        Sight::Workspace,
        "error of one drive that differs from point to point",
    )],
    amounts: &[
        mode("mode_1"),
        mode("mode_2"),
        mode("mode_3"),
        mode("mode_4"),
        mode("mode_5"),
        mode("mode_6"),
    ],
};

const fn mode(name: &'static str) -> Amount {
    Amount::new(
        name,
        "1",
        "excess of compliance that goes with one shape over the angle",
        [-100.0, 100.0],
        &[0.3],
    )
}

impl Cause for Wave {
    fn card(&self) -> &'static Card {
        &WAVE
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        drives(robot)
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        soften(robot, site, amounts.iter().sum());
    }
}

/// Within this angle a wave keeps its value, rad.
const ALIKE: f64 = 0.2;

/// How a cause acts at the points `measured` (indices into `points`), amount by amount, if not everywhere
/// alike.
pub fn modes(
    cause: &dyn Cause,
    robot: &Robot,
    site: &str,
    (points, measured): (&[Vec<f64>], &[usize]),
) -> Option<DMatrix<f64>> {
    (cause.card().name == WAVE.name).then_some(())?;
    let joint = robot.joints.iter().position(|j| j.name == site)?;
    let angles: Vec<f64> = measured.iter().map(|i| points[*i][joint]).collect();
    let root = root_of_kernel(&angles);
    let eigen = root.tr_mul(&root).symmetric_eigen();
    let order = descending(eigen.eigenvalues.as_slice());
    let mut modes = DMatrix::zeros(angles.len(), WAVE.amounts.len());
    for (k, at) in order.iter().take(WAVE.amounts.len()).enumerate() {
        modes.set_column(k, &(&root * eigen.eigenvectors.column(*at)));
    }
    Some(modes)
}

/// L with LLᵀ the likeness of the angles, by Cholesky's method with pivots (Harbrecht, Peters and
/// Schneider 2012): waves over angles are smooth, so that few columns hold it to the last digits.
fn root_of_kernel(angles: &[f64]) -> DMatrix<f64> {
    let n = angles.len();
    let alike = |i: usize, j: usize| (-0.5 * ((angles[i] - angles[j]) / ALIKE).powi(2)).exp();
    let mut left = vec![1.0_f64; n];
    let mut columns: Vec<DVector<f64>> = Vec::new();
    while columns.len() < n {
        let pivot = (0..n).fold(0, |p, i| if left[i] > left[p] { i } else { p });
        if left[pivot] < 1e-13 {
            break;
        }
        let root = left[pivot].sqrt();
        let taken = |i: usize| columns.iter().map(|c| c[i] * c[pivot]).sum::<f64>();
        let column = DVector::from_fn(n, |i, _| (alike(i, pivot) - taken(i)) / root);
        for (left, x) in left.iter_mut().zip(column.iter()) {
            *left = (*left - x * x).max(0.0);
        }
        left[pivot] = 0.0;
        columns.push(column);
    }
    match columns.is_empty() {
        true => DMatrix::zeros(n, 0),
        false => DMatrix::from_columns(&columns),
    }
}
