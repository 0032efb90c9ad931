//! Hammer files with known truths.

use super::case::{Case, STRONGEST, Truth, WEAKEST, size_for};
use super::family;
use super::hammer::{Bench, Hit, Plan, Scene};
use super::hammer_effects::{Drawn, EFFECTS, OUTSIDE, draw};
use super::hammer_strength::{Before, spread};
use super::poses::random_pose;
use super::robot::Robot;
use super::structure::OBLIQUE;
use crate::blind_generator::random::Random;
use std::fmt::Write;

/// A file with the named effect, `clean`, `pair`, or an effect outside the library.
pub fn hammer_case(kind: &str, seed: u64) -> Case {
    let mut random = Random::new(seed, &format!("hammer {kind}"));
    for _ in 0..200 {
        let wanted = wanted(kind, &mut random);
        if let Some(case) = attempt(kind, seed, &wanted, &mut random) {
            return case;
        }
    }
    panic!("no robot shows {kind} with seed {seed}");
}

fn wanted(kind: &str, random: &mut Random) -> Vec<&'static str> {
    let mut known = EFFECTS.iter().chain(&OBLIQUE).chain(&OUTSIDE).copied();
    match kind {
        "clean" => Vec::new(),
        "pair" => {
            let first = random.choose(&EFFECTS);
            let others: Vec<_> = EFFECTS.into_iter().filter(|e| *e != first).collect();
            vec![first, random.choose(&others)]
        }
        _ => vec![known.find(|k| *k == kind).expect("no such effect")],
    }
}

fn attempt(kind: &str, seed: u64, wanted: &[&'static str], random: &mut Random) -> Option<Case> {
    let missing = wanted.contains(&"missing_tilt");
    let lacking = if missing || random.chance(0.4) {
        random.integer(1, 2)
    } else {
        0
    };
    let file = family::draw(lacking, random);
    let stiffness = random.uniform(0.02, 0.06);
    let real = family::real(&file, spread(stiffness), random);
    let plan = Plan::draw(&real, random_pose(&file, random), random);
    let mut scene = Scene::new(real);
    let mut truths = Vec::new();
    for effect in wanted {
        let before = Before::of(&scene, &file, stiffness, &plan, random);
        truths.push(hide(effect, &mut scene, &before, &plan, random)?);
    }
    Some(Case {
        kind: kind.into(),
        seed,
        truths,
        csv: text(&scene, &plan, stiffness, random),
        note: note(&plan, stiffness, &file),
        file,
        real: scene.robot,
    })
}

/// Puts an effect into the scene, at a place where it can be seen.
fn hide(
    effect: &'static str,
    scene: &mut Scene,
    before: &Before,
    plan: &Plan,
    random: &mut Random,
) -> Option<Truth> {
    for _ in 0..10 {
        let target = random.log_uniform(WEAKEST * 1.1, STRONGEST * 0.95);
        let Some(drawn) = draw(effect, scene, plan, random) else {
            continue;
        };
        let after = |size: f64| {
            let mut after = scene.clone();
            (drawn.change)(&mut after, size);
            before.strength(&secant(after), plan)
        };
        let size = if drawn.in_records {
            Some(0.0)
        } else {
            size_for(target, after)
        };
        if let Some(size) = size {
            let strength = if drawn.in_records {
                WEAKEST
            } else {
                after(size)
            };
            return Some(truth(effect, drawn, strength, size, scene));
        }
    }
    None
}

fn truth(effect: &'static str, drawn: Drawn, strength: f64, size: f64, scene: &mut Scene) -> Truth {
    Truth {
        effect: effect.trim_end_matches(":oblique"),
        strength,
        detail: (drawn.change)(scene, size),
        sites: drawn.sites,
    }
}

/// A softening drive as the middling hit sees it: half of the loss.
fn secant(mut scene: Scene) -> Scene {
    if let Some((site, share, _)) = scene.softening.clone() {
        let joint: usize = site[1..].parse().unwrap();
        scene.robot.joints[joint - 1].drive.stiffness *= 1.0 - 0.5 * share;
    }
    scene
}

pub(super) fn note(plan: &Plan, stiffness: f64, file: &Robot) -> String {
    let lacking = (1..=6).filter(|i| file.joints[i - 1].tilt.is_none());
    format!(
        "{} at {:?}, {} Hz, {:.2} s, {} hits of {:.0} N in {:.1} ms, noise {:.4} {}, window {:?}, springs {:.1} %, no tilt at {:?}, {} more axes",
        file.name,
        plan.pose,
        plan.rate,
        plan.length,
        plan.hits,
        plan.peak,
        plan.width * 1e3,
        plan.noise.size,
        plan.noise.name(),
        plan.window,
        stiffness * 1e2,
        lacking.collect::<Vec<_>>(),
        file.extra.len()
    )
}

pub(super) fn text(scene: &Scene, plan: &Plan, stiffness: f64, random: &mut Random) -> String {
    let mut text = format!(
        "# kind = \"hammer\"\n# robot = \"robot.toml\"\n# joint_angles_deg = {:?}\n# accelerometer_noise_m_s2 = {:.6}\n# nominal_stiffness_rel_std = {stiffness:.4}\n",
        plan.pose, plan.noise.size
    );
    if let Some(tau) = plan.window {
        let _ = writeln!(text, "# exponential_window_s = {tau:.6}");
    }
    text.push_str("direction,hit,time_s,force_N,ax_m_s2,ay_m_s2,az_m_s2\n");
    let bench = Bench::new(plan, scene);
    for (direction, name) in ["x", "y", "z"].iter().enumerate() {
        for hit in 1..=plan.hits {
            rows(
                &mut text,
                name,
                hit,
                plan.rate,
                &bench.hit(direction, random),
            );
        }
    }
    text
}

fn rows(text: &mut String, direction: &str, hit: usize, rate: usize, record: &Hit) {
    let (force, [x, y, z]) = record;
    for (i, f) in force.iter().enumerate() {
        let t = i as f64 / rate as f64;
        let (x, y, z) = (x[i], y[i], z[i]);
        let _ = writeln!(text, "{direction},{hit},{t:.9},{f:.3},{x:.6},{y:.6},{z:.6}");
    }
}
