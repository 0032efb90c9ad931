//! Stabilisation: poles that come back from order to order are those of the structure.

use super::lscf::Lscf;
use super::modal_model::{Channels, damping, frequency};
use rustfft::num_complex::Complex64;

/// Highest number of poles asked for, over all inputs.
const MOST_POLES: usize = 66;
/// Distance, as a share of |p|, within which two poles are the same.
const SAME: f64 = 0.015;
/// Damping ratios that a structure may have.
const DAMPING: std::ops::Range<f64> = 1e-5..0.3;

/// One point of the stabilisation chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Order of the polynomial.
    pub order: usize,
    /// The pole, 1/s.
    pub pole: Complex64,
    /// Whether the order before had the same pole (1 % in frequency, 20 % in damping).
    pub stable: bool,
}

/// A group of equal poles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// Its middle, 1/s.
    pub pole: Complex64,
    /// At how many orders it was seen.
    pub seen: usize,
}

/// The stabilisation chart of all orders.
pub fn chart(channels: &Channels) -> Vec<Point> {
    let inputs = channels.shape.0;
    let limit = channels.lines() / 2;
    let highest = (MOST_POLES / inputs).min(limit).max(4);
    let lscf = Lscf::new(channels, highest);
    let step = if inputs == 1 { 2 } else { 1 };
    let mut points = Vec::new();
    let mut before: Vec<Complex64> = Vec::new();
    for order in (2..=highest).step_by(step) {
        let poles = lscf.poles(order);
        let poles: Vec<_> = poles
            .into_iter()
            .filter(|p| DAMPING.contains(&damping(*p)))
            .collect();
        points.extend(poles.iter().map(|pole| Point {
            order,
            pole: *pole,
            stable: before.iter().any(|other| agrees(*pole, *other)),
        }));
        before = poles;
    }
    points
}

fn agrees(a: Complex64, b: Complex64) -> bool {
    let near = |a: f64, b: f64, share: f64| (a - b).abs() <= share * b;
    near(frequency(a), frequency(b), 0.01) && near(damping(a), damping(b), 0.2)
}

/// Groups the stable points, the most frequent first.
pub fn candidates(chart: &[Point]) -> Vec<Candidate> {
    let mut left: Vec<Complex64> = chart.iter().filter(|p| p.stable).map(|p| p.pole).collect();
    let mut found = Vec::new();
    while let Some(centre) = most_crowded(&left) {
        let (group, rest): (Vec<_>, Vec<_>) = left.iter().partition(|p| same(**p, centre));
        found.push(Candidate {
            pole: middle(&group),
            seen: group.len(),
        });
        left = rest;
    }
    found.sort_by_key(|candidate| std::cmp::Reverse(candidate.seen));
    found
}

fn same(a: Complex64, b: Complex64) -> bool {
    (a - b).norm() < SAME * b.norm()
}

fn most_crowded(poles: &[Complex64]) -> Option<Complex64> {
    let crowd = |p: &&Complex64| poles.iter().filter(|q| same(**q, **p)).count();
    poles.iter().max_by_key(crowd).copied()
}

fn middle(group: &[Complex64]) -> Complex64 {
    let re: Vec<f64> = group.iter().map(|p| p.re).collect();
    let im: Vec<f64> = group.iter().map(|p| p.im).collect();
    Complex64::new(super::outliers::median(&re), super::outliers::median(&im))
}
