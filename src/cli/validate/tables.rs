//! What `ident validate` says: sentences and tables.

use super::Validated;
use crate::fit::parameter::{Identified, Status};
use crate::fit::validation::{Comparison, Validation};
use crate::sheet::number::{ABSENT, fixed, significant};
use crate::sheet::page::Tone;
use crate::sheet::table::Table;

/// What an engineer shall take away, the most important first.
pub fn sentences(validated: &Validated) -> Vec<(Tone, String)> {
    let found = &validated.found;
    let mut said = vec![judgement(found)];
    said.extend(tilt(found).map(|s| (Tone::Neutral, s)));
    said.extend(after(found).map(|s| (Tone::Neutral, s)));
    said
}

fn judgement(found: &Validation) -> (Tone, String) {
    let Some((mean, max)) = found.errors(|c| c.simulated) else {
        return (
            Tone::Bad,
            "No point gives a stiffness: there is nothing to compare.".into(),
        );
    };
    let agree: Vec<bool> = found
        .comparisons
        .iter()
        .filter_map(Comparison::agrees)
        .collect();
    let inside = agree.iter().filter(|a| **a).count();
    let tone = match 10 * inside >= 8 * agree.len() {
        true => Tone::Good,
        false => Tone::Attention,
    };
    let mm = found
        .comparisons
        .iter()
        .filter_map(|c| c.error_m(c.simulated));
    let worst = mm.fold(0.0_f64, |m, e| m.max(e.abs())) * 1e3;
    let sentence = format!(
        "The simulated stiffness differs from the measured one by {} % on average and {} % at most ({} mm at 750 N); {inside} of {} simulated values lie inside the measured 95 % intervals.",
        fixed(mean, 1),
        fixed(max, 1),
        fixed(worst, 2),
        agree.len()
    );
    (tone, sentence)
}

fn tilt(found: &Validation) -> Option<String> {
    let (mean, _) = found.errors(|c| c.without_tilt)?;
    let ratios = [0, 1, 2].map(|d| {
        found
            .tilt_ratio(d)
            .map_or(ABSENT.into(), |r| format!("{r:.1}"))
    });
    let [x, y, z] = ratios;
    Some(format!(
        "Without tilt axes the simulation is {} % off on average: too stiff by factors of {x}, {y} and {z} in x, y and z.",
        fixed(mean, 0)
    ))
}

fn after(found: &Validation) -> Option<String> {
    let (mean, _) = found.errors(|c| c.refitted)?;
    Some(format!(
        "With the re-identified stiffnesses {} % are left on average.",
        fixed(mean, 1)
    ))
}

/// All tables in reading order.
pub fn all(validated: &Validated) -> Vec<Table> {
    vec![
        points(validated),
        parameters(validated),
        inseparable(&validated.found),
    ]
}

fn label(validated: &Validated, title: &str) -> String {
    match validated.test.facts.synthetic {
        true => format!("{title} (synthetic data)"),
        false => title.into(),
    }
}

/// Measured beside simulated, N/mm.
pub fn points(validated: &Validated) -> Table {
    let header = [
        "point",
        "measured N/mm",
        "simulated",
        "error %",
        "mm at 750 N",
        "without tilt",
        "error %",
    ];
    let mut table = Table::new(label(validated, "Stiffness at the points"), header).numeric(1..7);
    for c in &validated.found.comparisons {
        let percent = |k: f64| c.error_percent(k).map_or(ABSENT.into(), |e| fixed(e, 1));
        let mm = c
            .error_m(c.simulated)
            .map_or(ABSENT.into(), |e| fixed(1e3 * e, 3));
        table.push([
            c.name(),
            measured(c),
            fixed(1e-3 * c.simulated, 1),
            percent(c.simulated),
            mm,
            fixed(1e-3 * c.without_tilt, 1),
            percent(c.without_tilt),
        ]);
    }
    table.noted("measured ± half of the 95 % interval; error: simulated over measured; mm: simulated less measured deflection")
}

fn measured(c: &Comparison) -> String {
    match (c.measured.value, c.measured.ci95) {
        (Some(value), Some([low, high])) => {
            format!(
                "{} ± {}",
                fixed(1e-3 * value, 1),
                fixed(0.5e-3 * (high - low), 1)
            )
        }
        _ => "not identifiable".into(),
    }
}

/// The re-identified stiffnesses.
pub fn parameters(validated: &Validated) -> Table {
    let refit = &validated.found.refit;
    let header = [
        "site",
        "known before",
        "from",
        "now",
        "learned from the points",
    ];
    let mut table = Table::new(
        label(validated, "Re-identified stiffness, MN·m/rad"),
        header,
    )
    .numeric([1, 3, 4]);
    for (i, parameter) in validated.found.parameters().iter().enumerate() {
        let prior = &refit.priors[i];
        table.push([
            parameter.site.clone(),
            format!(
                "{} ± {} %",
                significant(1e-6 * prior.stiffness, 4),
                significant(196.0 * prior.rel_std, 2)
            ),
            if prior.measured {
                "axis test"
            } else {
                "nominal"
            }
            .to_string(),
            now(parameter),
            format!("{:.0} %", 100.0 * refit.learned(i)),
        ]);
    }
    table.noted("± half of the 95 % interval; learned: share of the prior's variance that the points took away")
}

fn now(parameter: &Identified) -> String {
    match (parameter.value, parameter.ci95, parameter.status) {
        (Some(value), Some([low, high]), _) => format!(
            "{} ± {} %",
            significant(1e-6 * value, 4),
            significant(50.0 * (high - low) / value, 2)
        ),
        (_, _, Status::AtBound) => "rigid (at bound)".into(),
        _ => "not identifiable".into(),
    }
}

/// What the points cannot separate.
pub fn inseparable(found: &Validation) -> Table {
    let mut table = Table::new(
        "What these points alone cannot separate",
        ["sites", "why", "what would tell"],
    );
    for group in &found.groups {
        let why = match group.weights.is_empty() {
            true => format!("{} ({})", group.kind.name(), significant(group.measure, 4)),
            false if group.measure > 1e6 => group.kind.name().to_string(),
            false => format!(
                "{} (± {} %)",
                group.kind.name(),
                significant(196.0 * group.measure, 2)
            ),
        };
        table.push([group.sites.join(", "), why, group.would_tell.clone()]);
    }
    table.noted("without any prior; the foundation (base-x, -y, -z) is looked at even where the model has none; exact and near: cosine between the responses; combination: interval of the weighted sum that stays open")
}
