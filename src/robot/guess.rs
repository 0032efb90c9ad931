//! Springs and bodies that nobody stated, guessed from another robot by geometric similarity: stiffness and
//! mass grow with the third power of the reach, damping with the fourth, so that damping ratios stay. Every
//! guess says that it is one, and how far it may be off.

use super::body::Body;
use super::model::{Joint, Robot};
use super::spring::Spring;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{V3, add, norm, scale, sub};

/// Radius of a guessed link over the reach.
const RADIUS: f64 = 0.05;
/// Least length of a guessed link over its radius.
const SHORTEST: f64 = 1.0;

/// How to guess.
#[derive(Debug, Clone, Copy)]
pub struct Guess<'a> {
    /// The robot to follow.
    pub like: &'a Robot,
    /// Relative standard deviation of a stiffness that is not stated.
    pub spread: f64,
    /// Mass of all links, kg, where it is known.
    pub mass_kg: Option<f64>,
}

/// What had to be guessed, in words.
pub type Guessed = Vec<String>;

/// Fills in what the robot does not state.
///
/// # Errors
/// Links that weigh more than the whole robot.
pub fn fill(mut robot: Robot, guess: &Guess) -> Outcome<(Robot, Guessed)> {
    let by = reach(&robot) / reach(guess.like);
    let mut said = Vec::new();
    let masses = masses(&robot, guess, by)?;
    let ends: Vec<V3> = ends(&robot);
    let (count, radius) = (robot.dof(), RADIUS * reach(&robot));
    let origin = origin(guess, by);
    for (i, joint) in robot.joints.iter_mut().enumerate() {
        let like = &guess.like.joints[place(i, count, guess.like.dof())];
        for (site, drive) in [(joint.name.clone(), true), (joint.tilt_site(), false)] {
            let (own, other) = match drive {
                true => (&mut joint.drive, &like.drive),
                false => (&mut joint.tilt, &like.tilt),
            };
            said.extend(
                spring(own, other.as_ref(), guess, by, &origin)
                    .map(|what| format!("{site}: {what}")),
            );
        }
        if body(joint, masses[i], ends[i], radius) {
            said.push(format!("{}: body", joint.link_name));
            joint.source.get_or_insert_with(|| {
                format!("body guessed: a bar with its share of the mass; {origin}")
            });
        }
    }
    if !said.is_empty() {
        robot
            .notes
            .push(format!("guessed ({origin}): {}", said.join(", ")));
    }
    Ok((robot, said))
}

fn origin(guess: &Guess, by: f64) -> String {
    format!("like {} times {by:.2} in length", guess.like.name)
}

/// The joint of the other robot at the same place in the chain.
fn place(i: usize, count: usize, other: usize) -> usize {
    match count {
        0 | 1 => 0,
        _ => (i as f64 * (other - 1) as f64 / (count - 1) as f64).round() as usize,
    }
}

/// Length of the stretched arm from the second joint on, m.
pub fn reach(robot: &Robot) -> f64 {
    let points = robot.joints.iter().skip(1).map(|joint| joint.point);
    let points: Vec<V3> = points.chain([robot.tool.flange]).collect();
    let arm = points
        .windows(2)
        .map(|pair| norm(sub(pair[1], pair[0])))
        .sum::<f64>();
    arm.max(1e-3)
}

/// Fills in a spring; what was guessed of it.
fn spring(
    own: &mut Option<Spring>,
    like: Option<&Spring>,
    guess: &Guess,
    by: f64,
    origin: &str,
) -> Option<String> {
    let like = like?;
    let damping_s = like.damping / like.stiffness * by;
    match own {
        None => {
            let stiffness = rounded(like.stiffness * by.powi(3));
            *own = Some(Spring {
                stiffness,
                damping: rounded(stiffness * damping_s),
                stiffness_rel_std: Some(guess.spread),
                source: Some(format!("guessed: {origin}")),
                ..Spring::default()
            });
            Some("stiffness and damping".into())
        }
        Some(spring) => {
            spring.stiffness_rel_std = spring.relative_std().or(Some(guess.spread));
            let open = spring.damping == 0.0;
            if open {
                spring.damping = rounded(spring.stiffness * damping_s);
                spring
                    .source
                    .get_or_insert_with(|| format!("damping guessed: {origin}"));
            }
            open.then(|| "damping".into())
        }
    }
}

/// Three digits: a guess has no more.
fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// Mass of every link, stated or shared out, kg.
fn masses(robot: &Robot, guess: &Guess, by: f64) -> Outcome<Vec<f64>> {
    let stated: Vec<Option<f64>> = robot
        .joints
        .iter()
        .map(|j| j.link.map(|b| b.mass).filter(|m| *m > 0.0))
        .collect();
    let like = |i: usize| {
        let joint = &guess.like.joints[place(i, robot.dof(), guess.like.dof())];
        joint.link.map_or(1.0, |body| body.mass)
    };
    let open: f64 = (0..robot.dof())
        .filter(|i| stated[*i].is_none())
        .map(like)
        .sum();
    let known: f64 = stated.iter().flatten().sum();
    let times = match guess.mass_kg {
        None => by.powi(3),
        Some(_) if open == 0.0 => 1.0,
        Some(all) if all > known => (all - known) / open,
        Some(all) => {
            let what = format!("{all} kg, less than the {known} kg of the links that state a mass");
            return Err(
                Problem::new(what, "give the mass of all moving links").in_column("mass_kg")
            );
        }
    };
    Ok(stated
        .iter()
        .enumerate()
        .map(|(i, mass)| mass.unwrap_or_else(|| rounded(like(i) * times)))
        .collect())
}

/// Where every link ends: the next joint, of the last one the flange.
fn ends(robot: &Robot) -> Vec<V3> {
    let next = robot.joints.iter().skip(1).map(|joint| joint.point);
    next.chain([robot.tool.flange]).collect()
}

/// Gives a joint a bar from its point to `end`, unless its body has an inertia; whether it did.
fn body(joint: &mut Joint, mass: f64, end: V3, radius: f64) -> bool {
    if joint
        .link
        .is_some_and(|body| body.mass > 0.0 && body.inertia != [0.0; 6])
    {
        return false;
    }
    let along = sub(end, joint.point);
    let length = norm(along).max(SHORTEST * radius);
    let direction = scale(1.0 / norm(along).max(1e-12), along);
    let (axial, across) = (
        0.5 * mass * radius * radius,
        mass * (3.0 * radius * radius + length * length) / 12.0,
    );
    // I = across·1 + (axial − across)·d·dᵀ
    let of = |i: usize, j: usize| {
        let own = if i == j { across } else { 0.0 };
        own + (axial - across) * direction[i] * direction[j]
    };
    joint.link = Some(Body {
        mass,
        com: add(joint.point, scale(0.5, along)),
        inertia: [of(0, 0), of(1, 1), of(2, 2), of(0, 1), of(0, 2), of(1, 2)],
    });
    true
}
