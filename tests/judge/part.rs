//! Parts milled by elastic robots and probed: own kinematics, own engagement of straight cuts, mean cutting forces,
//! weights, lost motion and a controller that rounds corners; read as a probe reads, with what nobody announced.

use super::algebra::{
    Quat, V3, axis, basis, cross, dot, minus, norm, plus, scaled, turn, turned, unit, without,
};
use super::arm::{Arm, Line, Spring, askew};
use super::chosen::{USUAL, chosen};
use super::cut::{Coefficients, Mill, Sweep, force, speed_after};
use super::rigid::{facing, postured};
use super::{Case, Truth, chance, pick, twin};
use ident::ground::random::Random;

/// A place of the path in the material.
#[derive(Debug, Clone)]
struct Station {
    /// Way along the programmed path and time, m and s.
    s: f64,
    time: f64,
    /// Tip, workpiece frame.
    tip: V3,
    feed: [f64; 2],
    speed: f64,
    line: usize,
    /// Distance behind the last corner and before the next, m; which way the path turns there (1 left, -1 right, 0 none).
    corners: [(f64, f64); 2],
    probed: bool,
    /// Joint angles there and their direction of motion.
    joints: [f64; 6],
    moving: [f64; 6],
}

/// A straight motion.
#[derive(Debug, Clone, Copy)]
struct Move {
    to: V3,
    rapid: bool,
    /// Its wall is probed.
    probed: bool,
}

/// Job, robot, probe.
#[derive(Debug, Clone)]
struct Habit {
    shape: &'static str,
    arm: Arm,
    mill: Mill,
    diameter_mm: f64,
    material: Coefficients,
    told_material: f64,
    feed_mm_min: f64,
    start: V3,
    moves: Vec<Move>,
    stations: Vec<Station>,
    /// Where the wall stands, 1 left, -1 right of the feed.
    side: f64,
    told_side: bool,
    /// Workpiece in the base frame.
    origin: V3,
    turn_z_deg: f64,
    abc_deg: V3,
    first_joints: [f64; 6],
    near: Option<f64>,
    noise: f64,
    told_noise: bool,
    datum: f64,
    told_datum: bool,
    wall: bool,
    floor: bool,
    by_way: bool,
    spacing: f64,
    close: bool,
}

/// How the controller goes round a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Corner {
    /// A parabola from this far before to this far behind.
    Blend(f64),
    /// The axes stay behind by this way.
    Lag(f64),
}

#[derive(Debug, Clone)]
struct World {
    springs: Vec<Spring>,
    material: Coefficients,
    /// Lateral compliance of the tool, m/N.
    bend: f64,
    /// Joint, gap, held where the motion left it or by the moment.
    gap: Option<(usize, f64, bool)>,
    radius: f64,
    offset: V3,
    turn: V3,
    corner: Option<Corner>,
    /// Growth along the spindle (m) and of the arm (1) at the end, and the time constant, s.
    growth: (f64, f64, f64),
    extra: Vec<V3>,
}

type Rival = (&'static str, Option<String>, Vec<Vec<V3>>);
/// The same as the best test sees it.
type Seen = (&'static str, Option<String>, Vec<Vec<f64>>);
/// Names and texts of files.
type Files = Vec<(String, String)>;

/// Moves from the foot to the base frame.
fn placed(h: &Habit, v: V3) -> V3 {
    turned(about_z(h.turn_z_deg), v)
}

fn about_z(deg: f64) -> Quat {
    turn(axis(2), deg.to_radians())
}

fn back(h: &Habit, v: V3) -> V3 {
    turned(about_z(-h.turn_z_deg), v)
}

/// Columns of the orientation at a posture.
fn orientation(arm: &Arm, q: &[f64; 6]) -> [V3; 3] {
    [0, 1, 2].map(|k| facing(&arm.frame, q, 6, axis(k)))
}

/// Joint angles that bring tip and orientation (columns) there, by Newton's method from a guess.
fn reached(arm: &Arm, place: V3, columns: &[V3; 3], guess: [f64; 6]) -> Option<[f64; 6]> {
    let mut q = guess;
    for _ in 0..40 {
        let hand = arm.hand(&q);
        let now = orientation(arm, &q);
        let miss = minus(place, hand);
        let turn = (0..3).fold([0.0; 3], |t, k| {
            plus(t, scaled(cross(now[k], columns[k]), 0.5))
        });
        let size = norm(miss) + norm(turn);
        if size < 1e-11 {
            return Some(q);
        }
        let lever = |j: usize| {
            let a = facing(&arm.frame, &q, j, arm.frame.axes[j]);
            let from = postured(&arm.frame, &q, j, arm.frame.points[j]);
            [cross(a, minus(hand, from)), a]
        };
        let levers: [[V3; 2]; 6] = std::array::from_fn(lever);
        let wanted = [miss, turn];
        let rows = std::array::from_fn(|r| {
            std::array::from_fn(|c| levers.get(c).unwrap_or(&wanted)[r / 3][r % 3])
        });
        let step = solved(rows)?;
        let most = step.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let share = if most > 0.3 { 0.3 / most } else { 1.0 };
        (0..6).for_each(|j| q[j] += share * step[j]);
    }
    None
}

fn solved(mut m: [[f64; 7]; 6]) -> Option<[f64; 6]> {
    for i in 0..6 {
        let best = (i..6).max_by(|a, b| m[*a][i].abs().total_cmp(&m[*b][i].abs()))?;
        m.swap(i, best);
        if m[i][i].abs() < 1e-9 {
            return None;
        }
        for r in 0..6 {
            if r != i {
                let f = m[r][i] / m[i][i];
                let pivot = m[i];
                (i..7).for_each(|c| m[r][c] -= f * pivot[c]);
            }
        }
    }
    Some(std::array::from_fn(|i| m[i][6] / m[i][i]))
}

/// A, B, C of an orientation given by its columns: R = Rz(a) Ry(b) Rx(c), deg.
fn angles(c: &[V3; 3]) -> V3 {
    let b = (-c[0][2]).asin();
    let a = c[0][1].atan2(c[0][0]);
    let g = c[1][2].atan2(c[2][2]);
    [a, b, g].map(f64::to_degrees)
}

/// The turn that takes one unit vector to another.
fn towards(from: V3, to: V3) -> Quat {
    let n = cross(from, to);
    let size = norm(n);
    if size < 1e-12 {
        return [1.0, 0.0, 0.0, 0.0];
    }
    turn(scaled(n, 1.0 / size), size.atan2(dot(&from, &to)))
}

/// The moves of a part, and which side its walls stand on; lengths in m, z 0 the upper face.
fn shape(random: &mut Random, mill: &mut Mill) -> (&'static str, V3, Vec<Move>, f64) {
    let mm = |x: f64| (x * 1e3).round() / 1e3;
    let (r, levels) = (mill.radius, 1 + random.below(4) / 3);
    let deep = (random.uniform(6.0, 20.0)).round() * 1e-4;
    let wide = mm(random.uniform(0.055, 0.075));
    let long = mm(random.uniform(0.06, 0.1));
    mill.low = [0.0, 0.0, -0.04];
    mill.high = [long, wide, 0.0];
    let up = 0.01;
    let cut = |to: V3, probed: bool| Move {
        to,
        rapid: false,
        probed,
    };
    let fast = |to: V3| Move {
        to,
        rapid: true,
        probed: false,
    };
    let mut all = Vec::new();
    match random.below(3) {
        0 => {
            // Round the block, a part inside: from outside in, the wall left or right.
            let ae = mm(random.uniform(1e-3, 0.4 * r)).max(1e-3);
            let e = r - ae;
            let left = chance(random, 0.5);
            let corners = [
                [-e, -e],
                [long + e, -e],
                [long + e, wide + e],
                [-e, wide + e],
            ];
            let order: [usize; 5] = if left {
                [0, 1, 2, 3, 0]
            } else {
                [0, 3, 2, 1, 0]
            };
            let from = if left {
                [-e - 3.0 * r, -e]
            } else {
                [-e, -e - 3.0 * r]
            };
            for level in 1..=levels {
                let z = -deep * level as f64;
                all.push(fast([from[0], from[1], up]));
                all.push(cut([from[0], from[1], z], false));
                for (n, at) in order.iter().enumerate() {
                    all.push(cut([corners[*at][0], corners[*at][1], z], n > 0));
                }
                let [x, y] = corners[0];
                let out = if left {
                    [x, y - 3.0 * r]
                } else {
                    [x - 3.0 * r, y]
                };
                all.push(cut([out[0], out[1], z], false));
                all.push(fast([out[0], out[1], up]));
            }
            (
                "round the block",
                [from[0], from[1], up],
                all,
                if left { 1.0 } else { -1.0 },
            )
        }
        1 => {
            // Slots right through, along both axes.
            let side = if chance(random, 0.5) { 1.0 } else { -1.0 };
            let start = [-2.0 * r, 0.25 * wide, up];
            let lanes = [0.25, 0.7];
            for level in 1..=levels {
                let z = -deep * level as f64;
                for (n, lane) in lanes.iter().enumerate() {
                    let y = mm(lane * wide);
                    let ends = [-2.0 * r, long + 2.0 * r];
                    let (a, b) = if n == 0 {
                        (ends[0], ends[1])
                    } else {
                        (ends[1], ends[0])
                    };
                    all.extend([
                        fast([a, y, up]),
                        cut([a, y, z], false),
                        cut([b, y, z], true),
                        fast([b, y, up]),
                    ]);
                }
                let x = mm(0.5 * long);
                let (a, b) = (-2.0 * r, wide + 2.0 * r);
                all.extend([
                    fast([x, a, up]),
                    cut([x, a, z], false),
                    cut([x, b, z], true),
                    fast([x, b, up]),
                ]);
            }
            ("slots", start, all, side)
        }
        _ => {
            // A pocket: the middle round first, then its wall, which stands right of the feed or left.
            let ae = mm(random.uniform(1e-3, 0.5 * r)).max(1e-3);
            let right = chance(random, 0.5);
            let m = [0.5 * long, 0.5 * wide].map(mm);
            let h = [0.5 * long - r - 0.012, 0.5 * wide - r - 0.012].map(mm);
            let h = [h[0].min(0.05), h[1].min(0.04)];
            for level in 1..=levels {
                let z = -deep * level as f64;
                for (inner, probed) in [(ae, false), (0.0, true)] {
                    let c =
                        |x: f64, y: f64| [m[0] + x * (h[0] - inner), m[1] + y * (h[1] - inner), z];
                    let ring = if right {
                        [
                            c(0.0, -1.0),
                            c(1.0, -1.0),
                            c(1.0, 1.0),
                            c(-1.0, 1.0),
                            c(-1.0, -1.0),
                            c(0.0, -1.0),
                        ]
                    } else {
                        [
                            c(0.0, -1.0),
                            c(-1.0, -1.0),
                            c(-1.0, 1.0),
                            c(1.0, 1.0),
                            c(1.0, -1.0),
                            c(0.0, -1.0),
                        ]
                    };
                    let [x, y, _] = ring[0];
                    if !probed {
                        all.push(fast([x, y, up]));
                        all.push(fast([x, y, 1e-3]));
                    }
                    // Not where the ring begins and ends.
                    let far = |n: usize| probed && (2..5).contains(&n);
                    all.extend(ring.iter().enumerate().map(|(n, to)| cut(*to, far(n))));
                }
                let [x, y, _] = all[all.len() - 1].to;
                all.push(fast([x, y, up]));
            }
            let start = [m[0], m[1] - h[1] + ae, up];
            ("pocket", start, all, if right { -1.0 } else { 1.0 })
        }
    }
}

impl Habit {
    fn draw(random: &mut Random) -> Self {
        loop {
            if let Some(own) = Self::tried(random) {
                return own;
            }
        }
    }

    fn tried(random: &mut Random) -> Option<Self> {
        let mut arm = Arm::draw(random);
        if arm.ground[2][2] < 0.5 || arm.build == "parallel" {
            return None;
        }
        let near = chance(random, 0.7).then(|| *pick(random, &[0.02, 0.05, 0.1]));
        let diameter_mm = *pick(random, &[10.0, 12.0, 16.0]);
        let mut mill = Mill {
            radius: 0.5e-3 * diameter_mm,
            teeth: 3 + random.below(2),
            rpm: (random.uniform(2.5, 4.5) * 10.0).round() * 100.0,
            low: [0.0; 3],
            high: [0.0; 3],
        };
        let (shape, start, moves, side) = shape(random, &mut mill);
        let material = [1200.0, 500.0, 60.0, 18.0, 20.0, 1.5];
        let scale = random.uniform(0.5, 1.3);
        let material: Coefficients = std::array::from_fn(|i| {
            let unit = if i < 3 { 1e6 } else { 1e3 };
            (material[i] * scale * random.uniform(0.8, 1.2) * 10.0).round() / 10.0 * unit
        });
        let turn_z_deg = *pick(random, &[0.0, 0.0, 30.0, -45.0, 90.0]);
        let wall = chance(random, 0.85);
        let micro = random.log_uniform(1.5, 8.0);
        let close = chance(random, 0.6);
        // So light and so well damped that what the tool does at entries and corners is soon over.
        let (light, damped) = match close && shape == "pocket" {
            true => (0.03, 1.4e-3),
            false => (0.12, 3e-3),
        };
        arm.bodies
            .iter_mut()
            .for_each(|b| b.1 = (100.0 * light * b.1).round() / 100.0);
        arm.text = arm.document(near, damped);
        let mut own = Self {
            shape,
            arm,
            mill,
            diameter_mm,
            material,
            told_material: *pick(random, &[0.03, 0.05, 0.1]),
            feed_mm_min: random.uniform(16.0, 26.0).round() * 100.0,
            start,
            moves,
            stations: Vec::new(),
            side,
            told_side: chance(random, 0.8),
            origin: [0.0; 3],
            turn_z_deg,
            abc_deg: [0.0; 3],
            first_joints: [0.0; 6],
            near,
            noise: 1e-6 * micro,
            told_noise: chance(random, 0.7),
            datum: *pick(random, &[5e-6, 1e-5, 2e-5]),
            told_datum: chance(random, 0.7),
            wall,
            floor: !wall || chance(random, 0.6),
            by_way: chance(random, 0.3),
            spacing: *pick(random, &[2e-3, 5e-3, 1e-2]),
            close,
        };
        if !own.told_datum {
            own.datum = 1e-5;
        }
        own.stand(random)?;
        own.walk()?;
        // Nobody mills what bends the robot further.
        let milled = own.milled(&World::told(&own));
        let most = milled.iter().map(|cut| norm(cut.at)).fold(0.0, f64::max);
        let places = own.stations.iter().filter(|s| own.counts(s)).count();
        (most < 3e-4 && places >= 12).then_some(own)
    }

    /// Where the workpiece stands: before the robot, the spindle upright.
    fn stand(&mut self, random: &mut Random) -> Option<()> {
        let arm = &self.arm;
        let mut q = arm.home_deg.map(f64::to_radians);
        let spindle = unit(minus(arm.frame.flange, arm.frame.tcp));
        // The wrist bends until the spindle stands about upright.
        let upright = |q5: f64| {
            let mut q = q;
            q[4] = q5;
            facing(&arm.frame, &q, 6, spindle)[2]
        };
        let best = (0..36).map(|i| (5.0 * i as f64 - 60.0).to_radians());
        q[4] = best.max_by(|a, b| upright(*a).total_cmp(&upright(*b)))?;
        for (j, spread) in [25.0_f64, 8.0, 8.0, 12.0, 0.0, 25.0].iter().enumerate() {
            q[j] += random.uniform(-spread, *spread).to_radians();
        }
        let now = facing(&arm.frame, &q, 6, spindle);
        let lift = towards(now, axis(2));
        let columns = orientation(arm, &q).map(|c| turned(lift, c));
        let place = arm.hand(&q).map(|x| (x * 1e3).round() / 1e3);
        let middle = scaled(plus(self.mill.low, self.mill.high), 0.5);
        self.origin = minus(place, placed(self, [middle[0], middle[1], 0.0]))
            .map(|x| (x * 1e3).round() / 1e3);
        self.abc_deg = angles(&columns.map(|c| back(self, c)));
        if self.abc_deg[1].abs() > 80.0 {
            return None;
        }
        let q = reached(arm, self.based(self.start), &columns, q)?;
        // Clear of both singular postures and of the axes' ends.
        let bent = q[4].abs().to_degrees();
        let free = q.iter().all(|a| a.abs() < 3.1);
        (free && bent > 15.0 && bent < 150.0).then_some(())?;
        self.first_joints = q;
        Some(())
    }

    fn based(&self, x: V3) -> V3 {
        plus(placed(self, x), self.origin)
    }

    /// The stations along the path.
    fn walk(&mut self) -> Option<()> {
        let feed = self.feed_mm_min / 60e3;
        let mut stations = Vec::new();
        let (mut at, mut way, mut time) = (self.start, 0.0, 0.0);
        let moves = self.moves.clone();
        for (n, m) in moves.iter().enumerate() {
            let (along, long) = (minus(m.to, at), norm(minus(m.to, at)));
            let level = along[2].abs() < 1e-9;
            let speed = if m.rapid { 5.0 * feed } else { feed };
            if long > 0.0 && level && !m.rapid {
                let u = [along[0] / long, along[1] / long];
                let corner = |other: Option<V3>| match other {
                    Some(o) if o[2].abs() < 1e-9 && norm(o) > 0.0 => {
                        let o = unit(o);
                        u[0] * o[1] - u[1] * o[0]
                    }
                    _ => 0.0,
                };
                let next = moves
                    .get(n + 1)
                    .filter(|m| !m.rapid)
                    .map(|o| minus(o.to, m.to));
                let last = (n > 0 && !moves[n - 1].rapid).then(|| {
                    let from = if n > 1 { moves[n - 2].to } else { self.start };
                    minus(at, from)
                });
                let turns = [-corner(last), corner(next)];
                for (d, probed) in self.places(long, m.probed) {
                    stations.push(Station {
                        s: way + d,
                        time: time + d / speed,
                        tip: [at[0] + u[0] * d, at[1] + u[1] * d, m.to[2]],
                        feed: u,
                        speed: speed_after(d.min(long - d), feed, 0.5, 5.0),
                        line: n,
                        corners: [(d, turns[0]), (long - d, turns[1])],
                        probed,
                        joints: [0.0; 6],
                        moving: [0.0; 6],
                    });
                }
            }
            time += long / speed + 0.1;
            way += long;
            at = m.to;
        }
        self.stations = stations;
        self.pose()
    }

    fn places(&self, long: f64, probed: bool) -> Vec<(f64, bool)> {
        let grid = 2.5e-3;
        let steps = (long / grid).ceil().max(1.0);
        let mut all: Vec<(f64, bool)> = (0..=steps as usize)
            .map(|i| (long * i as f64 / steps, false))
            .collect();
        if probed {
            let count = (long / self.spacing).floor() as usize;
            let own = (0..=count).map(|i| ((i as f64 + 0.37) * self.spacing * 1e4).round() / 1e4);
            all.extend(
                own.filter(|d| *d > 4e-3 && *d < long - 4e-3)
                    .map(|d| (d, true)),
            );
            if self.close {
                for d in [0.8e-3, 1.5e-3, 2.5e-3, 4e-3] {
                    all.extend([(d, true), (long - d, true)]);
                }
            }
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    }

    fn pose(&mut self) -> Option<()> {
        let spindle = orientation(&self.arm, &self.first_joints);
        let mut q = self.first_joints;
        for i in 0..self.stations.len() {
            let s = &self.stations[i];
            let (place, feed) = (self.based(s.tip), s.feed);
            let before = q;
            q = reached(&self.arm, place, &spindle, q)?;
            let ahead = plus(place, placed(self, [1e-4 * feed[0], 1e-4 * feed[1], 0.0]));
            let then = reached(&self.arm, ahead, &spindle, q)?;
            if (0..6).any(|j| (q[j] - before[j]).abs() > 1.0 || q[j].abs() > 3.2) {
                return None;
            }
            let s = &mut self.stations[i];
            s.joints = q;
            s.moving = std::array::from_fn(|j| then[j] - q[j]);
        }
        Some(())
    }

    /// Whether the tool is well within the material: not while it enters or leaves.
    fn counts(&self, s: &Station) -> bool {
        let clear = match self.shape {
            "round the block" => 6e-3,
            _ => self.mill.radius * 1.2 + 3e-3,
        };
        let inside = |k: usize| {
            let (low, high) = (self.mill.low[k], self.mill.high[k]);
            s.feed[k].abs() < 0.5 || s.tip[k] > low + clear && s.tip[k] < high - clear
        };
        // Where a line ends without a corner another pass begins.
        let ends = s
            .corners
            .iter()
            .any(|(way, turns)| *way < 4e-3 && turns.abs() < 0.5);
        // Nor where slots cross.
        let lanes = [0.25, 0.7].map(|l| (l * self.mill.high[1] * 1e3).round() / 1e3);
        let near = |x: f64, lane: f64| (x - lane).abs() < self.mill.radius + 9e-3;
        let crossing = self.shape == "slots"
            && match s.feed[0].abs() > 0.5 {
                true => near(s.tip[0], 0.5 * self.mill.high[0]),
                false => lanes.iter().any(|lane| near(s.tip[1], *lane)),
            };
        s.probed && !ends && !crossing && inside(0) && inside(1)
    }

    /// Moment of the weights about the line of a spring.
    fn weight(&self, s: &Spring, line: &Line, joints: &[f64; 6]) -> f64 {
        let arm = &self.arm;
        let beyond = |(n, b): &(usize, &(usize, f64, V3))| b.0 > s.link || s.link == 6 && *n == 6;
        let of = |(_, (link, mass, com)): (usize, &(usize, f64, V3))| {
            let at = minus(postured(&arm.frame, joints, *link, *com), line.1);
            dot(&line.0, &cross(at, [0.0, 0.0, -9.81 * mass]))
        };
        arm.bodies.iter().enumerate().filter(beyond).map(of).sum()
    }

    /// The job as it is cut, station by station.
    fn milled(&self, world: &World) -> Vec<Cut> {
        let mut swept: Vec<Sweep> = Vec::new();
        let mut all = Vec::new();
        let mill = Mill {
            radius: self.mill.radius + world.radius,
            ..self.mill.clone()
        };
        let mut last: Option<(usize, V3)> = None;
        let zero = self.sag(&world.springs, &self.first_joints);
        let end = self.stations.last().map_or(1.0, |s| s.time);
        let mut side = 0.0;
        for s in &self.stations {
            let lines: Vec<(Line, f64)> = world
                .springs
                .iter()
                .map(|k| (self.arm.line(k, &s.joints), k.stiffness))
                .collect();
            let hand = self.arm.hand(&s.joints);
            let free = self.before_the_cut(world, s, hand, zero, &mut side, end);
            let stands = |d: V3| {
                let own = mill.shares(plus(s.tip, d), s.feed, s.speed, &swept);
                let f = force(&own, &world.material);
                let left = [-s.feed[1], s.feed[0], 0.0];
                let ahead = [s.feed[0], s.feed[1], 0.0];
                let f = plus(
                    plus(scaled(ahead, f[0]), scaled(left, f[1])),
                    [0.0, 0.0, f[2]],
                );
                let soft = gives(&lines, hand, placed(self, f));
                let bent = [world.bend * f[0], world.bend * f[1], 0.0];
                (plus(plus(free, back(self, soft)), bent), own)
            };
            let (d, own) = at_rest(free, stands);
            let cut = Cut {
                at: d,
                shares: own,
                answers: answers(d, |d| stands(d).0),
            };
            let tip = plus(s.tip, d);
            match last {
                Some((line, from)) if line == s.line => swept.push((from, tip)),
                _ => swept.push((tip, tip)),
            }
            last = Some((s.line, tip));
            all.push(cut);
        }
        all
    }

    /// Where the weights bring the tip, base frame; each spring as it is.
    fn sag(&self, springs: &[Spring], joints: &[f64; 6]) -> V3 {
        let hand = self.arm.hand(joints);
        springs.iter().fold([0.0; 3], |d, s| {
            let line = self.arm.line(s, joints);
            let angle = self.weight(s, &line, joints) / s.stiffness;
            plus(d, scaled(cross(line.0, minus(hand, line.1)), angle))
        })
    }

    fn before_the_cut(
        &self,
        world: &World,
        s: &Station,
        hand: V3,
        zero: V3,
        side: &mut f64,
        end: f64,
    ) -> V3 {
        // What weight does at the start counts as calibrated away.
        let mut d = minus(self.sag(&world.springs, &s.joints), zero);
        if let Some((j, gap, by_motion)) = world.gap {
            let line = self.joint(j, &s.joints);
            if by_motion && s.moving[j].abs() > 1e-9 {
                *side = -s.moving[j].signum();
            } else if !by_motion {
                *side = (self.arm.weight_moment(j, &s.joints) / 5.0).clamp(-1.0, 1.0);
            }
            d = plus(
                d,
                scaled(cross(line.0, minus(hand, line.1)), 0.5 * gap * *side),
            );
        }
        let (spindle, arm, slow) = world.growth;
        let grown = (1.0 - (-s.time / slow).exp()) / (1.0 - (-end / slow).exp());
        d = plus(d, scaled(hand, arm * grown));
        let d = back(self, d);
        plus(d, [0.0, 0.0, -spindle * grown])
    }

    fn joint(&self, j: usize, joints: &[f64; 6]) -> Line {
        (
            facing(&self.arm.frame, joints, j, self.arm.frame.axes[j]),
            postured(&self.arm.frame, joints, j, self.arm.frame.points[j]),
        )
    }

    /// What is measured less nominal at every station.
    fn measured(&self, world: &World) -> Vec<V3> {
        let milled = self.milled(world);
        let all = self
            .stations
            .iter()
            .enumerate()
            .map(|(i, s)| self.surface(world, i, s, milled[i].at));
        all.collect()
    }

    /// The surface where the tool went this far beside its way.
    fn surface(&self, world: &World, i: usize, s: &Station, d: V3) -> V3 {
        let left = [-s.feed[1], s.feed[0], 0.0];
        let mut off = dot(&left, &d) + self.side * world.radius;
        if let Some(law) = world.corner {
            off += s
                .corners
                .iter()
                .enumerate()
                .map(|(n, c)| cut_short(law, n == 0, c))
                .sum::<f64>();
        }
        let middle = scaled(plus(self.mill.low, self.mill.high), 0.5);
        let datum = plus(world.offset, cross(world.turn, minus(s.tip, middle)));
        let datum = plus(datum, world.extra[i]);
        let across = off + dot(&left, &datum);
        plus(scaled(left, across), [0.0, 0.0, d[2] + datum[2]])
    }

    fn bare(&self, v: &[V3], tail: &[f64]) -> Vec<f64> {
        let mut all = Vec::new();
        for (s, d) in self.stations.iter().zip(v).filter(|(s, _)| self.counts(s)) {
            let left = [-s.feed[1], s.feed[0], 0.0];
            if self.wall {
                all.push(dot(&left, d) / self.noise);
            }
            if self.floor {
                all.push(d[2] / self.noise);
            }
        }
        all.extend(tail);
        all
    }
}

/// Displacement under a force, first order.
fn gives(lines: &[(Line, f64)], hand: V3, force: V3) -> V3 {
    lines.iter().fold([0.0; 3], |d, ((a, p), k)| {
        let arm = minus(hand, *p);
        plus(d, scaled(cross(*a, arm), dot(a, &cross(arm, force)) / k))
    })
}

/// How far to the left the path is cut short this far from a corner: behind it, or before.
fn cut_short(law: Corner, behind: bool, (way, turns): &(f64, f64)) -> f64 {
    if turns.abs() < 0.5 {
        return 0.0;
    }
    let inside = turns.signum();
    match law {
        Corner::Blend(r) if *way < r => inside * r * (1.0 - (way / r).sqrt()).powi(2),
        Corner::Blend(_) => 0.0,
        // x behind by L exp(-t), y = t - L (1 - exp(-t)) in the ways before and behind the corner.
        Corner::Lag(l) if behind => {
            let mut t = 0.0;
            while t - (1.0 - f64::exp(-t)) < way / l {
                t += 0.01;
            }
            inside * l * f64::exp(-t)
        }
        Corner::Lag(l) if *way < l => {
            let t = -(way / l).max(1e-6).ln();
            inside * l * (t - (1.0 - f64::exp(-t)))
        }
        Corner::Lag(_) => 0.0,
    }
}

impl World {
    fn told(habit: &Habit) -> Self {
        Self {
            springs: habit.arm.springs.clone(),
            material: habit.material,
            bend: 0.0,
            gap: None,
            radius: 0.0,
            offset: [0.0; 3],
            turn: [0.0; 3],
            corner: None,
            growth: (0.0, 0.0, 600.0),
            extra: vec![[0.0; 3]; habit.stations.len()],
        }
    }
}

const EFFECTS: [&str; 11] = [
    "cutting_coefficients",
    "drive_stiffness",
    "tilt_stiffness",
    "missing_tilt",
    "backlash",
    "tool_compliance",
    "tool_radius",
    "workpiece_offset",
    "workpiece_rotation",
    "corner_lag",
    "thermal_growth",
];
const OUTSIDE: [&str; 5] = [
    "chatter marks",
    "another tool from here on",
    "warped after unclamping",
    "probe lobes",
    "clamp slipped",
];

fn fits(name: &str, habit: &Habit) -> bool {
    let bearings = habit
        .arm
        .springs
        .iter()
        .filter(|s| s.effect == "tilt_stiffness")
        .count();
    match name {
        "tilt_stiffness" => bearings > 0,
        "missing_tilt" => bearings < 12,
        "tool_radius" => habit.wall && habit.told_side,
        "corner_lag" => habit.wall && habit.close && habit.shape == "pocket",
        "chatter marks" => habit.spacing < 3e-3 && habit.told_noise,
        "probe lobes" => habit.wall,
        _ => true,
    }
}

/// Puts a cause in place, its size by what shows of it; where, and its law.
fn place(
    name: &str,
    habit: &Habit,
    world: &mut World,
    random: &mut Random,
) -> (Option<String>, String) {
    let arm = &habit.arm;
    let sign: f64 = if chance(random, 0.5) { 1.0 } else { -1.0 };
    match name {
        "cutting_coefficients" => {
            let by =
                1.0 + sign.max(-0.5) * random.uniform(4.0, 8.0) * habit.told_material.max(0.05);
            let which = random.below(3);
            let own: &[usize] = [&[0, 1, 2, 3, 4, 5][..], &[0, 1, 2], &[3, 4, 5]][which];
            own.iter().for_each(|i| world.material[*i] *= by);
            (
                None,
                format!("{} times {by:.2}", ["all", "cutting", "edge"][which]),
            )
        }
        "drive_stiffness" | "tilt_stiffness" => {
            let own = |s: &&Spring| s.effect == name;
            let mut sites: Vec<String> = world
                .springs
                .iter()
                .filter(own)
                .map(|s| s.site.clone())
                .collect();
            sites.dedup();
            let site = pick(random, &sites).clone();
            let by = 1.0 + random.log_uniform(6.0 * habit.near.unwrap_or(0.02).max(0.03), 4.0);
            let springs = world
                .springs
                .iter_mut()
                .filter(|s| s.effect == name && s.site == site);
            springs.for_each(|s| s.stiffness /= by);
            (Some(site), format!("{by:.2} times softer"))
        }
        "missing_tilt" => {
            let free: Vec<usize> = (0..6)
                .filter(|j| {
                    arm.stiffness("tilt_stiffness", &format!("A{}", j + 1))
                        .is_none()
                })
                .collect();
            let j = *pick(random, &free);
            let k =
                arm.scale * random.log_uniform(0.3, 2.0) * [1.3e7, 2e7, 3e6, 1.9e6, 7e5, 1.5e6][j];
            world.springs.extend(arm.bearing(j, k));
            (Some(format!("A{}", j + 1)), format!("{k:.1e} Nm/rad"))
        }
        "backlash" => {
            let by_motion = chance(random, 0.6);
            let j = random.below(6);
            let gap = random.log_uniform(3e-5, 4e-4);
            world.gap = Some((j, gap, by_motion));
            let how = if by_motion { "by motion" } else { "by moment" };
            (
                Some(format!("A{}", j + 1)),
                format!("gap {:.0} urad {how}", 1e6 * gap),
            )
        }
        "tool_compliance" => {
            if chance(random, 0.5) {
                world.bend = 1.0 / random.log_uniform(1.5e6, 2e7);
                return (
                    Some("tool".into()),
                    format!("bends {:.1e} N/m", 1.0 / world.bend),
                );
            }
            let k = random.log_uniform(5e4, 1e6);
            world.springs.extend(arm.soft_tool(k, 1.0));
            (Some("tool".into()), format!("turns {k:.1e} Nm/rad"))
        }
        "tool_radius" => {
            world.radius = sign * random.log_uniform(1.5e-5, 1e-4);
            (None, format!("{:.0} um", 1e6 * world.radius))
        }
        "workpiece_offset" => {
            let d = askew(random, 1.0);
            let size = random.log_uniform(6.0 * habit.datum, 3e-4);
            world.offset = scaled(unit([d[1], d[2], d[3]]), size);
            (None, format!("{:.0?} um", world.offset.map(|x| 1e6 * x)))
        }
        "workpiece_rotation" => {
            let d = askew(random, 1.0);
            let flat = chance(random, 0.6);
            let d = if flat {
                [0.0, 0.0, sign]
            } else {
                unit([d[1], d[2], d[3]])
            };
            world.turn = scaled(d, random.log_uniform(3e-4, 4e-3));
            (None, format!("{:.1?} mrad", world.turn.map(|x| 1e3 * x)))
        }
        "corner_lag" => {
            let way = random.log_uniform(3e-4, 4e-3);
            let blend = chance(random, 0.5);
            world.corner = Some(if blend {
                Corner::Blend(way)
            } else {
                Corner::Lag(0.5 * way)
            });
            (
                None,
                format!(
                    "{} {:.1} mm",
                    if blend { "blend" } else { "lag" },
                    1e3 * way
                ),
            )
        }
        _ => {
            let slow = random.log_uniform(20.0, 2000.0);
            let spindle = chance(random, 0.5);
            let size = random.log_uniform(1.5e-5, 1.5e-4);
            world.growth = match spindle {
                true => (size, 0.0, slow),
                false => (0.0, size / norm(arm.hand(&habit.first_joints)), slow),
            };
            let what = if spindle { "spindle" } else { "arm" };
            (None, format!("{what} {:.0} um, {slow:.0} s", 1e6 * size))
        }
    }
}

fn outside(name: &str, habit: &Habit, random: &mut Random) -> (Vec<V3>, String) {
    let size = random.log_uniform(5.0, 30.0) * habit.noise;
    let count = habit.stations.len();
    let from = (count as f64 * random.uniform(0.3, 0.7)) as usize;
    let middle = scaled(plus(habit.mill.low, habit.mill.high), 0.5);
    let (k, wave, phase) = (
        random.below(2),
        random.uniform(4e-3, 9e-3),
        random.uniform(0.0, 6.0),
    );
    let of = |(i, s): (usize, &Station)| -> V3 {
        let left = [-s.feed[1], s.feed[0], 0.0];
        let behind = if i > from { 1.0 } else { 0.0 };
        match name {
            "chatter marks" => {
                let x = (std::f64::consts::TAU * s.s / wave + phase).sin();
                plus(scaled(left, x), [0.0, 0.0, 0.4 * x])
            }
            // Longer and thicker.
            "another tool from here on" => scaled(
                plus(scaled(left, 0.6 * habit.side), [0.0, 0.0, -1.0]),
                behind,
            ),
            "warped after unclamping" => {
                let at = (s.tip[k] - middle[k]) / (habit.mill.high[k] - middle[k]);
                let mut d = [0.0, 0.0, at * at];
                d[1 - k] = 0.7 * at * at;
                d
            }
            "probe lobes" => scaled(left, if s.feed[0].abs() > 0.5 { 1.0 } else { -1.0 }),
            _ => scaled([0.6, 0.7, 0.3], behind),
        }
    };
    let all = habit
        .stations
        .iter()
        .enumerate()
        .map(of)
        .map(|d| scaled(d, size));
    (all.collect(), format!("{name}; {:.0} um", 1e6 * size))
}

struct Hidden {
    name: &'static str,
    site: Option<String>,
    law: String,
    /// What it changes at every station, m.
    change: Vec<V3>,
    /// Standard deviations by which springs, material and datum would have to be off to do exactly the same.
    price: f64,
}

/// See [`Hidden::price`]: infinite where something else changed.
fn price(habit: &Habit, before: &World, after: &World) -> f64 {
    let of = |w: &World| (w.bend, w.gap, w.radius, w.turn, w.corner, w.growth);
    if of(before) != of(after) || before.springs.len() != after.springs.len() {
        return f64::INFINITY;
    }
    let near = habit.near.unwrap_or(0.02);
    let mut sites = std::collections::BTreeMap::new();
    for (b, a) in before.springs.iter().zip(&after.springs) {
        let off = (b.stiffness / a.stiffness - 1.0) / near;
        sites.insert((b.effect, b.site.clone()), off);
    }
    let coefficients = before.material.iter().zip(&after.material);
    let material = coefficients.map(|(b, a)| (a / b - 1.0) / habit.told_material);
    let places = before.offset.iter().zip(&after.offset);
    let datum = places.map(|(b, a)| (a - b) / habit.datum);
    let all = sites.into_values().chain(material).chain(datum);
    all.map(|x| x * x).sum::<f64>().sqrt()
}

fn difference(habit: &Habit, with: &World, base: &World) -> Vec<V3> {
    let (a, b) = (habit.measured(with), habit.measured(base));
    a.iter().zip(b).map(|(a, b)| minus(*a, b)).collect()
}

fn hide(habit: &Habit, world: &mut World, random: &mut Random) -> Vec<Hidden> {
    let names = chosen(random, USUAL, [&EFFECTS, &OUTSIDE], |name| {
        fits(name, habit)
    });
    let mut all = Vec::new();
    for name in names {
        if EFFECTS.contains(&name) {
            let before = world.clone();
            // At a site where it shows, if there is one.
            for attempt in 0..8 {
                *world = before.clone();
                let (site, law) = place(name, habit, world, random);
                let change = difference(habit, world, &before);
                let most = habit
                    .bare(&change, &[])
                    .iter()
                    .fold(0.0_f64, |m, x| m.max(x.abs()));
                if most > 4.0 || attempt == 7 {
                    let price = price(habit, &before, world);
                    all.push(Hidden {
                        name,
                        site,
                        law,
                        change,
                        price,
                    });
                    break;
                }
            }
        } else {
            let (extra, law) = outside(name, habit, random);
            world.extra = extra;
            let flat = habit.stations.iter().zip(&world.extra).map(|(s, d)| {
                let left = [-s.feed[1], s.feed[0], 0.0];
                plus(scaled(left, dot(&left, d)), [0.0, 0.0, d[2]])
            });
            all.push(Hidden {
                name: "outside",
                site: None,
                law,
                change: flat.collect(),
                price: f64::INFINITY,
            });
        }
    }
    all
}

/// What small changes of everything do to first order, for the best test.
/// The tool at one station.
struct Cut {
    /// Beside its way, m.
    at: V3,
    /// Force by coefficient.
    shares: [V3; 6],
    /// Where it goes when something moves it by one along every axis: the cut gives way, or is deeper.
    answers: [V3; 3],
}

struct Sensitivity<'a> {
    habit: &'a Habit,
    forces: Vec<V3>,
    cuts: Vec<Cut>,
}

impl<'a> Sensitivity<'a> {
    fn new(habit: &'a Habit) -> Self {
        let told = World::told(habit);
        let cuts = habit.milled(&told);
        let forces = habit.stations.iter().zip(&cuts).map(|(s, cut)| {
            let f = force(&cut.shares, &habit.material);
            based_force(habit, s, f)
        });
        Self {
            forces: forces.collect(),
            habit,
            cuts,
        }
    }

    /// Deviations when a spring gives way as much again.
    fn soft(&self, spring: &Spring) -> Vec<V3> {
        let h = self.habit;
        let one = std::slice::from_ref(spring);
        let zero = h.sag(one, &h.first_joints);
        let of = |(i, s): (usize, &Station)| {
            let line = h.arm.line(spring, &s.joints);
            let hand = h.arm.hand(&s.joints);
            let lever = minus(hand, line.1);
            let cut = dot(&line.0, &cross(lever, self.forces[i]));
            let bent = scaled(cross(line.0, lever), cut / spring.stiffness);
            self.moved(i, back(h, plus(bent, minus(h.sag(one, &s.joints), zero))))
        };
        h.stations.iter().enumerate().map(of).collect()
    }

    fn flat(&self, s: &Station, d: V3) -> V3 {
        let left = [-s.feed[1], s.feed[0], 0.0];
        plus(scaled(left, dot(&left, &d)), [0.0, 0.0, d[2]])
    }

    /// The surface where something moves the tool before the cut answers.
    fn moved(&self, i: usize, d: V3) -> V3 {
        let answers = &self.cuts[i].answers;
        let of = |k: usize| scaled(answers[k], d[k]);
        self.flat(&self.habit.stations[i], plus(plus(of(0), of(1)), of(2)))
    }

    /// Springs of one site together.
    fn group(&self, springs: &[Spring]) -> Vec<V3> {
        let mut sum = vec![[0.0; 3]; self.habit.stations.len()];
        for s in springs {
            let own = self.soft(s);
            sum = sum.iter().zip(own).map(|(a, b)| plus(*a, b)).collect();
        }
        sum
    }

    fn springs(&self) -> Vec<Vec<Spring>> {
        let mut all: Vec<Vec<Spring>> = Vec::new();
        for s in &self.habit.arm.springs {
            match all
                .iter_mut()
                .find(|g| g[0].effect == s.effect && g[0].site == s.site)
            {
                Some(own) => own.push(s.clone()),
                None => all.push(vec![s.clone()]),
            }
        }
        all
    }

    /// Deviations by one coefficient as it is.
    fn coefficient(&self, k: usize) -> Vec<V3> {
        let h = self.habit;
        let of = |(i, s): (usize, &Station)| {
            let f = based_force(h, s, scaled(self.cuts[i].shares[k], h.material[k]));
            let lines: Vec<(Line, f64)> = h
                .arm
                .springs
                .iter()
                .map(|p| (h.arm.line(p, &s.joints), p.stiffness))
                .collect();
            self.moved(i, back(h, gives(&lines, h.arm.hand(&s.joints), f)))
        };
        h.stations.iter().enumerate().map(of).collect()
    }

    /// What is free anyway: springs, coefficients and the datum within what is known of them.
    fn free(&self) -> Vec<Vec<f64>> {
        let near = self.habit.near.unwrap_or(0.02);
        let mut columns: Vec<(Vec<V3>, f64)> = self
            .springs()
            .iter()
            .map(|g| (self.group(g), near))
            .collect();
        columns.extend((0..6).map(|k| (self.coefficient(k), self.habit.told_material)));
        columns.extend((0..3).map(|k| (self.shifted(k), self.habit.datum)));
        let count = columns.len();
        let of = |(i, (c, near)): (usize, &(Vec<V3>, f64))| {
            let mut tail = vec![0.0; count];
            tail[i] = 1.0 / near;
            self.habit.bare(c, &tail)
        };
        columns.iter().enumerate().map(of).collect()
    }

    fn shifted(&self, k: usize) -> Vec<V3> {
        self.habit
            .stations
            .iter()
            .map(|s| self.flat(s, axis(k)))
            .collect()
    }

    fn each(&self, of: impl Fn(&Station) -> V3) -> Vec<V3> {
        self.habit
            .stations
            .iter()
            .map(|s| self.flat(s, of(s)))
            .collect()
    }

    /// The same where it is the tool that moves.
    fn each_moved(&self, of: impl Fn(&Station) -> V3) -> Vec<V3> {
        let stations = self.habit.stations.iter().enumerate();
        stations.map(|(i, s)| self.moved(i, of(s))).collect()
    }

    fn rivals(&self) -> Vec<Rival> {
        let h = self.habit;
        let mut all: Vec<Rival> = Vec::new();
        all.push((
            "cutting_coefficients",
            None,
            (0..6).map(|k| self.coefficient(k)).collect(),
        ));
        for g in self.springs() {
            all.push((g[0].effect, Some(g[0].site.clone()), vec![self.group(&g)]));
        }
        for j in 0..6 {
            let site = format!("A{}", j + 1);
            if h.arm.stiffness("tilt_stiffness", &site).is_none() {
                all.push((
                    "missing_tilt",
                    Some(site.clone()),
                    vec![self.group(&h.arm.bearing(j, 1e6))],
                ));
            }
            let moved =
                self.each_moved(|s| back(h, self.turned_joint(j, s, -s.moving[j].signum())));
            let pressed = self.each_moved(|s| {
                let side = (h.arm.weight_moment(j, &s.joints) / 5.0).clamp(-1.0, 1.0);
                back(h, self.turned_joint(j, s, side))
            });
            all.push(("backlash", Some(site.clone()), vec![moved]));
            all.push(("backlash", Some(site), vec![pressed]));
        }
        let soft = h.arm.soft_tool(1e5, 1.0);
        all.push((
            "tool_compliance",
            Some("tool".into()),
            vec![self.group(&soft)],
        ));
        let bend = h.stations.iter().enumerate().map(|(i, _)| {
            let f = back(h, self.forces[i]);
            self.moved(i, [1e-7 * f[0], 1e-7 * f[1], 0.0])
        });
        all.push(("tool_compliance", Some("tool".into()), vec![bend.collect()]));
        let thick = self.each_moved(|s| scaled([-s.feed[1], s.feed[0], 0.0], h.side));
        if h.told_side {
            all.push(("tool_radius", None, vec![thick]));
        }
        all.push((
            "workpiece_offset",
            None,
            (0..3).map(|k| self.shifted(k)).collect(),
        ));
        let turns = (0..3).map(|k| self.each(|s| cross(axis(k), s.tip)));
        all.push(("workpiece_rotation", None, turns.collect()));
        for law in [Corner::Blend(1.5e-3), Corner::Lag(7e-4)] {
            let of = |s: &Station| {
                let both = s
                    .corners
                    .iter()
                    .enumerate()
                    .map(|(n, c)| cut_short(law, n == 0, c));
                scaled([-s.feed[1], s.feed[0], 0.0], both.sum())
            };
            all.push(("corner_lag", None, vec![self.each(of)]));
        }
        for slow in [30.0, 1e4] {
            let grown = |s: &Station| 1.0 - (-s.time / slow).exp();
            let spindle = self.each_moved(|s| [0.0, 0.0, -grown(s)]);
            let arm = self.each_moved(|s| back(h, scaled(h.arm.hand(&s.joints), grown(s))));
            all.push(("thermal_growth", None, vec![spindle]));
            all.push(("thermal_growth", None, vec![arm]));
        }
        all
    }

    fn turned_joint(&self, j: usize, s: &Station, by: f64) -> V3 {
        let line = self.habit.joint(j, &s.joints);
        scaled(
            cross(line.0, minus(self.habit.arm.hand(&s.joints), line.1)),
            by,
        )
    }
}

/// Rounds within which force and deflection agree, and by how much they still differ, m.
const ROUNDS: usize = 60;
const AGREE: f64 = 2e-8;

/// Where the tool stands so that the force of the cut there is what holds it there: steps towards what the last
/// place asks, shorter where they do not bring it nearer (a soft tool in a hard cut overshoots).
fn at_rest<T>(from: V3, asks: impl Fn(V3) -> (V3, T)) -> (V3, T) {
    let (mut d, mut share, mut before) = (from, 1.0, f64::INFINITY);
    let (mut asked, mut of) = asks(d);
    for _ in 0..ROUNDS {
        let step = minus(asked, d);
        let far = dot(&step, &step).sqrt();
        if far < AGREE {
            break;
        }
        if far > 0.7 * before {
            share = f64::max(0.7 * share, 0.05);
        }
        before = far;
        d = plus(d, scaled(step, share));
        (asked, of) = asks(d);
    }
    (d, of)
}

/// Way by which an answer is tried, m.
const TRIED: f64 = 5e-6;

/// Where the tool goes when something else moves it by one along every axis: (1 - J)⁻¹, J the slope of where the
/// cut and the springs put it.
fn answers(d: V3, stands: impl Fn(V3) -> V3) -> [V3; 3] {
    let slope = |k: usize| {
        let (more, less) = (
            plus(d, scaled(axis(k), TRIED)),
            minus(d, scaled(axis(k), TRIED)),
        );
        scaled(minus(stands(more), stands(less)), 0.5 / TRIED)
    };
    let [a, b, c] = [0, 1, 2].map(|k| minus(axis(k), slope(k)));
    let volume = dot(&a, &cross(b, c));
    if volume.abs() < 1e-3 {
        return [axis(0), axis(1), axis(2)];
    }
    let rows = [cross(b, c), cross(c, a), cross(a, b)];
    [0, 1, 2].map(|k| [0, 1, 2].map(|i| rows[i][k] / volume))
}

fn based_force(h: &Habit, s: &Station, f: V3) -> V3 {
    let (ahead, left) = ([s.feed[0], s.feed[1], 0.0], [-s.feed[1], s.feed[0], 0.0]);
    placed(
        h,
        plus(
            plus(scaled(ahead, f[0]), scaled(left, f[1])),
            [0.0, 0.0, f[2]],
        ),
    )
}

fn truths(habit: &Habit, hidden: &[Hidden]) -> Vec<Truth> {
    if hidden.is_empty() {
        return Vec::new();
    }
    let s = Sensitivity::new(habit);
    let free = s.free();
    let tail = vec![0.0; free.len()];
    let rivals: Vec<Seen> = s
        .rivals()
        .into_iter()
        .map(|(e, s, c)| (e, s, c.iter().map(|c| habit.bare(c, &tail)).collect()))
        .collect();
    let seen: Vec<Vec<f64>> = hidden
        .iter()
        .map(|h| habit.bare(&h.change, &tail))
        .collect();
    let one = |i: usize| {
        let others = (0..hidden.len())
            .filter(|j| *j != i)
            .map(|j| seen[j].clone());
        let known: Vec<Vec<f64>> = free.iter().cloned().chain(others).collect();
        truth(hidden, i, &basis(&known), &seen[i], &rivals)
    };
    (0..hidden.len()).map(one).collect()
}

fn truth(hidden: &[Hidden], i: usize, known: &[Vec<f64>], seen: &[f64], rivals: &[Seen]) -> Truth {
    let Hidden {
        name,
        site,
        law,
        price,
        ..
    } = &hidden[i];
    let own = without(seen, known);
    // the free columns are straight, what is hidden is not: no test sees more than it costs to be none
    let sight = dot(&own, &own).sqrt().min(*price);
    let left = |columns: &Vec<Vec<f64>>| {
        let bare: Vec<Vec<f64>> = columns.iter().map(|c| without(c, known)).collect();
        let rest = without(&own, &basis(&bare));
        dot(&rest, &rest).sqrt()
    };
    let same = |e: &str, s: &Option<String>| {
        hidden
            .iter()
            .any(|h| h.name == e && (h.site.is_none() || h.site == *s))
    };
    let near: Vec<(&'static str, Option<String>, f64)> = rivals
        .iter()
        .filter(|(e, s, _)| !same(e, s))
        .map(|(e, s, c)| (*e, s.clone(), left(c)))
        .collect();
    let inside = *name != "outside";
    let twins = near.iter().filter(|n| inside && twin(n.2, sight));
    Truth {
        effect: name,
        site: site.clone(),
        sight,
        apart: near.iter().map(|n| n.2).fold(sight, f64::min),
        twins: twins.map(|n| (n.0, n.1.clone())).collect(),
        strength: seen.iter().fold(0.0_f64, |m, x| m.max(x.abs())),
        law: law.clone(),
    }
}

/// The robot, the material and the part as they are.
fn real(habit: &Habit, random: &mut Random) -> World {
    let mut world = World::told(habit);
    let near = habit.near.unwrap_or(0.01);
    let mut last = (String::new(), 1.0);
    for s in &mut world.springs {
        let tag = format!("{} {}", s.effect, s.site);
        if last.0 != tag {
            last = (tag, 1.0 + near * random.normal().clamp(-2.0, 2.0));
        }
        s.stiffness /= last.1;
    }
    for k in &mut world.material {
        *k *= 1.0 + habit.told_material * random.normal().clamp(-2.0, 2.0);
    }
    world.offset = std::array::from_fn(|_| 0.8 * habit.datum * random.normal().clamp(-2.0, 2.0));
    world
}

/// A case.
pub fn draw(seed: u64) -> Case {
    let mut random = Random::new(seed ^ 0x9a47_0000);
    let habit = Habit::draw(&mut random);
    let mut world = real(&habit, &mut random);
    let hidden = hide(&habit, &mut world, &mut random);
    let rows = habit.measured(&world);
    let mut files = vec![("part.csv".to_string(), habit.part(&rows, &mut random))];
    files.extend(habit.files());
    Case {
        seed,
        truths: truths(&habit, &hidden),
        habit: habit.said(),
        files,
    }
}

/// How far naming what is hidden lowers the error of the present simulation, in percent of all that is read: with
/// everything else as the files state it, and with everything else as it is.
pub fn worth(seed: u64) -> [f64; 2] {
    let mut random = Random::new(seed ^ 0x9a47_0000);
    let habit = Habit::draw(&mut random);
    let mut world = real(&habit, &mut random);
    let hidden = hide(&habit, &mut world, &mut random);
    let best = habit.bare(&habit.measured(&world), &[]);
    let present = habit.bare(&habit.measured(&World::told(&habit)), &[]);
    let named: Vec<Vec<f64>> = hidden.iter().map(|h| habit.bare(&h.change, &[])).collect();
    let (mut before, mut after) = (0.0, [0.0; 2]);
    for i in 0..best.len() {
        let noise = random.normal();
        let off = best[i] + noise - present[i];
        let named: f64 = named.iter().map(|n| n[i]).sum();
        before += off * off;
        after[0] += (off - named).powi(2);
        after[1] += noise * noise;
    }
    after.map(|after| 100.0 * (1.0 - (after / before).sqrt()))
}

/// The nominal part: its files, and what the springs and the cut make of every probed place: s, deviation (m) and
/// force (N) in the workpiece frame. For holding this plant against another.
pub fn nominal(seed: u64) -> (Files, Vec<(f64, V3, V3)>) {
    let mut random = Random::new(seed ^ 0x9a47_0000);
    let habit = Habit::draw(&mut random);
    let milled = habit.milled(&World::told(&habit));
    let each = habit.stations.iter().zip(&milled);
    let rows = each.filter(|(s, _)| habit.counts(s)).map(|(s, cut)| {
        let f = force(&cut.shares, &habit.material);
        (s.s, cut.at, back(&habit, based_force(&habit, s, f)))
    });
    let rows = rows.collect();
    (habit.files(), rows)
}

impl Habit {
    fn files(&self) -> Files {
        vec![
            ("job.toml".to_string(), self.job()),
            ("path.csv".to_string(), self.path()),
            ("robot.toml".to_string(), self.arm.text.clone()),
        ]
    }

    fn said(&self) -> String {
        let probed = self.stations.iter().filter(|s| self.counts(s)).count();
        format!(
            "{} {}, {probed} places of {}{}{}, tool {} x{}, noise {:.1} um{}, datum {:.0}{}, springs {}, material {}{}{}",
            self.arm.build,
            self.shape,
            if self.wall { "wall" } else { "" },
            if self.floor { " floor" } else { "" },
            if self.close { " near corners" } else { "" },
            self.diameter_mm,
            self.mill.teeth,
            1e6 * self.noise,
            if self.told_noise { " told" } else { "" },
            1e6 * self.datum,
            if self.told_datum { " told" } else { "" },
            self.near.map_or("untold".into(), |n| n.to_string()),
            self.told_material,
            if self.told_side { "" } else { ", no side" },
            if self.by_way { ", by s" } else { "" },
        )
    }

    fn job(&self) -> String {
        let v = |x: V3, s: f64| {
            format!(
                "[{:.4}, {:.4}, {:.4}]",
                s * x[0] + 0.0,
                s * x[1] + 0.0,
                s * x[2] + 0.0
            )
        };
        let q: Vec<String> = self
            .first_joints
            .iter()
            .map(|q| format!("{:.3}", q.to_degrees()))
            .collect();
        let k = self.material;
        format!(
            "kind = \"job\"\nrobot = \"robot.toml\"\npath = \"path.csv\"\nfeed_mm_min = {:?}\nblend_radius_mm = 0.0\nspin = \"fixed\"\nstart_joints_deg = [{}]\n\n[workpiece]\norigin_m = {}\nabc_deg = [{:?}, 0.0, 0.0]\nstock_min_mm = {}\nstock_max_mm = {}\n\n[tool]\ndiameter_mm = {:?}\nteeth = {}\nhelix_deg = 30.0\nflute_mm = 32.0\nspindle_rpm = {:?}\n\n[material]\nname = \"stuff\"\nKtc_N_mm2 = {:?}\nKrc_N_mm2 = {:?}\nKac_N_mm2 = {:?}\nKte_N_mm = {:?}\nKre_N_mm = {:?}\nKae_N_mm = {:?}\nrel_std = {:?}\n\n[limits]\npath_acceleration_m_s2 = 0.5\npath_jerk_m_s3 = 5.0\ntolerance_mm = 0.2\n",
            self.feed_mm_min,
            q.join(", "),
            v(self.origin, 1.0),
            self.turn_z_deg,
            v(self.mill.low, 1e3),
            v(self.mill.high, 1e3),
            self.diameter_mm,
            self.mill.teeth,
            self.mill.rpm,
            k[0] / 1e6,
            k[1] / 1e6,
            k[2] / 1e6,
            k[3] / 1e3,
            k[4] / 1e3,
            k[5] / 1e3,
            self.told_material,
        )
    }

    fn path(&self) -> String {
        let [a, b, c] = self.abc_deg;
        let mut all = String::from("# kind = \"path\"\nx_mm,y_mm,z_mm,a_deg,b_deg,c_deg,rapid\n");
        let row = |x: V3, rapid: bool| {
            let x = x.map(|x| 1e3 * x + 0.0);
            format!(
                "{:.4},{:.4},{:.4},{a:.9},{b:.9},{c:.9},{}\n",
                x[0],
                x[1],
                x[2],
                u8::from(rapid)
            )
        };
        all += &row(self.start, true);
        let mut at = self.start;
        for m in &self.moves {
            if norm(minus(m.to, at)) > 1e-9 {
                all += &row(m.to, m.rapid);
            }
            at = m.to;
        }
        all
    }

    fn part(&self, rows: &[V3], random: &mut Random) -> String {
        let mut all = String::from("# kind = \"milled-part\"\n# job = \"job.toml\"\n");
        if self.told_noise {
            all += &format!("# probe_noise_mm = {:.5}\n", 1e3 * self.noise);
        }
        if self.told_datum {
            all += &format!("# datum_std_mm = {:.4}\n", 1e3 * self.datum);
        }
        if self.told_side && self.wall {
            all += &format!(
                "# side = \"{}\"\n",
                if self.side > 0.0 { "left" } else { "right" }
            );
        }
        all += if self.by_way {
            "s_mm"
        } else {
            "x_mm,y_mm,z_mm"
        };
        all += ",dx_mm,dy_mm,dz_mm\n";
        for (s, d) in self
            .stations
            .iter()
            .zip(rows)
            .filter(|(s, _)| self.counts(s))
        {
            let place = match self.by_way {
                true => format!("{:.4}", 1e3 * s.s),
                false => format!(
                    "{:.4},{:.4},{:.4}",
                    1e3 * s.tip[0],
                    1e3 * s.tip[1],
                    1e3 * s.tip[2]
                ),
            };
            let mut cells = vec![place];
            for (k, d) in d.iter().enumerate() {
                let across = k < 2 && s.feed[k].abs() < 0.5;
                let read = if k == 2 {
                    self.floor
                } else {
                    self.wall && across
                };
                let noise = self.noise * random.normal();
                cells.push(match read {
                    true => format!("{:.5}", 1e3 * (d + noise)),
                    false => String::new(),
                });
            }
            all += &cells.join(",");
            all.push('\n');
        }
        all
    }
}
