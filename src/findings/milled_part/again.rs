//! The part milled again with what was found: what that changes beyond first order.

use super::tried::{shifted, still};
use super::{
    Case, backlash, cutting_coefficients, robot, thermal_growth, tool_radius, uncertain,
    workpiece_offset, workpiece_rotation,
};
use crate::findings::engine::{Blamed, Nuisance};
use crate::ground::spatial::{V3, add};
use crate::process::setup::Setup;

impl Case {
    /// How much more than in first order these causes and uncertain numbers change the rows, m: the cut is milled
    /// again with them, and the force gives way.
    pub(super) fn beyond_first_order(&self, about: &[Blamed], uncertain: &[f64]) -> Vec<f64> {
        let mut setup = self.trial.clone();
        let known = self.stated().uncertain.iter().zip(uncertain);
        let known: Vec<(&Nuisance, f64)> = known
            .filter(|((known, _), amount)| uncertain::put(known, **amount, &mut setup))
            .map(|((_, nuisance), amount)| (nuisance, *amount))
            .collect();
        let altered = about.iter().filter(|b| self.alter(b, &mut setup));
        let altered: Vec<&Blamed> = altered.collect();
        let moves: Vec<(&Blamed, Vec<V3>)> = about
            .iter()
            .filter_map(|b| Some((b, moves(self, b)?)))
            .collect();
        if altered.is_empty() && known.is_empty() && moves.is_empty() {
            return vec![0.0; self.rows.len()];
        }
        let Some(again) = self.milled_again(&setup, &moves) else {
            return vec![0.0; self.rows.len()];
        };
        let again = self.seen(&again);
        let linear = |row: usize| {
            let causes = altered.iter().copied().chain(moves.iter().map(|m| m.0));
            let causes: f64 = causes.map(|b| b.part[row]).sum();
            // the edge of another tool on the wall is no way of its middle
            let edges: f64 = altered
                .iter()
                .map(|b| tool_radius::edge(self, b, row))
                .sum();
            causes - edges + known.iter().map(|(n, a)| a * n.column[row]).sum::<f64>()
        };
        (0..self.rows.len())
            .map(|row| again[row] - self.still[row] - linear(row))
            .collect()
    }

    /// Puts a cause into robot, material or tool; false for others.
    fn alter(&self, blamed: &Blamed, setup: &mut Setup) -> bool {
        cutting_coefficients::alter(blamed, setup)
            || robot::alter(self, blamed, setup)
            || tool_radius::alter(blamed, setup)
    }

    /// Where the tool stands at every station beside its programmed way, m, moved there before the cut answers; none where that
    /// cannot be milled.
    fn milled_again(&self, setup: &Setup, moves: &[(&Blamed, Vec<V3>)]) -> Option<Vec<V3>> {
        if moves.is_empty() {
            return still(setup, &self.stations).ok();
        }
        let whole = |i: usize| moves.iter().fold([0.0; 3], |sum, m| add(sum, m.1[i]));
        let whole: Vec<V3> = (0..self.stations.len()).map(whole).collect();
        let beside = still(&shifted(setup, &self.stations, &whole), &self.stations).ok()?;
        Some(
            beside
                .iter()
                .zip(&whole)
                .map(|(b, w)| add(*b, *w))
                .collect(),
        )
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
