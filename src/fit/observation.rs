//! Observed deflections under a load history, ready for fitting: reduced, whitened, repaired.

use super::quieted::quieten;
use super::unrounded::unrounded;
use crate::effects::Scene;
use crate::ground::stats::{ends, largest};
use crate::measurement::cycles::Cycles;
use crate::measurement::load_cycle::LoadCycle;
use crate::signal::cosine::Cosine;
use crate::signal::hum::Hum;
use crate::signal::{lattice, outliers};

/// What is fitted: a scene, the readings, the cycles, and the planned transform.
pub struct Observation {
    /// Load history.
    pub scene: Scene,
    /// Readings, rad or m; wild ones replaced.
    pub reading: Vec<f64>,
    /// Cycles of the load.
    pub cycles: Cycles,
    /// Transform of the readings' length.
    pub cosine: Cosine,
    /// Rows of the file averaged into one.
    pub block: usize,
    /// Rows (after reduction) that were wild and were replaced.
    pub wild: Vec<usize>,
    /// What was taken of the file.
    pub part: Part,
    /// Tones that went through the readings and were taken off them.
    pub hums: Vec<Hum>,
    /// The load as it was read, where steps of the reading were taken off it.
    pub read: Option<Vec<f64>>,
}

/// The part of a long record that is fitted, and how it is averaged.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Part {
    /// Rows taken, from the first.
    pub rows: usize,
    /// Rows averaged into one.
    pub block: usize,
    /// Cycles taken, and cycles of the record.
    pub cycles: [usize; 2],
}

/// Averaged rows that a cycle keeps at least: fewer round its corners.
const PER_CYCLE: usize = 120;

impl Part {
    /// The whole record, averaged, where every cycle keeps its shape; else its first cycles.
    fn of(load: &[f64], most: usize) -> Self {
        let (rows, most) = (load.len(), most.max(4));
        let block = rows.div_ceil(most).max(1);
        if block == 1 {
            return Self {
                rows,
                block,
                cycles: [0; 2],
            };
        }
        Self::of_cycles(&Cycles::find(load), rows, most)
    }

    /// The same, the cycles being known.
    pub fn of_cycles(cycles: &Cycles, rows: usize, most: usize) -> Self {
        let block = rows.div_ceil(most).max(1);
        let whole = |cycles: usize| Self {
            rows,
            block,
            cycles: [cycles; 2],
        };
        let count = cycles.count();
        let finest = (rows / count / PER_CYCLE).max(1);
        if block == 1 || block <= finest {
            return whole(count);
        }
        let edges = cycles.starts.iter().copied().skip(1).chain([rows]);
        let fits = |edge: &usize| *edge <= most * finest;
        let taken = edges.clone().take_while(fits).count().max(1);
        let end = edges.clone().nth(taken - 1).unwrap_or(rows);
        Self {
            rows: end,
            block: end.div_ceil(most).max(finest),
            cycles: [taken, count],
        }
    }

    /// How many cycles are fitted of how many, where that is not all.
    pub fn sentence(&self) -> Option<String> {
        let [taken, all] = self.cycles;
        (taken < all).then(|| {
            format!("of {all} cycles the first {taken} are fitted: averaging the rest down would mix cycles")
        })
    }
}

/// Most tones that are taken off: the mains and two harmonics.
const TONES: usize = 3;

/// Rows beyond which neighbours are averaged before fitting.
pub const MOST_ROWS: usize = 3000;

/// Distance beyond its neighbours, in robust standard deviations of their jumps, that makes a lone
/// reading wild.
const WILD: f64 = 3.5;
/// Share of the largest reading that is rounding.
const ROUNDING: f64 = 1e-9;

impl Observation {
    /// Smallest and largest load.
    pub fn load_range(&self) -> (f64, f64) {
        ends(&self.scene.load)
    }

    /// Prepares the first sensor of a file, averaged down to at most `most` rows. Where averaging would
    /// mix cycles, the first cycles are taken as they are, and the others left out and counted.
    pub fn of(file: &LoadCycle, most: usize) -> Self {
        let part = Part::of(&file.load, most);
        let taken = |v: &[f64]| reduce(&v[..part.rows], part.block);
        let mut data = Self::from_channels(
            taken(&file.time),
            taken(&file.load),
            taken(&file.deflection),
            part.block,
        );
        data.part = part;
        data.unround(lattice::step(&file.load[..part.rows]));
        data.quieten();
        data.still();
        data
    }

    /// Takes the steps off a load that is read in coarse ones, if it is.
    fn unround(&mut self, step: Option<f64>) {
        let load = step.and_then(|step| unrounded(&self.scene, &self.reading, step));
        self.read = load.map(|load| std::mem::replace(&mut self.scene.load, load));
    }

    /// Takes the load cell's noise off the load, where it is not negligible beside the reading's.
    fn quieten(&mut self) {
        quieten(&mut self.scene, &mut self.reading);
    }

    /// Takes the hum of the mains off readings whose rows are uneven.
    fn still(&mut self) {
        while self.hums.len() < TONES && self.block == 1 {
            let scene = &self.scene;
            let k = scene.deflection_scale / scene.load_scale;
            let rows = self.reading.iter().zip(&scene.load);
            let beside: Vec<f64> = rows.map(|(y, m)| y - k * m).collect();
            let Some(hum) = Hum::of(&scene.time, &beside) else {
                return;
            };
            let each = self.reading.iter_mut().zip(&hum.course);
            each.for_each(|(y, tone)| *y -= tone);
            self.hums.push(hum);
        }
    }

    /// Prepares channels that are at hand already.
    pub fn from_channels(
        time: Vec<f64>,
        load: Vec<f64>,
        mut reading: Vec<f64>,
        block: usize,
    ) -> Self {
        let wild = repair(&load, &mut reading);
        let reading_rows = reading.len() * block;
        let cycles = Cycles::find(&load);
        let stiffness = rough_stiffness(&load, &reading);
        let scene = Scene::new(time, load, stiffness, cycles.count());
        let cosine = Cosine::new(reading.len());
        Self {
            scene,
            reading,
            cycles,
            cosine,
            part: Part {
                rows: reading_rows,
                block,
                cycles: [0; 2],
            },
            block,
            wild,
            read: None,
            hums: Vec::new(),
        }
    }

    /// The same, averaged down to about `most` rows, for a quick look; `None` where cycles would lose their shape.
    pub fn coarser(&self, most: usize) -> Option<Self> {
        let least = PER_CYCLE * self.cycles.count();
        let block = self.rows() / most.max(least);
        let taken = |v: &[f64]| reduce(v, block);
        (block > 1).then(|| {
            Self::from_channels(
                taken(&self.scene.time),
                taken(&self.scene.load),
                taken(&self.reading),
                block * self.block,
            )
        })
    }

    /// Number of readings.
    pub fn rows(&self) -> usize {
        self.reading.len()
    }
}

/// Means of neighbouring rows, `block` at a time.
pub fn reduce(values: &[f64], block: usize) -> Vec<f64> {
    if block <= 1 {
        return values.to_vec();
    }
    values
        .chunks(block)
        .map(|c| c.iter().sum::<f64>() / c.len() as f64)
        .collect()
}

/// Slope of load over deflection, robust against anything but a constant channel.
pub fn rough_stiffness(load: &[f64], reading: &[f64]) -> f64 {
    let n = load.len() as f64;
    let (ml, mr) = (
        load.iter().sum::<f64>() / n,
        reading.iter().sum::<f64>() / n,
    );
    let (mut ll, mut lr) = (0.0, 0.0);
    for (l, r) in load.iter().zip(reading) {
        ll += (l - ml) * (l - ml);
        lr += (l - ml) * (r - mr);
    }
    let slope = ll / lr;
    if slope.is_finite() && slope != 0.0 {
        slope.abs()
    } else {
        1.0
    }
}

/// Distance beyond its neighbours, in robust standard deviations of their jumps, of a reading so wild that
/// no slope may be taken with it.
const ABSURD: f64 = 50.0;

/// Replaces absurd lone readings by their neighbours; returns where.
pub fn tame(reading: &mut [f64]) -> Vec<usize> {
    let absurd = outliers::isolated(reading, ABSURD);
    for i in &absurd {
        reading[*i] = outliers::neighbours(reading, *i);
    }
    absurd
}

/// Replaces lone wild readings by their neighbours; returns where.
fn repair(load: &[f64], reading: &mut [f64]) -> Vec<usize> {
    let absurd = tame(reading);
    let slope = 1.0 / rough_stiffness(load, reading);
    let mut excess: Vec<f64> = reading
        .iter()
        .zip(load)
        .map(|(r, l)| r - slope * l)
        .collect();
    // what is left of a record without noise is rounding
    let is_exact = largest(&excess) <= ROUNDING * largest(reading);
    let wild = match is_exact {
        true => Vec::new(),
        false => outliers::isolated(&excess, WILD),
    };
    for i in &wild {
        excess[*i] = outliers::neighbours(&excess, *i);
        reading[*i] = excess[*i] + slope * load[*i];
    }
    let mut all = [absurd, wild].concat();
    all.sort_unstable();
    all.dedup();
    all
}
