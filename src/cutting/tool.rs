//! The milling tool: its teeth, their helix, the round of its end, its runout; cut into discs.

use super::chip::Tip;
use super::law::Direction;
use crate::ground::dual::Scalar;
use std::f64::consts::{FRAC_PI_2, TAU};

/// A milling tool. Angles in rad, lengths in m.
#[derive(Debug, Clone, PartialEq)]
pub struct Tool {
    /// Radius of the shaft.
    pub radius_m: f64,
    /// Number of teeth, evenly spaced.
    pub teeth: usize,
    /// Helix angle, positive right-handed.
    pub helix_rad: f64,
    /// Radius of the corner: 0 a square end, the tool's radius a ball end.
    pub corner_radius_m: f64,
    /// Length of the flutes.
    pub flute_m: f64,
    /// Distance of the tool's axis from the spindle's.
    pub runout_m: f64,
    /// Direction of that distance, from tooth 1 at the tip in the sense of rotation.
    pub runout_angle_rad: f64,
}

/// A slice of the tool across its axis, as the cut sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// Height of its middle above the tip, m.
    pub z_m: f64,
    /// Its thickness, m.
    pub height_m: f64,
    /// Radius at its middle without runout, m.
    pub radius_m: f64,
    /// Length of edge in the disc, da = dz / sin κ, m.
    pub edge_m: f64,
    /// sin κ, cos κ of the surface normal to the axis.
    pub normal: [f64; 2],
    /// Angle by which its edges lag those at the tip, rad.
    pub lag_rad: f64,
    /// Angle over which the lag is spread in the disc, rad.
    pub lag_width_rad: f64,
}

/// Largest angle of the surface normal and of the lag within a disc, rad: forces are those of its middle, to 8e-5. With twice as
/// much, coefficients are off by 3e-4, which shows in long records.
pub const FINE: f64 = 0.03;

impl Tool {
    /// A square end without runout.
    pub fn square(radius_m: f64, teeth: usize, helix_rad: f64) -> Self {
        Self {
            radius_m,
            teeth,
            helix_rad,
            corner_radius_m: 0.0,
            flute_m: f64::INFINITY,
            runout_m: 0.0,
            runout_angle_rad: 0.0,
        }
    }

    /// The angle from tooth to tooth, rad.
    pub fn pitch_rad(&self) -> f64 {
        TAU / self.teeth as f64
    }

    /// Lag of the edge at height z above the tip, rad: z tan β / R.
    pub fn lag_rad(&self, z_m: f64) -> f64 {
        z_m * self.helix_rad.tan() / self.radius_m
    }

    /// The discs from the tip up to `depth_m`, fine enough that mean forces do not depend on their
    /// number: round ends are cut evenly in κ, so that the tip of a ball keeps its edge.
    pub fn discs(&self, depth_m: f64) -> Vec<Disc> {
        self.discs_of(depth_m, FINE)
    }

    /// The same along each of which the edge lags by so much (rad) at most.
    pub fn discs_of(&self, depth_m: f64, fine: f64) -> Vec<Disc> {
        let round = self.corner_radius_m.min(depth_m);
        let mut discs = self.round_discs(round, fine);
        let straight = depth_m - round;
        let count = self.count_over(straight, fine);
        let height = straight / count as f64;
        let middle = |i: usize| round + (i as f64 + 0.5) * height;
        if straight > 0.0 {
            discs.extend((0..count).map(|i| self.disc(middle(i), height, 1.0)));
        }
        discs
    }

    fn count_over(&self, height_m: f64, fine: f64) -> usize {
        ((self.lag_rad(height_m).abs() / fine).ceil() as usize).clamp(1, 1000)
    }

    fn round_discs(&self, height_m: f64, fine: f64) -> Vec<Disc> {
        let rc = self.corner_radius_m;
        if rc <= 0.0 || height_m <= 0.0 {
            return Vec::new();
        }
        let last = (1.0 - height_m / rc).clamp(-1.0, 1.0).acos();
        let steps = ((last / fine).ceil() as usize).max(self.count_over(height_m, fine));
        let kappa = |i: f64| last * i / steps as f64;
        let of = |i: usize| {
            let (low, high) = (kappa(i as f64), kappa(i as f64 + 1.0));
            let height = rc * (low.cos() - high.cos());
            let (sin, cos) = (0.5 * (low + high)).sin_cos();
            let z = rc * (1.0 - cos);
            Disc {
                z_m: z,
                height_m: height,
                radius_m: self.radius_m - rc + rc * sin,
                edge_m: rc * (high - low),
                normal: [sin, cos],
                lag_rad: self.lag_rad(z),
                lag_width_rad: self.lag_rad(height).abs(),
            }
        };
        (0..steps).map(of).collect()
    }

    fn disc(&self, z_m: f64, height_m: f64, sin: f64) -> Disc {
        let cos = (1.0 - sin * sin).max(0.0).sqrt();
        Disc {
            z_m,
            height_m,
            radius_m: self.radius_at(z_m),
            edge_m: height_m / sin,
            normal: [sin, cos],
            lag_rad: self.lag_rad(z_m),
            lag_width_rad: self.lag_rad(height_m).abs(),
        }
    }

    /// Radius at height z above the tip without runout, m.
    pub fn radius_at(&self, z_m: f64) -> f64 {
        let rc = self.corner_radius_m;
        self.radius_m - rc + rc * self.sin_normal(z_m)
    }

    /// sin κ at height z above the tip: 1 on the shaft.
    pub fn sin_normal(&self, z_m: f64) -> f64 {
        let rc = self.corner_radius_m;
        if z_m >= rc {
            return 1.0;
        }
        let cos = (rc - z_m.max(0.0)) / rc;
        (1.0 - cos * cos).max(0.0).sqrt()
    }

    /// Angle φ of a tooth (from 0) in a disc when tooth 1 stands at `spindle_rad` at the tip.
    pub fn tooth_angle(&self, spindle_rad: f64, tooth: usize, disc: &Disc) -> f64 {
        spindle_rad + tooth as f64 * self.pitch_rad() - disc.lag_rad
    }

    /// Real radius of a tooth (from 0) in a disc: the nominal one and its share of the runout, m.
    pub fn tooth_radius(&self, disc: &Disc, tooth: usize) -> f64 {
        let (sin, cos) = self.runout_angle_rad.sin_cos();
        self.tooth_radius_of(disc, tooth, [self.runout_m * cos, self.runout_m * sin])
    }

    /// The same with the runout as a vector: its parts along tooth 1 at the tip, and a quarter turn
    /// further in the sense of rotation.
    pub fn tooth_radius_of<S: Scalar>(&self, disc: &Disc, tooth: usize, runout: [S; 2]) -> S {
        let (sin, cos) = (tooth as f64 * self.pitch_rad() - disc.lag_rad).sin_cos();
        runout[0] * cos + runout[1] * sin + disc.radius_m
    }

    /// Where the tip of a tooth really is: the tool's axis stands off the spindle's by the runout, so the
    /// tip is farther out and, by the part across, ahead of its tooth angle.
    pub fn tip<S: Scalar>(&self, disc: &Disc, tooth: usize, runout: [S; 2]) -> Tip<S> {
        let (sin, cos) = (tooth as f64 * self.pitch_rad() - disc.lag_rad).sin_cos();
        let across = runout[1] * cos - runout[0] * sin;
        Tip {
            radius: self.tooth_radius_of(disc, tooth, runout)
                + across * across / (2.0 * disc.radius_m),
            aside: across / disc.radius_m,
        }
    }

    /// Whether the corner is no larger than the tool.
    pub fn is_possible(&self) -> bool {
        let angles = self.helix_rad.abs() < FRAC_PI_2;
        let lengths = self.radius_m > 0.0 && self.flute_m > 0.0 && self.runout_m >= 0.0;
        angles && lengths && self.teeth > 0 && (0.0..=self.radius_m).contains(&self.corner_radius_m)
    }
}

impl Disc {
    /// How an edge of this disc stands at tooth angle φ.
    pub fn direction(&self, phi: f64) -> Direction {
        let (sin, cos) = phi.sin_cos();
        Direction {
            tooth: [sin, cos],
            normal: self.normal,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_end_has_a_quarter_circle_of_edge() {
        let ball = Tool {
            corner_radius_m: 8e-3,
            ..Tool::square(8e-3, 2, 0.5)
        };
        let discs = ball.discs(8e-3);
        let edge: f64 = discs.iter().map(|d| d.edge_m).sum();
        let height: f64 = discs.iter().map(|d| d.height_m).sum();
        assert!((edge - FRAC_PI_2 * 8e-3).abs() < 1e-12 && (height - 8e-3).abs() < 1e-12);
        assert!((discs.last().unwrap().radius_m - 8e-3).abs() < 1e-5);
    }

    #[test]
    fn runout_moves_opposite_teeth_apart() {
        let tool = Tool {
            runout_m: 10e-6,
            runout_angle_rad: 0.3,
            ..Tool::square(8e-3, 2, 0.0)
        };
        let disc = tool.discs(1e-3)[0];
        let [a, b] = [0, 1].map(|j| tool.tooth_radius(&disc, j) - 8e-3);
        assert!((a + b).abs() < 1e-15 && (a - 10e-6 * 0.3_f64.cos()).abs() < 1e-15);
    }
}
