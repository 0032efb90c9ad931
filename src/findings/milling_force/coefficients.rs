//! The material cuts otherwise than stated, or the edge is worn: coefficients beyond what is uncertain.

use super::Case;
use super::setting::PROCESS;
use crate::cutting::LINEAR_EDGE;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;

pub(super) const CUTTING: Effect<Case> = Effect {
    name: "cutting_coefficients",
    summary: "The material needs another force per area of chip than stated.",
    mechanism: "cutting",
    law_error: 0.03,
    can_be: |_, _| true,
    places: |case| places(case, 0),
    parameters,
    would_tell: "cut at several feeds and depths, and put a known force on the sensor",
};

pub(super) const EDGE: Effect<Case> = Effect {
    name: "edge_coefficients",
    summary: "The edge needs another force per length than stated: it is worn.",
    mechanism: "edge",
    law_error: 0.03,
    can_be: |_, _| true,
    places: |case| places(case, 3),
    parameters,
    would_tell: "cut at several feeds, and look at the edge",
};

/// All three in proportion, each alone, all three freely. None where nothing is stated.
fn places(case: &Case, first: usize) -> Vec<Place> {
    if !case.is_stated() {
        return Vec::new();
    }
    let nominal = case.nominal();
    let own = first..first + 3;
    let direction = |of: &dyn Fn(usize) -> f64| {
        let mut direction = vec![0.0; case.places().len()];
        own.clone().for_each(|j| direction[j] = of(j));
        direction
    };
    // a coefficient that is stated as zero is counted in the size of its kind
    let size = nominal[own.clone()]
        .iter()
        .fold(1.0, |a: f64, b| a.max(b.abs()));
    let single = |j: usize| direction(&|i| if i == j { size } else { 0.0 });
    let mut members = vec![far(case, &direction(&|j| nominal[j]), MOST, &[])];
    members.extend(own.clone().map(|j| far(case, &single(j), MOST, &[])));
    members.push(member(case, &own.clone().map(single).collect::<Vec<_>>()));
    members.retain(|m| m.columns.iter().flatten().any(|x| *x != 0.0));
    vec![Place::new("material", members)]
}

/// No coefficient is farther off, in its own size.
const MOST: f64 = 3.0;

/// A cause of the process along directions of the vector.
pub(super) fn member(case: &Case, directions: &[Vec<f64>]) -> Member {
    Member {
        columns: directions.iter().map(|d| case.along(d)).collect(),
        size: Size::Free,
        shape: std::iter::once(PROCESS)
            .chain(directions.iter().flatten().copied())
            .collect(),
        ..Member::free(Vec::new())
    }
}

/// A cause of the process along one direction that is not linear: the way to where it fits best, at most
/// `most` far, tried from `starts` too.
pub(super) fn far(case: &Case, direction: &[f64], most: f64, starts: &[f64]) -> Member {
    let shape: Vec<f64> = [PROCESS]
        .into_iter()
        .chain(direction.iter().copied())
        .collect();
    Member::free(case.aim().secant(case, direction, most, starts)).shaped(&shape)
}

/// What a cause makes of the vector.
pub(super) fn moved(case: &Case, blamed: &Blamed) -> Vec<f64> {
    let mut sum = vec![0.0; case.places().len()];
    let each = blamed.shape[1..].chunks(sum.len()).zip(&blamed.amounts);
    for (direction, amount) in each {
        for (s, d) in sum.iter_mut().zip(direction) {
            *s += d * amount;
        }
    }
    sum
}

fn parameters(case: &Case, blamed: &Blamed) -> Vec<(&'static str, f64, &'static str)> {
    let sum = moved(case, blamed);
    let card = LINEAR_EDGE.card();
    let own = (0..6).filter(|j| sum[*j] != 0.0);
    own.map(|j| {
        let unit = if j < 3 { "N/m²" } else { "N/m" };
        (card.coefficients[j].name, case.nominal()[j] + sum[j], unit)
    })
    .collect()
}
