//! A joint before anything is blamed: its channels, what its torque shows of friction, periods and jumps that
//! its twist suggests, and its noise.

use super::channels::Channels;
use super::friction::{Friction, sign};
use super::gear_torque::gear_torque;
use super::jumps::jumps;
use super::missed::SMOOTH;
use super::noise::Coloured;
use super::presumed::{Presumed, presumed};
use super::projection::{self, partial};
use super::ripple::{Wave, waves};
use crate::findings::engine::Suspect;
use crate::findings::table::{unit_range, waves as smooth};
use crate::measurement::joint_motion::JointRecord;
use nalgebra::DVector;

/// What is known of the present simulation of a joint.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Nominal {
    /// Stiffness, N·m/rad.
    pub stiffness: Option<f64>,
    /// Its relative standard deviation.
    pub rel_std: f64,
}

/// A joint as its diagnosis sees it: one row per reading of the difference of its encoders.
#[derive(Clone)]
pub struct Joint {
    /// Its site: `A2`.
    pub site: String,
    /// Gear ratio.
    pub ratio: Option<f64>,
    /// Delay that the file declares, s.
    pub declared: Option<f64>,
    /// Standard deviation to which the zeros of the encoders agree, rad.
    pub zero_std: Option<f64>,
    /// The present simulation.
    pub nominal: Nominal,
    /// Its spring where the motion shows none.
    pub presumed: Option<Presumed>,
    /// Its channels.
    pub data: Channels,
    /// Torque in the gear, N·m.
    pub geared: Vec<f64>,
    /// Friction that the torque shows.
    pub friction: Friction,
    /// Rows at which a zero may have jumped.
    pub jumps: Vec<usize>,
    /// Periods in either angle.
    pub waves: Vec<Wave>,
    /// The noise.
    pub noise: Coloured,
}

/// Shapes of every suspect beside which noise is sought: fewer leave loops in it, more would take all that is slow.
const EACH: usize = 8;
/// Waves of smooth structure over time.
const SLOW: usize = 10;

impl Joint {
    /// From a record.
    pub fn new(record: &JointRecord, stated: Nominal) -> Self {
        // a spring on the side of the link says nothing of torque on the side of the motor
        let nominal = Nominal {
            stiffness: stated.stiffness.filter(|_| record.ratio.is_some()),
            ..stated
        };
        let data = Channels::of(record);
        let rough = rough(&data, &data.twist);
        let presumed = presumed(&data, nominal);
        let mut joint = Self {
            site: record.site(),
            ratio: record.ratio,
            declared: record.delay,
            zero_std: record.zero_std,
            nominal,
            presumed,
            geared: gear_torque(&data, &data.twist, presumed.map(|p| p.compliance)),
            friction: Friction::of(&data),
            jumps: jumps(&rough),
            waves: waves(&data, &rough, record.ratio),
            noise: Coloured::unit(data.rows()),
            data,
        };
        joint.noise = Coloured::of(
            &joint.data.twist,
            &joint.beside_noise(),
            &joint.noise_of_torque(),
        );
        joint
    }

    /// What the torque's own noise makes of the twist, line by line of its cosine transform, rad.
    fn noise_of_torque(&self) -> Vec<f64> {
        let compliance = partial(&self.beside_torque(), &self.data.torque, &self.data.twist).slope;
        let noise = self.data.torque_noise().into_iter();
        noise.map(|n| compliance.abs() * n).collect()
    }

    /// The same once these parts of the twist are told: what they hid of the gear's torque, of instants and of periods.
    pub fn beside(&self, parts: &[Vec<f64>]) -> Self {
        let mut joint = self.clone();
        let part = |i: usize| parts.iter().map(|p| p[i]).sum::<f64>();
        let twist: Vec<f64> = self.column(|i| self.data.twist[i] - part(i));
        let rough = rough(&self.data, &twist);
        joint.geared = gear_torque(&self.data, &twist, self.presumed.map(|p| p.compliance));
        let new = jumps(&rough).into_iter();
        joint
            .jumps
            .extend(new.filter(|row| !self.jumps.contains(row)));
        let near = |w: &Wave| self.waves.iter().any(|own| w.is_near(own, &self.data));
        let new = waves(&self.data, &rough, self.ratio).into_iter();
        joint.waves.extend(new.filter(|w| !near(w)));
        joint
    }

    /// A few shapes of everybody, beside which noise is sought.
    fn beside_noise(&self) -> Vec<Vec<f64>> {
        let mut span = self.base();
        span.push(self.data.torque_rate.clone());
        let suspects = self.suspects();
        let every = |s: &Suspect| s.members.len().div_ceil(EACH).max(1);
        let members = suspects
            .iter()
            .flat_map(|s| s.members.iter().step_by(every(s)));
        span.extend(members.flat_map(|m| m.columns.iter().cloned()));
        span
    }

    /// Columns that every model has: zero, torque, the inertia of the rotor, the quick part of the torque, with its
    /// noise, its scatter, and what smoothing takes of sharp turns.
    pub fn base(&self) -> Vec<Vec<f64>> {
        base(&self.data)
    }

    /// These without the torque.
    pub fn beside_torque(&self) -> Vec<Vec<f64>> {
        let mut columns = self.base();
        columns.remove(TORQUE);
        columns
    }

    /// A column over all rows.
    pub fn column(&self, of: impl Fn(usize) -> f64) -> Vec<f64> {
        (0..self.data.rows()).map(of).collect()
    }

    /// Smooth structure of any kind over time and angle, less what the columns of every model and these parts make of
    /// it. Over torque and speed it would take the place of causes: there patterns compete with them.
    pub fn span(&self, parts: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let slow = smooth(&unit_range(&self.data.time), SLOW);
        let span = [slow, smooth(&unit_range(&self.data.motor), SMOOTH)].concat();
        let taken = projection::orthonormal(&[&self.base(), parts].concat());
        let free = |c: &Vec<f64>| projection::without(&taken, DVector::from_column_slice(c));
        span.iter().map(|c| free(c).as_slice().to_vec()).collect()
    }
}

/// Place of the torque among the columns that every model has.
pub const TORQUE: usize = 1;

pub(super) fn base(data: &Channels) -> Vec<Vec<f64>> {
    let mut columns = vec![
        vec![1.0; data.rows()],
        data.torque.clone(),
        data.acceleration.clone(),
        data.quick.clone(),
        data.scatter.clone(),
    ];
    columns.extend(data.bends.clone());
    columns
}

/// What zero, torque, acceleration, speed, friction, a gap and slow structure over the angle leave of the twist.
fn rough(data: &Channels, twist: &[f64]) -> Vec<f64> {
    let mut columns = base(data);
    columns.extend([
        data.speed.clone(),
        sign(data),
        super::backlash::step(&data.torque, 0.04),
    ]);
    columns.extend(smooth(&unit_range(&data.motor), 2));
    projection::left(&columns, twist)
}
