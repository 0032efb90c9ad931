//! Columns of a case, one entry per row: what is simulated, what is measured beside it, what a step adds.

use super::super::setting::Places;
use super::Case;
use crate::ground::spatial::{V3, rotate};
use rayon::prelude::*;

impl Case {
    /// A column from cut, sample and axis.
    pub(in super::super) fn column(&self, of: impl Fn(usize, usize, usize) -> f64) -> Vec<f64> {
        let cuts = self.cuts().iter().enumerate();
        let of = &of;
        cuts.flat_map(|(c, cut)| {
            (0..cut.time.len()).flat_map(move |i| (0..3).map(move |k| of(c, i, k)))
        })
        .collect()
    }

    /// Every row of the simulation, N.
    pub(in super::super) fn forces(&self) -> Vec<f64> {
        self.column(|c, i, k| self.simulated(c, i)[k])
    }

    /// What a step along a direction of the vector adds.
    pub(in super::super) fn along(&self, direction: &[f64]) -> Vec<f64> {
        let places = self.places();
        let own = |c: usize| -> Vec<(usize, f64)> {
            let used = places.of_cut(c).enumerate();
            used.map(|(at, place)| (at, direction[place]))
                .filter(|(_, d)| *d != 0.0)
                .collect()
        };
        let of_cuts: Vec<Vec<(usize, f64)>> = (0..places.cuts).map(own).collect();
        self.column(|c, i, k| {
            let slope = |(at, d): &(usize, f64)| d * self.slopes[c].slopes[*at][i][k];
            of_cuts[c].iter().map(slope).sum()
        })
    }

    /// What a step of the vector adds, all of it. The speeds of the records are in the scenes already: a stated one that is
    /// wrong adds what its slope says.
    pub(in super::super) fn step(&self, to: &[f64]) -> Vec<f64> {
        let (places, cuts) = (self.places(), self.cuts());
        let mut still = to.to_vec();
        (0..places.cuts).for_each(|c| still[places.speed(c)] = 0.0);
        let each = self.offset.iter().zip(&still);
        let there: Vec<f64> = each.map(|(o, d)| o + d).collect();
        let acts = |c: usize| places.of_cut(c).any(|place| still[place] != 0.0);
        let one = |c: usize| {
            acts(c).then(|| {
                let (scene, p) = cuts[c].present.moved(self.setting(c, &there));
                let force = scene.force(&p);
                force.iter().map(|f| self.shown(f)).collect()
            })
        };
        let moved: Vec<Option<Vec<V3>>> = (0..cuts.len()).into_par_iter().map(one).collect();
        let by_speed = self.along(&places.of_every_cut(Places::speed, |c| to[places.speed(c)]));
        let mut added = self.column(|c, i, k| match &moved[c] {
            Some(force) => force[i][k] - self.simulated(c, i)[k],
            None => 0.0,
        });
        added.iter_mut().zip(by_speed).for_each(|(a, s)| *a += s);
        added
    }

    /// What one coefficient of the chip (0 to 2: tangential, radial, axial) adds where it multiplies a function of the chip's
    /// thickness, m.
    pub(in super::super) fn of_chips(
        &self,
        own: usize,
        chip: impl Fn(f64) -> f64 + Sync,
    ) -> Vec<f64> {
        let one = |c: usize| {
            let present = &self.cuts()[c].present;
            let (scene, mut p) = present.moved(self.setting(c, &self.offset));
            (0..6).filter(|j| *j != own).for_each(|j| p[j] = 0.0);
            let force = scene.force_of(&p, &chip);
            force.iter().map(|f| self.shown(f)).collect()
        };
        let all: Vec<Vec<V3>> = (0..self.cuts().len()).into_par_iter().map(one).collect();
        self.column(|c, i, k| all[c][i][k])
    }

    /// Measured less simulated and less what is known, with the speeds of the records as what is stated.
    pub(in super::super) fn reading(&self) -> Vec<f64> {
        let error = |c: usize| self.cuts()[c].present.speed - self.speeds[c];
        let back = self.along(&self.places().of_every_cut(Places::speed, error));
        let left = self.column(|c, i, k| self.cuts()[c].measured[i][k] - self.simulated(c, i)[k]);
        let mut reading: Vec<f64> = left.iter().zip(back).map(|(l, b)| l + b).collect();
        let each = reading.iter_mut().zip(&self.explained);
        each.for_each(|(r, e)| *r -= e);
        reading
    }

    /// What the speeds that causes account for add to the readings, N.
    pub(in super::super) fn of_speeds(&self) -> Vec<f64> {
        let places = self.places();
        self.along(&places.of_every_cut(Places::speed, |c| self.speeds[c]))
    }

    /// Force as the sensor shows it.
    fn shown(&self, force: &V3) -> V3 {
        rotate(&self.sensor.map, *force)
    }
}
