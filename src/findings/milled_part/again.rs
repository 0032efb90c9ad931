//! The part milled again with what was found: what that changes beyond first order.

use super::driven::Driven;
use super::tried::{between, left, left_along};
use super::{
    Case, backlash, corner_lag, cutting_coefficients, robot, thermal_growth, tool_radius,
    uncertain, workpiece_offset, workpiece_rotation,
};
use crate::findings::bent;
use crate::findings::engine::{Blamed, Member, Nuisance};
use crate::ground::spatial::{V3, add};
use crate::ground::stats::difference;
use crate::process::setup::{Setup, Support};

/// A part that was milled again.
pub(super) struct Again {
    /// How much more than in first order the rows change, m.
    pub beyond: Vec<f64>,
    /// What the cut leaves, row by row, m: of a robot that swings with what sits in it; what only moves the tool or its way is no cut.
    pub simulated: Vec<f64>,
}

impl Case {
    /// These causes and uncertain numbers (amounts of `nuisances`) milled: the cut is milled again with them, and the force
    /// gives way. None where that cannot be milled.
    pub(super) fn again(
        &self,
        about: &[Blamed],
        uncertain: &[f64],
        nuisances: &[Nuisance],
    ) -> Option<Again> {
        let mut setup = self.trial.clone();
        let known = self.stated().uncertain.iter().zip(uncertain);
        let known: Vec<(&Nuisance, f64)> = known
            .zip(nuisances)
            .filter(|(((known, _), amount), _)| uncertain::put(known, **amount, &mut setup))
            .map(|((_, amount), nuisance)| (nuisance, *amount))
            .collect();
        let altered = about.iter().filter(|b| self.alter(b, &mut setup));
        let altered: Vec<&Blamed> = altered.collect();
        let moves: Vec<(&Blamed, Vec<V3>)> = about
            .iter()
            .filter_map(|b| Some((b, moves(self, b)?)))
            .collect();
        let driven: Vec<&Blamed> = about.iter().filter(|b| corner_lag::is_milled(b)).collect();
        if altered.is_empty() && known.is_empty() && moves.is_empty() && driven.is_empty() {
            return Some(self.as_it_is());
        }
        let support = match about.iter().any(backlash::is_milled) {
            true => Support::Coupled,
            false => self.support,
        };
        let again = self.milled_again((&setup, support), &driven, &moves)?;
        let (again, base) = (self.seen(&again), self.base(support)?);
        let causes = altered.iter().chain(&driven).copied();
        let causes = causes.chain(moves.iter().map(|m| m.0));
        let parts: Vec<Vec<f64>> = causes.map(|b| self.part(b)).collect();
        let linear = |row: usize| {
            let causes: f64 = parts.iter().map(|part| part[row]).sum();
            // the edge of another tool on the wall is no way of its middle
            let edges: f64 = altered
                .iter()
                .map(|b| tool_radius::edge(self, b, row))
                .sum();
            causes - edges + known.iter().map(|(n, a)| a * n.column[row]).sum::<f64>()
        };
        let more = difference(&again, base);
        let beyond = more.iter().enumerate();
        let beyond = beyond.map(|(row, more)| more - linear(row)).collect();
        let is_cut = self.swings() && moves.is_empty() && driven.is_empty();
        let cut = self.simulated.iter().zip(&more);
        let cut = cut.map(|(x, more)| if is_cut { x + more } else { *x });
        Some(Again {
            beyond,
            simulated: cut.collect(),
        })
    }

    /// Nothing changed.
    pub(super) fn as_it_is(&self) -> Again {
        Again {
            beyond: vec![0.0; self.rows.len()],
            simulated: self.simulated.clone(),
        }
    }

    /// What a trial with nothing changed leaves, row by row, m; none where that cannot be milled.
    pub(super) fn base(&self, support: Support) -> Option<&Vec<f64>> {
        if support == self.support {
            return Some(&self.still);
        }
        let own = || left(&self.trial, &self.stations, support).ok();
        let own = self.swung.get_or_init(|| Some(self.seen(&own()?)));
        own.as_ref()
    }

    /// What a cause adds in a straight line, row by row, m.
    fn part(&self, blamed: &Blamed) -> Vec<f64> {
        let Some(member) = self.about(blamed) else {
            return blamed.part.clone();
        };
        let row = |row: usize| {
            let each = member.columns.iter().zip(&blamed.amounts);
            each.map(|(column, amount)| amount * column[row]).sum()
        };
        (0..self.rows.len()).map(row).collect()
    }

    /// What a cause that adds no straight line adds about what was found of it.
    pub(super) fn about(&self, blamed: &Blamed) -> Option<Member> {
        if !self.bends(blamed) {
            return None;
        }
        let mut suspects = self.stated().suspects.iter();
        let own = suspects.find(|s| s.effect == blamed.effect && s.site == blamed.site)?;
        bent::about(own, blamed)
    }

    /// Whether a cause adds no straight line.
    pub(super) fn bends(&self, blamed: &Blamed) -> bool {
        self.swings() && robot::is_own(blamed)
            || backlash::is_milled(blamed)
            || corner_lag::is_milled(blamed)
    }

    /// Puts a cause into robot, material or tool; false for others.
    pub(super) fn alter(&self, blamed: &Blamed, setup: &mut Setup) -> bool {
        cutting_coefficients::alter(blamed, setup)
            || robot::alter(self, blamed, setup)
            || tool_radius::alter(blamed, setup)
            || backlash::alter(blamed, &mut setup.robot)
    }

    /// What is left at every station, m, the tool driven and moved beside its programmed way before the cut answers; none where that
    /// cannot be milled.
    pub(super) fn milled_again(
        &self,
        (setup, support): (&Setup, Support),
        driven: &[&Blamed],
        moves: &[(&Blamed, Vec<V3>)],
    ) -> Option<Vec<V3>> {
        let driven = driven.iter().find_map(|b| corner_lag::drives(self, b));
        let driven = driven.unwrap_or_else(|| Driven::as_told(&setup.way));
        let at = (&self.stations[..], support);
        if moves.is_empty() {
            return left_along(setup, &driven, at, |_| [0.0; 3]).ok();
        }
        let whole = |i: usize| moves.iter().fold([0.0; 3], |sum, m| add(sum, m.1[i]));
        let whole: Vec<V3> = (0..self.stations.len()).map(whole).collect();
        let by = between(&self.stations, &whole, &driven.when);
        left_along(setup, &driven, at, by).ok()
    }
}

/// Where a cause moves the tool before the cut answers.
fn moves(case: &Case, blamed: &Blamed) -> Option<Vec<V3>> {
    let own = [
        thermal_growth::moves,
        backlash::moves,
        workpiece_offset::moves,
        workpiece_rotation::moves,
    ];
    own.iter().find_map(|moves| moves(case, blamed))
}
