//! Reading robot files (TOML, `formats.md` section 2). Unknown keys are refused with their line.

mod syntax;
mod text;

use super::body::Body;
use super::joint_effect;
use super::model::{ElasticAxis, Joint, Robot, Tool};
use super::spring::Spring;
use crate::ground::problem::{Outcome, Problem, line_of};
use crate::ground::spatial::{IDENTITY, M3, V3, scale, unit};
use crate::ground::units::{DEGREE, FARTHEST_M};
use syntax::syntax;
use text::{BodyText, ElasticText, JointText, RobotText, SpringText, ToolText};

/// How far from 1 the length of an axis may be before it counts as a mistake; then it is scaled.
const UNIT_TOLERANCE: f64 = 1e-3;

/// Reads a robot from TOML text.
///
/// # Errors
/// Syntax, a missing or unknown key, an axis that is no unit vector, a spring or limit that cannot
/// be: each with line, key and remedy. Bodies are judged by [`super::check`], not here.
pub fn read(text: &str) -> Outcome<Robot> {
    let raw: RobotText = toml::from_str(text).map_err(|error| syntax(text, &error))?;
    let place = |span: std::ops::Range<usize>, problem: Problem| {
        problem.at_line(line_of(text.as_bytes(), span.start))
    };
    let joints = raw.joints.into_iter().map(|joint| {
        let span = joint.span();
        joint_of(joint.into_inner()).map_err(|problem| place(span, problem))
    });
    let joints = joints.collect::<Outcome<Vec<_>>>()?;
    let count = joints.len();
    let elastic = raw.elastic.into_iter().map(|axis| {
        let span = axis.span();
        elastic_of(axis.into_inner(), count).map_err(|problem| place(span, problem))
    });
    let elastic = elastic.collect::<Outcome<Vec<_>>>()?;
    let tool = raw.tool.map(|tool| {
        let span = tool.span();
        tool_of(tool.into_inner()).map_err(|problem| place(span, problem))
    });
    let tool = tool.transpose()?.unwrap_or_else(|| bare_flange(&joints));
    complete(Robot {
        name: raw.name,
        source: raw.source,
        notes: raw.notes,
        joints,
        tool,
        elastic,
    })
}

fn complete(robot: Robot) -> Outcome<Robot> {
    if robot.joints.is_empty() {
        return Err(Problem::new(
            "a robot without joints",
            "add at least one [[joints]] table",
        )
        .in_column("joints"));
    }
    let mut names: Vec<String> = robot
        .joints
        .iter()
        .map(|joint| joint.name.clone())
        .collect();
    names.extend(robot.elastic.iter().map(|axis| axis.name.clone()));
    names.sort();
    match names.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(Problem::new(
            format!("two joints or elastic axes are named `{}`", pair[0]),
            "give every [[joints]] and [[elastic]] its own name: results are reported under it",
        )
        .in_column("name")),
        None => Ok(robot),
    }
}

/// Without a [tool] the tool centre point is the point of the last axis.
fn bare_flange(joints: &[Joint]) -> Tool {
    let point = joints.last().map_or([0.0; 3], |joint| joint.point);
    Tool {
        flange: point,
        tcp: point,
        ..Tool::default()
    }
}

fn joint_of(raw: JointText) -> Outcome<Joint> {
    let name = raw.name;
    let link_name = name
        .strip_prefix('A')
        .map_or_else(|| name.clone(), |i| format!("link{i}"));
    let [low, high] = raw.limits_deg.unwrap_or([-360.0, 360.0]);
    if !(low <= high && low.is_finite() && high.is_finite()) {
        return Err(refuse(
            &name,
            "limits_deg",
            format!("are [{low}, {high}]"),
            "write them as [lowest, highest] in degrees",
        ));
    }
    let most = [
        ("max_speed_deg_s", raw.max_speed_deg_s),
        ("max_acceleration_deg_s2", raw.max_acceleration_deg_s2),
    ];
    for (key, limit) in most {
        if limit.is_some_and(|limit| !(limit > 0.0 && limit.is_finite())) {
            let remedy = "write the highest one in deg/s or deg/s², or leave it out";
            return Err(refuse(&name, key, "is not positive".into(), remedy));
        }
    }
    Ok(Joint {
        axis: unit_axis(&name, raw.axis)?,
        point: finite(&name, "point_m", raw.point_m)?,
        limits: [low * DEGREE, high * DEGREE],
        max_speed: raw.max_speed_deg_s.map(|speed| speed * DEGREE),
        max_acceleration: raw.max_acceleration_deg_s2.map(|limit| limit * DEGREE),
        drive: raw.drive.map(|drive| spring_of(&name, drive)).transpose()?,
        tilt: raw
            .tilt
            .map(|tilt| spring_of(&format!("{name}-tilt"), tilt))
            .transpose()?,
        link: raw.link.map(body_of),
        source: raw.source,
        link_name,
        name,
    })
}

fn elastic_of(raw: ElasticText, joints: usize) -> Outcome<ElasticAxis> {
    let (spring, effects, (name, after, axis, point_m, body)) = raw.parts();
    if after > joints {
        return Err(refuse(
            &name,
            "after",
            format!("is {after}"),
            &format!("0 is the foundation, 1 to {joints} the link moved by that joint"),
        ));
    }
    Ok(ElasticAxis {
        after,
        axis: unit_axis(&name, axis)?,
        point: finite(&name, "point_m", point_m)?,
        spring: sound(&name, spring, effects)?,
        body: body.map(body_of),
        name,
    })
}

fn tool_of(raw: ToolText) -> Outcome<Tool> {
    let rotation = raw.rotation.unwrap_or(IDENTITY);
    if !is_rotation(&rotation) {
        return Err(refuse(
            "tool",
            "rotation",
            "is no rotation matrix".into(),
            "write three orthonormal rows, right-handed; columns are the tool axes in the base frame with every joint at zero",
        ));
    }
    Ok(Tool {
        tcp: finite("tool", "tcp_m", raw.tcp_m)?,
        flange: finite("tool", "flange_m", raw.flange_m.unwrap_or(raw.tcp_m))?,
        rotation,
        spindle_axis: raw
            .spindle_axis
            .map(|axis| unit_axis("tool", axis))
            .transpose()?,
        body: raw.body.map(body_of),
        source: raw.source,
    })
}

fn spring_of(site: &str, raw: SpringText) -> Outcome<Spring> {
    let (spring, effects, ()) = raw.parts();
    sound(site, spring, effects)
}

/// The spring with its effects, if both are possible.
fn sound(site: &str, mut spring: Spring, effects: Vec<toml::Table>) -> Outcome<Spring> {
    spring.effects = joint_effect::read(site, effects, spring.stiffness)?;
    match spring.fault() {
        Some(fault) => Err(Problem::new(
            format!("the spring {site} {fault}"),
            "leave `drive` or `tilt` out where the joint is rigid; stiffness is in N·m/rad (1 N·mm/rad = 0.001 N·m/rad)",
        )
        .in_column(site)),
        None => Ok(spring),
    }
}

fn body_of(raw: BodyText) -> Body {
    Body {
        mass: raw.mass_kg,
        com: raw.com_m,
        inertia: raw.inertia_kgm2,
    }
}

fn unit_axis(name: &str, axis: V3) -> Outcome<V3> {
    let length = crate::ground::spatial::norm(axis);
    match unit(axis) {
        Some(u) if (length - 1.0).abs() <= f64::EPSILON * 2.0 => {
            Ok(if length == 1.0 { axis } else { u })
        }
        Some(u) if (length - 1.0).abs() <= UNIT_TOLERANCE => Ok(u),
        Some(u) => Err(refuse(
            name,
            "axis",
            format!("has length {length}"),
            &format!(
                "a direction has length 1; the same direction is {:?}",
                scale(1.0, u)
            ),
        )),
        None => Err(refuse(
            name,
            "axis",
            "has no direction".into(),
            "write a unit vector, for example [0.0, 1.0, 0.0]",
        )),
    }
}

fn finite(name: &str, key: &str, v: V3) -> Outcome<V3> {
    if v.iter().all(|x| x.abs() < FARTHEST_M) {
        return Ok(v);
    }
    Err(refuse(
        name,
        key,
        "is not finite, or lies more than ten kilometres away".into(),
        "write three finite numbers in metres",
    ))
}

/// Whether a matrix is orthonormal and right-handed to 1e-6.
pub fn is_rotation(r: &M3) -> bool {
    use crate::ground::spatial::{determinant, product, transpose};
    let gram = product(r, &transpose(r));
    let close = (0..9).all(|k| (gram[k / 3][k % 3] - IDENTITY[k / 3][k % 3]).abs() < 1e-6);
    close && determinant(r) > 0.0
}

fn refuse(name: &str, key: &str, what: String, remedy: &str) -> Problem {
    Problem::new(format!("{name}: `{key}` {what}"), remedy).in_column(key)
}
