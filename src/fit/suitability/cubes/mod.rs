//! The gate for measuring cubes.

mod copied;
mod few;
mod reversed;
mod scale;
mod unloaded;
mod unrelated;

use super::channel::{self, Channel};
use super::{Doubt, Said};
use crate::experiments::cubes::Setup;
use crate::measurement::cubes::CubeTest;
use crate::robot::Robot;

/// Names of what a cube shows.
const COMPONENTS: [&str; 6] = ["dx", "dy", "dz", "rx", "ry", "rz"];

/// What the rules look at: the readings beside what the present simulation says of them.
pub struct Loaded<'a> {
    /// The test.
    pub test: &'a CubeTest,
    /// The six components; what drives each is the simulated one.
    pub channels: Vec<Channel>,
}

/// One rule of this kind.
pub type Rule = super::Rule<for<'a, 'b> fn(&'b Loaded<'a>) -> Said>;

/// Every rule, in the order in which its findings are said.
pub const RULES: &[Rule] = &[
    unloaded::RULE,
    channel::dead_rule(|on| channel::dead(&on.channels)),
    channel::wild_rule(|on| channel::wild(&on.channels)),
    channel::clipped_rule(|on| channel::clipped(&on.channels)),
    reversed::RULE,
    unrelated::RULE,
    scale::RULE,
    copied::RULE,
    few::RULE,
];

/// What is odd about a test, the gravest first; none for a robot that does not fit it.
pub fn doubts(test: &CubeTest, robot: &Robot) -> Vec<Doubt> {
    let Ok(setup) = Setup::new(test, robot) else {
        return Vec::new();
    };
    let simulated = simulated(test, &setup);
    let channel = |(k, name): (usize, &&str)| {
        let values = test.readings.iter().map(|r| r.moved[k]).collect();
        Channel::new(*name, values, simulated.iter().map(|m| m[k]).collect())
    };
    let loaded = Loaded {
        test,
        channels: COMPONENTS.iter().enumerate().map(channel).collect(),
    };
    super::doubts(RULES, |look| look(&loaded))
}

fn simulated(test: &CubeTest, setup: &Setup) -> Vec<[f64; 6]> {
    let compliances: Vec<f64> = setup.sites.iter().map(|site| site.compliance).collect();
    let mut last = None;
    let mut of = |reading: &crate::measurement::cubes::Reading| {
        let key = (reading.force, reading.moment);
        if last.as_ref().is_none_or(|(known, _)| *known != key) {
            last = Some((key, setup.bent(reading, &compliances)));
        }
        let bent = last
            .as_ref()
            .map(|(_, bent)| setup.moved(bent, reading.cube));
        bent.unwrap_or([0.0; 6])
    };
    test.readings.iter().map(&mut of).collect()
}

/// What a component shows of the simulation.
struct Beside<'a> {
    name: &'a str,
    /// Measured over simulated, and its standard error.
    ratio: f64,
    stderr: f64,
    /// Cosine between measured and simulated.
    alike: f64,
    /// Root mean squares, measured and simulated.
    measured: f64,
    simulated: f64,
}

impl Loaded<'_> {
    /// The components of which the simulation expects enough to judge them by.
    fn beside(&self) -> Vec<Beside<'_>> {
        let all: Vec<Beside> = self.channels.iter().filter_map(beside).collect();
        let largest = |from: usize| {
            let own = COMPONENTS[from..from + 3].to_vec();
            let of = all.iter().filter(move |b| own.contains(&b.name));
            of.map(|b| b.simulated).fold(0.0, f64::max)
        };
        let largest = [largest(0), largest(3)];
        let moves = |b: &Beside| {
            let kind = usize::from(b.name.starts_with('r'));
            b.simulated > SMALL * largest[kind]
        };
        all.into_iter().filter(|b| moves(b)).collect()
    }
}

/// Share of the largest component below which one is not judged.
const SMALL: f64 = 0.2;
/// Readings that a comparison needs.
const FEWEST: usize = 6;

fn beside(channel: &Channel) -> Option<Beside<'_>> {
    let pairs = channel.values.iter().zip(&channel.drive);
    let pairs: Vec<(f64, f64)> = pairs
        .filter(|(m, _)| m.is_finite())
        .map(|(m, s)| (*m, *s))
        .collect();
    let sum = |of: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>();
    let (mm, ms, ss) = (
        sum(&|p| p.0 * p.0),
        sum(&|p| p.0 * p.1),
        sum(&|p| p.1 * p.1),
    );
    let n = pairs.len() as f64;
    let whole = pairs.len() >= FEWEST && mm > 0.0 && ss > 0.0 && mm.is_finite();
    whole.then(|| Beside {
        name: &channel.name,
        ratio: ms / ss,
        stderr: ((mm - ms * ms / ss).max(0.0) / (n - 1.0) / ss).sqrt(),
        alike: ms / (mm * ss).sqrt(),
        measured: (mm / n).sqrt(),
        simulated: (ss / n).sqrt(),
    })
}
