//! What a run writes down on its way.

use super::run::{Cut, Drilled, Outcome};
use super::structure::{Bout, Structure, Tick};
use super::way::Way;
use crate::cutting::cutter::Cutter;
use crate::ground::spatial::{V3, add, norm, scale, sub};
use std::collections::VecDeque;

/// Stations of the course in the cut, m; beside the stock ten times as far.
const STATIONS: f64 = 0.1e-3;
/// Stations at rest, s.
const PAUSE_S: f64 = 0.1;

/// What a run writes down.
#[derive(Default)]
pub(super) struct Book {
    course: Vec<Cut>,
    /// Begin, end and result of the latest ticks of one revolution.
    latest: VecDeque<([f64; 2], Bout)>,
    teeth: usize,
    cutting_s: f64,
    impulse: V3,
    /// The same of its size.
    impulse_size: f64,
    peak: f64,
    steps: usize,
    per_tick: usize,
    drilled: Vec<Drilled>,
    drilled_m3: f64,
    /// Arc length in the middle of the latest tick near the stock, m.
    middle_m: Option<f64>,
}

impl Book {
    pub(super) fn new(teeth: usize) -> Self {
        Self {
            teeth,
            per_tick: 1,
            ..Self::default()
        }
    }

    pub(super) fn note(&mut self, way: &Way, tick: &Tick, bout: &Bout, steps: usize) {
        (self.steps, self.per_tick) = (self.steps + steps, steps);
        if bout.peak > 0.0 {
            self.cutting_s += tick.duration_s();
            self.impulse = add(self.impulse, scale(tick.duration_s(), bout.force));
            self.impulse_size += tick.duration_s() * norm(bout.force);
            self.peak = self.peak.max(bout.peak);
        }
        self.latest
            .push_back(([tick.from.time_s, tick.to.time_s], *bout));
        if self.latest.len() > self.teeth {
            self.latest.pop_front();
        }
        self.station(way);
    }

    /// What the flat end took so far, after a tick.
    pub(super) fn drill(&mut self, tick: &Tick, so_far_m3: f64) {
        self.drill_at(0.5 * (tick.from.s_m + tick.to.s_m), so_far_m3);
    }

    /// The same at the end, where what the last tick took is booked.
    pub(super) fn settle(&mut self, so_far_m3: f64) {
        if let Some(middle) = self.middle_m {
            self.drill_at(middle, so_far_m3);
        }
    }

    fn drill_at(&mut self, middle: f64, so_far_m3: f64) {
        let volume_m3 = so_far_m3 - self.drilled_m3;
        if volume_m3 > 0.0 {
            self.drilled.push(Drilled {
                between_m: [self.middle_m.unwrap_or(middle), middle],
                volume_m3,
            });
        }
        (self.middle_m, self.drilled_m3) = (Some(middle), so_far_m3);
    }

    pub(super) fn pass(&mut self, way: &Way, tick: &Tick, bout: &Bout) {
        self.steps += 1;
        self.middle_m = None;
        self.latest.clear();
        self.latest
            .push_back(([tick.from.time_s, tick.to.time_s], *bout));
        self.station(way);
    }

    /// A station in the middle of the latest revolution, unless the last one is near.
    fn station(&mut self, way: &Way) {
        let first = self.latest.front().map_or(0.0, |l| l.0[0]);
        let last = self.latest.back().map_or(0.0, |l| l.0[1]);
        let middle = 0.5 * (first + last);
        let cutting = self.latest.iter().any(|l| l.1.peak > 0.0);
        let at = way.at(middle);
        if let Some(before) = self.course.last() {
            let apart = if cutting { STATIONS } else { 10.0 * STATIONS };
            let near = norm(sub(at.tip, before.tip)) < apart && middle - before.time_s < PAUSE_S;
            if near && before.cutting == cutting || middle <= before.time_s {
                return;
            }
        }
        let share = 1.0 / self.latest.len() as f64;
        let mean = |value: fn(&Bout) -> V3| {
            let sum = |s: V3, l: &([f64; 2], Bout)| add(s, scale(share, value(&l.1)));
            self.latest.iter().fold([0.0; 3], sum)
        };
        let station = Cut {
            time_s: middle,
            s_m: at.s_m,
            tip: at.tip,
            axis: at.axis,
            feed: way.feed(middle),
            force: mean(|b| b.force),
            deviation: mean(|b| b.deviation),
            cutting,
        };
        self.course.push(station);
    }

    pub(super) fn close(
        self,
        cutter: &Cutter,
        structure: &dyn Structure,
        duration_s: f64,
        pitch_s: f64,
    ) -> Outcome {
        let mean = |v: V3| match self.cutting_s > 0.0 {
            true => scale(1.0 / self.cutting_s, v),
            false => [0.0; 3],
        };
        Outcome {
            mean_n: mean(self.impulse),
            mean_size_n: mean([self.impulse_size, 0.0, 0.0])[0],
            course: self.course,
            removed_m3: cutter.removed(),
            drilled_m3: cutter.drilled(),
            drilled: self.drilled,
            stood_in_m3: cutter.stood_in(),
            duration_s,
            cutting_s: self.cutting_s,
            peak_n: self.peak,
            steps: self.steps,
            step_s: pitch_s / self.per_tick as f64,
            energy: structure.energy(),
        }
    }
}
