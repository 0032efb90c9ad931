//! Causes, and what cannot be told apart, as they are named.

use super::case::Case;
use super::next::{Known, Suspect, would_tell};
use super::search::Set;
use crate::findings::answer::{Candidate, Cause, Group};

/// Candidates that cannot be told apart hold the cause with this probability.
const SURE: f64 = 0.86;

impl Case<'_> {
    pub(super) fn name(&self, chosen: &Set) -> (Vec<Cause>, Vec<Group>) {
        let (mut causes, mut groups) = (Vec::new(), Vec::new());
        for seat in chosen
            .seats
            .iter()
            .filter(|s| !self.seats.seats[**s].stranger)
        {
            let known = |s: usize| !self.seats.seats[s].stranger;
            let rivals = self.posterior.rivals(&chosen.seats, *seat, (SURE, known));
            let gain = self.told_gain(chosen, *seat);
            let own = &self.seats.seats[*seat];
            causes.push(Cause {
                effect: own.cause.card().name,
                site: own.site.clone(),
                probability: self.posterior.inclusion(*seat),
                summary: own.cause.card().summary,
                alternatives: self.alternatives(chosen, *seat),
                parameters: own.cause.said(
                    self.scene.robot,
                    &own.site,
                    &self.amounts_of(chosen, *seat),
                ),
                gain,
            });
            if !rivals.is_empty() {
                let members = std::iter::once(*seat).chain(rivals.iter().map(|s| s.0));
                let members: Vec<usize> = members.collect();
                let of = |s: &usize| &self.seats.seats[*s];
                let repeatability = self.test.facts.setup_repeatability.unwrap_or(0.0);
                let known = Known {
                    scene: &self.scene,
                    shapes: &self.shapes,
                    springs: &self.springs,
                    columns: &self.columns,
                    seats: &self.seats,
                    repeatability,
                };
                let sets = std::iter::once(chosen).chain(rivals.iter().map(|s| s.1));
                let suspects = members
                    .iter()
                    .zip(sets)
                    .map(|(m, set)| self.suspect(set, *m));
                let suspects: Vec<Suspect> = suspects.collect();
                groups.push(Group {
                    effects: members.iter().map(|s| of(s).cause.card().name).collect(),
                    sites: members.iter().map(|s| of(s).site.clone()).collect(),
                    would_tell: would_tell(&known, &suspects),
                    gain,
                });
            }
        }
        causes.sort_by(|a, b| {
            b.gain
                .reduction_percent
                .total_cmp(&a.gain.reduction_percent)
        });
        (causes, groups)
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
        let mut others = self.posterior.stand_ins(&chosen.seats, seat);
        others.retain(|other| other.2 > 1e-4 && !self.seats.seats[other.0].stranger);
        let told = |(s, _, p): &(usize, &Set, f64)| {
            let own = &self.seats.seats[*s];
            (own.cause.card().name, own.site.clone(), *p)
        };
        others.iter().map(told).collect()
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
