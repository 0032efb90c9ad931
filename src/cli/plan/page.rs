//! The report page of `ident plan`.

use super::{Planned, account, figures};
use crate::ground::files;
use crate::ground::units::DEGREE;
use crate::planning::exceeded::JointUse;
use crate::sheet::number::{ABSENT, significant};
use crate::sheet::page::{Block, Page, Tone};
use crate::sheet::table::Table;

/// The page.
pub fn page(planned: &Planned) -> Page {
    let name = files::name(&planned.toolpath.path);
    let subtitle = format!(
        "{} for the robot {}",
        planned.job.path.display(),
        planned.plan.cell.robot.name
    );
    let mut page = Page::new(format!("Planned path: {name}"), subtitle);
    page.synthetic = planned.toolpath.synthetic || planned.job.synthetic;
    let good = planned.plan.exceeded.is_empty();
    let mut sentences = account::sentences(planned).into_iter();
    let first = sentences.next().unwrap_or_default();
    let tone = if good { Tone::Good } else { Tone::Neutral };
    page = page.with(Block::verdict(tone, first));
    page = sentences.fold(page, |page, sentence| page.with(Block::text(sentence)));
    for exceeded in &planned.plan.exceeded {
        page = page.with(Block::verdict(Tone::Attention, account::told(exceeded)));
    }
    page = page
        .with(Block::heading("The path"))
        .with(Block::Chart(figures::path(planned)))
        .with(Block::Scene(figures::scene(planned)))
        .with(Block::heading("The feed"))
        .with(Block::Chart(figures::feed(planned)))
        .with(Block::heading("The joints"))
        .with(Block::Chart(figures::joints(planned)))
        .with(Block::Chart(figures::angles(planned)))
        .with(Block::Table(joints(planned)));
    let remarks = account::remarks(planned);
    if remarks.is_empty() {
        return page;
    }
    let remarks = remarks.into_iter().map(Block::text).collect();
    page.with(Block::details("Remarks on the path file", remarks))
}

fn joints(planned: &Planned) -> Table {
    let header = [
        "joint",
        "least deg",
        "largest deg",
        "limits deg",
        "fastest deg/s",
        "limit deg/s",
        "hardest deg/s²",
        "limit deg/s²",
    ];
    let table = Table::new("Ranges, speeds and accelerations", header).numeric([1, 2, 4, 5, 6, 7]);
    planned
        .plan
        .joints
        .iter()
        .fold(table, |table, joint| table.with(row(joint)))
}

fn row(joint: &JointUse) -> [String; 8] {
    let fixed = |angle: f64| format!("{:.2}", angle / DEGREE + 0.0);
    let limit = |limit: Option<f64>| limit.map_or(ABSENT.into(), fixed);
    let [low, high] = joint.limits.map(|limit| significant(limit / DEGREE, 4));
    [
        joint.site.clone(),
        fixed(joint.range[0]),
        fixed(joint.range[1]),
        format!("{low} to {high}"),
        fixed(joint.max_speed),
        limit(joint.speed_limit),
        fixed(joint.max_acceleration),
        limit(joint.acceleration_limit),
    ]
}
