//! A milling-force file as its diagnosis sees it.

use super::aim::Aim;
use super::lines::{Line, lines};
use super::setting::{Places, Present, Slopes};
use super::start::fitted;
use crate::cutting::LINEAR_EDGE;
use crate::experiments::milling_force::{BANDWIDTH, PHASE, RUNOUT, SPEED, WIDTH};
use crate::fit::cut_force::{Account, CutFit};
use crate::ground::spatial::{M3, V3, rotate};
use crate::ground::stats::median;
use crate::measurement::milling_force::{Facts, MillingForce};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

/// Samples of all cuts that are compared at most: more cost time and tell little.
const MOST_SAMPLES: usize = 2800;
/// Pieces of a record that is longer than its share.
const PIECES: usize = 8;
/// Share of the force's own rms that the law of a sharp edge misses anyway: digits of the chip's surface.
const LAW: f64 = 2e-3;
/// Readings that a stated noise is worth, and an estimated one.
const WORTH: [f64; 2] = [60.0, 30.0];

/// Share of the deepest cut, from the tip, in which a tooth mostly breaks that does not break altogether.
const TIP: f64 = 0.7;

/// A sensor that shows what there is.
const IDENTITY: M3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The samples of a cut that are compared.
#[derive(Debug, Clone)]
pub struct CutSamples {
    /// The cut as it is simulated.
    pub present: Present,
    /// Measured forces on the tool, N.
    pub measured: Vec<V3>,
    /// Time in the file, s.
    pub time: Vec<f64>,
    /// First of its samples among those of all cuts.
    pub first: usize,
}

/// What does not change while causes are tried.
struct Data {
    file: MillingForce,
    cuts: Vec<CutSamples>,
    lines: Vec<Line>,
    stated: bool,
    noise: Vec<f64>,
    worth: f64,
    nominal: [f64; 6],
}

/// A file with the simulation that it is compared with: rows are samples by axes x, y, z.
pub struct Case {
    data: Arc<Data>,
    /// By how much the simulation differs from what is stated; see [`Places`].
    pub(super) offset: Vec<f64>,
    /// What the sensor makes of a force.
    seen: M3,
    /// What causes that are known add to the readings, N; none: nothing.
    explained: Vec<f64>,
    slopes: Vec<Slopes>,
    aim: OnceLock<Aim>,
}

impl Case {
    /// Of a file.
    pub fn new(file: MillingForce) -> Self {
        let (account, speeds) = fitted(&file);
        let stated = file.facts.nominal.is_some();
        let nominal = nominal(&file.facts, &account);
        let cuts = samples(&file, &account, &speeds, &nominal);
        let places = Places {
            teeth: file.facts.teeth,
            cuts: cuts.len(),
        };
        let mut offset = vec![0.0; places.len()];
        for (i, cut) in cuts.iter().enumerate() {
            offset[places.speed(i)] = cut.present.speed;
        }
        let data = Data {
            lines: lines(&account, &cuts),
            noise: noise(&file.facts, &account),
            worth: WORTH[usize::from(file.facts.sensor_noise_n.is_none())],
            file,
            cuts,
            stated,
            nominal,
        };
        Self::at(Arc::new(data), offset, IDENTITY, Vec::new())
    }

    fn at(data: Arc<Data>, offset: Vec<f64>, seen: M3, explained: Vec<f64>) -> Self {
        let mut case = Self {
            data,
            offset,
            seen,
            explained,
            slopes: Vec::new(),
            aim: OnceLock::new(),
        };
        case.simulate();
        case
    }

    /// The same file where the process differs by `by` more, the sensor makes `seen` of a force, and
    /// `explained` is known beside it.
    pub(super) fn moved(&self, by: &[f64], seen: M3, explained: Vec<f64>) -> Self {
        let each = self.offset.iter().zip(by);
        let offset = each.map(|(o, b)| o + b).collect();
        Self::at(self.data.clone(), offset, seen, explained)
    }

    /// What the sensor makes of a force.
    pub(super) fn seen(&self) -> M3 {
        self.seen
    }

    /// Force as the sensor shows it.
    fn shown(&self, force: &V3) -> V3 {
        rotate(&self.seen, *force)
    }

    /// Every row of the simulation, N.
    pub(super) fn forces(&self) -> Vec<f64> {
        self.column(|c, i, k| self.simulated(c, i)[k])
    }

    fn simulate(&mut self) {
        let (places, cuts) = (self.places(), self.cuts());
        let one = |i: usize| cuts[i].present.slopes(places, i, &self.offset);
        let mut all: Vec<Slopes> = (0..cuts.len()).into_par_iter().map(one).collect();
        if self.seen != IDENTITY {
            for own in &mut all {
                let each = own.slopes.iter_mut().flatten().chain(&mut own.force);
                each.for_each(|f| *f = rotate(&self.seen, *f));
            }
        }
        self.slopes = all;
    }

    /// The file.
    pub fn file(&self) -> &MillingForce {
        &self.data.file
    }

    /// Its cuts.
    pub fn cuts(&self) -> &[CutSamples] {
        &self.data.cuts
    }

    /// Lines between the harmonics of the spindle.
    pub(super) fn lines(&self) -> &[Line] {
        &self.data.lines
    }

    /// Whether coefficients are stated.
    pub(super) fn is_stated(&self) -> bool {
        self.data.stated
    }

    /// Coefficients of the simulation, SI.
    pub(super) fn nominal(&self) -> &[f64; 6] {
        &self.data.nominal
    }

    /// Noise of x, y and z, N.
    pub(super) fn noise(&self) -> &[f64] {
        &self.data.noise
    }

    /// Spread of every row, N.
    pub(super) fn spread(&self) -> Vec<f64> {
        self.column(|_, _, k| self.noise()[k])
    }

    /// Rows that the noise is worth.
    pub(super) fn worth(&self) -> f64 {
        self.data.worth
    }

    /// Places of the vector.
    pub(super) fn places(&self) -> Places {
        Places {
            teeth: self.data.file.facts.teeth,
            cuts: self.data.cuts.len(),
        }
    }

    /// Sign that turns forces on the tool into those of the file.
    pub(super) fn sign(&self) -> f64 {
        if self.data.file.facts.on_tool {
            1.0
        } else {
            -1.0
        }
    }

    /// A column from cut, sample and axis.
    pub(super) fn column(&self, of: impl Fn(usize, usize, usize) -> f64) -> Vec<f64> {
        let cuts = self.cuts().iter().enumerate();
        let of = &of;
        cuts.flat_map(|(c, cut)| {
            (0..cut.time.len()).flat_map(move |i| (0..3).map(move |k| of(c, i, k)))
        })
        .collect()
    }

    /// Simulated force, N.
    pub(super) fn simulated(&self, cut: usize, sample: usize) -> V3 {
        self.slopes[cut].force[sample]
    }

    /// What a step along a direction of the vector adds.
    pub(super) fn along(&self, direction: &[f64]) -> Vec<f64> {
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

    /// What a cause must be compared with beside what is merely uncertain.
    pub(super) fn aim(&self) -> &Aim {
        self.aim.get_or_init(|| Aim::new(self, self.loose()))
    }

    /// What a step of the vector adds, all of it.
    pub(super) fn step(&self, to: &[f64]) -> Vec<f64> {
        let (places, cuts) = (self.places(), self.cuts());
        let there: Vec<f64> = self.offset.iter().zip(to).map(|(o, d)| o + d).collect();
        let acts = |c: usize| places.of_cut(c).any(|place| to[place] != 0.0);
        let one = |c: usize| {
            acts(c).then(|| {
                let (scene, p) = cuts[c].present.moved(places, c, &there);
                let force = scene.force(&p);
                force.iter().map(|f| self.shown(f)).collect()
            })
        };
        let moved: Vec<Option<Vec<V3>>> = (0..cuts.len()).into_par_iter().map(one).collect();
        self.column(|c, i, k| match &moved[c] {
            Some(force) => force[i][k] - self.simulated(c, i)[k],
            None => 0.0,
        })
    }

    /// Measured less simulated and less what is known, with the speeds of the records as what is stated.
    pub(super) fn reading(&self) -> Vec<f64> {
        let places = self.places();
        let mut speeds = vec![0.0; places.len()];
        (0..places.cuts).for_each(|c| speeds[places.speed(c)] = self.cuts()[c].present.speed);
        let back = self.along(&speeds);
        let left = self.column(|c, i, k| self.cuts()[c].measured[i][k] - self.simulated(c, i)[k]);
        let mut reading: Vec<f64> = left.iter().zip(back).map(|(l, b)| l + b).collect();
        let each = reading.iter_mut().zip(&self.explained);
        each.for_each(|(r, e)| *r -= e);
        reading
    }

    /// Runout of the simulation, along tooth 1 and a quarter turn on, m.
    pub(super) fn runout(&self) -> [f64; 2] {
        let stated = &self.cuts()[0].present.p;
        [0, 1].map(|k| stated[RUNOUT + k] + self.offset[RUNOUT + k])
    }

    /// Revolutions of the spindle in the samples of a cut, on average.
    pub fn revolutions(&self) -> f64 {
        let of = |cut: &CutSamples| {
            let steps = cut.time.windows(2).map(|w| w[1] - w[0]);
            let step = steps.fold(f64::INFINITY, f64::min);
            cut.time.len() as f64 * step * cut.present.scene.cut.spindle_rad_s / TAU
        };
        self.cuts().iter().map(of).sum::<f64>() / self.cuts().len().max(1) as f64
    }

    /// Time of every sample over the whole file, 0 to 1.
    pub(super) fn progress(&self, cut: usize, sample: usize) -> f64 {
        let cuts = self.cuts();
        let first = cuts[0].time[0];
        let last = cuts.last().and_then(|c| c.time.last()).copied();
        let length = (last.unwrap_or(first) - first).max(f64::MIN_POSITIVE);
        (cuts[cut].time[sample] - first) / length
    }
}

/// The stated coefficients, what is left out zero; else those of the fit.
fn nominal(facts: &Facts, account: &Account) -> [f64; 6] {
    let Some(stated) = &facts.nominal else {
        return std::array::from_fn(|j| account.cuts[0].p[j]);
    };
    let card = LINEAR_EDGE.card();
    std::array::from_fn(|j| {
        let coefficient = &card.coefficients[j];
        let own = stated
            .coefficients
            .iter()
            .find(|(key, _)| key == coefficient.key);
        own.map_or(0.0, |(_, value)| value * coefficient.factor)
    })
}

fn samples(
    file: &MillingForce,
    account: &Account,
    speeds: &[f64],
    nominal: &[f64; 6],
) -> Vec<CutSamples> {
    let share = (MOST_SAMPLES / account.cuts.len().max(1)).max(64);
    let depths = file.facts.cuts.iter().map(|c| c.depth_m);
    let deepest = depths.fold(0.0, f64::max);
    let mut first = 0;
    let mut one = |(i, fit): (usize, &CutFit)| {
        let data = &fit.data;
        let used = pieces(data.force.len(), share);
        let mut scene = data.scene.clone();
        let whole = (1.0 + speeds[i]) * (1.0 + fit.p[SPEED]);
        scene.cut.spindle_rad_s = file.facts.cuts[i].spindle_rad_s * whole;
        scene.chipped_to_m = TIP * deepest;
        scene.time = used.iter().map(|at| data.scene.time[*at]).collect();
        let mut p = fit.p;
        p[..6].copy_from_slice(nominal);
        p[SPEED] = 0.0;
        let size = fit.p[RUNOUT]
            .hypot(fit.p[RUNOUT + 1])
            .max(f64::MIN_POSITIVE);
        for k in 0..2 {
            p[RUNOUT + k] *= file.facts.runout_m.unwrap_or(0.0) / size;
        }
        p[WIDTH] = scene.cut.width_m;
        if let Some(hz) = data.bandwidth_hz {
            p[BANDWIDTH] = hz.ln();
        }
        debug_assert!(p[PHASE].is_finite());
        let record = &file.records[i];
        let mut cut = CutSamples {
            measured: used
                .iter()
                .map(|at| record.force[data.settling + at])
                .collect(),
            time: used
                .iter()
                .map(|at| record.time[data.settling + at])
                .collect(),
            present: Present {
                scene,
                p,
                speed: whole - 1.0,
            },
            first,
        };
        cut.only(&steady(&cut));
        first += cut.time.len();
        cut
    };
    account.cuts.iter().enumerate().map(&mut one).collect()
}

/// How well the angle of a jump is known, rad, and the width of the cut, m.
const BESIDE: [f64; 2] = [4e-3, 5e-5];
/// Share of the range of a force from which such a shift changes it by a jump.
const JUMP: f64 = 0.1;

/// Samples that do not stand beside a jump of the simulated force (straight teeth that enter or leave at
/// once, and nothing that spreads it): those say only that the jump is thereabouts.
fn steady(cut: &CutSamples) -> Vec<bool> {
    let present = &cut.present;
    let at = |place: usize, by: f64| {
        let mut p = present.p;
        p[place] += by;
        present.scene.force(&p)
    };
    let here = present.scene.force(&present.p);
    let least = [0, 1, 2].map(|k| {
        let own = here.iter().map(|f| f[k]);
        let (low, high) = own.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
        JUMP * (high - low)
    });
    let [turn, width] = BESIDE;
    let beside = [
        (PHASE, turn),
        (PHASE, -turn),
        (WIDTH, width),
        (WIDTH, -width),
    ]
    .map(|(place, by)| at(place, by));
    let holds = |i: usize| {
        let still = |b: &Vec<V3>| (0..3).all(|k| (b[i][k] - here[i][k]).abs() <= least[k]);
        beside.iter().all(still)
    };
    (0..here.len()).map(holds).collect()
}

impl CutSamples {
    fn only(&mut self, kept: &[bool]) {
        let mut each = kept.iter();
        self.measured.retain(|_| *each.next().unwrap_or(&true));
        let mut each = kept.iter();
        self.time.retain(|_| *each.next().unwrap_or(&true));
        let mut each = kept.iter();
        self.present
            .scene
            .time
            .retain(|_| *each.next().unwrap_or(&true));
    }
}

/// Samples of a record: all, or pieces all along it.
fn pieces(count: usize, share: usize) -> Vec<usize> {
    if count <= share {
        return (0..count).collect();
    }
    let length = share / PIECES;
    let piece = |k: usize| {
        let first = k * (count - length) / (PIECES - 1);
        first..first + length
    };
    (0..PIECES).flat_map(piece).collect()
}

/// Noise of each axis: as stated, else from how consecutive samples of what a fit leaves differ; and what
/// the law misses.
fn noise(facts: &Facts, account: &Account) -> Vec<f64> {
    let axis = |k: usize| {
        let differences = account.cuts.iter().flat_map(|c| {
            let own = c.residual.windows(3);
            own.map(|w| (w[0][k] - 2.0 * w[1][k] + w[2][k]).abs())
        });
        // second differences of white noise have six times its variance; median of |x| is 0.6745 σ
        let own = median(&differences.collect::<Vec<_>>()) / (0.6745 * 6.0_f64.sqrt());
        let forces = account.cuts.iter().flat_map(|c| &c.data.force);
        let squares: Vec<f64> = forces.map(|f| f[0].hypot(f[1]).hypot(f[2])).collect();
        let size = LAW * crate::ground::stats::rms(&squares);
        facts.sensor_noise_n.unwrap_or(own).max(1e-9).hypot(size)
    };
    (0..3).map(axis).collect()
}
