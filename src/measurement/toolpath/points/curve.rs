//! Control points of a NURBS.

use super::Columns;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::front::Front;
use crate::measurement::table::Table;
use crate::measurement::toolpath::draft::within;
use crate::measurement::toolpath::{Move, Nurbs};

/// Highest degree of a curve.
const HIGHEST: f64 = 20.0;

pub(super) fn curve(table: &Table, columns: &Columns<'_>, points: Vec<Move>) -> Outcome<Nurbs> {
    let front = &table.front;
    let degree = front.positive("degree")?;
    let whole = |d: &f64| d.fract() == 0.0 && *d <= HIGHEST && (*d as usize) < points.len();
    let degree = degree.filter(whole).ok_or_else(|| {
        let what = format!(
            "is no degree of a curve through {} control points",
            points.len()
        );
        front.problem(
            "degree",
            what,
            "write a whole number from 1 to 20, fewer than points: `# degree = 3`",
        )
    })? as usize;
    let weights = match columns.weight {
        None => vec![1.0; points.len()],
        Some(weights) => weights.to_vec(),
    };
    if let Some(row) = weights.iter().position(|w| w.is_nan() || *w <= 0.0) {
        let remedy = "write a weight above zero for every control point, or leave the column out";
        let problem = Problem::new("the weight is not above zero", remedy).in_column("weight");
        return Err(problem.at_line(points[row].line));
    }
    Ok(Nurbs {
        degree,
        knots: knots(front, degree, points.len())?,
        weights,
        feed: one_feed(&points)?,
        orientations: points.iter().map(|point| point.orientation).collect(),
        lines: points.iter().map(|point| point.line).collect(),
        points: points.iter().map(|point| point.to).collect(),
    })
}

fn knots(front: &Front, degree: usize, points: usize) -> Outcome<Vec<f64>> {
    let refused = |what: String| {
        let remedy = "give points + degree + 1 knots that never decrease, none more than degree times (at the ends degree + 1): `# knots = [0, 0, 0, 1, 1, 1]`";
        front.problem("knots", what, remedy)
    };
    let knots = front
        .numbers("knots")?
        .ok_or_else(|| refused("is missing".into()))?;
    let wanted = points + degree + 1;
    if knots.len() != wanted {
        return Err(refused(format!(
            "has {} knots instead of {wanted}",
            knots.len()
        )));
    }
    if knots.windows(2).any(|pair| pair[1] < pair[0]) {
        return Err(refused("decreases".into()));
    }
    let inner = &knots[1..wanted - 1];
    let repeated = inner.windows(degree + 1).any(|run| run[0] == run[degree]);
    if repeated || knots[degree] >= knots[points] {
        return Err(refused("repeats a knot too often".into()));
    }
    within([knots[0] * 1e-3, knots[wanted - 1] * 1e-3, 0.0])
        .map_err(|_| refused("is out of range".into()))?;
    Ok(knots)
}

/// The feed of a curve: one for all.
fn one_feed(points: &[Move]) -> Outcome<Option<f64>> {
    let mut feeds = points
        .iter()
        .filter_map(|p| p.feed.map(|feed| (feed, p.line)));
    let first = feeds.next();
    let other = feeds.find(|feed| first.is_some_and(|first| first.0 != feed.0));
    let rapid = points
        .iter()
        .find(|point| point.rapid)
        .map(|point| point.line);
    match other.map(|other| other.1).or(rapid) {
        None => Ok(first.map(|first| first.0)),
        Some(line) => Err(Problem::new(
            "a curve has one feed and no rapid motion",
            "write the same feed for every control point, or leave the columns out",
        )
        .at_line(line)),
    }
}
