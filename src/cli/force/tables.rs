//! What `ident force` says: sentences and tables.

use super::Found;
use crate::cutting::LINEAR_EDGE;
use crate::fit::parameter::{Identified, Status};
use crate::sheet::number::{ABSENT, fixed, significant, with_interval};
use crate::sheet::page::Tone;
use crate::sheet::table::Table;

/// What an engineer shall take away, the most important first.
pub fn sentences(found: &Found) -> Vec<(Tone, String)> {
    let account = &found.account;
    let open: Vec<&str> = account.parameters[..6]
        .iter()
        .filter(|p| p.status != Status::Identified)
        .map(|p| p.name.as_str())
        .collect();
    let first = match (open.is_empty(), account.rel_std) {
        (true, Some(spread)) => (
            Tone::Good,
            format!(
                "All six coefficients are fixed by {} cuts; together they give the force to {} % (one standard deviation).",
                account.cuts.len(),
                significant(100.0 * spread, 2)
            ),
        ),
        _ if account.is_another_cut() => (
            Tone::Attention,
            "These are records of another cut than the file states: no coefficient is told, and no material written.".into(),
        ),
        _ => (
            Tone::Attention,
            format!(
                "These cuts leave {} open: no material is written.",
                open.join(", ")
            ),
        ),
    };
    let check = (!account.is_another_cut()).then(|| check(found));
    [first, left(found)].into_iter().chain(check).collect()
}

fn left(found: &Found) -> (Tone, String) {
    let [x, y, z] = found.account.rms.map(|v| significant(v, 3));
    let noise = match found.account.stated_noise {
        Some(noise) => format!("; the stated noise is {} N", significant(noise, 3)),
        None => String::new(),
    };
    let rows = found.account.rows;
    (
        Tone::Neutral,
        format!("The law leaves {x}, {y} and {z} N rms in x, y and z over {rows} samples{noise}."),
    )
}

fn check(found: &Found) -> (Tone, String) {
    let fitted = found.account.parameters[..6].iter().map(|p| p.value);
    let pairs = fitted.zip(found.account.averaged.coefficients);
    let both = pairs.filter_map(|(a, b)| Some((a?, b?)));
    let off: Vec<f64> = both.take(2).map(|(a, b)| 100.0 * (b / a - 1.0)).collect();
    let sentence = match off.as_slice() {
        [t, r] => format!(
            "Mean forces by the textbook (c sin φ, no runout) give Ktc {} % and Krc {} % off these values.",
            fixed(*t, 1),
            fixed(*r, 1)
        ),
        _ => "Mean forces alone do not fix the coefficients: the textbook's check needs two feeds."
            .into(),
    };
    (Tone::Neutral, sentence)
}

fn title(found: &Found, title: &str) -> String {
    match found.synthetic() {
        true => format!("{title} (synthetic data)"),
        false => title.into(),
    }
}

/// Coefficients and runout beside the textbook's.
pub fn parameters(found: &Found) -> Table {
    let header = ["parameter", "unit", "value, 95 %", "from mean forces"];
    let mut table = Table::new(title(found, "Coefficients"), header).numeric(2..4);
    let averaged = found.account.averaged.coefficients;
    for (i, p) in found.account.parameters.iter().enumerate() {
        let mean = averaged.get(i).copied().flatten();
        let mean = mean.map_or(ABSENT.into(), |v| significant(v, 4));
        table.push([p.name.clone(), p.unit.clone(), value(p), mean]);
    }
    table.noted(LINEAR_EDGE.card().equation)
}

/// What was found along.
pub fn nuisance(found: &Found) -> Table {
    let header = ["parameter", "site", "unit", "value, 95 %", "meaning"];
    let mut table = Table::new(title(found, "Found along"), header).numeric([3]);
    for p in &found.account.nuisance {
        table.push([
            p.name.clone(),
            p.site.clone(),
            p.unit.clone(),
            value(p),
            p.meaning.clone(),
        ]);
    }
    table
}

fn value(p: &Identified) -> String {
    match (p.value, p.ci95, p.limit95) {
        (Some(value), Some([low, high]), _) => with_interval(value, low, high),
        (_, _, Some(limit)) => format!("below {}", significant(limit, 2)),
        _ => "not identifiable".into(),
    }
}

/// Mean forces of each cut, measured and fitted.
pub fn means(found: &Found) -> Table {
    let header = [
        "cut", "fz mm", "ap mm", "ae mm", "side", "Fx N", "fitted", "Fy N", "fitted", "Fz N",
        "fitted",
    ];
    let mut table = Table::new(title(found, "Mean forces on the tool"), header).numeric(1..11);
    for (i, cut) in found.account.cuts.iter().enumerate() {
        let (measured, fitted) = super::figures::means(cut);
        let c = &cut.data.scene.cut;
        let feed = c.feed_per_tooth(cut.data.scene.tool.teeth);
        let mut row = vec![
            format!("{}", i + 1),
            fixed(1e3 * feed, 4),
            fixed(1e3 * c.depth_m, 2),
            fixed(1e3 * c.width_m, 2),
            format!("{:?}", c.side).to_lowercase(),
        ];
        for k in 0..3 {
            row.extend([fixed(measured[k], 1), fixed(fitted[k], 1)]);
        }
        table.push(row);
    }
    table
}
