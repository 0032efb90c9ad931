//! A robot of this generator: rigid bodies on virtual axes, poses by products of 4x4 matrices,
//! Jacobians by numeric differentiation of the poses.

use nalgebra::{DMatrix, Matrix3, Matrix4, Vector3, Vector4};

pub type V3 = Vector3<f64>;
pub type M3 = Matrix3<f64>;

#[derive(Clone, Copy)]
pub struct Spring {
    pub stiffness: f64,
    pub damping: f64,
}

/// Mass, centre and inertia about the centre, base axes, every joint at zero.
#[derive(Clone, Copy)]
pub struct Body {
    pub mass: f64,
    pub com: V3,
    pub inertia: M3,
}

#[derive(Clone)]
pub struct Joint {
    pub axis: V3,
    pub point: V3,
    pub limits: [f64; 2],
    pub drive: Spring,
    pub tilt: Option<Spring>,
    pub body: Body,
}

/// A virtual axis behind a link (0: in the foundation). One that slides is in N/m.
#[derive(Clone)]
pub struct Extra {
    pub name: String,
    pub after: usize,
    pub axis: V3,
    pub point: V3,
    pub slides: bool,
    pub spring: Spring,
}

#[derive(Clone)]
pub struct Robot {
    pub name: String,
    pub joints: Vec<Joint>,
    pub flange: V3,
    pub tcp: V3,
    pub tool: Body,
    pub extra: Vec<Extra>,
}

/// An elastic degree of freedom.
pub struct Degree {
    pub site: String,
    pub spring: Spring,
}

/// One motion of the chain: commanded angle, and the degree of freedom that adds to it.
struct Move {
    axis: V3,
    point: V3,
    slides: bool,
    angle: f64,
}

/// The chain at a pose. `ends[k]`: moves that carry link k + 1; the tool is carried by all.
pub struct Chain<'a> {
    robot: &'a Robot,
    moves: Vec<Move>,
    ends: Vec<usize>,
    pub degrees: Vec<Degree>,
}

impl Body {
    /// This body with a point mass welded to it.
    pub fn with_lump(self, mass: f64, at: V3) -> Self {
        let total = self.mass + mass;
        let com = (self.com * self.mass + at * mass) / total;
        let steiner = |m: f64, r: V3| (M3::identity() * r.dot(&r) - r * r.transpose()) * m;
        let inertia = self.inertia + steiner(self.mass, self.com - com) + steiner(mass, at - com);
        Self {
            mass: total,
            com,
            inertia,
        }
    }
}

fn screw(axis: &V3, point: &V3, slides: bool, amount: f64) -> Matrix4<f64> {
    let mut out = Matrix4::identity();
    if slides {
        out.fixed_view_mut::<3, 1>(0, 3).copy_from(&(axis * amount));
        return out;
    }
    let cross = axis.cross_matrix();
    let turn = M3::identity() + cross * amount.sin() + cross * cross * (1.0 - amount.cos());
    out.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
    out.fixed_view_mut::<3, 1>(0, 3)
        .copy_from(&(point - turn * point));
    out
}

/// Two unit vectors across `axis`.
pub fn across(axis: &V3) -> [V3; 2] {
    let helper = if axis.x.abs() < 0.7 { V3::x() } else { V3::z() };
    let u = axis.cross(&helper).normalize();
    [u, axis.cross(&u)]
}

impl Robot {
    /// The chain at joint angles in degrees.
    pub fn at(&self, angles_deg: &[f64; 6]) -> Chain<'_> {
        let mut chain = Chain {
            robot: self,
            moves: Vec::new(),
            ends: Vec::new(),
            degrees: Vec::new(),
        };
        chain.extras(0);
        for (i, joint) in self.joints.iter().enumerate() {
            let name = format!("A{}", i + 1);
            for axis in across(&joint.axis) {
                if let Some(tilt) = joint.tilt {
                    chain.add(axis, joint.point, false, 0.0, format!("{name}-tilt"), tilt);
                }
            }
            let angle = angles_deg[i].to_radians();
            chain.add(joint.axis, joint.point, false, angle, name, joint.drive);
            chain.ends.push(chain.moves.len());
            chain.extras(i + 1);
        }
        chain
    }
}

const STEP: f64 = 1e-5;

impl Chain<'_> {
    fn add(&mut self, axis: V3, point: V3, slides: bool, angle: f64, site: String, spring: Spring) {
        self.moves.push(Move {
            axis,
            point,
            slides,
            angle,
        });
        self.degrees.push(Degree { site, spring });
    }

    fn extras(&mut self, after: usize) {
        for e in self.robot.extra.iter().filter(|e| e.after == after) {
            self.add(e.axis, e.point, e.slides, 0.0, e.name.clone(), e.spring);
        }
    }

    /// Pose of every link and of the tool, with degree of freedom `bent` moved by `amount`.
    fn poses(&self, bent: usize, amount: f64) -> Vec<Matrix4<f64>> {
        let mut pose = Matrix4::identity();
        let mut out = Vec::new();
        for (i, m) in self.moves.iter().enumerate() {
            let more = if i == bent { amount } else { 0.0 };
            pose *= screw(&m.axis, &m.point, m.slides, m.angle + more);
            out.extend(self.ends.contains(&(i + 1)).then_some(pose));
        }
        out.push(pose);
        out
    }

    fn carried(&self) -> Vec<Body> {
        let links = self.robot.joints.iter().map(|j| j.body);
        links.chain([self.robot.tool]).collect()
    }

    pub fn tcp(&self) -> V3 {
        placed(self.poses(usize::MAX, 0.0).last().unwrap(), &self.robot.tcp)
    }

    /// Rotation of the tool since the pose at zero.
    pub fn turn(&self) -> M3 {
        rotation(self.poses(usize::MAX, 0.0).last().unwrap())
    }

    /// Motion of the tool centre point per degree of freedom, 3 x n.
    pub fn jacobian(&self) -> DMatrix<f64> {
        let mut out = DMatrix::zeros(3, self.moves.len());
        for i in 0..self.moves.len() {
            let end = |h: f64| placed(self.poses(i, h).last().unwrap(), &self.robot.tcp);
            out.set_column(i, &((end(STEP) - end(-STEP)) / (2.0 * STEP)));
        }
        out
    }

    /// Compliance per degree of freedom, rad/(N·m).
    pub fn compliances(&self) -> Vec<f64> {
        let each = self.degrees.iter();
        each.map(|d| 1.0 / d.spring.stiffness).collect()
    }

    /// Compliance at the tool centre point, m/N.
    pub fn compliance(&self) -> M3 {
        let jacobian = self.jacobian();
        let soft = DMatrix::from_diagonal(&self.compliances().into());
        let product = &jacobian * soft * jacobian.transpose();
        M3::from_iterator(product.iter().copied())
    }

    /// Torque of gravity per degree of freedom, N·m.
    pub fn gravity(&self) -> Vec<f64> {
        let bodies = self.carried();
        let height = |i: usize, h: f64| -> f64 {
            let poses = self.poses(i, h);
            let each = poses.iter().zip(&bodies);
            each.map(|(p, b)| b.mass * placed(p, &b.com).z).sum()
        };
        let torque = |i| -9.81 * (height(i, STEP) - height(i, -STEP)) / (2.0 * STEP);
        (0..self.moves.len()).map(torque).collect()
    }

    /// Mass matrix: twice the kinetic energy, summed over the bodies.
    pub fn mass_matrix(&self) -> DMatrix<f64> {
        let (bodies, count) = (self.carried(), self.moves.len());
        let rest = self.poses(usize::MAX, 0.0);
        let mut slide = vec![DMatrix::zeros(3, count); bodies.len()];
        let mut turn = slide.clone();
        for i in 0..count {
            let (ahead, back) = (self.poses(i, STEP), self.poses(i, -STEP));
            for (b, body) in bodies.iter().enumerate() {
                let apart = placed(&ahead[b], &body.com) - placed(&back[b], &body.com);
                slide[b].set_column(i, &(apart / (2.0 * STEP)));
                let rate = (rotation(&ahead[b]) - rotation(&back[b])) / (2.0 * STEP);
                let spin = rate * rotation(&rest[b]).transpose();
                turn[b].set_column(i, &V3::new(spin.m32, spin.m13, spin.m21));
            }
        }
        let mut mass = DMatrix::zeros(count, count);
        for (b, body) in bodies.iter().enumerate() {
            let turned = rotation(&rest[b]);
            let inertia = turned * body.inertia * turned.transpose();
            mass += slide[b].transpose() * &slide[b] * body.mass;
            mass += turn[b].transpose() * inertia * &turn[b];
        }
        mass
    }
}

fn placed(pose: &Matrix4<f64>, point: &V3) -> V3 {
    (pose * Vector4::new(point.x, point.y, point.z, 1.0)).xyz()
}

fn rotation(pose: &Matrix4<f64>) -> M3 {
    pose.fixed_view::<3, 3>(0, 0).into()
}
