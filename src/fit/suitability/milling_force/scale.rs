//! Units: force per chip section.

use super::{Cutting, Rule, mean};
use crate::fit::suitability::magnitude::{explanation, times};
use crate::fit::suitability::{Said, Weight, extent};
use crate::signal::outliers::median;

/// A force per chip section that no material has is a unit.
pub const RULE: Rule = Rule {
    name: "scale",
    remedy: "check the units at the ends of the column names, and feed, depth, width, teeth and speed in `cuts`",
    look,
};

/// Force per chip section from foam to hardened steel with blunt edges at thin chips, N/mm².
const MATERIALS: std::ops::RangeInclusive<f64> = 5.0..=2e5;
/// Ratio of the ranges of two channels that no cut makes.
const UNEVEN: f64 = 40.0;
/// Ratio to the stated coefficients that no blunt edge makes.
const FAR: f64 = 8.0;

fn look(on: &Cutting) -> Said {
    let mut found = uneven(on);
    found.extend(specific(on));
    found
}

/// A channel that is far smaller or larger than those beside it.
fn uneven(on: &Cutting) -> Said {
    let ranges: Vec<f64> = on.channels.iter().map(|c| extent(&c.values)).collect();
    let mut said = Vec::new();
    let mut say = |k: usize, ratio: f64| {
        let why = explanation(ratio).map_or(String::new(), |why| format!("; {why}"));
        let name = &on.channels[k].name;
        said.push((
            Weight::Fatal,
            format!("{name} spans {} what the others do{why}", times(ratio)),
        ));
    };
    let plane = ranges[0] / ranges[1];
    if plane > 0.0 && !(1.0 / UNEVEN..=UNEVEN).contains(&plane) {
        say(0, plane);
    }
    let axial = ranges[2] / ranges[0].max(ranges[1]);
    if axial > UNEVEN {
        say(2, axial);
    }
    said
}

fn specific(on: &Cutting) -> Said {
    let specific = |(cut, record): (&_, &_)| {
        let [x, y, _] = mean(record);
        let [a, b] = on.expected(cut);
        x.hypot(y) / a.hypot(b)
    };
    let all: Vec<f64> = on.cuts().map(specific).collect();
    let own = median(&all);
    let stated = on.file.facts.nominal.as_ref().and_then(|nominal| {
        let own = nominal
            .coefficients
            .iter()
            .find(|(key, _)| key == "Ktc_N_mm2");
        own.map(|(_, value)| *value).filter(|k| *k > 0.0)
    });
    let said = |what: String, ratio: f64| {
        let why = explanation(ratio).map_or(String::new(), |why| format!("; {why}"));
        vec![(Weight::Fatal, what + &why)]
    };
    match stated {
        _ if !own.is_finite() => Vec::new(),
        Some(stated) if !(1.0 / FAR..=FAR * FAR).contains(&(own / stated)) => said(
            format!(
                "the force per chip section is {} the stated Ktc",
                times(own / stated)
            ),
            own / stated,
        ),
        _ if !MATERIALS.contains(&own) => said(
            format!("the force per chip section, {own:.2e} N/mm², is that of no material"),
            own / 1e3,
        ),
        _ => Vec::new(),
    }
}
