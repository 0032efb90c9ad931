//! Measuring cubes as the model predicts them: every elastic hinge turns by its compliance times the
//! moment about it, and a cube moves with all hinges before it (source 002, section 2.5).

mod seats;

use super::workspace::Site;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{
    M3, V3, add, cross, dot, product, rotate, rotate_back, rotation_vector, scale, sub, transpose,
};
use crate::measurement::cubes::{Cube, CubeTest, Reading};
use crate::motion::kinematics::{column, forward_kinematics, hinge_point, hinge_rotation, place};
use crate::motion::statics::springs;
use crate::motion::{Chain, Work, elastic};
use crate::robot::Robot;
pub use seats::AddedAxes;
use seats::{before, bends_before};

/// One file with its robot, ready to predict.
#[derive(Debug, Clone)]
pub struct Setup {
    chain: Chain,
    angles: Vec<f64>,
    /// The places whose compliance acts as one number; `axes` are hinges of the chain.
    pub sites: Vec<Site>,
    /// How well the robot file says that each is known (`stiffness_rel_std`), relative.
    pub stated: Vec<Option<f64>>,
    cubes: Vec<Seat>,
    load: Seat,
}

/// A point fixed to the structure.
#[derive(Debug, Clone, Copy)]
struct Seat {
    /// How many hinges lie before it.
    hinges: usize,
    /// In the base frame, unloaded, m.
    at: V3,
}

/// The robot bent by one load.
pub struct Bent {
    work: Work,
    /// Moment about every hinge at the load, N·m.
    torque: Vec<f64>,
    rest: Vec<(M3, V3)>,
}

impl Setup {
    /// Of a file and its robot.
    ///
    /// # Errors
    /// Another number of joints, nothing elastic, or a cube on a link or behind an axis that is not there.
    pub fn new(test: &CubeTest, robot: &Robot) -> Outcome<Self> {
        let none = AddedAxes {
            first: robot.elastic.len(),
            is_floor: false,
        };
        Self::bending(test, robot, none)
    }

    /// The same where some elastic axes are no part of the robot file: a bend within a link has the cubes behind it that
    /// lie farther along the link.
    ///
    /// # Errors
    /// As [`Setup::new`].
    pub fn bending(test: &CubeTest, robot: &Robot, added: AddedAxes) -> Outcome<Self> {
        let refuse = |what: String, remedy: &str| Problem::new(what, remedy).in_file(&test.path);
        let (given, joints) = (test.facts.joint_angles.len(), robot.dof());
        if given != joints {
            return Err(refuse(
                format!(
                    "gives {given} joint angles, the robot `{}` has {joints} joints",
                    robot.name
                ),
                "correct `joint_angles_deg`, or name the right robot",
            ));
        }
        if !robot.is_elastic() {
            return Err(refuse(
                format!("nothing in the robot `{}` is elastic", robot.name),
                "add `drive = { stiffness_Nm_rad = .. }` to its joints",
            ));
        }
        let chain = elastic(robot);
        let angles = chain.spread(&test.facts.joint_angles);
        let mut work = Work::new(&chain);
        let tcp = forward_kinematics(&chain, &mut work, &angles).point;
        let seat = |cube: &Cube| {
            let own = (&robot.elastic[..added.first], robot.dof());
            let hinges = before(own, &chain, cube).map_err(|p| p.at_key(&test.path, "cubes"))?;
            Ok(Seat {
                hinges: hinges + bends_before((robot, added), &chain, (&work, tcp), (cube, hinges)),
                at: cube.centre,
            })
        };
        let sites = sites(&chain);
        let stated = |site: &Site| {
            let mut springs = robot.springs();
            springs.find(|s| s.0 == site.name)?.1.stiffness_rel_std
        };
        Ok(Self {
            stated: sites.iter().map(stated).collect(),
            sites,
            cubes: test.facts.cubes.iter().map(seat).collect::<Outcome<_>>()?,
            load: Seat {
                hinges: chain.len(),
                at: test.facts.load_point.unwrap_or(tcp),
            },
            chain,
            angles,
        })
    }

    /// How many hinges lie before a cube.
    pub fn hinges_before(&self, cube: usize) -> usize {
        self.cubes[cube].hinges
    }

    /// Equilibrium under the load of a reading with the compliances of the sites (rad/(N·m)): the load keeps
    /// its direction, its point moves along.
    pub fn bent(&self, reading: &Reading, compliances: &[f64]) -> Bent {
        const STEPS: usize = 60;
        let mut work = Work::new(&self.chain);
        place(&self.chain, &mut work, &self.angles);
        let rest = frames(&self.chain, &work);
        let mut bent = Bent {
            torque: Vec::new(),
            rest,
            work,
        };
        let mut last = vec![0.0; self.chain.len()];
        for _ in 0..STEPS {
            bent.torque = self.torques(&bent, reading);
            let mut turned = vec![0.0; self.chain.len()];
            for (site, compliance) in self.sites.iter().zip(compliances) {
                site.axes
                    .iter()
                    .for_each(|i| turned[*i] = compliance * bent.torque[*i]);
            }
            let change = turned
                .iter()
                .zip(&last)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max);
            let q: Vec<f64> = self
                .angles
                .iter()
                .zip(&turned)
                .map(|(q, t)| q + t)
                .collect();
            place(&self.chain, &mut bent.work, &q);
            last = turned;
            if change < 1e-13 {
                break;
            }
        }
        bent
    }

    fn torques(&self, bent: &Bent, reading: &Reading) -> Vec<f64> {
        let at = bent.point(&self.load);
        let torque = |i: usize| {
            let (v, w) = column(&bent.work, i, at);
            dot(v, reading.force) + dot(w, reading.moment)
        };
        (0..self.chain.len()).map(torque).collect()
    }

    /// Displacement (m) and rotation vector (rad) of a cube.
    pub fn moved(&self, bent: &Bent, cube: usize) -> [f64; 6] {
        let seat = &self.cubes[cube];
        let shift = sub(bent.point(seat), seat.at);
        let turn = rotation_vector(&bent.turned(seat));
        [shift[0], shift[1], shift[2], turn[0], turn[1], turn[2]]
    }

    /// How a cube moves per unit compliance of a site, about the bent state.
    pub fn slope(&self, bent: &Bent, cube: usize, site: usize) -> [f64; 6] {
        let seat = &self.cubes[cube];
        let at = bent.point(seat);
        let mut sum = [0.0; 6];
        for i in self.sites[site].axes.iter().filter(|i| **i < seat.hinges) {
            let (v, w) = column(&bent.work, *i, at);
            for k in 0..3 {
                sum[k] += v[k] * bent.torque[*i];
                sum[3 + k] += w[k] * bent.torque[*i];
            }
        }
        sum
    }

    /// Moment of the load of a reading about a point (base frame, m), N·m, unloaded geometry.
    pub fn moment_about(&self, reading: &Reading, point: V3) -> V3 {
        add(
            reading.moment,
            cross(sub(self.load.at, point), reading.force),
        )
    }

    /// Where to take moments between two cubes: the first hinge behind the nearer one, else half way.
    pub fn between(&self, from: usize, to: usize) -> V3 {
        let (a, b) = (&self.cubes[from], &self.cubes[to]);
        if a.hinges < b.hinges {
            let mut work = Work::new(&self.chain);
            place(&self.chain, &mut work, &self.angles);
            return hinge_point(&work, b.hinges - 1);
        }
        scale(0.5, add(a.at, b.at))
    }
}

impl Bent {
    /// Where a seat is now, m.
    fn point(&self, seat: &Seat) -> V3 {
        let Some(last) = seat.hinges.checked_sub(1) else {
            return seat.at;
        };
        let (rotation, point) = &self.rest[last];
        let local = rotate_back(rotation, sub(seat.at, *point));
        add(
            hinge_point(&self.work, last),
            rotate(&hinge_rotation(&self.work, last), local),
        )
    }

    /// Rotation of its body from rest.
    fn turned(&self, seat: &Seat) -> M3 {
        match seat.hinges.checked_sub(1) {
            None => crate::ground::spatial::IDENTITY,
            Some(last) => product(
                &hinge_rotation(&self.work, last),
                &transpose(&self.rest[last].0),
            ),
        }
    }
}

fn frames(chain: &Chain, work: &Work) -> Vec<(M3, V3)> {
    (0..chain.len())
        .map(|i| (hinge_rotation(work, i), hinge_point(work, i)))
        .collect()
}

fn sites(chain: &Chain) -> Vec<Site> {
    let mut sites: Vec<Site> = Vec::new();
    for (i, spring) in springs(chain) {
        match sites.iter_mut().find(|site| site.name == chain.names[i]) {
            Some(site) => site.axes.push(i),
            None => sites.push(Site {
                name: chain.names[i].clone(),
                compliance: 1.0 / spring.stiffness,
                axes: vec![i],
            }),
        }
    }
    sites
}
