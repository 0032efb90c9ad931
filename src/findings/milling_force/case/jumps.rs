//! Straight teeth enter and leave at once, and nothing spreads it: where a force jumps, no slope says where to go.

use super::CutSamples;
use crate::experiments::milling_force::{PHASE, Predicted};
use crate::findings::milling_force::setting::Present;
use crate::fit::cut_force::{Known, range, steady_samples};
use nalgebra::{Matrix6, Vector6};

/// How far from where a fit of slopes left it the angle of the tooth is sought, rad, in how many steps to either side; then
/// closer, in steps of as many parts of the first.
const FARTHEST: f64 = 0.16;
const STEPS: i32 = 32;
const CLOSER: i32 = 5;
/// Steps to one side in which the sample is sought that sees another force at once, and what share of the range that is.
const FINE: i32 = 80;
const SWITCH: f64 = 0.5;
/// No angle is known better, rad.
const LEAST: f64 = 2e-3;
/// How well the angle of a jump is known, rad.
const KNOWN: f64 = 4e-3;

/// The angle of tooth 1 at which the jumps are where the record has them, whatever the coefficients, and its standard deviation.
pub(super) fn placed(cut: &CutSamples) -> (f64, f64) {
    let from = cut.present.p[PHASE];
    let step = FARTHEST / f64::from(STEPS);
    let about = |middle: f64, step: f64, count: i32| {
        let each = (-count..=count).map(|k| middle + f64::from(k) * step);
        let tried = each.map(|phase| (misfit(cut, phase), phase));
        tried
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map_or(middle, |best| best.1)
    };
    let near = about(from, step, STEPS);
    let best = about(near, step / f64::from(CLOSER), CLOSER);
    let [low, high] = [-1.0, 1.0].map(|side| best + side * still(cut, best, side));
    // it stays between two samples where what is uncertain goes as far as two deviations
    (0.5 * (low + high), (0.25 * (high - low)).max(LEAST))
}

/// How far the tooth may turn to one side until a sample sees another force at once, rad.
fn still(cut: &CutSamples, phase: f64, side: f64) -> f64 {
    let scene = &cut.present.scene;
    let at = |turn: f64| {
        let mut p = cut.present.p;
        p[PHASE] = phase + side * turn;
        scene.force(&p)
    };
    let mut before = at(0.0);
    let least = range(&before).map(|r| SWITCH * r);
    let step = FARTHEST / f64::from(FINE);
    let jumped = |k: &i32| {
        let now = at(f64::from(*k) * step);
        let mut each = now.iter().zip(&before);
        let any = each.any(|(a, b)| (0..3).any(|k| (a[k] - b[k]).abs() > least[k]));
        before = now;
        any
    };
    let first = (1..=FINE).find(jumped).unwrap_or(FINE);
    f64::from(first - 1) * step
}

/// Sum of squares that any six coefficients leave.
fn misfit(cut: &CutSamples, phase: f64) -> f64 {
    let mut p = cut.present.p;
    p[PHASE] = phase;
    let Predicted { slopes, .. } = cut.present.scene.predict(&p);
    let (mut inner, mut right, mut sum) = (Matrix6::zeros(), Vector6::zeros(), 0.0);
    for (i, measured) in cut.measured.iter().enumerate() {
        for k in 0..3 {
            let row = Vector6::from_fn(|j, _| slopes[j][i][k]);
            inner += row * row.transpose();
            right += row * measured[k];
            sum += measured[k] * measured[k];
        }
    }
    let held = 1e-9 * inner.diagonal().max();
    (0..6).for_each(|j| inner[(j, j)] += held.max(f64::MIN_POSITIVE));
    let solved = inner.cholesky().map(|root| root.solve(&right));
    solved.map_or(sum, |amounts| sum - amounts.dot(&right))
}

/// Samples that do not stand beside a jump of the simulated force. `runout_m`: as stated.
pub(super) fn steady(cut: &CutSamples, runout_m: f64) -> Vec<bool> {
    let Present { scene, p, .. } = &cut.present;
    let known = Known {
        turn_rad: KNOWN,
        runout_m: if scene.jumps() { runout_m } else { 0.0 },
        sloped: scene.jumps(),
    };
    steady_samples(scene, p, known)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutting::tool::Tool;
    use crate::cutting::wave::{Cut, Side};
    use crate::experiments::milling_force::{CutScene, UNKNOWNS, WIDTH};

    const PHASE_RAD: f64 = 0.43;

    /// Straight teeth, and a start that is `off` from where tooth 1 stood.
    fn samples(off: f64) -> CutSamples {
        let scene = CutScene {
            tool: Tool::square(8e-3, 2, 0.0),
            cut: Cut {
                spindle_rad_s: 600.0,
                feed_m_s: 0.02,
                depth_m: 2e-3,
                width_m: 5e-3,
                side: Side::Up,
            },
            time: (0..700).map(|i| 9.3e-5 * f64::from(i)).collect(),
            low_pass: false,
            resonant: None,
            shorter: Vec::new(),
            chipped: Vec::new(),
            chipped_to_m: 0.0,
            slice_rad: crate::cutting::tool::FINE,
        };
        let mut p = [0.0; UNKNOWNS];
        p[..6].copy_from_slice(&[900e6, 300e6, 100e6, 15e3, 20e3, 2e3]);
        (p[PHASE], p[WIDTH]) = (PHASE_RAD, scene.cut.width_m);
        let mut other = p;
        (other[0], other[3]) = (1.2 * p[0], 0.8 * p[3]);
        let measured = scene.force(&other);
        p[PHASE] += off;
        CutSamples {
            measured,
            time: scene.time.clone(),
            present: Present {
                scene,
                p,
                speed: 0.0,
            },
            first: 0,
            turn: f64::INFINITY,
        }
    }

    #[test]
    fn the_tooth_is_placed_by_its_jumps_whatever_the_coefficients() {
        for off in [-0.11, 0.002, 0.14] {
            let (phase, spread) = placed(&samples(off));
            let away = phase - PHASE_RAD;
            assert!(
                away.abs() < 3.0 * spread && spread < 0.02,
                "{off}: {away} of {spread}"
            );
        }
    }

    #[test]
    fn samples_beside_a_jump_alone_are_left_out() {
        let cut = samples(0.0);
        let kept = steady(&cut, 0.0);
        let out = kept.iter().filter(|k| !**k).count();
        assert!((1..140).contains(&out), "{out} of {}", kept.len());
    }
}
