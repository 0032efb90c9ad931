//! The channels of one joint as they are compared: averaged down, with speed and acceleration.

use super::torque_scatter::torque_scatter;
use crate::fit::observation::reduce;
use crate::ground::stats::{mean, quantile, rms};
use crate::measurement::joint_motion::JointRecord;
use crate::signal::outliers;

/// Rows beyond which neighbours are averaged.
const MOST_ROWS: usize = 3200;
/// Width over which speed, acceleration and torque are smoothed, s.
const SMOOTHING_S: f64 = 0.035;
/// Passes of smoothing, twice three of them one after the other, through which an end reaches inwards.
const PASSES_BACK: usize = 6;
/// Times that width over which the torque is smoothed once more.
const WIDER: usize = 3;
/// Half of normal readings lie within so many deviations. Third differences of white noise have twenty times its variance.
const MEDIAN: f64 = 0.6745;
/// Distance from its neighbours, in robust standard deviations, that makes a lone reading wild.
const WILD: f64 = 6.0;

/// One joint, row by row, SI, on the link side of the gear.
#[derive(Clone)]
pub struct Channels {
    /// Time, s.
    pub time: Vec<f64>,
    /// Link angle − motor angle, rad; its mean is taken out.
    pub twist: Vec<f64>,
    /// Motor torque, smoothed, N·m.
    pub torque: Vec<f64>,
    /// What smoothing took from it, N·m.
    pub quick: Vec<f64>,
    /// What smoothing again, as much and more, takes of it and of the acceleration, N·m and rad/s²: by nearly as much both
    /// miss the sharp turns of a motion already, and have too much noise elsewhere.
    pub bends: [Vec<f64>; 3],
    /// What neither motion nor weight nor anything slow makes of it, N·m.
    pub scatter: Vec<f64>,
    /// Its rate, N·m/s.
    pub torque_rate: Vec<f64>,
    /// Speed, smoothed, rad/s.
    pub speed: Vec<f64>,
    /// Acceleration, smoothed, rad/s².
    pub acceleration: Vec<f64>,
    /// Angle of the motor, rad.
    pub motor: Vec<f64>,
    /// Angle of the link, rad.
    pub link: Vec<f64>,
    /// The mean difference of the encoders, rad.
    pub zero: f64,
    /// Wild readings that were replaced by their neighbours.
    pub wild: usize,
    /// Readings that were averaged to a row.
    pub block: usize,
    width: usize,
}

impl Channels {
    /// Of a joint's record.
    pub fn of(joint: &JointRecord) -> Self {
        let block = joint.time.len().div_ceil(MOST_ROWS).max(1);
        let time = reduce(&joint.time, block);
        let motor = reduce(&joint.motor, block);
        let link = reduce(&joint.link, block);
        let mut twist: Vec<f64> = link.iter().zip(&motor).map(|(l, m)| l - m).collect();
        let wild = outliers::isolated(&twist, WILD);
        for i in &wild {
            twist[*i] = outliers::neighbours(&twist, *i);
        }
        let zero = mean(&twist);
        twist.iter_mut().for_each(|y| *y -= zero);
        let width = smoothing_rows(&time);
        let speed = smoothed(&slope(&time, &motor), width);
        // smoothed as often as the torque, which pays for it
        let acceleration = smoothed(&bend(&time, &motor), width);
        let raw = reduce(&joint.torque, block);
        let torque = smoothed(&raw, width);
        let mut channels = Self {
            twist,
            bends: [(&torque, 1), (&torque, WIDER), (&acceleration, 1)].map(|(c, times)| {
                let again = smoothed(c, times * width);
                again.iter().zip(c).map(|(a, c)| a - c).collect()
            }),
            quick: raw.iter().zip(&torque).map(|(r, t)| r - t).collect(),
            scatter: Vec::new(),
            torque_rate: slope(&time, &torque),
            torque,
            width,
            speed,
            acceleration,
            motor,
            link,
            time,
            zero,
            wild: wild.len(),
            block,
        };
        channels.trim();
        channels.scatter = torque_scatter(&channels);
        channels
    }

    /// Leaves out the rows at either end for which smoothing had neighbours on one side only.
    fn trim(&mut self) {
        let margin = (PASSES_BACK * self.width).min(self.rows() / 20);
        let Self {
            time,
            twist,
            torque,
            quick,
            bends,
            torque_rate,
            speed,
            acceleration,
            motor,
            link,
            ..
        } = self;
        let [first, second, third] = bends;
        for column in [
            first,
            second,
            third,
            time,
            twist,
            torque,
            quick,
            torque_rate,
            speed,
            acceleration,
            motor,
            link,
        ] {
            column.truncate(column.len() - margin);
            column.drain(..margin);
        }
    }

    /// A column as smooth as the torque.
    pub fn smoothed(&self, column: &[f64]) -> Vec<f64> {
        smoothed(column, self.width)
    }

    /// Noise of the smoothed torque, line by line of its cosine transform, N·m: of one reading as its third neighbours'
    /// differences scatter, by what smoothing lets pass.
    pub fn torque_noise(&self) -> Vec<f64> {
        let n = self.rows();
        let raw: Vec<f64> = self
            .torque
            .iter()
            .zip(&self.quick)
            .map(|(t, q)| t + q)
            .collect();
        let third = outliers::third_differences(&raw).into_iter();
        let one = quantile(&third.map(f64::abs).collect::<Vec<_>>(), 0.5) / MEDIAN;
        let window = (2 * self.width + 1) as f64;
        let passes = |line: usize| {
            let half = 0.5 * std::f64::consts::PI * line as f64 / n as f64;
            let mean = match line {
                0 => 1.0,
                _ => (window * half).sin() / (window * half.sin()),
            };
            mean.powi(3)
        };
        (0..n).map(|line| one * passes(line).abs()).collect()
    }

    /// How much the torque moves: rms about its mean, N·m.
    pub fn torque_moves(&self) -> f64 {
        let middle = mean(&self.torque);
        let moves: Vec<f64> = self.torque.iter().map(|t| t - middle).collect();
        rms(&moves)
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.time.len()
    }

    /// Largest speed, rad/s.
    pub fn top_speed(&self) -> f64 {
        largest(&self.speed)
    }
}

/// Largest magnitude.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}

/// Smallest and largest value.
pub fn range(values: &[f64]) -> (f64, f64) {
    let wider = |(l, h): (f64, f64), v: &f64| (l.min(*v), h.max(*v));
    values.iter().fold((f64::MAX, f64::MIN), wider)
}

fn smoothing_rows(time: &[f64]) -> usize {
    let n = time.len();
    let step = (time[n - 1] - time[0]) / (n - 1) as f64;
    ((SMOOTHING_S / step) as usize / 2).clamp(1, n / 16)
}

/// Central differences.
fn slope(time: &[f64], values: &[f64]) -> Vec<f64> {
    let n = time.len();
    (0..n)
        .map(|i| {
            let (a, b) = (i.saturating_sub(1), (i + 1).min(n - 1));
            (values[b] - values[a]) / (time[b] - time[a])
        })
        .collect()
}

/// Second derivative by three neighbours; of the ends that of theirs.
fn bend(time: &[f64], values: &[f64]) -> Vec<f64> {
    let n = time.len();
    (0..n)
        .map(|i| {
            let i = i.clamp(1, n - 2);
            let rate = |i: usize| (values[i + 1] - values[i]) / (time[i + 1] - time[i]);
            2.0 * (rate(i) - rate(i - 1)) / (time[i + 1] - time[i - 1])
        })
        .collect()
}

/// Three passes of a mean over `half` neighbours on either side: nearly a Gaussian.
fn smoothed(values: &[f64], half: usize) -> Vec<f64> {
    let n = values.len();
    let mut out = values.to_vec();
    for _ in 0..3 {
        let mut sums = vec![0.0];
        for v in &out {
            sums.push(sums[sums.len() - 1] + v);
        }
        out = (0..n)
            .map(|i| {
                let reach = half.min(i).min(n - 1 - i);
                (sums[i + reach + 1] - sums[i - reach]) / (2 * reach + 1) as f64
            })
            .collect();
    }
    out
}

#[cfg(test)]
mod tests {
    use super::Channels;
    use crate::measurement::joint_motion::JointRecord;

    /// A rotor of 30 kg·m² that swings at 9.6 Hz: its torque pays for its acceleration, and both are smoothed alike.
    #[test]
    fn the_acceleration_is_as_smooth_as_the_torque_that_pays_for_it() {
        let time: Vec<f64> = (0..2000).map(|i| f64::from(i) * 0.004).collect();
        let swing = std::f64::consts::TAU * 9.6;
        let angle = |t: f64| 0.3 * (1.3 * t).sin() + 1e-3 * (swing * t).sin();
        let pull = |t: f64| {
            let slow = 0.3 * 1.69 * (1.3 * t).sin();
            -30.0 * (slow + 1e-3 * swing * swing * (swing * t).sin())
        };
        let motor: Vec<f64> = time.iter().map(|t| angle(*t)).collect();
        let torque = time.iter().map(|t| pull(*t)).collect();
        let record = JointRecord::bare([time, motor.clone(), motor, torque]);
        let data = Channels::of(&record);
        let each = data.torque.iter().zip(&data.acceleration);
        let most = data.torque.iter().fold(0.0_f64, |m, t| m.max(t.abs()));
        let off = each.fold(0.0_f64, |off, (t, a)| off.max((t - 30.0 * a).abs()));
        assert!(off < 0.01 * most, "{off} of {most}");
    }
}
