//! How visible a change is in a workspace test.

use super::robot::V3;
use super::workspace::{Plan, Scene};

/// Readings of a scene at every set-up, and what they are uncertain by at the largest force.
pub struct Before {
    readings: Vec<Vec<V3>>,
    sigma: Vec<V3>,
    largest: usize,
}

fn all(scene: &Scene, plan: &Plan) -> Vec<Vec<V3>> {
    let stands = scene.stands(plan);
    let each = plan.setups();
    each.map(|(p, d)| scene.readings(plan, &stands[p], (p, d)))
        .collect()
}

impl Before {
    pub fn of(scene: &Scene, plan: &Plan) -> Self {
        let steps = plan.steps.iter().enumerate();
        let by_force = |a: &(usize, &(usize, f64)), b: &(usize, &(usize, f64))| {
            a.1.1.abs().total_cmp(&b.1.1.abs())
        };
        let largest = steps.max_by(by_force).unwrap().0;
        let (readings, stands) = (all(scene, plan), scene.stands(plan));
        let sigma = plan.setups().zip(&readings).map(|((p, d), readings)| {
            let force = V3::ith(d, plan.steps[largest].1);
            let spread = plan.spread;
            let shares = stands[p].shares(&force);
            let nominal: V3 = shares.iter().map(|s| (s * spread).map(|x| x * x)).sum();
            let setup = (readings[largest] * plan.setup).map(|x| x * x);
            (nominal + setup).map(|v| (v + plan.noise.size.powi(2)).sqrt())
        });
        Self {
            sigma: sigma.collect(),
            readings,
            largest,
        }
    }

    /// Largest change of a measured component: of its size at the largest force over its
    /// uncertainty, or (`shape`) of the part that a straight line cannot absorb over the noise.
    pub fn strength(&self, after: &Scene, plan: &Plan, shape: bool) -> f64 {
        let after = all(after, plan);
        let mut most: f64 = 0.0;
        for (s, (_, direction)) in plan.setups().enumerate() {
            for c in (0..3).filter(|c| plan.measures(direction, *c)) {
                let change = |k: usize| after[s][k][c] - self.readings[s][k][c];
                most = most.max(match shape {
                    false => change(self.largest).abs() / self.sigma[s][c],
                    true => bent(plan, change) / plan.noise.size,
                });
            }
        }
        most
    }
}

/// Largest distance of a change from its straight line over force.
fn bent(plan: &Plan, change: impl Fn(usize) -> f64) -> f64 {
    let n = plan.steps.len();
    let mean = |f: &dyn Fn(usize) -> f64| (0..n).map(f).sum::<f64>() / n as f64;
    let (force, level) = (mean(&|k| plan.steps[k].1), mean(&change));
    let load = |k: usize| plan.steps[k].1 - force;
    let slope = mean(&|k| load(k) * (change(k) - level)) / mean(&|k| load(k) * load(k));
    let left = |k: usize| (change(k) - level - slope * load(k)).abs();
    (0..n).map(left).fold(0.0, f64::max)
}
