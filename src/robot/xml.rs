//! What the XML of a URDF says, before anybody asks whether it makes sense.

use super::body::Body;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{Pose, V3, roll_pitch_yaw};
use crate::ground::units::FARTHEST_M;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

/// What one `<joint>` says.
#[derive(Debug, Clone, Default)]
pub(super) struct JointText {
    pub name: String,
    pub kind: String,
    pub parent: String,
    pub child: String,
    pub origin: Placement,
    pub axis: Option<V3>,
    pub limits: Option<[f64; 2]>,
    pub velocity: Option<f64>,
    pub line: usize,
}

/// `<origin>`: translation (m) and roll, pitch, yaw (rad).
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Placement {
    xyz: V3,
    rpy: V3,
}

impl Placement {
    pub(super) fn pose(&self) -> Pose {
        let [roll, pitch, yaw] = self.rpy;
        Pose {
            rotation: roll_pitch_yaw(roll, pitch, yaw),
            point: self.xyz,
        }
    }
}

/// What one `<link>` says: name, inertial frame, mass, tensor.
#[derive(Debug, Clone, Default)]
pub(super) struct LinkText {
    pub name: String,
    origin: Placement,
    mass: Option<f64>,
    inertia: [f64; 6],
}

impl LinkText {
    /// Its body in the link frame, if the file gives it a mass.
    pub(super) fn body(&self) -> Option<Body> {
        let local = Body {
            mass: self.mass?,
            com: [0.0; 3],
            inertia: self.inertia,
        };
        Some(local.placed(&self.origin.pose()))
    }
}

/// A whole URDF.
#[derive(Debug, Default)]
pub(super) struct Document {
    pub name: String,
    pub links: Vec<LinkText>,
    pub joints: Vec<JointText>,
    pub comments: Vec<String>,
}

/// Goes through the XML once.
pub(super) fn parse(text: &str) -> Outcome<Document> {
    let mut reader = Reader::from_str(text);
    let mut document = Document::default();
    let mut open: Vec<String> = Vec::new();
    loop {
        let event = reader.read_event();
        let line = || line_at(text, reader.buffer_position());
        match event {
            Ok(Event::Start(tag)) => {
                if open.len() >= DEEPEST {
                    return Err(too_deep().at_line(line()));
                }
                whole(&tag).map_err(|problem| problem.at_line(line()))?;
                take(&mut document, &open, &tag, &line)?;
                open.push(tag.name().0.to_string());
            }
            Ok(Event::Empty(tag)) => {
                whole(&tag).map_err(|problem| problem.at_line(line()))?;
                take(&mut document, &open, &tag, &line)?;
            }
            Ok(Event::End(_)) => drop(open.pop()),
            Ok(Event::Comment(comment)) => document.comments.push(comment.trim().to_string()),
            Ok(Event::Eof) => return complete(document, &open),
            Ok(_) => {}
            Err(error) => return Err(broken(&error.to_string()).at_line(line())),
        }
    }
}

/// A URDF nests a handful of elements.
const DEEPEST: usize = 64;

fn too_deep() -> Problem {
    Problem::new(
        format!("elements are nested more than {DEEPEST} deep"),
        "a URDF is <robot> with <link> and <joint> elements",
    )
}

/// Refuses a tag one of whose attributes is malformed or doubled: it would be dropped.
fn whole(tag: &BytesStart) -> Outcome<()> {
    for attribute in tag.attributes() {
        attribute.map_err(|error| broken(&format!("<{}>: {error}", tag.name().0)))?;
    }
    Ok(())
}

fn broken(error: &str) -> Problem {
    Problem::new(
        format!("broken XML: {error}"),
        "repair the file, or expand xacro first: `xacro robot.xacro > robot.urdf`",
    )
}

fn complete(document: Document, open: &[String]) -> Outcome<Document> {
    if let Some(tag) = open.last() {
        return Err(Problem::new(
            format!("the file ends inside <{tag}>"),
            "the URDF is cut off: copy it again",
        ));
    }
    let joints = document.joints.iter().map(|j| (&j.name, j.line));
    let mut seen = std::collections::HashSet::new();
    for (name, line) in joints {
        if !seen.insert(name) {
            let what = format!("the joint `{name}` occurs twice");
            return Err(Problem::new(what, "give every joint its own name").at_line(line));
        }
    }
    match document.links.is_empty() {
        true => Err(Problem::new(
            "no <link> found: this is no URDF",
            "a URDF is <robot name=\"..\"> with <link> and <joint> elements",
        )),
        false => Ok(document),
    }
}

fn line_at(text: &str, offset: u64) -> usize {
    let head = text.as_bytes().iter().take(offset as usize);
    1 + head.filter(|byte| **byte == b'\n').count()
}

/// One opening tag: where it stands decides what it means.
fn take(
    document: &mut Document,
    open: &[String],
    tag: &BytesStart,
    line: &dyn Fn() -> usize,
) -> Outcome<()> {
    let place = |problem: Problem| problem.at_line(line());
    let path: Vec<&str> = open.iter().map(String::as_str).collect();
    match (path.as_slice(), tag.name().0) {
        ([], "robot") => document.name = text_of(tag, "name").map_err(place)?.unwrap_or_default(),
        (["robot"], "link") => document.links.push(LinkText {
            name: text_of(tag, "name").map_err(place)?.unwrap_or_default(),
            ..LinkText::default()
        }),
        (["robot"], "joint") => document.joints.push(JointText {
            name: text_of(tag, "name").map_err(place)?.unwrap_or_default(),
            kind: text_of(tag, "type").map_err(place)?.unwrap_or_default(),
            line: line(),
            ..JointText::default()
        }),
        (["robot", "link", "inertial"], name) => {
            document
                .links
                .last_mut()
                .map_or(Ok(()), |link| inertial(link, name, tag))
                .map_err(place)?;
        }
        (["robot", "joint"], name) => {
            document
                .joints
                .last_mut()
                .map_or(Ok(()), |joint| joint_part(joint, name, tag))
                .map_err(place)?;
        }
        _ => {}
    }
    Ok(())
}

fn inertial(link: &mut LinkText, name: &str, tag: &BytesStart) -> Outcome<()> {
    match name {
        "origin" => link.origin = placement(tag)?,
        "mass" => link.mass = number(tag, "value")?,
        "inertia" => {
            for (entry, key) in link
                .inertia
                .iter_mut()
                .zip(["ixx", "iyy", "izz", "ixy", "ixz", "iyz"])
            {
                *entry = number(tag, key)?.unwrap_or(0.0);
            }
        }
        _ => {}
    }
    Ok(())
}

fn joint_part(joint: &mut JointText, name: &str, tag: &BytesStart) -> Outcome<()> {
    match name {
        "origin" => joint.origin = placement(tag)?,
        "parent" => joint.parent = text_of(tag, "link")?.unwrap_or_default(),
        "child" => joint.child = text_of(tag, "link")?.unwrap_or_default(),
        "axis" => joint.axis = numbers(tag, "xyz")?,
        "limit" => {
            let (lower, upper) = (number(tag, "lower")?, number(tag, "upper")?);
            joint.limits = lower.zip(upper).map(|(low, high)| [low, high]);
            joint.velocity = number(tag, "velocity")?;
        }
        _ => {}
    }
    Ok(())
}

fn placement(tag: &BytesStart) -> Outcome<Placement> {
    let xyz: V3 = numbers(tag, "xyz")?.unwrap_or_default();
    if xyz.iter().any(|x| x.abs() >= FARTHEST_M) {
        let what = format!("<{}> lies more than ten kilometres away", tag.name().0);
        return Err(Problem::new(what, "write three numbers in metres").in_column("xyz"));
    }
    Ok(Placement {
        xyz,
        rpy: numbers(tag, "rpy")?.unwrap_or_default(),
    })
}

fn text_of(tag: &BytesStart, key: &str) -> Outcome<Option<String>> {
    let attribute = tag
        .try_get_attribute(key)
        .map_err(|error| broken(&error.to_string()))?;
    let value = attribute.map(|a| a.normalized_value(XmlVersion::Implicit1_0));
    let value = value
        .transpose()
        .map_err(|error| broken(&error.to_string()))?;
    Ok(value.map(|text| text.into_owned()))
}

fn number(tag: &BytesStart, key: &str) -> Outcome<Option<f64>> {
    text_of(tag, key)?
        .map(|text| parse_number(tag, key, &text))
        .transpose()
}

fn numbers(tag: &BytesStart, key: &str) -> Outcome<Option<V3>> {
    let Some(text) = text_of(tag, key)? else {
        return Ok(None);
    };
    let values = text
        .split_whitespace()
        .map(|word| parse_number(tag, key, word));
    let values = values.collect::<Outcome<Vec<f64>>>()?;
    <V3>::try_from(values).map(Some).map_err(|values| {
        Problem::new(
            format!(
                "<{}> has {} numbers in `{key}`, not 3",
                tag.name().0,
                values.len()
            ),
            "write three numbers, divided by spaces",
        )
        .in_column(key)
    })
}

fn parse_number(tag: &BytesStart, key: &str, text: &str) -> Outcome<f64> {
    let value = text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    value.ok_or_else(|| {
        Problem::new(
            format!(
                "<{}> has `{text}` in `{key}`, which is no finite number",
                tag.name().0
            ),
            "write a number in SI units; xacro expressions must be expanded first",
        )
        .in_column(key)
    })
}
