//! Files whose stiffness, and gap where they have one, are beyond dispute: a straight spring, alone or with a gap, a zero, a slip
//! or a drift; levers are off by as much as the file says.

use super::super::{chance, intervals::Known};
use super::course::{drift, offset, slip};
use super::habit::Habit;
use super::hidden::Hidden;
use super::noise::Noise;
use super::programme::Programme;
use super::{readings, text};
use ident::ground::random::Random;

/// A file with its truth, and what is in it.
pub fn stiffness(seed: u64) -> (Vec<(String, String)>, Vec<Known>, String) {
    let mut random = Random::new(seed ^ 0x10ad_5711);
    let p = Programme::draw(&mut random);
    let mut habit = Habit::draw(&mut random);
    let noise = Noise::draw(&p, &mut random);
    let strength = random.log_uniform(4.0, 40.0) * noise.base;
    let kind = random.below(6);
    let mut truth = vec![("stiffness".to_string(), None, habit.stiffness)];
    let (fine, said) = match kind {
        0 | 1 => (vec![0.0; p.u.len()], "nothing"),
        2 => (offset(&p, &mut random).0, "a zero"),
        3 => (slip(&p, &mut random).0, "a slip"),
        4 => (drift(&p, &mut random).0, "a drift"),
        _ if p.two_sided => {
            truth.push((
                "backlash".to_string(),
                None,
                2.0 * strength * habit.top / habit.stiffness,
            ));
            (p.of_load(|u| (u / 0.002).clamp(-1.0, 1.0)), "a gap")
        }
        _ => (vec![0.0; p.u.len()], "nothing"),
    };
    let added = vec![p.read(&fine).iter().map(|x| strength * x).collect()];
    if chance(&mut random, 0.5) {
        habit.nominal = Some(habit.stiffness * (1.0 + 0.5 * habit.nominal_std * random.normal()));
    }
    let hidden = Hidden {
        added,
        gains: [1.0; 2],
        raster: None,
        scale: 1.0,
        truths: Vec::new(),
    };
    let (own, loads) = readings(&p, &habit, &noise, &hidden, &mut random);
    let file = text(&p, &habit, &noise, None, &own, &loads);
    let said = format!(
        "{said} of {:.1} deviations, {}, noise {} {:.2} %",
        strength / noise.base,
        p.name,
        noise.name,
        100.0 * noise.base
    );
    (vec![("axis.csv".into(), file)], truth, said)
}
