use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use super::shapes::odd_power;
use crate::ground::dual::Scalar;

/// The joint or its fixture becomes softer while it is tested.
pub struct Loosening;

impl Law for Loosening {
    const CARD: Card = Card {
        name: "loosening",
        cause: "loosening",
        family: Family::Physics,
        summary: "The connection loosens under the test: every cycle is softer than the one before.",
        equation: "φ += growth · M/M̂ · (W/Ŵ)^p, W = ∫|M dM| so far, Ŵ = at the end",
        source: "stiffness degradation with dissipated work, Baber and Wen 1981, eq. 7",
        signature: "the slope falls from cycle to cycle",
        parameters: &[
            Parameter {
                name: "growth",
                meaning: "deflection at the largest load gained over the whole test (negative: it settles)",
                scale: Scale::Deflection,
                bounds: (-1.0, 1.0),
                grid: &[0.05],
            },
            Parameter {
                name: "exponent",
                meaning: "1: in proportion to the work done; below 1: mostly at the start",
                scale: Scale::One,
                bounds: (0.4, 2.5),
                grid: &[0.6, 1.0, 1.7],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (growth, exponent) = (p[0], p[1]);
        let work = work_share(&scene.load);
        for ((y, load), share) in out.iter_mut().zip(&scene.load).zip(work) {
            if share > 0.0 {
                *y += growth * odd_power(S::constant(share), exponent) * (load / scene.load_scale);
            }
        }
    }
}

/// Work done so far as a share of all work: ∫|M dM| normalised.
fn work_share(load: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut work: Vec<f64> = vec![0.0];
    for pair in load.windows(2) {
        sum += 0.5 * (pair[0] + pair[1]).abs() * (pair[1] - pair[0]).abs();
        work.push(sum);
    }
    if sum > 0.0 {
        work.iter_mut().for_each(|w| *w /= sum);
    }
    work
}
