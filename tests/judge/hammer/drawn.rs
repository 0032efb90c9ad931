//! Where a hidden cause sits and which law it follows.

use super::super::algebra::{V3, minus, norm, plus, scaled, unit};
use super::super::rigid::{across, between};
use super::super::{chance, pick};
use super::dynamics::{World, lines};
use super::habit::Habit;
use super::hidden::{EFFECTS, Hidden, Kind};
use super::robot::{Body, Hinge, Robot, along, span};
use ident::ground::random::Random;
use std::f64::consts::TAU;

impl Hidden {
    /// Draws one; nothing where the robot has no place for it.
    pub fn draw(
        name: &'static str,
        world: &World,
        told: &Robot,
        habit: &Habit,
        random: &mut Random,
    ) -> Option<Self> {
        let of = |site: Option<String>, law: String, kind| {
            Some(Self {
                effect: if EFFECTS.contains(&name) {
                    name
                } else {
                    "outside"
                },
                site,
                law,
                kind,
            })
        };
        let hinge = |random: &mut Random| {
            let j = random.below(6);
            (j, format!("A{}", j + 1))
        };
        match name {
            "drive_stiffness" | "tilt_stiffness" => {
                let site = hinge(random).1;
                let members = told.group(&name[..name.len() - 10], &site);
                let sign = if chance(random, 0.7) { -1.0 } else { 1.0 };
                let law = if sign < 0.0 { "softer" } else { "stiffer" };
                (!members.is_empty()).then_some(())?;
                of(Some(site), law.into(), Kind::Springs(members, sign))
            }
            "missing_tilt" => {
                let (j, site) = hinge(random);
                told.group("tilt", &site).is_empty().then_some(())?;
                let k = told.scale * [1.3e7, 2.6e7, 3e6, 2e6, 1e6, 1.9e6][j];
                let line = (told.frame.points[j], (j, j as f64 + 0.7));
                let all = soft(&across(told.frame.axes[j]), line, k, random);
                of(Some(site), "bearing".into(), Kind::Hinges(all))
            }
            "base_compliance" => {
                let feet = told.group("base", "");
                if !feet.is_empty() && chance(random, 0.6) {
                    return of(None, "softer bolts".into(), Kind::Springs(feet, -1.0));
                }
                let at = [
                    random.uniform(-0.15, 0.15),
                    random.uniform(-0.15, 0.15),
                    random.uniform(-0.1, 0.05),
                ];
                let about = random.uniform(0.0, TAU);
                let axes = [
                    [about.cos(), about.sin(), 0.0],
                    [-about.sin(), about.cos(), 0.0],
                ];
                let all = soft(&axes, (at, (0, 0.2)), 3e7 * told.scale, random);
                of(None, "rocking foot".into(), Kind::Hinges(all))
            }
            "link_compliance" => {
                let own: Vec<usize> = told.group("link", "");
                if !own.is_empty() && chance(random, 0.5) {
                    return of(None, "softer arm".into(), Kind::Springs(own, -1.0));
                }
                let link = 2 + random.below(2);
                let (from, to) = span(told, link);
                let place = between(from, to, random.uniform(0.35, 0.65));
                let rank = (link, link as f64 + 0.1);
                let k = [1.5e7, 6e6][link - 2] * told.scale;
                let all = soft(&across(along(from, to)), (place, rank), k, random);
                of(
                    Some(format!("link{link}")),
                    "bend".into(),
                    Kind::Hinges(all),
                )
            }
            "added_mass" => {
                let tool = chance(random, 0.6);
                let (link, kg) = if tool { (6, 3.0) } else { (3, 15.0) };
                let aim = match tool {
                    true => between(told.frame.flange, told.frame.tcp, random.uniform(0.2, 1.0)),
                    false => {
                        let (from, to) = span(told, 3);
                        between(from, to, random.uniform(0.3, 0.9))
                    }
                };
                let aside: V3 = std::array::from_fn(|_| random.uniform(-0.08, 0.08));
                let size = kg * 0.01;
                let body = Body {
                    link,
                    rank: if tool { 6.9 } else { 3.0 },
                    mass: kg,
                    com: plus(aim, aside),
                    inertia: [size, size, size, 0.0, 0.0, 0.0],
                };
                let site = if tool { "tool" } else { "link3" };
                of(Some(site.into()), format!("{kg} kg"), Kind::Mass(body))
            }
            "joint_damping" => {
                let (_, site) = hinge(random);
                let kind = *pick(random, &["drive", "drive", "tilt"]);
                let members = told.group(kind, &site);
                (!members.is_empty()).then_some(())?;
                let more = chance(random, 0.75);
                let law = format!("{kind} {}", if more { "more" } else { "less" });
                of(Some(site), law, Kind::Oil(members, more))
            }
            "accelerometer_misalignment" => {
                let any = unit([random.normal(), random.normal(), random.normal()]);
                let one = *pick(random, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
                let about = if chance(random, 0.5) { any } else { one };
                of(None, "0.3 rad".into(), Kind::Turn(scaled(about, 0.3)))
            }
            "accelerometer_gain" => {
                let sign = *pick(random, &[0.06, -0.06]);
                let axis = *pick(random, &[0, 1, 2, 0, 1, 2, 3]);
                let read = axis == 3 || habit.responses.contains(&axis);
                read.then_some(())?;
                let axes = std::array::from_fn(|i| if axis == 3 || axis == i { sign } else { 0.0 });
                let law = ["x", "y", "z", "all"][axis];
                let site = (axis < 3).then(|| format!("sensor-{law}"));
                of(site, format!("{law} {sign}"), Kind::Gain(axes))
            }
            "time_skew" => of(None, "0.8 ms".into(), Kind::Late(8e-4)),
            "exponential_window" => of(None, "0.25 1/s".into(), Kind::Window(0.25)),
            "double_hit" => {
                let whole = chance(random, 0.3);
                let direction = *pick(random, &habit.directions());
                let struck = habit
                    .hits
                    .iter()
                    .filter(|h| whole || h.direction == direction);
                let own: Vec<(usize, usize, f64, f64)> = struck
                    .map(|h| {
                        let (share, after) =
                            (random.uniform(0.12, 0.6), random.uniform(0.018, 0.07));
                        (h.direction, h.number, share, after)
                    })
                    .collect();
                let law = format!("{} of {}", own.len(), habit.hits.len());
                of(None, law, Kind::Second(own))
            }
            "absorber" => {
                let dir = unit([random.normal(), random.normal(), random.normal()]);
                let (f, zeta) = (random.uniform(9.0, 38.0), random.uniform(0.01, 0.04));
                of(
                    None,
                    format!("absorber; {f:.0} Hz"),
                    Kind::Absorber(dir, 1.0, f, zeta),
                )
            }
            "cubic spring" | "play" => {
                let site = format!("A{}", 1 + random.below(3));
                let i = told.group("drive", &site)[0];
                let angle = largest(world, habit, i);
                match name {
                    "play" => of(None, format!("play; {site}"), Kind::Play(i, 0.05 * angle)),
                    _ => of(None, format!("cubic spring; {site}"), Kind::Cubic(i, angle)),
                }
            }
            "hits beside the aim" => of(
                None,
                "hits beside the aim; 40 mm".into(),
                Kind::Wander(0.04),
            ),
            "knocking cable" => of(None, "knocking cable; 2 %".into(), Kind::Knock(0.02)),
            _ => {
                let site = format!("A{}", 1 + random.below(3));
                let i = told.group("drive", &site)[0];
                let slow = 1.0 / (TAU * random.log_uniform(5.0, 20.0));
                of(None, format!("rubber; {site}"), Kind::Rubber(i, slow))
            }
        }
    }
}

/// Hinges that give about some axes, the second by another measure than the first.
fn soft(axes: &[V3], at: (V3, (usize, f64)), k: f64, random: &mut Random) -> Vec<Hinge> {
    let (ratio, oil) = (random.uniform(0.7, 1.5), random.log_uniform(4e-4, 1.5e-3));
    let one = |(i, axis): (usize, &V3)| {
        let k = if i == 0 { k } else { k * ratio };
        Hinge {
            kind: "new",
            site: String::new(),
            link: at.1.0,
            rank: at.1.1,
            axis: *axis,
            point: at.0,
            k,
            d: oil * k,
        }
    };
    axes.iter().enumerate().map(one).collect()
}

/// About how far a hinge goes under the day's first hit: the impulse over its own inertia.
fn largest(world: &World, habit: &Habit, i: usize) -> f64 {
    let plant = world.plant();
    let hit = &habit.hits[0];
    let impulse: f64 = hit.pulse.iter().sum::<f64>() * habit.step();
    let (_, p) = lines(&world.robot, &world.joints)[i];
    let lever = norm(minus(world.tip(), p));
    let inertia = plant.m[(i, i)];
    impulse * lever / (inertia * plant.k[(i, i)]).sqrt()
}
