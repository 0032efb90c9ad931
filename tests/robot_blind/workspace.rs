//! Force steps at nine points: what the sensors of a workspace test show.

use super::law::Law;
use super::noise::Noise;
use super::poses::Angles;
use super::robot::{M3, Robot, V3};
use crate::blind_generator::random::Random;
use nalgebra::DMatrix;

/// What was done and with what.
#[derive(Clone)]
pub struct Plan {
    pub points: Vec<Angles>,
    pub layout: &'static str,
    /// Cycle and force of every step of a set-up, N.
    pub steps: Vec<(usize, f64)>,
    /// Only the displacement along the load is measured.
    pub along_only: bool,
    pub noise: Noise,
    pub setup: f64,
    pub spread: f64,
}

/// A set-up that went wrong: the point, one direction or all, a factor and a motion per newton.
#[derive(Clone)]
pub struct Spoilt {
    pub point: usize,
    pub direction: Option<usize>,
    pub factor: f64,
    pub stray: V3,
}

/// The real robot under the real instruments.
#[derive(Clone)]
pub struct Scene {
    pub robot: Robot,
    /// Force really applied per newton reported, a column per direction.
    pub force: M3,
    /// Reading over displacement per component.
    pub gains: V3,
    pub spoilt: Option<Spoilt>,
    pub laws: Vec<Law>,
    /// Sliding of the flange along an axis of the tool, m/N.
    pub sliding: Option<(V3, f64)>,
    /// Share of a cycle's largest displacement that the next cycles start from.
    pub set_per_cycle: f64,
    /// Growth of every reading with each step, m.
    pub growth: V3,
}

impl Scene {
    pub fn new(robot: Robot) -> Self {
        Self {
            robot,
            force: M3::identity(),
            gains: V3::from_element(1.0),
            spoilt: None,
            laws: Vec::new(),
            sliding: None,
            set_per_cycle: 0.0,
            growth: V3::zeros(),
        }
    }
}

impl Plan {
    pub fn draw(
        points: (Vec<Angles>, &'static str),
        both_signs: bool,
        random: &mut Random,
    ) -> Self {
        let rough = random.log_uniform(150.0, 900.0);
        let most = (rough / 10.0).round() * 10.0;
        Self {
            points: points.0,
            layout: points.1,
            steps: steps(most, both_signs, random),
            along_only: random.chance(0.25),
            noise: Noise::draw(random.log_uniform(1e-6, 6e-6), 0.2, random),
            setup: random.uniform(0.005, 0.02),
            spread: random.uniform(0.03, 0.1),
        }
    }

    pub fn setups(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.points.len()).flat_map(|p| (0..3).map(move |d| (p, d)))
    }

    pub fn measures(&self, direction: usize, component: usize) -> bool {
        !self.along_only || direction == component
    }

    /// Largest force, N.
    pub fn most(&self) -> f64 {
        self.steps.iter().fold(0.0, |m, s| m.max(s.1.abs()))
    }
}

/// Up and down in equal steps, both signs or one, several cycles, set by hand.
fn steps(most: f64, both: bool, random: &mut Random) -> Vec<(usize, f64)> {
    let levels = random.integer(2, 4);
    let (cycles, sign) = (random.integer(1, 3), random.sign());
    let mut out = Vec::new();
    for cycle in 1..=cycles {
        for side in [sign, -sign].iter().take(if both { 2 } else { 1 }) {
            for step in 0..2 * levels {
                let level = if step < levels {
                    step
                } else {
                    2 * levels - step
                };
                let hand = if level == 0 {
                    0.0
                } else {
                    random.uniform(0.97, 1.0)
                };
                out.push((cycle, side * most * hand * level as f64 / levels as f64));
            }
        }
        out.push((cycle, 0.0));
    }
    out
}

/// What a robot does at a point: tool motion per degree of freedom and springs.
pub struct Stand {
    jacobian: DMatrix<f64>,
    compliances: Vec<f64>,
    sites: Vec<String>,
    gravity: Vec<f64>,
    turn: M3,
    angles: Angles,
}

impl Stand {
    pub fn new(robot: &Robot, angles: &Angles, loaded: bool) -> Self {
        let chain = robot.at(angles);
        Self {
            jacobian: chain.jacobian(),
            compliances: chain.compliances(),
            sites: chain.degrees.iter().map(|d| d.site.clone()).collect(),
            gravity: if loaded { chain.gravity() } else { Vec::new() },
            turn: chain.turn(),
            angles: *angles,
        }
    }

    /// What every degree of freedom adds to the displacement under `force`.
    pub fn shares(&self, force: &V3) -> Vec<V3> {
        let each = self.compliances.iter().enumerate();
        each.map(|(i, c)| {
            let column: V3 = self.jacobian.fixed_view::<3, 1>(0, i).into();
            column * (c * column.dot(force))
        })
        .collect()
    }

    /// What a law of a joint adds beyond its spring, step by step.
    fn beyond(&self, law: &Law, forces: &[V3]) -> Vec<V3> {
        let Some(i) = self.sites.iter().position(|s| *s == law.site()) else {
            return vec![V3::zeros(); forces.len()];
        };
        let column: V3 = self.jacobian.fixed_view::<3, 1>(0, i).into();
        let torques: Vec<f64> = forces.iter().map(|f| column.dot(f)).collect();
        let angles = law.angles(&torques, self.gravity[i], self.compliances[i], &self.angles);
        angles.into_iter().map(|a| column * a).collect()
    }
}

impl Scene {
    pub fn stands(&self, plan: &Plan) -> Vec<Stand> {
        let loaded = !self.laws.is_empty();
        let each = plan.points.iter();
        each.map(|p| Stand::new(&self.robot, p, loaded)).collect()
    }

    /// Displacement readings of a set-up, step by step, without noise.
    pub fn readings(&self, plan: &Plan, stand: &Stand, setup: (usize, usize)) -> Vec<V3> {
        let applied: V3 = self.force.column(setup.1).into();
        let forces: Vec<V3> = plan.steps.iter().map(|s| applied * s.1).collect();
        let unit: V3 = stand.shares(&applied).iter().sum();
        let mut out: Vec<V3> = plan.steps.iter().map(|s| unit * s.1).collect();
        for law in &self.laws {
            let beyond = stand.beyond(law, &forces);
            out.iter_mut().zip(beyond).for_each(|(o, b)| *o += b);
        }
        if let Some((axis, soft)) = self.sliding {
            let axis = stand.turn * axis;
            let each = out.iter_mut().zip(&forces);
            each.for_each(|(o, f)| *o += axis * (soft * axis.dot(f)));
        }
        self.remember(plan, &mut out);
        if let Some(wrong) = self.spoilt.as_ref().filter(|w| w.hits(setup)) {
            let each = out.iter_mut().zip(&plan.steps);
            each.for_each(|(o, s)| *o = *o * wrong.factor + wrong.stray * s.1);
        }
        out.iter().map(|o| o.component_mul(&self.gains)).collect()
    }

    /// Permanent set from cycle to cycle, and growth since the set-up was zeroed.
    fn remember(&self, plan: &Plan, out: &mut [V3]) {
        let largest = out.iter().map(V3::norm).fold(0.0, f64::max);
        let way: V3 = out
            .iter()
            .find(|o| o.norm() == largest)
            .copied()
            .unwrap_or_default();
        for (k, o) in out.iter_mut().enumerate() {
            let later = plan.steps[k].0 as f64 - 1.0;
            *o += way * (self.set_per_cycle * later);
            *o += self.growth * k as f64;
        }
    }
}

impl Spoilt {
    fn hits(&self, (point, direction): (usize, usize)) -> bool {
        self.point == point && self.direction.is_none_or(|d| d == direction)
    }
}
