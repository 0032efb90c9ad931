//! The sentence and the tables of `ident screw`.

use super::Judged;
use crate::fit::screw::Account;
use crate::fit::screw::groups::Group;
use crate::fit::screw::iso::Figures;
use crate::sheet::number::{ABSENT, fixed, significant};
use crate::sheet::table::Table;

/// Key in the JSON, meaning, and where the number is.
pub type Figure = (&'static str, &'static str, fn(&Figures) -> Option<f64>);

/// Every figure of ISO 230-2.
pub const FIGURES: &[Figure] = &[
    ("A_um", "accuracy, both directions", |f| f.a),
    ("A_forward_um", "accuracy, forward", |f| f.a_forward),
    ("A_backward_um", "accuracy, backward", |f| f.a_backward),
    ("R_um", "repeatability, both directions", |f| f.r),
    ("R_forward_um", "repeatability, forward", |f| f.r_forward),
    ("R_backward_um", "repeatability, backward", |f| f.r_backward),
    ("B_um", "reversal value, largest", |f| f.b),
    (
        "B_mean_um",
        "reversal value, mean (forward less backward)",
        |f| f.b_mean,
    ),
    ("E_um", "systematic error, both directions", |f| f.e),
    ("E_forward_um", "systematic error, forward", |f| f.e_forward),
    ("E_backward_um", "systematic error, backward", |f| {
        f.e_backward
    }),
    ("M_um", "range of the mean of both directions", |f| f.m),
];

/// What was found, in one sentence.
pub fn sentence(judged: &Judged) -> String {
    let account = &judged.account;
    let um = |value: Option<f64>| {
        value.map_or("not known".into(), |v| format!("{} µm", fixed(v * 1e6, 1)))
    };
    let label = if judged.table.synthetic {
        " (synthetic)"
    } else {
        ""
    };
    let mut said = format!(
        "{}{label}: accuracy A {}, repeatability R {}, backlash {}; {} groups of quadratics hold the mean error of {} targets within {} µm",
        judged.stem(),
        um(account.figures.a),
        um(account.figures.r),
        um(account.backlash),
        account.groups.len(),
        account.targets.len(),
        significant(judged.limit_um, 3),
    );
    if let Some(least) = account
        .least
        .as_ref()
        .filter(|least| least.len() < account.groups.len())
    {
        said += &format!(" ({} would do)", least.len());
    }
    if let Some(percent) = improvement(judged) {
        said += &format!("; A changed by {} % against before", fixed(percent, 1));
    }
    said + "."
}

/// Change of A against before, percent.
pub fn improvement(judged: &Judged) -> Option<f64> {
    let before = judged.before.as_ref()?.1.figures.a.filter(|a| *a > 0.0)?;
    Some(100.0 * (judged.account.figures.a? / before - 1.0))
}

/// The figures, beside those of before.
pub fn figures(judged: &Judged) -> Table {
    let k = significant(judged.account.figures.coverage, 1);
    let mut header = vec!["figure", "meaning", "µm"];
    if judged.before.is_some() {
        header.push("before µm");
    }
    let um = |value: Option<f64>| value.map_or(ABSENT.into(), |v| fixed(v * 1e6, 2));
    let mut table = Table::new(
        format!("ISO 230-2, coverage factor {k}, all readings"),
        header,
    )
    .numeric([2, 3]);
    for (key, meaning, value) in FIGURES {
        let name = key.trim_end_matches("_um").replace('_', " ");
        let mut row = vec![
            name,
            meaning.to_string(),
            um(value(&judged.account.figures)),
        ];
        row.extend(
            judged
                .before
                .iter()
                .map(|(_, before)| um(value(&before.figures))),
        );
        table.push(row);
    }
    table.noted(format!("{ABSENT}: the readings do not give it"))
}

/// The greedy groups.
pub fn groups(judged: &Judged) -> Table {
    group_table(
        "Groups of quadratics p1 x² + p2 x + p3 (x in mm)",
        &judged.account.groups,
    )
    .noted(dropped(&judged.account))
}

/// The least groups, where there are fewer.
pub fn least(judged: &Judged) -> Option<Table> {
    let account = &judged.account;
    let least = account
        .least
        .as_ref()
        .filter(|least| least.len() < account.groups.len())?;
    Some(group_table(
        "The least number of groups with the same limit",
        least,
    ))
}

fn dropped(account: &Account) -> String {
    match account.dropped {
        0 => format!("of the {}; no reading left out", account.mean_of()),
        n => format!(
            "of the {}; {n} extreme readings left out of the means",
            account.mean_of()
        ),
    }
}

fn group_table(title: &str, groups: &[Group]) -> Table {
    let header = [
        "from mm",
        "to mm",
        "targets",
        "p1 µm/mm²",
        "p2 µm/mm",
        "p3 µm",
        "largest residual µm",
    ];
    let mut table = Table::new(title, header).numeric(0..7);
    for group in groups {
        let mut row = vec![
            fixed(group.from_mm, 3),
            fixed(group.to_mm, 3),
            group.points.to_string(),
        ];
        row.extend(group.p.iter().map(|p| significant(*p, 5)));
        row.push(fixed(group.max_residual_um, 2));
        table.push(row);
    }
    table
}
