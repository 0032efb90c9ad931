//! What a case hides, how large, and what nobody can tell from it.

use super::super::algebra::{beyond, dot};
use super::super::chosen::chosen;
use super::super::{Truth, chance};
use super::course::{drift, early, offset, outside, shows, skew, slip};
use super::curve::{backlash, sides, soft, stiffening};
use super::habit::Habit;
use super::memory::{border, creep, friction, hysteresis, loosening};
use super::noise::Noise;
use super::programme::Programme;
use super::scale::{SCALES, by_stiffness, scaled};
use super::sight::judged;
use ident::ground::random::Random;

const EFFECTS: [&str; 16] = [
    "backlash",
    "soft_zone",
    "cubic_stiffness",
    "asymmetry",
    "hysteresis",
    "coulomb_friction",
    "creep",
    "loosening",
    "slip",
    "sensor_offset",
    "thermal_drift",
    "time_skew",
    "quantization",
    "lever_arm",
    "cosine_error",
    "stiffness",
];
/// Shapes that no effect of the contract makes.
pub const OUTSIDE: [&str; 6] = [
    "tooth mesh over load",
    "catch on one branch",
    "neighbouring press",
    "telegraph",
    "wave of the foundation",
    "crossed loop",
];

/// Everything that is put into the readings.
#[derive(Debug, Clone)]
pub struct Hidden {
    /// At the rows, in deflections under the largest load.
    pub added: Vec<Vec<f64>>,
    /// Gains of the sensors.
    pub gains: [f64; 2],
    /// Raster of the readings, in the same.
    pub raster: Option<f64>,
    /// True stiffness over the stated one.
    pub scale: f64,
    pub truths: Vec<Truth>,
}

/// One cause before it is judged.
pub struct Draft {
    pub effect: &'static str,
    pub law: String,
    pub column: Option<Vec<f64>>,
    /// Statistic of what is no column.
    pub sight: f64,
    pub strength: f64,
    pub twins: Vec<&'static str>,
}

/// Size that is seen: what 97 of 100 readings stay below, beyond the spring.
fn size(column: &[f64], spring: &[f64]) -> f64 {
    let mut left: Vec<f64> = beyond(column, &[spring.to_vec()])
        .iter()
        .map(|x| x.abs())
        .collect();
    left.sort_by(f64::total_cmp);
    left[(0.97 * (left.len() - 1) as f64) as usize]
}

fn fits(name: &str, p: &Programme, habit: &Habit) -> bool {
    match name {
        // Under loads of one sign a gap is closed by the first of them: an offset, or nothing.
        "backlash" | "asymmetry" => p.two_sided,
        // Read while everything stands, delay is not there.
        "time_skew" => !p.standing,
        // Work and cycles: one cycle is creep or a bend of the curve.
        "loosening" => p.rows.len() > 60,
        "lever_arm" => habit.load_lever.is_some(),
        "cosine_error" => habit.sensors[0].lever.is_some() || !habit.turning,
        other if OUTSIDE.contains(&other) => shows(other, p),
        _ => true,
    }
}

/// The unit shape on the raster.
fn law(name: &str, p: &Programme, random: &mut Random) -> (Vec<f64>, &'static str) {
    match name {
        "backlash" => backlash(p, random),
        "soft_zone" => soft(p, random),
        "cubic_stiffness" => stiffening(p, random),
        "asymmetry" => sides(p, random),
        "hysteresis" => hysteresis(p, random),
        "coulomb_friction" => friction(p, random),
        "creep" => creep(p, random),
        "loosening" => loosening(p, random),
        "slip" => slip(p, random),
        "sensor_offset" => offset(p, random),
        _ => drift(p, random),
    }
}

/// Largest part of the whole deflection that a shape may make: beyond it a spring would run backwards.
fn most(name: &str) -> f64 {
    match name {
        "cubic_stiffness" => 0.3,
        _ => 0.7,
    }
}

fn delayed(
    p: &Programme,
    spring: &[f64],
    wanted: f64,
    random: &mut Random,
) -> (Vec<f64>, &'static str) {
    let form = random.below(3);
    let early = early(random);
    let (mut low, mut high) = (1e-4, 1.0);
    for _ in 0..18 {
        let half = f64::sqrt(low * high);
        let own = size(&p.read(&skew(p, form, early, half)), spring);
        if own > wanted {
            high = half
        } else {
            low = half
        }
    }
    (
        p.read(&skew(p, form, early, low)),
        ["delay", "low pass", "clock that runs away"][form],
    )
}

fn shaped(name: &'static str, p: &Programme, noise: &Noise, random: &mut Random) -> Draft {
    let spring = p.read(&p.u);
    let wanted = random.log_uniform(4.0, 40.0) * noise.base;
    let sign = if chance(random, 0.5) && matches!(name, "slip" | "sensor_offset" | "thermal_drift")
    {
        -1.0
    } else {
        1.0
    };
    let (unit, law) = if name == "time_skew" {
        delayed(p, &spring, wanted, random)
    } else if OUTSIDE.contains(&name) {
        (p.read(&outside(name, p, random)), name)
    } else {
        let (fine, law) = law(name, p, random);
        (p.read(&fine), law)
    };
    let own = size(&unit, &spring).max(1e-9);
    let peak = unit.iter().map(|x| x.abs()).fold(1e-9, f64::max);
    let factor = if name == "time_skew" {
        1.0
    } else {
        sign * (wanted / own).min(most(name) / peak)
    };
    let twins = match (name, law) {
        // Laws on the border: smooth friction is a narrow hysteresis, and the library may call it so.
        ("coulomb_friction", law) if border(law) => vec!["hysteresis"],
        // Friction-held gap = friction in the way of the load (knowledge, 7).
        ("backlash", "gap that grease holds") => vec!["coulomb_friction", "hysteresis"],
        _ => Vec::new(),
    };
    Draft {
        effect: name,
        law: law.into(),
        column: Some(unit.iter().map(|x| factor * x).collect()),
        sight: 0.0,
        strength: own * factor.abs() / noise.base,
        twins,
    }
}

fn same_mechanism(names: &[&'static str]) -> bool {
    let both = |group: &[&str]| names.len() == 2 && names.iter().all(|n| group.contains(n));
    both(&SCALES)
        || both(&["hysteresis", "coulomb_friction"])
        || both(&["soft_zone", "cubic_stiffness", "backlash"])
}

/// Draws what a case hides; the habit learns what it may state of the stiffness.
pub fn hide(p: &Programme, habit: &mut Habit, noise: &Noise, random: &mut Random) -> Hidden {
    let strange = OUTSIDE.iter().any(|n| fits(n, p, habit));
    let shares = [4, 13, if strange { 17 } else { 20 }];
    let mut names = chosen(random, shares, [&EFFECTS, &OUTSIDE], |n| fits(n, p, habit));
    while same_mechanism(&names) {
        names = chosen(random, [0, 0, 20], [&EFFECTS, &OUTSIDE], |n| {
            fits(n, p, habit)
        });
    }
    let mut hidden = Hidden {
        added: Vec::new(),
        gains: [1.0; 2],
        raster: None,
        scale: 1.0,
        truths: Vec::new(),
    };
    let shape = |n: &&&'static str| !SCALES.contains(n) && **n != "quantization";
    let mut drafts: Vec<Draft> = names
        .iter()
        .filter(shape)
        .map(|n| shaped(n, p, noise, random))
        .collect();
    hidden.added = drafts.iter().filter_map(|d| d.column.clone()).collect();
    if !told_apart(p, habit, &hidden.added) {
        names.retain(|n| !by_stiffness(n, habit));
    }
    state(
        p,
        habit,
        &hidden.added,
        names.iter().any(|n| by_stiffness(n, habit)),
        random,
    );
    for name in names.iter().filter(|n| !shape(n)) {
        drafts.push(scaled(name, habit, &mut hidden, noise, random));
    }
    hidden.truths = judged(p, noise, &drafts);
    hidden
}

/// Part of the spring's compliance that effects bring.
fn share(p: &Programme, added: &[Vec<f64>]) -> f64 {
    let spring = p.read(&p.u);
    added
        .iter()
        .map(|c| (dot(c, &spring) / dot(&spring, &spring)).abs())
        .sum()
}

/// Whether a wrong stiffness could be told from the compliance of the other effect.
fn told_apart(p: &Programme, habit: &Habit, added: &[Vec<f64>]) -> bool {
    share(p, added) < 0.6 * habit.nominal_std.max(0.1)
}

/// What the file says of the stiffness: nothing where an effect gives so much that the plain slope is another one, for it is
/// then a matter of words whose compliance that is.
fn state(p: &Programme, habit: &mut Habit, added: &[Vec<f64>], wanted: bool, random: &mut Random) {
    let share = share(p, added);
    let told = chance(random, 0.7);
    if wanted {
        habit.nominal_std = habit.nominal_std.max(share / 0.6);
    }
    if wanted || told && share < 0.6 * habit.nominal_std {
        let off = 0.5 * habit.nominal_std * random.normal().clamp(-1.5, 1.5);
        habit.nominal = Some(habit.stiffness * if wanted { 1.0 } else { 1.0 + off });
    }
}
