//! What `ident plan` says in words.

use super::json::{stops, tangential};
use super::{Planned, Written};
use crate::measurement::job::Turning;
use crate::path::element::Element;
use crate::planning::exceeded::Exceeded;
use crate::sheet::number::significant;

/// The account on standard output.
pub fn text(planned: &Planned, written: &Written) -> String {
    let mut said: String = sentences(planned)
        .into_iter()
        .map(|sentence| sentence + "\n")
        .collect();
    for exceeded in &planned.plan.exceeded {
        said.push_str(&format!("{}\n", told(exceeded)));
    }
    let files = [&written.trajectory, &written.program, &written.report];
    for file in files.into_iter().flatten() {
        said.push_str(&format!("wrote {}\n", file.display()));
    }
    said
}

/// The plan in a few sentences.
pub fn sentences(planned: &Planned) -> Vec<String> {
    let (plan, path) = (&planned.plan, &planned.plan.path);
    let mut said = vec![format!(
        "{} m in {} s: {} points, {} lines, {} arcs and curves, {} blends, {} stops; {} rows every {} ms.",
        significant(path.length, 4),
        significant(plan.timeline.duration, 5),
        path.programme.points,
        path.lines(),
        path.programme.elements.len() - path.lines(),
        path.blends(),
        stops(plan),
        plan.rows.len(),
        significant(plan.cycle * 1e3, 3)
    )];
    let corners = significant(path.max_deviation() * 1e3, 3);
    said.push(match path.programme.elements.iter().all(|e| e.rapid) {
        true => format!("Corners are passed at {corners} mm at most. All of it is rapid motion."),
        false => format!(
            "Corners are passed at {corners} mm at most. The asked feed of {} mm/s is held on {} % of the length, the lowest is {} mm/s.",
            significant(plan.feed.asked * 1e3, 4),
            significant(100.0 * plan.feed.held_share, 4),
            significant(plan.feed.min * 1e3, 4)
        ),
    });
    let busiest = plan.joints.iter().filter_map(|joint| {
        let limit = joint.speed_limit?;
        Some((joint, 100.0 * joint.max_speed / limit))
    });
    if let Some((joint, share)) = busiest.max_by(|a, b| a.1.total_cmp(&b.1)) {
        said.push(format!(
            "{} uses most of its speed: {} %.",
            joint.site,
            significant(share, 3)
        ));
    }
    if plan.feed.eased < 1.0 {
        said.push(format!(
            "Acceleration and jerk along the path are lowered to {} % for the accelerations of the joints.",
            significant(100.0 * plan.feed.eased, 3)
        ));
    }
    if let Some([carried, chosen]) = plan.compliance {
        said.push(format!(
            "Normal to the path the robot gives way by {} µm/N on average with the chosen turn about the spindle, by {} with the fixed one.",
            significant(chosen * 1e6, 4),
            significant(carried * 1e6, 4)
        ));
    }
    said
}

/// One limit exceeded.
pub fn told(exceeded: &Exceeded) -> String {
    let place = format!(
        "at {} s, line {} of the path",
        significant(exceeded.at, 4),
        exceeded.line
    );
    let (value, limit) = (
        significant(exceeded.value, 4),
        significant(exceeded.limit, 4),
    );
    let site = &exceeded.site;
    match exceeded.what {
        "joint-speed" => format!("{site} is too fast {place}: {value} deg/s, {limit} are allowed."),
        "joint-acceleration" => format!(
            "{site} would have to accelerate too hard {place}: {value} deg/s², {limit} are allowed."
        ),
        "joint-angle" => {
            format!("{site} leaves its range {place}: {value} deg, the limit is {limit}.")
        }
        _ => format!(
            "The {site} is {value} deg from its singularity {place}, where joints are too fast."
        ),
    }
}

/// What a reader should know and need not act on.
pub fn remarks(planned: &Planned) -> Vec<String> {
    let path = &planned.plan.path;
    let mut all = Vec::new();
    let mut shrunk = path.corners.iter().filter(|c| c.is_shrunk());
    if let Some(first) = shrunk.next() {
        all.push(format!(
            "{} blends are shorter than asked because their lines are, the first at line {} ({} instead of {} mm)",
            shrunk.count() + 1,
            first.line,
            significant(first.radius * 1e3, 3),
            significant(first.asked * 1e3, 3)
        ));
    }
    let turns = path.programme.elements.iter().any(Element::turns);
    if turns && planned.job.orientation != Turning::Whole {
        all.push("the tool is planned to turn about the corners; a controller that runs the program turns it over the whole of each line: `orientation = \"whole\"` plans that motion".into());
    }
    if path.programme.duplicates > 0 {
        let count = path.programme.duplicates;
        all.push(format!("{count} repeated points were left out"));
    }
    let tangential = tangential(&planned.plan);
    if tangential > 0 {
        all.push(format!(
            "{tangential} arcs or curves are met tangentially: the curvature jumps there, nothing is blended"
        ));
    }
    for [t, s] in &planned.plan.passages {
        all.push(format!(
            "line {}: A5 passes through zero at {} s (wrist singularity, passed straight)",
            path.line(*s),
            significant(*t, 4)
        ));
    }
    let passed_over = planned.toolpath.passed_over.iter();
    all.extend(passed_over.map(|p| format!("{} passed over ({})", p.what, p.count)));
    all
}
