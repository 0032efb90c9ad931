//! What is left of the deviation from the path that was programmed.

use super::drawn::Drawn;
use crate::ground::spatial::{V3, add, norm};
use crate::path::Path;
use crate::process::run::{Cut, Outcome as Milled};
use crate::process::way::Way;

/// One station: where the tool is less the nearest place of the programmed path, normal to the feed there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Time, s.
    pub time_s: f64,
    /// Arc length of the programmed path, m.
    pub s_m: f64,
    /// Where the tool is, m, workpiece frame.
    pub at: V3,
    /// What is left, m, workpiece frame.
    pub left: V3,
    /// Whether the tool cuts.
    pub cutting: bool,
}

/// What is left of the programmed path at every station that moves.
pub fn remaining(milled: &Milled, path: &Path) -> Vec<Station> {
    let drawn = Drawn::of(path);
    let station = |cut: &Cut| {
        let at = add(cut.tip, cut.deviation);
        Station {
            time_s: cut.time_s,
            s_m: cut.s_m,
            left: drawn.left(cut.s_m, at),
            at,
            cutting: cut.cutting,
        }
    };
    let moving = milled.course.iter().filter(|cut| cut.feed.is_some());
    moving.map(station).collect()
}

/// The stations at which the arc length grows.
pub(super) fn ascending(stations: &[Station]) -> impl Iterator<Item = &Station> {
    let mut last = f64::NEG_INFINITY;
    stations.iter().filter(move |station| {
        let grows = station.s_m > last;
        last = last.max(station.s_m);
        grows
    })
}

/// When a motion is at ascending arc lengths.
pub(super) struct Times<'a> {
    way: &'a Way,
    after: usize,
}

impl<'a> Times<'a> {
    pub(super) fn of(way: &'a Way) -> Self {
        Self { way, after: 1 }
    }

    pub(super) fn at(&mut self, s: f64) -> f64 {
        let rows = self.way.rows();
        while self.after + 1 < rows.len() && rows[self.after].s_m < s {
            self.after += 1;
        }
        let (a, b) = (&rows[self.after - 1], &rows[self.after.min(rows.len() - 1)]);
        let share = ((s - a.s_m) / (b.s_m - a.s_m).max(1e-12)).clamp(0.0, 1.0);
        a.time_s + share * (b.time_s - a.time_s)
    }
}

/// Largest and root mean square of what is left in the cut, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    /// Largest, m.
    pub max_m: f64,
    /// Root mean square, m.
    pub rms_m: f64,
    /// Arc length of the largest, m.
    pub at_m: f64,
}

impl Size {
    /// Over the stations in the cut.
    pub fn of(stations: &[Station]) -> Self {
        let cutting: Vec<&Station> = stations.iter().filter(|s| s.cutting).collect();
        let squares: f64 = cutting.iter().map(|s| norm(s.left).powi(2)).sum();
        let worst = cutting
            .iter()
            .max_by(|a, b| norm(a.left).total_cmp(&norm(b.left)));
        Self {
            max_m: worst.map_or(0.0, |s| norm(s.left)),
            at_m: worst.map_or(0.0, |s| s.s_m),
            rms_m: (squares / cutting.len().max(1) as f64).sqrt(),
        }
    }
}
