//! Where good sets lead to: the same causes at other places, about other axes, from where others ended.

use super::map::Fit;
use super::point::Point;
use super::search::{BASES, HOPE, same_set};
use super::suspect::{Suspect, same};
use super::unseen::without;

/// Sets whose causes are tried at their other places.
const MOVED: usize = 2;

/// The best sets with a cause at another place of its site.
pub(super) fn moved(fits: &[Fit]) -> Vec<Point> {
    let leading = leading(fits, MOVED).into_iter();
    leading.flat_map(|f| f.point.moved()).collect()
}

/// The best set with a cause a little beside its place.
pub(super) fn nearby(fits: &[Fit]) -> Vec<Point> {
    let leading = leading(fits, 1).into_iter();
    leading.flat_map(|f| f.point.nearby()).collect()
}

/// The best sets, and the best that is a part of the best: where a cause sits a little beside its place, another makes up for it.
fn leading(fits: &[Fit], count: usize) -> Vec<&Fit> {
    let mut leading: Vec<&Fit> = best(fits, count).collect();
    let Some(first) = leading.first().map(|f| &f.point) else {
        return leading;
    };
    let is_part = |f: &&Fit| {
        let own = &f.point.set;
        let held = |s: &Suspect| first.set.iter().any(|other| same(s, other));
        !own.is_empty() && own.len() < first.set.len() && own.iter().all(held)
    };
    let parts = fits.iter().filter(is_part);
    let part = parts.max_by(|a, b| a.evidence.total_cmp(&b.evidence));
    leading.extend(part);
    leading
}

/// The best sets with a cause that gives way about any axis, from where it ended along those of the frame: of every set of causes that may
/// still turn out best the best of those that lie along it. Per form all its starts.
pub(super) fn widened(fits: &[Fit]) -> Vec<Vec<Point>> {
    let mut leading: Vec<&Fit> = Vec::new();
    let straight = worthwhile(fits).filter(|f| !f.point.widened().is_empty());
    for fit in straight {
        if !leading.iter().any(|f| same_set(&f.point, &fit.point)) {
            leading.push(fit);
        }
    }
    let leading = leading.into_iter().take(BASES);
    leading.flat_map(|f| f.point.widened()).collect()
}

/// Those that a cause more free could still make the best, best first.
fn worthwhile(fits: &[Fit]) -> impl Iterator<Item = &Fit> {
    let least = fits.iter().map(|f| f.evidence);
    let least = least.fold(f64::INFINITY, f64::min);
    let top = best(fits, 1).next().map_or(0.0, |f| f.evidence);
    let from = top - HOPE.0 - HOPE.1 * (top - least);
    best(fits, fits.len()).filter(move |f| f.evidence > from)
}

/// The other good sets from where the best ended.
pub(super) fn followed(fits: &[Fit]) -> Vec<Point> {
    let Some(leader) = best(fits, 1).next() else {
        return Vec::new();
    };
    let others = best(fits, 2 * BASES).skip(1);
    others
        .filter_map(|f| f.point.following(&leader.point))
        .collect()
}

/// So many of the most probable.
fn best(fits: &[Fit], count: usize) -> impl Iterator<Item = &Fit> {
    let mut best: Vec<&Fit> = fits.iter().collect();
    best.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    best.into_iter().take(count)
}

/// The best pairs with either cause left out, from where they ended: a pair is no better than its
/// parts only because these did not arrive.
pub(super) fn parts(fits: &[Fit]) -> Vec<Point> {
    best(fits, 2)
        .filter(|f| f.point.set.len() > 1)
        .flat_map(|f| f.point.set.iter().map(|s| without(&f.point, s)))
        .collect()
}
