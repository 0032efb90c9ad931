//! What these cuts cannot tell, and what was left out.

use super::speed::off_speed;
use super::{Account, CutData};
use crate::cutting::wave::Side;
use crate::fit::parameter::Status;
use crate::measurement::milling_force::{IN_AIR, MillingForce};
use std::f64::consts::TAU;

/// Angle of lag below which the height does not show, rad.
const LAG: f64 = 0.02;
/// Excess of what is left over the stated noise that is worth a word.
const EXCESS: f64 = 1.3;

/// All of them, the most important first.
pub fn remarks(files: &[MillingForce], account: &Account) -> Vec<String> {
    let cuts: Vec<&CutData> = account.cuts.iter().map(|c| &c.data).collect();
    let mut said = Vec::new();
    said.extend(another_speed(account));
    said.extend(another_cut(account));
    said.extend(misfit(account));
    said.extend(open(account));
    said.push("No cut tells a common gain of the dynamometer from larger coefficients, or its turn about z from another ratio of tangential and radial ones: calibrate both by hand.".into());
    said.extend(slots(&cuts));
    said.extend(one_depth(&cuts));
    said.extend(offset(&cuts));
    said.extend(teeth(&cuts));
    said.extend(short(&cuts));
    said.extend(left_out(files, &cuts));
    said
}

fn another_speed(account: &Account) -> Option<String> {
    // where the law does not fit at all, the speed strays with everything else
    let off = off_speed(&account.cuts).filter(|_| !account.leaves_another_cut());
    let (cut, share) = off?;
    let stated = 60.0 / TAU * account.cuts[cut].data.scene.cut.spindle_rad_s;
    Some(format!(
        "The teeth of cut {} pass at {:.0} rpm, and the file states {stated:.0}: the chip of a tooth, which the coefficients stand on, is known from the feed of the table alone then, if that is as stated. Measure the spindle speed and state it.",
        cut + 1,
        stated * (1.0 + share)
    ))
}

fn another_cut(account: &Account) -> Option<String> {
    account.leaves_another_cut().then(|| {
        format!(
            "What the law leaves comes again with every turn and is {:.0} % of the force: no coefficients of the cut that the file states. Check the order and signs of the channels, teeth, helix, side and speed; `ident diagnose` tries what it knows.",
            100.0 * account.repeating
        )
    })
}

fn misfit(account: &Account) -> Option<String> {
    let noise = account.stated_noise?;
    let worst = account.rms.iter().fold(0.0_f64, |m, v| m.max(*v));
    (worst > EXCESS * noise).then(|| {
        format!(
            "What the law leaves, {worst:.2} N, is more than the stated noise of {noise:.2} N: `ident diagnose` names what may be behind it. Intervals count it as noise."
        )
    })
}

fn open(account: &Account) -> Option<String> {
    let open = account.parameters[..6].iter();
    let open = open.filter(|p| p.status == Status::NotIdentifiable);
    let names: Vec<&str> = open.map(|p| p.name.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "These cuts do not fix {}: add cuts at other feeds and widths, or longer records.",
            names.join(", ")
        )
    })
}

fn slots(cuts: &[&CutData]) -> Option<String> {
    let all = cuts.iter().all(|c| c.scene.cut.side == Side::Slot);
    all.then(|| "Full slots do not show the width of cut.".into())
}

fn one_depth(cuts: &[&CutData]) -> Option<String> {
    let same =
        |f: &dyn Fn(&CutData) -> f64| cuts.iter().all(|c| (f(c) / f(cuts[0]) - 1.0).abs() < 1e-6);
    let depth = same(&|c| c.scene.cut.depth_m);
    let lag = cuts.first()?.scene.tool.lag_rad(cuts[0].scene.cut.depth_m);
    match (depth, lag < LAG) {
        (true, true) => Some("One depth without a helix: an error of the depth is one of all coefficients.".into()),
        (true, false) => Some("One depth only: an error of the depth shows by the lag of the helix alone; a second depth would tell it apart.".into()),
        _ => None,
    }
}

fn offset(cuts: &[&CutData]) -> Option<String> {
    let alike = |c: &&CutData| {
        let (a, b) = (&c.scene.cut, &cuts[0].scene.cut);
        a.side == Side::Slot && (a.depth_m / b.depth_m - 1.0).abs() < 1e-6
    };
    let teeth = cuts.first()?.scene.tool.teeth;
    (cuts.iter().all(alike) && teeth.is_multiple_of(2)).then(|| {
        "In slots of one depth an offset of z is the same as Kae: zero the dynamometer before each cut.".into()
    })
}

fn teeth(cuts: &[&CutData]) -> Option<String> {
    let tool = &cuts.first()?.scene.tool;
    let deepest = cuts.iter().map(|c| c.scene.cut.depth_m).fold(0.0, f64::max);
    match (tool.teeth, tool.lag_rad(deepest) < LAG) {
        (1, _) => Some("One tooth shows no runout: it cuts its own surface.".into()),
        (2, true) => Some("Two teeth without a helix show the difference of their radii only, not runout and its angle one by one.".into()),
        _ => None,
    }
}

fn short(cuts: &[&CutData]) -> Option<String> {
    let turns = |c: &CutData| c.scene.time.last().unwrap_or(&0.0) * c.scene.cut.spindle_rad_s / TAU;
    let short = cuts.iter().filter(|c| turns(c) < 1.0).count();
    (short > 0).then(|| format!("{short} cuts are shorter than a revolution."))
}

fn left_out(files: &[MillingForce], cuts: &[&CutData]) -> Option<String> {
    let empty: usize = files.iter().map(|f| f.left_out).sum();
    let settling: usize = cuts.iter().map(|c| c.settling).sum();
    let beyond: usize = cuts.iter().map(|c| c.beyond).sum();
    let air: usize = files.iter().map(|f| f.in_air).sum();
    let beside: usize = cuts.iter().map(|c| c.force.len() - c.rows()).sum();
    (empty + settling + beyond + air + beside > 0).then(|| {
        format!("Left out: {empty} rows for an empty cell, {air} {IN_AIR}, {settling} at the starts of cuts until the low pass has settled, {beyond} at the ends of cuts longer than need be, {beside} beside a jump of the force or where straight teeth begin to scrape.")
    })
}
