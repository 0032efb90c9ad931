//! Reading URDF: links, joints, inertias. The tool centre point is the frame `tool0`, else the last
//! link; fixed joints are merged into the body that carries them.

use super::body::Body;
use super::model::{Joint, Robot, Tool};
use super::xml::{Document, JointText, LinkText, parse};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{Pose, V3, rotate, unit};
use std::collections::HashMap;

/// Reads a robot from URDF text.
///
/// # Errors
/// Broken XML, a number that is none, a joint kind that is neither fixed nor rotational, a chain
/// that branches into two drives: with line, name and remedy. Bodies are judged by [`super::check`].
pub fn read(text: &str) -> Outcome<Robot> {
    let document = parse(text)?;
    let chain = chain_of(&document)?;
    let tool = tool_of(&document, &chain);
    Ok(Robot {
        name: document.name.clone(),
        source: document.comments.join("; "),
        notes: vec!["read from URDF: joint values as the URDF means them".into()],
        joints: chain.joints,
        tool,
        elastic: Vec::new(),
    })
}

/// The driven joints and where every frame lies with all joints at zero.
struct Chain {
    joints: Vec<Joint>,
    frames: HashMap<String, Pose>,
    tip: String,
}

fn chain_of(document: &Document) -> Outcome<Chain> {
    let root = root_of(document)?;
    let mut chain = Chain {
        joints: Vec::new(),
        frames: HashMap::new(),
        tip: root.clone(),
    };
    let mut link = Some(root);
    let mut pose = Pose::IDENTITY;
    while let Some(name) = link.take() {
        let drive = merge_rigid(document, &name, pose, &mut chain)?;
        let Some((text, parent)) = drive else { break };
        pose = parent.then(&text.origin.pose());
        chain.joints.push(joint_of(text, &pose)?);
        link = Some(text.child.clone());
    }
    match chain.joints.is_empty() {
        true => Err(Problem::new(
            "the URDF has no rotational joint",
            "give it at least one joint of type revolute or continuous",
        )),
        false => Ok(chain),
    }
}

/// Adds a link and all that is fixed to it to the last driven joint; returns the next drive with
/// the pose of its parent.
fn merge_rigid<'a>(
    document: &'a Document,
    root: &str,
    pose: Pose,
    chain: &mut Chain,
) -> Outcome<Option<(&'a JointText, Pose)>> {
    let mut drive: Option<(&JointText, Pose)> = None;
    let mut todo = vec![(root.to_string(), pose)];
    while let Some((name, pose)) = todo.pop() {
        add_link(document, &name, &pose, chain)?;
        for joint in document.joints.iter().filter(|joint| joint.parent == name) {
            if joint.kind == "fixed" {
                todo.push((joint.child.clone(), pose.then(&joint.origin.pose())));
            } else if let Some((other, _)) = drive.replace((joint, pose)) {
                return Err(branches(&other.name, joint));
            }
        }
    }
    Ok(drive)
}

fn branches(first: &str, second: &JointText) -> Problem {
    Problem::new(
        format!(
            "the joints `{first}` and `{}` start from one link: the chain branches",
            second.name
        ),
        "keep one chain from the base to the tool",
    )
    .at_line(second.line)
}

fn add_link(document: &Document, name: &str, pose: &Pose, chain: &mut Chain) -> Outcome<()> {
    if chain.frames.insert(name.to_string(), *pose).is_some() {
        return Err(Problem::new(
            format!("the link `{name}` is reached twice"),
            "a serial robot has no loops: give each link one parent",
        ));
    }
    let body = document
        .links
        .iter()
        .find(|link| link.name == name)
        .and_then(LinkText::body);
    if let (Some(joint), Some(body)) = (chain.joints.last_mut(), body) {
        let placed = body.placed(pose);
        joint.link = Some(joint.link.unwrap_or(Body::NOTHING).with(&placed));
    }
    chain.tip = name.to_string();
    Ok(())
}

fn root_of(document: &Document) -> Outcome<String> {
    let is_child = |link: &LinkText| document.joints.iter().any(|joint| joint.child == link.name);
    let root = document.links.iter().find(|link| !is_child(link));
    root.map(|link| link.name.clone()).ok_or_else(|| {
        Problem::new(
            "the URDF has no link without a parent",
            "one link must be the base",
        )
    })
}

fn joint_of(text: &JointText, pose: &Pose) -> Outcome<Joint> {
    let refuse = |what: String, remedy: &str| {
        Err(Problem::new(format!("joint `{}` {what}", text.name), remedy).at_line(text.line))
    };
    if !matches!(text.kind.as_str(), "revolute" | "continuous") {
        return refuse(
            format!("is of type `{}`", text.kind),
            "only revolute, continuous and fixed joints are understood",
        );
    }
    let Some(local) = unit(text.axis.unwrap_or([1.0, 0.0, 0.0])) else {
        return refuse(
            "has an axis without direction".into(),
            "write a unit vector in <axis xyz=\"..\"/>",
        );
    };
    let full = std::f64::consts::TAU;
    let limits = text
        .limits
        .filter(|_| text.kind == "revolute")
        .unwrap_or([-full, full]);
    if limits[0] > limits[1] {
        return refuse(
            format!("has the limits {limits:?}"),
            "lower must not exceed upper",
        );
    }
    Ok(Joint {
        name: text.name.clone(),
        link_name: text.child.clone(),
        axis: clean(rotate(&pose.rotation, local)),
        point: pose.point,
        limits,
        max_speed: text.velocity.filter(|speed| *speed > 0.0),
        max_acceleration: None,
        drive: None,
        tilt: None,
        link: None,
        source: None,
    })
}

/// Length exactly 1, and no dust of 1e-16 from roll, pitch, yaw written as multiples of π/2.
fn clean(v: V3) -> V3 {
    let swept = v.map(|x| if x.abs() < 4.0 * f64::EPSILON { 0.0 } else { x });
    unit(swept).unwrap_or(v)
}

fn tool_of(document: &Document, chain: &Chain) -> Tool {
    let frame = |name: &str| chain.frames.get(name).copied();
    let last = chain
        .joints
        .last()
        .and_then(|joint| frame(&joint.link_name));
    let named = document
        .links
        .iter()
        .any(|link| link.name == "tool0")
        .then(|| frame("tool0"))
        .flatten();
    let tcp = named
        .or_else(|| frame(&chain.tip))
        .or(last)
        .unwrap_or(Pose::IDENTITY);
    let flange = frame("flange").unwrap_or(tcp);
    Tool {
        flange: flange.point,
        tcp: tcp.point,
        rotation: tcp.rotation,
        spindle_axis: None,
        body: None,
        source: None,
    }
}
