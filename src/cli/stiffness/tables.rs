//! The tables of `ident stiffness`.

use super::Result;
use crate::fit::parameter::{Identified, Z95};
use crate::fit::stiffness::Account;
use crate::measurement::load_cycle::Port;
use crate::sheet::number::{ABSENT, fixed, prefix, significant};
use crate::sheet::table::Table;

/// Columns of the table: heading, parameter name.
const COLUMNS: &[(&str, &str)] = &[
    ("stiffness", "stiffness"),
    ("backlash", "backlash"),
    ("loss per cycle", "hysteresis_loss"),
    ("loss factor", "loss_factor"),
];

/// One table for each kind of quantity: joints that turn, springs that are pressed.
pub fn tables(results: &[&Result]) -> Vec<Table> {
    let of = |port: Port| results.iter().copied().filter(move |r| r.file.port == port);
    [Port::Rotational, Port::Linear]
        .into_iter()
        .map(|port| of(port).collect::<Vec<_>>())
        .filter(|results| !results.is_empty())
        .map(|results| table(&results))
        .collect()
}

fn table(results: &[&Result]) -> Table {
    let found = |r: &Result, name: &str| {
        let parameters = &r.account.parameters;
        parameters.iter().find(|p| p.name == name).cloned()
    };
    let units: Vec<(f64, String)> = COLUMNS
        .iter()
        .map(|(_, name)| unit(results.iter().filter_map(|r| found(r, name))))
        .collect();
    let mut header = vec!["file".to_string(), "site".to_string()];
    for ((heading, _), (_, unit)) in COLUMNS.iter().zip(&units) {
        header.extend([format!("{heading} {unit}").trim().to_string(), "± %".into()]);
    }
    let stiffness = &units[0];
    header.insert(4, format!("nominal {}", stiffness.1));
    header.push("straight line".into());
    let synthetic = results.iter().any(|r| r.file.facts.synthetic);
    let label = if synthetic { " (synthetic data)" } else { "" };
    let title = format!("Identified stiffness{label}");
    let numeric: Vec<usize> = (2..header.len()).collect();
    let mut table = Table::new(title, header).numeric(numeric);
    for result in results {
        let mut cells = vec![result.file.stem(), result.file.site()];
        for ((_, name), (factor, _)) in COLUMNS.iter().zip(&units) {
            cells.extend(cell(found(result, name).as_ref(), *factor));
        }
        let nominal = result.file.facts.nominal_stiffness;
        cells.insert(
            4,
            nominal.map_or(ABSENT.into(), |k| significant(k * stiffness.0, 4)),
        );
        let line = straight_difference(&result.account);
        cells.push(line.map_or(ABSENT.into(), signed_percent));
        table.push(cells);
    }
    let parts = results.iter().filter_map(|r| parts(r));
    let parts: Vec<String> = parts.collect();
    let table = match parts.is_empty() {
        true => table,
        false => table.noted(format!(
            "± % of the stiffness by readings and by levers: {}",
            parts.join(", ")
        )),
    };
    table
        .noted(format!(
            "± %: half of the 95 % interval, levers included; <: 95 % limit of what was not found; {ABSENT}: not known"
        ))
        .noted("straight line: by how much a line through all readings misses the stiffness")
}

/// `axis6 0.12 and 0.55`: what the interval of the stiffness is made of.
fn parts(result: &Result) -> Option<String> {
    let stiffness = result.account.parameters.first()?;
    let (value, parts) = (stiffness.value?, stiffness.parts?);
    let percent = |std: f64| significant(100.0 * Z95 * std / value.abs(), 2);
    Some(format!(
        "{} {} and {}",
        result.file.stem(),
        percent(parts.readings),
        percent(parts.levers)
    ))
}

/// `+1.2 %`, `-1.2 %`, and `0.0 %` for what rounds to it.
fn signed_percent(value: f64) -> String {
    match fixed(value, 1) {
        text if value > 0.0 && text != "0.0" => format!("+{text} %"),
        text => format!("{text} %"),
    }
}

/// Factor and unit in which the smallest value of a column is shown; the others have the same.
fn unit(parameters: impl Iterator<Item = Identified>) -> (f64, String) {
    let mut smallest: Option<(f64, String)> = None;
    for parameter in parameters {
        let value = parameter.value.or(parameter.limit95).map_or(0.0, f64::abs);
        let less = smallest.as_ref().is_none_or(|s| value < s.0 || s.0 == 0.0);
        if smallest.is_none() || (less && value > 0.0) {
            smallest = Some((value, parameter.unit));
        }
    }
    match smallest {
        Some((_, unit)) if unit == "1" => (1.0, String::new()),
        Some((value, unit)) => prefix(value, &unit),
        None => (1.0, String::new()),
    }
}

/// Value and half of its interval in percent.
fn cell(parameter: Option<&Identified>, factor: f64) -> [String; 2] {
    let Some(parameter) = parameter else {
        return [ABSENT.into(), String::new()];
    };
    match (parameter.value, parameter.ci95, parameter.limit95) {
        (Some(value), Some([low, high]), _) => {
            let half = 50.0 * (high - low) / value.abs();
            [significant(value * factor, 4), significant(half, 2)]
        }
        (None, _, Some(limit)) => [
            format!("< {}", significant(limit * factor, 2)),
            String::new(),
        ],
        _ => [ABSENT.into(), String::new()],
    }
}

/// A number, if it is one.
pub fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// By how many percent a line through all readings misses the stiffness.
pub fn straight_difference(account: &Account) -> Option<f64> {
    let fitted = account.parameters.first()?.value?;
    finite(100.0 * (account.straight / fitted - 1.0))
}
