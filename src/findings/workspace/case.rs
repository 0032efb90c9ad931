//! Everything that is known about a test before causes are named.

use super::beyond::Beyond;
use super::columns::Columns;
use super::diagnosis::judgement;
use super::field::{Field, Springs};
use super::patterns::Scene;
use super::search::search;
use super::seats::Seats;
use super::set::Set;
use super::smooth::smooth;
use super::weights::weigh;
use crate::experiments::drive_law::{Law, STOP};
use crate::experiments::workspace::Response;
use crate::findings::engine::Judgement;
use crate::findings::engine::posterior::Posterior;
use crate::fit::force_shapes::Shapes;
use crate::fit::weighing::Weighing;
use crate::ground::spatial::{M3, V3, norm};
use crate::measurement::workspace_test::WorkspaceTest;
use crate::robot::Robot;
use nalgebra::DVector;

/// No model is right to better than this share of a deflection, where the file says how well set-ups repeat ...
const MODEL: f64 = 0.005;
/// ... and than this where it does not: what set-ups scatter by is in it then ...
const UNTOLD: f64 = 0.01;
/// A spring whose spread nobody states is held to this share of its nominal value: asked is whether the present
/// simulation is right. (Re-identified springs are freer: [`crate::fit::validation::DEFAULT_SPREAD`].)
const HELD: f64 = 0.1;
/// ... and no law to better than this share of the error that it explains.
const LAW: f64 = 0.05;
/// Amounts are reported with priors this many times as wide: without shrinkage.
const FREE: f64 = 30.0;

/// Beyond so many points a second look costs more than it tells, unless an instrument is suspect.
const FEW: usize = 100;

/// A test with all columns, and the sets of causes compared.
pub(super) struct Case<'a> {
    pub(super) test: &'a WorkspaceTest,
    pub(super) scene: Scene<'a>,
    pub(super) shapes: Shapes,
    pub(super) weighing: Weighing,
    pub(super) seats: Seats,
    pub(super) field: Field,
    pub(super) springs: Springs,
    /// Readings less the simulation: slopes, then levels; in standard deviations.
    pub(super) readings: DVector<f64>,
    /// The columns of all seats.
    pub(super) columns: Columns,
    pub(super) posterior: Posterior<Set>,
    pub(super) judgement: Judgement,
    pub(super) levels: usize,
}

impl<'a> Case<'a> {
    /// Twice where an instrument is suspect: it acts upon what it makes of the true displacement.
    /// And where the robot is: how far it lies beyond proportion follows from how soft it is. And where the rows agree with
    /// the model better than it was trusted.
    pub(super) fn of(test: &'a WorkspaceTest, robot: &'a Robot) -> Self {
        let first = Self::about(test, robot, (&[], robot), 1.0);
        let doubt = first.doubt();
        let best = &first.posterior.sets[0].0;
        let columns = first.columns_of(best);
        let blamed = columns.iter().any(|c| first.seats.columns[*c].instrument);
        let few = test.facts.joint_angles.len() <= FEW && !columns.is_empty();
        match blamed || few || doubt < 1.0 {
            false => first,
            true => {
                let softer = first.extended(best);
                drop(first);
                Self::about(test, robot, (&columns, &softer), doubt)
            }
        }
    }

    /// With the columns of the causes that are suspect, the robot being as soft as `bent` is, and a share of the guess of how
    /// far the model is wrong.
    fn about(
        test: &'a WorkspaceTest,
        robot: &'a Robot,
        (suspect, bent): (&[usize], &Robot),
        doubt: f64,
    ) -> Self {
        let points = &test.facts.joint_angles;
        let mut shapes = Shapes::of(test);
        let beyond = Beyond::of(bent, test);
        beyond.doubt(&mut shapes);
        let instruments = |seats: &Seats| -> Vec<usize> {
            let read = |c: &usize| seats.columns[*c].instrument;
            match suspect.iter().any(read) {
                true => suspect.to_vec(),
                false => Vec::new(),
            }
        };
        let mut scene = Scene::of(robot, points);
        let mut seats = Seats::of(&scene, &shapes);
        let response = Response::of(robot, points);
        let exact = match test.facts.setup_repeatability {
            Some(_) => MODEL,
            None => UNTOLD,
        };
        let repeatability = test.facts.setup_repeatability.unwrap_or(0.0);
        let mut weighing = Weighing::new(&shapes.setups, repeatability);
        let spread = test.facts.nominal_rel_std.unwrap_or(HELD).max(1e-6);
        let suspect = instruments(&seats);
        for _ in 0..3 {
            let smooth = smooth(&scene, &seats, &weighing, (&response, spread), &suspect);
            let size = |p: usize, d: usize| {
                let error: V3 =
                    std::array::from_fn(|k| smooth.read[p][d][k] - scene.base.slopes[p][d][k]);
                doubt * (exact * norm(smooth.read[p][d])).hypot(LAW * norm(error))
            };
            weighing.tolerate(size);
            weighing.about_slopes(|p, d| smooth.read[p][d]);
            scene.reference = smooth.real;
            seats.read_again(&scene, &shapes);
        }
        let left = shapes.left();
        let own =
            |p: usize, d: usize, f: &[f64]| scene.base.jumps((p, d), f, (Law::Free(STOP), 0.0));
        let (lines, jumps) = beyond.added(&shapes, &left, shapes.seen(own));
        let bends: Vec<f64> = left.iter().zip(&jumps).map(|(l, j)| l - j).collect();
        if shapes.is_bent(&bends) {
            weigh(&mut seats, &scene, &shapes, &bends);
        }
        let line = |p: usize, d: usize| -> V3 {
            let here = shapes.setup(p, d);
            let own = here.map_or([None; 3], |i| lines[i]);
            std::array::from_fn(|k| scene.base.slopes[p][d][k] + own[k].unwrap_or(0.0))
        };
        let slopes = weighing.measured() - weighing.whiten(line);
        let readings: Vec<f64> = slopes.iter().copied().chain(bends).collect();
        let readings = DVector::from_vec(readings);
        let levels = left.len();
        let patterns = seats.columns.iter().map(|c| &c.pattern);
        let columns = Columns::of(patterns, &weighing, levels);
        let mut springs = Springs::of(&weighing, robot, points, spread);
        springs.columns = springs.columns.resize_vertically(readings.len(), 0.0);
        let prior = seats.columns.iter().map(|c| c.prior).collect();
        let bounds = seats.columns.iter().map(|c| c.bound).collect();
        let field = Field::new(&readings, &columns, &springs, (prior, bounds));
        let judgement = judgement();
        let posterior = Posterior::of(search(&seats, &field), judgement.temper);
        Self {
            test,
            scene,
            shapes,
            weighing,
            seats,
            field,
            springs,
            readings,
            columns,
            posterior,
            judgement,
            levels,
        }
    }

    pub(super) fn slopes(&self) -> usize {
        self.readings.len() - self.levels
    }

    pub(super) fn columns_of(&self, set: &Set) -> Vec<usize> {
        let forms = set.forms.iter().map(|f| &self.seats.forms[*f]);
        forms.flat_map(|form| form.columns.clone()).collect()
    }

    /// Amounts without shrinkage, as they can be.
    pub(super) fn amounts(&self, set: &Set) -> Vec<f64> {
        let columns = self.columns_of(set);
        let mut found = self.field.amounts(&columns, |_| FREE).mean.into_iter();
        let forms = set.forms.iter().map(|f| &self.seats.forms[*f]);
        forms
            .flat_map(|form| {
                let seat = &self.seats.seats[form.seat];
                let mut all = vec![0.0; seat.cause.card().amounts.len()];
                let own = form.columns.iter().map(|c| c - seat.first);
                own.clone()
                    .zip(found.by_ref())
                    .for_each(|(k, a)| all[k] = a);
                seat.cause.possible(&mut all);
                own.map(|k| all[k]).collect::<Vec<f64>>()
            })
            .collect()
    }

    /// The amounts of one seat of a set, all of its card.
    pub(super) fn amounts_of(&self, set: &Set, seat: usize) -> Vec<f64> {
        let own = &self.seats.seats[seat];
        let mut all = vec![0.0; own.cause.card().amounts.len()];
        for (column, amount) in self.columns_of(set).iter().zip(self.amounts(set)) {
            if (own.first..own.first + all.len()).contains(column) {
                all[column - own.first] = amount;
            }
        }
        all
    }

    pub(super) fn explained(&self, set: &Set) -> Vec<M3> {
        let mut slopes = self.scene.base.slopes.clone();
        for (column, amount) in self.columns_of(set).iter().zip(self.amounts(set)) {
            let own = &self.seats.columns[*column].pattern.slopes;
            for (p, all) in slopes.iter_mut().enumerate() {
                for (a, b) in all.iter_mut().flatten().zip(own.at(p).iter().flatten()) {
                    *a += amount * b;
                }
            }
        }
        slopes
    }
}
