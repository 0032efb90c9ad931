//! Hides an effect in a file, at a strength relative to the file's own noise.

use crate::effects::{Effect, Scene, contract::Role};
use crate::experiments::load_cycle::straight_line;
use crate::fit::candidates::Candidates;
use crate::fit::observation::Observation;
use crate::fit::screen::screen;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::random::Random;
use crate::ground::stats::{difference, ends};
use crate::measurement::load_cycle::LoadCycle;

/// An effect made to show with a given strength.
pub struct Hidden {
    /// The effect.
    pub effect: &'static dyn Effect,
    /// Its parameters, SI.
    pub p: Vec<f64>,
    /// What it adds to the deflection, every row of the file, rad or m.
    pub addition: Vec<f64>,
}

/// Draws the shapes of an effect between its grid values and sizes its amplitude so that the peak
/// of what a straight line cannot absorb is `strength` times the noise (for scale effects and
/// offsets: the peak itself).
pub fn hide(
    effect: &'static dyn Effect,
    strength: f64,
    file: &LoadCycle,
    random: &mut Random,
) -> Outcome<Hidden> {
    let noise = noise_of(file);
    let stiffness = straight_line(&file.load, &file.deflection).abs();
    let cycles = crate::measurement::cycles::Cycles::find(&file.load).count();
    let scene = Scene::new(file.time.clone(), file.load.clone(), stiffness, cycles);
    let mut p = draw(effect, &scene, random);
    if effect.role() == Role::Lattice {
        p[0] = strength * noise;
        let addition = response(effect, &p, &scene, &file.deflection);
        return Ok(Hidden {
            effect,
            p,
            addition,
        });
    }
    for _ in 0..40 {
        let peak = visible(
            &response(effect, &p, &scene, &file.deflection),
            effect.role(),
            &scene.load,
        );
        if peak <= 0.0 || !peak.is_finite() {
            return Err(Problem::new(
                format!("`{}` does not show in this file", effect.card().name),
                "choose a file whose load schedule excites it",
            ));
        }
        p[0] *= strength * noise / peak;
    }
    let addition = response(effect, &p, &scene, &file.deflection);
    Ok(Hidden {
        effect,
        p,
        addition,
    })
}

/// Noise of a file's first sensor, rad or m.
pub fn noise_of(file: &LoadCycle) -> f64 {
    let data = Observation::of(file, 2000);
    let candidates = Candidates::new(&crate::effects::shapes(crate::effects::EFFECTS), &data);
    screen(&data, &candidates).rms
}

fn draw(effect: &dyn Effect, scene: &Scene, random: &mut Random) -> Vec<f64> {
    let parameters = effect.card().parameters;
    let value = |q: &crate::effects::Parameter| {
        let (low, high) = ends(q.grid);
        random.uniform(low, high) * q.scale.of(scene)
    };
    let mut p: Vec<f64> = parameters.iter().map(value).collect();
    if let Some(first) = parameters.first() {
        p[0] = first.grid[0] * 0.1 * first.scale.of(scene);
    }
    p
}

/// What an effect adds to a given deflection.
fn response(effect: &'static dyn Effect, p: &[f64], scene: &Scene, deflection: &[f64]) -> Vec<f64> {
    let elastic: Vec<f64> = scene
        .load
        .iter()
        .map(|m| m * scene.deflection_scale / scene.load_scale)
        .collect();
    let mut with = deflection.to_vec();
    effect.respond(p, scene, &elastic, &mut with);
    difference(&with, deflection)
}

fn visible(addition: &[f64], role: Role, load: &[f64]) -> f64 {
    let slope = match role {
        Role::Scale => 0.0,
        _ => {
            let (ll, la) = load
                .iter()
                .zip(addition)
                .fold((0.0, 0.0), |(a, b), (l, y)| (a + l * l, b + l * y));
            if ll > 0.0 { la / ll } else { 0.0 }
        }
    };
    addition
        .iter()
        .zip(load)
        .fold(0.0_f64, |m, (y, l)| m.max((y - slope * l).abs()))
}
