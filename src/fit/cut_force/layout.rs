//! Which unknown stands where: coefficients and runout are common, the nuisance belongs to cuts.

use super::CutData;
use crate::cutting::wave::Side;
use crate::experiments::milling_force::{BANDWIDTH, BORDER, PHASE, RUNOUT, SPEED, UNKNOWNS, WIDTH};

/// Spread of the logarithm of a stated bandwidth.
pub const BANDWIDTH_STD: f64 = 0.2;
/// Spread of a stated spindle speed.
pub(super) const SPEED_STD: f64 = 1e-3;
/// Spread of either part of the runout, m: no clamped tool runs worse. It closes what two teeth leave open.
pub(super) const RUNOUT_STD: f64 = 5e-5;
/// Spread of a stated width of cut, m.
const WIDTH_STD: f64 = 2e-5;

/// Share of the ray before the border of the stock that counts as chip: none by geometry, all of it where the
/// free face gives way; which of both is not known beforehand. Its mean and standard deviation.
pub const BORDER_SHARE: [f64; 2] = [0.5, 0.5];

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

/// Where the unknowns stand that all cuts share besides the coefficients.
struct Common {
    runout: [Option<usize>; 2],
    bandwidth: Option<usize>,
    border: Option<usize>,
}

const SCALES: [f64; UNKNOWNS] = [
    1e8, 1e8, 1e8, 1e4, 1e4, 1e4, 1e-6, 1e-6, 0.1, 1e-2, 1e-4, 1e-5, 0.1,
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
        let [share, spread] = BORDER_SHARE;
        let bordered = |c: &CutData| c.scene.cut.side != Side::Slot;
        let border = cuts.iter().any(bordered);
        let border = border.then(|| layout.add(known(BORDER, share, spread)));
        let common = Common {
            runout: [runout, second],
            bandwidth,
            border,
        };
        for cut in cuts {
            layout.add_cut(cut, &common);
        }
        layout
    }

    fn add(&mut self, unknown: Unknown) -> usize {
        self.unknowns.push(unknown);
        self.unknowns.len() - 1
    }

    fn add_cut(&mut self, cut: &CutData, common: &Common) {
        let width = cut.scene.cut.width_m;
        let mut places = [None; UNKNOWNS];
        (0..6).for_each(|k| places[k] = Some(k));
        (places[RUNOUT], places[RUNOUT + 1]) = (common.runout[0], common.runout[1]);
        places[BANDWIDTH] = common.bandwidth.filter(|_| cut.scene.low_pass);
        places[PHASE] = Some(self.add(free(PHASE)));
        places[SPEED] = Some(self.add(known(SPEED, 0.0, SPEED_STD)));
        if cut.scene.cut.side != Side::Slot {
            places[WIDTH] = Some(self.add(known(WIDTH, width, WIDTH_STD)));
            places[BORDER] = common.border;
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
