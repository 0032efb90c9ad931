//! The directional matrix of milling: force per depth of cut and displacement, over a tooth passing
//! (Altintas and Budak 1995), with the lag of the helix integrated in closed form.

use super::chebyshev::Stretch;
use super::law::Material;
use super::tool::Tool;
use crate::ground::spatial::V3;

/// Teeth, their engagement, and what a chip costs.
#[derive(Debug, Clone, PartialEq)]
pub struct Directional {
    teeth: usize,
    pitch_rad: f64,
    engagement: [f64; 2],
    /// Lag over the whole depth, rad; 0: straight teeth.
    lag_rad: f64,
    /// Slopes of tangential, radial, axial force over the chip, N/m².
    slopes: [f64; 3],
}

/// Stretches shorter than this share of a tooth passing are none.
const SHORTEST: f64 = 1e-9;
/// Below this lag teeth count as straight, rad.
const STRAIGHT: f64 = 1e-6;

impl Directional {
    /// A square end with teeth that cut between two angles φ (rad), at a depth, for a mean chip.
    pub fn new(
        tool: &Tool,
        material: &Material,
        engagement: [f64; 2],
        depth_m: f64,
        chip_m: f64,
    ) -> Self {
        Self {
            teeth: tool.teeth,
            pitch_rad: tool.pitch_rad(),
            engagement,
            lag_rad: tool.lag_rad(depth_m).abs(),
            slopes: material.slope(chip_m),
        }
    }

    /// The angle of a tooth passing, rad.
    pub fn pitch_rad(&self) -> f64 {
        self.pitch_rad
    }

    /// Whether the matrix changes with the depth of cut.
    pub fn depends_on_depth(&self) -> bool {
        self.lag_rad > STRAIGHT
    }

    /// The stretches of a tooth passing: between entries and exits of edges, at tip and top.
    pub fn stretches(&self, passing_s: f64) -> Vec<Stretch> {
        let [from, to] = self.engagement;
        let mut borders = vec![0.0, self.pitch_rad];
        for border in [from, to, from + self.lag_rad, to + self.lag_rad] {
            borders.push(border.rem_euclid(self.pitch_rad));
        }
        borders.sort_by(f64::total_cmp);
        let long = |w: &&[f64]| w[1] - w[0] > SHORTEST * self.pitch_rad;
        let scale = passing_s / self.pitch_rad;
        let stretch = |w: &[f64]| {
            let middle = 0.5 * (w[0] + w[1]);
            Stretch {
                middle_s: middle * scale,
                length_s: (w[1] - w[0]) * scale,
                cutting: (0..=self.most_teeth()).any(|j| self.share(middle, middle, j).is_some()),
            }
        };
        borders.windows(2).filter(long).map(stretch).collect()
    }

    fn most_teeth(&self) -> usize {
        self.teeth + (self.lag_rad / self.pitch_rad) as usize
    }

    /// Angles between which the edge of a tooth cuts, for the spindle at θ in the stretch about `middle`.
    fn share(&self, theta: f64, middle: f64, tooth: usize) -> Option<[f64; 2]> {
        let [from, to] = self.engagement;
        let inside = |theta: f64| {
            let tip = theta + tooth as f64 * self.pitch_rad;
            [(tip - self.lag_rad).max(from), tip.min(to)]
        };
        let [low, high] = inside(middle);
        let cuts = match self.lag_rad > STRAIGHT {
            true => high > low,
            false => high >= low && middle + tooth as f64 * self.pitch_rad <= to,
        };
        cuts.then(|| inside(theta))
    }

    /// Columns x and y: force (N per m of depth and m of displacement) on the tool when the tip moves that
    /// way, for the spindle at θ (rad) in the stretch about `middle`.
    pub fn at(&self, theta: f64, middle: f64) -> [V3; 2] {
        let mut columns = [[0.0; 3]; 2];
        for tooth in 0..=self.most_teeth() {
            let Some([low, high]) = self.share(theta, middle, tooth) else {
                continue;
            };
            let phi = theta + tooth as f64 * self.pitch_rad;
            let moments = match self.lag_rad > STRAIGHT {
                true => over(low, high).map(|m| m / self.lag_rad),
                false => [
                    phi.sin().powi(2),
                    phi.sin() * phi.cos(),
                    phi.cos().powi(2),
                    phi.sin(),
                    phi.cos(),
                ],
            };
            self.add(&mut columns, moments);
        }
        columns
    }

    fn add(&self, columns: &mut [V3; 2], [ss, sc, cc, s, c]: [f64; 5]) {
        let [t, r, a] = self.slopes;
        let x = [-t * sc - r * ss, t * ss - r * sc, a * s];
        let y = [-t * cc - r * sc, t * sc - r * cc, a * c];
        for k in 0..3 {
            columns[0][k] += x[k];
            columns[1][k] += y[k];
        }
    }
}

/// Integrals of sin², sin cos, cos², sin, cos.
fn over(low: f64, high: f64) -> [f64; 5] {
    let (width, double) = (high - low, (2.0 * high).sin() - (2.0 * low).sin());
    [
        0.5 * width - 0.25 * double,
        0.25 * ((2.0 * low).cos() - (2.0 * high).cos()),
        0.5 * width + 0.25 * double,
        low.cos() - high.cos(),
        high.sin() - low.sin(),
    ]
}
