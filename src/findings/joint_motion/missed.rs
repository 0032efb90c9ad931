//! What laws that are nearly right miss of the twist: smooth structure over the channels on which they depend.

use super::joint::Joint;
use super::projection::{orthonormal, without};
use super::{encoder_ripple, sensor_offset, time_skew, viscous_friction};
use crate::findings::engine::{Blamed, Nuisance};
use crate::findings::table::{unit_range, waves};
use crate::ground::stats::rms;
use nalgebra::DVector;

/// Standard deviation of what laws miss over every channel, as a share of all that the torque leaves and they may have
/// missed: a twentieth, of waves whose rms is 0.7.
const MISSED: f64 = 0.07;
/// Waves of smooth structure over a channel.
pub(super) const SMOOTH: usize = 6;

/// A channel over which a law may be wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Over {
    Time,
    Angle,
    Torque,
    Speed,
    Acceleration,
}

use Over::{Acceleration, Angle, Speed, Time, Torque};

const ALL: [Over; 5] = [Time, Angle, Torque, Speed, Acceleration];

/// Causes whose law misses nothing.
const EXACT: [&str; 3] = [
    sensor_offset::EFFECT.name,
    encoder_ripple::EFFECT.name,
    time_skew::EFFECT.name,
];

/// Where the law of a cause may miss nature, once it is told: a jump is a jump, a ripple has its period and a delay the
/// speed, so that they miss nothing; oil drags by another power of the speed, and of nothing else.
fn may_miss(effect: &str) -> &'static [Over] {
    match effect {
        exact if EXACT.contains(&exact) => &[],
        oil if oil == viscous_friction::EFFECT.name => &[Speed],
        _ => &ALL,
    }
}

impl Joint {
    /// Over every channel, in proportion to all that may be missed there.
    pub(super) fn missed(&self, about: &[Blamed]) -> Vec<Nuisance> {
        let base = orthonormal(&self.open());
        let each = ALL.iter().flat_map(|over| {
            let left = without(&base, DVector::from_vec(self.inexact(*over, about)));
            let spread = MISSED * rms(left.as_slice());
            let smooth = waves(&unit_range(self.channel(*over)), SMOOTH).into_iter();
            smooth.map(move |column| Nuisance { column, spread })
        });
        each.collect()
    }

    /// The twist less what is told and misses nothing over a channel.
    fn inexact(&self, over: Over, about: &[Blamed]) -> Vec<f64> {
        let exact = about.iter().filter(|b| !may_miss(b.effect).contains(&over));
        let mut twist = self.reading();
        for blamed in exact {
            let each = twist.iter_mut().zip(&blamed.part);
            each.for_each(|(t, part)| *t -= part);
        }
        twist
    }

    fn channel(&self, over: Over) -> &[f64] {
        let data = &self.data;
        match over {
            Time => &data.time,
            Angle => &data.motor,
            Torque => &self.geared,
            Speed => &data.speed,
            Acceleration => &data.acceleration,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::joint::Nominal;
    use super::{Blamed, Joint, SMOOTH};
    use crate::measurement::joint_motion::JointRecord;
    use nalgebra::DMatrix;

    /// A spring under a motor that swings, with dry friction of 30 µrad and more twist after half of the time, rad.
    fn joint(jump: f64) -> Joint {
        let time: Vec<f64> = (0..1500).map(|i| f64::from(i) * 0.008).collect();
        let of = |f: &dyn Fn(f64) -> f64| time.iter().map(|t| f(*t)).collect::<Vec<f64>>();
        let angle = |t: f64| 0.5 * (1.1 * t).sin() + 0.2 * (2.7 * t).sin();
        let speed = |t: f64| 0.55 * (1.1 * t).cos() + 0.54 * (2.7 * t).cos();
        let torque = |t: f64| 2000.0 * (angle(t) + 0.4).cos();
        let link = |t: f64| {
            let step = if t < 6.0 { 0.0 } else { jump };
            angle(t) - torque(t) / 2e6 - 3e-5 * (40.0 * speed(t)).tanh() + step
        };
        let record = JointRecord {
            ratio: Some(200.0),
            ..JointRecord::bare([time.clone(), of(&angle), of(&link), of(&torque)])
        };
        Joint::new(&record, Nominal::default())
    }

    fn spreads(joint: &Joint, effect: Option<&'static str>, part: &[f64]) -> Vec<f64> {
        let blamed = |effect| Blamed {
            effect,
            site: "A2".into(),
            shape: Vec::new(),
            amounts: vec![1.0],
            covariance: DMatrix::zeros(1, 1),
            part: part.to_vec(),
        };
        let about: Vec<Blamed> = effect.map(blamed).into_iter().collect();
        joint.missed(&about).iter().map(|n| n.spread).collect()
    }

    #[test]
    fn beside_a_jump_laws_miss_as_much_as_without_it() {
        let (jumped, sound) = (joint(1e-3), joint(0.0));
        let after = |t: &f64| if *t < 6.0 - 1e-9 { 0.0 } else { 1e-3 };
        let part: Vec<f64> = jumped.data.time.iter().map(after).collect();
        let (told, without) = (
            spreads(&jumped, Some("sensor_offset"), &part),
            spreads(&sound, None, &part),
        );
        let far = |(a, b): (&f64, &f64)| (a / b - 1.0).abs() > 0.01;
        assert!(!told.iter().zip(&without).any(far), "{told:?} {without:?}");
        // a loop is known by no law that would be exact
        let loops = spreads(&jumped, Some("hysteresis"), &part);
        assert_eq!(loops, spreads(&jumped, None, &part));
        assert!(loops[0] > 5.0 * told[0]);
    }

    #[test]
    fn oil_is_wrong_over_the_speed_alone() {
        let joint = joint(0.0);
        let part: Vec<f64> = joint.data.twist.iter().map(|t| 0.9 * t).collect();
        let [oil, none] = [Some("viscous_friction"), None].map(|e| spreads(&joint, e, &part));
        let kept: Vec<bool> = oil.iter().zip(&none).map(|(a, b)| a == b).collect();
        let of_speed = (0..kept.len()).map(|i| i / SMOOTH == 3);
        assert_eq!(kept, of_speed.collect::<Vec<bool>>());
    }
}
