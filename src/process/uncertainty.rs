//! What the uncertainty of springs and coefficients makes of the deviation at one station.
//!
//! Linearised: every spring, damper and coefficient is moved by one standard deviation, the part is
//! milled again, less finely, and the changes at the station are summed as independent.

use super::run::Outcome as Milled;
use super::setup::{Setup, Support};
use crate::ground::problem::Outcome;
use crate::ground::spatial::{V3, add, dot, norm, scale, sub};
use crate::ground::stats::Z95;
use crate::motion::Linear;
use crate::robot::Robot;
use rayon::prelude::*;

/// One number that is not known exactly.
#[derive(Debug, Clone, PartialEq)]
pub struct Doubt {
    /// Its name: `stiffness`, `Ktc`.
    pub name: String,
    /// Its site: `A2-tilt`; the material's for coefficients.
    pub site: String,
    /// Relative standard deviation.
    pub rel_std: f64,
    which: Which,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Which {
    Spring(usize),
    Damper(usize),
    Gap(f64),
    Coefficient(usize),
}

/// Springs known better than this are not simulated anew: first order is closer than that ...
const SMALL: f64 = 0.02;
/// ... nor dampers known better than this: they change no more than their part in what swings.
const BOUNDED: f64 = 0.2;

/// Standard deviation of a place anywhere within a gap, over the gap: 1/√12.
const ANYWHERE: f64 = 0.288_675;

/// Everything whose uncertainty is stated: springs with intervals or a
/// stated spread, and coefficients with these relative
/// standard deviations (`None`: not stated).
pub fn doubts(robot: &Robot, setup: &Setup, coefficients: &[Option<f64>]) -> Vec<Doubt> {
    let of_springs = robot.springs().enumerate().flat_map(|(i, (site, spring))| {
        let damping = spring.ci95.damping.filter(|_| spring.damping > 0.0);
        let damping = damping.map(|[low, high]| (high - low) / (2.0 * Z95 * spring.damping));
        let known = [
            ("stiffness", spring.relative_std(), Which::Spring(i)),
            ("damping", damping, Which::Damper(i)),
        ];
        known.into_iter().filter_map(move |(name, rel_std, which)| {
            Some(Doubt {
                name: name.into(),
                site: site.clone(),
                rel_std: rel_std?,
                which,
            })
        })
    });
    let gaps = robot.springs().filter_map(|(site, spring)| {
        let gap = spring.ci95.backlash.map_or(spring.gap(), |ci95| ci95[1]);
        (gap > 0.0).then(|| Doubt {
            name: "backlash".into(),
            site,
            rel_std: ANYWHERE,
            which: Which::Gap(gap),
        })
    });
    let card = setup.material.law.card();
    let coefficients = card.coefficients.iter().zip(coefficients).enumerate();
    let coefficients = coefficients.filter_map(|(i, (card, rel_std))| {
        Some(Doubt {
            name: card.name.into(),
            site: "material".into(),
            rel_std: (*rel_std)?,
            which: Which::Coefficient(i),
        })
    });
    of_springs
        .chain(gaps)
        .chain(coefficients)
        .filter(|d| d.rel_std > 0.0)
        .collect()
}

impl Doubt {
    /// What would measure it: an imperative phrase.
    pub fn measured_by(&self) -> String {
        match self.which {
            Which::Spring(_) => {
                format!("load {} through two cycles (`ident stiffness`)", self.site)
            }
            Which::Gap(_) => format!(
                "load {} to and fro past zero (`ident stiffness`)",
                self.site
            ),
            Which::Damper(_) => "hit the robot at the pose of the cut (`ident damping`)".into(),
            Which::Coefficient(_) => "record the force of three cuts (`ident force`)".into(),
        }
    }

    /// Whether only a simulation says what it does to the part.
    fn asks_for_a_run(&self) -> bool {
        match self.which {
            Which::Gap(_) => false,
            Which::Spring(_) => self.rel_std > SMALL,
            Which::Damper(_) => self.rel_std > BOUNDED,
            Which::Coefficient(_) => true,
        }
    }

    /// The same job with this number one standard deviation larger.
    pub fn moved(&self, setup: &Setup) -> Setup {
        let mut setup = setup.clone();
        let factor = 1.0 + self.rel_std;
        match self.which {
            Which::Spring(i) => {
                if let Some((_, spring)) = setup.robot.springs_mut().nth(i) {
                    spring.stiffness *= factor;
                }
            }
            Which::Damper(i) => {
                if let Some((_, spring)) = setup.robot.springs_mut().nth(i) {
                    spring.damping *= factor;
                }
            }
            Which::Gap(_) => {}
            Which::Coefficient(i) => setup.material.coefficients[i] *= factor,
        }
        setup
    }
}

/// How much more coarsely the cut is resolved here, since only differences are asked. On the example's corrected part 2 gave 0.194 to
/// 0.234 mm where 1 gave 0.193 to 0.218; on a correction that left 0.214 mm, 1 gave 0.207 to 0.240 and 1.5 gave 0.210 to 0.458: which
/// swings a change sets going differs more than that.
const COARSER: f64 = 2.0;

/// A job milled as it is, and again with every doubt that asks for it moved by one standard deviation.
pub struct Moved<'a> {
    doubts: &'a [Doubt],
    /// As it is, then moved; none where nothing is doubted.
    runs: Vec<Milled>,
}

impl<'a> Moved<'a> {
    /// Mills them, side by side.
    ///
    /// # Errors
    /// As the runs.
    pub fn of(setup: &Setup, support: Support, doubts: &'a [Doubt]) -> Outcome<Self> {
        let asked = doubts.iter().filter(|doubt| doubt.asks_for_a_run());
        let base = doubts.first().map(|_| None);
        let all: Vec<Option<&Doubt>> = base.into_iter().chain(asked.map(Some)).collect();
        let quick = setup.coarser(COARSER);
        let run = |doubt: &Option<&Doubt>| {
            let moved = doubt.map(|doubt| doubt.moved(&quick));
            let (milled, _) = moved.as_ref().unwrap_or(&quick).run(support, |_| {})?;
            Ok(milled)
        };
        let runs: Vec<Outcome<Milled>> = all.par_iter().map(run).collect();
        Ok(Self {
            runs: runs.into_iter().collect::<Outcome<_>>()?,
            doubts,
        })
    }

    /// What is doubted.
    pub fn doubts(&self) -> &[Doubt] {
        self.doubts
    }

    /// Changes of the deviation at some times (s) by one standard deviation of each doubt: one list per
    /// doubt, m, workpiece frame.
    ///
    /// # Errors
    /// A pose that the robot cannot have.
    pub fn changes(&self, setup: &Setup, times: &[f64]) -> Outcome<Vec<Vec<V3>>> {
        let seen = |milled: &Milled| Seen {
            deviations: times.iter().map(|t| milled.deviation_at(*t)).collect(),
            forces: times.iter().map(|t| milled.force_at(*t)).collect(),
        };
        let mut runs = self.runs.iter().map(seen);
        let base = runs.next().unwrap_or_default();
        let change = |doubt: &Doubt| match doubt.which {
            _ if doubt.asks_for_a_run() => {
                let moved = runs.next().unwrap_or_default();
                let pairs = moved.deviations.iter().zip(&base.deviations);
                Ok(pairs.map(|(a, b)| sub(*a, *b)).collect())
            }
            Which::Gap(gap) => across(setup, &doubt.site, gap * doubt.rel_std, times),
            Which::Damper(_) => calmer(setup, doubt, &base, times),
            _ => stiffer(setup, doubt, &base, times),
        };
        self.doubts.iter().map(change).collect()
    }
}

/// A simulation at some times.
#[derive(Debug, Default)]
struct Seen {
    /// Deviation, m, workpiece frame.
    deviations: Vec<V3>,
    /// Force of the cut, N, workpiece frame.
    forces: Vec<V3>,
}

/// What a spring that is stiffer by its small doubt takes from the bend under force and weight, m: first order, the
/// force staying as it is.
fn stiffer(setup: &Setup, doubt: &Doubt, base: &Seen, times: &[f64]) -> Outcome<Vec<V3>> {
    let mut carrier = setup.carrier();
    let mut bent = |time: f64, force: V3| -> Outcome<V3> {
        let held = carrier.held(&setup.way.at(time).joints)?;
        let linear = &held.linear;
        let one = |i: usize| {
            let torque = dot(linear.tool[i], force) - held.weight[i];
            let turned = torque / linear.stiffness[i * linear.n + i];
            scale(turned, linear.tool[i])
        };
        let all = coordinates(linear, &doubt.site);
        Ok(all.map(one).fold([0.0; 3], add))
    };
    let calibrated = bent(setup.way.span()[0], [0.0; 3])?;
    let of = |(time, force): (&f64, &V3)| {
        let bend = sub(bent(*time, *force)?, calibrated);
        Ok(scale(-doubt.rel_std, bend))
    };
    times.iter().zip(&base.forces).map(of).collect()
}

/// The elastic coordinates of a site: a bearing tilts about two axes.
fn coordinates<'a>(linear: &'a Linear, site: &'a str) -> impl Iterator<Item = usize> + 'a {
    let named = linear.names.iter().enumerate();
    named.filter(move |(_, name)| *name == site).map(|(i, _)| i)
}

/// What a damper off by a small share changes at most, m: that share of what is not the bend of springs, as far as
/// the damper takes part in it.
fn calmer(setup: &Setup, doubt: &Doubt, base: &Seen, times: &[f64]) -> Outcome<Vec<V3>> {
    let (mut springs, mut carrier) = (setup.springs()?, setup.carrier());
    let of = |((time, force), deviation): ((&f64, &V3), &V3)| {
        let moment = setup.way.at(*time);
        let swing = sub(*deviation, springs.bent(&moment, *force)?);
        let linear = carrier.held(&moment.joints)?.linear;
        let part = taking_part(&linear, &doubt.site, swing);
        Ok(scale(doubt.rel_std * part, swing))
    };
    let forced = times.iter().zip(&base.forces);
    forced.zip(&base.deviations).map(of).collect()
}

/// Share of a site's dampers in the damping of a swing along a direction, the robot being bent as a force there
/// bends it.
fn taking_part(linear: &Linear, site: &str, along: V3) -> f64 {
    let taken = |i: usize| {
        let [stiffness, damping] =
            [&linear.stiffness, &linear.damping].map(|m| m[i * linear.n + i]);
        damping * (dot(linear.tool[i], along) / stiffness).powi(2)
    };
    let own: f64 = coordinates(linear, site).map(taken).sum();
    let all: f64 = (0..linear.n).map(taken).sum();
    own / all.max(f64::MIN_POSITIVE)
}

/// What an angle of one spring does to the tip at some times, m: the simulation is linear, and a gap lies
/// wherever friction leaves it.
fn across(setup: &Setup, site: &str, angle: f64, times: &[f64]) -> Outcome<Vec<V3>> {
    let mut carrier = setup.carrier();
    let moved = |time: &f64| {
        let linear = carrier.held(&setup.way.at(*time).joints)?.linear;
        let one = |i: usize| scale(angle, linear.tool[i]);
        Ok(coordinates(&linear, site).map(one).fold([0.0; 3], add))
    };
    times.iter().map(moved).collect()
}

/// Standard deviation of the length of `vector` at station `i`.
pub fn spread(changes: &[Vec<V3>], i: usize, vector: V3) -> f64 {
    let size = norm(vector);
    if size == 0.0 {
        return 0.0;
    }
    let along = scale(1.0 / size, vector);
    let squares = changes
        .iter()
        .map(|c| c.get(i).map_or(0.0, |v| dot(*v, along).powi(2)));
    squares.sum::<f64>().sqrt()
}
