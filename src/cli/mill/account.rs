//! What `ident mill` says in words.

use super::{Driven, Result, Written};
use crate::compensation::corrected::Met;
use crate::ground::spatial::norm;
use crate::process::run::NOTHING_CUT;
use crate::process::setup::Support;
use crate::sheet::number::{significant, with_interval};

/// The account on standard output.
pub fn text(result: &Result, written: &Written) -> String {
    let mut said: String = sentences(result).into_iter().map(|s| s + "\n").collect();
    for file in [&written.course, &written.report].into_iter().flatten() {
        said.push_str(&format!("wrote {}\n", file.display()));
    }
    said
}

/// The result in a few sentences.
pub fn sentences(result: &Result) -> Vec<String> {
    let milled = &result.milled;
    let mut said = vec![format!(
        "{} mm³ removed in {} s, {} s of it in the cut; force {} N at most, on average {} N.",
        significant(milled.removed_m3 * 1e9, 5),
        significant(milled.duration_s, 4),
        significant(milled.cutting_s, 4),
        significant(milled.peak_n, 4),
        significant(milled.mean_size_n, 4),
    )];
    said.extend(result.driven.as_ref().map(driven));
    said.extend(deviation(result));
    said.push(steps(result));
    said
}

fn driven(driven: &Driven) -> String {
    let [max, rms] = driven.recorded.off_path().map(|x| significant(1e3 * x, 3));
    format!(
        "Recorded joint angles lead the tool beside the path by {max} mm at most, {rms} mm root mean square; that counts as deviation, and the robot bends beside it."
    )
}

fn deviation(result: &Result) -> Option<String> {
    if result.support == Support::Rigid && result.driven.is_none() {
        return Some("The robot counts as rigid: no deviation.".into());
    }
    let worst = result.worst.as_ref()?;
    let mm = 1e3 * worst.size;
    let size = match worst.ci95 {
        Some([low, high]) => with_interval(mm, 1e3 * low, 1e3 * high),
        None => significant(mm, 3),
    };
    let rms = result.milled.rms(|cut| norm(cut.deviation));
    let place = 1e3 * result.milled.course[worst.station].s_m;
    let mut said = format!(
        "Largest deviation {size} mm at {place:.1} mm of the path, root mean square {} mm.",
        significant(1e3 * rms, 3)
    );
    said.extend(verdict(result));
    Some(said)
}

fn verdict(result: &Result) -> Option<String> {
    let allowed = significant(1e3 * result.planned.job.limits.tolerance?, 3);
    let allowed = format!("the {allowed} mm that the part allows");
    Some(match result.met()? {
        Met::Yes => format!(" That is within {allowed}."),
        Met::No => format!(" That is beyond {allowed}."),
        Met::NotCertain => format!(" Whether that is within {allowed} is not certain."),
    })
}

fn steps(result: &Result) -> String {
    let milled = &result.milled;
    let energy = milled.energy.map_or(String::new(), |energy| {
        format!(
            "; of the energy {} % is not accounted for",
            significant(100.0 * energy.gap(), 2)
        )
    });
    match result.support {
        Support::Coupled => format!(
            "Robot and cut coupled in {} steps, {} µs in the cut{energy}.",
            milled.steps,
            significant(1e6 * milled.step_s, 3)
        ),
        _ => format!("{} steps, one per tooth in the cut.", milled.steps),
    }
}

/// What the reader should know.
pub fn remarks(result: &Result) -> Vec<String> {
    let mut said = Vec::new();
    let elastic = result.support != Support::Rigid;
    if elastic && result.asked && result.doubts.is_empty() {
        said.push(
            "neither the robot nor the material states how well it is known: no interval"
                .to_string(),
        );
    }
    let left_out = result.driven.as_ref().map_or(0, |d| d.joints.left_out);
    if left_out > 0 {
        said.push(format!(
            "{left_out} rows of the recorded joint angles are left out for an empty cell"
        ));
    }
    if let Some(s) = result.ends_at() {
        said.push(format!(
            "the recorded joint angles end at {} of {} mm of the path: what it cuts beyond that is not milled, and not judged",
            significant(1e3 * s, 4),
            significant(1e3 * result.planned.plan.path.length, 4)
        ));
    }
    if result.milled.removed_m3 == 0.0 {
        said.push(NOTHING_CUT.join(": "));
    }
    if let Some(s) = result.cut_in_rapid() {
        said.push(format!(
            "line {} of the path: a rapid motion cuts, from {} mm of the path on: do not run it; move above the stock, or at the feed",
            result.planned.plan.path.line(s),
            significant(1e3 * s, 4)
        ));
    }
    match &result.chatter {
        Some(chatter) => said.extend(chatter.remarks()),
        None => said.extend(result.milled.not_cut()),
    }
    if result.support != Support::Coupled && result.step_asked {
        said.push(
            "--step-us has no effect: without masses a step is the passing of a tooth".into(),
        );
    }
    if result.planned.toolpath.corrected {
        said.push("the path is a corrected one: its deviations are from the corrected commands, not from the part that was drawn; `ident compensate` judges the part".to_string());
    }
    for exceeded in &result.planned.plan.exceeded {
        said.push(format!(
            "the plan exceeds a limit: {} of {} at {:.3} s",
            exceeded.what, exceeded.site, exceeded.at
        ));
    }
    said
}
