//! Causes, and what cannot be told apart, as they are named.

use super::case::Case;
use super::next::{Known, Suspect, would_tell};
use super::set::Set;
use crate::findings::answer::{Candidate, Cause};
use crate::findings::engine::posterior::without;
use crate::findings::engine::rivals::{Rivals, runners_up};
use crate::findings::engine::verdict::Named;

/// Most members of a group whose others fit better: with more the data tell nothing.
const MEMBERS: usize = 3;

impl Case<'_> {
    pub(super) fn name(&self, chosen: &Set) -> Named {
        let mut named = Named::default();
        let is_named = |s: usize| !self.seats.seats[s].stranger;
        for seat in chosen.seats.iter().filter(|s| is_named(**s)) {
            let mut rivals = Rivals::of(&self.posterior, chosen, *seat, is_named, &self.judgement);
            if rivals.open.is_empty() {
                rivals.open = self.fitting_better(chosen, *seat);
            }
            let gain = self.told_gain(chosen, *seat);
            let own = &self.seats.seats[*seat];
            if !rivals.open.is_empty() {
                let members = std::iter::once(seat).chain(&rivals.open);
                let places = members.map(|s| self.seats.seats[*s].place()).collect();
                let would_tell = self.would_tell(chosen, *seat, &rivals.open);
                let probability = rivals.probability(&self.posterior, &self.judgement);
                named.group((places, probability), would_tell, gain);
                continue;
            }
            let inclusion = self.posterior.inclusion(*seat);
            named.causes.push(Cause {
                effect: own.cause.card().name,
                site: own.site.clone(),
                probability: inclusion.min(self.judgement.certain),
                summary: own.cause.card().summary,
                alternatives: self.alternatives(chosen, *seat),
                ci95: Vec::new(),
                parameters: own.cause.said(
                    self.scene.robot,
                    &own.site,
                    &self.amounts_of(chosen, *seat),
                ),
                gain,
            });
        }
        named.sorted()
    }

    /// Who in the place of a seat fits better, each free amount paid for, although it was thought the less likely one before:
    /// what is believed before the data names no cause against them.
    fn fitting_better(&self, chosen: &Set, seat: usize) -> Vec<usize> {
        let asked = &self.judgement;
        let fit = |set: &Set| set.nats - asked.amount * self.columns_of(set).len() as f64;
        let fits = |(other, odds): &(usize, f64)| {
            let library = !self.seats.seats[*other].stranger;
            let instead = self.swapped(chosen, (seat, *other));
            library
                && *odds > asked.ambiguous_if_better
                && instead.is_some_and(|set| fit(set) > fit(chosen))
        };
        let rivals = self.posterior.stand_ins(chosen, seat).into_iter();
        rivals.filter(fits).map(|r| r.0).take(MEMBERS - 1).collect()
    }

    /// The set with another seat in the place of one, if it was compared.
    fn swapped(&self, chosen: &Set, (seat, other): (usize, usize)) -> Option<&Set> {
        let mut seats = without(&chosen.seats, seat);
        seats.push(other);
        seats.sort_unstable();
        self.posterior.set(&seats)
    }

    /// What would tell a seat of a set from its rivals.
    fn would_tell(&self, chosen: &Set, seat: usize, rivals: &[usize]) -> String {
        let known = Known {
            scene: &self.scene,
            shapes: &self.shapes,
            springs: &self.springs,
            columns: &self.columns,
            seats: &self.seats,
            repeatability: self.test.facts.setup_repeatability.unwrap_or(0.0),
        };
        let in_its_place = |rival: &usize| {
            let set = self.swapped(chosen, (seat, *rival))?;
            Some(self.suspect(set, *rival))
        };
        let rivals = rivals.iter().filter_map(in_its_place);
        let suspects: Vec<Suspect> = std::iter::once(self.suspect(chosen, seat))
            .chain(rivals)
            .collect();
        would_tell(&known, &suspects)
    }

    /// A seat of a set with its amounts.
    fn suspect(&self, set: &Set, seat: usize) -> Suspect {
        let form = set.forms.iter().map(|f| &self.seats.forms[*f]);
        let columns: Vec<usize> = form
            .filter(|f| f.seat == seat)
            .flat_map(|f| f.columns.clone())
            .collect();
        let all = self.amounts_of(set, seat);
        let first = self.seats.seats[seat].first;
        Suspect {
            seat,
            amounts: columns.iter().map(|c| all[c - first]).collect(),
            columns,
        }
    }

    fn alternatives(&self, chosen: &Set, seat: usize) -> Vec<(&'static str, String, f64)> {
        let is_named = |s: usize| !self.seats.seats[s].stranger;
        let others = runners_up(&self.posterior, chosen, seat, is_named).into_iter();
        let told = others.map(|(s, p)| {
            let (effect, site) = self.seats.seats[s].place();
            (effect, site, p)
        });
        told.collect()
    }

    pub(super) fn table(&self) -> Vec<Candidate> {
        let name = |s: &usize| {
            let own = &self.seats.seats[*s];
            format!("{} {}", own.cause.card().name, own.site)
        };
        let row = |(set, p): &(Set, f64)| (set.seats.iter().map(name).collect(), *p, set.nats);
        self.posterior.sets.iter().take(10).map(row).collect()
    }
}
