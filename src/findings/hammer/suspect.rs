//! A cause at a place of one robot, its amounts counted in spreads.

use crate::causes::turns::{SIX, not_below};
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
    /// Which of the places that its amounts are for: those of one place are [`Cause::heard`] together.
    pub place: usize,
    /// How many of the amounts of its place act.
    pub heard: usize,
}

impl Suspect {
    /// Its name.
    pub fn name(&self) -> &'static str {
        self.cause.card().name
    }

    /// The amounts that a hammer test can tell.
    fn amounts(&self) -> &'static [Amount] {
        &self.cause.card().amounts[self.before()..][..self.heard]
    }

    /// Amounts of the cause before those that it uses.
    fn before(&self) -> usize {
        self.place * self.cause.heard()
    }

    /// All amounts of the cause, SI, where those of its place are `own` spreads.
    pub fn whole(&self, own: &[f64]) -> Vec<f64> {
        let own = own.iter().zip(self.spreads()).map(|(a, s)| a * s);
        std::iter::repeat_n(0.0, self.before()).chain(own).collect()
    }

    /// Logarithm of how many forms and places it was chosen among.
    pub fn choices(&self) -> f64 {
        let count = self.cause.card().amounts.len();
        let places = count / self.cause.heard().max(1);
        let forms = forms(self.cause, &self.site).len();
        ((places * forms) as f64).ln()
    }

    /// The same cause at the other places that it may have at its site.
    pub fn elsewhere(&self) -> impl Iterator<Item = Self> {
        let places = self.cause.card().amounts.len() / self.cause.heard().max(1);
        let others = (0..places).filter(|place| *place != self.place);
        others.map(|place| Self {
            place,
            ..self.clone()
        })
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
            let each = amounts.iter().zip(self.spreads()).enumerate();
            each.map(|(k, (a, spread))| match self.cause.is_shared(k) {
                true => 0.0,
                false => a.starts[j.min(a.starts.len() - 1)] / spread,
            })
            .collect()
        };
        (0..count).map(at).collect()
    }

    /// Brings amounts (spreads) to what can be: every matrix gives way everywhere, if ever so little, so that the
    /// coordinates stay the same.
    pub fn possible(&self, amounts: &mut [f64]) {
        let spreads = self.spreads();
        let whole = |first: &usize| first + SIX <= spreads.len();
        for first in self.cause.matrices().into_iter().filter(whole) {
            let (own, spreads) = (&mut amounts[first..first + SIX], &spreads[first..]);
            own.iter_mut().zip(spreads).for_each(|(a, s)| *a *= s);
            not_below(own, LEAST * spreads[0]);
            own.iter_mut().zip(spreads).for_each(|(a, s)| *a /= s);
        }
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
        sites.flat_map(move |site| forms(cause, &site))
    });
    let measured = |s: &Suspect| match s.site.strip_prefix("sensor-") {
        Some(axis) => outputs.len() > 1 && outputs.iter().any(|o| o == axis),
        None => true,
    };
    places.filter(measured).collect()
}

/// The narrow form of a cause whose amounts are matrices, their axes those of the frame, and the whole.
fn forms(cause: &'static dyn Cause, site: &str) -> Vec<Suspect> {
    let form = |heard| Suspect {
        cause,
        site: site.to_string(),
        place: 0,
        heard,
    };
    let mut heard = vec![cause.straight(), cause.heard()];
    heard.dedup();
    heard.into_iter().map(form).collect()
}

/// Whether two suspects are one.
pub fn same(a: &Suspect, b: &Suspect) -> bool {
    a.name() == b.name() && a.site == b.site
}
