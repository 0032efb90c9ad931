//! A rigid body and whether it can exist.

use crate::ground::spatial::{Pose, V3, add, rotate, rotate_tensor, scale, sub};
use nalgebra::{Matrix3, Vector3};

/// A rigid body in base-frame axes, placed where it is with every joint at zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass, m, base frame.
    pub com: V3,
    /// Inertia about the centre of mass, kg·m², base axes: xx yy zz xy xz yz.
    pub inertia: [f64; 6],
}

impl Body {
    /// No body at all: the neutral element of [`Body::with`].
    pub const NOTHING: Self = Self {
        mass: 0.0,
        com: [0.0; 3],
        inertia: [0.0; 6],
    };

    /// The same body carried from a link frame into the frame that `pose` is given in.
    #[must_use]
    pub fn placed(&self, pose: &Pose) -> Self {
        Self {
            mass: self.mass,
            com: add(pose.point, rotate(&pose.rotation, self.com)),
            inertia: rotate_tensor(&pose.rotation, &self.inertia),
        }
    }

    /// Both bodies as one rigid body (parallel-axis theorem).
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        let mass = self.mass + other.mass;
        if mass == 0.0 {
            return *self;
        }
        let weighted = add(scale(self.mass, self.com), scale(other.mass, other.com));
        let com = scale(1.0 / mass, weighted);
        let (a, b) = (self.shifted(com), other.shifted(com));
        Self {
            mass,
            com,
            inertia: std::array::from_fn(|i| a[i] + b[i]),
        }
    }

    /// The body in two, cut across the unit vector `along`, the share `far` (0 to 1, neither of them) of its mass ahead: together they have its
    /// mass, centre and inertia. Their centres are as far apart as those of a uniform bar; what is left of the inertia they share as
    /// their mass. None of an inertia that no mass has.
    pub fn cut(&self, along: V3, far: f64) -> Option<[Self; 2]> {
        let [xx, yy, zz, xy, xz, yz] = self.inertia;
        let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let spread = |inertia: Matrix3<f64>| Matrix3::identity() * inertia.trace() - inertia;
        // second moments of the mass
        let whole = 0.5 * tensor.trace() * Matrix3::identity() - tensor;
        let u = Vector3::from(along);
        let stretch = 1.0 / u.dot(&(whole.try_inverse()? * u));
        if !(stretch > 0.0 && self.mass > 0.0) {
            return None;
        }
        // centres of the parts of a uniform bar are half of its length apart: length² = 12 stretch / mass
        let apart = (3.0 * stretch / self.mass).sqrt();
        let rest = whole - 3.0 * far * (1.0 - far) * stretch * u * u.transpose();
        let part = |share: f64, away: f64| {
            let i = spread(share * rest);
            Self {
                mass: share * self.mass,
                com: add(self.com, scale(away * apart, along)),
                inertia: [
                    i[(0, 0)],
                    i[(1, 1)],
                    i[(2, 2)],
                    i[(0, 1)],
                    i[(0, 2)],
                    i[(1, 2)],
                ],
            }
        };
        Some([part(1.0 - far, -far), part(far, 1.0 - far)])
    }

    /// Inertia about `point` instead of the centre of mass.
    fn shifted(&self, point: V3) -> [f64; 6] {
        let [x, y, z] = sub(self.com, point);
        let m = self.mass;
        let steiner = [
            y * y + z * z,
            x * x + z * z,
            x * x + y * y,
            -x * y,
            -x * z,
            -y * z,
        ];
        std::array::from_fn(|i| self.inertia[i] + m * steiner[i])
    }

    /// Principal moments of inertia, ascending, kg·m².
    pub fn principal_moments(&self) -> V3 {
        let [xx, yy, zz, xy, xz, yz] = self.inertia;
        let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let mut moments: V3 = tensor.symmetric_eigenvalues().into();
        moments.sort_by(f64::total_cmp);
        moments
    }

    /// Why no real body has these numbers, if so: mass, positive definiteness and the triangle
    /// inequality (Traversaro et al. 2016, eq. 5): each principal moment at most the sum of the others.
    pub fn fault(&self) -> Option<String> {
        let numbers = [&[self.mass][..], &self.com, &self.inertia].concat();
        if numbers.iter().any(|x| !x.is_finite()) {
            return Some("has a mass, centre or inertia that is not finite".into());
        }
        if self.mass == 0.0 {
            return Some("has no mass".into());
        }
        if self.mass < 0.0 {
            return Some(format!("has the negative mass {} kg", self.mass));
        }
        let [small, middle, large] = self.principal_moments();
        if small <= 0.0 {
            return Some(format!(
                "has an inertia that is not positive definite (smallest principal moment {small:.3e} kg·m²)"
            ));
        }
        (large > (small + middle) * (1.0 + 1e-9)).then(|| {
            format!("has an inertia that violates the triangle inequality ({large:.4} > {small:.4} + {middle:.4} kg·m²)")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_cut_is_whole_together() {
        let bar = Body {
            mass: 120.0,
            com: [0.1, 0.2, 0.9],
            inertia: [12.0, 13.0, 4.0, 0.3, -0.6, 0.2],
        };
        for far in [0.2, 0.5, 0.95] {
            let [near, far_part] = bar.cut([0.0, 0.6, 0.8], far).unwrap();
            assert!(near.fault().is_none() && far_part.fault().is_none());
            assert!((far_part.mass / bar.mass - far).abs() < 1e-12);
            let apart = sub(far_part.com, near.com);
            assert!(apart[1] > 0.0 && (apart[2] / apart[1] - 0.8 / 0.6).abs() < 1e-9);
            let both = near.with(&far_part);
            let numbers = |b: &Body| [&[b.mass][..], &b.com, &b.inertia].concat();
            let each = numbers(&both).into_iter().zip(numbers(&bar));
            each.for_each(|(a, b)| assert!((a - b).abs() < 1e-9, "{a} {b}"));
        }
    }

    #[test]
    fn two_points_make_a_dumbbell() {
        let point = |x: f64| Body {
            mass: 1.0,
            com: [x, 0.0, 0.0],
            inertia: [0.0; 6],
        };
        let both = point(1.0).with(&point(-1.0));
        assert_eq!(
            both,
            Body {
                mass: 2.0,
                com: [0.0; 3],
                inertia: [0.0, 2.0, 2.0, 0.0, 0.0, 0.0]
            }
        );
        assert_eq!(Body::NOTHING.with(&point(2.0)), point(2.0));
    }

    #[test]
    fn faults_are_told_apart() {
        let body = |mass, inertia| Body {
            mass,
            com: [0.0; 3],
            inertia,
        };
        let says = |b: Body, word: &str| b.fault().is_some_and(|f| f.contains(word));
        assert!(says(body(0.0, [0.0; 6]), "no mass"));
        assert!(says(body(-1.0, [1.0; 6]), "negative mass"));
        assert!(says(
            body(1.0, [1.0, 1.0, 1.0, 2.0, 0.0, 0.0]),
            "positive definite"
        ));
        assert!(says(body(1.0, [1.0, 1.0, 3.0, 0.0, 0.0, 0.0]), "triangle"));
        assert!(says(body(f64::NAN, [1.0; 6]), "finite"));
        assert_eq!(body(1.0, [1.0, 1.0, 1.9, 0.0, 0.0, 0.0]).fault(), None);
    }
}
