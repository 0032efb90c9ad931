//! Double hits: seen in the force record, and what overlooking them would cost.

use super::data::{AXES, Data, Grid, Pair};
use super::discrepancy::simulated;
use super::map::Fit;
use super::prediction::Machine;
use super::unseen::of_blocks;
use crate::causes;
use crate::experiments::hammer_force::ForceWindow;
use crate::experiments::hammer_frf::{HammerFrf, Settings, estimate};
use crate::findings::answer::Cause;
use crate::findings::gain::Gain;
use crate::ground::problem::Outcome;
use crate::measurement::hammer::HammerRecord;
use crate::motion::frf::C64;
use crate::signal::double_hit::{Second, second_pulse};
use crate::signal::pulse::Pulse;

/// The name of the cause.
const NAME: &str = "double_hit";

/// Second pulses of the hits that are used: so many of their direction are doubled that they had to be.
pub fn seconds(frf: &HammerFrf) -> Vec<Second> {
    let used = frf.screened.iter().filter(|hit| hit.used());
    used.filter_map(|hit| second_pulse(&hit.force, &Pulse::find(&hit.force)?))
        .collect()
}

/// The cause, where doubled hits had to be used; `settings` made the FRFs.
pub fn cause(
    machine: &Machine,
    record: &HammerRecord,
    settings: &Settings,
    grid: Grid,
    frf: &HammerFrf,
    chosen: &Fit,
) -> Option<Cause> {
    let seconds = seconds(frf);
    let highest = seconds.iter().max_by(|a, b| a.share.total_cmp(&b.share))?;
    let card = causes::named(NAME)?.card();
    let overlooked = Settings {
        force_window: ForceWindow::Always,
        ..*settings
    };
    let gain = gain(
        machine,
        &estimate(record, &overlooked).ok()?,
        frf,
        grid,
        chosen,
    )
    .ok()?;
    gain.is_real().then(|| Cause {
        effect: card.name,
        site: "sensor".into(),
        probability: gain.probability(),
        summary: card.summary,
        alternatives: Vec::new(),
        ci95: Vec::new(),
        parameters: vec![
            ("share", highest.share, "1"),
            ("delay", highest.after as f64 * record.interval_s, "s"),
            ("hits", seconds.len() as f64, "1"),
        ],
        gain,
    })
}

/// Error of the FRFs of the doubled directions against the model: the second pulse overlooked (a force
/// window behind the first one), and in the force where it belongs.
fn gain(
    machine: &Machine,
    overlooked: &HammerFrf,
    seen: &HammerFrf,
    grid: Grid,
    chosen: &Fit,
) -> Outcome<Gain> {
    let (without, with) = (Data::of(overlooked, grid), Data::of(seen, grid));
    let curves = simulated(machine, &with, &chosen.point)?;
    let doubled: Vec<usize> = doubled(seen);
    let pairs = with.pairs.iter().zip(&without.pairs).zip(&curves);
    let own = pairs.filter(|((pair, _), _)| doubled.contains(&pair.input));
    let block = |((with, without), curve): ((&Pair, &Pair), &Vec<C64>)| {
        let mut sums = [0.0; 3];
        for (k, model) in curve.iter().enumerate() {
            let weight: f64 = with.weight[k] * with.weight[k];
            sums[0] += weight * (without.frf[k] - model).norm_sqr();
            sums[1] += weight * (with.frf[k] - model).norm_sqr();
            sums[2] += weight;
        }
        sums
    };
    Ok(of_blocks(&own.map(block).collect::<Vec<_>>()))
}

/// Directions with doubled hits among those used.
fn doubled(frf: &HammerFrf) -> Vec<usize> {
    let used = frf.screened.iter().filter(|hit| hit.used());
    let double = used.filter(|hit| {
        let pulse = Pulse::find(&hit.force);
        pulse.is_some_and(|pulse| second_pulse(&hit.force, &pulse).is_some())
    });
    double
        .filter_map(|hit| AXES.iter().position(|axis| *axis == hit.direction))
        .collect()
}
