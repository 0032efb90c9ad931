//! The report page of `ident stiffness`.

use super::Result;
use super::tables::tables;
use crate::experiments::load_cycle::Curves;
use crate::fit::parameter::Status;
use crate::fit::stiffness::Account;
use crate::ground::stats::difference;
use crate::sheet::chart::Chart;
use crate::sheet::number::{ABSENT, engineering, prefix, significant};
use crate::sheet::page::{Block, Page};
use crate::sheet::table::Table;

/// The report: the stiffnesses beside the nominal ones, then each file with its figure.
pub fn page(results: &[&Result]) -> Page {
    let first = results[0];
    let title = match results {
        [one] => format!("Stiffness of {}", one.file.stem()),
        _ => "Identified stiffness".into(),
    };
    let subtitle = match (results, first.place.campaign.as_str()) {
        ([one], _) => format!("{}, {} rows", one.file.site(), one.file.load.len()),
        (_, "") => format!("{} files", results.len()),
        (_, campaign) => format!("{} files of campaign {campaign}", results.len()),
    };
    let mut page = Page::new(title, subtitle);
    page.synthetic = results.iter().any(|r| r.file.facts.synthetic);
    page = page.with(Block::heading("Stiffness, beside the present simulation"));
    for table in tables(results) {
        page = page.with(Block::Table(table));
    }
    let noted = || results.iter().filter(|r| !r.account.warnings.is_empty());
    if noted().next().is_some() {
        page = page.with(Block::heading("What needs attention"));
    }
    for result in noted() {
        let said = format!(
            "{}: {}.",
            result.file.stem(),
            result.account.warnings.join("; ")
        );
        page = page.with(Block::text(said));
    }
    page = page.with(Block::heading("Files"));
    for result in results {
        let mut inside = vec![Block::Table(parameters_table(result))];
        if result.account.parameters[0].status == Status::Identified {
            inside.insert(0, Block::Chart(chart(result)));
        }
        page = match results {
            [_] => inside.into_iter().fold(page, Page::with),
            _ => page.with(Block::details(
                format!("{} ({})", result.file.stem(), result.file.site()),
                inside,
            )),
        };
    }
    page
}

/// Load cycles with the fitted model, and what lies beyond its spring.
fn chart(result: &Result) -> Chart {
    let account = &result.account;
    let scene = &account.data.scene;
    let (load, reading) = match account.imposed {
        false => (&scene.load, &account.data.reading),
        true => (&account.data.reading, &scene.load),
    };
    let model = fitted(account);
    let spring: Vec<f64> = match account.imposed {
        false => scene
            .load
            .iter()
            .map(|m| m / account.solution.p[0])
            .collect(),
        true => vec![0.0; scene.load.len()],
    };
    let beyond = match account.imposed {
        false => format!("{} − spring", result.file.port.deflection_name()),
        true => result.file.port.load_name().to_string(),
    };
    let curves = Curves {
        file: &result.file,
        time: &scene.time,
        load,
        reading,
        model: &model,
        name: "fitted model",
        reference: (&beyond, &spring),
        imposed: account.imposed,
    };
    let stem = format!("{}-stiffness", result.file.stem());
    curves.chart(&stem, "load cycles and fitted model")
}

/// Everything that was identified in one file.
fn parameters_table(result: &Result) -> Table {
    let mut table = Table::new(
        format!("What was identified in {}", result.file.stem()),
        ["parameter", "value", "95 % interval", "meaning"],
    )
    .numeric([1, 2]);
    for parameter in &result.account.parameters {
        let unit = if parameter.unit == "1" {
            ""
        } else {
            &parameter.unit
        };
        let value = match (parameter.value, parameter.limit95, parameter.status) {
            (Some(value), ..) => engineering(value, 5, unit),
            (None, Some(limit), _) => format!("< {}", engineering(limit, 2, unit)),
            (None, None, Status::AtBound) => "at its bound".into(),
            _ => "not identifiable".into(),
        };
        let interval = parameter.ci95.map_or(ABSENT.into(), |[low, high]| {
            let (factor, unit) = prefix(low.abs().max(high.abs()), unit);
            let end = |v: f64| significant(v * factor, 5);
            format!("{} to {} {unit}", end(low), end(high))
        });
        table.push([
            parameter.name.replace('_', " "),
            value,
            interval,
            parameter.meaning.clone(),
        ]);
    }
    table
}

fn fitted(account: &Account) -> Vec<f64> {
    difference(&account.data.reading, &account.solution.residual)
}
