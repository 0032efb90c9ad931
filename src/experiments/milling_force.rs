//! What a dynamometer should have read in a straight cut: the wave form of the force at every sample,
//! with its slopes over all that may be unknown.

mod place;

use super::around::Passage;
use super::resonance::Resonant;
use crate::cutting::tool::Tool;
use crate::cutting::wave::{Basis, Cut, Side, Wave, force};
use crate::ground::dual::{Dual, Scalar};
use crate::ground::spatial::{V3, add, scale};
use crate::measurement::milling_force::{CutFacts, CutSide, Facts};
use place::Place;
use std::f64::consts::TAU;

/// Unknowns of one cut, in the order of the slopes: six coefficients (Ktc, Krc, Kac, Kte, Kre, Kae; SI),
/// runout along tooth 1 and a quarter turn on (m), logarithm of the bandwidth, angle of tooth 1 at the
/// first sample (rad), relative error of the spindle speed, width (m), share of the ray before the border of
/// the stock that counts as chip.
pub const UNKNOWNS: usize = 13;
/// Place of the first part of the runout.
pub const RUNOUT: usize = 6;
/// Place of the logarithm of the bandwidth.
pub const BANDWIDTH: usize = 8;
/// Place of the angle of tooth 1 at the first sample.
pub const PHASE: usize = 9;
/// Place of the relative error of the spindle speed.
pub const SPEED: usize = 10;
/// Place of the width.
pub const WIDTH: usize = 11;

/// Place of the share of the ray before the border of the stock that counts as chip.
pub const BORDER: usize = 12;

/// Steps by which a stamp may stray from its clock: half a step is the next reading's.
const STRAY: f64 = 0.5;
/// Teeth are straight below this lag along the edge of one cut, rad.
const STRAIGHT: f64 = 2e-3;
/// Fewest samples of a revolution that is low-passed, of teeth along a helix and of straight ones, whose force jumps; the most;
/// and how many there are to an oscillation at the corner. Forces are exact to 1.2e-3.
const GRID: [usize; 2] = [360, 1440];
const GRID_MOST: usize = 11_520;
const PER_OSCILLATION: f64 = 32.0;

/// One cut with its samples.
#[derive(Debug, Clone)]
pub struct CutScene {
    /// The tool, without runout.
    pub tool: Tool,
    /// The cut as the file states it.
    pub cut: Cut,
    /// Times of the samples from the first, s.
    pub time: Vec<f64>,
    /// Whether a low pass stands between the force and the file.
    pub low_pass: bool,
    /// Whether the sensor rings.
    pub resonant: Option<Resonant>,
    /// By how much each tooth is shorter than the others along its whole edge, m; empty: none is.
    pub shorter: Vec<f64>,
    /// The same from the tip up to [`CutScene::chipped_to_m`] alone.
    pub chipped: Vec<f64>,
    /// Height up to which teeth are chipped, m.
    pub chipped_to_m: f64,
    /// Lag of the edge along one disc, rad: how finely the edges are sliced.
    pub slice_rad: f64,
}

/// Forces at the samples, N, and their slopes over the [`UNKNOWNS`].
#[derive(Debug, Clone)]
pub struct Predicted {
    /// On the tool, cut frame.
    pub force: Vec<V3>,
    /// Per unknown and sample; empty if not asked for.
    pub slopes: Vec<Vec<V3>>,
}

/// The tool of a file, without runout.
pub fn tool(facts: &Facts) -> Tool {
    Tool::square(0.5 * facts.diameter_m, facts.teeth, facts.helix_rad)
}

/// A cut of a file.
pub fn cut(facts: &CutFacts) -> Cut {
    Cut {
        spindle_rad_s: facts.spindle_rad_s,
        feed_m_s: facts.feed_m_s,
        depth_m: facts.depth_m,
        width_m: facts.width_m,
        side: match facts.side {
            CutSide::Slot => Side::Slot,
            CutSide::Up => Side::Up,
            CutSide::Down => Side::Down,
        },
    }
}

type D = Dual<5>;

impl CutScene {
    /// Forces and slopes at `p`, in the order of [`UNKNOWNS`].
    pub fn predict(&self, p: &[f64; UNKNOWNS]) -> Predicted {
        match self.is_direct() {
            true => self.ideal(p),
            false => self.filtered(p),
        }
    }

    /// Whether the force jumps: teeth that are straight, and nothing that spreads their entry.
    pub fn jumps(&self) -> bool {
        self.is_direct() && self.is_straight()
    }

    /// Step of the clock of the samples, s; `None`: they follow none. Stamps that are rounded, or shake, stay near it.
    pub fn step_s(&self) -> Option<f64> {
        let mean = self.time.last()? / (self.time.len().max(2) - 1) as f64;
        let is_near = |(i, t): (usize, &f64)| (t - i as f64 * mean).abs() < STRAY * mean;
        (mean > 0.0 && self.time.iter().enumerate().all(is_near)).then_some(mean)
    }

    fn is_straight(&self) -> bool {
        self.tool.helix_rad.tan().abs() * self.cut.depth_m < STRAIGHT * self.tool.radius_m
    }

    /// Whether the file holds the force itself.
    pub fn is_direct(&self) -> bool {
        !self.low_pass && self.resonant.is_none()
    }

    /// Forces at `p` without their slopes, N: a fraction of the work.
    pub fn force(&self, p: &[f64; UNKNOWNS]) -> Vec<V3> {
        self.force_of(p, |chip| chip)
    }

    /// The same where the force stands to some function of the chip's thickness (m) as to the thickness itself.
    pub fn force_of(&self, p: &[f64; UNKNOWNS], chip: impl Fn(f64) -> f64) -> Vec<V3> {
        if !self.is_direct() {
            return self.read_of(p, self.grid(p), chip);
        }
        let wave = self.wave(p, |value, _| value);
        let at = |angle: f64| force(&wave.basis_of(angle, 0.0, &chip), &p[..6]);
        self.angles(p).into_iter().map(at).collect()
    }

    /// The same by a revolution of this many samples behind the instrument.
    fn read_of(&self, p: &[f64; UNKNOWNS], grid: usize, chip: impl Fn(f64) -> f64) -> Vec<V3> {
        let wave = self.wave(p, |value, _| value);
        let step = TAU / grid as f64;
        let at = |i: usize| force(&wave.basis_of(i as f64 * step, step, &chip), &p[..6]);
        let passed = self
            .passage(p, grid)
            .plain(&(0..grid).map(at).collect::<Vec<_>>());
        let angles = self.angles(p).into_iter();
        angles
            .map(|angle| Place::of(angle, grid).read(&passed))
            .collect()
    }

    /// Angle of tooth 1 at every sample, rad.
    pub fn angles(&self, p: &[f64; UNKNOWNS]) -> Vec<f64> {
        let rate = self.cut.spindle_rad_s * (1.0 + p[SPEED]);
        self.time.iter().map(|t| p[PHASE] + rate * t).collect()
    }

    /// The cut at `p`, whose runout, width and border are scalars of their own by number.
    pub fn wave<S: Scalar>(
        &self,
        p: &[f64; UNKNOWNS],
        unknown: impl Fn(f64, usize) -> S,
    ) -> Wave<'_, S> {
        let runout = [0, 1].map(|k| unknown(p[RUNOUT + k], k));
        // the table feeds as stated, however fast the spindle turns
        let cut = Cut {
            spindle_rad_s: self.cut.spindle_rad_s * (1.0 + p[SPEED]),
            ..self.cut
        };
        Wave::sliced(
            (&self.tool, self.slice_rad),
            &cut,
            runout,
            unknown(p[WIDTH], 2),
        )
        .before_the_border(unknown(p[BORDER], 4))
        .shorter(&self.shorter, f64::INFINITY)
        .shorter(&self.chipped, self.chipped_to_m)
    }

    fn ideal(&self, p: &[f64; UNKNOWNS]) -> Predicted {
        let wave = self.wave(p, D::variable);
        let mut predicted = Predicted::zeros(self.time.len());
        for (i, angle) in self.angles(p).into_iter().enumerate() {
            let basis = wave.basis(D::variable(angle, 3), 0.0);
            let f = force(&basis, &p[..6]);
            predicted.set(i, &basis, p, &f);
            predicted.slopes[PHASE][i] = f.map(|part| part.eps[3]);
        }
        predicted.turning(self)
    }

    /// Samples of a revolution.
    fn grid(&self, p: &[f64; UNKNOWNS]) -> usize {
        let own = self
            .resonant
            .map_or(0.0, |resonant| resonant.resonance.at[0]);
        let corner = self.corner(p).unwrap_or(0.0);
        let fewest = PER_OSCILLATION * corner.max(own) * TAU / self.cut.spindle_rad_s;
        let mut grid = GRID[usize::from(self.is_straight())];
        while grid < GRID_MOST && (grid as f64) < fewest {
            grid *= 2;
        }
        grid
    }

    fn corner(&self, p: &[f64; UNKNOWNS]) -> Option<f64> {
        self.low_pass.then(|| p[BANDWIDTH].exp())
    }

    /// The instrument for a revolution of this many samples.
    fn passage(&self, p: &[f64; UNKNOWNS], grid: usize) -> Passage {
        let hertz = self.cut.spindle_rad_s / TAU;
        Passage::new(grid, hertz, self.corner(p), self.resonant)
    }

    fn filtered(&self, p: &[f64; UNKNOWNS]) -> Predicted {
        let wave = self.wave(p, D::variable);
        let grid = self.grid(p);
        let step = TAU / grid as f64;
        let mut around = Predicted::zeros(grid);
        for i in 0..grid {
            let basis = wave.basis(D::constant(i as f64 * step), step);
            around.set(i, &basis, p, &force(&basis, &p[..6]));
        }
        let passed = Predicted::passed(&around, &self.passage(p, grid));
        let mut predicted = Predicted::zeros(self.time.len());
        for (i, angle) in self.angles(p).into_iter().enumerate() {
            let place = Place::of(angle, grid);
            predicted.force[i] = place.read(&passed.force);
            for (own, from) in predicted.slopes.iter_mut().zip(&passed.slopes) {
                own[i] = place.read(from);
            }
        }
        predicted.turning(self)
    }
}

impl Predicted {
    fn zeros(samples: usize) -> Self {
        Self {
            force: vec![[0.0; 3]; samples],
            slopes: vec![vec![[0.0; 3]; samples]; UNKNOWNS],
        }
    }

    /// A sample, apart from what its angle does.
    fn set(&mut self, i: usize, basis: &Basis<D>, p: &[f64; UNKNOWNS], f: &[D; 3]) {
        let speed = 1.0 + p[SPEED];
        for k in 0..3 {
            self.force[i][k] = f[k].re;
            for (j, sums) in basis.iter().enumerate() {
                self.slopes[j][i][k] = sums[k].re;
            }
            self.slopes[RUNOUT][i][k] = f[k].eps[0];
            self.slopes[RUNOUT + 1][i][k] = f[k].eps[1];
            self.slopes[WIDTH][i][k] = f[k].eps[2];
            self.slopes[BORDER][i][k] = f[k].eps[4];
            // a faster spindle takes thinner chips but for what runout makes of them, to first order of the feed
            let of_chip: f64 = (0..3).map(|j| p[j] * basis[j][k].re).sum();
            let of_runout = p[RUNOUT] * f[k].eps[0] + p[RUNOUT + 1] * f[k].eps[1];
            self.slopes[SPEED][i][k] = (of_runout - of_chip) / speed;
        }
    }

    /// The slope over the speed with what the angles of the teeth do: the later, the more.
    fn turning(mut self, scene: &CutScene) -> Self {
        for (i, time) in scene.time.iter().enumerate() {
            let turned = scale(scene.cut.spindle_rad_s * time, self.slopes[PHASE][i]);
            self.slopes[SPEED][i] = add(self.slopes[SPEED][i], turned);
        }
        self
    }

    /// One revolution behind an instrument.
    fn passed(around: &Self, pass: &Passage) -> Self {
        let mut passed = Self::zeros(around.force.len());
        let [plain, slower, turned] = pass.with_slopes(&around.force);
        passed.force = plain;
        passed.slopes[BANDWIDTH] = slower;
        passed.slopes[PHASE] = turned;
        for j in [0, 1, 2, 3, 4, 5, RUNOUT, RUNOUT + 1, SPEED, WIDTH, BORDER] {
            let own = &around.slopes[j];
            if own.iter().flatten().any(|x| *x != 0.0) {
                passed.slopes[j] = pass.plain(own);
            }
        }
        passed
    }
}

#[cfg(test)]
mod tests;
