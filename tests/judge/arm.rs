//! Elastic six-axis robots drawn at random, and their files: three builds (arm level at zero, arm upright at
//! zero, three parallel axes with an offset wrist), on the floor, askew in the hall or under a ceiling.

use super::algebra::{Quat, V3, axis, cross, dot, minus, plus, scaled, turn, turned, unit};
use super::rigid::{Frame, Motion, across, between, facing, postured};
use super::{chance, pick};
use ident::ground::random::Random;
use std::f64::consts::PI;

/// A spring about a line of a link, at zero.
#[derive(Debug, Clone)]
pub struct Spring {
    /// What it would be blamed as, and where.
    pub effect: &'static str,
    pub site: String,
    /// Link it is fixed to before it gives, 0 the foundation.
    pub link: usize,
    /// Place in the chain.
    pub rank: f64,
    pub axis: V3,
    pub point: V3,
    /// N·m/rad.
    pub stiffness: f64,
    /// Whether the robot file has it.
    pub told: bool,
}

/// A line in a posture.
pub type Line = (V3, V3);

/// A robot.
#[derive(Debug, Clone)]
pub struct Arm {
    pub build: &'static str,
    pub frame: Frame,
    pub springs: Vec<Spring>,
    /// Masses with the link they move with and their centres at zero.
    pub bodies: Vec<(usize, f64, V3)>,
    /// Its file.
    pub text: String,
    /// Size of its springs beside those of a robot of 210 kg.
    pub scale: f64,
    /// A posture from which others are drawn, deg.
    pub home_deg: [f64; 6],
    /// The directions of the foundation, base frame: across, across, up.
    pub ground: [V3; 3],
}

const DRIVES: [f64; 6] = [5.6e6, 8.0e6, 3.1e6, 7.2e5, 6.6e5, 3.1e5];
const TILTS: [f64; 6] = [1.3e7, 2.6e7, 1.5e6, 1.9e6, 6.6e5, 1.9e6];

fn millimetre(x: V3) -> V3 {
    x.map(|v| (v * 1e3).round() / 1e3)
}

/// Arm and fore-arm stretched along x at zero, drive signs of one maker.
fn level(s: &mut dyn FnMut(f64) -> f64) -> (Frame, [f64; 6]) {
    let (d, h, upper, drop, fore, hand) = (s(0.35), s(0.7), s(1.2), s(-0.05), s(1.1), s(0.22));
    let (elbow, wrist) = (d + upper, d + upper + fore);
    let z = h - drop;
    let points = [
        [0.0, 0.0, h],
        [d, 0.0, h],
        [elbow, 0.0, h],
        [elbow + 0.4 * fore, 0.0, z],
        [wrist, 0.0, z],
        [wrist + hand, 0.0, z],
    ];
    let (x, y, up) = (axis(0), axis(1), axis(2));
    let frame = Frame {
        axes: [scaled(up, -1.0), y, y, scaled(x, -1.0), y, scaled(x, -1.0)],
        points,
        flange: points[5],
        tcp: plus(points[5], [s(0.28), 0.0, -s(0.15)]),
    };
    (frame, [0.0, -80.0, 95.0, 0.0, 55.0, 0.0])
}

/// Arm upright, fore-arm level at zero.
fn upright(s: &mut dyn FnMut(f64) -> f64) -> (Frame, [f64; 6]) {
    let (d, h, upper, rise, fore, hand) = (s(0.3), s(0.75), s(1.1), s(0.2), s(1.2), s(0.2));
    let (x, y, up) = (axis(0), axis(1), axis(2));
    let z = h + upper + rise;
    let points = [
        [0.0, 0.0, 0.5 * h],
        [d, 0.0, h],
        [d, 0.0, h + upper],
        [d + 0.5 * fore, 0.0, z],
        [d + fore, 0.0, z],
        [d + fore + hand, 0.0, z],
    ];
    let frame = Frame {
        axes: [up, y, y, x, y, x],
        points,
        flange: points[5],
        tcp: plus(points[5], [s(0.18), s(0.05), s(0.1)]),
    };
    (frame, [0.0, 15.0, 5.0, 10.0, 50.0, 0.0])
}

/// Three parallel axes, wrist without a common point.
fn parallel(s: &mut dyn FnMut(f64) -> f64) -> (Frame, [f64; 6]) {
    let (h, side, upper, fore, a, b) = (s(0.25), s(0.18), s(0.75), s(0.7), s(0.15), s(0.13));
    let (y, up) = (axis(1), axis(2));
    let down = scaled(up, -1.0);
    let reach = upper + fore;
    let points = [
        [0.0, 0.0, 0.3 * h],
        [0.0, side, h],
        [upper, side, h],
        [reach, side - 0.1, h],
        [reach, side + a - 0.1, h],
        [reach, side + a - 0.1, h - b],
    ];
    let flange = plus(points[5], [0.0, s(0.1), 0.0]);
    let frame = Frame {
        axes: [up, y, y, y, down, y],
        points,
        flange,
        tcp: plus(flange, [s(0.03), s(0.17), 0.0]),
    };
    (frame, [0.0, -60.0, 80.0, -30.0, -80.0, 20.0])
}

/// Turns the whole robot about its foot.
fn turned_whole(frame: &Frame, q: Quat) -> Frame {
    Frame {
        axes: frame.axes.map(|a| turned(q, a)),
        points: frame.points.map(|p| millimetre(turned(q, p))),
        flange: millimetre(turned(q, frame.flange)),
        tcp: millimetre(turned(q, frame.tcp)),
    }
}

impl Arm {
    /// A robot whose file states every spring; bearings of every joint, of some or of none.
    pub fn draw(random: &mut Random) -> Self {
        let size = random.uniform(0.75, 1.2);
        let family = *pick(
            random,
            &["level", "level", "upright", "upright", "parallel"],
        );
        let mut s = |x: f64| x * size * random.uniform(0.85, 1.15);
        let (frame, home_deg) = match family {
            "level" => level(&mut s),
            "upright" => upright(&mut s),
            _ => parallel(&mut s),
        };
        let (q, place) = match random.below(10) {
            0 => (turn(axis(0), PI), " under the ceiling"),
            1 | 2 => (
                turn(axis(2), (random.uniform(-90.0, 90.0_f64)).to_radians()),
                " askew",
            ),
            _ => ([1.0, 0.0, 0.0, 0.0], ""),
        };
        let frame = turned_whole(&frame, q);
        let scale = random.log_uniform(0.4, 1.6) * if family == "parallel" { 0.25 } else { 1.0 };
        let mut own = Self {
            build: match (family, place) {
                ("level", "") => "level",
                ("level", _) => "level, placed",
                ("upright", "") => "upright",
                ("upright", _) => "upright, placed",
                _ => "parallel",
            },
            ground: [0, 1, 2].map(|i| turned(q, axis(i))),
            frame,
            springs: Vec::new(),
            bodies: Vec::new(),
            text: String::new(),
            scale,
            home_deg,
        };
        own.build_springs(random);
        own.build_bodies(size);
        own.text = own.document(None, 0.0);
        own
    }

    fn build_springs(&mut self, random: &mut Random) {
        let bearings = random.below(10);
        if chance(random, 0.15) {
            for (i, name) in ["foot-x", "foot-y"].iter().enumerate() {
                let k = (3e7 * self.scale * random.uniform(0.7, 1.4)).round();
                self.add(
                    "base_compliance",
                    name,
                    (0, 0.3),
                    (self.ground[i], [0.0; 3]),
                    k,
                );
            }
        }
        for j in 0..6 {
            let line = (self.frame.axes[j], self.frame.points[j]);
            let site = format!("A{}", j + 1);
            let mut of = |k: f64| (k * self.scale * random.uniform(0.6, 1.6)).round();
            let (drive, tilt) = (of(DRIVES[j]), of(TILTS[j]));
            let has = match bearings {
                0..6 => true,
                6 | 7 => false,
                _ => chance(random, 0.5),
            };
            if has {
                for a in across(line.0) {
                    self.add(
                        "tilt_stiffness",
                        &site,
                        (j, j as f64 + 0.7),
                        (a, line.1),
                        tilt,
                    );
                }
            }
            self.add("drive_stiffness", &site, (j, j as f64 + 0.8), line, drive);
        }
    }

    fn add(&mut self, effect: &'static str, site: &str, at: (usize, f64), line: Line, k: f64) {
        self.springs.push(Spring {
            effect,
            site: site.into(),
            link: at.0,
            rank: at.1,
            axis: line.0,
            point: line.1,
            stiffness: k,
            told: true,
        });
    }

    fn build_bodies(&mut self, size: f64) {
        for (j, mass) in [360.0, 230.0, 190.0, 45.0, 20.0, 10.0, 45.0]
            .into_iter()
            .enumerate()
        {
            let com = match j {
                0..5 => between(self.frame.points[j], self.frame.points[j + 1], 0.5),
                5 => self.frame.flange,
                _ => between(self.frame.flange, self.frame.tcp, 0.3),
            };
            let mass = (mass * size.powi(2) * self.scale.min(1.0)).round().max(2.0);
            self.bodies.push(((j + 1).min(6), mass, millimetre(com)));
        }
    }

    /// Spring of a site.
    pub fn stiffness(&self, effect: &str, site: &str) -> Option<f64> {
        let own = |s: &&Spring| s.effect == effect && s.site == site;
        self.springs.iter().find(own).map(|s| s.stiffness)
    }

    /// The robot file; with how well it says it knows every spring, and damping over stiffness (s).
    pub fn document(&self, near: Option<f64>, damped: f64) -> String {
        let damping = |k: f64| (1e3_f64).max(damped * k).round();
        let known = near.map_or(String::new(), |n| format!(", stiffness_rel_std = {n}"));
        let v = |x: V3| format!("[{:?}, {:?}, {:?}]", x[0] + 0.0, x[1] + 0.0, x[2] + 0.0);
        let body = |(_, m, c): &(usize, f64, V3)| {
            let i = 0.1 * m;
            format!(
                "{{ mass_kg = {m:?}, com_m = {}, inertia_kgm2 = [{i:?}, {i:?}, {i:?}, 0.0, 0.0, 0.0] }}",
                v(*c)
            )
        };
        let mut doc = String::from("name = \"stranger\"\nsource = \"made up\"\n");
        for j in 0..6 {
            let site = format!("A{}", j + 1);
            let drive = self.stiffness("drive_stiffness", &site).unwrap();
            doc += &format!(
                "[[joints]]\nname = \"{site}\"\naxis = {}\npoint_m = {}\nlimits_deg = [-185.0, 185.0]\nmax_speed_deg_s = 100.0\ndrive = {{ stiffness_Nm_rad = {drive:?}, damping_Nms_rad = {:?}{known} }}\n",
                v(self.frame.axes[j]),
                v(self.frame.points[j]),
                damping(drive)
            );
            if let Some(k) = self.stiffness("tilt_stiffness", &site) {
                doc += &format!(
                    "tilt = {{ stiffness_Nm_rad = {k:?}, damping_Nms_rad = {:?}{known} }}\n",
                    damping(k)
                );
            }
            doc += &format!("link = {}\n", body(&self.bodies[j]));
        }
        let (f, t) = (self.frame.flange, self.frame.tcp);
        doc += &format!(
            "[tool]\nflange_m = {}\ntcp_m = {}\nbody = {}\n",
            v(f),
            v(t),
            body(&self.bodies[6])
        );
        for s in self
            .springs
            .iter()
            .filter(|s| s.effect == "base_compliance")
        {
            doc += &format!(
                "[[elastic]]\nname = \"{}\"\nafter = 0\naxis = {}\npoint_m = {}\nstiffness_Nm_rad = {:?}\ndamping_Nms_rad = {:?}\n{}",
                s.site,
                v(s.axis),
                v(s.point),
                s.stiffness,
                damping(s.stiffness),
                near.map_or(String::new(), |n| format!("stiffness_rel_std = {n}\n"))
            );
        }
        doc
    }

    /// The line of a spring in a posture.
    pub fn line(&self, s: &Spring, joints: &[f64; 6]) -> Line {
        (
            facing(&self.frame, joints, s.link, s.axis),
            postured(&self.frame, joints, s.link, s.point),
        )
    }

    /// Tool centre point in a posture.
    pub fn hand(&self, joints: &[f64; 6]) -> V3 {
        postured(&self.frame, joints, 6, self.frame.tcp)
    }

    /// Moment of the weights beyond joint `j` (from 0) about it, N·m.
    pub fn weight_moment(&self, j: usize, joints: &[f64; 6]) -> f64 {
        let a = facing(&self.frame, joints, j, self.frame.axes[j]);
        let p = postured(&self.frame, joints, j, self.frame.points[j]);
        let beyond = self.bodies.iter().filter(|b| b.0 > j);
        let of = |(link, mass, com): &(usize, f64, V3)| {
            let arm = minus(postured(&self.frame, joints, *link, *com), p);
            dot(&a, &cross(arm, [0.0, 0.0, -9.81 * mass]))
        };
        beyond.map(of).sum()
    }

    /// Bending of a link between the lines of its joints: hinges about the two directions across it (and along it
    /// where it twists), in the middle or, as a beam bends, in two places that integrate it exactly.
    pub fn bend(&self, link: usize, k: f64, beam: bool, twist: bool) -> Vec<Spring> {
        let (from, to) = match link {
            3 if self.build != "parallel" => (self.frame.points[2], self.frame.points[4]),
            _ => (self.frame.points[link - 1], self.frame.points[link]),
        };
        let along = unit(minus(to, from));
        let [a, b] = across(along);
        let mut axes = vec![a, b];
        if twist {
            axes.push(along);
        }
        let gauss = 0.5 / 3.0_f64.sqrt();
        let places: &[f64] = if beam {
            &[0.5 - gauss, 0.5 + gauss]
        } else {
            &[0.5]
        };
        let mut all = Vec::new();
        for (n, share) in places.iter().enumerate() {
            for w in &axes {
                all.push(Spring {
                    effect: "link_compliance",
                    site: format!("link{link}"),
                    link,
                    rank: link as f64 + 0.05 * (1 + n) as f64,
                    axis: *w,
                    point: between(from, to, *share),
                    stiffness: k * places.len() as f64,
                    told: false,
                });
            }
        }
        all
    }

    /// A tool or holder that gives way about the two directions across it, at the flange.
    pub fn soft_tool(&self, k: f64, ratio: f64) -> Vec<Spring> {
        let along = unit(minus(self.frame.tcp, self.frame.flange));
        let of = |(i, w): (usize, V3)| Spring {
            effect: "tool_compliance",
            site: "tool".into(),
            link: 6,
            rank: 6.5,
            axis: w,
            point: self.frame.flange,
            stiffness: if i == 0 { k } else { k * ratio },
            told: false,
        };
        across(along).into_iter().enumerate().map(of).collect()
    }

    /// A foundation that gives way about the two level directions.
    pub fn soft_base(&self, k: f64, ratio: f64, point: V3) -> Vec<Spring> {
        let of = |i: usize| Spring {
            effect: "base_compliance",
            site: "base".into(),
            link: 0,
            rank: 0.2,
            axis: self.ground[i],
            point,
            stiffness: if i == 0 { k } else { k * ratio },
            told: false,
        };
        (0..2).map(of).collect()
    }

    /// The bearing of joint `j` (from 0) as it tilts.
    pub fn bearing(&self, j: usize, k: f64) -> Vec<Spring> {
        let of = |w: V3| Spring {
            effect: "missing_tilt",
            site: format!("A{}", j + 1),
            link: j,
            rank: j as f64 + 0.7,
            axis: w,
            point: self.frame.points[j],
            stiffness: k,
            told: false,
        };
        across(self.frame.axes[j]).map(of).to_vec()
    }
}

/// How far `target` goes under a force at `hand`: each spring turns all beyond it by a finite angle until the
/// moments of the force, in the place where it then acts, balance.
pub fn deflected(lines: &[(Line, f64)], hand: V3, target: V3, force: V3) -> V3 {
    let mut angles = vec![0.0; lines.len()];
    let mut all = Motion::still();
    for _ in 0..4 {
        all = Motion::still();
        for (((a, p), _), angle) in lines.iter().zip(&angles) {
            all = all.then_about(*a, *p, *angle);
        }
        let acts = all.of(hand);
        let mut before = Motion::still();
        for (((a, p), k), angle) in lines.iter().zip(&mut angles) {
            let (now, at) = (turned(before.turn, *a), before.of(*p));
            let next = dot(&now, &cross(minus(acts, at), force)) / k;
            before = before.then_about(*a, *p, *angle);
            *angle = next;
        }
    }
    minus(all.of(target), target)
}

/// A small turn about a random axis.
pub fn askew(random: &mut Random, angle: f64) -> Quat {
    let about = unit([random.normal(), random.normal(), random.normal()]);
    turn(about, angle)
}
