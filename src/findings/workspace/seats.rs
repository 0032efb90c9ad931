//! Who may be blamed, where, and how readily.

use super::patterns::{Pattern, Scene};
use super::strangers::{STRANGERS, is_stranger};
use crate::causes::contract::{Blame, Cause, Sight};
use crate::causes::seen_by;
use crate::findings::belief::Place;
use crate::fit::force_shapes::Shapes;

/// A cause at a site.
#[derive(Clone)]
pub struct Seat {
    /// The cause.
    pub cause: &'static dyn Cause,
    /// Where it sits.
    pub site: String,
    /// No cause of the library.
    pub stranger: bool,
    /// Column of its first amount; the others follow.
    pub first: usize,
}

impl Seat {
    /// Cause and site.
    pub fn place(&self) -> Place {
        (self.cause.card().name, self.site.clone())
    }
}

/// One form in which a seat may act.
#[derive(Debug, Clone, PartialEq)]
pub struct Form {
    /// Index of the seat.
    pub seat: usize,
    /// Its columns.
    pub columns: Vec<usize>,
    /// Logarithm of its share among the forms of the seat.
    pub weight: f64,
    /// Its strength: spreads of the amounts before the data, times this.
    pub width: f64,
}

/// One amount at its place.
#[derive(Debug, Clone)]
pub struct Column {
    /// What a unit of it does.
    pub pattern: Pattern,
    /// Standard deviation before the data.
    pub prior: f64,
    /// Lowest value.
    pub low: f64,
    /// Of an instrument.
    pub instrument: bool,
    /// Of no cause of the library.
    pub stranger: bool,
}

/// Everybody who may be blamed.
#[derive(Clone)]
pub struct Seats {
    /// The seats.
    pub seats: Vec<Seat>,
    /// Their forms.
    pub forms: Vec<Form>,
    /// The amounts of all seats.
    pub columns: Vec<Column>,
    /// Whether no bearing of the model tilts.
    rigid_bearings: bool,
}

/// A cause may be strong or weak: each form is compared in both.
const WIDTHS: [f64; 2] = [1.0, 0.2];
/// An amount spreads over this many ordinary sizes before the data.
const SPREAD: f64 = 1.5;

impl Seats {
    /// All causes that a workspace test would show, and the strangers.
    pub fn of(scene: &Scene, shapes: &Shapes) -> Self {
        let mut all = Self {
            seats: Vec::new(),
            forms: Vec::new(),
            columns: Vec::new(),
            rigid_bearings: scene.robot.joints.iter().all(|j| j.tilt.is_none()),
        };
        let library = seen_by(Sight::Workspace);
        for cause in library.chain(STRANGERS.iter().copied()) {
            for site in cause.sites_at(scene.robot, scene.points.len()) {
                all.seat(cause, site, scene, shapes);
            }
        }
        all
    }

    fn seat(&mut self, cause: &'static dyn Cause, site: String, scene: &Scene, shapes: &Shapes) {
        let (seat, first) = (self.seats.len(), self.columns.len());
        let scales = cause.scale(scene.robot, &site);
        for (index, amount) in cause.card().amounts.iter().enumerate() {
            let scale = scales[index].abs().max(1e-12);
            self.columns.push(Column {
                pattern: scene.pattern(cause, &site, (index, scale), shapes),
                prior: SPREAD * scale,
                low: amount.bounds[0],
                instrument: cause.blame() == Blame::Instrument,
                stranger: is_stranger(cause),
            });
        }
        let forms = cause.forms();
        let weight = -((forms.len() * WIDTHS.len()) as f64).ln();
        for width in WIDTHS {
            self.forms.extend(forms.iter().map(|form| Form {
                seat,
                columns: form.iter().map(|k| first + k).collect(),
                weight,
                width,
            }));
        }
        self.seats.push(Seat {
            stranger: is_stranger(cause),
            cause,
            site,
            first,
        });
    }

    /// Takes the patterns of the instruments anew, about another reference.
    pub fn read_again(&mut self, scene: &Scene, shapes: &Shapes) {
        for seat in &self.seats {
            if seat.cause.blame() != Blame::Instrument {
                continue;
            }
            for index in 0..seat.cause.card().amounts.len() {
                let column = &mut self.columns[seat.first + index];
                let step = (index, column.prior / SPREAD);
                column.pattern = scene.pattern(seat.cause, &seat.site, step, shapes);
            }
        }
    }

    /// Logarithm of the odds of these seats before the data: instruments before parameters before
    /// structure, and one part forgotten makes another of its kind likely.
    pub fn odds(&self, seats: &[usize]) -> f64 {
        let mut total = 0.0;
        let bare = self.rigid_bearings;
        for (at, seat) in seats.iter().enumerate() {
            let own = &self.seats[*seat];
            let name = own.cause.card().name;
            let again = |s: &usize| self.seats[*s].cause.card().name == name;
            let again = own.cause.blame() == Blame::Structure && seats[..at].iter().any(again);
            let places = self.seats.iter().filter(|s| s.cause.card().name == name);
            let first = odds(own.cause.blame(), own.stranger) - (places.count() as f64).ln();
            total += match (bare && name == "missing_tilt", again) {
                (true, false) => SUSPECT - 6.0_f64.ln(),
                (true, true) => LIKELY,
                (false, true) => AGAIN.max(first),
                (false, false) if faulty(own, &seats[..at], &self.seats) => first + SHARED,
                (false, false) if name == "sensor_gain" && own.site == "sensor" => first + SHARED,
                (false, false) => first,
            };
        }
        total
    }
}

const AGAIN: f64 = -2.5;
/// A model in which no bearing tilts at all most likely lacks more than one.
const LIKELY: f64 = -1.5;
/// ... and is suspect from the start.
const SUSPECT: f64 = -1.5;
/// Several sensors hardly ever share an error that one load cell explains.
const SHARED: f64 = -2.0;

/// Whether one point is blamed where another one is already: few set-ups slip.
fn faulty(seat: &Seat, others: &[usize], all: &[Seat]) -> bool {
    let name = seat.cause.card().name;
    let same = |s: &usize| all[*s].cause.card().name == name;
    seat.site.starts_with("point") && others.iter().any(same)
}

/// Logarithm of the odds of a kind of cause, wherever it sits.
fn odds(blame: Blame, stranger: bool) -> f64 {
    match (stranger, blame) {
        (true, _) => -4.6,
        (_, Blame::Instrument) => -2.6,
        (_, Blame::Parameter) => -2.8,
        (_, Blame::Structure) => -3.4,
    }
}
