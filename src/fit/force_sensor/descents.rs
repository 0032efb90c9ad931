//! Ways down to the parameters: descents from turns of the sensor.

use super::fitted::{MOUNTED, System, less, size_at};
use super::poses::Pose;
use super::statics::N;
use crate::inference::descent::{self, Landscape, Linear, Stop};
use nalgebra::DVector;

/// What the poses and the prior say against parameters.
struct Poses<'a> {
    poses: &'a [Pose],
    prior: &'a [f64; N],
    noise: [f64; 2],
}

/// Parameters, what stands against them, and their natural sizes.
struct At {
    p: [f64; N],
    cost: f64,
    size: [f64; N],
}

impl Poses<'_> {
    fn at(&self, p: [f64; N]) -> At {
        let of = |pose: &Pose| {
            let left = less(pose, &p);
            (0..6).map(move |c| (left[c] / self.noise[c / 3]).powi(2))
        };
        let data: f64 = self.poses.iter().flat_map(of).sum();
        let prior = (0..N).map(|j| (p[j] / self.prior[j]).powi(2));
        At {
            cost: data + prior.sum::<f64>(),
            size: size_at(&p),
            p,
        }
    }
}

impl Landscape for Poses<'_> {
    type Place = At;

    fn height(&self, place: &At) -> f64 {
        place.cost
    }

    fn linear(&self, place: &mut At) -> Option<Linear> {
        let system = System::new(self.poses, self.prior, self.noise, &place.p);
        Some(Linear {
            slope: system.downhill(self.poses, self.prior, &place.p),
            normal: system.normal,
        })
    }

    fn step(&self, from: &At, step: &DVector<f64>) -> Option<At> {
        let moved = |j: usize| from.p[j] + step[j] * from.size[j];
        Some(self.at(std::array::from_fn(moved)))
    }
}

/// Ends a descent: the sum of squares is at its rounding.
const STOP: Stop = Stop {
    steps: 60,
    gain: 1e-12,
    share: 1e-12,
    promise: 0.0,
};

/// Down from `p`; where it arrives, and the cost there.
pub(super) fn descend(
    poses: &[Pose],
    prior: &[f64; N],
    noise: [f64; 2],
    p: [f64; N],
) -> ([f64; N], f64) {
    let all = Poses {
        poses,
        prior,
        noise,
    };
    let at = descent::descend(&all, all.at(p), STOP);
    (at.p, at.cost)
}

/// The best of descents from four turns of the sensor about its z, one quarter apart.
pub(super) fn start(poses: &[Pose], prior: &[f64; N], noise: [f64; 2]) -> [f64; N] {
    let quarter = std::f64::consts::FRAC_PI_2;
    let turns: &[f64] = if prior[12] > MOUNTED {
        &[0.0, 1.0, -1.0, 2.0]
    } else {
        &[0.0]
    };
    let begin = |turn: &f64| {
        let mut p = [0.0; N];
        p[12] = turn * quarter;
        let loads = |c: usize| poses.iter().map(move |pose| pose.load[c]);
        let n = poses.len() as f64;
        (0..6).for_each(|c| p[4 + c] = loads(c).sum::<f64>() / n);
        let swing = |c: usize| loads(c).map(|x| (x - p[4 + c]).powi(2)).sum::<f64>() / n;
        p[0] = (swing(0) + swing(1) + swing(2)).sqrt().max(1e-3);
        descend(poses, prior, noise, p)
    };
    let tried = turns.iter().map(begin);
    let best = tried.min_by(|a, b| a.1.total_cmp(&b.1));
    best.map_or([0.0; N], |best| best.0)
}
