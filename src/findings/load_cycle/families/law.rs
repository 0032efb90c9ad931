//! The law of an effect: its curves over the grid of its shapes; where it has no family beside it, so finely
//! that a step of the grid does not look like a second cause.

use super::View;
use crate::effects::{Composite, Effect};
use crate::findings::engine::Member;
use crate::fit::observation::Observation;

/// Correlation of neighbouring curves at which a grid is fine enough: what is left of an effect of 30
/// noise deviations halfway between them is then within two.
const ALIKE: f64 = 0.98;
/// Most values of one shape, and most curves of one law.
const MOST: (usize, usize) = (33, 150);

/// The curves of an effect as members of its suspect.
/// `alone`: it has no family.
pub fn members(
    effect: &'static dyn Effect,
    alone: bool,
    data: &Observation,
    view: &View,
) -> Vec<Member> {
    let one_signed = effect.card().parameters[0].bounds.0 >= 0.0;
    let member = |p: Vec<f64>| {
        let column = curve(effect, &p, data, view)?;
        let member = Member::free(column).shaped(&p);
        Some(match one_signed {
            true => member.positive(),
            false => member,
        })
    };
    let points = points(&axes(effect, alone, data, view));
    points.into_iter().filter_map(member).collect()
}

/// What one unit of the effect adds, beyond the spring.
fn curve(
    effect: &'static dyn Effect,
    p: &[f64],
    data: &Observation,
    view: &View,
) -> Option<Vec<f64>> {
    let stiffness = data.scene.load_scale / data.scene.deflection_scale;
    let parameters: Vec<f64> = std::iter::once(stiffness)
        .chain(p.iter().copied())
        .collect();
    let whole = Composite::new(&[effect]).predict(&parameters, &data.scene);
    let rows = whole.iter().zip(&data.scene.load);
    let own: Vec<f64> = rows.map(|(y, m)| (y - m / stiffness) / p[0]).collect();
    own.iter()
        .all(|v| v.is_finite())
        .then(|| view.beyond_spring(&own))?
}

/// Values of every parameter, SI; those of the shapes finely.
fn axes(
    effect: &'static dyn Effect,
    alone: bool,
    data: &Observation,
    view: &View,
) -> Vec<Vec<f64>> {
    let parameters = effect.card().parameters.iter();
    let mut axes: Vec<Vec<f64>> = parameters
        .map(|p| p.grid.iter().map(|g| g * p.scale.of(&data.scene)).collect())
        .collect();
    let middle: Vec<f64> = axes.iter().map(|axis| axis[axis.len() / 2]).collect();
    let shapes = if alone { 1..axes.len() } else { 0..0 };
    for k in shapes {
        let at = |value: f64| {
            let mut p = middle.clone();
            p[k] = value;
            curve(effect, &p, data, view)
        };
        axes[k] = bisected(&axes[k], &at);
    }
    axes
}

/// A grid with halves between neighbours whose curves are not alike.
fn bisected(grid: &[f64], curve: &dyn Fn(f64) -> Option<Vec<f64>>) -> Vec<f64> {
    let mut all: Vec<(f64, Option<Vec<f64>>)> = grid.iter().map(|v| (*v, curve(*v))).collect();
    let mut at = 0;
    while at + 1 < all.len() && all.len() < MOST.0 {
        let alike = match (&all[at].1, &all[at + 1].1) {
            (Some(a), Some(b)) => correlation(a, b) > ALIKE,
            _ => true,
        };
        match alike {
            true => at += 1,
            false => {
                let half = 0.5 * (all[at].0 + all[at + 1].0);
                all.insert(at + 1, (half, curve(half)));
            }
        }
    }
    all.into_iter().map(|point| point.0).collect()
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(p, q)| p * q).sum::<f64>();
    dot(a, b) / (dot(a, a) * dot(b, b)).sqrt().max(f64::MIN_POSITIVE)
}

/// All combinations, the longest axis thinned where they are too many.
fn points(axes: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut axes = axes.to_vec();
    while axes.iter().map(Vec::len).product::<usize>() > MOST.1 {
        if let Some(longest) = axes.iter_mut().max_by_key(|axis| axis.len()) {
            *longest = longest.iter().copied().step_by(2).collect();
        }
    }
    axes.iter().fold(vec![Vec::new()], |points, axis| {
        let longer = |point: &Vec<f64>| {
            let own = point.clone();
            axis.iter().map(move |value| [&own[..], &[*value]].concat())
        };
        points.iter().flat_map(longer).collect()
    })
}
