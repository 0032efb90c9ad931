//! A robot from its table of Denavit and Hartenberg: the geometry of the table, with what else it states.
//!
//! Classic (Denavit and Hartenberg 1955): `T = Rz(θ + q)·Tz(d)·Tx(a)·Rx(α)`; modified (Craig 1986):
//! `T = Rx(α)·Tx(a)·Rz(θ + q)·Tz(d)`, the a and α of a row being those before its joint.

mod table;

pub use table::{Convention, DhTable, Row, read};

use super::body::Body;
use super::model::{Joint, Robot, Tool};
use super::spring::Spring;
use crate::ground::spatial::{M3, Pose, V3, add, rotate, scale, unit};
use crate::ground::units::DEGREE;

/// Sine and cosine of degrees, exact at right angles.
fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => (degrees * DEGREE).sin_cos(),
    }
}

/// A turn about z and a shift along it.
fn along_z(degrees: f64, shift: f64) -> Pose {
    let (s, c) = sin_cos(degrees);
    Pose {
        rotation: [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]],
        point: [0.0, 0.0, shift],
    }
}

/// A turn about x and a shift along it.
fn along_x(degrees: f64, shift: f64) -> Pose {
    let (s, c) = sin_cos(degrees);
    Pose {
        rotation: [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]],
        point: [shift, 0.0, 0.0],
    }
}

impl DhTable {
    /// The robot with every joint at zero as the table counts it, in the frame of the table's base.
    /// Springs and bodies are there as far as the table states them.
    pub fn robot(&self) -> Robot {
        let mut frame = Pose::IDENTITY;
        let mut joints = Vec::new();
        for (i, row) in self.rows.iter().enumerate() {
            let [before, after] = self.parts(row);
            let driven = frame.then(&before);
            joints.push(joint(i, row, &driven));
            frame = driven.then(&after);
        }
        let tcp = add(frame.point, rotate(&frame.rotation, self.tool));
        Robot {
            name: self.name.clone(),
            source: self.source.clone(),
            notes: vec![self.convention.note().into()],
            joints,
            tool: Tool {
                flange: frame.point,
                tcp,
                rotation: frame.rotation,
                spindle_axis: None,
                body: None,
                source: None,
            },
            elastic: Vec::new(),
        }
    }

    /// What stands before and behind the axis of a row, its joint at zero.
    fn parts(&self, row: &Row) -> [Pose; 2] {
        let (x, z) = (
            along_x(row.alpha_deg, row.a_m),
            along_z(row.theta_deg, row.d_m),
        );
        match self.convention {
            Convention::Classic => [Pose::IDENTITY, z.then(&x)],
            Convention::Modified => [x, z],
        }
    }
}

fn joint(index: usize, row: &Row, driven: &Pose) -> Joint {
    let z = column(&driven.rotation, 2);
    let axis = scale(if row.reversed { -1.0 } else { 1.0 }, z);
    Joint {
        name: format!("A{}", index + 1),
        link_name: format!("link{}", index + 1),
        axis: unit(axis).unwrap_or(axis),
        point: add(driven.point, scale(row.bearing_m, z)),
        limits: row.limits_deg.map(|limit| limit * DEGREE),
        max_speed: row.max_speed_deg_s.map(|speed| speed * DEGREE),
        max_acceleration: None,
        drive: spring(row.stiffness, row),
        tilt: spring(row.tilt_stiffness, row),
        link: row.mass_kg.map(|mass| Body {
            mass,
            ..Body::NOTHING
        }),
        source: None,
    }
}

fn spring(stiffness: Option<f64>, row: &Row) -> Option<Spring> {
    Some(Spring {
        stiffness: stiffness?,
        stiffness_rel_std: row.rel_std,
        ..Spring::default()
    })
}

fn column(m: &M3, j: usize) -> V3 {
    std::array::from_fn(|i| m[i][j])
}
