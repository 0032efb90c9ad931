//! Spatial (6-D) vector algebra over any [`Scalar`], fixed-size, without heap.
//!
//! Everything is written in **one inertial frame at one instant** (Featherstone 2008, section 2):
//! the algorithms of floor 4 never change coordinates, they only add. Motion vectors are
//! (ω, v of the body point at the reference point), force vectors (moment about it, force).

use super::dual::Scalar;
pub use super::vector::*;

/// A position and an orientation in the base frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose<S = f64> {
    /// Columns are the frame's axes in base axes.
    pub rotation: M3<S>,
    /// Origin, m.
    pub point: V3<S>,
}

impl Pose {
    /// The base frame itself.
    pub const IDENTITY: Self = Self {
        rotation: IDENTITY,
        point: [0.0; 3],
    };

    /// self ∘ inner: a frame given in this frame, expressed in the base.
    pub fn then(&self, inner: &Self) -> Self {
        Self {
            rotation: product(&self.rotation, &inner.rotation),
            point: add(self.point, rotate(&self.rotation, inner.point)),
        }
    }
}

/// Motion vector: angular part ω (rad/s) and linear part v (m/s) at the reference point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion<S = f64> {
    /// Angular part.
    pub ang: V3<S>,
    /// Linear part at the reference point.
    pub lin: V3<S>,
}

/// Force vector: moment (N·m) about the reference point and force (N).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Force<S = f64> {
    /// Moment about the reference point.
    pub mom: V3<S>,
    /// Force.
    pub lin: V3<S>,
}

impl<S: Scalar> Motion<S> {
    /// No motion.
    #[inline(always)]
    pub fn zero() -> Self {
        Self {
            ang: lift([0.0; 3]),
            lin: lift([0.0; 3]),
        }
    }
    /// Unit rate about the line with unit direction `axis` through `point`.
    #[inline(always)]
    pub fn about(axis: V3<S>, point: V3<S>) -> Self {
        Self {
            ang: axis,
            lin: cross(point, axis),
        }
    }
    /// self + rate · s
    #[inline(always)]
    pub fn plus(self, rate: S, s: &Self) -> Self {
        Self {
            ang: add(self.ang, scale(rate, s.ang)),
            lin: add(self.lin, scale(rate, s.lin)),
        }
    }
    /// self × other: rate of change of `other` carried along with self.
    #[inline(always)]
    pub fn cross(&self, other: &Self) -> Self {
        Self {
            ang: cross(self.ang, other.ang),
            lin: add(cross(self.ang, other.lin), cross(self.lin, other.ang)),
        }
    }
    /// self ×* force.
    #[inline(always)]
    pub fn cross_force(&self, f: &Force<S>) -> Force<S> {
        Force {
            mom: add(cross(self.ang, f.mom), cross(self.lin, f.lin)),
            lin: cross(self.ang, f.lin),
        }
    }
    /// Power of a force along this motion, W.
    #[inline(always)]
    pub fn dot(&self, f: &Force<S>) -> S {
        dot(self.ang, f.mom) + dot(self.lin, f.lin)
    }
}

impl<S: Scalar> Force<S> {
    /// No force.
    #[inline(always)]
    pub fn zero() -> Self {
        Self {
            mom: lift([0.0; 3]),
            lin: lift([0.0; 3]),
        }
    }
    /// self + other
    #[inline(always)]
    pub fn plus(self, other: &Self) -> Self {
        Self {
            mom: add(self.mom, other.mom),
            lin: add(self.lin, other.lin),
        }
    }
}

/// Rigid-body inertia about a reference point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inertia<S = f64> {
    /// Mass, kg.
    pub mass: S,
    /// First moment m·c, kg·m, from the reference point.
    pub moment: V3<S>,
    /// Second moment about the reference point, kg·m²: xx yy zz xy xz yz.
    pub tensor: [S; 6],
}

impl<S: Scalar> Inertia<S> {
    /// Nothing.
    #[inline(always)]
    pub fn zero() -> Self {
        let zero = S::constant(0.0);
        Self {
            mass: zero,
            moment: [zero; 3],
            tensor: [zero; 6],
        }
    }

    /// A body of mass (kg), centre (m, from the reference point) and tensor about its centre.
    #[inline(always)]
    pub fn about_reference(mass: f64, c: V3<S>, tensor: [S; 6]) -> Self {
        let mc = [c[0] * mass, c[1] * mass, c[2] * mass];
        let (xx, yy, zz) = (mc[0] * c[0], mc[1] * c[1], mc[2] * c[2]);
        let [ixx, iyy, izz, ixy, ixz, iyz] = tensor;
        let tensor = [
            ixx + yy + zz,
            iyy + xx + zz,
            izz + xx + yy,
            ixy - mc[0] * c[1],
            ixz - mc[0] * c[2],
            iyz - mc[1] * c[2],
        ];
        Self {
            mass: S::constant(mass),
            moment: mc,
            tensor,
        }
    }

    /// Both bodies as one.
    #[inline(always)]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            moment: add(self.moment, other.moment),
            tensor: [
                self.tensor[0] + other.tensor[0],
                self.tensor[1] + other.tensor[1],
                self.tensor[2] + other.tensor[2],
                self.tensor[3] + other.tensor[3],
                self.tensor[4] + other.tensor[4],
                self.tensor[5] + other.tensor[5],
            ],
        }
    }

    /// Momentum of the body in a motion (also: force for an acceleration).
    #[inline(always)]
    pub fn times(&self, m: &Motion<S>) -> Force<S> {
        Force {
            mom: add(symmetric(&self.tensor, m.ang), cross(self.moment, m.lin)),
            lin: sub(scale(self.mass, m.lin), cross(self.moment, m.ang)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: V3, b: V3) -> bool {
        super::super::vector::norm(sub(a, b)) < 1e-14
    }

    #[test]
    fn power_balance_of_crosses() {
        let m = Motion {
            ang: [0.1, 0.2, -0.4],
            lin: [1.0, -2.0, 0.5],
        };
        let n = Motion {
            ang: [-0.3, 0.6, 0.9],
            lin: [0.2, 0.1, -0.7],
        };
        let f = Force {
            mom: [2.0, 1.0, 0.3],
            lin: [-1.0, 0.4, 0.9],
        };
        assert!((m.cross(&n).dot(&f) + n.dot(&m.cross_force(&f))).abs() < 1e-14);
    }

    #[test]
    fn inertia_about_a_point_is_that_of_a_point_mass() {
        let i: Inertia = Inertia::about_reference(2.0, [0.0, 3.0, 0.0], [0.0; 6]);
        let f = i.times(&Motion {
            ang: [0.0, 0.0, 1.0],
            lin: [0.0; 3],
        });
        assert!(near(f.lin, [-6.0, 0.0, 0.0]) && near(f.mom, [0.0, 0.0, 18.0]));
    }
}
