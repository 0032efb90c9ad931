//! The report of `ident damping`.

use super::account::{self, dampings, fixed_combinations, matches};
use super::figures::{hits, pair, poles};
use super::result::Damped;
use crate::experiments::robot_picture::{mode_blocks, modes};
use crate::fit::damping::{Pair, Test};
use crate::ground::files;
use crate::motion::skeleton::skeleton;
use crate::sheet::chart::Chart;
use crate::sheet::page::{Block, Page, Tone};
use crate::sheet::table::Table;

/// Modes of the robot that are drawn.
const SWINGS: usize = 4;

/// The page: does the simulation meet the measurement, with which constants, how was it measured.
pub fn page(damped: &Damped) -> Page {
    let subtitle = format!(
        "{} from {}",
        damped.input.robot.robot.name,
        damped.input.names()
    );
    let mut page = Page::new("Damping from hammer tests", subtitle);
    page.synthetic = damped.synthetic();
    let (tone, sentence) = verdict(damped);
    page = page.with(Block::verdict(tone, sentence));
    for remark in damped.remarks().into_iter().chain(damped.left_out()) {
        page = page.with(Block::verdict(Tone::Attention, remark));
    }
    for remark in damped.passed_over() {
        page = page.with(Block::verdict(Tone::Neutral, remark));
    }
    page = page
        .with(Block::heading("Simulated beside measured"))
        .with(Block::Table(matches(damped)));
    page = charts(damped, page, true)
        .with(Block::heading("What was identified"))
        .with(Block::Table(dampings(damped)));
    let fixed = fixed_combinations(damped);
    if !fixed.rows.is_empty() {
        page = page.with(Block::Table(fixed));
    }
    page = swings(damped).into_iter().fold(page, Page::with);
    page = page.with(Block::heading("Cross terms"));
    let cross = charts(damped, Page::default(), false).blocks;
    page.with(Block::details("All cross terms", cross))
        .with(Block::heading("How it was measured"))
        .with(Block::Table(hit_table(damped)))
        .with(Block::Table(account::modes(damped)))
        .with(Block::details(
            "Hit by hit, and the choice of modes",
            measured(damped),
        ))
}

/// The tuned robot as it swings at the pose of the first test, where its constants are told.
fn swings(damped: &Damped) -> Vec<Block> {
    let robot = &damped.account.robot;
    let tests = &damped.input.tests;
    let joints = tests
        .first()
        .and_then(|test| test.record.joint_angles.as_ref());
    let Some(joints) = joints.filter(|_| damped.account.supported) else {
        return Vec::new();
    };
    let line = skeleton(robot, joints);
    let modes = modes(robot, joints, &line, SWINGS).unwrap_or_default();
    let blocks = mode_blocks(&line, &modes, "damping-mode-").into_iter();
    let synthetic = damped.synthetic();
    let labelled = blocks.map(|block| match block {
        Block::Chart(chart) => Block::Chart(chart.synthetic(synthetic)),
        other => other,
    });
    let heading = (!modes.is_empty()).then(|| Block::heading("How the tuned robot swings"));
    heading.into_iter().chain(labelled).collect()
}

fn verdict(damped: &Damped) -> (Tone, String) {
    let pairs = damped.account.pairs.iter().flatten();
    let worst = pairs.map(|p| p.matches[1]);
    let (frac, db) = worst.fold((1.0_f64, 0.0_f64), |(f, d), m| {
        (f.min(m.frac), d.max(m.log_error_db))
    });
    let floor = (frac * 1e4).floor() / 1e4;
    let numbers = format!("FRAC at least {floor:.4}, amplitude within {db:.2} dB in the mean");
    match damped.met() {
        true => (
            Tone::Good,
            format!("The tuned simulation meets every measured FRF: {numbers}."),
        ),
        false => (
            Tone::Attention,
            format!(
                "Damping alone does not bring the simulation to the measurement ({numbers}): look for wrong stiffness or mass (--release-stiffness, --release-mass), play or friction."
            ),
        ),
    }
}

fn tests(damped: &Damped) -> impl Iterator<Item = (usize, &Test, &Pair)> {
    let tests = damped
        .input
        .tests
        .iter()
        .zip(&damped.account.pairs)
        .enumerate();
    tests.flat_map(|(i, (test, pairs))| pairs.iter().map(move |pair| (i, test, pair)))
}

/// File stem of a figure; the first test needs no number.
fn stem(test: usize, what: &str) -> String {
    match test {
        0 => format!("damping-{what}"),
        _ => format!("damping-{}-{what}", test + 1),
    }
}

fn driving(pair: &Pair) -> bool {
    pair.measured.input == pair.measured.output
}

fn charts(damped: &Damped, page: Page, direct: bool) -> Page {
    let wanted = tests(damped).filter(|(_, _, pair)| driving(pair) == direct);
    wanted.fold(page, |page, (i, test, one)| {
        page.with(Block::Chart(pair(test, one, &stem(i, &one.name))))
    })
}

fn measured(damped: &Damped) -> Vec<Block> {
    let direct = tests(damped).filter(|(_, _, pair)| driving(pair));
    let overlays = direct
        .filter_map(|(i, test, one)| hits(test, one, &stem(i, &format!("hits-{}", one.name))));
    let mut all: Vec<Chart> = overlays.collect();
    let to_hz = damped.request.settings.band_hz;
    let charts = damped.input.tests.iter().enumerate();
    all.extend(charts.map(|(i, test)| poles(test, to_hz, &stem(i, "stabilisation"))));
    all.into_iter().map(Block::Chart).collect()
}

fn hit_table(damped: &Damped) -> Table {
    let mut table = Table::new("Hits", ["file", "direction", "hit", "verdict"]);
    for test in &damped.input.tests {
        for hit in &test.frf.screened {
            let verdict = hit
                .why()
                .map_or("used".into(), |why| format!("left out: {why}"));
            table.push([
                files::name(&test.path),
                hit.direction.clone(),
                hit.hit.clone(),
                verdict,
            ]);
        }
    }
    table
}
