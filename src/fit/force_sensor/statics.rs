//! What a sensor reads that carries a weight and touches nothing.
//!
//! Sensor axes in base axes: R(q) Rot(ρ), where q is what the robot says and ρ the turn of the sensor about
//! its own axes. Gravity in base axes: Rot(τ)ᵀ (0, 0, −1), where τ = (τx, τy, 0) tilts the base. With
//! d = (R Rot(ρ))ᵀ Rot(τ)ᵀ (0, 0, −1), weight W, centre of mass r (sensor frame) and offsets o:
//! F = o_F + W d, M = o_M + W r × d.

use crate::ground::spatial::{
    M3, V3, cross, norm, of_quaternion, rotate_back, rotation, scale, unit,
};

/// Number of parameters.
pub const N: usize = 15;

/// Name, site, unit and meaning of each, in the order of the vector.
pub const PARAMETERS: [(&str, &str, &str, &str); N] = [
    ("weight", "tool", "N", "Weight of what hangs on the sensor."),
    (
        "com_x",
        "tool",
        "m",
        "Centre of mass along x of the sensor.",
    ),
    (
        "com_y",
        "tool",
        "m",
        "Centre of mass along y of the sensor.",
    ),
    (
        "com_z",
        "tool",
        "m",
        "Centre of mass along z of the sensor.",
    ),
    (
        "offset_fx",
        "sensor-x",
        "N",
        "Force that the sensor reads unloaded, along its x.",
    ),
    (
        "offset_fy",
        "sensor-y",
        "N",
        "Force that the sensor reads unloaded, along its y.",
    ),
    (
        "offset_fz",
        "sensor-z",
        "N",
        "Force that the sensor reads unloaded, along its z.",
    ),
    (
        "offset_mx",
        "sensor-x",
        "N·m",
        "Moment that the sensor reads unloaded, about its x.",
    ),
    (
        "offset_my",
        "sensor-y",
        "N·m",
        "Moment that the sensor reads unloaded, about its y.",
    ),
    (
        "offset_mz",
        "sensor-z",
        "N·m",
        "Moment that the sensor reads unloaded, about its z.",
    ),
    (
        "rotation_x",
        "sensor",
        "rad",
        "Turn of the sensor about its x: component of a rotation vector, true axes = R(q) Rot(rotation).",
    ),
    (
        "rotation_y",
        "sensor",
        "rad",
        "Turn of the sensor about its y, as rotation_x.",
    ),
    (
        "rotation_z",
        "sensor",
        "rad",
        "Turn of the sensor about its z, as rotation_x.",
    ),
    (
        "base_tilt_x",
        "base",
        "rad",
        "Tilt of the base about its x: gravity in base axes is Rot(tilt)ᵀ (0, 0, −1).",
    ),
    (
        "base_tilt_y",
        "base",
        "rad",
        "Tilt of the base about its y, as base_tilt_x.",
    ),
];

/// First of the angles among the parameters.
pub const ANGLES: usize = 10;

/// Natural size of each parameter for a tool of this weight: what counts as not known at all.
pub fn sizes(weight: f64) -> [f64; N] {
    let (w, r, a) = (weight.abs().max(f64::MIN_POSITIVE), 0.1, 0.1);
    [w, r, r, r, w, w, w, w * r, w * r, w * r, a, a, a, a, a]
}

/// Rotation matrix of a rotation vector, rad.
fn turned(v: V3) -> M3 {
    let angle = norm(v);
    unit(v).map_or_else(
        || rotation([1.0, 0.0, 0.0], 0.0),
        |axis| rotation(axis, angle),
    )
}

/// Force (N) and moment (N·m) that the sensor reads at the orientation `q`.
pub fn reading(p: &[f64; N], q: [f64; 4]) -> [f64; 6] {
    let gravity = rotate_back(&turned([p[13], p[14], 0.0]), [0.0, 0.0, -1.0]);
    let d = rotate_back(
        &turned([p[10], p[11], p[12]]),
        rotate_back(&of_quaternion(q), gravity),
    );
    let (f, m) = (scale(p[0], d), cross([p[1], p[2], p[3]], scale(p[0], d)));
    [
        p[4] + f[0],
        p[5] + f[1],
        p[6] + f[2],
        p[7] + m[0],
        p[8] + m[1],
        p[9] + m[2],
    ]
}

/// Slopes of [`reading`]: for each channel along each parameter, by central differences (the law is smooth
/// and its scales are known: 1e-5 of them leaves eleven digits).
pub fn slopes(p: &[f64; N], q: [f64; 4]) -> [[f64; N]; 6] {
    let mut out = [[0.0; N]; 6];
    let steps = sizes(p[0].abs().max(1.0)).map(|size| 1e-5 * size);
    for (j, step) in steps.into_iter().enumerate() {
        let (mut up, mut down) = (*p, *p);
        up[j] += step;
        down[j] -= step;
        let (up, down) = (reading(&up, q), reading(&down, q));
        for c in 0..6 {
            out[c][j] = (up[c] - down[c]) / (2.0 * step);
        }
    }
    out
}
