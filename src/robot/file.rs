//! Reading robot files (TOML, `formats.md` section 2). Unknown keys are refused with their line.

use super::body::Body;
use super::joint_effect;
use super::model::{ElasticAxis, Joint, Robot, Tool};
use super::spring::{Intervals, Spring};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{IDENTITY, M3, V3, scale, unit};
use crate::ground::units::DEGREE;
use serde::Deserialize;
use toml::Spanned;

/// How far from 1 the length of an axis may be before it counts as a mistake; then it is scaled.
const UNIT_TOLERANCE: f64 = 1e-3;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RobotText {
    name: String,
    #[serde(default)]
    source: String,
    #[serde(default)]
    notes: Vec<String>,
    joints: Vec<Spanned<JointText>>,
    tool: Option<Spanned<ToolText>>,
    #[serde(default)]
    elastic: Vec<Spanned<ElasticText>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct JointText {
    name: String,
    axis: V3,
    point_m: V3,
    limits_deg: Option<[f64; 2]>,
    max_speed_deg_s: Option<f64>,
    drive: Option<SpringText>,
    tilt: Option<SpringText>,
    link: Option<BodyText>,
    source: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SpringText {
    #[serde(rename = "stiffness_Nm_rad")]
    stiffness: f64,
    #[serde(rename = "damping_Nms_rad", default)]
    damping: f64,
    #[serde(rename = "backlash_rad", default)]
    backlash: OneOrMany,
    #[serde(default)]
    effects: Vec<toml::Table>,
    source: Option<String>,
    #[serde(rename = "stiffness_ci95_Nm_rad")]
    stiffness_ci95: Option<[f64; 2]>,
    #[serde(rename = "damping_ci95_Nms_rad")]
    damping_ci95: Option<[f64; 2]>,
    #[serde(rename = "backlash_ci95_rad")]
    backlash_ci95: Option<[f64; 2]>,
}

/// One gap or a list of gaps in series.
#[derive(Deserialize)]
#[serde(untagged)]
enum OneOrMany {
    One(f64),
    Many(Vec<f64>),
}

impl Default for OneOrMany {
    fn default() -> Self {
        Self::One(0.0)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BodyText {
    mass_kg: f64,
    com_m: V3,
    inertia_kgm2: [f64; 6],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ToolText {
    flange_m: Option<V3>,
    tcp_m: V3,
    rotation: Option<M3>,
    body: Option<BodyText>,
    source: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ElasticText {
    name: String,
    after: usize,
    axis: V3,
    point_m: V3,
    #[serde(rename = "stiffness_Nm_rad")]
    stiffness: f64,
    #[serde(rename = "damping_Nms_rad", default)]
    damping: f64,
    #[serde(rename = "backlash_rad", default)]
    backlash: OneOrMany,
    #[serde(default)]
    effects: Vec<toml::Table>,
    source: Option<String>,
    #[serde(rename = "stiffness_ci95_Nm_rad")]
    stiffness_ci95: Option<[f64; 2]>,
    #[serde(rename = "damping_ci95_Nms_rad")]
    damping_ci95: Option<[f64; 2]>,
}

/// Reads a robot from TOML text.
///
/// # Errors
/// Syntax, a missing or unknown key, an axis that is no unit vector, a spring or limit that cannot
/// be: each with line, key and remedy. Bodies are judged by [`super::check`], not here.
pub fn read(text: &str) -> Outcome<Robot> {
    let raw: RobotText = toml::from_str(text).map_err(|error| syntax(text, &error))?;
    let place =
        |span: std::ops::Range<usize>, problem: Problem| problem.at_line(line_of(text, span.start));
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
    if raw
        .max_speed_deg_s
        .is_some_and(|speed| !(speed > 0.0 && speed.is_finite()))
    {
        return Err(refuse(
            &name,
            "max_speed_deg_s",
            "is not positive".into(),
            "write the highest speed in deg/s, or leave it out",
        ));
    }
    Ok(Joint {
        axis: unit_axis(&name, raw.axis)?,
        point: finite(&name, "point_m", raw.point_m)?,
        limits: [low * DEGREE, high * DEGREE],
        max_speed: raw.max_speed_deg_s.map(|speed| speed * DEGREE),
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
    let name = raw.name;
    if raw.after > joints {
        return Err(refuse(
            &name,
            "after",
            format!("is {}", raw.after),
            &format!("0 is the foundation, 1 to {joints} the link moved by that joint"),
        ));
    }
    let spring = SpringText {
        stiffness: raw.stiffness,
        damping: raw.damping,
        backlash: raw.backlash,
        effects: raw.effects,
        source: raw.source,
        stiffness_ci95: raw.stiffness_ci95,
        damping_ci95: raw.damping_ci95,
        backlash_ci95: None,
    };
    Ok(ElasticAxis {
        after: raw.after,
        axis: unit_axis(&name, raw.axis)?,
        point: finite(&name, "point_m", raw.point_m)?,
        spring: spring_of(&name, spring)?,
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
        body: raw.body.map(body_of),
        source: raw.source,
    })
}

fn spring_of(site: &str, raw: SpringText) -> Outcome<Spring> {
    let mut backlash = match raw.backlash {
        OneOrMany::One(gap) => vec![gap],
        OneOrMany::Many(gaps) => gaps,
    };
    backlash.retain(|gap| *gap != 0.0);
    let spring = Spring {
        stiffness: raw.stiffness,
        damping: raw.damping,
        backlash,
        effects: joint_effect::read(site, raw.effects, raw.stiffness)?,
        source: raw.source,
        ci95: Intervals {
            stiffness: raw.stiffness_ci95,
            damping: raw.damping_ci95,
            backlash: raw.backlash_ci95,
        },
    };
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
    if v.iter().all(|x| x.is_finite()) {
        return Ok(v);
    }
    Err(refuse(
        name,
        key,
        "is not finite".into(),
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

/// 1-based line of a byte offset.
fn line_of(text: &str, offset: usize) -> usize {
    1 + text
        .as_bytes()
        .iter()
        .take(offset)
        .filter(|byte| **byte == b'\n')
        .count()
}

fn syntax(text: &str, error: &toml::de::Error) -> Problem {
    let what = error.message().lines().collect::<Vec<_>>().join("; ");
    let problem = Problem::new(
        what,
        "compare with `ident robot convert kr210`, a complete robot file; every key carries its unit",
    );
    let Some(span) = error.span() else {
        return problem;
    };
    let problem = problem.at_line(line_of(text, span.start));
    match key_before(text, span.start) {
        Some(key) => problem.in_column(key),
        None => problem,
    }
}

/// The key whose value stands at a byte offset: the word before the last `=` on that line.
fn key_before(text: &str, offset: usize) -> Option<&str> {
    let line = text.get(..offset)?.rsplit('\n').next()?;
    let key = line.rsplit_once('=')?.0.trim_end();
    let word = key
        .rsplit(|c: char| !(c.is_alphanumeric() || c == '_' || c == '-'))
        .next()?;
    (!word.is_empty()).then_some(word)
}
