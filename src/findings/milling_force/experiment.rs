//! The statement of a milling-force file for the engine.

use super::aim::Loose;
use super::arrived::BENT;
use super::noise::Coloured;
use super::patterns::PATTERNS;
use super::{Case, EFFECTS, runout};
use crate::cutting::wave::Side;
use crate::experiments::milling_force::RUNOUT;
use crate::findings::engine::{
    Arrival, Aspects, Blamed, Experiment, Noise, Nuisance, Peers, Remaining, Statement, White,
};
use crate::findings::table;
use crate::fit::cut_force::{BANDWIDTH_STD, BORDER_SHARE};
use crate::ground::stats::rms;
use crate::sheet::number::fixed;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// Relative spread of a spindle speed that is as stated: inverters hold synchronous motors closer, and asynchronous ones that slip by more
/// are not as stated. A choice; at 5e-4 one part in a thousand in two to four cuts was no cause (files by strangers).
const SPEED: f64 = 2e-4;
/// Spread of a width that is as stated, m.
pub(super) const WIDTH_SPREAD: f64 = 2e-5;
/// Spread of a depth that is as stated, m: tools are set to the stock by paper or a probe. A choice.
pub(super) const DEPTH_SPREAD: f64 = 2e-5;
/// Share of a stated runout by which its tip may stand aside: nobody states where it points. A choice.
const RUNOUT_TURN: f64 = 0.8;
/// Orders of the spindle in which structure is looked for.
const ORDERS: usize = 8;
/// Cuts whose structure is looked for apart.
const APART: usize = 3;
/// Places of a turn at which forces are one pattern, and the fewest samples of one: a choice, no other values were tried.
const PLACES: usize = 72;
const IN_A_PLACE: usize = 4;

impl Experiment for Case {
    fn unit(&self) -> &'static str {
        "N"
    }

    fn is_linear(&self) -> bool {
        false
    }

    // a runout and a chipped tooth, which with two teeth are nearly one, and a gain and a cross-talk; all rivals would take twice the time
    fn peers(&self) -> Peers {
        Peers::Kin
    }

    fn state(&self, about: &[Blamed]) -> Statement {
        match about {
            [] => Statement {
                suspects: [
                    table::suspects(EFFECTS, self),
                    table::patterns(PATTERNS, self),
                ]
                .concat(),
                ..self.statement_beside(&[])
            },
            _ => super::anew::about(self, about, |_| true),
        }
    }

    fn state_among(
        &self,
        about: &[Blamed],
        _uncertain: &[f64],
        names: &[(&'static str, String)],
    ) -> Statement {
        super::anew::about(self, about, |effect| names.iter().any(|n| n.0 == effect))
    }

    /// A chord to what is no straight line may be a quarter off (widths of cuts by a stranger), unless it arrives; of runouts the two-toothed.
    fn has_sure_intervals(&self, effect: &str) -> bool {
        !BENT.contains(&effect) || effect == runout::EFFECT.name && self.places().teeth > 2
    }

    fn arrived(&self, found: &[Blamed]) -> Vec<Arrival> {
        super::arrived::arrived(self, found)
    }

    fn parameters(&self, blamed: &Blamed) -> Vec<(&'static str, f64, &'static str)> {
        table::parameters(EFFECTS, self, blamed)
    }

    fn would_tell(&self, rivals: &[(&'static str, String)]) -> String {
        table::would_tell(EFFECTS, rivals)
    }

    fn place(&self, missed: &[f64]) -> String {
        let size = |c: usize| {
            let cut = &self.cuts()[c];
            let own = &missed[3 * cut.first..3 * (cut.first + cut.time.len())];
            rms(own)
        };
        let worst = (0..self.cuts().len()).max_by(|a, b| size(*a).total_cmp(&size(*b)));
        let cut = worst.unwrap_or(0);
        format!("largest in cut {} ({} N rms)", cut + 1, fixed(size(cut), 2))
    }

    fn remaining(&self, left: &[f64]) -> Remaining {
        let mut sums = vec![(0.0, 0.0); PLACES];
        let mut over_time = Vec::new();
        for cut in self.cuts() {
            let angles = cut.present.scene.angles(&cut.present.p);
            for (i, angle) in angles.iter().enumerate() {
                let row = 3 * (cut.first + i);
                let size =
                    (left[row].powi(2) + left[row + 1].powi(2) + left[row + 2].powi(2)).sqrt();
                let place = (angle.rem_euclid(TAU) / TAU * PLACES as f64) as usize % PLACES;
                sums[place].0 += size;
                sums[place].1 += 1.0;
                if i % 8 == 0 {
                    over_time.push([cut.time[i], size]);
                }
            }
        }
        let shape = sums.iter().enumerate().filter(|(_, s)| s.1 > 0.0);
        Remaining {
            shape: shape
                .map(|(i, s)| [(i as f64 + 0.5) * 360.0 / PLACES as f64, s.0 / s.1])
                .collect(),
            over_time,
            description: "a force over the turn of the spindle that no known effect makes (size over degrees)".into(),
        }
    }
}

impl Case {
    /// Rms of the simulated forces, N.
    pub fn force_rms(&self) -> f64 {
        rms(&self.column(|c, i, k| self.simulated(c, i)[k]))
    }

    /// The statement without anybody to blame, beside causes that were found.
    pub(super) fn statement_beside(&self, found: &[Blamed]) -> Statement {
        Statement {
            reading: self.reading(),
            noise: self.noise_of_rows(),
            nuisances: self.nuisances(found),
            suspects: Vec::new(),
            span: self.span(),
            splits: self.splits(),
            aspects: self.aspects(),
        }
    }

    /// The noise of the readings.
    pub(super) fn noise_of_rows(&self) -> Box<dyn Noise> {
        let (spread, rows) = (self.spread(), self.worth());
        match self.filter() {
            Some(filter) => Box::new(Coloured {
                filter,
                spread,
                rows,
            }),
            None => Box::new(White { spread, rows }),
        }
    }

    fn nuisances(&self, found: &[Blamed]) -> Vec<Nuisance> {
        let column = |l: &Loose| self.along(&l.direction(self.places()));
        let loose = self.loose_beside(found).into_iter();
        loose
            .map(|l| Nuisance {
                column: column(&l),
                spread: l.spread,
            })
            .collect()
    }

    /// What is uncertain beside causes that were found: where nobody states a runout, one that was found is all there is.
    pub(super) fn loose_beside(&self, found: &[Blamed]) -> Vec<Loose> {
        let is_all = runout::is_all(self, found);
        let is_free = |l: &Loose| !(is_all && runout::is_its(l));
        self.loose().into_iter().filter(is_free).collect()
    }

    /// The angle of tooth 1 of every cut, and what is stated only so well.
    pub(super) fn loose(&self) -> Vec<Loose> {
        let places = self.places();
        let loose = Loose::place;
        let mut all: Vec<Loose> = (0..6)
            .map(|j| loose(j, self.coefficient_spread(j)))
            .collect();
        for (c, cut) in self.cuts().iter().enumerate() {
            all.push(loose(places.phase(c), self.turn(c)));
            all.push(loose(places.speed(c), SPEED));
            all.push(loose(places.depth(c), DEPTH_SPREAD));
            if cut.present.scene.cut.side != Side::Slot {
                all.push(loose(places.width(c), WIDTH_SPREAD));
            }
        }
        all.push(loose(places.bandwidth(), BANDWIDTH_STD));
        all.push(loose(places.border(), BORDER_SHARE[1]));
        match self.file().facts.runout_m {
            _ if places.teeth < 2 => {}
            Some(stated) => all.extend(self.loose_runout(stated)),
            // nobody says anything of what every tool has
            None => {
                let each = runout::EVERYBODYS * runout::UNIT * FRAC_1_SQRT_2;
                all.extend([RUNOUT, RUNOUT + 1].map(|at| loose(at, each)));
            }
        }
        let shows = |l: &Loose| self.along(&l.direction(places)).iter().any(|x| *x != 0.0);
        all.retain(|l| l.spread > 0.0 && shows(l));
        all
    }

    /// A runout is stated by its size: its direction is what the fit of everything made of it.
    fn loose_runout(&self, stated: f64) -> [Loose; 2] {
        let [x, y] = self.runout();
        let size = x.hypot(y);
        let [x, y] = match size > 0.0 {
            true => [x / size, y / size],
            false => [1.0, 0.0],
        };
        let towards = |x: f64, y: f64, spread: f64| Loose {
            along: vec![(RUNOUT, x), (RUNOUT + 1, y)],
            spread,
        };
        [
            towards(x, y, runout::spread(stated)),
            towards(-y, x, (RUNOUT_TURN * stated).max(runout::spread(stated))),
        ]
    }

    fn coefficient_spread(&self, j: usize) -> f64 {
        match &self.file().facts.nominal {
            Some(stated) => stated.rel_std * self.nominal()[j].abs(),
            None => f64::INFINITY,
        }
    }

    /// Any wave over the turn of the spindle, by axis and cut, and waves over the time.
    fn span(&self) -> Vec<Vec<f64>> {
        let angles: Vec<Vec<f64>> = self
            .cuts()
            .iter()
            .map(|cut| cut.present.scene.angles(&cut.present.p))
            .collect();
        let apart = self.cuts().len().min(APART);
        let mut span = Vec::new();
        for axis in 0..3 {
            for group in 0..apart {
                for order in 1..=ORDERS {
                    for quarter in [0.0, 0.25] {
                        let turn = |c: usize, i: usize| order as f64 * angles[c][i] - TAU * quarter;
                        span.push(
                            self.column(|c, i, k| match k == axis && c % apart == group {
                                true => turn(c, i).cos() / (order as f64).sqrt(),
                                false => 0.0,
                            }),
                        );
                    }
                }
            }
            for wave in 0..4 {
                let phase = std::f64::consts::PI * wave as f64;
                span.push(self.column(|c, i, k| match k == axis {
                    true => (phase * self.progress(c, i)).cos(),
                    false => 0.0,
                }));
            }
        }
        span
    }

    /// The level of a cut, its wave over the turn of the spindle, and what changes from turn to turn.
    fn aspects(&self) -> Aspects {
        let cuts = self.cuts();
        let angles = cuts
            .iter()
            .map(|cut| cut.present.scene.angles(&cut.present.p));
        let angles: Vec<Vec<f64>> = angles.collect();
        let places = |c: usize| (cuts[c].time.len() / IN_A_PLACE).clamp(1, PLACES);
        let place = |c: usize, i: usize| {
            let turn = angles[c][i].rem_euclid(TAU) / TAU;
            (turn * places(c) as f64) as usize % places(c)
        };
        let level = |c: usize, k: usize| 3 * c + k;
        Aspects {
            groups: vec![
                self.groups(|c, _, k| level(c, k)),
                self.groups(|c, i, k| level(c, k) * PLACES + place(c, i)),
            ],
        }
    }

    /// The group of every row, from cut, sample and axis.
    fn groups(&self, of: impl Fn(usize, usize, usize) -> usize) -> Vec<usize> {
        let all = self.column(|c, i, k| of(c, i, k) as f64);
        all.into_iter().map(|group| group as usize).collect()
    }

    /// Whole cuts, whole pieces of their revolutions, then samples here and there.
    fn splits(&self) -> Vec<Vec<usize>> {
        let turns = |c: usize, i: usize| {
            let cut = &self.cuts()[c].present.scene;
            (cut.cut.spindle_rad_s * cut.time[i] / TAU * 2.0) as usize
        };
        let by_cut = self.groups(|c, _, _| c % 8);
        let by_turn = self.groups(|c, i, _| (c + turns(c, i)) % 8);
        let spread = self.groups(|c, i, _| (c + i / 5) % 8);
        match self.cuts().len() {
            0..3 => vec![by_turn, spread],
            _ => vec![by_cut, by_turn, spread],
        }
    }
}
