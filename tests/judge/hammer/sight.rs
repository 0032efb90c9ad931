//! How well the best test sees what is hidden: change of the transfer functions over their noise, beyond what the
//! stated spreads of springs, oil, bodies and calibration may do, and beyond each rival. Spreads act to first order:
//! where several of them together go far, less is seen than is said here.

use super::super::algebra::{basis, dot, without};
use super::dynamics::{C, Pairs, Plant, World, lines, weight};
use super::habit::Habit;
use super::line::{Line, whole};
use super::records::{Record, estimated};
use super::rival::{RIGID, Rival, blamed, with_candidates};
use super::robot::Spread;
use nalgebra::DMatrix;

/// Lines of the band that are looked at, and the band, Hz.
const LINES: usize = 44;
const BAND: [f64; 2] = [3.0, 50.0];

/// What nature misses of any linear law, share of the transfer function.
const LAWS: f64 = 0.005;

/// Eyes for one file.
pub struct Sight {
    pub frequencies: Vec<f64>,
    /// Standard deviation of real and imaginary part, and how many free lines stand behind.
    sigma: Vec<[[f64; 3]; 3]>,
    share: f64,
    pairs: Vec<(usize, usize)>,
    priors: usize,
    sound: Vec<Vec<f64>>,
    pub rivals: Vec<Rival>,
    pub lines: Vec<Line>,
    /// Hinges that may give: effect, site, members, stiffness as it is.
    gives: Vec<(&'static str, Option<String>, Vec<usize>, f64)>,
}

/// What one file shows of one cause.
pub struct Seen {
    pub sight: f64,
    pub apart: f64,
    pub strength: f64,
    pub twins: Vec<(&'static str, Option<String>)>,
}

impl Sight {
    /// For the world as it is, the file's spreads and a day's hits; `records` without noise.
    pub fn new(world: &World, spread: &Spread, habit: &Habit, records: &[Record]) -> Self {
        let (robot, candidates) = with_candidates(&world.robot);
        let springs = world.robot.springs();
        let eyes = World {
            robot,
            absorber: None,
            rubber: None,
            ..world.clone()
        };
        let plant = eyes.plant();
        let step = (BAND[1] - BAND[0]) / (LINES - 1) as f64;
        let frequencies: Vec<f64> = (0..LINES).map(|i| BAND[0] + step * i as f64).collect();
        let at = |f: &f64| Line::new(&plant, C::new(world.decay, std::f64::consts::TAU * f));
        let all: Vec<Line> = frequencies.iter().map(at).collect();
        let mut own = Self {
            sigma: Vec::new(),
            share: 0.0,
            pairs: Vec::new(),
            priors: 0,
            sound: Vec::new(),
            rivals: Vec::new(),
            lines: Vec::new(),
            gives: Vec::new(),
            frequencies,
        };
        own.listen(world, habit, records);
        own.learn(&eyes, &plant, &springs, spread, &all);
        own.blame(&eyes, &plant, &springs, &candidates, &all, spread.stiffness);
        for (kind, site, members) in springs {
            let k = eyes.robot.hinges[members[0]].k;
            let (effect, site) = blamed(kind, &site);
            own.gives.push((effect, site, members, k));
        }
        let rigid = candidates.into_iter().map(|(e, s, m)| (e, s, m, RIGID));
        own.gives.extend(rigid);
        own.lines = all;
        own
    }

    fn listen(&mut self, world: &World, habit: &Habit, records: &[Record]) {
        let (mut sum, mut fourth) = (0.0, 0.0);
        for i in 0..habit.samples {
            let w = (-2.0 * world.decay * i as f64 * habit.interval).exp();
            sum += w;
            fourth += w * w;
        }
        let free = sum * sum / fourth * habit.interval;
        self.share = ((BAND[1] - BAND[0]) * free / LINES as f64).sqrt();
        for direction in habit.directions() {
            self.pairs
                .extend(habit.responses.iter().map(|r| (*r, direction)));
        }
        for f in &self.frequencies {
            let (h, force) = estimated(records, *f, habit.interval);
            let power = habit.noise.power(*f, habit.interval);
            let hammer = habit.noise.force.powi(2);
            let of = |r: usize, d: usize| {
                let read = power + h[r][d].norm_sqr() * hammer;
                let law = h[r][d].norm() * LAWS;
                (0.5 * read * sum / force[d].max(1e-300) + 0.5 * law * law).sqrt()
            };
            let all = std::array::from_fn(|r| std::array::from_fn(|d| of(r, d)));
            self.sigma.push(all);
        }
    }

    /// Over the noise, as one long vector; nothing is known of priors.
    pub fn white(&self, change: &[Pairs]) -> Vec<f64> {
        let mut all = Vec::with_capacity(change.len() * self.pairs.len() * 2 + self.priors);
        for (pairs, sigma) in change.iter().zip(&self.sigma) {
            for (r, d) in &self.pairs {
                let z = pairs[*r][*d] * (self.share / sigma[*r][*d]);
                all.extend([z.re, z.im]);
            }
        }
        all.resize(all.len() + self.priors, 0.0);
        all
    }

    fn learn(
        &mut self,
        eyes: &World,
        plant: &Plant,
        springs: &[(&'static str, String, Vec<usize>)],
        spread: &Spread,
        all: &[Line],
    ) {
        let mut columns: Vec<Vec<Pairs>> = Vec::new();
        for (_, _, members) in springs {
            let hinge = &eyes.robot.hinges[members[0]];
            let stiff = C::new(hinge.k * spread.stiffness, 0.0);
            columns.push(all.iter().map(|l| l.springs(members, stiff)).collect());
            let oil = hinge.d * spread.damping;
            columns.push(all.iter().map(|l| l.springs(members, l.s * oil)).collect());
        }
        for more in bodies(eyes, spread) {
            let more = whole(&more);
            columns.push(all.iter().map(|l| l.mass(&more)).collect());
        }
        for axis in 0..4 {
            let gain = |l: &Line| {
                let mut h = l.transfer(plant);
                for (r, row) in h.iter_mut().enumerate() {
                    let own = if axis == 3 || axis == r {
                        spread.gain
                    } else {
                        0.0
                    };
                    row.iter_mut().for_each(|z| *z *= own);
                }
                h
            };
            columns.push(all.iter().map(gain).collect());
        }
        self.priors = columns.len();
        let rows = all.len() * self.pairs.len() * 2;
        let known: Vec<Vec<f64>> = columns
            .iter()
            .enumerate()
            .map(|(i, c)| {
                let mut v = self.white(c);
                v[rows + i] = 1.0;
                v
            })
            .collect();
        self.sound = basis(&known);
    }

    /// What is seen of a change beside other changes.
    pub fn of(
        &self,
        change: &[Pairs],
        others: &[Vec<Pairs>],
        own: (&str, Option<&str>),
        deep: bool,
    ) -> Seen {
        let shown = self.white(change);
        let strength = shown.iter().fold(0.0, |m: f64, x| m.max(x.abs())) / self.share;
        let others: Vec<Vec<f64>> = others
            .iter()
            .map(|o| without(&self.white(o), &self.sound))
            .collect();
        let others = basis(&others);
        let left = without(&without(&shown, &self.sound), &others);
        let sight = dot(&left, &left).sqrt();
        let (mut apart, mut within, mut twins) = (sight, sight, Vec::new());
        for rival in &self.rivals {
            if rival.effect == own.0 && (own.1.is_none() || rival.site.as_deref() == own.1) {
                continue;
            }
            let free: Vec<Vec<f64>> = rival
                .columns
                .iter()
                .map(|c| without(&without(c, &self.sound), &others))
                .collect();
            let rest = without(&left, &basis(&free));
            let rest = dot(&rest, &rest).sqrt();
            apart = apart.min(rest);
            within = within.min(rest.hypot(rival.cost));
            let told = (rival.effect, rival.site.clone());
            if super::super::twin(rest, sight) && !twins.contains(&told) {
                twins.push(told);
            }
        }
        for (effect, site, members, told) in self.gives.iter().filter(|_| deep) {
            if *effect == own.0 && (own.1.is_none() || site.as_deref() == own.1) {
                continue;
            }
            let shown = |v: &[f64]| {
                let rest: Vec<f64> = left
                    .iter()
                    .zip(without(&without(v, &self.sound), &others))
                    .map(|(a, b)| a - b)
                    .collect();
                dot(&rest, &rest).sqrt()
            };
            let starts: &[f64] = if *told == RIGID {
                &[5e6, 2e7, 8e7]
            } else {
                &[*told]
            };
            for start in starts {
                let rest = self.refined(members, *told, *start, &shown);
                apart = apart.min(rest);
                let named = (*effect, site.clone());
                if super::super::twin(rest, sight) && !twins.contains(&named) {
                    twins.push(named);
                }
            }
        }
        Seen {
            sight: within,
            apart,
            strength,
            twins,
        }
    }
}

/// What each stated spread of the bodies does to the mass matrix.
fn bodies(eyes: &World, spread: &Spread) -> Vec<DMatrix<f64>> {
    let (robot, q) = (&eyes.robot, &eyes.joints);
    let at = lines(robot, q);
    let mut all = Vec::new();
    for body in &robot.bodies {
        let with = |change: &dyn Fn(&mut super::robot::Body)| {
            let mut own = body.clone();
            change(&mut own);
            weight(robot, q, &at, &own)
        };
        let own = with(&|_| ());
        all.push(with(&|b| b.mass *= 1.0 + spread.mass) - &own);
        for i in 0..3 {
            let (more, less) = (
                with(&|b| b.com[i] += spread.com),
                with(&|b| b.com[i] -= spread.com),
            );
            all.push((more - less) * 0.5);
        }
        let mean = (body.inertia[0] + body.inertia[1] + body.inertia[2]) / 3.0;
        for i in 0..6 {
            let size = if i < 3 { body.inertia[i] } else { 0.5 * mean };
            all.push(with(&|b| b.inertia[i] += spread.inertia * size) - &own);
        }
    }
    all
}
