//! The page of a survey.

use super::tables::{matrix, measured_hz, modes, sentence, simulated_hz};
use super::{RobotBeside, Told};
use crate::experiments::survey::picture::{mac_chart, mode_blocks};
use crate::sheet::page::{Block, Page, Tone};

/// The page.
pub fn page(stem: &str, told: &Told) -> Page {
    let points = told.survey.geometry.points.len();
    let mut page = Page::new(format!("Survey {stem}"), format!("{points} points"));
    page.synthetic = told.survey.record.synthetic;
    page = page.with(Block::text(sentence(told)));
    for remark in &told.found.remarks {
        page = page.with(Block::verdict(Tone::Attention, format!("{remark}.")));
    }
    page = page.with(Block::Table(modes(told)));
    page = page.with(Block::heading("Modes as they swing"));
    page = mode_blocks(&told.survey, &told.found.modes)
        .into_iter()
        .fold(page, Page::with);
    page = page.with(Block::heading("Modal assurance"));
    page = auto(told).into_iter().fold(page, Page::with);
    if let Some(robot) = &told.robot {
        page = page.with(Block::heading("Beside the simulation"));
        page = simulated(told, robot).into_iter().fold(page, Page::with);
    }
    let remarks = told
        .survey
        .remarks
        .iter()
        .map(|remark| Block::text(format!("{remark}.")));
    remarks.fold(page, Page::with)
}

fn auto(told: &Told) -> Vec<Block> {
    let caption = "Shapes that are alike (dark beside the diagonal) cannot be told apart at the points that were measured.";
    let chart = mac_chart(
        "survey-mac",
        "Modal assurance among the modes of the survey",
        caption,
        ("mode", "mode"),
        &told.auto,
    );
    let hz = measured_hz(told);
    let table = matrix("Modal assurance", &hz, &hz, &told.auto).map(Block::Table);
    let chart = Block::Chart(chart.synthetic(told.survey.record.synthetic));
    [chart].into_iter().chain(table).collect()
}

fn simulated(told: &Told, robot: &RobotBeside) -> Vec<Block> {
    let remarks = robot.assignment.remarks.iter();
    let mut blocks: Vec<Block> = remarks.map(|r| Block::text(format!("{r}."))).collect();
    let caption = "Over the directions at points whose link is certain. A pair is told where each is the other's best and the assurance is 0.7 at least.";
    let chart = mac_chart(
        "survey-mac-simulated",
        "Modal assurance, survey beside simulation",
        caption,
        ("simulated mode", "mode of the survey"),
        &robot.beside.mac,
    );
    blocks.push(Block::Chart(chart.synthetic(told.survey.record.synthetic)));
    let title = "Modal assurance, survey (rows) beside simulation (columns)";
    let table = matrix(
        title,
        &measured_hz(told),
        &simulated_hz(robot),
        &robot.beside.mac,
    );
    blocks.extend(table.map(Block::Table));
    blocks
}
