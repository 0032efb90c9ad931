//! What of a cause is seen beside the noise, the spring and the other cause, and which names nobody tells from it.

use super::super::algebra::{basis, dot, without};
use super::super::{Truth, twin};
use super::hidden::{Draft, OUTSIDE};
use super::noise::Noise;
use super::programme::Programme;
use super::rival::{Rival, rivals};

/// Names of one mechanism: what one of them can be, the judge lets the others take over.
fn family(effect: &'static str) -> Vec<&'static str> {
    match effect {
        "hysteresis" | "coulomb_friction" => vec!["hysteresis", "coulomb_friction"],
        "backlash" | "soft_zone" | "cubic_stiffness" => {
            vec!["backlash", "soft_zone", "cubic_stiffness"]
        }
        own => vec![own],
    }
}

fn length(v: &[f64]) -> f64 {
    dot(v, v).sqrt()
}

/// The truths with what is seen of them.
///
/// * A cause of which less than three deviations of a reading are left beyond the spring is no cause that must be named.
/// * In a pair, what the other name's own family takes over, or what is below a tenth of the other, need not be named: nature
///   misses every law by about as much.
/// * A rival that leaves less than three standard deviations, or less than seven hundredths of the effect, is a twin.
pub fn judged(p: &Programme, noise: &Noise, drafts: &[Draft]) -> Vec<Truth> {
    let own: Vec<Vec<f64>> = drafts
        .iter()
        .map(|d| {
            d.column
                .as_ref()
                .map(|c| noise.white(c))
                .unwrap_or_default()
        })
        .collect();
    let mut free = vec![noise.white(&p.read(&p.u))];
    free.extend(noise.known(p).iter().map(|c| noise.white(c)));
    let white = |(name, columns): Rival| (name, columns.iter().map(|c| noise.white(c)).collect());
    let rivals: Vec<Rival> = if drafts.iter().any(|d| d.column.is_some()) {
        rivals(p).into_iter().map(white).collect()
    } else {
        Vec::new()
    };
    (0..drafts.len())
        .map(|i| one(i, drafts, &own, &free, &rivals))
        .collect()
}

fn one(i: usize, drafts: &[Draft], own: &[Vec<f64>], free: &[Vec<f64>], rivals: &[Rival]) -> Truth {
    let draft = &drafts[i];
    // Readings on a raster scatter by it as well.
    let raster = drafts
        .iter()
        .find(|d| d.effect == "quantization" && draft.effect != d.effect);
    let coarse = raster.map_or(1.0, |r| (1.0 + r.strength.powi(2) / 12.0).sqrt());
    let mut truth = Truth {
        effect: if OUTSIDE.contains(&draft.effect) {
            "outside"
        } else {
            draft.effect
        },
        site: None,
        sight: draft.sight,
        apart: draft.sight,
        twins: draft.twins.iter().map(|t| (*t, None)).collect(),
        strength: draft.strength,
        law: draft.law.clone(),
    };
    if draft.column.is_none() {
        return truth;
    }
    let other = (0..drafts.len()).find(|j| *j != i && drafts[*j].column.is_some());
    let mut known = free.to_vec();
    known.extend(other.map(|j| own[j].clone()));
    let known = basis(&known);
    let left = |v: &[f64], columns: &[Vec<f64>]| {
        let bare: Vec<Vec<f64>> = columns.iter().map(|c| without(c, &known)).collect();
        length(&without(&without(v, &known), &basis(&bare)))
    };
    let whole = left(&own[i], &[]);
    truth.sight = whole;
    if let Some(j) = other {
        let family = rivals
            .iter()
            .filter(|r| family(drafts[j].effect).contains(&r.0));
        truth.sight = family.map(|r| left(&own[i], &r.1)).fold(whole, f64::min);
        let rest = length(&without(&own[j], &basis(free)));
        if truth.sight < 0.1 * rest {
            truth.sight = 0.0;
        }
    }
    (truth.sight, truth.strength) = (truth.sight / coarse, draft.strength / coarse);
    if truth.strength < 3.0 {
        truth.sight = 0.0;
    }
    let names = |name: &str| drafts.iter().any(|d| d.effect == name);
    let strangers = rivals.iter().filter(|r| !names(r.0));
    let all: Vec<(&'static str, f64)> = strangers.map(|r| (r.0, left(&own[i], &r.1))).collect();
    truth.apart = all.iter().map(|r| r.1).fold(truth.sight, f64::min);
    if truth.effect != "outside" {
        truth
            .twins
            .extend(all.iter().filter(|r| twin(r.1, whole)).map(|r| (r.0, None)));
        truth.twins.extend(imitators(i, other, own, free, rivals));
    }
    truth.twins.sort();
    truth.twins.dedup();
    truth
}

/// Single names that take both causes of a pair over.
fn imitators(
    i: usize,
    other: Option<usize>,
    own: &[Vec<f64>],
    free: &[Vec<f64>],
    rivals: &[Rival],
) -> Vec<(&'static str, Option<String>)> {
    let Some(j) = other else { return Vec::new() };
    let sum: Vec<f64> = own[i].iter().zip(&own[j]).map(|(a, b)| a + b).collect();
    let free = basis(free);
    let bare = without(&sum, &free);
    let left = |columns: &[Vec<f64>]| {
        let columns: Vec<Vec<f64>> = columns.iter().map(|c| without(c, &free)).collect();
        length(&without(&bare, &basis(&columns)))
    };
    let whole = length(&bare);
    rivals
        .iter()
        .filter(|r| twin(left(&r.1), whole))
        .map(|r| (r.0, None))
        .collect()
}
