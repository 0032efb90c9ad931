//! The whole way, tick by tick: one tooth passing in the cut, longer steps beside the stock.

use super::book::Book;
use super::structure::{Energy, Structure, Tick};
use super::way::{Moment, Way, normal_part};
use crate::cutting::cutter::Cutter;
use crate::ground::problem;
use crate::ground::spatial::{V3, add, norm, scale, sub};
use crate::ground::stats::mean;
use std::f64::consts::TAU;

/// A path that cuts nothing, and where to look then.
pub const NOTHING_CUT: [&str; 2] = [
    "the path cuts nothing",
    "check origin_m, abc_deg and the stock of [workpiece], the path's heights, and whether its flutes reach the stock",
];

/// How the way is run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Speed of the spindle, rad/s.
    pub spindle_rad_s: f64,
}

/// One station of the course: means over a revolution about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cut {
    /// Time, s.
    pub time_s: f64,
    /// Arc length of the programmed path, m.
    pub s_m: f64,
    /// Where the tip was told to be, workpiece frame, m.
    pub tip: V3,
    /// Spindle axis there.
    pub axis: V3,
    /// Direction of the feed; `None` at rest.
    pub feed: Option<V3>,
    /// Force on the tool, N, workpiece frame.
    pub force: V3,
    /// Where the tool is less where it was told to be, m, workpiece frame.
    pub deviation: V3,
    /// Whether it cuts.
    pub cutting: bool,
}

impl Cut {
    /// The deviation normal to the feed, m.
    pub fn normal(&self) -> V3 {
        normal_part(self.deviation, self.feed)
    }
}

/// What the flat end took in the passing of a tooth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drilled {
    /// Arc lengths of the path between which it did, m: what is taken is booked when the tool is looked at next.
    pub between_m: [f64; 2],
    /// How much, m³.
    pub volume_m3: f64,
}

/// What came of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Stations in order of time.
    pub course: Vec<Cut>,
    /// Volume taken, m³.
    pub removed_m3: f64,
    /// The part of it that the flat end took where the tool plunged, m³: no law says with what force.
    pub drilled_m3: f64,
    /// Where along the path it did.
    pub drilled: Vec<Drilled>,
    /// Stock where the tool began, m³: gone, but not cut.
    pub stood_in_m3: f64,
    /// Length in time, s.
    pub duration_s: f64,
    /// Time in the cut, s.
    pub cutting_s: f64,
    /// Largest force, N.
    pub peak_n: f64,
    /// Mean force while in the cut, N, workpiece frame.
    pub mean_n: V3,
    /// Mean size of the force of a tooth passing there, N: what acts one way and then the other does not cancel.
    pub mean_size_n: f64,
    /// Steps of time.
    pub steps: usize,
    /// Step in the cut, s.
    pub step_s: f64,
    /// Energy of the structure, where it has one.
    pub energy: Option<Energy>,
}

impl Outcome {
    /// The station of the largest deviation, of those in the cut where there are any, by a measure.
    pub fn worst(&self, measure: impl Fn(&Cut) -> f64) -> Option<usize> {
        let cutting = self.course.iter().any(|c| c.cutting);
        let counted = |c: &Cut| c.cutting == cutting;
        let stations = self.course.iter().enumerate().filter(|(_, c)| counted(c));
        stations
            .map(|(i, c)| (i, measure(c)))
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map(|w| w.0)
    }

    /// The deviation at a time (s), linear between stations, m.
    pub fn deviation_at(&self, time_s: f64) -> V3 {
        self.between(time_s, |cut| cut.deviation)
    }

    /// The force at a time (s), linear between stations, N.
    pub fn force_at(&self, time_s: f64) -> V3 {
        self.between(time_s, |cut| cut.force)
    }

    fn between(&self, time_s: f64, value: fn(&Cut) -> V3) -> V3 {
        let after = self.course.partition_point(|c| c.time_s < time_s);
        let (Some(a), Some(b)) = (
            self.course.get(after.saturating_sub(1)),
            self.course.get(after),
        ) else {
            return self.course.last().map_or([0.0; 3], value);
        };
        match b.time_s > a.time_s {
            true => {
                let share = (time_s - a.time_s) / (b.time_s - a.time_s);
                add(value(a), scale(share, sub(value(b), value(a))))
            }
            false => value(b),
        }
    }

    /// Root mean square over the stations in the cut, by a measure.
    pub fn rms(&self, measure: impl Fn(&Cut) -> f64) -> f64 {
        let cutting = self.course.iter().any(|c| c.cutting);
        let squares: Vec<f64> = self
            .course
            .iter()
            .filter(|c| c.cutting == cutting)
            .map(|c| measure(c).powi(2))
            .collect();
        mean(&squares).sqrt()
    }
}

/// A tool this near to the box around the stock may cut, m.
const NEAR: f64 = 1e-3;

/// Runs a way. `progress` hears the share that is done.
///
/// # Errors
/// Material above the flutes; a structure that cannot answer, with its station.
pub fn mill(
    way: &Way,
    cutter: &mut Cutter,
    structure: &mut dyn Structure,
    settings: &Settings,
    mut progress: impl FnMut(f64),
) -> problem::Outcome<Outcome> {
    let [begin, end] = way.span();
    let pitch_s = TAU / (settings.spindle_rad_s * cutter.tool().teeth as f64);
    let mut book = Book::new(cutter.tool().teeth);
    let mut from = way.at(begin);
    let mut beside = true;
    while from.time_s < end - 1e-9 {
        let long = way.at(from.time_s + structure.longest_travel_s());
        let margin = NEAR + norm(sub(long.tip, from.tip)) + norm(structure.deviation());
        if cutter.near(from.tip, from.axis, margin) {
            if beside {
                cutter.jump(add(from.tip, structure.deviation()), from.axis);
            }
            beside = false;
            let to = way.at(from.time_s + pitch_s);
            let tick = Tick { from, to };
            let steps = structure.steps_per_tick(cutter);
            let place = add(tick.to.tip, structure.deviation());
            let bout = cutter
                .follow([tick.from.tip, tick.to.tip], place, tick.to.axis)
                .and_then(|()| structure.cut(cutter, &tick));
            let bout = bout.map_err(|p| stationed(p, &tick.to))?;
            book.note(way, &tick, &bout, steps);
            book.drill(&tick, cutter.drilled());
            from = tick.to;
        } else {
            beside = true;
            let tick = Tick { from, to: long };
            let bout = structure
                .travel(&tick)
                .map_err(|p| stationed(p, &tick.to))?;
            book.pass(way, &tick, &bout);
            from = tick.to;
        }
        progress((from.time_s - begin) / (end - begin));
    }
    cutter.settle();
    book.settle(cutter.drilled());
    Ok(book.close(cutter, structure, end - begin, pitch_s))
}

fn stationed(mut problem: problem::Problem, at: &Moment) -> problem::Problem {
    problem.what = format!(
        "at {:.1} mm of the path ({:.3} s): {}",
        1e3 * at.s_m,
        at.time_s,
        problem.what
    );
    problem
}
