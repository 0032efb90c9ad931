//! What the points of a workspace test cannot tell apart, whatever the priors: axes that move the
//! tool alike, and small singular directions of the design. The foundation is always considered.

use super::weighing::Weighing;
use crate::experiments::workspace::{Response, Site};
use crate::robot::{ElasticAxis, Robot, Spring};
use nalgebra::{DMatrix, DVector};

/// Why a combination is not told apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The axes move the tool in exactly the same way at every point.
    Exact,
    /// They do so nearly.
    Near,
    /// Their weighted sum acts on nothing that was measured.
    Combination,
    /// One site alone that these points do not load.
    Unloaded,
}

impl Kind {
    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Near => "near",
            Self::Combination => "combination",
            Self::Unloaded => "unloaded",
        }
    }
}

/// Sites that these points cannot separate.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Why.
    pub kind: Kind,
    /// The sites.
    pub sites: Vec<String>,
    /// Their weights in the direction that stays open (relative compliances; empty for pairs).
    pub weights: Vec<f64>,
    /// Cosine between the responses for pairs, relative standard deviation of the combination else.
    pub measure: f64,
    /// The experiment that would tell.
    pub would_tell: String,
}

/// Cosine above which two responses count as one.
const NEAR: f64 = 0.98;
/// Cosine above which they are one.
const EXACT: f64 = 1.0 - 1e-10;
/// A direction is open if its relative standard deviation exceeds this.
const OPEN: f64 = 0.5;
/// A site belongs to a direction if its weight exceeds this share of the largest.
const MEMBER: f64 = 0.25;

/// The same robot with an elastic foundation about x, y and z where it has none: as soft as A1.
pub fn with_foundation(robot: &Robot) -> Robot {
    let mut robot = robot.clone();
    let first = robot
        .joints
        .first()
        .and_then(|j| j.drive.clone().or(j.tilt.clone()));
    let stiffness = first.map_or(1e7, |spring| spring.stiffness);
    for (k, name) in ["base-x", "base-y", "base-z"].into_iter().enumerate() {
        let axis = std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 });
        let known = robot
            .elastic
            .iter()
            .any(|e| e.after == 0 && e.axis[k].abs() > 0.999);
        if !known && robot.elastic.iter().all(|e| e.name != name) {
            robot.elastic.push(ElasticAxis {
                name: name.into(),
                after: 0,
                axis,
                point: [0.0; 3],
                spring: Spring::new(stiffness, 0.0),
                body: None,
            });
        }
    }
    robot
}

/// Everything the points cannot separate, the exact groups first.
pub fn groups(response: &Response, weighing: &Weighing) -> Vec<Group> {
    let axes = single_axes(&response.sites);
    let cosines = cosines(&weighing.design(response, &axes));
    let mut found: Vec<Group> = Vec::new();
    for (limit, kind) in [(EXACT, Kind::Exact), (NEAR, Kind::Near)] {
        for members in bundles(&cosines, limit) {
            let group = alike(&axes, &members, &cosines, kind);
            if group.sites.len() > 1 && found.iter().all(|known| known.sites != group.sites) {
                found.push(group);
            }
        }
    }
    found.extend(directions(response, weighing, &found));
    found
}

/// Every axis as a site of its own: the two axes of a bearing are looked at one by one.
fn single_axes(sites: &[Site]) -> Vec<Site> {
    let split = |site: &Site| {
        let one = |axis: &usize| Site {
            axes: vec![*axis],
            ..site.clone()
        };
        site.axes.iter().map(one).collect::<Vec<_>>()
    };
    sites.iter().flat_map(split).collect()
}

fn cosines(design: &DMatrix<f64>) -> DMatrix<f64> {
    let norms: Vec<f64> = design.column_iter().map(|c| c.norm()).collect();
    let largest = norms.iter().fold(0.0_f64, |m, n| m.max(*n));
    DMatrix::from_fn(norms.len(), norms.len(), |i, j| {
        let loaded = norms[i].min(norms[j]) > 1e-9 * largest;
        let product = design.column(i).dot(&design.column(j));
        if loaded {
            product / (norms[i] * norms[j])
        } else {
            0.0
        }
    })
}

/// Groups of axes of which every two have a cosine above `limit`, the closest joined first.
fn bundles(cosines: &DMatrix<f64>, limit: f64) -> Vec<Vec<usize>> {
    let n = cosines.nrows();
    let mut groups: Vec<Vec<usize>> = (0..n).map(|i| vec![i]).collect();
    let mut pairs: Vec<(usize, usize)> = (0..n).flat_map(|i| (0..i).map(move |j| (i, j))).collect();
    pairs.retain(|pair| cosines[*pair] > limit);
    pairs.sort_by(|a, b| cosines[*b].total_cmp(&cosines[*a]).then(a.cmp(b)));
    for (i, j) in pairs {
        let at = |k: usize| groups.iter().position(|g| g.contains(&k)).unwrap_or(k);
        let (a, b) = (at(i), at(j));
        let all = groups[a]
            .iter()
            .all(|x| groups[b].iter().all(|y| cosines[(*x, *y)] > limit));
        if a != b && all {
            let moved = std::mem::take(&mut groups[a]);
            groups[b].extend(moved);
        }
    }
    groups.retain(|g| g.len() > 1);
    groups
}

fn alike(axes: &[Site], members: &[usize], cosines: &DMatrix<f64>, kind: Kind) -> Group {
    let mut sites: Vec<String> = members.iter().map(|i| axes[*i].name.clone()).collect();
    sites.sort();
    sites.dedup();
    let pairs = members
        .iter()
        .flat_map(|i| members.iter().map(move |j| cosines[(*i, *j)]));
    Group {
        kind,
        would_tell: would_tell(&sites),
        sites,
        weights: Vec::new(),
        measure: pairs.fold(1.0, f64::min),
    }
}

/// Open directions of the prior-free design; exact twins are looked at once.
fn directions(response: &Response, weighing: &Weighing, known: &[Group]) -> Vec<Group> {
    let twin = |site: &&Site| {
        let foundation = site.name.starts_with("base");
        let exact = known
            .iter()
            .any(|g| g.kind == Kind::Exact && g.sites.contains(&site.name));
        !(foundation && exact)
    };
    let sites: Vec<Site> = response.sites.iter().filter(twin).cloned().collect();
    let design = weighing.design(response, &sites);
    let gram = (design.transpose() * &design).symmetric_eigen();
    let mut order: Vec<usize> = (0..sites.len()).collect();
    order.sort_by(|a, b| gram.eigenvalues[*a].total_cmp(&gram.eigenvalues[*b]));
    let open = |k: &usize| gram.eigenvalues[*k].max(0.0).sqrt() * OPEN < 1.0;
    let group = |k: usize| {
        let deviation = 1.0 / gram.eigenvalues[k].max(1e-24).sqrt();
        direction(&sites, &gram.eigenvectors.column(k).into_owned(), deviation)
    };
    let mut found: Vec<Group> = Vec::new();
    for group in order.into_iter().filter(open).map(group) {
        let seen = |other: &Group| other.sites == group.sites;
        if !known.iter().any(seen) && !found.iter().any(seen) {
            found.push(group);
        }
    }
    found
}

fn direction(sites: &[Site], vector: &DVector<f64>, deviation: f64) -> Group {
    let largest = vector.amax();
    let mut members: Vec<usize> = (0..sites.len()).collect();
    members.retain(|i| vector[*i].abs() > MEMBER * largest);
    members.sort_by(|a, b| sites[*a].name.cmp(&sites[*b].name));
    let sign = members.first().map_or(1.0, |i| vector[*i].signum());
    let names: Vec<String> = members.iter().map(|i| sites[*i].name.clone()).collect();
    Group {
        kind: match members.len() {
            1 => Kind::Unloaded,
            _ => Kind::Combination,
        },
        weights: members.iter().map(|i| sign * vector[*i]).collect(),
        measure: deviation,
        would_tell: would_tell(&names),
        sites: names,
    }
}

fn would_tell(sites: &[String]) -> String {
    let named: Vec<&str> = sites.iter().map(String::as_str).collect();
    if named.iter().any(|name| name.starts_with("base")) {
        return "put a displacement sensor on the foot or on link 1 while the tool is loaded"
            .into();
    }
    let wrist =
        |name: &&str| name.starts_with("A6") || name.starts_with("A5") || name.starts_with("A4");
    match named.iter().all(wrist) {
        true => format!(
            "an axis test of {}, or points with another tool length and other wrist angles",
            named.join(" or ")
        ),
        false => format!("an axis test (`ident stiffness`) of {}", named.join(" or ")),
    }
}
