//! The samples of a record that are compared, and how well they are known.

use super::CutSamples;
use super::jumps::{placed, steady};
use crate::cutting::LINEAR_EDGE;
use crate::cutting::tool::FINE;
use crate::experiments::milling_force::{BANDWIDTH, BORDER, PHASE, RUNOUT, SPEED, WIDTH};
use crate::findings::milling_force::direction::Direction;
use crate::findings::milling_force::noise::Colour;
use crate::findings::milling_force::runout::as_stated;
use crate::findings::milling_force::setting::Present;
use crate::fit::cut_force::{Account, BORDER_SHARE, CutFit};
use crate::ground::stats::{median, rms};
use crate::measurement::milling_force::{Facts, MillingForce};

/// Samples of all cuts that are compared at most: more cost time and tell little.
const MOST_SAMPLES: usize = 2800;
/// Pieces of a record that is longer than its share.
const PIECES: usize = 8;
/// Share of the force's own rms that the law of a sharp edge misses anyway: digits of the chip's surface.
const LAW: f64 = 2e-3;

/// Share of the deepest cut, from the tip, in which a tooth mostly breaks that does not break altogether.
const TIP: f64 = 0.7;

/// The stated coefficients, what is left out zero; else those of the fit.
pub(super) fn nominal(facts: &Facts, account: &Account) -> [f64; 6] {
    let Some(stated) = &facts.nominal else {
        return std::array::from_fn(|j| account.cuts[0].p[j]);
    };
    let card = LINEAR_EDGE.card();
    std::array::from_fn(|j| {
        let coefficient = &card.coefficients[j];
        let own = stated
            .coefficients
            .iter()
            .find(|(key, _)| key == coefficient.key);
        own.map_or(0.0, |(_, value)| value * coefficient.factor)
    })
}

/// The samples of every cut that are compared.
pub(super) fn samples(
    file: &MillingForce,
    account: &Account,
    speeds: &[f64],
    nominal: &[f64; 6],
) -> Vec<CutSamples> {
    let share = (MOST_SAMPLES / account.cuts.len().max(1)).max(64);
    let depths = file.facts.cuts.iter().map(|c| c.depth_m);
    let deepest = depths.fold(0.0, f64::max);
    let fitted = [0, 1].map(|k| account.cuts[0].p[RUNOUT + k]);
    let runout = match (file.facts.runout_m, account.runout_covariance) {
        (Some(size), Some(covariance)) => Direction {
            at: fitted,
            covariance,
        }
        .of_size(as_stated(size, fitted[0].hypot(fitted[1]))),
        _ => [0.0; 2],
    };
    let mut first = 0;
    let mut one = |(i, fit): (usize, &CutFit)| {
        let data = &fit.data;
        let used = pieces(data.force.len(), share);
        let mut scene = data.scene.clone();
        let whole = (1.0 + speeds[i]) * (1.0 + fit.p[SPEED]);
        scene.cut.spindle_rad_s = file.facts.cuts[i].spindle_rad_s * whole;
        scene.chipped_to_m = TIP * deepest;
        scene.slice_rad = FINE;
        scene.time = used.iter().map(|at| data.scene.time[*at]).collect();
        let mut p = fit.p;
        p[..6].copy_from_slice(nominal);
        p[SPEED] = 0.0;
        p[RUNOUT..RUNOUT + 2].copy_from_slice(&runout);
        p[WIDTH] = scene.cut.width_m;
        // as known beforehand: a fit of everything lets it make up for whatever is wrong
        p[BORDER] = BORDER_SHARE[0];
        if let Some(hz) = data.bandwidth_hz {
            p[BANDWIDTH] = hz.ln();
        }
        debug_assert!(p[PHASE].is_finite());
        let record = &file.records[i];
        let mut cut = CutSamples {
            measured: used
                .iter()
                .map(|at| record.force[data.settling + at])
                .collect(),
            time: used
                .iter()
                .map(|at| record.time[data.settling + at])
                .collect(),
            present: Present {
                scene,
                p,
                speed: whole - 1.0,
            },
            first,
            turn: f64::INFINITY,
        };
        if cut.present.scene.jumps() {
            (cut.present.p[PHASE], cut.turn) = placed(&cut);
        }
        cut.only(&steady(&cut, file.facts.runout_m.unwrap_or(0.0)));
        first += cut.time.len();
        cut
    };
    account.cuts.iter().enumerate().map(&mut one).collect()
}

impl CutSamples {
    fn only(&mut self, kept: &[bool]) {
        let mut each = kept.iter();
        self.measured.retain(|_| *each.next().unwrap_or(&true));
        let mut each = kept.iter();
        self.time.retain(|_| *each.next().unwrap_or(&true));
        let mut each = kept.iter();
        self.present
            .scene
            .time
            .retain(|_| *each.next().unwrap_or(&true));
    }
}

/// Samples of a record: all, or pieces all along it.
fn pieces(count: usize, share: usize) -> Vec<usize> {
    if count <= share {
        return (0..count).collect();
    }
    let length = share / PIECES;
    let piece = |k: usize| {
        let first = k * (count - length) / (PIECES - 1);
        first..first + length
    };
    (0..PIECES).flat_map(piece).collect()
}

/// Noise of each axis: as stated, else from how consecutive samples of what a fit leaves differ; and what
/// the law misses.
pub(super) fn noise(facts: &Facts, account: &Account, colour: Option<&Colour>) -> Vec<f64> {
    let axis = |k: usize| {
        let rough = colour.map_or(1.0, |colour| colour.rough(k));
        let differences = account.cuts.iter().flat_map(|c| {
            let own = c.residual.windows(3);
            own.map(|w| (w[0][k] - 2.0 * w[1][k] + w[2][k]).abs())
        });
        // second differences of white noise have six times its variance; median of |x| is 0.6745 σ
        let own = median(&differences.collect::<Vec<_>>()) / (0.6745 * 6.0_f64.sqrt() * rough);
        let forces = account.cuts.iter().flat_map(|c| &c.data.force);
        let squares: Vec<f64> = forces.map(|f| f[0].hypot(f[1]).hypot(f[2])).collect();
        let size = LAW * rms(&squares);
        facts.sensor_noise_n.unwrap_or(own).max(1e-9).hypot(size)
    };
    (0..3).map(axis).collect()
}
