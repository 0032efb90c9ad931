//! The diagnosis of a workspace test: from force steps to the verdict.

use super::adequacy::{Adequacy, Squares};
use super::field::{Field, Springs};
use super::limits::{Limit, limits};
use super::next::{Known, Suspect, would_tell};
use super::patterns::Scene;
use super::posterior::Posterior;
use super::search::{Set, search};
use super::seats::{Column, Seats};
use super::unseen::{Rows, fitted, gain, held_out};
use crate::experiments::workspace::Response;
use crate::findings::answer::{Answer, Candidate, Cause, Discrepancy, Group, Structure, Verdict};
use crate::findings::gain::Gain;
use crate::fit::force_shapes::Shapes;
use crate::fit::validation::DEFAULT_SPREAD;
use crate::fit::weighing::Weighing;
use crate::ground::spatial::{M3, V3};
use crate::measurement::workspace_test::{DIRECTIONS, WorkspaceTest};
use crate::robot::Robot;
use nalgebra::{DMatrix, DVector};

/// What a diagnosis found: the answer, and what its figures need.
pub struct WorkspaceDiagnosis {
    /// The answer.
    pub answer: Answer,
    /// The robot with the causes in it.
    pub extended: Robot,
    /// The lines of the set-ups.
    pub shapes: Shapes,
    /// Slopes that the present simulation predicts, m/N, by point and direction.
    pub simulated: Vec<M3>,
    /// Slopes that model and instruments with the causes predict.
    pub explained: Vec<M3>,
    /// Slopes at every point predicted from the other points alone, with the causes.
    pub unseen: Vec<M3>,
    /// What these points would not show.
    pub limits: Vec<Limit>,
    /// Standard deviation of a measured slope about any model, m/N, by set-up and component.
    pub deviation: Vec<[f64; 3]>,
}

impl std::ops::Deref for WorkspaceDiagnosis {
    type Target = Answer;

    fn deref(&self) -> &Answer {
        &self.answer
    }
}

/// Candidates that cannot be told apart hold the cause with this probability.
const SURE: f64 = 0.93;
/// Probability of a set against the same set less one cause, below which that cause is not named.
const NEEDED: f64 = 0.9;
/// No model is right to better than this share of a deflection ...
const MODEL: f64 = 0.01;
/// ... and no law to better than this share of the error that it explains.
const LAW: f64 = 0.05;
/// Amounts are reported with priors this many times as wide: without shrinkage.
const FREE: f64 = 30.0;
/// With more than this share unexplained the causes found are not the story.
const NOT_THE_STORY: f64 = 0.35;

/// Sets looked through for one whose causes all gain.
const SETS: usize = 24;
/// A set with less than this share of the best one's probability is no explanation.
const UNLIKELY: f64 = 0.01;

/// Diagnoses a test against the robot that simulates it.
pub fn diagnose(test: &WorkspaceTest, robot: &Robot) -> WorkspaceDiagnosis {
    Case::of(test, robot).conclude()
}

struct Case<'a> {
    test: &'a WorkspaceTest,
    scene: Scene<'a>,
    shapes: Shapes,
    weighing: Weighing,
    seats: Seats,
    field: Field,
    springs: Springs,
    /// Readings less the simulation: slopes, then levels; in standard deviations.
    readings: DVector<f64>,
    /// The columns of all seats.
    columns: DMatrix<f64>,
    posterior: Posterior,
    levels: usize,
}

impl<'a> Case<'a> {
    /// Twice where an instrument is suspect: it acts upon what it makes of the true displacement.
    fn of(test: &'a WorkspaceTest, robot: &'a Robot) -> Self {
        let first = Self::about(test, robot, &[]);
        let best = &first.posterior.sets[0].0;
        let blamed = |c: &usize| first.seats.columns[*c].instrument;
        let suspect: Vec<usize> = first.columns_of(best).into_iter().filter(blamed).collect();
        match suspect.is_empty() {
            true => first,
            false => Self::about(test, robot, &suspect),
        }
    }

    /// With the columns of instruments that are suspect.
    fn about(test: &'a WorkspaceTest, robot: &'a Robot, suspect: &[usize]) -> Self {
        let points = &test.facts.joint_angles;
        let shapes = Shapes::of(test);
        let mut scene = Scene::of(robot, points);
        let mut seats = Seats::of(&scene, &shapes);
        let response = Response::of(robot, points);
        let repeatability = test.facts.setup_repeatability.unwrap_or(0.0);
        let mut weighing = Weighing::new(&shapes.setups, repeatability);
        let spread = test
            .facts
            .nominal_rel_std
            .unwrap_or(DEFAULT_SPREAD)
            .max(1e-6);
        for _ in 0..2 {
            let smooth = smooth(&scene, &seats, &weighing, (&response, spread), suspect);
            let size = |p: usize, d: usize| {
                let error: V3 =
                    std::array::from_fn(|k| smooth[p][d][k] - scene.base.slopes[p][d][k]);
                (MODEL * norm(&smooth[p][d])).hypot(LAW * norm(&error))
            };
            weighing.tolerate(size);
            weighing.about_slopes(|p, d| smooth[p][d]);
            scene.reference = smooth;
            seats.read_again(&scene, &shapes);
        }
        let left = shapes.left();
        let jumps = shapes.seen(|p, d, f, _| scene.base.jump(p, d, f, None)).1;
        let slopes = weighing.measured() - weighing.whiten(|p, d| scene.base.slopes[p][d]);
        let bends = left.iter().zip(&jumps).map(|(l, j)| l - j);
        let readings: Vec<f64> = slopes.iter().copied().chain(bends).collect();
        let readings = DVector::from_vec(readings);
        let levels = left.len();
        let weighed = |c: &Column| c.pattern.weighed(&weighing, levels);
        let columns = DMatrix::from_columns(&seats.columns.iter().map(weighed).collect::<Vec<_>>());
        let springs = weighing.design(&response, &response.sites);
        let springs = Springs {
            columns: springs.resize_vertically(readings.len(), 0.0),
            spread,
        };
        let prior = seats.columns.iter().map(|c| c.prior).collect();
        let low = seats.columns.iter().map(|c| c.low).collect();
        let field = Field::new(&readings, &columns, &springs, (prior, low));
        let posterior = Posterior::new(search(&seats, &field));
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
            levels,
        }
    }

    fn slopes(&self) -> usize {
        self.readings.len() - self.levels
    }

    fn columns_of(&self, set: &Set) -> Vec<usize> {
        let forms = set.forms.iter().map(|f| &self.seats.forms[*f]);
        forms.flat_map(|form| form.columns.clone()).collect()
    }

    /// The most probable set whose causes all gain on unseen points; if there is none, the most
    /// probable one less those that gain nothing.
    fn choose(&self) -> Set {
        let likely = self.posterior.sets.iter().take(SETS);
        let mut likely = likely.filter(|(_, p)| *p > UNLIKELY * self.posterior.sets[0].1);
        let real = |set: &Set| set.seats.iter().all(|seat| self.is_real(set, *seat));
        if let Some((set, _)) = likely.find(|(set, _)| !set.seats.is_empty() && real(set)) {
            return set.clone();
        }
        let mut set = self.posterior.sets[0].0.clone();
        while let Some(seat) = set.seats.iter().copied().find(|s| !self.is_real(&set, *s)) {
            set = self.without(&set, seat);
        }
        set
    }

    fn is_real(&self, set: &Set, seat: usize) -> bool {
        self.is_needed(set, seat) && self.gain_of(set, seat).is_real()
    }

    /// The set less one seat, its other seats in the same forms.
    fn without(&self, set: &Set, seat: usize) -> Set {
        let keep: Vec<usize> = (0..set.seats.len())
            .filter(|i| set.seats[*i] != seat)
            .collect();
        let seats: Vec<usize> = keep.iter().map(|i| set.seats[*i]).collect();
        let known = self.posterior.sets.iter().find(|(s, _)| s.seats == seats);
        known.map_or_else(
            || Set {
                forms: keep.iter().map(|i| set.forms[*i]).collect(),
                seats,
                ..set.clone()
            },
            |(known, _)| known.clone(),
        )
    }

    fn is_needed(&self, set: &Set, seat: usize) -> bool {
        let rest: Vec<usize> = set.seats.iter().copied().filter(|s| *s != seat).collect();
        let (with, without) = (self.posterior.of(&set.seats), self.posterior.of(&rest));
        with > NEEDED * (with + without)
    }

    /// Gain of one seat: the set without it against the set, on points left out.
    fn gain_of(&self, set: &Set, seat: usize) -> Gain {
        let own = &self.seats.seats[seat];
        let (without, with) = (self.without(set, seat), set);
        let (before, after) = match self.point_of(own) {
            Some(point) => (self.seen_at(point, &without), self.seen_at(point, with)),
            None => {
                let folds = self.folds(own);
                let of =
                    |set: &Set| held_out(&self.rows(set), &folds, self.springs.columns.ncols());
                let (before, after) = (of(&without), of(with));
                let carried = gain(&before.carried, &after.carried, self.unit());
                if carried.is_real() {
                    return carried;
                }
                (before.refitted, after.refitted)
            }
        };
        gain(&before, &after, self.unit())
    }

    /// The point that a seat is about, if it is about one.
    fn point_of(&self, seat: &super::seats::Seat) -> Option<usize> {
        let number: usize = seat.site.strip_prefix("point")?.parse().ok()?;
        number.checked_sub(1)
    }

    /// What is left at one point for the cycles of a set-up that follow the one fitted: the slopes
    /// of cycles differ by the noise of readings only, which is small beside that of a set-up.
    fn seen_at(&self, point: usize, set: &Set) -> Vec<f64> {
        let mut left = fitted(&self.rows(set));
        let places = self.weighing.places();
        let here = |i: usize| places.get(i).is_some_and(|place| place.0 == point);
        let far = (0..left.len()).filter(|i| !here(*i));
        far.collect::<Vec<_>>()
            .into_iter()
            .for_each(|i| left[i] = f64::NAN);
        left
    }

    /// Which rows are left out together: those of one point.
    fn folds(&self, seat: &super::seats::Seat) -> Vec<Option<usize>> {
        let places = self.weighing.places();
        let bends = !self.seats.columns[seat.first].pattern.left.is_empty();
        let slopes = places.iter().map(|place| Some(place.0));
        let levels = self.shapes.levels();
        let levels = levels.iter().map(|l| bends.then_some(l.point));
        slopes.chain(levels).collect()
    }

    fn rows(&self, set: &Set) -> Rows<'_> {
        let own = self.columns_of(set);
        let springs = &self.springs.columns;
        let k = springs.ncols();
        let columns = DMatrix::from_fn(springs.nrows(), k + own.len(), |i, j| match j < k {
            true => springs[(i, j)],
            false => self.columns[(i, own[j - k])],
        });
        let spread = std::iter::repeat_n(self.springs.spread, k);
        let prior = own.iter().map(|c| 10.0 * self.field.prior(*c));
        Rows {
            readings: &self.readings,
            columns,
            prior: spread.chain(prior).collect(),
        }
    }

    /// Rms force of the steps, N.
    fn force(&self) -> f64 {
        let squares: f64 = self.test.steps.iter().map(|s| s.force * s.force).sum();
        (squares / self.test.steps.len().max(1) as f64).sqrt()
    }

    /// Standard deviation of an ordinary displacement about any model, m.
    fn unit(&self) -> f64 {
        let deviations = self.weighing.deviations();
        let all: Vec<f64> = deviations
            .iter()
            .flatten()
            .copied()
            .filter(|d| d.is_finite())
            .collect();
        let squares: f64 = all.iter().map(|d| d * d).sum();
        self.force() * (squares / all.len().max(1) as f64).sqrt()
    }

    /// Amounts without shrinkage, none below its bound.
    fn amounts(&self, set: &Set) -> Vec<f64> {
        let columns = self.columns_of(set);
        let found = self.field.amounts(&columns, |_| FREE);
        let bounded = columns.iter().zip(found.mean);
        bounded.map(|(c, a)| a.max(self.field.low(*c))).collect()
    }

    /// The amounts of one seat of a set, all of its card.
    fn amounts_of(&self, set: &Set, seat: usize) -> Vec<f64> {
        let own = &self.seats.seats[seat];
        let mut all = vec![0.0; own.cause.card().amounts.len()];
        for (column, amount) in self.columns_of(set).iter().zip(self.amounts(set)) {
            if (own.first..own.first + all.len()).contains(column) {
                all[column - own.first] = amount;
            }
        }
        all
    }

    fn adequacy(&self, set: &Set) -> Adequacy {
        let mut left = self.readings.clone();
        let columns = self.columns_of(set);
        for (column, amount) in columns.iter().zip(self.amounts(set)) {
            left -= self.columns.column(*column) * amount;
        }
        let n = self.slopes();
        let levels = left.rows(n, self.levels).norm_squared();
        let bends = |c: &&usize| !self.seats.columns[**c].pattern.left.is_empty();
        let bent = columns.iter().filter(bends).count() as f64;
        let all = self.springs.left(&left);
        Adequacy::of(
            Squares {
                sum: all - levels,
                freedom: (n as f64 - columns.len() as f64).max(1.0),
            },
            Squares {
                sum: levels,
                freedom: (self.shapes.freedom() - bent).max(1.0),
            },
            self.field.base,
            (
                self.shapes.bends(left.rows(n, self.levels).as_slice()),
                self.shapes.wander.iter().fold(0.0, |m, w| w.max(m)),
            ),
        )
    }

    fn conclude(self) -> WorkspaceDiagnosis {
        let chosen = self.choose();
        let adequacy = self.adequacy(&chosen);
        let strange = chosen
            .seats
            .iter()
            .find(|s| self.seats.seats[**s].stranger)
            .copied();
        let (causes, groups) = self.name(&chosen);
        let mut answer = Answer {
            verdict: verdict(&causes, &groups, &adequacy, strange.is_some()),
            discrepancy: self.discrepancy(),
            causes,
            groups,
            unexplained: self.structure(&chosen, &adequacy, strange),
            p_value: adequacy.p_value(),
            candidates: self.table(),
            unit: "m",
            noise: self.noise(),
        };
        if answer.verdict == Verdict::UnknownCause {
            answer.causes.clear();
            answer.groups.clear();
        }
        if answer.verdict == Verdict::CannotTell {
            answer.causes.clear();
        }
        let named = !matches!(answer.verdict, Verdict::UnknownCause | Verdict::Sufficient);
        WorkspaceDiagnosis {
            extended: match named {
                true => self.extended(&chosen),
                false => self.scene.robot.clone(),
            },
            simulated: self.scene.base.slopes.clone(),
            explained: self.explained(&chosen),
            unseen: self.explained(&chosen),
            limits: limits(&self.seats, &self.field),
            deviation: self.weighing.deviations(),
            answer,
            shapes: self.shapes,
        }
    }

    fn explained(&self, set: &Set) -> Vec<M3> {
        let mut slopes = self.scene.base.slopes.clone();
        for (column, amount) in self.columns_of(set).iter().zip(self.amounts(set)) {
            let own = &self.seats.columns[*column].pattern.slopes;
            for (all, part) in slopes.iter_mut().zip(own) {
                for (a, b) in all.iter_mut().flatten().zip(part.iter().flatten()) {
                    *a += amount * b;
                }
            }
        }
        slopes
    }

    fn extended(&self, set: &Set) -> Robot {
        let mut robot = self.scene.robot.clone();
        for seat in set.seats.iter().filter(|s| !self.seats.seats[**s].stranger) {
            let own = &self.seats.seats[*seat];
            own.cause
                .alter(&mut robot, &own.site, &self.amounts_of(set, *seat));
        }
        robot
    }

    fn name(&self, chosen: &Set) -> (Vec<Cause>, Vec<Group>) {
        let (mut causes, mut groups) = (Vec::new(), Vec::new());
        for seat in chosen
            .seats
            .iter()
            .filter(|s| !self.seats.seats[**s].stranger)
        {
            let mut rivals = self.posterior.rivals(&chosen.seats, *seat, SURE);
            rivals.retain(|rival| !self.seats.seats[rival.0].stranger);
            let gain = self.gain_of(chosen, *seat);
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

    fn discrepancy(&self) -> Discrepancy {
        let mut worst = (0.0, String::new());
        let (mut squares, mut count) = (0.0, 0.0);
        for setup in &self.shapes.setups {
            let simulated = self.scene.base.slopes[setup.point][setup.direction];
            for k in 0..3 {
                let Some(line) = setup.lines[k] else { continue };
                let error = (line.slope - simulated[k]) * self.force();
                squares += error * error;
                count += 1.0;
                if error.abs() > worst.0 {
                    let (p, d) = (setup.point + 1, DIRECTIONS[setup.direction]);
                    let along = match k == setup.direction {
                        true => String::new(),
                        false => format!(" under force in {d}"),
                    };
                    worst = (
                        error.abs(),
                        format!("largest at point {p} in {}{along}", DIRECTIONS[k]),
                    );
                }
            }
        }
        Discrepancy {
            rms: (squares / f64::max(count, 1.0)).sqrt(),
            noise_rms: self.unit(),
            place: worst.1,
        }
    }

    fn structure(&self, chosen: &Set, adequacy: &Adequacy, strange: Option<usize>) -> Structure {
        let explained = self.explained(chosen);
        let mut shape = Vec::new();
        let mut worst = (0.0, String::new());
        for (i, setup) in self.shapes.setups.iter().enumerate() {
            let Some(line) = setup.lines[setup.direction] else {
                continue;
            };
            let own = explained[setup.point][setup.direction][setup.direction];
            let left = (line.slope - own) * self.force();
            shape.push([i as f64 + 1.0, left]);
            if left.abs() > worst.0 {
                let place = format!(
                    "point {} in {}",
                    setup.point + 1,
                    DIRECTIONS[setup.direction]
                );
                worst = (left.abs(), place);
            }
        }
        let description = match strange {
            Some(seat) => {
                let own = &self.seats.seats[seat];
                format!("as if {} {}.", own.site, own.cause.card().summary)
            }
            None if adequacy.wanders() => "a zero that moves from cycle to cycle.".to_string(),
            None if adequacy.is_bent() => {
                "displacement that is not in proportion to the force.".to_string()
            }
            None => format!(
                "stiffness that depends on the posture in its own way, most at {}.",
                worst.1
            ),
        };
        Structure {
            share_of_variance: adequacy.share,
            shape,
            over_time: Vec::new(),
            description,
        }
    }

    fn noise(&self) -> String {
        let used: Vec<f64> = self
            .shapes
            .noise
            .iter()
            .copied()
            .filter(|n| *n > 0.0)
            .collect();
        let rms = (used.iter().map(|n| n * n).sum::<f64>() / used.len().max(1) as f64).sqrt();
        let repeatability = self.test.facts.setup_repeatability;
        let shared = repeatability.map_or("no stated repeatability".to_string(), |r| {
            format!("{:.1} % of every set-up", 100.0 * r)
        });
        format!("{:.1} µm a reading and {shared}", 1e6 * rms)
    }

    fn table(&self) -> Vec<Candidate> {
        let name = |s: &usize| {
            let own = &self.seats.seats[*s];
            format!("{} {}", own.cause.card().name, own.site)
        };
        let row = |(set, p): &(Set, f64)| (set.seats.iter().map(name).collect(), *p, set.nats);
        self.posterior.sets.iter().take(10).map(row).collect()
    }
}

fn verdict(causes: &[Cause], groups: &[Group], adequacy: &Adequacy, strange: bool) -> Verdict {
    match (causes.is_empty(), adequacy.is_left() || strange) {
        (true, true) => Verdict::UnknownCause,
        (true, false) => Verdict::Sufficient,
        (false, true) if strange || adequacy.share > NOT_THE_STORY => Verdict::UnknownCause,
        (false, true) => Verdict::PartlyExplained,
        (false, false) if groups.len() == causes.len() => Verdict::CannotTell,
        (false, false) => Verdict::Explained,
    }
}

/// Slopes close to what was measured, without its noise: all springs and all parts that could give
/// way fitted at once, each held by its prior, with the instruments that are `suspect`.
fn smooth(
    scene: &Scene,
    seats: &Seats,
    weighing: &Weighing,
    (response, spread): (&Response, f64),
    suspect: &[usize],
) -> Vec<M3> {
    let part = |i: &usize| {
        let own = &seats.columns[*i];
        let physics = !own.instrument && !own.stranger && own.pattern.left.is_empty();
        physics || suspect.contains(i)
    };
    let parts: Vec<&Column> = (0..seats.columns.len())
        .filter(part)
        .map(|i| &seats.columns[i])
        .collect();
    let springs = weighing.design(response, &response.sites);
    let k = springs.ncols();
    let mut design = springs.resize_horizontally(k + parts.len(), 0.0);
    for (j, part) in parts.iter().enumerate() {
        design.set_column(k + j, &part.pattern.weighed(weighing, 0));
    }
    let readings = weighing.measured() - weighing.whiten(|p, d| scene.base.slopes[p][d]);
    let mut normal = design.tr_mul(&design);
    let prior = |j: usize| if j < k { spread } else { parts[j - k].prior };
    (0..normal.nrows()).for_each(|j| normal[(j, j)] += prior(j).powi(-2));
    let Some(root) = normal.cholesky() else {
        return scene.base.slopes.clone();
    };
    let amounts = root.solve(&design.tr_mul(&readings));
    let sites = response.sites.iter().zip(amounts.iter());
    let compliances: Vec<f64> = sites.map(|(s, a)| s.compliance * a).collect();
    let at = |p: usize, d: usize| -> V3 {
        let own = response.slope(p, d, &compliances);
        let mut sum: V3 = std::array::from_fn(|c| scene.base.slopes[p][d][c] + own[c]);
        for (j, part) in parts.iter().enumerate() {
            (0..3).for_each(|c| sum[c] += amounts[k + j] * part.pattern.slopes[p][d][c]);
        }
        sum
    };
    let point = |p: usize| [0, 1, 2].map(|d| at(p, d));
    (0..scene.points.len()).map(point).collect()
}

fn norm(v: &V3) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}
