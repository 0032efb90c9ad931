//! A robot as the text of a robot file.

use super::robot::{Body, Robot, Spring, V3};
use std::fmt::Write;

fn list(v: &V3) -> String {
    format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z)
}

fn spring(s: &Spring) -> String {
    format!(
        "{{ stiffness_Nm_rad = {:?}, damping_Nms_rad = {:?} }}",
        s.stiffness, s.damping
    )
}

fn body(b: &Body) -> String {
    let i = &b.inertia;
    let tensor = [i.m11, i.m22, i.m33, i.m12, i.m13, i.m23];
    format!(
        "{{ mass_kg = {:?}, com_m = {}, inertia_kgm2 = {tensor:?} }}",
        b.mass,
        list(&b.com)
    )
}

/// The robot file; `None` where an axis slides, which robot files do not know.
pub fn robot_text(robot: &Robot) -> Option<String> {
    if robot.extra.iter().any(|e| e.slides) {
        return None;
    }
    let mut text = format!("name = \"{}\"\nsource = \"drawn for a test\"\n", robot.name);
    for (i, joint) in robot.joints.iter().enumerate() {
        let tilt = joint.tilt.map(|t| format!("tilt = {}\n", spring(&t)));
        let _ = write!(
            text,
            "\n[[joints]]\nname = \"A{}\"\naxis = {}\npoint_m = {}\nlimits_deg = {:?}\ndrive = {}\n{}link = {}\n",
            i + 1,
            list(&joint.axis),
            list(&joint.point),
            joint.limits,
            spring(&joint.drive),
            tilt.unwrap_or_default(),
            body(&joint.body)
        );
    }
    let _ = write!(
        text,
        "\n[tool]\nflange_m = {}\ntcp_m = {}\nbody = {}\n",
        list(&robot.flange),
        list(&robot.tcp),
        body(&robot.tool)
    );
    for e in &robot.extra {
        let _ = write!(
            text,
            "\n[[elastic]]\nname = \"{}\"\nafter = {}\naxis = {}\npoint_m = {}\nstiffness_Nm_rad = {:?}\ndamping_Nms_rad = {:?}\n",
            e.name,
            e.after,
            list(&e.axis),
            list(&e.point),
            e.spring.stiffness,
            e.spring.damping
        );
    }
    Some(text)
}
