//! The statement of a milled part for the engine.

use super::noise::{Uneven, is_scatter};
use super::patterns::PATTERNS;
use super::uncertain::{Known, missed, uncertain};
use super::{Case, EFFECTS, Stated};
use crate::findings::engine::{
    ALLOWED, Alone, Blamed, Experiment, Nuisance, Peers, Remaining, Statement, Suspect, unblamed,
};
use crate::findings::physics;
use crate::findings::table;
use crate::ground::stats::{farthest, largest, rms};

/// Readings that a stated noise is worth.
const WORTH: f64 = 60.0;
/// Waves of what nobody knows, over the path and over the time.
const WAVES: [usize; 2] = [10, 5];
/// Stretches of the path that are held out, one after the other.
const STRETCHES: usize = 8;

impl Experiment for Case {
    fn unit(&self) -> &'static str {
        "m"
    }

    fn is_linear(&self) -> bool {
        false
    }

    fn peers(&self) -> Peers {
        Peers::Near
    }

    fn state(&self, about: &[Blamed]) -> Statement {
        self.state_beside(about, &[])
    }

    fn state_beside(&self, about: &[Blamed], uncertain: &[f64]) -> Statement {
        let nuisances = self.uncertain_about(about, uncertain);
        let again = self.again(about, uncertain, &nuisances);
        let (about, nuisances, again) = match again {
            Some(again) => (about, nuisances, again),
            None => (&[][..], self.uncertain_about(&[], &[]), self.as_it_is()),
        };
        let missed = self.missed.iter().zip(&again.beyond);
        Statement {
            reading: missed.map(|(missed, beyond)| missed - beyond).collect(),
            nuisances: self.with_laws_of(nuisances, &again.simulated),
            suspects: self.suspects_about(about),
            span: self.span(),
            splits: self.splits(),
            ..self.bare()
        }
    }

    fn is_scatter(&self, left: &[f64]) -> bool {
        let along = |wall: bool| {
            let rows = (0..left.len()).filter(|i| self.rows[*i].left == wall);
            rows.map(|i| left[i] / self.spread[i]).collect::<Vec<f64>>()
        };
        is_scatter(&[along(true), along(false)])
    }

    fn is_settled(&self, before: &Statement, after: &Statement) -> bool {
        after.reads_as(before) && after.nuisances == before.nuisances
    }

    /// Of 16 on parts by a stranger 11 held it: what is told of two causes is mostly half of it, and takes the part of the other.
    fn has_sure_intervals(&self, _effect: &str) -> bool {
        false
    }

    fn parameters(&self, blamed: &Blamed) -> Vec<(&'static str, f64, &'static str)> {
        match blamed.shape.first() {
            Some(form) if *form >= 0.0 => physics::parameters(self, blamed).unwrap_or_default(),
            _ => table::parameters(EFFECTS, self, blamed),
        }
    }

    fn would_tell(&self, rivals: &[(&'static str, String)]) -> String {
        table::would_tell_or(
            EFFECTS,
            rivals,
            "mill with the tool turned to another orientation, or load the axes one by one (`ident stiffness`)",
        )
    }

    fn place(&self, missed: &[f64]) -> String {
        let worst = farthest(missed);
        worst.map_or("nowhere".into(), |i| {
            let station = &self.stations[self.rows[i].station];
            format!("largest at {:.1} mm of the path", 1e3 * station.s_m)
        })
    }

    fn remaining(&self, left: &[f64]) -> Remaining {
        let along = self.rows.iter().zip(left);
        let over_time = self.rows.iter().zip(left);
        Remaining {
            shape: along
                .map(|(row, l)| [1e3 * self.stations[row.station].s_m, *l])
                .collect(),
            over_time: over_time
                .map(|(row, l)| [self.stations[row.station].time_s, *l])
                .collect(),
            description:
                "a deviation that no known effect makes (over the arc length of the path in mm)"
                    .into(),
        }
    }
}

/// Nats and share of what is missed that a cause must take to be tried at other strengths. Choices for time, no measurement.
const CHANCE: f64 = 4.0;
const SHARE: f64 = 0.01;

impl Case {
    /// What is missed, and nobody to blame.
    pub(super) fn bare(&self) -> Statement {
        let stated = self.test.facts.probe_noise.is_some();
        let noise = Uneven {
            spread: self.spread.clone(),
            rows: if stated { WORTH } else { 0.0 },
        };
        Statement::bare(self.missed.clone(), Box::new(noise))
    }

    /// Whether what is missed may hold something of a column, datum and coefficients being free: a share of it, and more than chance.
    pub(super) fn holds_some_of(&self, column: &[f64]) -> bool {
        // what cannot be milled has none
        if column.len() != self.rows.len() {
            return false;
        }
        let datum = (0..3).map(|k| self.column(|_, row| row.across[k]));
        let open = datum.chain(self.coefficients.iter().cloned());
        let open = open.map(|column| Nuisance {
            column,
            spread: f64::INFINITY,
        });
        let statement = Statement {
            nuisances: open.collect(),
            ..self.bare()
        };
        let alone = Alone::of(&statement, column);
        alone.taken > 2.0 * CHANCE && alone.taken > SHARE * alone.all
    }

    /// Whether what is merely uncertain leaves scatter within a stated noise, none of it being far off: no spring is worth a trial in time
    /// then.
    fn is_sound(&self, uncertain: &[(Known, Nuisance)]) -> bool {
        let statement = Statement {
            nuisances: uncertain.iter().map(|u| u.1.clone()).collect(),
            ..self.bare()
        };
        let (left, farthest) = unblamed(&statement);
        let in_place: Vec<f64> = left.iter().zip(&self.spread).map(|(l, s)| l * s).collect();
        let is_told = self.test.facts.probe_noise.is_some();
        is_told && rms(&left) <= 1.0 && farthest <= ALLOWED && self.is_scatter(&in_place)
    }

    /// What every statement holds, found once.
    pub(super) fn stated(&self) -> &Stated {
        self.stated.get_or_init(|| {
            let uncertain = uncertain(self);
            let mut suspects = match self.swings() && self.is_sound(&uncertain) {
                true => Vec::new(),
                false => physics::suspects(self),
            };
            suspects.extend(table::suspects(EFFECTS, self));
            suspects.extend(table::patterns(PATTERNS, self));
            Stated {
                suspects,
                uncertain,
            }
        })
    }

    /// Everybody, those that were found in the shape that they were found in.
    fn suspects_about(&self, about: &[Blamed]) -> Vec<Suspect> {
        let mut suspects = self.stated().suspects.clone();
        for blamed in about {
            let own = suspects
                .iter_mut()
                .find(|s| s.effect == blamed.effect && s.site == blamed.site);
            if let Some((own, member)) = own.zip(self.about(blamed)) {
                let form = &member.shape[..member.shape.len() - 1];
                own.members
                    .retain(|m| !m.shape.starts_with(form) || m.within.is_none());
                own.members.push(member);
            }
        }
        suspects
    }

    /// Waves over path and time, and the simulated deviation changing along the path.
    fn span(&self) -> Vec<Vec<f64>> {
        let mut span = self.either_way(&self.waves(WAVES[0]));
        let time = table::unit_range(&self.column(|s, _| s.time_s));
        span.extend(self.either_way(&table::waves(&time, WAVES[1])));
        let sizes = largest(&self.simulated);
        if sizes > 0.0 {
            let missed = missed(self, &self.simulated).into_iter();
            span.extend(missed.map(|m| m.iter().map(|x| x / sizes).collect()));
        }
        span.retain(|column| column.iter().any(|x| *x != 0.0));
        span
    }

    /// Waves over the path, the smaller the shorter they are ([`table::waves`]).
    pub(super) fn waves(&self, count: usize) -> Vec<Vec<f64>> {
        table::waves(&table::unit_range(&self.column(|s, _| s.s_m)), count)
    }

    /// Columns of one direction across the feed, and of the other.
    pub(super) fn either_way(&self, columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let one = |column: &Vec<f64>, left: bool| {
            let own = self.rows.iter().zip(column);
            own.map(|(row, c)| if row.left == left { *c } else { 0.0 })
                .collect()
        };
        let each = columns.iter();
        each.flat_map(|c| [one(c, true), one(c, false)]).collect()
    }

    /// Stretches of the path, then places here and there.
    fn splits(&self) -> Vec<Vec<usize>> {
        let count = self.stations.len().max(1);
        let stretch = |row: &super::Row| row.station * STRETCHES / count;
        vec![
            self.rows.iter().map(stretch).collect(),
            self.rows.iter().map(|row| row.station % 5).collect(),
        ]
    }
}
