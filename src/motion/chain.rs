//! The immutable model that all algorithms of this floor run over: hinges in a row.

use crate::ground::spatial::{IDENTITY, M3, Pose, V3, add, sub};
use crate::robot::{Body, Spring};

/// Standard gravity of the reference values, m/s², towards −z of the base (Pinocchio's 9.81).
pub const GRAVITY: V3 = [0.0, 0.0, -9.81];

/// A rotational joint, real or virtual. Link frames are parallel to the base with every joint at zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hinge {
    /// Unit vector of positive rotation, base axes at zero.
    pub axis: V3,
    /// From the previous hinge's point to this one's, m, base axes at zero.
    pub offset: V3,
    /// The body moved, its centre from the hinge's point; `None` for a virtual axis.
    pub body: Option<Body>,
}

/// Hinges from the foundation to the tool centre point.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// The hinges in order.
    pub hinges: Vec<Hinge>,
    /// Site name of each hinge.
    pub names: Vec<String>,
    /// Spring of each hinge; `None`: rigid, it stays where it is commanded.
    pub springs: Vec<Option<Spring>>,
    /// Hinge of each driven joint, A1 first.
    pub drives: Vec<usize>,
    /// Free fall, m/s², base axes.
    pub gravity: V3,
    /// From the last hinge's point to the tool centre point, m, base axes at zero.
    pub tip: V3,
    /// Tool axes as columns, base axes at zero.
    pub tip_rotation: M3,
    last_point: V3,
}

impl Default for Chain {
    fn default() -> Self {
        Self {
            hinges: Vec::new(),
            names: Vec::new(),
            springs: Vec::new(),
            drives: Vec::new(),
            gravity: GRAVITY,
            tip: [0.0; 3],
            tip_rotation: IDENTITY,
            last_point: [0.0; 3],
        }
    }
}

impl Chain {
    /// Number of hinges, n.
    pub fn len(&self) -> usize {
        self.hinges.len()
    }

    /// Whether there is no hinge at all.
    pub fn is_empty(&self) -> bool {
        self.hinges.is_empty()
    }

    /// Appends a hinge: unit axis and a point on it (m), both in the base frame at zero, and the body
    /// it moves (base frame at zero).
    pub fn push(
        &mut self,
        name: impl Into<String>,
        axis: V3,
        point: V3,
        body: Option<Body>,
        spring: Option<Spring>,
    ) {
        let body = body.map(|body| Body {
            com: sub(body.com, point),
            ..body
        });
        self.hinges.push(Hinge {
            axis,
            offset: sub(point, self.last_point),
            body,
        });
        self.names.push(name.into());
        self.springs.push(spring);
        self.last_point = point;
    }

    /// Adds a body (base frame at zero) to the last hinge; on an empty chain it stands still.
    pub fn load(&mut self, body: &Body) {
        let here = Body {
            com: sub(body.com, self.last_point),
            ..*body
        };
        if let Some(hinge) = self.hinges.last_mut() {
            hinge.body = Some(hinge.body.unwrap_or(Body::NOTHING).with(&here));
        }
    }

    /// Sets the tool centre point (m) and tool axes (columns), base frame at zero.
    pub fn end_at(&mut self, tcp: V3, rotation: M3) {
        self.tip = sub(tcp, self.last_point);
        self.tip_rotation = rotation;
    }

    /// Pose of the tool with every joint at zero.
    pub fn zero_pose(&self) -> Pose {
        Pose {
            rotation: self.tip_rotation,
            point: add(self.last_point, self.tip),
        }
    }

    /// Every hinge's point at zero, m, base frame.
    pub fn points_at_zero(&self) -> Vec<V3> {
        let walk = self.hinges.iter().scan([0.0; 3], |at, hinge| {
            *at = add(*at, hinge.offset);
            Some(*at)
        });
        walk.collect()
    }

    /// Angles of all hinges for driven joint angles (rad): virtual axes at zero.
    ///
    /// Angles beyond the number of drives are ignored, missing ones are zero.
    pub fn spread(&self, joints: &[f64]) -> Vec<f64> {
        let mut q = vec![0.0; self.len()];
        self.drives
            .iter()
            .zip(joints)
            .for_each(|(hinge, angle)| q[*hinge] = *angle);
        q
    }
}
