//! What a motion says of the parameters of each joint, and the sentences about them.

use super::finding::JointFinding;
use super::scales::STIFFNESS;
use crate::fit::parameter::{Identified, Status};
use crate::sheet::number::{engineering, with_interval};

/// What would fix the stiffness of a joint.
pub const FOR_STIFFNESS: &str = "hold the joint at rest in poses of different gravity load, coming to each slowly from both sides, and read both encoders there; or press on the arm with a known force with the brakes on";

/// Delay and stiffness of a joint; a number only where the data fix one.
pub fn parameters(joint: &JointFinding) -> Vec<Identified> {
    let mut all = Vec::new();
    if let Some(delay) = joint.delay {
        let meaning = "how much later than the motor encoder the link encoder is read";
        let (value, std) = (delay.value, delay.std);
        all.push(Identified::new(
            "delay",
            &joint.site,
            value,
            "s",
            std,
            meaning,
        ));
    }
    let meaning = "torque on the link side of the gear per twist";
    let stiffness = |value: f64, std: f64| {
        Identified::new("stiffness", &joint.site, value, "N·m/rad", std, meaning)
    };
    all.push(match joint.compliance {
        Ok(c) => stiffness(1.0 / c.value, c.std / (c.value * c.value)),
        Err(_) => stiffness(0.0, 0.0).without_value(Status::NotIdentifiable),
    });
    all
}

/// What a reader should know beside the causes: delays that agree, and stiffnesses that are not fixed.
pub fn remarks(joints: &[JointFinding]) -> Vec<String> {
    let mut said = Vec::new();
    said.extend(common_delay(joints));
    said.extend(stiffnesses(joints));
    said.extend(joints.iter().filter_map(rotor));
    said.extend(joints.iter().filter_map(softer_still));
    said.extend(joints.iter().filter_map(leftover));
    let wild: usize = joints.iter().map(|j| j.data.wild).sum();
    if wild > 0 {
        said.push(format!(
            "{wild} lone wild readings were replaced by their neighbours."
        ));
    }
    said
}

fn common_delay(joints: &[JointFinding]) -> Option<String> {
    let of = |j: &JointFinding| parameters(j).into_iter().find(|p| p.name == "delay");
    let delays: Vec<Identified> = joints.iter().filter_map(of).collect();
    if delays.is_empty() {
        return None;
    }
    let each: Vec<String> = delays
        .iter()
        .filter_map(|d| {
            let ([low, high], value) = (d.ci95?, d.value?);
            let text = with_interval(1e3 * value, 1e3 * low, 1e3 * high);
            Some(format!("{} {text} ms", d.site))
        })
        .collect();
    let ends = |k: usize| delays.iter().filter_map(move |d| Some(d.ci95?[k]));
    let agree = ends(0).fold(f64::MIN, f64::max) <= ends(1).fold(f64::MAX, f64::min);
    let why = match delays.len() > 1 && agree {
        true => {
            "; the intervals (95 %) share a value, as one read-out for all of them would make it"
        }
        false => " (95 %)",
    };
    Some(format!(
        "Delay of the link encoder behind the motor encoder: {}{why}. State it as `# encoder_delay_s` to take it out.",
        each.join(", ")
    ))
}

fn stiffnesses(joints: &[JointFinding]) -> Vec<String> {
    let mut said = Vec::new();
    let mut open: Vec<(&'static str, Vec<&str>)> = Vec::new();
    for joint in joints {
        match joint.compliance {
            Ok(c) => said.push(format!(
                "Stiffness of {}: {} (standard error {:.0} %).",
                joint.site,
                engineering(1.0 / c.value, 3, "N·m/rad"),
                100.0 * c.std / c.value
            )),
            Err(why) => match open.iter_mut().find(|o| o.0 == why) {
                Some(known) => known.1.push(&joint.site),
                None => open.push((why, vec![&joint.site])),
            },
        }
    }
    for (why, sites) in &open {
        said.push(format!(
            "Stiffness of {}: not identifiable from this motion; {why}.",
            sites.join(", ")
        ));
    }
    if !open.is_empty() {
        said.push(format!("To identify a stiffness: {FOR_STIFFNESS}."));
    }
    said
}

fn rotor(joint: &JointFinding) -> Option<String> {
    let share = 100.0 * joint.rotor?;
    Some(format!(
        "{} twists less than its stated spring does under the torque of its motor: a rotor whose inertia, seen through the gear, is {share:.0} % of what the joint moves would make that, and so would a spring {share:.0} % stiffer.",
        joint.site
    ))
}

/// A spring that is told beside a rotor of which nothing is known.
fn softer_still(joint: &JointFinding) -> Option<String> {
    let is_named = joint
        .answer
        .causes
        .iter()
        .any(|c| c.effect == STIFFNESS.name);
    let is_bound = is_named && joint.compliance.is_err();
    is_bound.then(|| {
        format!(
            "The stiffness named at {} is the most that the motion allows: behind a rotor with inertia the spring is softer still.",
            joint.site
        )
    })
}

fn leftover(joint: &JointFinding) -> Option<String> {
    let seen = joint.seen.as_ref()?;
    Some(format!("Seen at {} and not named: {seen}.", joint.site))
}
