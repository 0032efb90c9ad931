//! Sets of causes compared under one screen.

use super::ambiguity::{Posterior, temper};
use super::refine::{Refined, refine, refine_from};
use super::search::search;
use super::tints::Tints;
use crate::effects::Composite;
use crate::fit::candidates::Candidates;
use crate::fit::normal::{Found, Normal};
use crate::fit::observation::Observation;
use crate::fit::screen::Screen;
use crate::signal::colour::Colour;

/// Sets whose own curves widen the span of a second screen.
const WIDENED: usize = 3;

/// Sets refined beyond the single causes.
const REFINED_PAIRS: usize = 14;

/// Sets of causes compared under one screen.
pub(super) struct Comparison {
    pub(super) screen: Screen,
    pub(super) plain: Refined,
    pub(super) refined: Vec<Refined>,
    pub(super) posterior: Posterior,
}

impl Comparison {
    pub(super) fn new(screen: Screen, candidates: &Candidates, data: &Observation) -> Self {
        let normal = Normal::new(candidates, &screen.colour);
        let start = [data.scene.load_scale / data.scene.deflection_scale];
        let spring = Composite::new(&[]);
        let plain = refine_from(spring, &start, data, &screen.colour, normal.base, 12);
        let tints = Tints::new(&screen.colour, &screen.tints, &plain.optimum);
        let temper = temper(0.5 * (normal.base - screen.saturated).max(0.0));
        let nothing = tints.evidence(&plain.optimum);
        let weighed = |found: &Found| {
            let mut set = refine(found, candidates, data, &screen.colour, normal.base, 12);
            set.nats = (tints.evidence(&set.optimum) - nothing) / temper;
            set
        };
        let found = search(candidates, &normal, REFINED_PAIRS);
        let refined: Vec<Refined> = found.iter().map(weighed).collect();
        let posterior = Posterior::new(&refined, data.rows(), temper);
        Self {
            screen,
            plain,
            refined,
            posterior,
        }
    }

    /// The most probable set.
    fn best(&self) -> &Refined {
        let best = self.posterior.sets.first().and_then(|set| set.2);
        best.map_or(&self.plain, |i| &self.refined[i])
    }

    /// Reading less what the most probable set predicts.
    pub(super) fn residual(&self, data: &Observation) -> Vec<f64> {
        let best = self.best();
        let predicted = best.model.predict(&best.optimum.p, &data.scene);
        data.reading
            .iter()
            .zip(&predicted)
            .map(|(y, f)| y - f)
            .collect()
    }

    /// The colour that suits the most probable set.
    pub(super) fn suited(&self) -> Colour {
        Tints::new(&self.screen.colour, &self.screen.tints, &self.plain.optimum)
            .best(&self.best().optimum)
            .clone()
    }

    /// The curves of the sets that leave least, and how they change with their shapes, in cosine
    /// coefficients.
    pub(super) fn curves(&self) -> Vec<Vec<f64>> {
        let mut order: Vec<&Refined> = self.refined.iter().collect();
        order.sort_by(|a, b| a.optimum.chi2.total_cmp(&b.optimum.chi2));
        let columns = order.iter().take(WIDENED).flat_map(|set| {
            let jacobian = &set.optimum.jacobian;
            let sigma = &self.screen.colour.sigma;
            (1..jacobian.ncols()).map(move |j| {
                let column = jacobian.column(j);
                column.iter().zip(sigma).map(|(v, s)| v * s).collect()
            })
        });
        columns.collect()
    }
}
