//! The tables of an answer.

use crate::findings::answer::LIMIT;
use crate::findings::gain::Gain;
use crate::findings::sentence::{candidates, probability, spoken};
use crate::findings::{Answer, Cause};
use crate::sheet::number::engineering;
use crate::sheet::table::Table;

/// Causes and groups with their gains.
pub fn causes_table(answer: &Answer) -> Table {
    let header = [
        "cause",
        "site",
        "probability",
        "parameters",
        "error without",
        "with it",
        "reduction [95 %]",
    ];
    let mut table = Table::new("Causes, with the error on data held out of the fit", header)
        .numeric([2, 4, 5, 6]);
    let unit = answer.unit;
    for cause in &answer.causes {
        table.push([
            spoken(cause.effect),
            cause.site.clone(),
            probability(cause.probability),
            amounts(cause),
            engineering(cause.gain.before, 3, unit),
            engineering(cause.gain.after, 3, unit),
            reduction(&cause.gain),
        ]);
    }
    for group in &answer.groups {
        table.push([
            candidates(group),
            distinct(&group.sites),
            "not told apart".into(),
            String::new(),
            engineering(group.gain.before, 3, unit),
            engineering(group.gain.after, 3, unit),
            reduction(&group.gain),
        ]);
    }
    table
}

fn distinct(sites: &[String]) -> String {
    let mut sites = sites.to_vec();
    sites.dedup();
    sites.join(", ")
}

/// The parameters of a cause, as `gap 216 µrad, contact load 7.57 N·m`; one that is gone shows its limit.
pub fn amounts(cause: &Cause) -> String {
    let amount = |(name, value, unit): &(&str, f64, &str)| {
        let amount = |v: f64| engineering(v, 3, if *unit == "1" { "" } else { unit });
        match (*value, cause.limit()) {
            (0.0, Some(limit)) => format!("{} < {}", spoken(name), amount(limit)),
            _ => match cause.interval(name) {
                Some([low, high]) => format!(
                    "{} {} [{}, {}]",
                    spoken(name),
                    amount(*value),
                    amount(low),
                    amount(high)
                ),
                None => format!("{} {}", spoken(name), amount(*value)),
            },
        }
    };
    let printed = cause.parameters.iter().filter(|(name, ..)| *name != LIMIT);
    printed.map(amount).collect::<Vec<_>>().join(", ")
}

/// What naming a cause gains, as `91.0 % [90.5, 91.4]`.
pub fn reduction(gain: &Gain) -> String {
    format!(
        "{:.1} % [{:.1}, {:.1}]",
        gain.reduction_percent, gain.ci95_percent[0], gain.ci95_percent[1]
    )
}

/// The sets of causes that were compared.
pub fn candidates_table(answer: &Answer) -> Table {
    let mut table = Table::new(
        "Sets of causes, most probable first",
        ["causes", "probability", "misfit explained in nats"],
    )
    .numeric([1, 2]);
    for (causes, probability, nats) in &answer.candidates {
        let name = if causes.is_empty() {
            "none".to_string()
        } else {
            spoken(&causes.join(" + "))
        };
        table.push([
            name,
            match 100.0 * probability {
                p if p < 0.01 => "< 0.01 %".into(),
                p => format!("{p:.2} %"),
            },
            format!("{nats:.1}"),
        ]);
    }
    table
}
