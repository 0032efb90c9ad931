//! The diagnosis of a test that moved the joint instead of pressing it.
//!
//! Dry friction is sought first, then a clearance beside it; each must predict cycles that were not
//! fitted. Faults of the instruments are not sought here: against a slipping contact the laws'
//! own error is far above the noise, and a channel's fault would be blamed for it. For the same
//! reason no evidence is compared: the probability of a cause is that of its gain on unseen cycles.

use super::diagnosis::Diagnosis;
use super::structure;
use super::unseen::{Split, gain, held_out};
use crate::effects::{CLEARANCE_SLIDER, DRY_SLIDER};
use crate::findings::answer::{Answer, Cause, Verdict};
use crate::findings::gain::Gain;
use crate::fit::imposed::{observe, solve};
use crate::fit::observation::{MOST_ROWS, Observation};
use crate::fit::solution::{Solution, unit_of};
use crate::ground::stats::difference;
use crate::measurement::load_cycle::{LoadCycle, Port};
use crate::signal::colour::Colour;
use crate::signal::smooth::noise;

/// Least reduction of the error on unseen cycles, in percent, for which a clearance is named.
const WORTH_NAMING: f64 = 2.0;
/// Share of the variance beyond which what is left matters.
const MATTERS: f64 = 0.002;

/// Diagnoses a test under imposed displacement.
pub fn diagnose_imposed(file: &LoadCycle) -> Diagnosis {
    let data = observe(file, MOST_ROWS);
    let plain = solve(&[], &data);
    let dry = solve(&[DRY_SLIDER], &data);
    let gapped = solve(&[CLEARANCE_SLIDER], &data);
    let white = Colour::white(data.rows(), data.scene.deflection_scale * 0.1);
    let errors = |s: &Solution| held_out(&s.model, &s.p, &data, &white, Split::Cycles);
    let (before, without, with) = (errors(&plain), errors(&dry), errors(&gapped));
    let clearance = gain(&without, &with, &data);
    let named_gap = clearance.is_real() && clearance.reduction_percent > WORTH_NAMING;
    let (chosen, after) = if named_gap {
        (gapped, with)
    } else {
        (dry, without)
    };
    let friction = gain(&before, &after, &data);
    let mut causes = Vec::new();
    if friction.is_real() {
        causes.push(cause(
            "coulomb_friction",
            &["friction", "stick"],
            friction,
            &chosen,
            file,
        ));
        if named_gap {
            causes.push(cause("backlash", &["gap"], clearance, &chosen, file));
        }
    }
    conclude(file, data, (plain, chosen), causes)
}

fn cause(
    effect: &'static str,
    wanted: &[&str],
    gain: Gain,
    chosen: &Solution,
    file: &LoadCycle,
) -> Cause {
    let slots = chosen.model.slots();
    let own = slots
        .iter()
        .zip(&chosen.p)
        .filter(|(s, _)| wanted.contains(&s.parameter.name));
    // the ports are swapped: what counts as deflection there is a force here
    let unit = |scale| match scale {
        crate::effects::Scale::Deflection => file.port.load_unit(),
        crate::effects::Scale::Load => file.port.deflection_unit(),
        other => unit_of(other, file.port),
    };
    Cause {
        effect,
        site: file.site(),
        probability: gain.probability(),
        summary: summary(effect, file.port),
        alternatives: Vec::new(),
        ci95: Vec::new(),
        parameters: own
            .map(|(s, v)| (s.parameter.name, *v, unit(s.parameter.scale)))
            .collect(),
        gain,
    }
}

/// What a cause is in a test that moves: no gear need be there, and nothing waits for a load.
fn summary(effect: &str, port: Port) -> &'static str {
    match (effect, port) {
        ("backlash", Port::Linear) => {
            "A clearance: after each reversal the part moves this far before any force builds up."
        }
        ("backlash", Port::Rotational) => {
            "A clearance: after each reversal the joint turns this far before any moment builds up."
        }
        (_, Port::Linear) => {
            "One dry contact slips: from then on the force stays the same however far the part moves."
        }
        (_, Port::Rotational) => {
            "One dry contact slips: from then on the moment stays the same however far the joint turns."
        }
    }
}

fn conclude(
    file: &LoadCycle,
    data: Observation,
    models: (Solution, Solution),
    causes: Vec<Cause>,
) -> Diagnosis {
    let (plain, chosen) = models;
    let square = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>() / v.len().max(1) as f64;
    let share = square(&chosen.residual) / square(&plain.residual).max(f64::MIN_POSITIVE);
    let noise_rms = noise(&file.load);
    let discrepancy = structure::discrepancy(&plain.residual, &data, noise_rms);
    let unexplained = structure::structure(
        &chosen.residual,
        &data,
        square(&plain.residual),
        noise_rms,
        "lack of fit",
    );
    let verdict = match (causes.is_empty(), share > MATTERS) {
        (true, _) => Verdict::UnknownCause,
        (false, true) => Verdict::PartlyExplained,
        (false, false) => Verdict::Explained,
    };
    let fitted = |s: &Solution| difference(&data.reading, &s.residual);
    let answer = Answer {
        verdict,
        discrepancy,
        causes,
        groups: Vec::new(),
        unexplained,
        p_value: 0.0,
        candidates: Vec::new(),
        unit: file.port.load_unit(),
        noise: chosen.colour.describe(),
        unstated: file.facts.nominal_stiffness.is_none(),
        doubts: Vec::new(),
    };
    Diagnosis {
        answer,
        simulated: fitted(&plain),
        extended: fitted(&chosen),
        model: chosen.model.clone(),
        p: chosen.p.clone(),
        imposed: true,
        judgement: None,
        data,
    }
}
