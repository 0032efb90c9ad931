//! What the slide does while the card leads it along a stroke.

use super::{Drive, Loop, Screw, Stroke};

/// One sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instant {
    /// s.
    pub time: f64,
    /// Commanded position, m.
    pub command: f64,
    /// On the way from the first end to the second.
    pub forward: bool,
    /// Speed of the slide, m/s.
    pub speed: f64,
    /// Position of the slide less the commanded one, m.
    pub error: f64,
    /// Whether the commanded speed has been constant for [`SETTLED`].
    pub steady: bool,
}

/// After the start of a way the loop is given this long, s, before its speed counts.
pub const SETTLED: f64 = 0.1;

/// Leads the drive along the stroke with a `correction` (m, at a commanded position, m, and direction) added
/// to the following error; `seen` is told every sample.
pub fn course(
    drive: &Drive,
    control: &Loop,
    screw: &Screw,
    stroke: &Stroke,
    correction: &dyn Fn(f64, bool) -> f64,
    mut seen: impl FnMut(Instant),
) {
    let dt = control.sample;
    let [kp, kd, ki] = control.gains;
    let start = stroke.at(0.0);
    // at rest, the slide pushed forward before
    let mut motor = start.position + correction(start.position, true);
    let mut speed = 0.0;
    let mut slide = motor + (screw.error)(motor) - 0.5 * screw.play;
    let (mut integral, mut last) = (0.0, f64::NAN);
    let samples = (stroke.duration() / dt).ceil() as usize;
    for i in 0..samples {
        let time = i as f64 * dt;
        let told = stroke.at(time);
        let counted = (motor / drive.count).round() * drive.count;
        let wanted = told.position + correction(told.position, told.forward);
        let following = wanted - counted;
        let slope = if last.is_nan() {
            0.0
        } else {
            (following - last) / dt
        };
        last = following;
        let fed = drive.mass * told.acceleration + drive.viscous * told.speed;
        let asked = kp * following + kd * slope + ki * (integral + following * dt) + fed;
        let force = asked.clamp(-drive.force_limit, drive.force_limit);
        if force == asked {
            integral += following * dt; // no wind-up while the motor gives all it has
        }
        speed = moved(drive, speed, force, dt);
        motor += speed * dt;
        let nut = motor + (screw.error)(motor);
        let next = slide.clamp(nut - 0.5 * screw.play, nut + 0.5 * screw.play);
        // motor and slide have arrived where the next sample begins
        let due = stroke.at(time + dt).position;
        seen(Instant {
            time: time + dt,
            command: due,
            forward: told.forward,
            speed: (next - slide) / dt,
            error: next - due,
            steady: stroke.is_steady(time, SETTLED),
        });
        slide = next;
    }
}

/// Speed after a sample: dry friction takes what it can, down to standstill.
fn moved(drive: &Drive, speed: f64, force: f64, dt: f64) -> f64 {
    let free = (speed + force * dt / drive.mass) / (1.0 + drive.viscous * dt / drive.mass);
    let grip = drive.dry * dt / drive.mass;
    free.signum() * (free.abs() - grip).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::super::BANDWIDTH;
    use super::*;

    fn run(
        error: fn(f64) -> f64,
        play: f64,
        correction: &dyn Fn(f64, bool) -> f64,
    ) -> Vec<Instant> {
        let drive = Drive::of_pitch(5.08e-3);
        let control = Loop::with_bandwidth(&drive, BANDWIDTH);
        let stroke = Stroke {
            ends: [0.0, 0.1],
            speed: 5.0 / 60.0,
            acceleration: 2.0,
            rest: 0.1,
        };
        let screw = Screw {
            error: &error,
            play,
        };
        let mut all = Vec::new();
        course(&drive, &control, &screw, &stroke, correction, |i| {
            all.push(i)
        });
        all
    }

    #[test]
    fn a_perfect_screw_follows_at_constant_speed_to_a_count_or_two() {
        for instant in run(|_| 0.0, 0.0, &|_, _| 0.0) {
            assert!(instant.error.abs() < 12e-6, "{instant:?}");
            if instant.steady {
                assert!(
                    (instant.speed.abs() - 5.0 / 60.0).abs() < 1.5e-3,
                    "{instant:?}"
                );
                assert!(instant.error.abs() < 2e-6, "{instant:?}");
            }
        }
    }

    #[test]
    fn lost_motion_shows_as_the_difference_of_the_ways() {
        let all = run(|_| 0.0, 20e-6, &|_, _| 0.0);
        let middle = |forward: bool| {
            let own: Vec<f64> = all
                .iter()
                .filter(|i| i.steady && i.forward == forward)
                .map(|i| i.error)
                .collect();
            own.iter().sum::<f64>() / own.len() as f64
        };
        assert!((middle(false) - middle(true) - 20e-6).abs() < 1e-6);
    }

    #[test]
    fn a_step_of_the_correction_makes_the_speed_peak_that_three_equal_poles_make() {
        // y'/Δ = w (3 + 3 w/s + ...)/(1 + s/w)³: the peak is where the step arrives, 3 w Δ
        let step = 4e-6;
        let all = run(|_| 0.0, 0.0, &|x, _| if x > 0.05 { step } else { 0.0 });
        let peak = all
            .iter()
            .filter(|i| i.steady && i.forward)
            .map(|i| i.speed - 5.0 / 60.0)
            .fold(0.0, f64::max);
        let wanted = 3.0 * std::f64::consts::TAU * BANDWIDTH * step;
        assert!((peak / wanted - 1.0).abs() < 0.25, "{peak} {wanted}");
    }
}
