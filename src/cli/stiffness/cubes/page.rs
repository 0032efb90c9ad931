//! The report page of measuring cubes.

use super::{Identified, tables};
use crate::ground::spatial::norm;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::page::{Block, Page, Tone};

/// The page.
pub fn page(found: &Identified) -> Page {
    let tests = found.account.relative.len();
    let subtitle = format!(
        "{} of robot {}, {tests} pairs of subsequent cubes under load",
        found.stem(),
        found.base.robot.name
    );
    let mut page = Page::new(format!("Measuring cubes {}", found.stem()), subtitle);
    page.synthetic = found.synthetic();
    page = page.with(Block::verdict(Tone::Neutral, tables::sentence(found)));
    for warning in found.warnings() {
        page = page.with(Block::verdict(Tone::Attention, format!("{warning}.")));
    }
    page = page
        .with(Block::heading("Stiffness of joints and links"))
        .with(Block::Chart(ratios(found)))
        .with(Block::Table(tables::parameters(found)));
    if let Some(together) = tables::together(found) {
        page = page.with(Block::Table(together));
    }
    page.with(Block::heading("Between subsequent cubes"))
        .with(Block::Chart(pairs(found)))
}

/// Identified stiffness over that of the robot now, with whiskers.
fn ratios(found: &Identified) -> Chart {
    let (mut names, mut values, mut ends) = (Vec::new(), Vec::new(), Vec::new());
    for (parameter, site) in found
        .account
        .parameters
        .iter()
        .zip(&found.account.solved.sites)
    {
        if let (Some(value), Some([low, high])) = (parameter.value, parameter.ci95) {
            names.push(parameter.site.clone());
            values.push(value * site.compliance);
            ends.push([low * site.compliance, high * site.compliance]);
        }
    }
    let beside = beside(found, &names);
    let mut panel = Panel::new(
        Axis::new("Site", ""),
        Axis::new("Identified / robot now", ""),
    )
    .over(names)
    .with(Series::bars("cubes", &values).between(ends));
    if beside.iter().any(|v| !v.is_nan()) {
        panel = panel.with(Series::bars("axis tests", &beside));
    }
    Chart::new(format!("{}-stiffness", found.stem()), "Identified stiffness over that of the robot now", "A bar at 1: the robot file is right; whiskers are 95 % intervals. Sites that the cubes do not fix are left out.")
        .with(panel)
        .synthetic(found.synthetic())
}

/// What axis tests say of these sites, over the robot now; NaN where there is none.
fn beside(found: &Identified, names: &[String]) -> Vec<f64> {
    let value = |name: &String| {
        let test = found.axis_tests.iter().find(|test| test.site == *name)?;
        let sites = &found.account.solved.sites;
        let now = sites.iter().find(|site| site.name == *name)?.compliance;
        Some(test.stiffness.0 * now)
    };
    names.iter().map(|n| value(n).unwrap_or(f64::NAN)).collect()
}

/// Rotation of each pair against the moment there.
fn pairs(found: &Identified) -> Chart {
    let mut panel = Panel::new(
        Axis::new("Moment of the load there", "N·m"),
        Axis::new("Rotation", "mrad"),
    );
    let mut series: Vec<(String, Vec<[f64; 2]>)> = Vec::new();
    for pair in &found.account.relative {
        let name = format!("{} to {}", pair.from, pair.to);
        let point = [norm(pair.moment), norm(pair.rotation) * 1e3];
        match series.iter_mut().find(|(known, _)| *known == name) {
            Some((_, points)) => points.push(point),
            None => series.push((name, vec![point])),
        }
    }
    for (name, points) in series.into_iter().take(8) {
        panel = panel.with(Series::points(name, points));
    }
    Chart::new(format!("{}-pairs", found.stem()), "Rotation between subsequent cubes", "Size of the rotation of a cube against the one before it, over the size of the moment that the load has there: points of one direction lie on a line through zero where what lies between is linear.")
        .with(panel)
        .synthetic(found.synthetic())
}
