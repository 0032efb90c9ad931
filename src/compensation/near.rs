//! What is left near the cut: a correction is carried on a little before and behind it, and fades.

use super::remaining::{Station, ascending};
use crate::ground::spatial::{V3, scale};

/// How far before and behind the cut the correction is carried on fully, and fades, m: springs ...
const CARRIED: f64 = 2e-3;
const FADES: f64 = 12e-3;
/// ... and how long before and behind it, s, where masses swing: a few periods of a soft robot.
const AHEAD_S: [f64; 2] = [0.6, 0.4];
const BEHIND_S: [f64; 2] = [0.05, 0.2];

/// What is left at one time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Left {
    /// Time, s.
    pub(super) time_s: f64,
    /// Arc length, m.
    pub(super) s_m: f64,
    /// From the nearest place of the drawn path, m, workpiece frame.
    pub(super) left: V3,
}

/// What is left at ascending arc lengths, fading away from the cut.
fn windowed(stations: &[Station], weight: &dyn Fn(&Station) -> f64) -> Vec<Left> {
    let left = |station: &Station| Left {
        time_s: station.time_s,
        s_m: station.s_m,
        left: scale(weight(station), station.left),
    };
    ascending(stations).map(left).collect()
}

/// Springs: everything within millimetres of the cut.
pub(super) fn near(stations: &[Station]) -> Vec<Left> {
    let cuts: Vec<f64> = of_cuts(stations, |s| s.s_m);
    windowed(stations, &|station| {
        faded(distance(&cuts, station.s_m), CARRIED, FADES)
    })
}

/// Masses: a swing that the way to the cut has set going is taken away before it gets there.
pub(super) fn before_and_in(stations: &[Station]) -> Vec<Left> {
    let cuts: Vec<f64> = of_cuts(stations, |s| s.time_s);
    windowed(stations, &|station| {
        let next = cuts.partition_point(|t| *t < station.time_s);
        let ahead = cuts.get(next).map_or(f64::INFINITY, |t| t - station.time_s);
        let last = next.checked_sub(1).map(|i| station.time_s - cuts[i]);
        let ahead = faded(ahead, AHEAD_S[0], AHEAD_S[1]);
        let behind = faded(last.unwrap_or(f64::INFINITY), BEHIND_S[0], BEHIND_S[1]);
        ahead.max(behind)
    })
}

fn of_cuts(stations: &[Station], value: fn(&Station) -> f64) -> Vec<f64> {
    let cutting = stations.iter().filter(|s| s.cutting);
    cutting.map(value).collect()
}

/// Distance to the nearest of ascending places.
fn distance(places: &[f64], s: f64) -> f64 {
    let after = places.partition_point(|p| *p < s);
    let near = [after.checked_sub(1), Some(after)].into_iter().flatten();
    let near = near.filter_map(|i| places.get(i));
    near.map(|p| (p - s).abs()).fold(f64::INFINITY, f64::min)
}

/// 1 up to a distance, then falling to 0 over a length.
fn faded(distance: f64, full: f64, falls: f64) -> f64 {
    let x = ((distance - full) / falls).clamp(0.0, 1.0);
    1.0 - x * x * (3.0 - 2.0 * x)
}
