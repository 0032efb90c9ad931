//! The workspace test as the model predicts it: how far the tool moves per newton at every point,
//! site by site. Deflection is linear in the compliances: C = Σ Jᵥ Jᵥᵀ / k (Abele et al. 2008).

use crate::ground::spatial::{M3, V3};
use crate::motion::kinematics::{column, place, tcp};
use crate::motion::statics::springs;
use crate::motion::{Work, elastic};
use crate::robot::Robot;

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
