//! Coefficients of the cut from wave forms of force: all six, the runout and its angle, with the angle of
//! the tooth, the speed and the width of each cut and the dynamometer's bandwidth as nuisance.
//!
//! Weighted Levenberg-Marquardt on residuals whitened by an autoregression per channel. The chip is that
//! of trochoids with real tooth radii: c sin φ would leave intervals that hold the truth in 77 % of cases
//! instead of 95.

mod answer;
mod averaged;
mod descent;
mod layout;
mod misfit;
mod remarks;
mod repeated;
mod rounds;
mod speed;
mod start;
mod steady;
mod whitening;

pub use answer::{Account, CutFit, identify};
pub use averaged::{Averaged, averaged};
pub use layout::{BANDWIDTH_STD, BORDER_SHARE, Layout};
pub use steady::{Known, range, steady_samples};

use crate::cutting::tool::FINE;
use crate::experiments::milling_force::{CutScene, cut, tool};
use crate::ground::spatial::V3;
use crate::measurement::milling_force::{MillingForce, Record};
use crate::signal::low_pass::settling_s;

/// One cut as the fit sees it.
#[derive(Debug, Clone)]
pub struct CutData {
    /// Tool, cut and times.
    pub scene: CutScene,
    /// Measured force on the tool, N.
    pub force: Vec<V3>,
    /// Time from the first sample of the cut in the file to the first one here, s.
    pub begins_s: f64,
    /// Whether a sample counts, one per row; those beside a jump do not.
    pub counts: Vec<bool>,
    /// Rows left out at the start, until the low pass has settled.
    pub settling: usize,
    /// Rows at the end that were not used: the record is longer than it need be.
    pub beyond: usize,
    /// Corner of the low pass as stated, Hz.
    pub bandwidth_hz: Option<f64>,
    /// Number of the file and of its cut, from 0.
    pub place: [usize; 2],
}

impl CutData {
    /// How many samples count.
    pub fn rows(&self) -> usize {
        self.counts.iter().filter(|c| **c).count()
    }

    /// Those of a wave that count.
    pub fn counted<'a>(&'a self, wave: &'a [V3]) -> impl Iterator<Item = &'a V3> {
        let each = wave.iter().zip(&self.counts);
        each.filter(|(_, counts)| **counts).map(|(v, _)| v)
    }
}

/// Most rows of a cut that are used: with more, what the law leaves counts, not the noise.
const MOST_ROWS: usize = 40_000;
/// Largest share of a record that settling may take.
const SETTLING_SHARE: f64 = 0.2;

/// The cuts of several files of one tool.
pub fn cuts(files: &[MillingForce]) -> Vec<CutData> {
    let of_file = |(number, file): (usize, &MillingForce)| -> Vec<CutData> {
        let records = file.records.iter().enumerate();
        records
            .map(|(i, record)| one(file, [number, i], record))
            .collect()
    };
    files.iter().enumerate().flat_map(of_file).collect()
}

fn one(file: &MillingForce, place: [usize; 2], record: &Record) -> CutData {
    let bandwidth = file.facts.bandwidth_hz;
    let start = record.time[0];
    let until = bandwidth.map_or(0.0, settling_s);
    let most = (SETTLING_SHARE * record.time.len() as f64) as usize;
    let settled = record.time.partition_point(|t| t - start < until).min(most);
    let first = record.time[settled];
    let last = record.time.len().min(settled + MOST_ROWS);
    CutData {
        scene: CutScene {
            tool: tool(&file.facts),
            cut: cut(&file.facts.cuts[place[1]]),
            time: record.time[settled..last]
                .iter()
                .map(|t| t - first)
                .collect(),
            low_pass: bandwidth.is_some(),
            resonant: None,
            shorter: Vec::new(),
            chipped: Vec::new(),
            chipped_to_m: 0.0,
            slice_rad: FINE,
        },
        force: record.force[settled..last].to_vec(),
        counts: vec![true; last - settled],
        begins_s: first - record.begins_s,
        settling: settled,
        beyond: record.time.len() - last,
        bandwidth_hz: bandwidth,
        place,
    }
}
