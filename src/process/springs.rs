//! Springs only: the tool stands where compliance times force puts it (`--static`).
//!
//! The force answers the deflection: the chip is the way of the deflected tool, u = C F(u), solved with
//! the slope of the force in every step; depth and width of the cut follow the deflected tool too.

use super::loose::Loose;
use super::pose::{Carrier, Held, one_less, solve3};
use super::structure::{Bout, Structure, Tick};
use super::way::Moment;
use crate::cutting::cutter::Cutter;
use crate::ground::problem::Outcome;
use crate::ground::spatial::{M3, V3, add, dot, rotate, scale, sub};

/// The robot as a spring at the tool that changes with the pose.
#[derive(Debug, Clone)]
pub struct Springs {
    carrier: Carrier,
    /// Sag at the start: calibrated away.
    calibrated: V3,
    held: Held,
    compliance: M3,
    sag: V3,
    /// Gaps and contacts of the joints.
    loose: Loose,
    /// Where they let the tool go, m, and where they did at the start.
    slack: V3,
    slack_at_first: V3,
    pose: Vec<f64>,
    deviation: V3,
    /// The last step of it, m.
    gone: V3,
}

/// Joint motion beyond which the compliance is computed anew, rad.
const SAME_POSE: f64 = 1e-4;

impl Springs {
    /// At rest at the start of a motion.
    ///
    /// # Errors
    /// Nothing in the robot is elastic.
    pub fn new(mut carrier: Carrier, start: &Moment) -> Outcome<Self> {
        let held = carrier.held(&start.joints)?;
        let loose = Loose::of(&carrier.chain, &held);
        let slack = loose.slack(&held, [0.0; 3]);
        Ok(Self {
            loose,
            slack,
            slack_at_first: slack,
            calibrated: held.sag(),
            compliance: held.compliance(),
            sag: [0.0; 3],
            pose: start.joints.clone(),
            deviation: [0.0; 3],
            gone: [0.0; 3],
            carrier,
            held,
        })
    }

    /// Where the tool stands under a force (N, workpiece frame) at a moment of the motion, less where it
    /// was told to, m; gaps stay where they are.
    ///
    /// # Errors
    /// Nothing in the robot is elastic.
    pub fn bent(&mut self, moment: &Moment, force: V3) -> Outcome<V3> {
        self.go(moment)?;
        Ok(add(rotate(&self.compliance, force), self.sag))
    }

    fn go(&mut self, moment: &Moment) -> Outcome<()> {
        if !moment.is_at(&self.pose, SAME_POSE) {
            let held = self.carrier.held(&moment.joints)?;
            self.compliance = held.compliance();
            self.sag = sub(held.sag(), self.calibrated);
            self.pose.clone_from(&moment.joints);
            self.held = held;
        }
        Ok(())
    }

    /// Takes the slack under a force, N.
    fn rest(&mut self, slack: V3, force: V3) {
        self.loose.rest(&self.held, force);
        self.slack = slack;
    }
}

/// A step from where the tool stood to where it would stand: half of it where it turns back by a good part of the last one. Width and depth of the cut
/// follow the tool a tooth late, and the way back and forth would grow where the robot is soft; a tool at rest stands where it would.
fn calmed(step: V3, last: V3) -> V3 {
    match dot(step, last) < -TURNS * dot(last, last) {
        true => scale(0.5, step),
        false => step,
    }
}

/// Share of the last step from which on a step back is half one. A choice; a step that comes back by a quarter dies out by itself.
const TURNS: f64 = 0.25;

impl Structure for Springs {
    fn deviation(&self) -> V3 {
        self.deviation
    }

    fn cut(&mut self, cutter: &Cutter, tick: &Tick) -> Outcome<Bout> {
        self.go(&tick.to)?;
        let before = self.deviation;
        let (load, peak) = cutter.revolution(sub(tick.to.tip, tick.from.tip));
        // u = C (F + G (u − before)) + sag
        let still = sub(load.force, rotate(&load.slope, before));
        let matrix = one_less(&self.compliance, &load.slope);
        let from = sub(self.sag, self.slack_at_first);
        let solved = |slack: V3| -> Outcome<(V3, V3)> {
            let right = add(rotate(&self.compliance, still), add(from, slack));
            let place = solve3(&matrix, right)?;
            let answered = rotate(&load.slope, sub(place, before));
            Ok((place, add(load.force, answered)))
        };
        let (place, force, slack) = self.loose.settle(&self.held, self.slack, solved)?;
        let step = sub(place, before);
        self.gone = calmed(step, self.gone);
        self.deviation = add(before, self.gone);
        // what the cut answers where the tool comes to stand
        let force = add(force, rotate(&load.slope, sub(self.gone, step)));
        self.rest(slack, force);
        Ok(Bout {
            force,
            peak,
            deviation: self.deviation,
        })
    }

    fn travel(&mut self, tick: &Tick) -> Outcome<Bout> {
        self.go(&tick.to)?;
        let slack = self.loose.slack(&self.held, [0.0; 3]);
        self.rest(slack, [0.0; 3]);
        self.deviation = add(self.sag, sub(slack, self.slack_at_first));
        Ok(Bout {
            deviation: self.deviation,
            ..Bout::default()
        })
    }

    fn longest_travel_s(&self) -> f64 {
        0.02
    }

    fn steps_per_tick(&self, _: &Cutter) -> usize {
        1
    }
}

#[cfg(test)]
mod tests {
    use super::calmed;

    #[test]
    fn a_step_that_turns_back_is_halved() {
        let last = [2e-6, 0.0, 1e-6];
        let back = [-1.9e-6, 0.0, -1e-6];
        assert_eq!(calmed(back, last), [-0.95e-6, 0.0, -0.5e-6]);
        assert_eq!(calmed([1e-6, 0.0, 0.0], last), [1e-6, 0.0, 0.0]);
        let little = [-0.2e-6, 0.0, 0.0];
        assert_eq!(calmed(little, last), little);
        // one that grows from step to step dies out
        let (mut at, mut gone) = ([1e-6, 0.0, 0.0], [0.0; 3]);
        for _ in 0..40 {
            let step = [-2.4 * at[0], 0.0, 0.0];
            gone = calmed(step, gone);
            at[0] += gone[0];
        }
        assert!(at[0].abs() < 1e-9, "{}", at[0]);
    }
}
