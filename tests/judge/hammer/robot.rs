//! The robots under the hammer: an arm on hinges with bodies of its own, and its file.

use super::super::algebra::{V3, cross, minus, norm, scaled};
use super::super::chance;
use super::super::rigid::{Frame, across, between};
use super::build::{example, stranger};
use ident::ground::random::Random;

/// A hinge with a spring and an oil damper beside it.
#[derive(Debug, Clone)]
pub struct Hinge {
    /// `drive`, `tilt`, `base` or `link`.
    pub kind: &'static str,
    pub site: String,
    /// Joints before it.
    pub link: usize,
    /// Place in the chain.
    pub rank: f64,
    pub axis: V3,
    pub point: V3,
    /// N·m/rad and N·m·s/rad.
    pub k: f64,
    pub d: f64,
}

/// A body; inertia xx yy zz xy xz yz about its centre, base axes at zero.
#[derive(Debug, Clone)]
pub struct Body {
    pub link: usize,
    pub rank: f64,
    pub mass: f64,
    pub com: V3,
    pub inertia: [f64; 6],
}

/// How well the file knows the robot, one standard deviation.
#[derive(Debug, Clone, Copy)]
pub struct Spread {
    pub stiffness: f64,
    pub damping: f64,
    pub mass: f64,
    pub com: f64,
    pub inertia: f64,
    pub gain: f64,
}

/// A robot.
#[derive(Debug, Clone)]
pub struct Robot {
    pub build: String,
    pub frame: Frame,
    pub hinges: Vec<Hinge>,
    pub bodies: Vec<Body>,
    /// Size of its springs beside those of a robot of 210 kg.
    pub scale: f64,
    pub home_deg: [f64; 6],
}

impl Robot {
    /// The example's robot changed, or an arm of three other builds.
    pub fn draw(random: &mut Random) -> Self {
        let mut own = if chance(random, 0.4) {
            example(random)
        } else {
            stranger(random)
        };
        if chance(random, 0.3) {
            own.leave_bearings_out(random);
        }
        if chance(random, 0.25) {
            own.bend_upper_arm(random);
        }
        let oil = random.log_uniform(4e-4, 1.3e-3);
        for (_, _, members) in own.springs() {
            let share = oil * random.log_uniform(0.5, 2.0);
            for i in members {
                own.hinges[i].d = three(own.hinges[i].k * share);
            }
        }
        own
    }

    fn leave_bearings_out(&mut self, random: &mut Random) {
        let all = chance(random, 0.3);
        let gone: Vec<String> = (1..=6)
            .filter(|_| all || chance(random, 0.4))
            .map(|j| format!("A{j}"))
            .collect();
        self.hinges
            .retain(|h| h.kind != "tilt" || !gone.contains(&h.site));
    }

    fn bend_upper_arm(&mut self, random: &mut Random) {
        let [from, to] = [self.frame.points[1], self.frame.points[2]];
        for (i, w) in across(scaled(minus(to, from), 1.0 / norm(minus(to, from))))
            .into_iter()
            .enumerate()
        {
            let k = three(1.5e7 * self.scale * random.uniform(0.7, 1.5));
            self.hinges.push(Hinge {
                kind: "link",
                site: format!("upper-arm-{}", i + 1),
                link: 2,
                rank: 2.3,
                axis: w,
                point: between(from, to, 0.5),
                k,
                d: 0.0,
            });
        }
    }

    /// Hinges of one kind and site.
    pub fn group(&self, kind: &str, site: &str) -> Vec<usize> {
        let own = |h: &Hinge| h.kind == kind && (h.site == site || site.is_empty());
        (0..self.hinges.len())
            .filter(|i| own(&self.hinges[*i]))
            .collect()
    }

    /// All springs as the file states them: kind, site and hinges.
    pub fn springs(&self) -> Vec<(&'static str, String, Vec<usize>)> {
        let mut all: Vec<(&'static str, String, Vec<usize>)> = Vec::new();
        for (i, h) in self.hinges.iter().enumerate() {
            match all.iter_mut().find(|s| s.0 == h.kind && s.1 == h.site) {
                Some(own) => own.2.push(i),
                None => all.push((h.kind, h.site.clone(), vec![i])),
            }
        }
        all
    }

    /// What stands in the laboratory when this is what the file says.
    pub fn real(&self, spread: &Spread, random: &mut Random) -> Self {
        let mut own = self.clone();
        for (_, _, members) in self.springs() {
            let k = (spread.stiffness * bounded(random)).exp();
            let d = (spread.damping * bounded(random)).exp();
            for i in members {
                own.hinges[i].k *= k;
                own.hinges[i].d *= d;
            }
        }
        for body in &mut own.bodies {
            body.mass *= 1.0 + spread.mass * bounded(random);
            body.com = body.com.map(|c| c + spread.com * bounded(random));
            let share = 1.0 + spread.inertia * bounded(random);
            body.inertia = body.inertia.map(|i| i * share);
        }
        own
    }

    /// The robot file; where asked for, with how well it says it knows every spring.
    pub fn document(&self, told: Option<f64>) -> String {
        let known = told.map_or(String::new(), |n| format!(", stiffness_rel_std = {n:.3}"));
        let spring = |name: &str, h: &Hinge| {
            format!(
                "{name} = {{ stiffness_Nm_rad = {:?}, damping_Nms_rad = {:?}{known} }}\n",
                h.k, h.d
            )
        };
        let mut doc = String::from("name = \"stranger\"\nsource = \"made up\"\n");
        for j in 0..6 {
            let site = format!("A{}", j + 1);
            doc += &format!(
                "[[joints]]\nname = \"{site}\"\naxis = {}\npoint_m = {}\nlimits_deg = [-350.0, 350.0]\nmax_speed_deg_s = 100.0\n",
                list(&self.frame.axes[j]),
                list(&self.frame.points[j])
            );
            for kind in ["drive", "tilt"] {
                if let Some(i) = self.group(kind, &site).first() {
                    doc += &spring(kind, &self.hinges[*i]);
                }
            }
            doc += &format!("link = {}\n", body(&self.bodies[j]));
        }
        doc += &format!(
            "[tool]\nflange_m = {}\ntcp_m = {}\nbody = {}\n",
            list(&self.frame.flange),
            list(&self.frame.tcp),
            body(&self.bodies[6])
        );
        let further = |h: &&Hinge| matches!(h.kind, "base" | "link");
        for h in self.hinges.iter().filter(further) {
            doc += &format!(
                "[[elastic]]\nname = \"{}\"\nafter = {}\naxis = {}\npoint_m = {}\nstiffness_Nm_rad = {:?}\ndamping_Nms_rad = {:?}\n{}",
                h.site,
                h.link,
                list(&h.axis),
                list(&h.point),
                h.k,
                h.d,
                told.map_or(String::new(), |n| format!("stiffness_rel_std = {n:.3}\n"))
            );
        }
        doc
    }
}

fn list(v: &[f64]) -> String {
    let all: Vec<String> = v.iter().map(|x| format!("{:?}", x + 0.0)).collect();
    format!("[{}]", all.join(", "))
}

fn body(b: &Body) -> String {
    format!(
        "{{ mass_kg = {:?}, com_m = {}, inertia_kgm2 = {} }}",
        b.mass,
        list(&b.com),
        list(&b.inertia)
    )
}

/// Three leading digits.
pub fn three(x: f64) -> f64 {
    let step = 10f64.powf(x.abs().log10().floor() - 2.0);
    (x / step).round() * step
}

/// A normal number that stays within two standard deviations.
pub fn bounded(random: &mut Random) -> f64 {
    random.normal().clamp(-2.0, 2.0)
}

/// Velocity of a place per unit rate of a hinge line.
pub fn swing(a: V3, p: V3, x: V3) -> V3 {
    cross(a, minus(x, p))
}

/// Both ends of a link that may bend.
pub fn span(robot: &Robot, link: usize) -> (V3, V3) {
    let p = &robot.frame.points;
    match norm(std::array::from_fn(|i| p[link][i] - p[link - 1][i])) > 0.05 {
        true => (p[link - 1], p[link]),
        false => (p[link - 1], p[(link + 1).min(5)]),
    }
}

/// Unit vector from one place to another; up where they are one.
pub fn along(from: V3, to: V3) -> V3 {
    let way: V3 = std::array::from_fn(|i| to[i] - from[i]);
    match norm(way) > 1e-6 {
        true => way.map(|x| x / norm(way)),
        false => [0.0, 0.0, 1.0],
    }
}
