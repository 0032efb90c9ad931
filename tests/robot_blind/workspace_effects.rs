//! Effects that a workspace test may hide, and effects that no library holds.

use super::case::between;
use super::law::Law;
use super::robot::{M3, V3};
use super::structure;
use super::workspace::{Plan, Scene, Spoilt};
use crate::blind_generator::random::Random;
use nalgebra::{Rotation3, Unit};

pub const EFFECTS: [&str; 11] = [
    "drive_stiffness",
    "tilt_stiffness",
    "missing_tilt",
    "base_compliance",
    "link_compliance",
    "tool_compliance",
    "force_gain",
    "sensor_gain",
    "load_misalignment",
    "outlier_point",
    "backlash",
];

pub const OUTSIDE: [&str; 6] = [
    "outside:flange_slides",
    "outside:softening",
    "outside:one_sided",
    "outside:cycle_memory",
    "outside:thermal_growth",
    "outside:wavy_joint",
];

/// Changes the scene by a size of 0..1 and says how.
pub type Change = Box<dyn Fn(&mut Scene, f64) -> String>;

/// An effect with its place drawn.
pub struct Drawn {
    pub sites: Vec<String>,
    /// Seen in the shape of the readings over force, not in their slope.
    pub shape: bool,
    pub change: Change,
}

fn drawn(
    sites: &[&str],
    shape: bool,
    change: impl Fn(&mut Scene, f64) -> String + 'static,
) -> Option<Drawn> {
    Some(Drawn {
        sites: sites.iter().map(|s| s.to_string()).collect(),
        shape,
        change: Box::new(change),
    })
}

/// Effects that show only with loads of both signs.
pub fn wants_both_signs(effect: &str) -> bool {
    effect == "outside:one_sided"
}

/// Draws the place of an effect; `None` where the robot has none for it.
pub fn draw(effect: &str, scene: &Scene, plan: &Plan, random: &mut Random) -> Option<Drawn> {
    if let Some((sites, change)) = structure::draw(effect, &scene.robot, 0.0, random) {
        let sites: Vec<&str> = sites.iter().map(String::as_str).collect();
        return drawn(&sites, false, move |s, size| change(&mut s.robot, size));
    }
    match effect {
        "force_gain" => {
            let inverse = random.chance(0.5);
            drawn(&["sensor"], false, move |s, size| {
                let gain = gain(inverse, 1.03, 1.5, size);
                s.force /= gain;
                format!("reported times {gain:.3}")
            })
        }
        "sensor_gain" => {
            let (component, inverse) = (random.integer(0, 2), random.chance(0.5));
            let site = ["sensor-x", "sensor-y", "sensor-z"][component];
            drawn(&[site], false, move |s, size| {
                let gain = gain(inverse, 1.03, 2.0, size);
                s.gains[component] *= gain;
                format!("times {gain:.3}")
            })
        }
        "load_misalignment" => misaligned(random),
        "outlier_point" => spoilt(scene, plan, random),
        "backlash" => gap(random),
        _ => outside(effect, plan, random),
    }
}

pub fn gain(inverse: bool, from: f64, to: f64, size: f64) -> f64 {
    let gain = between(from, to, size);
    if inverse { 1.0 / gain } else { gain }
}

fn any_axis(random: &mut Random) -> Unit<V3> {
    Unit::new_normalize(V3::from_fn(|_, _| random.normal()))
}

/// The rig stands askew: all forces turned alike, or those of one direction alone.
fn misaligned(random: &mut Random) -> Option<Drawn> {
    let (axis, all) = (any_axis(random), random.chance(0.5));
    let one = random.integer(0, 2);
    drawn(&[], false, move |s, size| {
        let degrees = between(0.5, 15.0, size);
        let turned: M3 = Rotation3::from_axis_angle(&axis, f64::to_radians(degrees)) * s.force;
        for d in (0..3).filter(|d| all || *d == one) {
            s.force.set_column(d, &turned.column(d));
        }
        let which = if all { "all" } else { ["x", "y", "z"][one] };
        format!("{which} {degrees:.1} deg about {:.2?}", axis.as_slice())
    })
}

/// One set-up, or all of a point: scaled, or a stand that moves with the load.
fn spoilt(scene: &Scene, plan: &Plan, random: &mut Random) -> Option<Drawn> {
    let point = random.integer(0, plan.points.len() - 1);
    let direction = random.chance(0.5).then(|| random.integer(0, 2));
    let (scaled, sign) = (random.chance(0.6), random.sign());
    let soft = scene.robot.at(&plan.points[point]).compliance().norm();
    let way = any_axis(random).into_inner() * soft;
    drawn(&[&format!("point{}", point + 1)], false, move |s, size| {
        let share = between(0.05, 0.7, size);
        s.spoilt = Some(Spoilt {
            point,
            direction,
            factor: if scaled { 1.0 + sign * share } else { 1.0 },
            stray: if scaled { V3::zeros() } else { way * share },
        });
        let what = if scaled { "scaled" } else { "stray" };
        format!("{what} by {share:.2}, direction {direction:?}")
    })
}

fn gap(random: &mut Random) -> Option<Drawn> {
    let site = format!("A{}", random.integer(1, 6));
    let held = random.chance(0.4);
    let torque = if held {
        random.log_uniform(2.0, 20.0)
    } else {
        random.log_uniform(0.5, 4.0)
    };
    drawn(&[&site.clone()], true, move |s, size| {
        let width = between(1e-6, 4e-4, size);
        s.laws.push(Law::Gap {
            site: site.clone(),
            width,
            torque,
            held,
        });
        let how = if held { "held" } else { "free" };
        format!("{width:.2e} rad, {how}, {torque:.1} Nm")
    })
}

fn outside(effect: &str, plan: &Plan, random: &mut Random) -> Option<Drawn> {
    let joint = random.integer(0, 4);
    let site = format!("A{}", joint + 1);
    let (most, waves) = (plan.most(), random.uniform(3.0, 9.0));
    let axis = random.choose(&[V3::x(), V3::y(), V3::z()]);
    let way = any_axis(random).into_inner();
    let many = plan.steps.last().is_some_and(|s| s.0 > 1);
    match effect {
        "outside:flange_slides" => drawn(&[], false, move |s, size| {
            let soft = between(1e-9, 4e-6, size);
            s.sliding = Some((axis, soft));
            format!("{soft:.2e} m/N along tool {:?}", axis.as_slice())
        }),
        "outside:softening" => drawn(&[], true, move |s, size| {
            let (site, share) = (site.clone(), between(0.01, 5.0, size));
            let scale = 1.5 * most;
            s.laws.push(Law::Softening { site, share, scale });
            format!("A{} by {share:.2} at {scale:.0} Nm", joint + 1)
        }),
        "outside:one_sided" => drawn(&[], true, move |s, size| {
            let (site, share) = (site.clone(), between(0.01, 3.0, size));
            s.laws.push(Law::OneSided { site, share });
            format!("A{} by {share:.2}", joint + 1)
        }),
        "outside:cycle_memory" if many => drawn(&[], true, move |s, size| {
            s.set_per_cycle = between(0.001, 0.3, size);
            format!("{:.3} a cycle", s.set_per_cycle)
        }),
        "outside:thermal_growth" => drawn(&[], true, move |s, size| {
            s.growth = way * between(1e-8, 2e-5, size);
            format!("{:.2e} m a step", s.growth.norm())
        }),
        "outside:wavy_joint" => drawn(&[], false, move |s, size| {
            let (site, share) = (site.clone(), between(0.1, 0.95, size));
            s.laws.push(Law::Wavy {
                site,
                joint,
                share,
                waves,
            });
            format!("A{} by {share:.2}, {waves:.1} a turn", joint + 1)
        }),
        _ => None,
    }
}
