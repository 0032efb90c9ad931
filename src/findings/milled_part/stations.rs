//! Where a part was probed: places along the simulated way, the two directions across the feed that a
//! surface shows, and how well a simulation knows them.

use super::counted::Counted;
use super::plane::Plane;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{V3, add, cross, norm, sub, unit};
use crate::measurement::milled_part::{At, PartTest, Reading};
use crate::process::run::Outcome as Milled;
use crate::process::setup::Setup;
use crate::process::way;

/// A probed place.
#[derive(Debug, Clone, PartialEq)]
pub struct Station {
    /// When the tool was there, s.
    pub time_s: f64,
    /// Share of the whole time by then, 0 to 1.
    pub progress: f64,
    /// Share of the programmed path by then, 0 to 1.
    pub share: f64,
    /// Arc length of the programmed path, m.
    pub s_m: f64,
    /// Tip of the tool, workpiece frame, m.
    pub tip: V3,
    /// Spindle axis, workpiece frame.
    pub axis: V3,
    /// Direction of the feed.
    pub feed: V3,
    /// Speed of the feed, m/s.
    pub speed: f64,
    /// Joint angles, rad, and their speeds, rad/s.
    pub joints: Vec<f64>,
    /// See `joints`.
    pub speeds: Vec<f64>,
    /// Simulated mean force on the tool, N, workpiece frame.
    pub force: V3,
    /// What the simulation leaves there, m, workpiece frame: the deviation of the tool when it passes the place.
    pub deviation: V3,
    /// The same at the time when it is told to be there, m.
    pub told: V3,
    /// By how much that differs over `STEEP`, m.
    pub steep: f64,
    /// Measured deviation, m; NaN where a component was not probed.
    pub measured: V3,
}

impl Station {
    /// A place on a straight way along x where nothing is simulated to be left.
    #[cfg(test)]
    pub(super) fn plain(s_m: f64) -> Self {
        Self {
            time_s: s_m,
            progress: s_m,
            share: s_m,
            s_m,
            tip: [s_m, 0.0, 0.0],
            axis: [0.0, 0.0, 1.0],
            feed: [1.0, 0.0, 0.0],
            speed: 1.0,
            joints: Vec::new(),
            speeds: Vec::new(),
            force: [0.0; 3],
            deviation: [0.0; 3],
            told: [0.0; 3],
            steep: 0.0,
            measured: [0.0; 3],
        }
    }

    /// The plane in which it was probed.
    pub(super) fn plane(&self) -> Plane {
        Plane {
            place: self.tip,
            speed: self.speed,
            feed: self.feed,
        }
    }
}

/// One number that was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Its station.
    pub station: usize,
    /// The direction that it measures: to the left of the feed, or along the spindle.
    pub across: V3,
    /// Whether that is to the left of the feed.
    pub left: bool,
    /// Measured deviation along it, m.
    pub measured: f64,
}

/// How well a place is known, m.
pub(super) const NEAR: f64 = 0.25e-3;
/// Distance over which a simulated deviation is called steep, m: as far as a tool that gives way is ahead or behind.
const STEEP: f64 = 0.15e-3;
/// A component that a direction hardly has may be missing.
pub(super) const HARDLY: f64 = 0.02;
/// Share of a simulated deviation that the laws of the cut do not know.
pub(super) const LAW: f64 = 0.015;

/// The stations of a test, those where nothing is cut left out.
///
/// # Errors
/// A place that is not on the path, with its line; nothing that is cut.
pub(super) fn placed(
    (test, counted): (&PartTest, &Counted),
    setup: &Setup,
    milled: &Milled,
) -> Outcome<Vec<Station>> {
    let mut stations = Vec::new();
    for reading in &test.readings {
        let time_s =
            when(reading, counted, (setup, milled)).map_err(|p| p.at_line(reading.line))?;
        stations.extend(station(reading, time_s, setup, milled));
    }
    match stations.is_empty() {
        true => Err(Problem::new(
            "no probed place lies where the job cuts",
            "check `job`, and that s_mm is the arc length of the programmed path",
        )
        .at_line(test.readings[0].line)),
        false => Ok(stations),
    }
}

fn when(reading: &Reading, counted: &Counted, (setup, milled): (&Setup, &Milled)) -> Outcome<f64> {
    let rows = setup.way.rows();
    match reading.at {
        At::Along(told) => {
            let s = counted.drawn(told, &setup.way);
            let last = rows.last().map_or(0.0, |r| r.s_m);
            if s < -NEAR || s > last + NEAR {
                let what = format!(
                    "s = {:.3} mm is not on the path of {:.3} mm",
                    1e3 * told,
                    1e3 * last
                );
                return Err(
                    Problem::new(what, "give the arc length of the programmed path")
                        .in_column("s_mm"),
                );
            }
            let after = rows.partition_point(|r| r.s_m < s).clamp(1, rows.len() - 1);
            let [a, b] = [&rows[after - 1], &rows[after]];
            let share = if b.s_m > a.s_m {
                ((s - a.s_m) / (b.s_m - a.s_m)).clamp(0.0, 1.0)
            } else {
                1.0
            };
            Ok(a.time_s + share * (b.time_s - a.time_s))
        }
        At::Place(place) => {
            let reach = 2.0 * setup.tool.radius_m + NEAR;
            let cuts = |time_s: f64| norm(milled.force_at(time_s)) > 0.0;
            match passes(rows, place, cuts).filter(|(far, _)| *far <= reach) {
                Some((_, time_s)) => Ok(time_s),
                None => Err(Problem::new(
                    format!("the place is more than {:.1} mm from the path", 1e3 * reach),
                    "give nominal coordinates in the frame of the workpiece",
                )
                .in_column("x_mm")),
            }
        }
    }
}

/// Passes that are as near to a place as this leave it together, m: the last of them that cuts made the surface.
const TWICE: f64 = 1e-6;

/// How far a way stays from a place (m), and when it is there (s): between its rows it is straight.
fn passes(rows: &[way::Row], place: V3, cuts: impl Fn(f64) -> bool) -> Option<(f64, f64)> {
    let nearest = |pair: &[way::Row]| {
        let (share, far) = way::nearest([&pair[0], &pair[1]], place);
        let [a, b] = [pair[0].time_s, pair[1].time_s];
        (far, a + share * (b - a))
    };
    let all: Vec<(f64, f64)> = rows.windows(2).map(nearest).collect();
    let least = all.iter().map(|a| a.0).fold(f64::INFINITY, f64::min);
    let mut near = all.iter().filter(|a| a.0 <= least + TWICE);
    let last = near.clone().rev().find(|a| cuts(a.1));
    last.or_else(|| near.next_back()).copied()
}

fn station(reading: &Reading, time_s: f64, setup: &Setup, milled: &Milled) -> Option<Station> {
    let at = setup.way.at(time_s);
    let force = milled.force_at(time_s);
    let feed = setup.way.feed(time_s)?;
    let [begin, end] = setup.way.span();
    let speed = norm(sub(
        setup.way.at(time_s + 1e-3).tip,
        setup.way.at(time_s - 1e-3).tip,
    )) / 2e-3;
    let near = STEEP / speed.max(1e-4);
    let [before, after] = [-near, near].map(|d| milled.deviation_at(time_s + d));
    let plane = Plane {
        place: at.tip,
        speed,
        feed,
    };
    let tool = |time: f64| add(setup.way.at(time).tip, milled.deviation_at(time));
    (norm(force) > 0.0).then(|| Station {
        time_s,
        progress: (time_s - begin) / (end - begin),
        share: at.s_m / setup.way.rows().last().map_or(1.0, |row| row.s_m),
        s_m: at.s_m,
        tip: at.tip,
        axis: at.axis,
        feed,
        speed,
        joints: at.joints,
        speeds: at.speeds,
        force,
        deviation: plane.passed_by(tool, time_s),
        told: milled.deviation_at(time_s),
        steep: 0.5 * norm(sub(after, before)),
        measured: reading.deviation,
    })
}

/// What was measured across the feed: to its left, and along the spindle.
pub(super) fn rows(stations: &[Station]) -> Vec<Row> {
    let of = |(i, s): (usize, &Station)| {
        let left = unit(cross(s.axis, s.feed)).unwrap_or([0.0; 3]);
        let directions = [(left, true), (s.axis, false)];
        directions.map(|(across, left)| Row {
            station: i,
            across,
            left,
            measured: (0..3)
                .filter(|k| across[*k].abs() > HARDLY)
                .map(|k| across[k] * s.measured[k])
                .sum(),
        })
    };
    let all = stations.iter().enumerate().flat_map(of);
    all.filter(|row| row.measured.is_finite() && norm(row.across) > 0.5)
        .collect()
}

/// Standard deviation of every row, m; `ahead`: the share of what is steep that is not known.
pub(super) fn spreads(stations: &[Station], rows: &[Row], probe: f64, ahead: f64) -> Vec<f64> {
    let of = |row: &Row| {
        let s = &stations[row.station];
        let law = LAW * norm(s.deviation).max(row.measured.abs());
        (probe * probe + law * law + (ahead * s.steep).powi(2)).sqrt()
    };
    rows.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::passes;
    use crate::process::way::Row;

    fn way(places: &[[f64; 2]]) -> Vec<Row> {
        let row = |(i, [x, y]): (usize, &[f64; 2])| Row {
            time_s: i as f64,
            s_m: 0.0,
            tip: [*x, *y, 0.0],
            axis: [0.0, 0.0, 1.0],
            joints: Vec::new(),
        };
        places.iter().enumerate().map(row).collect()
    }

    /// A place between two rows belongs to the way that leads through it, though a row of another is nearer.
    #[test]
    fn a_place_is_looked_for_between_rows() {
        let rows = way(&[[0.0, 0.0], [1e-3, 0.0], [1e-3, 1e-4], [0.5e-3, 1e-4]]);
        let (far, time) = passes(&rows, [0.5e-3, 1e-5, 0.0], |_| true).unwrap();
        assert!((far - 1e-5).abs() < 1e-12 && (time - 0.5).abs() < 1e-9);
    }

    /// Of two passes over a place the last that cuts made the surface.
    #[test]
    fn of_two_passes_the_last_that_cuts_counts() {
        let rows = way(&[
            [0.0, 0.0],
            [1e-3, 0.0],
            [1e-3, 1e-3],
            [1e-3, 0.0],
            [0.0, 0.0],
        ]);
        let when = |cuts: fn(f64) -> bool| passes(&rows, [0.4e-3, 0.0, 0.0], cuts).unwrap().1;
        assert!((when(|_| true) - 3.6).abs() < 1e-9);
        assert!((when(|time| time < 2.0) - 0.4).abs() < 1e-9);
        assert!((when(|_| false) - 3.6).abs() < 1e-9);
    }
}
