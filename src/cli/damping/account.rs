//! What `ident damping` tells on the terminal.

use super::result::Damped;
use crate::experiments::hammer_given::ScatterFrom;
use crate::fit::damping::{Pair, Test};
use crate::fit::parameter::{Identified, Status};
use crate::ground::files;
use crate::report::text::table;
use crate::sheet::number::{engineering, fixed, significant};
use crate::sheet::table::Table;
use std::fmt::Write;
use std::path::PathBuf;

/// The whole account.
pub fn text(damped: &Damped, written: &[PathBuf]) -> String {
    let mut out = hits(damped);
    for part in [
        modes(damped),
        dampings(damped),
        fixed_combinations(damped),
        matches(damped),
    ] {
        if !part.header.is_empty() {
            out.push_str(&table(&part));
            out.push('\n');
        }
    }
    let pages = written
        .iter()
        .filter(|path| path.extension().is_none_or(|e| e != "svg"));
    for path in pages {
        let _ = writeln!(out, "written: {}", path.display());
    }
    out
}

fn hits(damped: &Damped) -> String {
    let mut out = String::new();
    for test in &damped.input.tests {
        let used = test.frf.screened.iter().filter(|hit| hit.used()).count();
        let (name, all) = (files::name(&test.path), test.frf.screened.len());
        let _ = match test.frf.scatter_from {
            ScatterFrom::Hits => writeln!(out, "{name}: {used} of {all} hits used"),
            from => writeln!(out, "{name}: FRFs as given; scatter: {}", from.sentence()),
        };
        for hit in &test.frf.screened {
            if let Some(why) = hit.why() {
                let _ = writeln!(out, "  hit {} {} left out: {why}", hit.direction, hit.hit);
            }
        }
    }
    out.push('\n');
    out
}

/// The modes that were measured.
pub fn modes(damped: &Damped) -> Table {
    let header = ["frequency Hz", "± Hz", "damping %", "± %"];
    let mut out = Table::new("Modes measured", header).numeric(0..4);
    for mode in damped.input.tests.iter().flat_map(|test| &test.modes) {
        out.push([
            fixed(mode.frequency_hz, 3),
            fixed(mode.half_width[0], 3),
            fixed(100.0 * mode.damping_ratio, 3),
            fixed(100.0 * mode.half_width[1], 3),
        ]);
    }
    let hits = |test: &Test| test.frf.scatter_from == ScatterFrom::Hits;
    out.noted(match damped.input.tests.iter().all(hits) {
        true => "95 % intervals by jackknife over hits",
        false => "95 % intervals by jackknife over hits; of FRFs as given by what the fit leaves",
    })
}

/// The tuned constants.
pub fn dampings(damped: &Damped) -> Table {
    let title = match damped.synthetic() {
        true => "Identified damping (synthetic data)",
        false => "Identified damping",
    };
    let mut out = Table::new(
        title,
        ["site", "constant", "before", "identified", "95 % interval"],
    );
    let constants = damped
        .account
        .parameters
        .iter()
        .zip(&damped.account.constants);
    for (parameter, constant) in constants {
        let (value, interval) = cells(parameter);
        out.push([
            parameter.site.clone(),
            parameter.name.clone(),
            engineering(constant.start, 3, &parameter.unit),
            value,
            interval,
        ]);
    }
    if damped.request.released.prior_ln_std.is_some() {
        out = out.noted("dampings are regularised towards `before`, as asked for by --prior");
    }
    out
}

fn cells(parameter: &Identified) -> (String, String) {
    match (parameter.value, parameter.ci95, parameter.status) {
        (Some(value), Some([low, high]), _) => {
            let percent = |x: f64| significant(100.0 * (x / value - 1.0), 2);
            let interval = format!("{} % .. +{} %", percent(low), percent(high));
            (engineering(value, 4, &parameter.unit), interval)
        }
        (_, _, Status::AtBound) => ("not fixed: at its bound".into(), String::new()),
        _ => ("not identifiable".into(), String::new()),
    }
}

/// What the data fix of those constants that they do not fix alone.
pub fn fixed_combinations(damped: &Damped) -> Table {
    let mut out = Table::new(
        "Combinations that the data fix",
        ["product", "times before", "± %"],
    )
    .numeric(1..3);
    let parameters = &damped.account.parameters;
    let alone = parameters.iter().all(|p| p.status == Status::Identified);
    if alone || !damped.account.supported {
        return Table::default(); // each constant is fixed alone, or none is told
    }
    let alone = |weights: &[(usize, f64)]| weights.len() == 1;
    let fixed_ones = damped
        .account
        .tuned
        .uncertainty
        .fixed
        .iter()
        .zip(damped.combinations());
    for (_, said) in fixed_ones.filter(|(one, _)| !alone(&one.weights)) {
        let half = significant(196.0 * said.relative_stderr, 2);
        out.push([said.product, significant(said.times_before, 4), half]);
    }
    out
}

/// How well simulated and measured FRFs agree.
pub fn matches(damped: &Damped) -> Table {
    let header = ["pair", "FRAC before", "after", "dB before", "after"];
    let mut out = Table::new("Simulated beside measured FRF", header).numeric(1..5);
    let row = |name: String, pair: &Pair| {
        let [before, after] = pair.matches;
        [
            name,
            fixed(before.frac, 4),
            fixed(after.frac, 4),
            fixed(before.log_error_db, 2),
            fixed(after.log_error_db, 2),
        ]
    };
    let many = damped.input.tests.len() > 1;
    for (test, pairs) in damped.input.tests.iter().zip(&damped.account.pairs) {
        for pair in pairs {
            let name = match many {
                true => format!("{} {}", files::name(&test.path), pair.name),
                false => pair.name.clone(),
            };
            out.push(row(name, pair));
        }
    }
    let band = &damped.request;
    out.noted(format!(
        "{} to {} Hz; dB: mean absolute amplitude error; reduced chi-square {} (1: noise alone)",
        band.from_hz,
        band.settings.band_hz,
        significant(damped.account.tuned.reduced_chi_square, 3)
    ))
}
