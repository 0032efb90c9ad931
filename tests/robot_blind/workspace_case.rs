//! Workspace files with known truths.

use super::case::{Case, STRONGEST, Truth, WEAKEST, size_for};
use super::family::{self, Spread};
use super::poses::nine_points;
use super::robot::{Robot, V3};
use super::workspace::{Plan, Scene};
use super::workspace_effects::{EFFECTS, OUTSIDE, draw, wants_both_signs};
use super::workspace_strength::Before;
use crate::blind_generator::random::Random;
use std::fmt::Write;

/// A file with the named effect, `clean`, `pair`, or an effect outside the library.
pub fn workspace_case(kind: &str, seed: u64) -> Case {
    let mut random = Random::new(seed, &format!("workspace {kind}"));
    for _ in 0..200 {
        let wanted = wanted(kind, &mut random);
        if let Some(case) = attempt(kind, seed, &wanted, &mut random) {
            return case;
        }
    }
    panic!("no robot shows {kind} with seed {seed}");
}

fn wanted(kind: &str, random: &mut Random) -> Vec<&'static str> {
    let known = EFFECTS.iter().chain(&OUTSIDE).copied();
    match kind {
        "clean" => Vec::new(),
        "pair" => {
            let first = random.choose(&EFFECTS);
            let others: Vec<_> = EFFECTS.into_iter().filter(|e| *e != first).collect();
            vec![first, random.choose(&others)]
        }
        _ => vec![
            known
                .into_iter()
                .find(|k| *k == kind)
                .expect("no such effect"),
        ],
    }
}

fn attempt(kind: &str, seed: u64, wanted: &[&'static str], random: &mut Random) -> Option<Case> {
    let missing = usize::from(wanted.contains(&"missing_tilt"));
    let lacking = if missing > 0 || random.chance(0.5) {
        random.integer(1, 3)
    } else {
        0
    };
    let file = family::draw(lacking, random);
    let rather = if wanted.contains(&"backlash") {
        0.8
    } else {
        0.5
    };
    let both = random.chance(rather) || wanted.iter().any(|e| wants_both_signs(e));
    let plan = Plan::draw(nine_points(&file, random), both, random);
    let spread = Spread {
        stiffness: plan.spread,
        damping: 0.0,
        mass: 0.02,
        com: 0.005,
        inertia: 0.05,
    };
    let mut scene = Scene::new(family::real(&file, spread, random));
    let mut truths = Vec::new();
    for effect in wanted {
        truths.push(hide(effect, &mut scene, &plan, random)?);
    }
    Some(Case {
        kind: kind.into(),
        seed,
        truths,
        csv: text(&scene, &plan, random),
        note: note(&plan, &file),
        file,
        real: scene.robot,
    })
}

/// Puts an effect into the scene, at a place where it can be seen.
fn hide(
    effect: &'static str,
    scene: &mut Scene,
    plan: &Plan,
    random: &mut Random,
) -> Option<Truth> {
    let before = Before::of(scene, plan);
    for _ in 0..12 {
        let target = random.log_uniform(WEAKEST * 1.1, STRONGEST * 0.95);
        let Some(drawn) = draw(effect, scene, plan, random) else {
            continue;
        };
        let strength = |size: f64| {
            let mut after = scene.clone();
            (drawn.change)(&mut after, size);
            before.strength(&after, plan, drawn.shape)
        };
        if let Some(size) = size_for(target, strength) {
            let strength = strength(size);
            let detail = (drawn.change)(scene, size);
            return Some(Truth {
                effect,
                sites: drawn.sites,
                strength,
                detail,
            });
        }
    }
    None
}

fn note(plan: &Plan, file: &Robot) -> String {
    let lacking = (1..=6).filter(|i| file.joints[i - 1].tilt.is_none());
    format!(
        "{} {} points, {:.0} N, {} steps, {}, noise {:.1} um {}, set-up {:.1} %, springs {:.1} %, no tilt at {:?}, {} more axes",
        file.name,
        plan.layout,
        plan.most(),
        plan.steps.len(),
        if plan.along_only { "along" } else { "xyz" },
        plan.noise.size * 1e6,
        plan.noise.name(),
        plan.setup * 1e2,
        plan.spread * 1e2,
        lacking.collect::<Vec<_>>(),
        file.extra.len()
    )
}

fn front(plan: &Plan) -> String {
    let rows: Vec<String> = plan.points.iter().map(|p| format!("{p:?}")).collect();
    format!(
        "# kind = \"workspace\"\n# robot = \"robot.toml\"\n# joint_angles_deg = [{}]\n# nominal_stiffness_rel_std = {:.4}\n# setup_repeatability = {:.4}\n# sensor_noise_mm = {:.5}\npoint,direction,cycle,force_N,dx_mm,dy_mm,dz_mm\n",
        rows.join(", "),
        plan.spread,
        plan.setup,
        plan.noise.size * 1e3
    )
}

/// Takes the readings: every set-up has a factor of its own and is zeroed on a noisy reading.
fn text(scene: &Scene, plan: &Plan, random: &mut Random) -> String {
    let mut text = front(plan);
    let stands = scene.stands(plan);
    let cell = plan.most() * random.uniform(2e-4, 1e-3);
    for (p, d) in plan.setups() {
        let factor = 1.0 + plan.setup * random.normal();
        let readings = scene.readings(plan, &stands[p], (p, d));
        let noise: [Vec<f64>; 3] =
            std::array::from_fn(|_| plan.noise.stretch(plan.steps.len() + 1, random));
        for (k, (cycle, force)) in plan.steps.iter().enumerate() {
            let off = V3::from_fn(|c, _| noise[c][k + 1] - noise[c][0]);
            let seen = (readings[k] * factor + off) * 1e3;
            let cells: [String; 3] = std::array::from_fn(|c| match plan.measures(d, c) {
                true => format!("{:.5}", seen[c]),
                false => String::new(),
            });
            let force = force + cell * random.normal();
            let name = ["x", "y", "z"][d];
            let _ = writeln!(
                text,
                "{},{name},{cycle},{force:.2},{}",
                p + 1,
                cells.join(",")
            );
        }
    }
    text
}
