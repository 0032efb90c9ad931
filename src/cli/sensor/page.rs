//! The report page of `ident sensor`.

use super::{Identified, tables};
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::page::{Block, Page, Tone};

/// The page.
pub fn page(found: &Identified) -> Page {
    let subtitle = format!("{} orientations", found.account.poses.len());
    let mut page = Page::new(format!("Force sensor {}", found.stem()), subtitle);
    page.synthetic = found.synthetic();
    page = page.with(Block::verdict(Tone::Neutral, tables::sentence(found)));
    for remark in found.remarks() {
        let mut letters = remark.chars();
        let first = letters
            .next()
            .map(|c| c.to_uppercase().to_string())
            .unwrap_or_default();
        page = page.with(Block::verdict(
            Tone::Attention,
            format!("{first}{}.", letters.as_str()),
        ));
    }
    page.with(Block::Table(tables::parameters(found)))
        .with(Block::heading("What is left over the orientations"))
        .with(Block::Chart(left(found)))
        .with(Block::heading("What to measure next"))
        .with(Block::Table(tables::next(found)))
}

/// Residuals of forces and moments before and after the polynomial, orientation by orientation.
fn left(found: &Identified) -> Chart {
    let account = &found.account;
    let mut chart = Chart::new(
        format!("{}-left", found.stem()),
        "What is left of forces and moments",
        "Readings less the weight and offsets (lines), and less the polynomial over the orientation too (points); what repeats from axis to axis is a hose or a wrong model, what does not is noise.",
    )
    .synthetic(found.synthetic());
    for (kind, unit, names) in [(0, "N", ["Fx", "Fy", "Fz"]), (1, "N·m", ["Mx", "My", "Mz"])] {
        let quantity = if kind == 0 {
            "Force left"
        } else {
            "Moment left"
        };
        let mut panel = Panel::new(Axis::new("Orientation", ""), Axis::new(quantity, unit));
        for (c, name) in names.iter().enumerate() {
            let channel = 3 * kind + c;
            let (mut before, mut after) = (Vec::new(), Vec::new());
            for (i, (pose, residual)) in account
                .poses
                .iter()
                .zip(&account.fitted.residual)
                .enumerate()
            {
                let x = (i + 1) as f64;
                before.push([x, residual[channel]]);
                after.push([
                    x,
                    residual[channel] - account.remainder.at(pose.quaternion)[channel],
                ]);
            }
            panel = panel.with(Series::line(*name, before));
            if account.remainder.order > 0 {
                panel = panel.with(Series::points(format!("{name}, after"), after));
            }
        }
        chart = chart.with(panel);
    }
    chart
}
