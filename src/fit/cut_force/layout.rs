//! Which unknown stands where: coefficients and runout are common, the nuisance belongs to cuts.

use super::CutData;
use crate::cutting::wave::Side;
use crate::experiments::milling_force::{BANDWIDTH, PHASE, RUNOUT, SPEED, UNKNOWNS, WIDTH};

/// Spread of the logarithm of a stated bandwidth.
const BANDWIDTH_STD: f64 = 0.2;
/// Spread of a stated spindle speed.
const SPEED_STD: f64 = 1e-3;
/// Spread of either part of the runout, m: no clamped tool runs worse. It closes what two teeth leave open.
pub(super) const RUNOUT_STD: f64 = 5e-5;
/// Spread of a stated width of cut, m.
const WIDTH_STD: f64 = 2e-5;

/// What is known of an unknown beforehand, and how large its steps are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unknown {
    /// Step in which it is counted, SI.
    pub scale: f64,
    /// Mean and standard deviation known beforehand.
    pub prior: Option<[f64; 2]>,
}

/// The unknowns of a campaign.
#[derive(Debug, Clone)]
pub struct Layout {
    /// All of them.
    pub unknowns: Vec<Unknown>,
    /// For each cut, where its own unknowns stand; `None`: fixed.
    pub of_cut: Vec<[Option<usize>; UNKNOWNS]>,
    /// Values of what is fixed.
    fixed: Vec<[f64; UNKNOWNS]>,
}

const SCALES: [f64; UNKNOWNS] = [
    1e8, 1e8, 1e8, 1e4, 1e4, 1e4, 1e-6, 1e-6, 0.1, 1e-2, 1e-4, 1e-5,
];

impl Layout {
    /// The unknowns of these cuts.
    pub fn of(cuts: &[CutData]) -> Self {
        let mut layout = Self {
            unknowns: (0..6).map(free).collect(),
            of_cut: Vec::new(),
            fixed: Vec::new(),
        };
        let teeth = cuts.first().map_or(1, |c| c.scene.tool.teeth);
        let part = || known(RUNOUT, 0.0, RUNOUT_STD);
        let runout = (teeth > 1).then(|| layout.add(part()));
        let second = (teeth > 1).then(|| layout.add(part()));
        let stated = cuts.iter().find_map(|c| c.bandwidth_hz);
        let bandwidth = stated.map(|hz| layout.add(known(BANDWIDTH, hz.ln(), BANDWIDTH_STD)));
        for cut in cuts {
            layout.add_cut(cut, [runout, second], bandwidth);
        }
        layout
    }

    fn add(&mut self, unknown: Unknown) -> usize {
        self.unknowns.push(unknown);
        self.unknowns.len() - 1
    }

    fn add_cut(&mut self, cut: &CutData, runout: [Option<usize>; 2], bandwidth: Option<usize>) {
        let width = cut.scene.cut.width_m;
        let mut places = [None; UNKNOWNS];
        (0..6).for_each(|k| places[k] = Some(k));
        (places[RUNOUT], places[RUNOUT + 1]) = (runout[0], runout[1]);
        places[BANDWIDTH] = bandwidth.filter(|_| cut.scene.low_pass);
        places[PHASE] = Some(self.add(free(PHASE)));
        places[SPEED] = Some(self.add(known(SPEED, 0.0, SPEED_STD)));
        if cut.scene.cut.side != Side::Slot {
            places[WIDTH] = Some(self.add(known(WIDTH, width, WIDTH_STD)));
        }
        let mut fixed = [0.0; UNKNOWNS];
        fixed[WIDTH] = width;
        self.of_cut.push(places);
        self.fixed.push(fixed);
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.unknowns.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.unknowns.is_empty()
    }

    /// What one cut is predicted with.
    pub fn of_one(&self, cut: usize, p: &[f64]) -> [f64; UNKNOWNS] {
        let mut own = self.fixed[cut];
        for (value, place) in own.iter_mut().zip(&self.of_cut[cut]) {
            if let Some(place) = place {
                *value = p[*place];
            }
        }
        own
    }

    /// The means known beforehand, zero elsewhere.
    pub fn centre(&self) -> Vec<f64> {
        let of = |u: &Unknown| u.prior.map_or(0.0, |p| p[0]);
        self.unknowns.iter().map(of).collect()
    }
}

fn free(kind: usize) -> Unknown {
    Unknown {
        scale: SCALES[kind],
        prior: None,
    }
}

fn known(kind: usize, mean: f64, spread: f64) -> Unknown {
    Unknown {
        scale: SCALES[kind],
        prior: Some([mean, spread]),
    }
}
