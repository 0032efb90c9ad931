//! Where the tool and the joints are told to be, and when.

use crate::ground::spatial::{V3, add, dot, norm, scale, sub, unit};

/// One sample of the programmed motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Time, s.
    pub time_s: f64,
    /// Arc length of the programmed path, m.
    pub s_m: f64,
    /// Tip of the tool, workpiece frame, m.
    pub tip: V3,
    /// Spindle axis from the tip into the spindle, workpiece frame.
    pub axis: V3,
    /// Joint angles, rad; none for a tool without a robot.
    pub joints: Vec<f64>,
}

/// A programmed motion: at least one row, time ascending.
#[derive(Debug, Clone, PartialEq)]
pub struct Way {
    rows: Vec<Row>,
}

/// The programmed motion at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// Time, s.
    pub time_s: f64,
    /// Arc length of the programmed path, m.
    pub s_m: f64,
    /// Tip of the tool, workpiece frame, m.
    pub tip: V3,
    /// Spindle axis, workpiece frame.
    pub axis: V3,
    /// Joint angles, rad.
    pub joints: Vec<f64>,
    /// Their speeds, rad/s.
    pub speeds: Vec<f64>,
    /// Their accelerations, rad/s².
    pub accelerations: Vec<f64>,
}

impl Moment {
    /// Whether every joint is within so much of a pose, rad.
    pub(super) fn is_at(&self, pose: &[f64], within: f64) -> bool {
        let moved = pose.iter().zip(&self.joints).map(|(a, b)| (a - b).abs());
        moved.fold(0.0, f64::max) <= within
    }
}

impl Way {
    /// A motion through these rows; `None` without any, or where time does not ascend.
    pub fn new(rows: Vec<Row>) -> Option<Self> {
        let ascending = rows.windows(2).all(|pair| pair[0].time_s < pair[1].time_s);
        (!rows.is_empty() && ascending).then_some(Self { rows })
    }

    /// The samples.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// First and last time, s.
    pub fn span(&self) -> [f64; 2] {
        [self.rows[0].time_s, self.rows[self.rows.len() - 1].time_s]
    }

    /// The motion at a time, between rows by cubics whose slopes are those of the neighbours: places
    /// and speeds without jumps. Before the first and after the last row it rests.
    pub fn at(&self, time_s: f64) -> Moment {
        let [first, last] = self.span();
        let time = time_s.clamp(first, last);
        let after = self.rows.partition_point(|r| r.time_s <= time);
        let i = after.clamp(1, self.rows.len().max(2) - 1) - 1;
        if self.rows.len() == 1 {
            return rest(&self.rows[0], time_s);
        }
        let cubic = Cubic::new(&self.rows, i, time);
        let joints = self.rows[i].joints.len();
        let joint = |k: usize| cubic.at(|row| row.joints[k]);
        let moving: Vec<[f64; 3]> = (0..joints).map(joint).collect();
        let tip = [0, 1, 2].map(|k| cubic.at(|row| row.tip[k])[0]);
        let axis = [0, 1, 2].map(|k| cubic.line(|row| row.axis[k]));
        let resting = time != time_s;
        let still = |x: f64| if resting { 0.0 } else { x };
        Moment {
            time_s,
            s_m: cubic.line(|row| row.s_m),
            tip,
            axis: unit(axis).unwrap_or(self.rows[i].axis),
            joints: moving.iter().map(|m| m[0]).collect(),
            speeds: moving.iter().map(|m| still(m[1])).collect(),
            accelerations: moving.iter().map(|m| still(m[2])).collect(),
        }
    }

    /// Direction of the feed at a time: where the tip goes, or came from at the end; `None` at rest.
    pub fn feed(&self, time_s: f64) -> Option<V3> {
        const LOOK_S: f64 = 1e-3;
        let [before, after] = [-LOOK_S, LOOK_S].map(|d| self.at(time_s + d).tip);
        let way = sub(after, before);
        (norm(way) > 1e-9).then(|| unit(way)).flatten()
    }
}

/// Where a straight piece between two rows is nearest to a place: how far along it (0 to 1), and how far that is from the place, m.
pub fn nearest([a, b]: [&Row; 2], place: V3) -> (f64, f64) {
    let along = sub(b.tip, a.tip);
    let share = dot(sub(place, a.tip), along) / dot(along, along).max(f64::MIN_POSITIVE);
    let share = share.clamp(0.0, 1.0);
    (share, norm(sub(place, add(a.tip, scale(share, along)))))
}

/// What of `v` is normal to `direction`, or all of it without one.
pub fn normal_part(v: V3, direction: Option<V3>) -> V3 {
    match direction {
        Some(d) => add(v, scale(-dot(v, d), d)),
        None => v,
    }
}

fn rest(row: &Row, time_s: f64) -> Moment {
    Moment {
        time_s,
        s_m: row.s_m,
        tip: row.tip,
        axis: row.axis,
        joints: row.joints.clone(),
        speeds: vec![0.0; row.joints.len()],
        accelerations: vec![0.0; row.joints.len()],
    }
}

/// A cubic between two rows, with their neighbours.
struct Cubic<'a> {
    rows: [&'a Row; 4],
    length: f64,
    share: f64,
}

impl<'a> Cubic<'a> {
    fn new(rows: &'a [Row], i: usize, time: f64) -> Self {
        let at = |k: usize| &rows[k.min(rows.len() - 1)];
        let length = at(i + 1).time_s - at(i).time_s;
        Self {
            rows: [at(i.saturating_sub(1)), at(i), at(i + 1), at(i + 2)],
            length,
            share: (time - at(i).time_s) / length,
        }
    }

    fn line(&self, value: impl Fn(&Row) -> f64) -> f64 {
        let [a, b] = [self.rows[1], self.rows[2]].map(value);
        a + self.share * (b - a)
    }

    /// Value, speed and acceleration.
    fn at(&self, value: impl Fn(&Row) -> f64) -> [f64; 3] {
        let [before, a, b, after] = self.rows.map(|row| (value(row), row.time_s));
        let slope = |p: (f64, f64), q: (f64, f64)| match q.1 > p.1 {
            true => (q.0 - p.0) / (q.1 - p.1),
            false => 0.0,
        };
        let (u, h) = (self.share, self.length);
        let (m, n) = (h * slope(before, b), h * slope(a, after));
        let rise = b.0 - a.0;
        let (c2, c3) = (3.0 * rise - 2.0 * m - n, m + n - 2.0 * rise);
        [
            a.0 + u * (m + u * (c2 + u * c3)),
            (m + u * (2.0 * c2 + 3.0 * u * c3)) / h,
            (2.0 * c2 + 6.0 * u * c3) / (h * h),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_rows_places_and_speeds_have_no_jumps() {
        let row = |i: usize| {
            let t = 0.012 * i as f64;
            Row {
                time_s: t,
                s_m: t,
                tip: [t * t, 0.0, 0.0],
                axis: [0.0, 0.0, 1.0],
                joints: vec![(3.0 * t).sin()],
            }
        };
        let way = Way::new((0..100).map(row).collect()).unwrap();
        let at = way.at(0.5005);
        assert!((at.tip[0] - 0.5005 * 0.5005).abs() < 1e-12);
        assert!((at.joints[0] - 1.5015_f64.sin()).abs() < 1e-7);
        assert!((at.speeds[0] - 3.0 * 1.5015_f64.cos()).abs() < 3e-4);
        let (a, b) = (way.at(0.6 - 1e-9), way.at(0.6 + 1e-9));
        assert!((a.speeds[0] - b.speeds[0]).abs() < 1e-6);
        assert_eq!(way.at(9.0).speeds[0], 0.0);
        assert!(Way::new(Vec::new()).is_none());
    }
}
