//! Measuring cubes on a loaded robot: every spring turns what lies beyond it by a finite angle, the load
//! stands still in base axes while its arm moves; turns are quaternions, equilibrium is found by iteration.

use super::algebra::{
    Quat, V3, axis, cross, dot, length_beyond, minus, norm, plus, scaled, turn, turned, unit,
};
use super::chosen::{USUAL, chosen};
use super::rigid::{Frame, Motion, across, facing, postured};
use super::{Case, Truth, chance, pick, twin};
use ident::ground::random::Random;

/// A spring about a line, in the posture of the test and unloaded.
#[derive(Debug, Clone)]
struct Spring {
    /// What it is: effect by which it would be blamed, and where.
    effect: &'static str,
    site: String,
    /// Link it is fixed to before it gives: cubes with a greater rank move with it.
    rank: f64,
    axis: V3,
    point: V3,
    stiffness: f64,
    /// How well the robot file knows it.
    near: f64,
    /// Whether the robot file has it at all.
    told: bool,
}

/// A cube: name, link, elastic axis before it, rank along the chain, centre.
#[derive(Debug, Clone)]
struct Cube {
    name: String,
    after: usize,
    beyond: Option<String>,
    rank: f64,
    centre: V3,
}

/// A load: force and moment at the load point, base frame.
type Load = (V3, V3);

/// The test in which a cube moved by itself, and how far.
type Slip = (usize, V3);

/// A cause that is nearest to others: its effect, its site, what it does as columns.
type Rival = (&'static str, Option<String>, Vec<Vec<f64>>);

/// What is not the robot's.
#[derive(Debug, Clone)]
struct World {
    springs: Vec<Spring>,
    gain: f64,
    tilt: Quat,
    /// Rigid motion of the measuring frame in each test.
    frame: Vec<(V3, V3)>,
    /// Loose cube: which, share by which it follows its neighbour, slip.
    loose: Option<(usize, f64, Option<Slip>)>,
}

/// Robot, tests and sensors.
#[derive(Debug, Clone)]
struct Habit {
    robot: String,
    joints_deg: [f64; 6],
    load_point: V3,
    told: World,
    cubes: Vec<Cube>,
    loads: Vec<Load>,
    noise: [f64; 2],
    told_noise: bool,
    turns: bool,
    told_std: bool,
    rounding: f64,
}

impl World {
    /// The motions after each spring, under a load.
    fn motions(&self, load: Load, at: V3) -> Vec<Motion> {
        let force = turned(self.tilt, scaled(load.0, self.gain));
        let moment = turned(self.tilt, scaled(load.1, self.gain));
        let mut angles = vec![0.0; self.springs.len()];
        let mut chain = vec![Motion::still(); self.springs.len()];
        for _ in 0..6 {
            let mut all = Motion::still();
            for (i, s) in self.springs.iter().enumerate() {
                all = all.then_about(s.axis, s.point, angles[i]);
                chain[i] = all;
            }
            let hand = all.of(at);
            let mut before = Motion::still();
            for (i, s) in self.springs.iter().enumerate() {
                let (a, p) = (turned(before.turn, s.axis), before.of(s.point));
                angles[i] = dot(&a, &plus(moment, cross(minus(hand, p), force))) / s.stiffness;
                before = chain[i];
            }
        }
        chain
    }
}

impl Habit {
    /// Motions of every cube in every test: dx dy dz (m), rx ry rz (rad).
    fn readings(&self, world: &World) -> Vec<[f64; 6]> {
        let mut all = Vec::new();
        for (test, load) in self.loads.iter().enumerate() {
            let chain = world.motions(*load, self.load_point);
            let moved: Vec<[f64; 6]> = self.cubes.iter().map(|c| moved(world, &chain, c)).collect();
            for (i, cube) in self.cubes.iter().enumerate() {
                let mut own = moved[i];
                if let Some((loose, share, slip)) = world.loose.filter(|l| l.0 == i) {
                    let other = if loose > 0 { loose - 1 } else { loose + 1 };
                    (0..6).for_each(|k| own[k] += share * (moved[other][k] - own[k]));
                    if let Some((_, by)) = slip.filter(|s| s.0 == test) {
                        (0..3).for_each(|k| own[k] += by[k]);
                    }
                }
                let (d, r) = world.frame[test];
                let seen = plus(d, cross(r, cube.centre));
                (0..3).for_each(|k| {
                    own[k] -= seen[k];
                    own[k + 3] -= r[k];
                });
                all.push(own);
            }
        }
        all
    }

    fn flat(&self, a: &[[f64; 6]], b: &[[f64; 6]], tail: &[f64]) -> Vec<f64> {
        let count = if self.turns { 6 } else { 3 };
        let pair = a.iter().zip(b);
        let mut all: Vec<f64> = pair
            .flat_map(|(a, b)| (0..count).map(move |i| (b[i] - a[i]) / self.noise[i / 3]))
            .collect();
        all.extend(tail);
        all
    }

    /// Every spring of the robot file a little softer, with what the file knows beforehand.
    fn free(&self, base: &World) -> Vec<Vec<f64>> {
        let from = self.readings(base);
        let told: Vec<usize> = (0..base.springs.len())
            .filter(|i| base.springs[*i].told)
            .collect();
        let column = |(k, i): (usize, &usize)| {
            let mut world = base.clone();
            world.springs[*i].stiffness /= 1.01;
            let mut tail = vec![0.0; told.len()];
            tail[k] = 0.01 / world.springs[*i].near;
            self.flat(&from, &self.readings(&world), &tail)
        };
        told.iter().enumerate().map(column).collect()
    }

    fn rivals(&self, base: &World) -> Vec<Rival> {
        let from = self.readings(base);
        let tail = vec![0.0; base.springs.iter().filter(|s| s.told).count()];
        let of = |change: &dyn Fn(&mut World)| {
            let mut world = base.clone();
            change(&mut world);
            self.flat(&from, &self.readings(&world), &tail)
        };
        let mut all: Vec<Rival> = Vec::new();
        for (i, s) in base.springs.iter().enumerate() {
            let column = of(&|w| w.springs[i].stiffness *= 0.99);
            match all
                .iter_mut()
                .find(|r| r.0 == s.effect && r.1.as_deref() == Some(&s.site))
            {
                // The two axes of a bearing are one number.
                Some(own) if s.effect == "tilt_stiffness" => {
                    own.2[0].iter_mut().zip(column).for_each(|(a, b)| *a += b)
                }
                Some(own) => own.2.push(column),
                None => all.push((s.effect, Some(s.site.clone()), vec![column])),
            }
        }
        all.push(("force_gain", None, vec![of(&|w| w.gain *= 1.01)]));
        all.push((
            "load_misalignment",
            None,
            (0..3)
                .map(|i| of(&|w| w.tilt = turn(axis(i), 1e-3)))
                .collect(),
        ));
        for test in 0..self.loads.len() {
            let one = |k: usize| {
                of(&|w| match k {
                    0..3 => w.frame[test].0[k] += 1e-5,
                    _ => w.frame[test].1[k - 3] += 1e-5,
                })
            };
            all.push(("frame_motion", None, (0..6).map(one).collect()));
        }
        all
    }
}

fn moved(world: &World, chain: &[Motion], cube: &Cube) -> [f64; 6] {
    let last = world.springs.iter().rposition(|s| s.rank < cube.rank);
    let motion = last.map_or(Motion::still(), |i| chain[i]);
    let d = minus(motion.of(cube.centre), cube.centre);
    let v = [motion.turn[1], motion.turn[2], motion.turn[3]];
    let size = norm(v);
    let angle = 2.0 * size.atan2(motion.turn[0]);
    let r = if size > 0.0 {
        scaled(v, angle / size)
    } else {
        [0.0; 3]
    };
    [d[0], d[1], d[2], r[0], r[1], r[2]]
}

fn frame(random: &mut Random) -> Frame {
    let mut near = |x: f64| (x * random.uniform(0.9, 1.1) * 1e3).round() / 1e3;
    let (d, h, upper, drop, fore, hand) = (
        near(0.35),
        near(0.72),
        near(1.2),
        near(0.05),
        near(1.1),
        near(0.23),
    );
    let elbow = d + upper;
    let wrist = elbow + fore;
    Frame {
        axes: [
            [0.0, 0.0, -1.0],
            [0.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [-1.0, 0.0, 0.0],
        ],
        points: [
            [0.0, 0.0, h],
            [d, 0.0, h],
            [elbow, 0.0, h],
            [elbow + 0.4, 0.0, h + drop],
            [wrist, 0.0, h + drop],
            [wrist + hand, 0.0, h + drop],
        ],
        flange: [wrist + hand, 0.0, h + drop],
        tcp: [wrist + hand + near(0.25), 0.0, h + drop - near(0.15)],
    }
}

const DRIVES: [f64; 6] = [5.6e6, 8.04e6, 3.12e6, 7.2e5, 6.59e5, 3.14e5];
const TILTS: [f64; 6] = [1.33e7, 2.61e7, 1.54e6, 1.93e6, 6.58e5, 1.9e6];

/// How a robot file says how well it knows a spring: by an interval of 95 % or by a relative deviation.
fn known_to(told: bool, interval: bool, near: f64, k: f64) -> Option<String> {
    let half = 1.959964 * near * k;
    let line = match interval {
        true => format!("stiffness_ci95_Nm_rad = [{:?}, {:?}]", k - half, k + half),
        false => format!("stiffness_rel_std = {near}"),
    };
    told.then_some(line)
}

/// Faults of structure that a case may hide, beside those of springs in the file.
fn structure(frame: &Frame, joints: &[f64; 6], name: &str, random: &mut Random) -> Vec<Spring> {
    let spring = |effect, site: &str, rank, axis, point, stiffness| Spring {
        effect,
        site: site.into(),
        rank,
        axis,
        point,
        stiffness,
        near: 1.0,
        told: false,
    };
    match name {
        "base_compliance" => {
            let foot = [0.0, 0.0, 0.0];
            let one = |i: usize, k: f64| spring("base_compliance", "base", 0.5, axis(i), foot, k);
            let k = random.log_uniform(6e6, 4e7);
            vec![one(0, k), one(1, k * random.uniform(0.7, 1.4))]
        }
        "missing_tilt" => {
            let j = random.below(5);
            let a = facing(frame, joints, j, frame.axes[j]);
            let p = postured(frame, joints, j, frame.points[j]);
            let k = TILTS[j] * random.log_uniform(0.7, 4.0);
            let site = format!("A{}", j + 1);
            across(a)
                .map(|w| spring("missing_tilt", &site, j as f64 + 0.7, w, p, k))
                .to_vec()
        }
        _ => {
            // Half way along the arm or the fore-arm, about the two directions across it.
            let link = 2 + random.below(2);
            let (from, to) = (
                frame.points[link - 1],
                if link == 2 {
                    frame.points[2]
                } else {
                    frame.points[4]
                },
            );
            let middle = postured(frame, joints, link, scaled(plus(from, to), 0.5));
            let along = unit(facing(frame, joints, link, minus(to, from)));
            let k = random.log_uniform(2.5e6, 2e7);
            across(along)
                .map(|w| {
                    spring(
                        "link_compliance",
                        &format!("link{link}"),
                        link as f64 + 0.05,
                        w,
                        middle,
                        k,
                    )
                })
                .to_vec()
        }
    }
}

impl Habit {
    fn draw(random: &mut Random) -> (Self, Frame) {
        let frame = frame(random);
        let joints_deg: [f64; 6] = [
            random.uniform(-60.0, 60.0),
            random.uniform(-110.0, -50.0),
            random.uniform(70.0, 120.0),
            random.uniform(-80.0, 80.0),
            random.uniform(25.0, 80.0),
            random.uniform(-90.0, 90.0),
        ]
        .map(|d: f64| (d * 10.0).round() / 10.0);
        let joints = joints_deg.map(f64::to_radians);
        let told_std = chance(random, 0.7);
        let interval = chance(random, 0.5);
        // What a file that says nothing may mean: springs as a catalogue has them.
        let near = if told_std {
            *pick(random, &[0.02, 0.05, 0.1])
        } else {
            0.1
        };
        let mut springs = Vec::new();
        let (mut doc, mut stated) = (
            String::from("name = \"judge\"\nsource = \"made up\"\n"),
            Vec::new(),
        );
        let base = chance(random, 0.3);
        if base {
            for (i, name) in ["base-x", "base-y"].iter().enumerate() {
                let k = (3e7 * random.uniform(0.7, 1.4)).round();
                springs.push(Spring {
                    effect: "base_compliance",
                    site: name.to_string(),
                    rank: 0.3,
                    axis: axis(i),
                    point: [0.0; 3],
                    stiffness: k,
                    near,
                    told: true,
                });
                stated.push((name.to_string(), i, k));
            }
        }
        let without = chance(random, 0.3);
        for j in 0..6 {
            let a = facing(&frame, &joints, j, frame.axes[j]);
            let p = postured(&frame, &joints, j, frame.points[j]);
            let (kd, kt) = (
                (DRIVES[j] * random.uniform(0.75, 1.3)).round(),
                (TILTS[j] * random.uniform(0.75, 1.3)).round(),
            );
            let extra = |k: f64| {
                known_to(told_std, interval, near, k)
                    .map_or(String::new(), |line| format!(", {line}"))
            };
            let [ax, p0] = [frame.axes[j], frame.points[j]];
            doc += &format!(
                "[[joints]]\nname = \"A{}\"\naxis = [{:?}, {:?}, {:?}]\npoint_m = [{:?}, {:?}, {:?}]\nlimits_deg = [-185.0, 185.0]\nmax_speed_deg_s = 90.0\ndrive = {{ stiffness_Nm_rad = {kd:?}, damping_Nms_rad = 1000.0{} }}\n",
                j + 1,
                ax[0],
                ax[1],
                ax[2],
                p0[0],
                p0[1],
                p0[2],
                extra(kd)
            );
            if !without {
                doc += &format!(
                    "tilt = {{ stiffness_Nm_rad = {kt:?}, damping_Nms_rad = 1000.0{} }}\n",
                    extra(kt)
                );
                springs.extend(across(a).map(|w| Spring {
                    effect: "tilt_stiffness",
                    site: format!("A{}", j + 1),
                    rank: j as f64 + 0.7,
                    axis: w,
                    point: p,
                    stiffness: kt,
                    near,
                    told: true,
                }));
            }
            let mass = [360.0, 230.0, 190.0, 45.0, 20.0, 10.0][j];
            let end = if j < 5 {
                frame.points[j + 1]
            } else {
                frame.tcp
            };
            let com = scaled(plus(p0, end), 0.5);
            let i = 0.1 * mass;
            doc += &format!(
                "link = {{ mass_kg = {mass:?}, com_m = [{:?}, {:?}, {:?}], inertia_kgm2 = [{i:?}, {i:?}, {i:?}, 0.0, 0.0, 0.0] }}\n",
                com[0], com[1], com[2]
            );
            springs.push(Spring {
                effect: "drive_stiffness",
                site: format!("A{}", j + 1),
                rank: j as f64 + 0.8,
                axis: a,
                point: p,
                stiffness: kd,
                near,
                told: true,
            });
        }
        let holder = chance(random, 0.4);
        if holder {
            for (i, name) in ["holder-x", "holder-y"].iter().enumerate() {
                let k = (1e5 * random.uniform(2.0, 6.0)).round();
                let w = facing(&frame, &joints, 6, axis(1 + i));
                springs.push(Spring {
                    effect: "tool_compliance",
                    site: name.to_string(),
                    rank: 6.3,
                    axis: w,
                    point: postured(&frame, &joints, 6, frame.flange),
                    stiffness: k,
                    near,
                    told: true,
                });
                stated.push((name.to_string(), 10 + i, k));
            }
        }
        let (f, t) = (frame.flange, frame.tcp);
        doc += &format!(
            "[tool]\nflange_m = [{:?}, {:?}, {:?}]\ntcp_m = [{:?}, {:?}, {:?}]\nbody = {{ mass_kg = 40.0, com_m = [{:?}, {:?}, {:?}], inertia_kgm2 = [1.2, 1.4, 1.1, 0.0, 0.0, 0.0] }}\n",
            f[0], f[1], f[2], t[0], t[1], t[2], f[0], f[1], f[2]
        );
        for (name, code, k) in &stated {
            let (after, a, p) = if *code < 10 {
                (0, axis(*code), [0.0; 3])
            } else {
                (6, axis(code - 9), f)
            };
            let extra = known_to(told_std, interval, near, *k)
                .map_or(String::new(), |line| format!("{line}\n"));
            doc += &format!(
                "[[elastic]]\nname = \"{name}\"\nafter = {after}\naxis = [{:?}, {:?}, {:?}]\npoint_m = [{:?}, {:?}, {:?}]\nstiffness_Nm_rad = {k:?}\ndamping_Nms_rad = 1000.0\n{extra}",
                a[0], a[1], a[2], p[0], p[1], p[2]
            );
        }
        let cubes = cubes(&frame, &joints, base, holder, random);
        let loads = loads(random);
        let micro = random.uniform(1.0, 5.0);
        let turns = chance(random, 0.8);
        let tests = loads.len();
        let habit = Self {
            robot: doc,
            joints_deg,
            load_point: postured(&frame, &joints, 6, frame.tcp).map(|x| (x * 1e6).round() / 1e6),
            told: World {
                springs,
                gain: 1.0,
                tilt: [1.0, 0.0, 0.0, 0.0],
                frame: vec![([0.0; 3], [0.0; 3]); tests],
                loose: None,
            },
            cubes,
            loads,
            noise: [1e-6 * micro, 1e-6 * micro * random.uniform(3.0, 8.0)],
            told_noise: chance(random, 0.7),
            turns,
            told_std,
            rounding: *pick(random, &[1e-3, 0.3, 1.0]),
        };
        (habit, frame)
    }
}

fn cubes(
    frame: &Frame,
    joints: &[f64; 6],
    base: bool,
    holder: bool,
    random: &mut Random,
) -> Vec<Cube> {
    let mut all = Vec::new();
    let mut add = |name: String,
                   after: usize,
                   beyond: Option<&str>,
                   rank: f64,
                   at: V3,
                   random: &mut Random| {
        let spot = plus(at, std::array::from_fn(|_| random.uniform(-0.08, 0.08)));
        let centre = postured(frame, joints, after, spot).map(|x| (x * 1e4).round() / 1e4);
        all.push(Cube {
            name,
            after,
            beyond: beyond.map(String::from),
            rank,
            centre,
        });
    };
    add(
        "foot".into(),
        0,
        base.then_some("base-y"),
        0.6,
        [0.2, 0.1, 0.1],
        random,
    );
    let missing = if chance(random, 0.25) {
        3 + random.below(3)
    } else {
        0
    };
    for link in 1..=6 {
        let p = frame.points[link - 1];
        // The fore-arm reaches to the wrist, wherever the file puts the point of its own axis.
        let end = match link {
            3 => frame.points[4],
            6 => frame.flange,
            _ => frame.points[link],
        };
        // At either end of the arm and the fore-arm, else once.
        let long = link == 2 || link == 3;
        if link != missing {
            let at = if long { 0.9 } else { 0.5 };
            add(
                format!("link{link}"),
                link,
                None,
                link as f64 + if long { 0.1 } else { 0.0 },
                plus(scaled(p, 1.0 - at), scaled(end, at)),
                random,
            );
        }
    }
    if holder {
        add(
            "spindle".into(),
            6,
            Some("holder-y"),
            6.5,
            plus(frame.flange, [0.1, 0.0, -0.05]),
            random,
        );
    }
    all
}

fn loads(random: &mut Random) -> Vec<Load> {
    let mut all = Vec::new();
    let steps = 1 + random.below(3);
    let bars = chance(random, 0.6);
    for i in 0..3 {
        for sign in [1.0, -1.0] {
            for step in 1..=steps {
                let force =
                    sign * (random.uniform(0.9, 1.1) * 1500.0 * step as f64 / steps as f64).round();
                all.push((scaled(axis(i), force), [0.0; 3]));
            }
            if bars {
                all.push((
                    scaled(
                        axis((i + 1) % 3),
                        sign * random.uniform(200.0, 500.0).round(),
                    ),
                    scaled(axis(i), sign * random.uniform(200.0, 600.0).round()),
                ));
            }
        }
    }
    all
}

const EFFECTS: [&str; 10] = [
    "drive_stiffness",
    "tilt_stiffness",
    "missing_tilt",
    "base_compliance",
    "link_compliance",
    "tool_compliance",
    "loose_cube",
    "frame_motion",
    "force_gain",
    "load_misalignment",
];
const OUTSIDE: [&str; 3] = [
    "stiffens with load",
    "one sensor's gain",
    "lost motion of an axis",
];

fn fits(name: &str, habit: &Habit) -> bool {
    let has = |effect: &str| habit.told.springs.iter().any(|s| s.effect == effect);
    match name {
        "tilt_stiffness" => has("tilt_stiffness"),
        "missing_tilt" => !has("tilt_stiffness"),
        "base_compliance" => !has("base_compliance"),
        "tool_compliance" => has("tool_compliance"),
        "link_compliance" => {
            habit.cubes.iter().any(|c| c.name == "link2")
                && habit.cubes.iter().any(|c| c.name == "link3")
        }
        _ => true,
    }
}

/// Puts a cause in place; what it is blamed as, where, and the law.
fn place(
    name: &'static str,
    habit: &Habit,
    frame: &Frame,
    world: &mut World,
    random: &mut Random,
) -> (Option<String>, String) {
    let least = 1.0 + 6.0 * habit.told.springs[0].near;
    let factor = least * random.log_uniform(1.0, 2.0);
    let factor = if chance(random, 0.7) {
        1.0 / factor
    } else {
        factor
    };
    match name {
        "drive_stiffness" | "tilt_stiffness" | "tool_compliance" => {
            let sites: Vec<String> = world
                .springs
                .iter()
                .filter(|s| s.effect == name && s.told)
                .map(|s| s.site.clone())
                .collect();
            let site = pick(random, &sites).clone();
            world
                .springs
                .iter_mut()
                .filter(|s| s.effect == name && s.site == site)
                .for_each(|s| s.stiffness *= factor);
            (Some(site), format!("times {factor:.2}"))
        }
        "missing_tilt" | "base_compliance" | "link_compliance" => {
            let joints = habit.joints_deg.map(f64::to_radians);
            let springs = structure(frame, &joints, name, random);
            let (site, k) = (springs[0].site.clone(), springs[0].stiffness);
            world.springs.extend(springs);
            world.springs.sort_by(|a, b| a.rank.total_cmp(&b.rank));
            (Some(site), format!("{k:.1e}"))
        }
        "loose_cube" => {
            let i = random.below(habit.cubes.len());
            let slips = chance(random, 0.4);
            let by = scaled(
                unit([random.normal(), random.normal(), random.normal()]),
                1e-6 * random.log_uniform(15.0, 200.0),
            );
            let share = if slips { 0.0 } else { random.uniform(0.1, 0.5) };
            world.loose = Some((
                i,
                share,
                slips.then(|| (random.below(habit.loads.len()), by)),
            ));
            (
                Some(habit.cubes[i].name.clone()),
                if slips {
                    format!("slips by {:.0} um", 1e6 * norm(by))
                } else {
                    format!("share {share:.2}")
                },
            )
        }
        "frame_motion" => {
            let every = chance(random, 0.5);
            let size = random.log_uniform(10e-6, 80e-6);
            let only = random.below(habit.loads.len());
            for test in 0..habit.loads.len() {
                if every || test == only {
                    let d: V3 = std::array::from_fn(|_| size * random.normal());
                    let r: V3 = std::array::from_fn(|_| 0.5 * size * random.normal());
                    world.frame[test] = (d, r);
                }
            }
            (
                None,
                if every {
                    "every test".into()
                } else {
                    "one test".into()
                },
            )
        }
        "force_gain" => {
            world.gain =
                1.0 + random.log_uniform(0.04, 0.25) * if chance(random, 0.5) { 1.0 } else { -1.0 };
            (None, format!("{:.2}", world.gain))
        }
        _ => {
            let about = unit([random.normal(), random.normal(), random.normal()]);
            let angle = random.log_uniform(0.02, 0.12);
            world.tilt = turn(about, angle);
            (None, format!("{:.1} deg", angle.to_degrees()))
        }
    }
}

fn outside(name: &str, habit: &Habit, world: &World, random: &mut Random) -> Vec<[f64; 6]> {
    let clean = habit.readings(world);
    let count = habit.cubes.len();
    let (joint, k) = (random.below(3), random.below(3));
    let cube = 2 + random.below(count - 2);
    let gap = random.log_uniform(2e-5, 1e-4);
    let gain = 1.0 + random.uniform(0.1, 0.4);
    let spring = world
        .springs
        .iter()
        .position(|s| s.effect == "drive_stiffness" && s.site == format!("A{}", joint + 1))
        .unwrap_or(0);
    match name {
        "one sensor's gain" => {
            let mut all = clean;
            (0..all.len())
                .filter(|i| i % count == cube)
                .for_each(|i| all[i][k] *= gain);
            all
        }
        _ => {
            // An axis whose spring is not straight: harder with load, or after a gap.
            let mut all = Vec::new();
            for (test, load) in habit.loads.iter().enumerate() {
                let s = &world.springs[spring];
                let arm = minus(habit.load_point, s.point);
                let moment = dot(&s.axis, &plus(load.1, cross(arm, load.0)));
                let angle = moment / s.stiffness;
                let wanted = match name {
                    _ if moment == 0.0 => 0.0,
                    "stiffens with load" => angle * (1.0 + 1.5 / (1.0 + (moment / 600.0).powi(2))),
                    _ => angle + gap * moment.signum(),
                };
                let mut bent = world.clone();
                bent.springs[spring].stiffness = if wanted != 0.0 {
                    moment / wanted
                } else {
                    s.stiffness
                };
                all.extend_from_slice(&habit.readings(&bent)[test * count..(test + 1) * count]);
            }
            all
        }
    }
}

/// A case.
pub fn draw(seed: u64) -> Case {
    let mut random = Random::new(seed ^ 0xcbe5_0000);
    let (habit, frame) = Habit::draw(&mut random);
    let names = chosen(&mut random, USUAL, [&EFFECTS, &OUTSIDE], |name| {
        fits(name, &habit)
    });
    let mut real = habit.told.clone();
    let mut bearing = (String::new(), 1.0);
    for s in &mut real.springs {
        let near = if habit.told_std { s.near } else { 0.005 };
        let draw = 1.0 + near * random.normal().clamp(-2.0, 2.0);
        // Both axes of a bearing are one spring.
        if s.effect == "tilt_stiffness" && bearing.0 == s.site {
            s.stiffness *= bearing.1;
            continue;
        }
        bearing = (s.site.clone(), draw);
        s.stiffness *= draw;
    }
    let mut world = real.clone();
    let mut truths = Vec::new();
    let mut rows = Vec::new();
    let mut steps = Vec::new();
    for name in &names {
        match EFFECTS.contains(name) {
            true => {
                let before = world.clone();
                let placed = place(name, &habit, &frame, &mut world, &mut random);
                steps.push((*name, placed, before, world.clone()));
            }
            false => rows = outside(name, &habit, &world, &mut random),
        }
    }
    if rows.is_empty() {
        rows = habit.readings(&world);
    } else {
        let told = vec![0.0; real.springs.iter().filter(|s| s.told).count()];
        let change = habit.flat(&habit.readings(&world), &rows, &told);
        let sight = length_beyond(&change, &habit.free(&real));
        let strength = change.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        truths.push(Truth {
            effect: "outside",
            site: None,
            sight,
            apart: sight,
            twins: Vec::new(),
            strength,
            law: names[0].to_string(),
        });
    }
    for i in 0..steps.len() {
        truths.push(truth(&habit, &real, &steps, i));
    }
    let said = format!(
        "{} cubes, {} tests, noise {:.1} um {:.0} urad{}{}{}, rounded {:.2}",
        habit.cubes.len(),
        habit.loads.len(),
        1e6 * habit.noise[0],
        1e6 * habit.noise[1],
        if habit.turns { "" } else { ", no turns" },
        if habit.told_noise { ", noise told" } else { "" },
        if habit.told_std {
            format!(", springs to {}", habit.told.springs[0].near)
        } else {
            String::new()
        },
        habit.rounding,
    );
    let files = vec![
        ("cubes.csv".to_string(), text(&habit, &rows, &mut random)),
        ("robot.toml".to_string(), habit.robot.clone()),
    ];
    Case {
        seed,
        truths,
        habit: said,
        files,
    }
}

type Step = (&'static str, (Option<String>, String), World, World);

fn truth(habit: &Habit, real: &World, steps: &[Step], i: usize) -> Truth {
    let (name, (site, law), before, after) = &steps[i];
    let tail = vec![0.0; real.springs.iter().filter(|s| s.told).count()];
    let own = habit.flat(&habit.readings(before), &habit.readings(after), &tail);
    let mut known = habit.free(real);
    for (_, other) in steps.iter().enumerate().filter(|(j, _)| *j != i) {
        known.push(habit.flat(&habit.readings(&other.2), &habit.readings(&other.3), &tail));
    }
    let sight = length_beyond(&own, &known);
    let rival = |columns: &Vec<Vec<f64>>| {
        let with: Vec<Vec<f64>> = known.iter().chain(columns).cloned().collect();
        length_beyond(&own, &with)
    };
    let rivals = habit.rivals(real);
    let near: Vec<(&'static str, Option<String>, f64)> = rivals
        .iter()
        .filter(|(e, s, _)| {
            !steps
                .iter()
                .any(|step| step.0 == *e && (s.is_none() || *s == step.1.0))
        })
        .map(|(e, s, c)| (*e, s.clone(), rival(c)))
        .collect();
    let mut twins: Vec<(&'static str, Option<String>)> = near
        .iter()
        .filter(|n| twin(n.2, sight))
        .map(|n| (n.0, n.1.clone()))
        .collect();
    if *name == "tool_compliance" {
        // A softer elastic axis is a link's as well, says the contract.
        twins.push(("link_compliance", None));
    }
    Truth {
        effect: name,
        site: if *name == "tool_compliance" {
            None
        } else {
            site.clone()
        },
        sight,
        apart: near.iter().map(|n| n.2).fold(sight, f64::min),
        twins,
        strength: own.iter().fold(0.0, |m: f64, x| m.max(x.abs())),
        law: law.clone(),
    }
}

fn text(habit: &Habit, rows: &[[f64; 6]], random: &mut Random) -> String {
    let cube = |c: &Cube| {
        let beyond = c
            .beyond
            .as_ref()
            .map_or(String::new(), |b| format!(", beyond = \"{b}\""));
        format!(
            "{{ name = \"{}\", after = {}{beyond}, centre_m = [{:?}, {:?}, {:?}] }}",
            c.name, c.after, c.centre[0], c.centre[1], c.centre[2]
        )
    };
    let cubes: Vec<String> = habit.cubes.iter().map(cube).collect();
    let q: Vec<String> = habit.joints_deg.iter().map(|d| format!("{d:?}")).collect();
    let mut head = format!(
        "# kind = \"cubes\"\n# robot = \"robot.toml\"\n# joint_angles_deg = [{}]\n# cubes = [{}]\n",
        q.join(", "),
        cubes.join(", ")
    );
    if chance(random, 0.5) {
        let p = habit.load_point;
        head += &format!("# load_point_m = [{:?}, {:?}, {:?}]\n", p[0], p[1], p[2]);
    }
    if habit.told_noise {
        head += &format!("# sensor_noise_mm = {:.5}\n", 1e3 * habit.noise[0]);
        if habit.turns {
            head += &format!("# sensor_noise_mrad = {:.5}\n", 1e3 * habit.noise[1]);
        }
    }
    head +=
        "test,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,cube,dx_mm,dy_mm,dz_mm,rx_mrad,ry_mrad,rz_mrad\n";
    let count = habit.cubes.len();
    for (i, row) in rows.iter().enumerate() {
        let (test, cube) = (i / count, &habit.cubes[i % count]);
        let (f, m) = habit.loads[test];
        let cell = |k: usize, random: &mut Random| {
            let noise = habit.noise[k / 3];
            let read = row[k] + noise * random.normal();
            let step = habit.rounding * noise;
            match habit.turns || k < 3 {
                true => format!("{:.7}", 1e3 * (read / step).round() * step),
                false => String::new(),
            }
        };
        let read: Vec<String> = (0..6).map(|k| cell(k, random)).collect();
        head += &format!(
            "{},{:?},{:?},{:?},{:?},{:?},{:?},{},{}\n",
            test + 1,
            f[0],
            f[1],
            f[2],
            m[0],
            m[1],
            m[2],
            cube.name,
            read.join(",")
        );
    }
    head
}

/// A clean file, its robot file and the true stiffness at every site: (`A1`, N·m/rad), (`A1-tilt`, ..), names.
pub fn known(seed: u64) -> (Case, Vec<(String, f64)>) {
    let mut random = Random::new(seed ^ 0xcbe5_1111);
    let (mut habit, _) = Habit::draw(&mut random);
    habit.rounding = 1e-3;
    let mut world = habit.told.clone();
    let mut truth: Vec<(String, f64)> = Vec::new();
    let mut last = (String::new(), 1.0);
    for s in &mut world.springs {
        let tag = if s.effect == "tilt_stiffness" {
            format!("{}-tilt", s.site)
        } else {
            s.site.clone()
        };
        let near = if habit.told_std { s.near } else { 0.2 };
        if last.0 != tag {
            last = (tag.clone(), 1.0 + near * random.normal().clamp(-2.5, 2.5));
            truth.push((tag, s.stiffness * last.1));
        }
        s.stiffness *= last.1;
    }
    let rows = habit.readings(&world);
    let files = vec![
        ("cubes.csv".to_string(), text(&habit, &rows, &mut random)),
        ("robot.toml".to_string(), habit.robot.clone()),
    ];
    (
        Case {
            seed,
            truths: Vec::new(),
            habit: String::new(),
            files,
        },
        truth,
    )
}
