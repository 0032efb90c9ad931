//! What is left of the deviation from the path that was programmed.

use super::correction::Correction;
use crate::ground::random::Random;
use crate::ground::spatial::{V3, add, norm};
use crate::process::run::{Cut, Outcome as Milled};
use crate::process::way::{Way, normal_part};

/// One station: where the tool is less where the programmed path is, normal to the feed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Time, s.
    pub time_s: f64,
    /// Arc length of the programmed path, m.
    pub s_m: f64,
    /// Where the tool was told to be, m, workpiece frame.
    pub tip: V3,
    /// Normal to the feed, m, workpiece frame.
    pub left: V3,
    /// Whether the tool cuts.
    pub cutting: bool,
}

/// What is left at every station that moves, the correction being that of the run; `drawn` is the
/// motion without correction, whose feed counts at the same arc length.
pub fn remaining(milled: &Milled, correction: &Correction, drawn: &Way) -> Vec<Station> {
    let mut times = Times::of(drawn);
    let station = |cut: &Cut| {
        let feed = drawn.feed(times.at(cut.s_m))?;
        let left = add(cut.deviation, correction.at(cut.s_m));
        Some(Station {
            time_s: cut.time_s,
            s_m: cut.s_m,
            tip: cut.tip,
            left: normal_part(left, Some(feed)),
            cutting: cut.cutting,
        })
    };
    milled.course.iter().filter_map(station).collect()
}

/// When a motion is at ascending arc lengths.
struct Times<'a> {
    way: &'a Way,
    after: usize,
}

impl<'a> Times<'a> {
    fn of(way: &'a Way) -> Self {
        Self { way, after: 1 }
    }

    fn at(&mut self, s: f64) -> f64 {
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

/// Draws of the uncertain numbers.
const DRAWS: usize = 4000;

/// How large the largest deviation may be, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Likely {
    /// 95 % interval.
    pub ci95: [f64; 2],
    /// In 999 of 1000 cases at most this: what a promise needs.
    pub at_most: f64,
}

/// 95 % interval of the largest deviation, m: `changes` holds, per uncertain number, what one standard
/// deviation of it changes at each station. The largest of many stations is no linear function of them:
/// it is drawn.
pub fn interval(left: &[V3], changes: &[Vec<V3>]) -> Option<Likely> {
    if changes.is_empty() || left.is_empty() {
        return None;
    }
    let mut random = Random::new(1);
    let mut largest: Vec<f64> = (0..DRAWS)
        .map(|_| {
            let z: Vec<f64> = changes.iter().map(|_| random.normal()).collect();
            let at = |i: usize| {
                let moved = changes.iter().zip(&z);
                norm(moved.fold(left[i], |sum, (c, z)| {
                    [0, 1, 2].map(|k| sum[k] + z * c[i][k])
                }))
            };
            (0..left.len()).map(at).fold(0.0, f64::max)
        })
        .collect();
    largest.sort_by(f64::total_cmp);
    let at = |share: f64| largest[((DRAWS - 1) as f64 * share).round() as usize];
    // the largest of many places that are uncertain is rarely as small as where nothing is off
    let as_told = left.iter().map(|l| norm(*l)).fold(0.0, f64::max);
    Some(Likely {
        ci95: [at(0.025).min(as_told), at(0.975)],
        at_most: at(0.999),
    })
}
