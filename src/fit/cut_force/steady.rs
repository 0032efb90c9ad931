//! Samples beside a jump: an edge that enters or leaves at once changes the force of the next sample, and no slope of the model
//! says when. On the wrong side of it a sample holds a fit where it is, far above its noise: all they say is that the jump is thereabouts.

use crate::cutting::wave::Side;
use crate::experiments::milling_force::{CutScene, PHASE, RUNOUT, UNKNOWNS, WIDTH};
use crate::ground::spatial::V3;
use std::f64::consts::{PI, TAU};

/// How well it is known where a force jumps.
#[derive(Debug, Clone, Copy)]
pub struct Known {
    /// The angle of the teeth, rad.
    pub turn_rad: f64,
    /// Either part of the runout, m.
    pub runout_m: f64,
    /// Whether what the slope of a force says is no jump.
    pub sloped: bool,
}

/// How well the width of a cut is known, m.
const WIDTH_M: f64 = 5e-5;
/// Of a narrow one this share: a choice.
const NARROW: f64 = 0.1;
/// Share of the range of a force that a shift changes if it is a jump; beyond what its slope says, since an edge alone makes small ones.
const JUMP: f64 = 0.1;
const SMALL: f64 = 0.05;
/// So near to where the chip is nothing a straight tooth may scrape or not, rad. No other number was tried.
const SCRAPING: f64 = 0.1;
/// Of many teeth no more than this share of their pitch to either side: a choice.
const OF_PITCH: f64 = 0.1;

/// Samples that do not stand beside a jump of the simulated force: those say only that the jump is thereabouts. Nor where straight
/// teeth begin or end to scrape: a few µm of their radii move that by degrees.
pub fn steady_samples(scene: &CutScene, p: &[f64; UNKNOWNS], known: Known) -> Vec<bool> {
    let here = scene.predict(p);
    let (sloped, share) = if known.sloped {
        (1.0, SMALL)
    } else {
        (0.0, JUMP)
    };
    let least = range(&here.force).map(|r| share * r);
    let [turn, runout] = [known.turn_rad, known.runout_m];
    let shifts = [
        (PHASE, turn),
        (WIDTH, WIDTH_M.min(NARROW * p[WIDTH])),
        (RUNOUT, runout),
        (RUNOUT + 1, runout),
    ];
    let both = shifts.into_iter().filter(|(_, by)| *by > 0.0);
    let both = both.flat_map(|(place, by)| [(place, by), (place, -by)]);
    let beside: Vec<(usize, f64, Vec<V3>)> = both
        .map(|(place, by)| {
            let mut p = *p;
            p[place] += by;
            (place, sloped * by, scene.force(&p))
        })
        .collect();
    let angles = scene.angles(p);
    let holds = |i: usize| {
        let still = |(place, by, there): &(usize, f64, Vec<V3>)| {
            let slope = &here.slopes[*place][i];
            let beyond = |k: usize| there[i][k] - here.force[i][k] - by * slope[k];
            (0..3).all(|k| beyond(k).abs() <= least[k])
        };
        !(scene.jumps() && scrapes(scene, angles[i])) && beside.iter().all(still)
    };
    (0..here.force.len()).map(holds).collect()
}

/// Range of a force, by axis.
pub fn range(force: &[V3]) -> V3 {
    [0, 1, 2].map(|k| {
        let own = force.iter().map(|f| f[k]);
        let (low, high) = own.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
        high - low
    })
}

/// Whether a straight tooth stands where its chip begins or ends at nothing, when tooth 1 is at this angle.
fn scrapes(scene: &CutScene, angle: f64) -> bool {
    let borders: &[f64] = match scene.cut.side {
        Side::Up => &[0.0],
        Side::Down => &[PI],
        Side::Slot => &[0.0, PI],
    };
    let pitch = TAU / scene.tool.teeth as f64;
    let near = |border: &f64| {
        let away = (angle - border).rem_euclid(pitch);
        away.min(pitch - away) < SCRAPING.min(OF_PITCH * pitch)
    };
    borders.iter().any(near)
}
