//! Block bootstrap over cycles: intervals that assume nothing about the noise.

use super::least_squares::{Problem, minimise};
use super::observation::Observation;
use super::solution::Solution;
use crate::ground::random::Random;
use crate::ground::stats::difference;
use crate::inference::descent::Stop;

/// 95 % intervals of every parameter from `draws` resamplings of the residual, cycle by cycle.
///
/// Each draw adds to the fitted curve, for every cycle, the residual of a randomly chosen cycle
/// (moving blocks of one cycle, Künsch 1989), and fits again. Seeded: the same on every machine.
pub fn intervals(
    solution: &Solution,
    data: &Observation,
    draws: usize,
    seed: u64,
) -> Vec<[f64; 2]> {
    use rayon::prelude::*;
    let fits: Vec<Vec<f64>> = (0..draws as u64)
        .into_par_iter()
        .map(|draw| {
            refit(
                solution,
                data,
                &mut Random::new(seed.wrapping_mul(1_000_003).wrapping_add(draw)),
            )
        })
        .collect();
    (0..solution.p.len())
        .map(|j| spread(fits.iter().map(|p| p[j]).collect()))
        .collect()
}

fn refit(solution: &Solution, data: &Observation, random: &mut Random) -> Vec<f64> {
    let fitted: Vec<f64> = difference(&data.reading, &solution.residual);
    let noise = shuffled(solution, data, random);
    let reading = fitted.iter().zip(noise).map(|(f, r)| f + r).collect();
    let scene = &data.scene;
    let again =
        Observation::from_channels(scene.time.clone(), scene.load.clone(), reading, data.block);
    let ignored = vec![false; again.rows()];
    let problem = Problem {
        model: &solution.model,
        data: &again,
        colour: &solution.colour,
        ignored: &ignored,
    };
    minimise(&problem, &solution.p, Stop::default()).p
}

/// Residual blocks of one cycle's length, drawn with replacement and a random sign.
fn shuffled(solution: &Solution, data: &Observation, random: &mut Random) -> Vec<f64> {
    let n = data.rows();
    let length = (n / data.cycles.count().max(1)).clamp(1, n);
    let mut noise = Vec::with_capacity(n + length);
    while noise.len() < n {
        let start = random.below(n - length + 1);
        let sign = if random.unit() < 0.5 { -1.0 } else { 1.0 };
        noise.extend(
            solution.residual[start..start + length]
                .iter()
                .map(|r| sign * r),
        );
    }
    noise.truncate(n);
    noise
}

fn spread(mut values: Vec<f64>) -> [f64; 2] {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let x = share * (values.len().max(1) - 1) as f64;
        let (low, high) = (values[x.floor() as usize], values[x.ceil() as usize]);
        low + (high - low) * x.fract()
    };
    [at(0.025), at(0.975)]
}
