//! The facts of a load-cycle file.

use super::port::Axis;
use crate::ground::problem::Outcome;
use crate::measurement::front::Front;

/// The facts of a load-cycle file, SI.
#[derive(Debug, Clone, Default)]
pub struct Facts {
    /// Robot name or file.
    pub robot: Option<String>,
    /// Joint number 1..6.
    pub joint: Option<usize>,
    /// Rotation or tilt.
    pub axis: Option<Axis>,
    /// Lever of the force, m.
    pub load_lever: Option<f64>,
    /// Lever of the first displacement sensor, m.
    pub sensor_lever: Option<f64>,
    /// Lever of the second, m.
    pub sensor2_lever: Option<f64>,
    /// Duration of the unloaded start, s.
    pub rest: Option<f64>,
    /// Stiffness the simulation uses at present, N·m/rad (N/m for a linear spring).
    pub nominal_stiffness: Option<f64>,
    /// Its relative standard deviation.
    pub nominal_rel_std: Option<f64>,
    /// Relative standard deviation of each lever.
    pub lever_rel_std: Option<f64>,
    /// Data-sheet noise of the displacement sensor, m.
    pub sensor_noise: Option<f64>,
    /// Declared delay of the deflection channel behind the load channel, s.
    pub sensor_delay: f64,
    /// True when the file says that it was simulated.
    pub synthetic: bool,
}

/// The facts of this kind, as they are written.
pub(in crate::measurement) const FACTS: &[&str] = &[
    "joint",
    "axis",
    "load_lever_m",
    "sensor_lever_m",
    "sensor2_lever_m",
    "rest_s",
    "nominal_stiffness_Nm_rad",
    "nominal_stiffness_N_m",
    "nominal_stiffness_rel_std",
    "lever_rel_std",
    "sensor_noise_mm",
    "sensor_delay_s",
];

/// Relative standard deviation of a lever that nobody stated.
pub const LEVER_REL_STD: f64 = 0.003;

/// Relative standard deviation that the levers of a file leave in its stiffness: in
/// k = F·a / (x/b) the lever a of the load and the lever b of the sensor stand once each, measured
/// one by one. Without levers (moment and angle in the file) there is none.
pub fn lever_spread(front: &Front) -> Outcome<f64> {
    let each = front
        .not_negative("lever_rel_std")?
        .unwrap_or(LEVER_REL_STD);
    let stated = ["load_lever_m", "sensor_lever_m"].map(|key| front.facts.contains_key(key));
    let levers = stated.into_iter().filter(|given| *given).count();
    Ok(each * (levers as f64).sqrt())
}

impl Facts {
    /// The same for a file at hand.
    pub fn lever_spread(&self) -> f64 {
        let each = self.lever_rel_std.unwrap_or(LEVER_REL_STD);
        let levers = [self.load_lever, self.sensor_lever];
        each * (levers.iter().flatten().count() as f64).sqrt()
    }

    pub(super) fn of(front: &Front) -> Outcome<Self> {
        Ok(Self {
            robot: front.text("robot")?.map(str::to_string),
            joint: joint_of(front)?,
            axis: axis_of(front)?,
            load_lever: front.positive("load_lever_m")?,
            sensor_lever: front.positive("sensor_lever_m")?,
            sensor2_lever: front.positive("sensor2_lever_m")?,
            rest: front.not_negative("rest_s")?,
            nominal_stiffness: match front.positive("nominal_stiffness_Nm_rad")? {
                None => front.positive("nominal_stiffness_N_m")?,
                some => some,
            },
            nominal_rel_std: front.not_negative("nominal_stiffness_rel_std")?,
            lever_rel_std: front.not_negative("lever_rel_std")?,
            sensor_noise: front.not_negative("sensor_noise_mm")?.map(|mm| mm * 1e-3),
            sensor_delay: front.number("sensor_delay_s")?.unwrap_or(0.0),
            synthetic: front.synthetic(),
        })
    }
}

fn joint_of(front: &Front) -> Outcome<Option<usize>> {
    match front.number("joint")? {
        None => Ok(None),
        Some(j) if j.fract() == 0.0 && (1.0..=6.0).contains(&j) => Ok(Some(j as usize)),
        Some(j) => Err(front.problem("joint", format!("is {j}"), "give the joint as 1 to 6")),
    }
}

fn axis_of(front: &Front) -> Outcome<Option<Axis>> {
    match front.text("axis")? {
        None => Ok(None),
        Some("rotation") => Ok(Some(Axis::Rotation)),
        Some("tilt") => Ok(Some(Axis::Tilt)),
        Some(other) => Err(front.problem(
            "axis",
            format!("is `{other}`"),
            "write `rotation` (about the drive axis) or `tilt` (across it)",
        )),
    }
}
