//! The diagnosis of a file: its joints one by one, and one answer for all.

use super::finding::{JointFinding, diagnose_joint};
use super::joint::Nominal;
use super::remarks::{parameters, remarks};
use crate::findings::answer::{Answer, Discrepancy, Structure, Verdict};
use crate::fit::parameter::{Identified, Status};
use crate::fit::suitability::joint_motion::doubts;
use crate::ground::stats::{mean, rms};
use crate::measurement::joint_motion::{JointMotion, JointRecord};
use crate::robot::Robot;
use rayon::prelude::*;

/// What was found in a file.
pub struct MotionDiagnosis {
    /// The answer.
    pub answer: Answer,
    /// Joint by joint.
    pub joints: Vec<JointFinding>,
    /// Delays and stiffnesses.
    pub parameters: Vec<Identified>,
    /// What a reader should know beside the causes.
    pub remarks: Vec<String>,
}

/// Diagnoses a file; the robot, if there is one, is the present simulation.
pub fn diagnose(file: &JointMotion, robot: Option<&Robot>) -> MotionDiagnosis {
    let joints: Vec<JointFinding> = file
        .joints
        .par_iter()
        .map(|joint| diagnose_joint(joint, nominal(joint, robot)))
        .collect();
    let doubts = doubts(file, |joint| nominal(joint, robot).stiffness);
    let answer = answer(&joints).doubted(doubts);
    let (mut parameters, mut remarks): (Vec<Identified>, _) = (
        joints.iter().flat_map(parameters).collect(),
        remarks(&joints),
    );
    if answer.is_withheld() {
        let withheld = |p: Identified| p.without_value(Status::NotIdentifiable);
        parameters = parameters.into_iter().map(withheld).collect();
        remarks.clear();
    }
    MotionDiagnosis {
        answer,
        parameters,
        remarks,
        joints,
    }
}

fn nominal(joint: &JointRecord, robot: Option<&Robot>) -> Nominal {
    let drive = || {
        let spring = robot?.joints.get(joint.number - 1)?.drive.as_ref()?;
        Some(spring.stiffness)
    };
    Nominal {
        stiffness: joint.nominal_stiffness.or_else(drive),
        rel_std: joint.nominal_rel_std,
    }
}

/// Candidates that are told of every joint.
const CANDIDATES: usize = 4;

fn answer(joints: &[JointFinding]) -> Answer {
    let answers = || joints.iter().map(|j| &j.answer);
    let pooled = |of: &dyn Fn(&JointFinding) -> f64| {
        let squares: Vec<f64> = joints.iter().map(|j| of(j).powi(2)).collect();
        mean(&squares).sqrt()
    };
    let left = |j: &JointFinding| rms(&j.residual());
    let noise_rms = pooled(&|j| j.answer.discrepancy.noise_rms);
    let all = pooled(&|j| j.answer.discrepancy.rms);
    let share =
        (pooled(&left).powi(2) - noise_rms * noise_rms) / all.powi(2).max(f64::MIN_POSITIVE);
    let mut causes: Vec<_> = answers().flat_map(|a| a.causes.clone()).collect();
    causes.sort_by(|a, b| {
        b.gain
            .reduction_percent
            .total_cmp(&a.gain.reduction_percent)
    });
    let worst = joints.iter().max_by(|a, b| left(a).total_cmp(&left(b)));
    Answer {
        verdict: verdict(&answers().map(|a| a.verdict).collect::<Vec<_>>()),
        discrepancy: Discrepancy {
            rms: all,
            noise_rms,
            place: at_each(joints, |a| &a.discrepancy.place),
        },
        causes,
        groups: answers().flat_map(|a| a.groups.clone()).collect(),
        unexplained: worst.map_or_else(Structure::default, |j| structure(j, share.clamp(0.0, 1.0))),
        p_value: answers().map(|a| a.p_value).fold(1.0, f64::min),
        candidates: answers()
            .flat_map(|a| a.candidates.iter().take(CANDIDATES).cloned())
            .collect(),
        unit: "rad",
        noise: at_each(joints, |a| &a.noise),
        unstated: false,
        doubts: Vec::new(),
    }
}

/// What is said of every joint, once where all say the same.
fn at_each(joints: &[JointFinding], said: impl Fn(&Answer) -> &String) -> String {
    let mut all: Vec<&String> = joints.iter().map(|j| said(&j.answer)).collect();
    all.dedup();
    match all.as_slice() {
        [one] => (*one).clone(),
        _ => {
            let each = joints.iter();
            let each = each.map(|j| format!("{} at {}", said(&j.answer), j.site));
            each.collect::<Vec<_>>().join(", ")
        }
    }
}

/// The residual of one joint over its torque and over time.
fn structure(joint: &JointFinding, share: f64) -> Structure {
    let own = &joint.answer.unexplained;
    let seen = joint.seen.as_ref().unwrap_or(&own.description);
    Structure {
        share_of_variance: share,
        description: format!("at {}: {seen}.", joint.site),
        ..own.clone()
    }
}

/// The verdict on all joints: where one joint is explained and another is not, the file is in part.
fn verdict(joints: &[Verdict]) -> Verdict {
    let mut open: Vec<Verdict> = joints.to_vec();
    open.retain(|v| *v != Verdict::Sufficient);
    let is_left = |v: &Verdict| matches!(v, Verdict::UnknownCause | Verdict::PartlyExplained);
    match open.as_slice() {
        [] => Verdict::Sufficient,
        [first, rest @ ..] if rest.iter().all(|v| v == first) => *first,
        all if all.iter().any(is_left) => Verdict::PartlyExplained,
        _ => Verdict::Explained,
    }
}
