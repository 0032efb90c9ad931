//! The commanded stroke: there at one speed, a rest, and back.

/// A stroke with trapezoidal speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Where it starts and where it turns, m.
    pub ends: [f64; 2],
    /// Speed, m/s.
    pub speed: f64,
    /// Acceleration, m/s².
    pub acceleration: f64,
    /// Rest at either end, s.
    pub rest: f64,
}

/// Commanded position, m, speed, m/s, and acceleration, m/s², and whether the stroke goes forward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Command {
    /// m.
    pub position: f64,
    /// m/s.
    pub speed: f64,
    /// m/s².
    pub acceleration: f64,
    /// On the way from the first end to the second.
    pub forward: bool,
}

impl Stroke {
    /// Duration of one way, s.
    fn way(&self) -> f64 {
        self.length() / self.speed + self.ramp()
    }

    fn ramp(&self) -> f64 {
        self.speed / self.acceleration
    }

    fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).abs()
    }

    /// Duration of the whole, s: rest, way, rest, way back.
    pub fn duration(&self) -> f64 {
        2.0 * (self.way() + self.rest)
    }

    /// What is commanded at a time, s.
    pub fn at(&self, time: f64) -> Command {
        let half = self.way() + self.rest;
        let forward = time < half;
        let own = if forward { time } else { time - half } - self.rest;
        let [s, v, a] = match own {
            _ if own <= 0.0 => [0.0; 3],
            _ if own >= self.way() => [self.length(), 0.0, 0.0],
            _ => self.along(own),
        };
        let [from, to] = match forward {
            true => self.ends,
            false => [self.ends[1], self.ends[0]],
        };
        let sign = (to - from).signum();
        Command {
            position: from + sign * s,
            speed: sign * v,
            acceleration: sign * a,
            forward,
        }
    }

    /// Whether the speed has been constant for `settled` seconds at a time, s.
    pub fn is_steady(&self, time: f64, settled: f64) -> bool {
        let half = self.way() + self.rest;
        let own = if time < half { time } else { time - half } - self.rest;
        own > self.ramp() + settled && own < self.way() - self.ramp()
    }

    /// Way, speed and acceleration after the start of one way.
    fn along(&self, t: f64) -> [f64; 3] {
        let (ramp, a) = (self.ramp(), self.acceleration);
        let left = self.way() - t;
        if t < ramp {
            [0.5 * a * t * t, a * t, a]
        } else if left < ramp {
            [self.length() - 0.5 * a * left * left, a * left, -a]
        } else {
            [self.speed * (t - 0.5 * ramp), self.speed, 0.0]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stroke_ends_where_it_started_and_its_speed_is_the_slope_of_its_position() {
        let stroke = Stroke {
            ends: [-0.041, 0.326],
            speed: 0.0833,
            acceleration: 2.0,
            rest: 0.1,
        };
        assert_eq!(stroke.at(0.0).position, -0.041);
        assert!((stroke.at(stroke.duration()).position + 0.041).abs() < 1e-12);
        let step = 1e-6;
        for i in 1..400 {
            let t = stroke.duration() * f64::from(i) / 400.0;
            let slope = (stroke.at(t + step).position - stroke.at(t - step).position) / step / 2.0;
            assert!((slope - stroke.at(t).speed).abs() < 1e-5, "{t}");
        }
    }
}
