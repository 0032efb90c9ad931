//! The error in groups of neighbouring targets, one quadratic each: as many targets as the limit of the
//! residual allows, one group after the other (source 003, section 3.2).

use nalgebra::{Matrix3, Vector3};

/// One group: p(x) = p1 x² + p2 x + p3 with x the target in mm and p in µm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Group {
    /// First target, mm.
    pub from_mm: f64,
    /// Last target, mm.
    pub to_mm: f64,
    /// p1 in µm/mm², p2 in µm/mm, p3 in µm.
    pub p: [f64; 3],
    /// Largest residual, µm.
    pub max_residual_um: f64,
    /// Number of targets.
    pub points: usize,
    /// The quadratic about the middle of the group: where x = middle + scale·t, c0 + c1 t + c2 t².
    centred: Centred,
}

/// A quadratic in numbers of order one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Centred {
    middle: f64,
    scale: f64,
    c: [f64; 3],
}

/// Whether neighbouring groups meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Joint {
    /// Each for itself, as in the source.
    Free,
    /// Each starts where the one before ended, in value.
    Continuous,
}

impl Group {
    /// Its value at a position, µm.
    pub fn at(&self, x_mm: f64) -> f64 {
        self.centred.at(x_mm)
    }

    /// Least squares through targets `[x mm, error µm]` (at least one); fewer than three have a lower degree.
    pub fn through(points: &[[f64; 2]]) -> Self {
        let (middle, scale) = frame(points);
        Self::with(
            points,
            fit(points, middle, scale, points.len().min(3), None),
        )
    }

    /// The same, through the end of the group before.
    fn onward(points: &[[f64; 2]], before: &Group) -> Self {
        let start = [before.to_mm, before.at(before.to_mm)];
        let scale = (points[points.len() - 1][0] - start[0])
            .abs()
            .max(f64::MIN_POSITIVE);
        Self::with(
            points,
            fit(points, start[0], scale, points.len().min(2), Some(start[1])),
        )
    }

    fn with(points: &[[f64; 2]], centred: Centred) -> Self {
        let residual = |p: &[f64; 2]| (p[1] - centred.at(p[0])).abs();
        Self {
            from_mm: points[0][0],
            to_mm: points[points.len() - 1][0],
            p: centred.powers(),
            max_residual_um: points.iter().map(residual).fold(0.0, f64::max),
            points: points.len(),
            centred,
        }
    }
}

impl Centred {
    fn at(&self, x: f64) -> f64 {
        let t = (x - self.middle) / self.scale;
        self.c[0] + t * (self.c[1] + t * self.c[2])
    }

    /// Coefficients of x², x and 1.
    fn powers(&self) -> [f64; 3] {
        let [c0, c1, c2] = self.c;
        let (a, b) = (c2 / self.scale.powi(2), c1 / self.scale);
        [
            a,
            b - 2.0 * a * self.middle,
            c0 - b * self.middle + a * self.middle.powi(2),
        ]
    }
}

fn frame(points: &[[f64; 2]]) -> (f64, f64) {
    let (first, last) = (points[0][0], points[points.len() - 1][0]);
    let half = 0.5 * (last - first);
    (0.5 * (first + last), if half > 0.0 { half } else { 1.0 })
}

/// Least squares with `free` coefficients from the lowest on; with `held` the value at the middle is that,
/// and the free ones are those of t and t².
fn fit(points: &[[f64; 2]], middle: f64, scale: f64, free: usize, held: Option<f64>) -> Centred {
    let first = usize::from(held.is_some());
    let (mut normal, mut right) = (Matrix3::<f64>::identity(), Vector3::zeros());
    let basis = |x: f64| {
        let t = (x - middle) / scale;
        [1.0, t, t * t]
    };
    for i in first..(first + free).min(3) {
        for j in first..(first + free).min(3) {
            normal[(i, j)] = points.iter().map(|p| basis(p[0])[i] * basis(p[0])[j]).sum();
        }
        right[i] = points
            .iter()
            .map(|p| basis(p[0])[i] * (p[1] - held.unwrap_or(0.0)))
            .sum();
    }
    let mut c = normal
        .cholesky()
        .map_or(Vector3::zeros(), |c| c.solve(&right));
    if let Some(value) = held {
        c[0] = value;
    }
    Centred {
        middle,
        scale,
        c: [c[0], c[1], c[2]],
    }
}

/// Groups of the targets `[x mm, error µm]`, in rising order: each starts with three targets (fewer only at
/// the end) and grows target by target until its largest residual exceeds `limit_um`; the group before that
/// is taken, and the next starts behind it.
pub fn greedy(points: &[[f64; 2]], limit_um: f64, joint: Joint) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut rest = points;
    while !rest.is_empty() {
        let before = groups
            .last()
            .copied()
            .filter(|_| joint == Joint::Continuous);
        let fitted = |n: usize| match &before {
            None => Group::through(&rest[..n]),
            Some(before) => Group::onward(&rest[..n], before),
        };
        // what a group holds exactly: three targets, or two behind a held start
        let least = (3 - usize::from(before.is_some())).min(rest.len());
        let mut group = fitted(least);
        for n in least + 1..=rest.len() {
            let longer = fitted(n);
            if longer.max_residual_um > limit_um {
                break;
            }
            group = longer;
        }
        rest = &rest[group.points..];
        groups.push(group);
    }
    groups
}

/// The group that speaks for a position: the first that reaches so far, else the last.
pub fn of(groups: &[Group], x_mm: f64) -> Option<&Group> {
    groups
        .iter()
        .find(|group| x_mm <= group.to_mm)
        .or(groups.last())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wavy() -> Vec<[f64; 2]> {
        (0..73)
            .map(|i| f64::from(i) * 5.08 - 41.0)
            .map(|x| [x, 12.0 * (x / 30.0).sin() + 0.05 * x])
            .collect()
    }

    #[test]
    fn a_quadratic_is_one_group_with_its_own_coefficients() {
        let points: Vec<[f64; 2]> = (0..40)
            .map(f64::from)
            .map(|x| [x, 0.02 * x * x - 0.7 * x + 5.0])
            .collect();
        let groups = greedy(&points, 1e-6, Joint::Free);
        assert_eq!(groups.len(), 1);
        for (found, wanted) in groups[0].p.iter().zip([0.02, -0.7, 5.0]) {
            assert!((found - wanted).abs() < 1e-10);
        }
    }

    #[test]
    fn groups_are_maximal_and_disjoint() {
        let points = wavy();
        let groups = greedy(&points, 3.0, Joint::Free);
        assert_eq!(groups.iter().map(|g| g.points).sum::<usize>(), points.len());
        assert!(groups.iter().all(|g| g.max_residual_um <= 3.0));
        let mut from = 0;
        for group in &groups[..groups.len() - 1] {
            let longer = Group::through(&points[from..=from + group.points]);
            assert!(longer.max_residual_um > 3.0);
            from += group.points;
        }
    }

    #[test]
    fn continuous_groups_meet() {
        let groups = greedy(&wavy(), 3.0, Joint::Continuous);
        assert!(groups.iter().all(|g| g.max_residual_um <= 3.0));
        for pair in groups.windows(2) {
            assert!((pair[0].at(pair[0].to_mm) - pair[1].at(pair[0].to_mm)).abs() < 1e-9);
        }
    }
}
