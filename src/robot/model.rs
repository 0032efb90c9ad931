//! The robot as its file gives it: base-frame geometry with every joint at zero.

use super::body::Body;
use super::spring::Spring;
use crate::ground::spatial::{IDENTITY, M3, V3, rotate_back, sub, unit};

/// A serial robot. SI units, angles in rad, geometry in the base frame with every joint at zero.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Robot {
    /// Its name.
    pub name: String,
    /// Who published the numbers.
    pub source: String,
    /// Remarks and choices, one per line.
    pub notes: Vec<String>,
    /// From the foundation to the flange.
    pub joints: Vec<Joint>,
    /// What is mounted on the flange.
    pub tool: Tool,
    /// Further virtual axes.
    pub elastic: Vec<ElasticAxis>,
}

/// A driven rotational joint and the link it moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// `A1` to `A6`, or the joint's name in URDF. The site name of its drive.
    pub name: String,
    /// Name of the link moved, for messages (`link_5` in URDF, `link5` otherwise).
    pub link_name: String,
    /// Unit vector of positive rotation.
    pub axis: V3,
    /// A point on the axis, m; the tilt axes pass through it.
    pub point: V3,
    /// Lowest and highest angle, rad.
    pub limits: [f64; 2],
    /// Highest speed, rad/s.
    pub max_speed: Option<f64>,
    /// Highest acceleration, rad/s²; `None`: not stated.
    pub max_acceleration: Option<f64>,
    /// Elastic drive; `None`: rigid.
    pub drive: Option<Spring>,
    /// Elastic bearing across the axis, equal in both directions; `None`: rigid.
    pub tilt: Option<Spring>,
    /// The body moved; `None`: not known, so no dynamics.
    pub link: Option<Body>,
    /// Who published the link's numbers, if not the robot's source.
    pub source: Option<String>,
}

impl Joint {
    /// Site name of the bearing: `A6-tilt`.
    pub fn tilt_site(&self) -> String {
        format!("{}-tilt", self.name)
    }
}

/// What is mounted on the flange.
#[derive(Debug, Clone, PartialEq)]
pub struct Tool {
    /// Centre of the flange, m.
    pub flange: V3,
    /// Tool centre point, m.
    pub tcp: V3,
    /// Axes of the tool frame as columns, in base axes, every joint at zero.
    pub rotation: M3,
    /// Unit vector from the tip into the spindle, base axes; `None`: from the tool centre point to
    /// the flange.
    pub spindle_axis: Option<V3>,
    /// Its body; `None`: without mass.
    pub body: Option<Body>,
    /// Who published the numbers.
    pub source: Option<String>,
}

impl Tool {
    /// Unit vector from the tip into the spindle in the tool frame; `None`: the file does not say,
    /// and the tool centre point lies in the flange.
    pub fn spindle_in_tool(&self) -> Option<V3> {
        let axis = self
            .spindle_axis
            .or_else(|| unit(sub(self.flange, self.tcp)))?;
        Some(rotate_back(&self.rotation, axis))
    }
}

impl Default for Tool {
    fn default() -> Self {
        Self {
            flange: [0.0; 3],
            tcp: [0.0; 3],
            rotation: IDENTITY,
            spindle_axis: None,
            body: None,
            source: None,
        }
    }
}

/// A virtual elastic axis anywhere in the structure.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticAxis {
    /// Its site name.
    pub name: String,
    /// 0: in the foundation; i: behind the body that joint i moves.
    pub after: usize,
    /// Unit vector, base axes, every joint at zero.
    pub axis: V3,
    /// A point on the axis, m.
    pub point: V3,
    /// The spring about it.
    pub spring: Spring,
    /// A body behind it, before whatever comes next: the far part of a link that bends. `None`: without mass.
    pub body: Option<Body>,
}

impl Robot {
    /// Number of driven joints.
    pub fn dof(&self) -> usize {
        self.joints.len()
    }

    /// The whole body that joint `joint` (from 0) moves, what lies behind its virtual axes included.
    pub fn link_body(&self, joint: usize) -> Option<Body> {
        let far = self.elastic.iter().filter(|axis| axis.after == joint + 1);
        let far = far.filter_map(|axis| axis.body);
        let near = self.joints.get(joint)?.link;
        near.map(|near| far.fold(near, |whole, part| whole.with(&part)))
    }

    /// Whether any drive, bearing or virtual axis is elastic.
    pub fn is_elastic(&self) -> bool {
        let joints = self.joints.iter();
        !self.elastic.is_empty()
            || joints.fold(false, |e, j| e || j.drive.is_some() || j.tilt.is_some())
    }

    /// The same robot with rigid bearings (the thesis's comparison without virtual axes).
    #[must_use]
    pub fn without_tilt(&self) -> Self {
        let mut robot = self.clone();
        robot.joints.iter_mut().for_each(|joint| joint.tilt = None);
        robot
    }

    /// Every spring with its site name: the joints from the base to the flange, then the further axes.
    pub fn springs(&self) -> impl Iterator<Item = (String, &Spring)> {
        let joints = self.joints.iter().flat_map(|joint| {
            let tilt = joint.tilt.iter().map(|spring| (joint.tilt_site(), spring));
            tilt.chain(
                joint
                    .drive
                    .iter()
                    .map(|spring| (joint.name.clone(), spring)),
            )
        });
        joints.chain(
            self.elastic
                .iter()
                .map(|axis| (axis.name.clone(), &axis.spring)),
        )
    }

    /// [`Robot::springs`], to be changed.
    pub fn springs_mut(&mut self) -> impl Iterator<Item = (String, &mut Spring)> {
        let joints = self.joints.iter_mut().flat_map(|joint| {
            let (name, tilt_site) = (joint.name.clone(), joint.tilt_site());
            let tilt = joint
                .tilt
                .iter_mut()
                .map(move |spring| (tilt_site.clone(), spring));
            let drive = joint
                .drive
                .iter_mut()
                .map(move |spring| (name.clone(), spring));
            tilt.chain(drive)
        });
        let elastic = self.elastic.iter_mut();
        joints.chain(elastic.map(|axis| (axis.name.clone(), &mut axis.spring)))
    }
}
