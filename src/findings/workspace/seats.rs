//! Who may be blamed, where, and how readily.

use super::bound::Bound;
use super::patterns::{Pattern, Scene};
use super::strangers::{STRANGERS, is_stranger, modes};
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
    /// Logarithm of its share among the seats of its cause.
    pub share: f64,
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
    /// What bounds it.
    pub bound: Bound,
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
            let mut sites = cause.sites_at(scene.robot, scene.points.len());
            sites.retain(|site| was_measured(site, shapes));
            let ready = |site: &String| cause.readiness(scene.robot, site);
            let total: f64 = sites.iter().map(ready).sum();
            for site in sites {
                let share = (ready(&site) / total).ln();
                all.seat(cause, (site, share), scene, shapes);
            }
        }
        all
    }

    fn seat(
        &mut self,
        cause: &'static dyn Cause,
        (site, share): (String, f64),
        scene: &Scene,
        shapes: &Shapes,
    ) {
        let (seat, first) = (self.seats.len(), self.columns.len());
        let scales = cause.scale(scene.robot, &site);
        let measured = measured(shapes);
        let modes = modes(cause, scene.robot, &site, (scene.points, &measured));
        for (index, amount) in cause.card().amounts.iter().enumerate() {
            let scale = scales[index].abs().max(1e-12);
            let mut pattern = scene.pattern(cause, &site, (index, scale), shapes);
            if let Some(modes) = &modes {
                let at = |p: usize| {
                    measured
                        .binary_search(&p)
                        .map_or(0.0, |row| modes[(row, index)])
                };
                pattern.scale_points(at);
            }
            self.columns.push(Column {
                pattern,
                prior: SPREAD * scale,
                bound: match cause.matrix_of(index) {
                    Some((own, place)) => Bound::Of(first + own, place),
                    None => Bound::Low(amount.bounds[0]),
                },
                instrument: cause.blame() == Blame::Instrument,
                stranger: is_stranger(cause),
            });
        }
        let (forms, shares) = (cause.forms(), cause.shares());
        let total = WIDTHS.len() as f64 * shares.iter().sum::<f64>();
        for width in WIDTHS {
            let each = forms.iter().zip(&shares);
            self.forms.extend(each.map(|(form, share)| Form {
                seat,
                columns: form.iter().map(|k| first + k).collect(),
                weight: (share / total).ln(),
                width,
            }));
        }
        self.seats.push(Seat {
            stranger: is_stranger(cause),
            cause,
            site,
            first,
            share,
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

    /// Takes the patterns of the gaps anew, with the weights that `tuned` finds for a column.
    pub fn weigh_again(&mut self, tuned: impl Fn(&Seat, (usize, f64)) -> Option<(Pattern, f64)>) {
        for at in 0..self.seats.len() {
            let own = self.seats[at].clone();
            for index in 0..own.cause.card().amounts.len() {
                let column = own.first + index;
                if self.columns[column].pattern.left.is_empty() {
                    continue;
                }
                let step = (index, self.columns[column].prior / SPREAD);
                if let Some((pattern, price)) = tuned(&own, step) {
                    self.columns[column].pattern = pattern;
                    let bent = |f: &&mut Form| f.columns.contains(&column);
                    self.forms
                        .iter_mut()
                        .filter(bent)
                        .for_each(|f| f.weight -= price);
                }
            }
        }
    }

    /// Logarithm of the odds of these seats before the data: instruments and parameters before structure,
    /// kind by kind, and one part forgotten makes another of its kind likely.
    pub fn odds(&self, seats: &[usize]) -> f64 {
        let mut total = 0.0;
        let bare = self.rigid_bearings;
        for (at, seat) in seats.iter().enumerate() {
            let own = &self.seats[*seat];
            let name = own.cause.card().name;
            let again = |s: &usize| self.seats[*s].cause.card().name == name;
            let again = own.cause.blame() == Blame::Structure && seats[..at].iter().any(again);
            let first = odds(own.cause.blame(), own.stranger) + own.share;
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

/// Points that were loaded, ascending.
fn measured(shapes: &Shapes) -> Vec<usize> {
    let mut points: Vec<usize> = shapes.setups.iter().map(|s| s.point).collect();
    points.sort_unstable();
    points.dedup();
    points
}

/// Whether a site is none of the points, or one that was loaded: nobody else can be blamed, and columns
/// do not grow with points that were left out.
fn was_measured(site: &str, shapes: &Shapes) -> bool {
    let number = site
        .strip_prefix("point")
        .and_then(|n| n.parse::<usize>().ok());
    number.is_none_or(|n| shapes.setups.iter().any(|s| s.point + 1 == n))
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
        (_, Blame::Instrument) => -2.4,
        (_, Blame::Parameter) => -2.4,
        (_, Blame::Structure) => -3.0,
    }
}
