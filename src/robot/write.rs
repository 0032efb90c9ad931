//! Writing robot files: the same TOML that [`super::file`] reads, every number with its unit, its
//! source and, where known, its interval. Deterministic: the shortest text that reads back exactly.

use super::body::Body;
use super::joint_effect::JointEffect;
use super::model::{ElasticAxis, Joint, Robot, Tool};
use super::spring::Spring;
use crate::ground::spatial::IDENTITY;
use crate::ground::units::DEGREE;
use crate::measurement::front::quoted;
use std::fmt::Write;

/// The same for a robot that measurements extended, labelled where these were simulated.
pub fn labelled(robot: &Robot, synthetic: bool) -> String {
    let label = match synthetic {
        true => "# synthetic: extended from simulated measurements\n",
        false => "",
    };
    format!("{label}{}", write(robot))
}

/// The robot as TOML text; [`super::file::read`] gives the same robot back (angles to rounding).
pub fn write(robot: &Robot) -> String {
    let mut out = String::new();
    let _ = writeln!(
        out,
        "# Geometry in the base frame with every joint at zero; units stand in the names."
    );
    let _ = writeln!(out, "name = {}", quoted(&robot.name));
    let _ = writeln!(out, "source = {}", quoted(&robot.source));
    if !robot.notes.is_empty() {
        let notes: Vec<String> = robot
            .notes
            .iter()
            .map(|note| format!("    {},\n", quoted(note)))
            .collect();
        let _ = writeln!(out, "notes = [\n{}]", notes.concat());
    }
    robot
        .joints
        .iter()
        .for_each(|joint| joint_table(&mut out, joint));
    tool_table(&mut out, &robot.tool);
    robot
        .elastic
        .iter()
        .for_each(|axis| elastic_table(&mut out, axis));
    out
}

fn joint_table(out: &mut String, joint: &Joint) {
    let _ = writeln!(out, "\n[[joints]]\nname = {}", quoted(&joint.name));
    let _ = writeln!(out, "axis = {}", list(&joint.axis));
    let _ = writeln!(out, "point_m = {}", list(&joint.point));
    let _ = writeln!(out, "limits_deg = {}", list(&joint.limits.map(degrees)));
    if let Some(speed) = joint.max_speed {
        let _ = writeln!(out, "max_speed_deg_s = {}", number(degrees(speed)));
    }
    if let Some(limit) = joint.max_acceleration {
        let _ = writeln!(out, "max_acceleration_deg_s2 = {}", number(degrees(limit)));
    }
    for (key, spring) in [("drive", &joint.drive), ("tilt", &joint.tilt)] {
        if let Some(spring) = spring {
            let _ = writeln!(out, "{key} = {{ {} }}", entries(spring).join(", "));
        }
    }
    if let Some(body) = &joint.link {
        let _ = writeln!(out, "link = {}", inline_body(body));
    }
    source_line(out, joint.source.as_deref());
}

fn tool_table(out: &mut String, tool: &Tool) {
    let _ = writeln!(
        out,
        "\n[tool]\nflange_m = {}\ntcp_m = {}",
        list(&tool.flange),
        list(&tool.tcp)
    );
    if tool.rotation != IDENTITY {
        let rows = tool.rotation.map(|row| list(&row)).join(", ");
        let _ = writeln!(out, "rotation = [{rows}]");
    }
    if let Some(axis) = &tool.spindle_axis {
        let _ = writeln!(out, "spindle_axis = {}", list(axis));
    }
    if let Some(body) = &tool.body {
        let _ = writeln!(out, "body = {}", inline_body(body));
    }
    source_line(out, tool.source.as_deref());
}

fn elastic_table(out: &mut String, axis: &ElasticAxis) {
    let _ = writeln!(
        out,
        "\n[[elastic]]\nname = {}\nafter = {}",
        quoted(&axis.name),
        axis.after
    );
    let _ = writeln!(
        out,
        "axis = {}\npoint_m = {}",
        list(&axis.axis),
        list(&axis.point)
    );
    if let Some(body) = &axis.body {
        let _ = writeln!(out, "body = {}", inline_body(body));
    }
    entries(&axis.spring).iter().for_each(|entry| {
        let _ = writeln!(out, "{entry}");
    });
}

fn source_line(out: &mut String, source: Option<&str>) {
    if let Some(source) = source {
        let _ = writeln!(out, "source = {}", quoted(source));
    }
}

fn entries(spring: &Spring) -> Vec<String> {
    let mut out = vec![
        format!("stiffness_Nm_rad = {}", number(spring.stiffness)),
        format!("damping_Nms_rad = {}", number(spring.damping)),
    ];
    match spring.backlash.as_slice() {
        [] => {}
        [gap] => out.push(format!("backlash_rad = {}", number(*gap))),
        gaps => out.push(format!("backlash_rad = {}", list(gaps))),
    }
    let effects: Vec<String> = spring.effects.iter().map(effect).collect();
    if !effects.is_empty() {
        out.push(format!("effects = [{}]", effects.join(", ")));
    }
    let intervals = [
        ("stiffness_ci95_Nm_rad", spring.ci95.stiffness),
        ("damping_ci95_Nms_rad", spring.ci95.damping),
        ("backlash_ci95_rad", spring.ci95.backlash),
    ];
    out.extend(
        intervals
            .iter()
            .filter_map(|(key, ci)| Some(format!("{key} = {}", list(&(*ci)?)))),
    );
    let stated = spring.stiffness_rel_std.iter();
    out.extend(stated.map(|s| format!("stiffness_rel_std = {}", number(*s))));
    out.extend(
        spring
            .source
            .iter()
            .map(|source| format!("source = {}", quoted(source))),
    );
    out
}

fn effect(effect: &JointEffect) -> String {
    let values = effect.keys().into_iter().zip(&effect.values);
    let values: String = values
        .map(|(key, value)| format!(", {key} = {}", number(*value)))
        .collect();
    format!("{{ name = {}{values} }}", quoted(&effect.name))
}

fn inline_body(body: &Body) -> String {
    format!(
        "{{ mass_kg = {}, com_m = {}, inertia_kgm2 = {} }}",
        number(body.mass),
        list(&body.com),
        list(&body.inertia)
    )
}

fn list(values: &[f64]) -> String {
    let numbers: Vec<String> = values.iter().map(|x| number(*x)).collect();
    format!("[{}]", numbers.join(", "))
}

fn number(x: f64) -> String {
    format!("{x:?}")
}

/// Degrees without the dust of the conversion: 185.0, not 185.00000000000003.
fn degrees(radians: f64) -> f64 {
    let raw = radians / DEGREE;
    let short = (raw * 1e9).round() / 1e9;
    if (short - raw).abs() <= 1e-13 * raw.abs().max(1.0) {
        short
    } else {
        raw
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{builtin, file};

    #[test]
    fn what_is_written_reads_back() {
        for (_, source) in builtin::BUILTINS {
            let robot = file::read(source).unwrap();
            let again = file::read(&write(&robot)).unwrap();
            assert_eq!(again, robot);
        }
    }

    #[test]
    fn what_is_identified_of_any_spring_reads_back() {
        for (_, source) in builtin::BUILTINS {
            let mut robot = file::read(source).unwrap();
            for (_, spring) in robot.springs_mut() {
                spring.backlash = vec![2e-4];
                spring.ci95.stiffness = Some([0.9, 1.1].map(|share| share * spring.stiffness));
                spring.ci95.damping = Some([10.0, 20.0]);
                spring.ci95.backlash = Some([1e-4, 3e-4]);
            }
            assert_eq!(file::read(&write(&robot)).unwrap(), robot);
        }
    }
}
