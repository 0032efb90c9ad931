//! What a set-up would read: the movement of a place of the robot per newton at the tool, site by site.

use super::unknowns::Unknowns;
use crate::experiments::workspace::Site;
use crate::fit::force_steps::setups;
use crate::fit::validation::FORCE;
use crate::ground::spatial::{V3, add, cross, normals, scale, sub, unit};
use crate::measurement::workspace_test::WorkspaceTest;
use crate::motion::chain::Chain;
use crate::motion::kinematics::{column, hinge_point, place, tcp};
use crate::motion::statics::springs;
use crate::motion::{Work, elastic};
use crate::robot::Robot;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// Where the sensor stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Seat {
    /// Three components of the tool's movement.
    Tool,
    /// Three components at the far end of link i, from 1.
    Link(usize),
    /// Three rotations of the foot, read over [`FOOT_LEVER`].
    Foot,
}

/// How long the tool is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Reach {
    /// As it is mounted.
    Mounted,
    /// Longer by a stiff bar along it.
    Along,
    /// With a stiff bar across it.
    Across,
}

/// One set-up: a pose, a load, a place of the sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Joint angles, rad.
    pub angles: Vec<f64>,
    /// Where force and tool sensor act.
    pub reach: Reach,
    /// Direction of the force, base frame: 0 x, 1 y, 2 z.
    pub direction: usize,
    /// Where the sensor stands.
    pub seat: Seat,
}

/// Distance of the displacement sensors on the foot from its middle, m.
pub const FOOT_LEVER: f64 = 0.5;
/// Length of the bar, m.
const BAR: f64 = 0.5;

impl Reach {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Mounted, Self::Along, Self::Across];

    /// In words.
    pub fn word(self) -> &'static str {
        match self {
            Self::Mounted => "mounted tool",
            Self::Along => "bar of 0.5 m along the tool",
            Self::Across => "bar of 0.5 m across the tool",
        }
    }

    /// Where force and sensor act, m, base frame, every joint at zero.
    pub fn tip(self, robot: &Robot) -> V3 {
        let tool = &robot.tool;
        let along = unit(sub(tool.tcp, tool.flange)).unwrap_or([1.0, 0.0, 0.0]);
        let bar = match self {
            Self::Mounted => [0.0; 3],
            Self::Along => scale(BAR, along),
            Self::Across => scale(BAR, normals(along).0),
        };
        add(tool.tcp, bar)
    }
}

impl Seat {
    /// Site name as in results.
    pub fn name(self) -> String {
        match self {
            Self::Tool => "tool".into(),
            Self::Link(i) => format!("link{i}"),
            Self::Foot => "foot".into(),
        }
    }

    /// All of them on a robot.
    pub fn of(robot: &Robot) -> Vec<Self> {
        let links = (1..robot.dof()).map(Self::Link);
        [Self::Tool]
            .into_iter()
            .chain(links)
            .chain([Self::Foot])
            .collect()
    }
}

/// How a reading scatters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Standard deviation of a component, m/N.
    pub slope: f64,
    /// Relative standard deviation that the components of a set-up share.
    pub repeatability: f64,
    /// From readings, not assumed.
    pub measured: bool,
}

impl Noise {
    /// As the readings of a test scatter; without one 3 µm at 750 N and 2 % from set-up to set-up.
    pub fn of(test: Option<&WorkspaceTest>) -> Self {
        let lines = test.map_or_else(Vec::new, setups);
        let lines = lines.iter().flat_map(|setup| setup.lines.iter().flatten());
        let mut sizes: Vec<f64> = lines.map(|line| line.stderr).filter(|s| *s > 0.0).collect();
        sizes.sort_by(f64::total_cmp);
        let measured = sizes.get(sizes.len() / 2).copied();
        let stated = test.and_then(|test| test.facts.setup_repeatability);
        Self {
            slope: measured.unwrap_or(3e-6 / FORCE),
            repeatability: stated.unwrap_or(0.02),
            measured: measured.is_some(),
        }
    }

    /// Rows with unit noise: what the components share is taken about the slopes expected.
    fn whiten(&self, rows: DMatrix<f64>, mean: &DVector<f64>) -> DMatrix<f64> {
        let expected = &rows * mean;
        let own = DMatrix::identity(rows.nrows(), rows.nrows()) * self.slope.powi(2);
        let shared = &expected * expected.transpose() * self.repeatability.powi(2);
        let root = (own + shared).cholesky();
        let white = root.and_then(|root| root.l().solve_lower_triangular(&rows));
        white.unwrap_or(rows / self.slope)
    }
}

/// The robot as the sensors see it: one chain for each length of the tool.
pub struct Sights<'a> {
    sites: &'a [Site],
    chains: Vec<(Reach, Chain)>,
    foot: usize,
}

impl<'a> Sights<'a> {
    /// Of everything that may give way.
    pub fn of(unknowns: &'a Unknowns) -> Self {
        let robot = &unknowns.robot;
        let chain = |reach: Reach| {
            let mut chain = elastic(robot);
            chain.end_at(reach.tip(robot), robot.tool.rotation);
            (reach, chain)
        };
        Self {
            sites: &unknowns.sites,
            chains: Reach::ALL.into_iter().map(chain).collect(),
            foot: robot.elastic.iter().filter(|axis| axis.after == 0).count(),
        }
    }

    /// Rows of every set-up with unit noise, in order.
    pub fn all(
        &self,
        settings: &[Setting],
        noise: &Noise,
        mean: &DVector<f64>,
    ) -> Vec<DMatrix<f64>> {
        let one = |setting: &Setting| noise.whiten(self.rows(setting), mean);
        settings.par_iter().map(one).collect()
    }

    /// Movement per newton and per unit of each unknown, m/N.
    pub fn rows(&self, setting: &Setting) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(3, self.sites.len());
        let Some((_, chain)) = self
            .chains
            .iter()
            .find(|(reach, _)| *reach == setting.reach)
        else {
            return rows;
        };
        let mut work = Work::new(chain);
        place(chain, &mut work, &chain.spread(&setting.angles));
        let at = tcp(chain, &work).point;
        let moves: Vec<(f64, V3)> = springs(chain)
            .map(|(hinge, _)| {
                let load = column(&work, hinge, at).0[setting.direction];
                (load, self.lever(chain, &work, hinge, setting.seat))
            })
            .collect();
        for (j, site) in self.sites.iter().enumerate() {
            for (load, lever) in site.axes.iter().filter_map(|axis| moves.get(*axis)) {
                (0..3).for_each(|k| rows[(k, j)] += lever[k] * load * site.compliance);
            }
        }
        rows
    }

    /// How a place moves per radian of a hinge, m.
    fn lever(&self, chain: &Chain, work: &Work, hinge: usize, seat: Seat) -> V3 {
        match seat {
            Seat::Tool => column(work, hinge, tcp(chain, work).point).0,
            Seat::Foot if hinge < self.foot => scale(FOOT_LEVER, column(work, hinge, [0.0; 3]).1),
            Seat::Foot => [0.0; 3],
            Seat::Link(i) => match chain.drives.get(i) {
                // The axes of the next joint pass through the end of the link.
                Some(next) if hinge < *next => {
                    let (_, axis) = column(work, hinge, [0.0; 3]);
                    let end = hinge_point(work, *next);
                    cross(axis, sub(end, hinge_point(work, hinge)))
                }
                _ => [0.0; 3],
            },
        }
    }
}
