//! A milling-force file as its diagnosis sees it.

mod columns;
mod jumps;
mod samples;

use super::aim::Aim;
use super::lines::{Line, lines};
use super::noise::{Colour, Filter};
use super::sensor::{SOUND, Sensor};
use super::setting::{Places, Present, Setting, Slopes};
use super::start::fitted;
use crate::experiments::milling_force::RUNOUT;
use crate::ground::spatial::{V3, rotate};
use crate::measurement::milling_force::MillingForce;
use rayon::prelude::*;
use samples::{noise, nominal, samples};
use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

/// Readings that a stated noise is worth, and an estimated one.
const WORTH: [f64; 2] = [60.0, 30.0];

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
    /// How well the angle of tooth 1 is known from where the force jumps, rad; infinite: nothing jumps.
    pub turn: f64,
}

/// What does not change while causes are tried.
struct Data {
    file: MillingForce,
    cuts: Vec<CutSamples>,
    lines: Vec<Line>,
    stated: bool,
    noise: Vec<f64>,
    /// What whitens it; none: it is white.
    filter: Option<Arc<Filter>>,
    worth: f64,
    nominal: [f64; 6],
}

/// A file with the simulation that it is compared with: rows are samples by axes x, y, z.
pub struct Case {
    data: Arc<Data>,
    /// By how much the simulation differs from what is stated; see [`Places`].
    pub(super) offset: Vec<f64>,
    /// What the sensor makes of a force.
    sensor: Sensor,
    /// What causes that are known add to the readings, N; none: nothing.
    explained: Vec<f64>,
    /// Relative errors of the stated speeds that causes account for, by cut.
    speeds: Vec<f64>,
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
        let colour = Colour::of(&account, &cuts);
        let times: Vec<f64> = cuts.iter().flat_map(|c| &c.time).copied().collect();
        let data = Data {
            lines: lines(&account, &cuts, colour.as_ref()),
            noise: noise(&file.facts, &account, colour.as_ref()),
            filter: colour.map(|c| Arc::new(c.filter(&times))),
            worth: WORTH[usize::from(file.facts.sensor_noise_n.is_none())],
            file,
            cuts,
            stated,
            nominal,
        };
        Self::at(Arc::new(data), offset, SOUND, Vec::new())
    }

    fn at(data: Arc<Data>, offset: Vec<f64>, sensor: Sensor, explained: Vec<f64>) -> Self {
        let mut case = Self {
            speeds: vec![0.0; data.cuts.len()],
            data,
            offset,
            sensor,
            explained,
            slopes: Vec::new(),
            aim: OnceLock::new(),
        };
        case.simulate();
        case
    }

    /// The same file where the process differs by `by` more, the sensor is this one, and `explained` is known
    /// beside it. The speeds of the records are in the scenes already.
    pub(super) fn moved(&self, by: &[f64], sensor: Sensor, explained: Vec<f64>) -> Self {
        let places = self.places();
        let speeds: Vec<usize> = (0..places.cuts).map(|c| places.speed(c)).collect();
        let each = self.offset.iter().zip(by).enumerate();
        let offset = each
            .map(|(at, (o, b))| if speeds.contains(&at) { *o } else { o + b })
            .collect();
        Self {
            speeds: speeds.iter().map(|at| by[*at]).collect(),
            ..Self::at(self.data.clone(), offset, sensor, explained)
        }
    }

    /// What the sensor makes of a force.
    pub(super) fn sensor(&self) -> Sensor {
        self.sensor
    }

    /// A cut where the vector is `offset`.
    pub(super) fn setting<'a>(&self, cut: usize, offset: &'a [f64]) -> Setting<'a> {
        Setting {
            places: self.places(),
            cut,
            offset,
            resonant: self.sensor.resonant,
        }
    }

    fn simulate(&mut self) {
        let cuts = self.cuts();
        let one = |i: usize| cuts[i].present.slopes(self.setting(i, &self.offset));
        let mut all: Vec<Slopes> = (0..cuts.len()).into_par_iter().map(one).collect();
        if self.sensor.map != SOUND.map {
            for own in &mut all {
                let each = own.slopes.iter_mut().flatten().chain(&mut own.force);
                each.for_each(|f| *f = rotate(&self.sensor.map, *f));
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

    /// What whitens the noise; none: it is white.
    pub(super) fn filter(&self) -> Option<Arc<Filter>> {
        self.data.filter.clone()
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

    /// Simulated force, N.
    pub(super) fn simulated(&self, cut: usize, sample: usize) -> V3 {
        self.slopes[cut].force[sample]
    }

    /// What a cause must be compared with beside what is merely uncertain.
    pub(super) fn aim(&self) -> &Aim {
        self.aim.get_or_init(|| Aim::new(self, self.loose()))
    }

    /// Runout of the simulation, along tooth 1 and a quarter turn on, m.
    pub(super) fn runout(&self) -> [f64; 2] {
        let stated = &self.cuts()[0].present.p;
        [0, 1].map(|k| stated[RUNOUT + k] + self.offset[RUNOUT + k])
    }

    /// How well the angle of tooth 1 of a cut is known before the slopes of its force, rad: a sensor that rings shows a jump late.
    pub(super) fn turn(&self, cut: usize) -> f64 {
        match self.sensor.resonant {
            Some(_) => f64::INFINITY,
            None => self.cuts()[cut].turn,
        }
    }

    /// Whether the force of a cut jumps.
    pub(super) fn jumps(&self) -> bool {
        self.cuts().iter().any(|c| c.present.scene.jumps())
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
