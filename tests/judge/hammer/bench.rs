//! The laboratory of one case: the real robot, the day, and what eyes that know everything else see of a cause.

use super::dynamics::{Pairs, World};
use super::habit::Habit;
use super::hidden::Hidden;
use super::records::{Record, estimated, records};
use super::robot::{Robot, Spread, bounded};
use super::sight::{Seen, Sight};
use crate::judge::{Truth, chance};
use ident::ground::random::Random;

/// A laboratory: the file's robot, the real one, and the day.
pub struct Bench {
    pub told: Robot,
    pub spread: Spread,
    /// Which spreads the file tells: bodies, damping, stiffness with gain; and whether in the robot file.
    pub tells: [bool; 3],
    pub within: bool,
    pub world: World,
    pub habit: Habit,
}

impl Bench {
    pub fn draw(random: &mut Random) -> Self {
        let told = Robot::draw(random);
        let tells = [0.6, 0.6, 0.6].map(|p| chance(random, p));
        let between = |random: &mut Random, told: bool, usual: f64, low: f64, high: f64| {
            let x = if told {
                random.uniform(low, high)
            } else {
                usual
            };
            (x * 1e4).round() / 1e4
        };
        let spread = Spread {
            stiffness: between(random, tells[2], 0.05, 0.02, 0.1),
            damping: between(random, tells[1], 0.25, 0.08, 0.3),
            mass: between(random, tells[0], 0.02, 0.01, 0.03),
            com: between(random, tells[0], 0.005, 0.002, 0.008),
            inertia: between(random, tells[0], 0.05, 0.03, 0.08),
            gain: between(random, tells[2], 0.01, 0.005, 0.02),
        };
        let joints: [f64; 6] = std::array::from_fn(|i| {
            let turn: f64 = told.home_deg[i] + random.uniform(-25.0, 25.0);
            turn.round().to_radians()
        });
        let real = told.real(&spread, random);
        let mut world = World::new(real, joints);
        let habit = Habit::draw(random, world.plant().slowest());
        world.decay = habit.window.map_or(0.0, |t| 1.0 / t);
        for i in 0..3 {
            world.sensor[i][i] = 1.0 + spread.gain * bounded(random);
        }
        world.hammer = 1.0 + spread.gain * bounded(random);
        Self {
            within: chance(random, 0.4),
            told,
            spread,
            tells,
            world,
            habit,
        }
    }

    pub fn with(&self, hidden: &[(Hidden, f64)], but: Option<usize>) -> World {
        let mut world = self.world.clone();
        for (i, (one, size)) in hidden.iter().enumerate() {
            if Some(i) != but {
                one.apply(&mut world, *size);
            }
        }
        world
    }

    /// Transfer functions at the lines of a sight, with all that is hidden but one.
    pub fn answers(
        &self,
        hidden: &[(Hidden, f64)],
        but: Option<usize>,
        sight: &Sight,
    ) -> Vec<Pairs> {
        let world = self.with(hidden, but);
        if world.bent.is_some() || world.wander > 0.0 || world.knock > 0.0 {
            let all = records(&world, &self.habit);
            return seen(&all, &self.habit, sight);
        }
        let plant = world.plant();
        let at = |f: &f64| world.transfer(&plant, *f);
        sight.frequencies.iter().map(at).collect()
    }

    /// What one of the hidden causes does to the transfer functions.
    fn change(&self, hidden: &[(Hidden, f64)], which: usize, sight: &Sight) -> Vec<Pairs> {
        let with = self.answers(hidden, None, sight);
        let without = match hidden[which].0.stepped() {
            true => {
                let plain = self.with(hidden, Some(which));
                seen(&records(&plain, &self.habit), &self.habit, sight)
            }
            false => self.answers(hidden, Some(which), sight),
        };
        with.iter().zip(&without).map(less).collect()
    }

    fn see(&self, hidden: &[(Hidden, f64)], which: usize, sight: &Sight, deep: bool) -> Seen {
        let own = &hidden[which].0;
        if own.fixed() {
            return Seen {
                sight: 50.0,
                apart: 50.0,
                strength: 10.0,
                twins: Vec::new(),
            };
        }
        let change = self.change(hidden, which, sight);
        let stated = own.beyond(hidden[which].1, &self.spread, &self.told);
        let others = (0..hidden.len()).filter(|i| *i != which && !hidden[*i].0.fixed());
        let others: Vec<Vec<Pairs>> = others.map(|i| self.change(hidden, i, sight)).collect();
        let seen = sight.of(&change, &others, (own.effect, own.site.as_deref()), deep);
        Seen {
            sight: seen.sight.min(stated),
            ..seen
        }
    }

    /// Eyes for one of the hidden causes: they know all but it.
    pub fn sight(&self, hidden: &[(Hidden, f64)], which: Option<usize>, plain: &[Record]) -> Sight {
        let mut world = self.with(hidden, which);
        world.decay = self.world.decay;
        Sight::new(&world, &self.spread, &self.habit, plain)
    }

    /// A cause of a size that is seen: the first of growing sizes that the best test sees well, and somewhat more.
    pub fn sized(
        &self,
        name: &'static str,
        plain: &[Record],
        random: &mut Random,
    ) -> (Hidden, f64) {
        let sight = self.sight(&[], None, plain);
        let mut last = None;
        for _ in 0..12 {
            let drawn = Hidden::draw(name, &self.world, &self.told, &self.habit, random);
            let Some(drawn) = drawn else { continue };
            if drawn.fixed() {
                return (drawn, 1.0);
            }
            let least = random.uniform(6.0, 14.0);
            let strong = random.log_uniform(3.0, 12.0);
            let mut one = [(drawn, 0.0)];
            for size in [0.2, 0.3, 0.45, 0.7, 1.0, 1.5, 2.3, 3.5, 5.0] {
                if matches!(one[0].0.effect, "drive_stiffness" | "tilt_stiffness") && size > 1.5 {
                    break;
                }
                one[0].1 = size * random.uniform(0.85, 1.15);
                if one[0].0.beyond(one[0].1, &self.spread, &self.told) < least {
                    continue;
                }
                let seen = self.see(&one, 0, &sight, false);
                let enough = match one[0].0.effect {
                    "outside" => seen.apart,
                    _ => seen.sight,
                };
                if enough > least && seen.strength > strong {
                    let [found] = one;
                    return found;
                }
            }
            let [found] = one;
            last = Some(found);
        }
        last.unwrap_or_else(|| {
            let sound = Hidden::draw("time_skew", &self.world, &self.told, &self.habit, random);
            (sound.unwrap(), 3.0)
        })
    }

    pub fn truths(&self, hidden: &[(Hidden, f64)], plain: &[Record]) -> Vec<Truth> {
        if hidden.is_empty() {
            return Vec::new();
        }
        let truth = |i: usize| {
            let sight = self.sight(hidden, Some(i), plain);
            let (own, size) = &hidden[i];
            let seen = self.see(hidden, i, &sight, true);
            Truth {
                effect: own.effect,
                site: own.site.clone(),
                sight: seen.sight,
                apart: seen.apart,
                twins: if own.effect == "outside" {
                    Vec::new()
                } else {
                    seen.twins
                },
                strength: seen.strength,
                law: format!("{} times {size:.2}", own.law),
            }
        };
        (0..hidden.len()).map(truth).collect()
    }
}

pub fn less((a, b): (&Pairs, &Pairs)) -> Pairs {
    std::array::from_fn(|r| std::array::from_fn(|d| a[r][d] - b[r][d]))
}

pub fn seen(all: &[Record], habit: &Habit, sight: &Sight) -> Vec<Pairs> {
    let at = |f: &f64| estimated(all, *f, habit.interval).0;
    sight.frequencies.iter().map(at).collect()
}
