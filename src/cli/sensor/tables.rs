//! The sentence and the tables of `ident sensor`.

use super::Identified;
use crate::fit::parameter::Identified as Parameter;
use crate::sheet::number::{engineering, fixed, prefix, significant};
use crate::sheet::table::Table;

/// What was found, in one sentence.
pub fn sentence(found: &Identified) -> String {
    let account = &found.account;
    let label = if found.synthetic() {
        " (synthetic)"
    } else {
        ""
    };
    let weight = account.parameters[0].value;
    let weight = weight.map_or("the weight is not fixed".into(), |w| {
        format!("weight {} N", significant(w, 5))
    });
    let rest = &account.remainder;
    let polynomial = match rest.order {
        0 => "a polynomial over the orientation gains nothing".to_string(),
        _ => format!(
            "a polynomial over the orientation lowers it from {} to {} N at orientations left out",
            significant(rest.held_out_before[0], 3),
            significant(rest.held_out[0], 3)
        ),
    };
    format!(
        "{}{label}: {weight}; {} orientations leave {} N and {} N·m; {polynomial}.",
        found.stem(),
        account.poses.len(),
        significant(rest.before[0], 3),
        significant(rest.before[1], 3)
    )
}

/// The parameters.
pub fn parameters(found: &Identified) -> Table {
    let header = ["parameter", "site", "value", "95 % interval", "meaning"];
    let mut table = Table::new("What the sensor carries", header).numeric([2, 3]);
    for parameter in &found.account.parameters {
        let value = parameter.value.map_or("not identifiable".into(), |v| {
            engineering(v, 5, &parameter.unit)
        });
        let cells = [
            parameter.name.replace('_', " "),
            parameter.site.clone(),
            value,
            interval(parameter),
            parameter.meaning.clone(),
        ];
        table.push(cells);
    }
    let [force, moment] = found.account.fitted.noise;
    let from = if found.account.fitted.estimated {
        "from the residuals"
    } else {
        "as stated"
    };
    table.noted(format!(
        "noise of a point: {} N and {} N·m, {from}",
        significant(force, 3),
        significant(moment, 3)
    ))
}

fn interval(parameter: &Parameter) -> String {
    parameter.ci95.map_or(String::new(), |[low, high]| {
        let (factor, unit) = prefix(low.abs().max(high.abs()), &parameter.unit);
        format!(
            "{} to {} {unit}",
            significant(low * factor, 4),
            significant(high * factor, 4)
        )
    })
}

/// The orientations to measure next.
pub fn next(found: &Identified) -> Table {
    let header = ["orientation", "A deg", "B deg", "C deg", "information bits"];
    let mut table = Table::new("Orientations to measure next", header).numeric([1, 2, 3, 4]);
    for (i, proposal) in found.account.next.iter().enumerate() {
        let mut row = vec![(i + 1).to_string()];
        row.extend(proposal.abc_deg.iter().map(|a| fixed(*a, 0)));
        row.push(fixed(proposal.bits, 2));
        table.push(row);
    }
    table.noted("A, B, C turn sensor axes into base axes: R = Rz(A) Ry(B) Rx(C); each after the ones before it")
}
