//! The workspace test as the model predicts it: how far the tool moves per newton at every point,
//! site by site. Deflection is linear in the compliances: C = Σ Jᵥ Jᵥᵀ / k (Abele et al. 2008).

use super::drive_law::{Law, Press};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{M3, V3, add, rotate, sub};
use crate::measurement::workspace_test::WorkspaceTest;
use crate::motion::kinematics::{column, hinge_point, hinge_rotation, place, tcp};
use crate::motion::statics::{compliance, springs};
use crate::motion::{Chain, Work, elastic, gravity_torque};
use crate::robot::{Robot, Spring, check};

/// One place whose compliance acts as one number: a drive, a bearing (two equal axes), a virtual axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// Its name, as `A6`, `A6-tilt` or that of the virtual axis.
    pub name: String,
    /// The compliance that the model has now, rad/(N·m).
    pub compliance: f64,
    /// Its axes among the levers.
    pub axes: Vec<usize>,
}

/// How the tool moves per radian of every elastic axis at every point.
#[derive(Debug, Clone)]
pub struct Response {
    /// The places, from the foundation to the tool.
    pub sites: Vec<Site>,
    /// For every point and elastic axis: translation of the tool, m/rad, base frame.
    pub levers: Vec<Vec<V3>>,
}

impl Response {
    /// Of a robot at the joint angles of each point, rad.
    pub fn of(robot: &Robot, points: &[Vec<f64>]) -> Self {
        let chain = elastic(robot);
        let mut work = Work::new(&chain);
        let levers = points.iter().map(|angles| {
            place(&chain, &mut work, &chain.spread(angles));
            let at = tcp(&chain, &work).point;
            springs(&chain)
                .map(|(i, _)| column(&work, i, at).0)
                .collect()
        });
        let levers = levers.collect();
        let mut sites: Vec<Site> = Vec::new();
        for (axis, (i, spring)) in springs(&chain).enumerate() {
            let name = &chain.names[i];
            match sites.iter_mut().find(|site| site.name == *name) {
                Some(site) => site.axes.push(axis),
                None => sites.push(Site {
                    name: name.clone(),
                    compliance: 1.0 / spring.stiffness,
                    axes: vec![axis],
                }),
            }
        }
        Self { sites, levers }
    }

    /// Movement of the tool per newton along `direction` and per unit compliance of `axes`:
    /// m/N over rad/(N·m).
    pub fn unit(&self, point: usize, direction: usize, axes: &[usize]) -> V3 {
        let mut sum = [0.0; 3];
        for axis in axes {
            let lever = self.levers[point][*axis];
            (0..3).for_each(|k| sum[k] += lever[k] * lever[direction]);
        }
        sum
    }

    /// Movement of the tool per newton along `direction`, m/N, with these compliances of the sites.
    pub fn slope(&self, point: usize, direction: usize, compliances: &[f64]) -> V3 {
        let mut sum = [0.0; 3];
        for (site, compliance) in self.sites.iter().zip(compliances) {
            let unit = self.unit(point, direction, &site.axes);
            (0..3).for_each(|k| sum[k] += unit[k] * compliance);
        }
        sum
    }

    /// The compliances that the model has now, rad/(N·m).
    pub fn compliances(&self) -> Vec<f64> {
        self.sites.iter().map(|site| site.compliance).collect()
    }

    /// Compliance matrix of the tool at a point, m/N.
    pub fn matrix(&self, point: usize) -> M3 {
        let own = self.compliances();
        [0, 1, 2].map(|direction| self.slope(point, direction, &own))
    }
}

/// A drive with lost motion, as every point loads it.
#[derive(Debug, Clone)]
struct Gap {
    /// From stop to stop, rad.
    size: f64,
    /// Compliance of the drive, rad/(N·m).
    soft: f64,
    /// Translation of the tool at every point, m/rad, base frame.
    levers: Vec<V3>,
    /// Torque of the weight on the axis at every point, N·m.
    weights: Vec<f64>,
}

/// The force steps as the model predicts them: compliance, and jumps where a torque changes sign.
#[derive(Debug, Clone)]
pub struct Deflection {
    /// Movement of the tool per newton at every point, m/N: one vector per direction of the force.
    pub slopes: Vec<M3>,
    gaps: Vec<Gap>,
}

impl Deflection {
    /// Of a robot at the joint angles of each point, rad.
    pub fn of(robot: &Robot, points: &[Vec<f64>]) -> Self {
        let chain = elastic(robot);
        let mut work = Work::new(&chain);
        let mut slopes = Vec::with_capacity(points.len());
        let loose = springs(&chain).filter(|(_, spring)| spring.gap() > 0.0);
        let own = |(i, spring): (usize, &Spring)| (i, Gap::new(spring.gap(), spring.stiffness));
        let (loose, mut gaps): (Vec<usize>, Vec<Gap>) = loose.map(own).unzip();
        for angles in points {
            let q = chain.spread(angles);
            place(&chain, &mut work, &q);
            slopes.push(compliance(&chain, &work));
            for (hinge, gap) in loose.iter().zip(&mut gaps) {
                gap.meet(&chain, &mut work, *hinge, &q);
            }
        }
        Self { slopes, gaps }
    }

    /// The same with the displacement read elsewhere: at a point (m, base frame, every joint at zero)
    /// fixed to the body behind joint `after`, or to the foundation for 0. Without jumps.
    pub fn seen_at(robot: &Robot, points: &[Vec<f64>], after: usize, at: V3) -> Self {
        let chain = elastic(robot);
        let mut work = Work::new(&chain);
        let behind = match after {
            0 => robot.elastic.iter().filter(|axis| axis.after == 0).count(),
            _ => chain.drives.get(after - 1).map_or(0, |drive| drive + 1),
        };
        let zero = chain.points_at_zero();
        let slopes = points.iter().map(|angles| {
            place(&chain, &mut work, &chain.spread(angles));
            let tool = tcp(&chain, &work).point;
            let here = match behind.checked_sub(1) {
                Some(last) => {
                    let arm = rotate(&hinge_rotation(&work, last), sub(at, zero[last]));
                    add(hinge_point(&work, last), arm)
                }
                None => at,
            };
            let mut slope = [[0.0; 3]; 3];
            for (i, spring) in springs(&chain).filter(|(i, _)| *i < behind) {
                let (pushed, moved) = (column(&work, i, tool).0, column(&work, i, here).0);
                for (direction, own) in slope.iter_mut().enumerate() {
                    let turn = pushed[direction] / spring.stiffness;
                    (0..3).for_each(|k| own[k] += moved[k] * turn);
                }
            }
            slope
        });
        Self {
            slopes: slopes.collect(),
            gaps: Vec::new(),
        }
    }

    /// Whether force and displacement are in proportion.
    pub fn is_linear(&self) -> bool {
        self.gaps.is_empty()
    }

    /// Displacement of the tool beyond that in proportion to the force, m, base frame, step by step:
    /// every loose drive turns as forces (N, along `direction`, in their order) and weight press it,
    /// after its `law`; the weight is larger by `more` N·m than the model says.
    pub fn jumps(
        &self,
        (point, direction): (usize, usize),
        forces: &[f64],
        (law, more): (Law, f64),
    ) -> Vec<V3> {
        let mut all = vec![[0.0; 3]; forces.len()];
        for gap in &self.gaps {
            let lever = gap.levers[point];
            let press = |force: f64| Press {
                load: lever[direction] * force,
                weight: gap.weights[point] + more,
                soft: gap.soft,
            };
            let mut angle = law.angle(press(0.0), 0.0);
            for (sum, force) in all.iter_mut().zip(forces) {
                angle = law.angle(press(*force), angle);
                (0..3).for_each(|k| sum[k] += gap.size * angle * lever[k]);
            }
        }
        all
    }
}

impl Gap {
    fn new(size: f64, stiffness: f64) -> Self {
        Self {
            size,
            soft: 1.0 / stiffness,
            levers: Vec::new(),
            weights: Vec::new(),
        }
    }

    fn meet(&mut self, chain: &Chain, work: &mut Work, hinge: usize, q: &[f64]) {
        let weight = gravity_torque(chain, work, q)[hinge];
        let at = tcp(chain, work).point;
        self.levers.push(column(work, hinge, at).0);
        self.weights.push(-weight);
    }
}
/// Refuses a robot that these points cannot be simulated with.
///
/// # Errors
/// Another number of joints, nothing elastic, bodies that cannot be.
pub fn fits(robot: &Robot, test: &WorkspaceTest) -> Outcome<()> {
    let angles = test.facts.joint_angles.first().map_or(0, Vec::len);
    let refuse = |what: String, remedy: &str| Err(Problem::new(what, remedy).in_file(&test.path));
    if angles != robot.dof() {
        return refuse(
            format!(
                "gives {angles} joint angles per point, the robot `{}` has {} joints",
                robot.name,
                robot.dof()
            ),
            "correct `joint_angles_deg`, or name the right robot",
        );
    }
    if !robot.is_elastic() {
        return refuse(
            format!("nothing in the robot `{}` is elastic", robot.name),
            "add `drive = { stiffness_Nm_rad = .. }` to its joints; `ident robot convert FILE` makes an editable copy",
        );
    }
    check::bodies(robot).map_err(|problem| problem.in_file(&test.path))
}
