//! `[spindle]`: another spindle on the robot than the tool it was identified with.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::vector::{M3, V3, norm, unit};
use crate::measurement::keys::Keys;

/// A spindle, base frame, every joint at zero, as `[tool]` of a robot file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spindle {
    /// Centre of the flange, m; `None`: that of the robot file.
    pub flange: Option<V3>,
    /// Tool centre point, m; `None`: that of the robot file.
    pub tcp: Option<V3>,
    /// Unit vector from the tip into the spindle; `None`: from the tool centre point to the flange.
    pub axis: Option<V3>,
    /// Tool axes as columns; `None`: those of the robot file.
    pub rotation: Option<M3>,
    /// Its body; `None`: that of the robot file.
    pub body: Option<SpindleBody>,
}

/// Body of a spindle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpindleBody {
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass, m.
    pub com: V3,
    /// `ixx iyy izz ixy ixz iyz` about the centre of mass, kg·m², base-frame axes.
    pub inertia: [f64; 6],
}

const KEYS: &[&str] = &["flange_m", "tcp_m", "axis", "rotation", "body"];
const BODY_KEYS: &[&str] = &["mass_kg", "com_m", "inertia_kgm2"];

/// How far from 1 the length of an axis, or from orthonormal a matrix may be.
const TOLERANCE: f64 = 1e-3;

impl Spindle {
    pub(super) fn of(job: &Keys<'_>) -> Outcome<Option<Self>> {
        let Some(keys) = job.table("spindle", KEYS)? else {
            return Ok(None);
        };
        let body = keys.table("body", BODY_KEYS)?;
        Ok(Some(Self {
            flange: keys.vector("flange_m")?,
            tcp: keys.vector("tcp_m")?,
            axis: axis(&keys)?,
            rotation: rotation(&keys)?,
            body: body.map(|keys| body_of(&keys)).transpose()?,
        }))
    }
}

fn axis(keys: &Keys<'_>) -> Outcome<Option<V3>> {
    let Some(axis) = keys.vector("axis")? else {
        return Ok(None);
    };
    let long = (norm(axis) - 1.0).abs() <= TOLERANCE;
    let axis = unit(axis).filter(|_| long);
    let remedy = "write a unit vector from the tip into the spindle, for example [0.0, 0.0, 1.0]";
    let refused = || keys.problem("axis", "is no unit vector", remedy);
    axis.map(Some).ok_or_else(refused)
}

fn rotation(keys: &Keys<'_>) -> Outcome<Option<M3>> {
    let Some(rows) = keys.matrix("rotation")? else {
        return Ok(None);
    };
    match crate::ground::spatial::determinant(&rows) > 0.0 && is_orthonormal(&rows) {
        true => Ok(Some(rows)),
        false => Err(refused_rotation(keys)),
    }
}

fn is_orthonormal(rows: &M3) -> bool {
    let gram = crate::ground::vector::product(rows, &crate::ground::vector::transpose(rows));
    let wanted = |i: usize, j: usize| f64::from(u8::from(i == j));
    (0..9).all(|k| (gram[k / 3][k % 3] - wanted(k / 3, k % 3)).abs() < 1e-6)
}

fn refused_rotation(keys: &Keys<'_>) -> Problem {
    let remedy = "write three orthonormal rows, right-handed; columns are the tool axes";
    keys.problem("rotation", "is no rotation matrix", remedy)
}

fn body_of(keys: &Keys<'_>) -> Outcome<SpindleBody> {
    let mass = keys.positive("mass_kg")?;
    let com = keys.vector("com_m")?;
    let inertia = keys.array::<6>("inertia_kgm2")?;
    let example = "inertia_kgm2 = [1.2, 1.4, 1.1, 0.0, 0.0, 0.0]";
    Ok(SpindleBody {
        mass: mass.ok_or_else(|| keys.missing("mass_kg", "mass_kg = 48.0"))?,
        com: com.ok_or_else(|| keys.missing("com_m", "com_m = [1.92, 0.0, 1.81]"))?,
        inertia: inertia.ok_or_else(|| keys.missing("inertia_kgm2", example))?,
    })
}
