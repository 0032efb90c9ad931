//! Sites of which the cubes see only a sum: "cumulative values of the sensor and axis 6" (source 002).

use super::solved::Solved;
use crate::fit::parameter::{Status, Z95};

/// Sites that are seen together only.
#[derive(Debug, Clone, PartialEq)]
pub struct Together {
    /// Their names.
    pub sites: Vec<String>,
    /// Stiffness of all in series about one axis, N·m/rad, with its 95 % interval; none where they do not
    /// turn about one axis.
    pub stiffness: Option<(f64, [f64; 2])>,
}

/// Beyond this correlation two sites are not told apart.
const BOUND: f64 = 0.8;
/// Beyond this cosine two sites move the cubes in the same way.
const PARALLEL: f64 = 0.999;

/// The groups among the sites that are not fixed.
pub fn together(solved: &Solved) -> Vec<Together> {
    let n = solved.sites.len();
    let open: Vec<usize> = (0..n)
        .filter(|i| solved.seen[*i] && solved.status[*i] != Status::Identified)
        .collect();
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for i in open {
        let (near, mut rest): (Vec<Vec<usize>>, Vec<Vec<usize>>) =
            groups.into_iter().partition(|group| {
                group
                    .iter()
                    .any(|j| correlation(solved, i, *j).abs() > BOUND)
            });
        let mut own: Vec<usize> = near.into_iter().flatten().chain([i]).collect();
        own.sort_unstable();
        rest.push(own);
        groups = rest;
    }
    groups.retain(|group| group.len() > 1);
    groups.sort();
    groups
        .iter()
        .map(|group| Together {
            sites: group
                .iter()
                .map(|i| solved.sites[*i].name.clone())
                .collect(),
            stiffness: series(solved, group),
        })
        .collect()
}

fn correlation(solved: &Solved, i: usize, j: usize) -> f64 {
    let c = &solved.covariance;
    c[(i, j)] / (c[(i, i)] * c[(j, j)]).sqrt()
}

/// Stiffness of sites that move the cubes in the same way: their compliances add.
fn series(solved: &Solved, group: &[usize]) -> Option<(f64, [f64; 2])> {
    let column = |i: usize| solved.design.column(i).normalize();
    let alike = group
        .iter()
        .all(|i| column(*i).dot(&column(group[0])) > PARALLEL);
    let sum: f64 = group.iter().map(|i| solved.compliance(*i)).sum();
    let nominal = |i: usize| solved.sites[i].compliance;
    let pairs = group
        .iter()
        .flat_map(|i| group.iter().map(move |j| (*i, *j)));
    let variance: f64 = pairs
        .map(|(i, j)| solved.covariance[(i, j)] * nominal(i) * nominal(j))
        .sum();
    let half = Z95 * variance.max(0.0).sqrt();
    (alike && half < 0.5 * sum).then(|| (1.0 / sum, [1.0 / (sum + half), 1.0 / (sum - half)]))
}
