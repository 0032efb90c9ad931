//! Motion with limited jerk along a path: the double-S profile in closed form (Biagiotti & Melchiorri
//! 2009, section 3.4).

/// Limits along the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Acceleration, m/s².
    pub acceleration: f64,
    /// Jerk, m/s³.
    pub jerk: f64,
}

/// A time of constant jerk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phase {
    /// When it begins, s.
    pub begin: f64,
    /// How long it lasts, s.
    pub duration: f64,
    /// Arc length at its begin, m.
    pub s: f64,
    /// Speed at its begin, m/s.
    pub v: f64,
    /// Acceleration at its begin, m/s².
    pub a: f64,
    /// Jerk, m/s³.
    pub j: f64,
}

impl Phase {
    /// Arc length (m), speed (m/s) and acceleration (m/s²) at the time `t` (s).
    pub fn at(&self, t: f64) -> [f64; 3] {
        let t = t - self.begin;
        [
            self.s + t * (self.v + t * (0.5 * self.a + t * self.j / 6.0)),
            self.v + t * (self.a + 0.5 * t * self.j),
            self.a + t * self.j,
        ]
    }
}

impl Limits {
    /// So much of both.
    #[must_use]
    pub fn scaled(&self, share: f64) -> Self {
        Self {
            acceleration: share * self.acceleration,
            jerk: share * self.jerk,
        }
    }

    /// Those of the same motion at this share of its speed: stretched in time.
    #[must_use]
    pub fn slowed(&self, share: f64) -> Self {
        Self {
            acceleration: share.powi(2) * self.acceleration,
            jerk: share.powi(3) * self.jerk,
        }
    }

    /// Time from one speed to another (m/s), acceleration zero at both, s.
    pub fn change_time(&self, from: f64, to: f64) -> f64 {
        let (change, ramp) = ((to - from).abs(), self.acceleration / self.jerk);
        match change >= self.acceleration * ramp {
            true => change / self.acceleration + ramp,
            false => 2.0 * (change / self.jerk).sqrt(),
        }
    }

    /// Arc length from one speed to another, m: the profile is symmetric, so the mean speed counts.
    pub fn change_length(&self, from: f64, to: f64) -> f64 {
        0.5 * (from + to) * self.change_time(from, to)
    }

    /// The highest speed up to `limit` that is reached between `from` and `to` (m/s) on `length` (m).
    pub fn peak(&self, from: f64, to: f64, length: f64, limit: f64) -> f64 {
        let needed = |v: f64| self.change_length(from, v) + self.change_length(v, to);
        if needed(limit) <= length {
            return limit;
        }
        if from == 0.0 && to == 0.0 {
            return self.peak_from_rest(length);
        }
        highest(from.max(to), limit, |v| needed(v) <= length)
    }

    /// From rest to rest: v√(v/j) or v(v/a + a/j) is the length.
    fn peak_from_rest(&self, length: f64) -> f64 {
        let (a, j) = (self.acceleration, self.jerk);
        let short = (0.5 * length).powf(2.0 / 3.0) * j.cbrt();
        if short * j <= a * a {
            return short;
        }
        let half = 0.5 * a * a / j;
        (half * half + a * length).sqrt() - half
    }

    /// The highest speed up to `limit` that is reached from `from` (m/s) on `length` (m).
    pub fn reachable(&self, from: f64, length: f64, limit: f64) -> f64 {
        if limit <= from || self.change_length(from, limit) <= length {
            return limit;
        }
        highest(from, limit, |v| self.change_length(from, v) <= length)
    }

    /// Appends the phases from one speed to another.
    pub fn change(&self, phases: &mut Vec<Phase>, start: [f64; 2], from: f64, to: f64) {
        let change = (to - from).abs();
        let sign = (to - from).signum();
        let ramp = self.acceleration / self.jerk;
        let (outer, middle) = match change >= self.acceleration * ramp {
            true => (ramp, change / self.acceleration - ramp),
            false => ((change / self.jerk).sqrt(), 0.0),
        };
        let parts = [
            (outer, sign * self.jerk),
            (middle, 0.0),
            (outer, -sign * self.jerk),
        ];
        let [mut t, mut s] = start;
        let (mut v, mut a) = (from, 0.0);
        for (duration, j) in parts.into_iter().filter(|part| part.0 > 0.0) {
            let phase = Phase {
                begin: t,
                duration,
                s,
                v,
                a,
                j,
            };
            phases.push(phase);
            [s, v, a] = phase.at(t + duration);
            t += duration;
        }
    }
}

/// The largest value up to `high` that is `fine`, to the last digits; `low` is.
fn highest(low: f64, high: f64, fine: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (low, high);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        match fine(middle) {
            true => low = middle,
            false => high = middle,
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::profile::{Step, profile};

    fn duration(length: f64, v: f64, acceleration: f64, jerk: f64) -> f64 {
        let limits = Limits { acceleration, jerk };
        let steps = [Step {
            begin: 0.0,
            end: length,
            speed: v,
        }];
        let phases = profile(&steps, &limits, 0.0);
        let last = phases.last().unwrap();
        let [s, v, a] = last.at(last.begin + last.duration);
        assert!((s - length).abs() < 1e-14 && v.abs() < 1e-14 && a.abs() < 1e-13);
        last.begin + last.duration
    }

    #[test]
    fn durations_are_those_of_the_references() {
        assert!((duration(0.4, 0.1, 1.0, 20.0) - 4.15).abs() < 1e-13);
        assert!((duration(0.05, 0.1, 2.0, 10.0) - 0.7).abs() < 1e-13);
        let cube = 4.0 * (0.003_f64 / 10.0).cbrt();
        assert!((duration(0.003, 0.05, 0.5, 5.0) - cube).abs() < 1e-13);
        assert!((cube - 0.267_773_180_03).abs() < 1e-11);
        // Reaches the acceleration but not the speed: v = (√(a⁴/j² + 4 a L) − a²/j)/2.
        let v = 0.5 * ((0.05_f64.powi(2) + 0.4).sqrt() - 0.05);
        assert!((duration(0.1, 9.0, 1.0, 20.0) - 2.0 * (v + 0.05)).abs() < 1e-13);
    }
}
