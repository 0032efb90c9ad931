//! A campaign as it is printed (`formats.md`, section 3).

use super::{Campaign, Check, DiagnosedFile, FileDocument};
use crate::findings::answer::Group;
use crate::findings::belief::Place;
use crate::findings::document::{CauseDocument, GroupDocument};
use crate::findings::gain::Gain;
use crate::findings::joint::{Joint, Together};
use crate::findings::next_setups::SetupDocument;
use crate::ground::problem::Outcome;
use serde::Serialize;
use serde_json::{Map, Value, json};

/// Something with the file it was found in.
#[derive(Serialize)]
struct WithFile<T> {
    #[serde(flatten)]
    own: T,
    file: String,
}

impl<T> WithFile<T> {
    fn new(own: T, file: &DiagnosedFile) -> Self {
        Self {
            own,
            file: file.path().display().to_string(),
        }
    }
}

/// A cause as all tests of the robot see it.
#[derive(Serialize)]
struct TogetherDocument<'a> {
    effect: &'a str,
    site: &'a str,
    probability: f64,
    alone: Map<String, Value>,
}

#[derive(Serialize)]
struct CheckDocument<'a> {
    from: &'a str,
    causes: &'a [String],
    against: &'a str,
    rms_before: f64,
    rms_after: f64,
    unit: &'static str,
    prediction: &'static str,
}

/// A campaign as it is printed.
#[derive(Serialize)]
pub struct CampaignDocument<'a> {
    kind: &'static str,
    campaign: &'a str,
    synthetic: bool,
    verdict: &'static str,
    sentence: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<Vec<TogetherDocument<'a>>>,
    causes: Vec<WithFile<CauseDocument<'a>>>,
    cannot_separate: Vec<WithFile<GroupDocument<'a>>>,
    checks: Vec<CheckDocument<'a>>,
    remarks: &'a [String],
    next: Option<Vec<SetupDocument>>,
    experiments: Vec<WithFile<FileDocument<'a>>>,
    model: Option<String>,
}

impl Campaign {
    /// What is printed; `written`: whether models are written, so that their paths are named.
    ///
    /// # Errors
    /// A model that no file can hold.
    pub fn document(&self, written: bool) -> Outcome<CampaignDocument<'_>> {
        let (causes, cannot_separate) = gathered(self);
        let experiments = self.files.iter();
        let experiments = experiments.map(|file| Ok(WithFile::new(file.document(written)?, file)));
        let robot = self.robot.as_ref().filter(|_| written);
        let next = self.next.as_ref();
        Ok(CampaignDocument {
            kind: "campaign",
            campaign: &self.place.campaign,
            synthetic: self.synthetic(),
            verdict: self.verdict.name(),
            sentence: self.sentence(),
            joint: self.joint.as_ref().map(together),
            causes,
            cannot_separate,
            checks: self.checks.iter().map(check).collect(),
            remarks: &self.remarks,
            next: next.map(|next| SetupDocument::of(&next.plan)),
            experiments: experiments.collect::<Outcome<_>>()?,
            model: robot.map(|_| self.robot_path().display().to_string()),
        })
    }
}

type Gathered<'a> = (
    Vec<WithFile<CauseDocument<'a>>>,
    Vec<WithFile<GroupDocument<'a>>>,
);

/// The causes of all files, the most gainful first, and the groups that stay open: a group that all tests
/// together tell apart counts as a cause.
fn gathered(campaign: &Campaign) -> Gathered<'_> {
    let (mut causes, mut groups) = (Vec::new(), Vec::new());
    for file in &campaign.files {
        let answer = file.found.answer();
        let own = answer.causes.iter().map(CauseDocument::of);
        causes.extend(own.map(|cause| WithFile::new(cause, file)));
        for group in &answer.groups {
            match campaign.told(group) {
                Some(told) => causes.push(WithFile::new(settled(told, group), file)),
                None => groups.push(WithFile::new(GroupDocument::of(group), file)),
            }
        }
    }
    causes.sort_by(|a, b| reduction(b.own.gain()).total_cmp(&reduction(a.own.gain())));
    (causes, groups)
}

/// What a cause gains; one without a number comes last.
fn reduction(gain: &Gain) -> f64 {
    Some(gain.reduction_percent)
        .filter(|percent| percent.is_finite())
        .unwrap_or(0.0)
}

/// A cause that one experiment cannot tell from others, and all together can.
fn settled<'a>(((effect, site), probability): (Place, f64), group: &'a Group) -> CauseDocument<'a> {
    CauseDocument::bare(effect, site, probability, &group.gain)
}

fn together(joint: &Joint) -> Vec<TogetherDocument<'_>> {
    let one = |cause: &'_ Together| {
        let alone = joint.tests.iter().zip(&cause.alone);
        alone.map(|(test, p)| (test.clone(), json!(p))).collect()
    };
    let causes = joint.causes.iter().map(|cause| TogetherDocument {
        effect: cause.place.0,
        site: &cause.place.1,
        probability: cause.probability,
        alone: one(cause),
    });
    causes.collect()
}

fn check(check: &Check) -> CheckDocument<'_> {
    CheckDocument {
        from: &check.from,
        causes: &check.causes,
        against: &check.against,
        rms_before: check.before,
        rms_after: check.after,
        unit: check.unit,
        prediction: check.word(),
    }
}
