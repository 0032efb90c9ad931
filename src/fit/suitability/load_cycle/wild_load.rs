//! A lone wild reading of the load.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, extent};
use crate::signal::outliers::isolated;

/// One wild reading of the load sets its range, and with it every scale.
pub const RULE: Rule = Rule {
    name: "wild-load",
    remedy: "empty that cell, or correct it",
    look,
};

/// Distance from the neighbours, in robust standard deviations of their jumps.
const WILD: f64 = 12.0;
/// Share of the range that may hang on lone readings.
const SHARE: f64 = 0.95;

fn look(on: &Course) -> Said {
    let file = on.file;
    let wild = isolated(&file.load, WILD);
    if wild.is_empty() {
        return Vec::new();
    }
    let mut rest = file.load.clone();
    wild.iter().for_each(|i| rest[*i] = f64::NAN);
    let weight = match extent(&rest) < SHARE * extent(&file.load) {
        true => Weight::Fatal,
        false => Weight::Odd,
    };
    let at = file.time[wild[0]];
    let what = match wild.len() {
        1 => format!("the load has a lone wild reading at {at} s"),
        n => format!("the load has {n} lone wild readings, the first at {at} s"),
    };
    vec![(weight, what)]
}
