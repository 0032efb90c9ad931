//! Where a part was probed: places along the simulated way, the two directions across the feed that a
//! surface shows, and how well a simulation knows them.

use super::counted::Counted;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{V3, add, cross, dot, norm, sub, unit};
use crate::measurement::milled_part::{At, PartTest, Reading};
use crate::process::run::Outcome as Milled;
use crate::process::setup::Setup;

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
    pub(super) fn at_rest(s_m: f64) -> Self {
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
        let time_s = when(reading, counted, setup).map_err(|p| p.at_line(reading.line))?;
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

fn when(reading: &Reading, counted: &Counted, setup: &Setup) -> Outcome<f64> {
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
            let far = |i: &usize| norm(sub(rows[*i].tip, place));
            let nearest = (0..rows.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
            let reach = 2.0 * setup.tool.radius_m + NEAR;
            match nearest.filter(|i| far(i) <= reach) {
                Some(i) => Ok(rows[i].time_s),
                None => Err(Problem::new(
                    format!("the place is more than {:.1} mm from the path", 1e3 * reach),
                    "give nominal coordinates in the frame of the workpiece",
                )
                .in_column("x_mm")),
            }
        }
    }
}

/// Speed below which a tool stands, m/s: the places that it passes later are not told from its deviation.
const STANDS: f64 = 1e-3;
/// Steps to the time at which the tool passes a place, and how near to the place it is passed, m.
const STEPS: usize = 4;
const PASSED: f64 = 1e-6;
/// Way within which that time is sought, m, and parts of it that are looked at on either side: a tool that passes the place from
/// farther off has been there before or comes again.
const NEAREST: f64 = 2e-3;
const PARTS: i32 = 40;

/// The plane across the feed at a place.
pub(super) struct Plane {
    place: V3,
    /// How fast the tool goes through it, m/s.
    speed: f64,
    feed: V3,
}

impl Plane {
    /// From its place to where a tool passes it, m: ahead or behind of about that time as it gives way along the feed. `tool`: where
    /// that is at any time.
    pub fn passed_by(&self, tool: impl Fn(f64) -> V3, about_s: f64) -> V3 {
        let off = |time: f64| sub(tool(time), self.place);
        if self.speed <= STANDS {
            return off(about_s);
        }
        let behind = |time: f64| -dot(off(time), self.feed);
        let passes = (0..STEPS).fold(about_s, |time, _| time + behind(time) / self.speed);
        let far_s = NEAREST / self.speed;
        if behind(passes).abs() < PASSED && (passes - about_s).abs() < far_s {
            return off(passes);
        }
        off(passed(behind, about_s, far_s / f64::from(PARTS)).unwrap_or(about_s))
    }
}

/// When what is behind of a place no longer is: the nearest such time about one, looked for in steps.
fn passed(behind: impl Fn(f64) -> f64, about_s: f64, step_s: f64) -> Option<f64> {
    let time = |k: i32| about_s + step_s * f64::from(k);
    let far: Vec<f64> = (-PARTS..=PARTS).map(|k| behind(time(k))).collect();
    let turns = far.windows(2).zip(-PARTS..);
    let turns = turns.filter(|(w, _)| w[0] >= 0.0 && w[1] < 0.0);
    let crossed = turns.map(|(w, k)| time(k) + step_s * w[0] / (w[0] - w[1]));
    crossed.min_by(|a, b| (a - about_s).abs().total_cmp(&(b - about_s).abs()))
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
    use super::Plane;
    use crate::ground::spatial::V3;

    /// A tool that swings along its feed by 0.8 mm at 10 Hz passes a place when it is there, not when it is told to be there.
    #[test]
    fn a_place_is_passed_when_the_tool_is_there() {
        let tool = |time: f64| -> V3 {
            let swing = 0.8e-3 * (62.8 * time).sin();
            [0.03 * time + swing, 1e-4 * time, 0.0]
        };
        for k in 0..20 {
            let time = 0.01 * f64::from(k) + 0.1;
            let plane = Plane {
                place: [0.03 * time, 0.0, 0.0],
                speed: 0.03,
                feed: [1.0, 0.0, 0.0],
            };
            let left = plane.passed_by(tool, time);
            assert!(left[0].abs() < 3e-6, "{left:?}");
            assert!((left[1] / 1e-4 - time).abs() < 0.03, "{left:?}");
        }
    }
}
