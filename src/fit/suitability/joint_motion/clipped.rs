//! An encoder or a torque at the end of its range.

use super::{Moving, Rule};
use crate::fit::suitability::load_cycle::clipped;
use crate::fit::suitability::{Said, Weight};

/// A channel at the end of its range repeats one number while the joint moves on.
pub const RULE: Rule = Rule {
    name: "clipped",
    remedy: "record with a wider range, or move less",
    look,
};

/// Share of the rows in which an encoder may stand while the other goes on.
const STANDS: f64 = 0.005;

fn look(on: &Moving) -> Said {
    let joint = on.joint;
    let pairs = [
        ("motor angle", &joint.motor, &joint.link),
        ("link angle", &joint.link, &joint.motor),
    ];
    let stands = |(name, own, other): (&str, &Vec<f64>, &Vec<f64>)| {
        let (rows, end) = clipped(own, other)?;
        (rows as f64 > STANDS * own.len() as f64).then(|| {
            let what = format!("the {name} stands at its {end} for {rows} rows while the joint moves on: it is clipped");
            (Weight::Fatal, what)
        })
    };
    let torque = clipped(&joint.torque, &joint.motor)
        .filter(|(rows, _)| *rows as f64 > MANY * joint.torque.len() as f64);
    let said = torque.map(|(rows, end)| {
        let what = format!("the motor torque stands at its {end} for {rows} rows while the joint moves on: it is clipped, or the drive is at its limit");
        (Weight::Odd, what)
    });
    pairs.into_iter().filter_map(stands).chain(said).collect()
}

/// Share of the rows in which a torque may stand: friction at constant speed is one number too.
const MANY: f64 = 0.02;
