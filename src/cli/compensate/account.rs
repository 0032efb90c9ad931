//! What `ident compensate` says in words.

use super::Written;
use crate::compensation::corrected::{Corrected, Met};
use crate::compensation::proof::Checked;
use crate::compensation::remaining::Size;
use crate::sheet::number::significant;

/// The account on standard output.
pub fn text(result: &Corrected, written: &Written) -> String {
    let mut said: String = sentences(result).into_iter().map(|s| s + "\n").collect();
    for file in [&written.path, &written.program, &written.report]
        .into_iter()
        .flatten()
    {
        said.push_str(&format!("wrote {}\n", file.display()));
    }
    said
}

/// The result in a few sentences.
pub fn sentences(result: &Corrected) -> Vec<String> {
    let mm = |x: f64| significant(1e3 * x, 3);
    let worse = result.after.max_m > result.before.max_m;
    let (moves, than) = if worse {
        ("rises", "more")
    } else {
        ("falls", "less")
    };
    let fell = result.reduction_percent().map_or(String::new(), |percent| {
        format!(", {} % {than}", significant(percent.abs(), 3))
    });
    let left = match result.certainty.ci95 {
        Some([low, high]) => {
            let of = if result.plant.is_some() {
                " without the plant"
            } else {
                ""
            };
            format!(" (95 %{of}: {} to {} mm)", mm(low), mm(high))
        }
        None => String::new(),
    };
    let mut said = vec![format!(
        "The largest deviation from the drawn path {moves} from {} to {} mm{left}{fell}.",
        mm(result.before.max_m),
        mm(result.after.max_m)
    )];
    let found = &result.found;
    let state = match found.converged {
        true => format!("after {} iterations", found.iterations),
        false => format!(
            "not converged: after {} iterations it still changes by {} mm",
            found.iterations,
            mm(found.last_change_m)
        ),
    };
    said.push(format!(
        "Correction by {}, {state}; {} mm at most.",
        result.method.name,
        mm(found.correction.largest().0)
    ));
    if result.slowed {
        said.push(
            "Rapid motions run at the feed of the cuts: the robot would still swing from them when it cuts."
                .into(),
        );
    }
    said.push(verdict(result));
    said.extend(limited(result));
    said.extend(result.checked.iter().filter(|c| !c.ok).map(failed));
    said
}

fn verdict(result: &Corrected) -> String {
    let Some(tolerance) = result.planned.job.limits.tolerance else {
        return "The job states no tolerance_mm: whether the part is good is not certain.".into();
    };
    let tolerance = significant(1e3 * tolerance, 3);
    match result.met {
        Met::Yes if !result.is_proven() => format!(
            "The part would be within its {tolerance} mm, but the path breaks a limit: do not run it."
        ),
        Met::Yes => format!("The part will be within its {tolerance} mm."),
        Met::No => format!("The part will not be within its {tolerance} mm."),
        Met::NotCertain => {
            format!("Whether the part will be within its {tolerance} mm is not certain.")
        }
    }
}

/// What limits the accuracy, and what to measure next.
fn limited(result: &Corrected) -> Option<String> {
    let certainty = &result.certainty;
    let (limit, next) = (certainty.limits.first()?, certainty.next.as_ref()?);
    let mm = |x: f64| significant(1e3 * x, 3);
    Some(format!(
        "What limits it most is {} of {} (one standard deviation: {} mm); to lower the upper end to {} mm: {}.",
        limit.doubt.name,
        limit.doubt.site,
        mm(limit.change_m),
        mm(next.high_after_m),
        next.what
    ))
}

/// One check that failed.
fn failed(c: &Checked) -> String {
    format!(
        "{} of {}: {} {}, allowed {}, at {:.1} mm of the path.",
        c.what,
        c.site,
        significant(c.worst, 4),
        c.unit,
        c.limit.map_or("–".into(), |l| significant(l, 4)),
        1e3 * c.s_m
    )
}

/// More than rounding.
const ROUNDING: f64 = 1.0 + 1e-6;

/// What the reader should know.
pub fn remarks(result: &Corrected) -> Vec<String> {
    let mut said = Vec::new();
    if result.doubts.is_empty() {
        said.push(
            "neither the robot nor the material states how well it is known: no interval, nothing is certain"
                .to_string(),
        );
    }
    if result.plant_mills_else() {
        said.push(
            "the job of --plant mills something else (path, feed, tool or stock): only its robot and its material are taken"
                .into(),
        );
    }
    if result.after.max_m > ROUNDING * result.before.max_m {
        said.push(
            "the corrected path leaves more than the programmed one: do not run it; try another --method, or plunge more gently".into(),
        );
    }
    if result.checked.iter().any(|c| !c.ok) {
        said.push("the corrected path exceeds a limit that was checked: do not run it".into());
    }
    if !result.found.converged && result.met != Met::Yes {
        said.push(format!(
            "the mirror does not converge: trials still change the correction by {} mm, and the best of them is kept",
            significant(1e3 * result.found.last_change_m, 2)
        ));
    }
    let is_beside =
        |(name, left): &(&str, Vec<_>)| (*left == result.stations[1]).then(|| name.to_string());
    let others = result
        .beside
        .iter()
        .map(|(name, left)| (name, Size::of(left).max_m));
    for (name, left) in others.filter(|other| ROUNDING * other.1 < result.after.max_m) {
        let left = significant(1e3 * left, 3);
        said.push(format!("`{name}` leaves less here, {left} mm: use it"));
    }
    if let Some(name) = result.beside.as_ref().and_then(is_beside) {
        said.push(format!(
            "the simulated force is used nowhere, since it differs too little from the measured one: this is `{name}`"
        ));
    }
    match &result.chatter {
        Some(chatter) => said.extend(chatter.remarks()),
        None => said.extend(result.not_cut.iter().cloned()),
    }
    said
}
