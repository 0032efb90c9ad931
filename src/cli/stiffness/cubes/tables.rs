//! The sentence and the tables of measuring cubes.

use super::Identified;
use crate::sheet::number::{ABSENT, engineering, fixed, prefix, significant};
use crate::sheet::table::Table;

/// What was found, in one sentence.
pub fn sentence(found: &Identified) -> String {
    let solved = &found.account.solved;
    let label = if found.synthetic() {
        " (synthetic)"
    } else {
        ""
    };
    let [before, after] = solved.rms;
    let um = |m: f64| significant(m * 1e6, 3);
    format!(
        "{}{label}: {} of {} stiffnesses of {} identified from {} numbers; left {} µm and {} µrad (before {} µm and {} µrad).",
        found.stem(),
        found.identified(),
        solved.sites.len(),
        found.base.robot.name,
        solved.readings,
        um(after[0]),
        um(after[1]),
        um(before[0]),
        um(before[1])
    )
}

/// Every site beside what the robot has now, and what axis tests of the campaign say.
pub fn parameters(found: &Identified) -> Table {
    let mut header = vec![
        "site",
        "stiffness",
        "95 % interval",
        "± %",
        "robot now",
        "change %",
    ];
    if !found.axis_tests.is_empty() {
        header.push("axis test");
    }
    let mut table = Table::new("Identified stiffness", header).numeric([1, 2, 3, 4, 5, 6]);
    for (parameter, site) in found
        .account
        .parameters
        .iter()
        .zip(&found.account.solved.sites)
    {
        let now = 1.0 / site.compliance;
        let value = parameter
            .value
            .map_or("not identifiable".into(), |v| engineering(v, 4, "N·m/rad"));
        let interval = parameter.ci95.map_or(ABSENT.into(), |[low, high]| {
            let (factor, unit) = prefix(high, "N·m/rad");
            format!(
                "{} to {} {unit}",
                significant(low * factor, 4),
                significant(high * factor, 4)
            )
        });
        let half = parameter
            .ci95
            .zip(parameter.value)
            .map(|([low, high], v)| 50.0 * (high - low) / v);
        let change = parameter.value.map(|v| 100.0 * (v / now - 1.0));
        let percent = |x: Option<f64>, decimals| x.map_or(ABSENT.into(), |x| fixed(x, decimals));
        let mut row = vec![
            parameter.site.clone(),
            value,
            interval,
            percent(half, 2),
            engineering(now, 4, "N·m/rad"),
            percent(change, 1),
        ];
        if !found.axis_tests.is_empty() {
            let test = found
                .axis_tests
                .iter()
                .find(|test| test.site == parameter.site);
            row.push(test.map_or(ABSENT.into(), |test| {
                engineering(test.stiffness.0, 4, "N·m/rad")
            }));
        }
        table.push(row);
    }
    let solved = &found.account.solved;
    let from = |k: usize| {
        if solved.estimated[k] {
            "from the residuals"
        } else {
            "as stated"
        }
    };
    table.noted(format!(
        "noise: {} µm ({}), {} µrad ({})",
        significant(solved.noise[0] * 1e6, 3),
        from(0),
        significant(solved.noise[1] * 1e6, 3),
        from(1)
    ))
}

/// Sites seen together only.
pub fn together(found: &Identified) -> Option<Table> {
    let groups = &found.account.together;
    if groups.is_empty() {
        return None;
    }
    let mut table = Table::new(
        "Seen together only",
        ["sites", "stiffness in series", "95 % interval"],
    )
    .numeric([1, 2]);
    for group in groups {
        let (value, interval) = match group.stiffness {
            None => ("not about one axis".to_string(), ABSENT.to_string()),
            Some((value, [low, high])) => {
                let (factor, unit) = prefix(high, "N·m/rad");
                (
                    engineering(value, 4, "N·m/rad"),
                    format!(
                        "{} to {} {unit}",
                        significant(low * factor, 4),
                        significant(high * factor, 4)
                    ),
                )
            }
        };
        table.push([group.sites.join(" + "), value, interval]);
    }
    Some(table)
}
