//! The diagnosis of a file: its joints one by one, and one answer for all.

use super::channels::rms;
use super::joint::{JointFinding, Nominal, diagnose_joint};
use super::parameters::{parameters, remarks};
use crate::findings::answer::{Answer, Cause, Discrepancy, Structure, Verdict};
use crate::findings::load_cycle::structure::binned;
use crate::fit::parameter::{Identified, Status};
use crate::fit::suitability::joint_motion::doubts;
use crate::measurement::joint_motion::{JointMotion, JointRecord};
use crate::robot::Robot;
use rayon::prelude::*;

/// Share of the discrepancy above which what was found is not the story.
const NOT_THE_STORY: f64 = 0.5;

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
    let found = joints.iter().flat_map(parameters);
    match answer.is_withheld() {
        false => MotionDiagnosis {
            answer,
            parameters: found.collect(),
            remarks: remarks(&joints),
            joints,
        },
        true => MotionDiagnosis {
            answer,
            parameters: found
                .map(|p| p.without_value(Status::NotIdentifiable))
                .collect(),
            remarks: Vec::new(),
            joints,
        },
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

fn answer(joints: &[JointFinding]) -> Answer {
    let pooled = |of: &dyn Fn(&JointFinding) -> f64| {
        let squares: f64 = joints.iter().map(|j| of(j).powi(2)).sum();
        (squares / joints.len().max(1) as f64).sqrt()
    };
    let missed = |j: &JointFinding| rms(&j.missed());
    let left = |j: &JointFinding| rms(&j.residual());
    let noise_rms = pooled(&|j| j.noise_rms);
    let all = pooled(&missed);
    let share = (pooled(&left).powi(2) - noise_rms.powi(2)) / all.powi(2).max(f64::MIN_POSITIVE);
    let mut causes: Vec<Cause> = joints.iter().flat_map(|j| j.named.causes.clone()).collect();
    causes.sort_by(|a, b| {
        b.gain
            .reduction_percent
            .total_cmp(&a.gain.reduction_percent)
    });
    let worst = joints.iter().max_by(|a, b| left(a).total_cmp(&left(b)));
    Answer {
        verdict: verdict(joints),
        discrepancy: Discrepancy {
            rms: all,
            noise_rms,
            place: place(joints),
        },
        causes,
        groups: joints.iter().flat_map(|j| j.named.groups.clone()).collect(),
        unexplained: worst.map_or_else(Structure::default, |j| structure(j, share.clamp(0.0, 1.0))),
        p_value: joints.iter().map(|j| j.p_value).fold(1.0, f64::min),
        candidates: joints.iter().flat_map(|j| j.candidates.clone()).collect(),
        unit: "rad",
        noise: joints
            .iter()
            .map(|j| format!("{} at {}", j.noise, j.site))
            .collect::<Vec<_>>()
            .join(", "),
        unstated: false,
        doubts: Vec::new(),
    }
}

fn place(joints: &[JointFinding]) -> String {
    let mut places: Vec<&str> = joints.iter().map(|j| j.place).collect();
    places.dedup();
    match places.as_slice() {
        [one] => (*one).into(),
        _ => joints
            .iter()
            .map(|j| format!("{} at {}", j.place, j.site))
            .collect::<Vec<_>>()
            .join(", "),
    }
}

/// The residual of one joint over its torque and over time.
fn structure(joint: &JointFinding, share: f64) -> Structure {
    let residual = joint.residual();
    let seen = joint.description.clone();
    let plain = || "no pattern over speed, torque or angle that a known cause makes".into();
    Structure {
        share_of_variance: share,
        shape: binned(&joint.data.torque, &residual),
        over_time: binned(&joint.data.time, &residual),
        description: format!("at {}: {}.", joint.site, seen.unwrap_or_else(plain)),
    }
}

fn verdict(joints: &[JointFinding]) -> Verdict {
    let any = |of: &dyn Fn(&JointFinding) -> bool| joints.iter().any(of);
    let caused = any(&|j| !j.named.causes.is_empty());
    let grouped = any(&|j| !j.named.groups.is_empty());
    let left = any(&|j| j.is_left);
    let story = any(&|j| j.is_left && j.share_left > NOT_THE_STORY);
    match (caused, grouped, left) {
        (false, false, true) => Verdict::UnknownCause,
        (false, true, true) if story => Verdict::UnknownCause,
        (true, _, true) | (false, true, true) => Verdict::PartlyExplained,
        (false, false, false) => Verdict::Sufficient,
        (false, true, false) => Verdict::CannotTell,
        (true, _, false) => Verdict::Explained,
    }
}
