//! The search for sets of causes: every single one from all its starts on broad peaks, pairs where a
//! single one leaves something that another would explain, then the best sets on sharp peaks.

use super::chord::{Chord, promise};
use super::data::Data;
use super::further::{followed, moved, nearby, parts, widened};
use super::map::{self, Fit, Way, fit};
use super::point::Point;
use super::prediction::Machine;
use super::suspect::{Suspect, same};
use crate::ground::problem::Outcome;
use rayon::prelude::*;

/// Steps of a descent: while starts compete, on broad peaks, on sharp ones.
const STEPS: [usize; 3] = [2, 8, 20];
/// Suspects that are tried by descent, those of them that go on, singles continued to pairs, partners
/// tried for each.
const TRIED: usize = 40;
const KEPT: usize = 24;
pub(super) const BASES: usize = 4;
const PARTNERS: usize = 6;
/// Starts of a cause from which it is tried by descent.
const STARTS: usize = 6;
/// Rounds in which the best set is continued on sharp peaks, and causes of a set at most.
const ROUNDS: usize = 2;
const LARGEST: usize = 2;
/// Nats that a partner must promise to be tried.
const PROMISE: f64 = 3.0;
/// Sets on broad peaks go on to sharp ones within these nats of the best, or this share of what the
/// best explains.
pub(super) const HOPE: (f64, f64) = (30.0, 0.15);

/// Everything that was compared, on sharp peaks; the empty set first.
pub struct Found {
    /// The fits.
    pub fits: Vec<Fit>,
}

/// Searches on `broad` and `sharp` data.
///
/// # Errors
/// The robot as simulated now cannot be computed.
pub fn search(
    machine: &Machine,
    suspects: &[Suspect],
    broad: &Data,
    sharp: &Data,
) -> Outcome<Found> {
    let nothing = fit(machine, broad, Point::nothing(), 2 * STEPS[1])?;
    let singles = singles(machine, suspects, broad, &nothing);
    let pairs = pairs(machine, suspects, broad, &singles);
    let mut points = vec![nothing.point.clone()];
    for fits in [&singles, &pairs] {
        points.extend(hopeful(fits, &nothing).map(|f| f.point.clone()));
    }
    Ok(sought(machine, suspects, sharp, points))
}

/// The same sets, and what they lead to, on lines that are weighed anew.
pub fn again(machine: &Machine, suspects: &[Suspect], sharp: &Data, found: &Found) -> Found {
    let mut fits = found.fits.clone();
    sort(&mut fits);
    let nothing = fits.iter().find(|f| f.point.set.is_empty());
    let mut points: Vec<Point> = nothing.map(|f| f.point.clone()).into_iter().collect();
    for fit in nothing.into_iter().flat_map(|n| hopeful(&fits, n)) {
        if !points.iter().any(|p| same_set(p, &fit.point)) {
            points.push(fit.point.clone());
        }
    }
    sought(machine, suspects, sharp, points)
}

/// Sets on sharp peaks, and what they lead to.
fn sought(machine: &Machine, suspects: &[Suspect], sharp: &Data, points: Vec<Point>) -> Found {
    let mut fits = sharpened(machine, sharp, points, STEPS[2]);
    for _ in 0..ROUNDS {
        let more = continued(machine, suspects, sharp, &fits);
        if more.is_empty() {
            break;
        }
        fits.extend(sharpened(machine, sharp, more, STEPS[2]));
    }
    let lead = |fits: &mut Vec<Fit>, ways: &[(Lead, usize)]| {
        for (points, steps) in ways {
            let points = points(fits);
            fits.extend(sharpened(machine, sharp, points, *steps));
        }
    };
    let near: [(Lead, usize); 4] = [
        (parts, STEPS[2]),
        (moved, STEPS[2]),
        (nearby, STEPS[1]),
        (nearby, STEPS[1]),
    ];
    lead(&mut fits, &near);
    let wide = widened(&fits).into_par_iter();
    let wide: Vec<Option<Fit>> = wide
        .map(|starts| lowest_of(machine, sharp, starts))
        .collect();
    fits.extend(wide.into_iter().flatten());
    lead(&mut fits, &[(followed, STEPS[2]), (parts, STEPS[2])]);
    Found { fits }
}

/// Where good sets lead to.
type Lead = fn(&[Fit]) -> Vec<Point>;

/// Of several starts of a set the one that is lowest after the first steps, fitted.
fn lowest_of(machine: &Machine, sharp: &Data, starts: Vec<Point>) -> Option<Fit> {
    let begun = starts
        .into_iter()
        .filter_map(|start| map::begin(machine, sharp, start, STEPS[0]).ok());
    lowest(begun)?.further(STEPS[2]).finish().ok()
}

fn sharpened(machine: &Machine, sharp: &Data, points: Vec<Point>, steps: usize) -> Vec<Fit> {
    let fits = points
        .into_par_iter()
        .map(|point| fit(machine, sharp, point, steps).ok())
        .collect::<Vec<_>>();
    fits.into_iter().flatten().collect()
}

/// What only sharp peaks show beside the best set (dampings above all), where it is not yet compared.
fn continued(machine: &Machine, suspects: &[Suspect], sharp: &Data, fits: &[Fit]) -> Vec<Point> {
    let best = fits.iter().max_by(|a, b| a.evidence.total_cmp(&b.evidence));
    let Some(best) = best.filter(|best| best.point.set.len() < LARGEST) else {
        return Vec::new();
    };
    let new = |point: &Point| !fits.iter().any(|fit| same_set(&fit.point, point));
    let partners = partners(machine, suspects, sharp, best).into_iter();
    partners.filter(new).collect()
}

/// Whether two sets have the same causes.
pub(super) fn same_set(a: &Point, b: &Point) -> bool {
    let held = |s: &Suspect| b.set.iter().any(|other| same(s, other));
    a.set.len() == b.set.len() && a.set.iter().all(held)
}

/// The fits that may still turn out best.
fn hopeful<'a>(fits: &'a [Fit], nothing: &'a Fit) -> impl Iterator<Item = &'a Fit> {
    let best = fits.first().map_or(0.0, |f| f.evidence);
    let within = HOPE.0 + HOPE.1 * (best - nothing.evidence).max(0.0);
    fits.iter().filter(move |f| f.evidence > best - within)
}

/// Every single cause that promises something, best first.
fn singles(machine: &Machine, suspects: &[Suspect], data: &Data, nothing: &Fit) -> Vec<Fit> {
    let promised = suspects
        .par_iter()
        .filter_map(|s| Some((promise(machine, data, nothing, s)?.0, s)))
        .collect::<Vec<_>>();
    let mut promised: Vec<(f64, &Suspect)> = promised;
    promised.sort_by(|a, b| b.0.total_cmp(&a.0));
    promised.truncate(TRIED);
    let begun = promised
        .par_iter()
        .map(|(_, suspect)| begin(machine, data, nothing, suspect))
        .collect::<Vec<_>>();
    let mut begun: Vec<Fit> = begun.into_iter().flatten().collect();
    sort(&mut begun);
    begun.truncate(KEPT);
    let ended = begun
        .into_par_iter()
        .map(|begun| fit(machine, data, begun.point, STEPS[1]).ok())
        .collect::<Vec<_>>();
    let mut ended: Vec<Fit> = ended.into_iter().flatten().collect();
    sort(&mut ended);
    ended
}

/// Best first.
pub fn sort(fits: &mut [Fit]) {
    fits.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
}

/// The first steps of a cause from those of its starts that promise most, and from nearly nothing with the nuisances of the
/// empty set.
fn begin(machine: &Machine, data: &Data, nothing: &Fit, suspect: &Suspect) -> Option<Fit> {
    let from = |theta: &Point, start: &[f64]| {
        map::begin(machine, data, theta.and(suspect, start), STEPS[0]).ok()
    };
    let clean = Point::nothing();
    let starts = promising(machine, data, nothing, suspect);
    let fresh = starts.iter().filter_map(|start| from(&clean, start));
    let small = suspect.times(starts.first()?, 0.02);
    let near = from(&nothing.point, &small);
    lowest(fresh.chain(near))?.finish().ok()
}

/// The starts of a cause; of more than a few those that promise most.
fn promising(machine: &Machine, data: &Data, nothing: &Fit, suspect: &Suspect) -> Vec<Vec<f64>> {
    let starts = suspect.starts();
    if starts.len() <= STARTS {
        return starts;
    }
    let chord = Chord::of(machine, data, nothing, suspect);
    let rated = starts
        .into_iter()
        .filter_map(|start| Some((chord.to(&start, 1.0)?.0, start)));
    let mut rated: Vec<(f64, Vec<f64>)> = rated.collect();
    rated.sort_by(|a, b| b.0.total_cmp(&a.0));
    rated.truncate(STARTS);
    rated.into_iter().map(|(_, start)| start).collect()
}

fn lowest<'a>(ways: impl Iterator<Item = Way<'a>>) -> Option<Way<'a>> {
    ways.min_by(|a, b| a.cost().total_cmp(&b.cost()))
}

/// The best singles with those partners that promise to explain what is left, best first.
fn pairs(machine: &Machine, suspects: &[Suspect], data: &Data, singles: &[Fit]) -> Vec<Fit> {
    let bases: Vec<&Fit> = singles.iter().take(BASES).collect();
    let points: Vec<Point> = bases
        .par_iter()
        .flat_map_iter(|base| partners(machine, suspects, data, base))
        .collect();
    let tried = points
        .into_par_iter()
        .map(|point| pair(machine, data, point))
        .collect::<Vec<_>>();
    let mut tried: Vec<Fit> = tried.into_iter().flatten().collect();
    sort(&mut tried);
    tried
}

/// A pair from where its first cause left the nuisances, and from nuisances as stated.
fn pair(machine: &Machine, data: &Data, point: Point) -> Option<Fit> {
    let fresh = Point {
        theta: Vec::new(),
        ..point.clone()
    };
    let begun = [point, fresh].into_iter();
    let begun = begun.filter_map(|point| map::begin(machine, data, point, STEPS[0]).ok());
    lowest(begun)?.further(STEPS[1]).finish().ok()
}

fn partners(machine: &Machine, suspects: &[Suspect], data: &Data, base: &Fit) -> Vec<Point> {
    let others = suspects
        .iter()
        .filter(|s| !base.point.set.iter().any(|own| same(own, s)));
    let tried = others.filter_map(|s| promise(machine, data, base, s));
    let mut promised: Vec<(f64, Point)> = tried.filter(|(nats, _)| *nats > PROMISE).collect();
    promised.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut best: Vec<Point> = Vec::new();
    for (_, point) in promised {
        // of the forms of a cause the one that promises most
        if best.len() < PARTNERS && !best.iter().any(|known| same_set(known, &point)) {
            best.push(point);
        }
    }
    best
}
