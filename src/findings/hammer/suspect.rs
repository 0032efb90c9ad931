//! A cause at a place of one robot, its amounts counted in spreads.

use crate::causes::{self, Amount, Cause, Sight};
use crate::effects::Family;
use crate::findings::belief::Place;
use crate::ground::stats::largest;
use crate::robot::Robot;

/// Where an amount that cannot be negative starts to exist, in spreads.
const LEAST: f64 = 1e-3;

/// A cause at a place.
#[derive(Clone)]
pub struct Suspect {
    /// The cause.
    pub cause: &'static dyn Cause,
    /// Its site.
    pub site: String,
}

impl Suspect {
    /// Its name.
    pub fn name(&self) -> &'static str {
        self.cause.card().name
    }

    /// The amounts that a hammer test can tell.
    fn amounts(&self) -> &'static [Amount] {
        &self.cause.card().amounts[..self.cause.heard()]
    }

    /// Spread of each amount: the prior's standard deviation, as far as its starts reach.
    pub fn spreads(&self) -> Vec<f64> {
        let amounts = self.amounts().iter();
        amounts.map(|a| largest(a.starts)).collect()
    }

    /// Bounds of each amount, in spreads.
    pub fn bounds(&self) -> Vec<[f64; 2]> {
        let amounts = self.amounts().iter().zip(self.spreads());
        amounts
            .map(|(a, spread)| {
                let [low, high] = a.bounds.map(|b| b / spread);
                [if low == 0.0 { LEAST } else { low }, high]
            })
            .collect()
    }

    /// Where to start, in spreads: the first of every amount, the second of every amount, ...
    pub fn starts(&self) -> Vec<Vec<f64>> {
        let amounts = self.amounts();
        let count = amounts.iter().map(|a| a.starts.len()).max().unwrap_or(0);
        let at = |j: usize| {
            let each = amounts.iter().zip(self.spreads());
            each.map(|(a, spread)| a.starts[j.min(a.starts.len() - 1)] / spread)
                .collect()
        };
        (0..count).map(at).collect()
    }

    /// Cause and site.
    pub fn place(&self) -> Place {
        (self.name(), self.site.clone())
    }

    /// Whether it changes the robot.
    pub fn is_physical(&self) -> bool {
        self.cause.card().family == Family::Physics
    }
}

/// Every cause at every place of this robot that a hammer test with these outputs would show.
pub fn suspects(robot: &Robot, outputs: &[String]) -> Vec<Suspect> {
    let all = causes::seen_by(Sight::Hammer).filter(|c| !c.card().amounts.is_empty());
    let places = all.flat_map(|cause| {
        let sites = cause.sites(robot).into_iter();
        sites.map(move |site| Suspect { cause, site })
    });
    let measured = |s: &Suspect| match s.site.strip_prefix("sensor-") {
        Some(axis) => outputs.len() > 1 && outputs.iter().any(|o| o == axis),
        None => true,
    };
    places.filter(measured).collect()
}

/// Whether two suspects are one.
pub fn same(a: &Suspect, b: &Suspect) -> bool {
    a.name() == b.name() && a.site == b.site
}
