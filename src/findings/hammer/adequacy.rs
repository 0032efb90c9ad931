//! Whether anything is left, where, and what it looks like.

use super::data::{AXES, Data};
use nalgebra::DVector;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Width of the windows in which what is left is looked for, Hz.
const WINDOW_HZ: f64 = 2.0;
/// Weighted mean square in a window, against noise alone, that is no chance and no small error of the
/// model: then something is left.
const LOCAL: f64 = 4.0;
/// The same over the whole band.
const WHOLE: f64 = 2.0;

/// Probability that chance leaves so much over the whole band, below which something is left as well: among 40 tests by a stranger it was
/// above 0.8 wherever nothing was missed, and 1e-10 and 1e-19 of two of which an instrument or a knock was.
const CHANCE: f64 = 1e-6;
/// Weighted mean square that is more than what noise is known to, in long tests. A choice.
const PLAIN: f64 = 1.1;

/// What is left of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Adequacy {
    /// Weighted mean square over the whole band; 1 is noise.
    pub whole: f64,
    /// Largest weighted mean square in a window.
    pub local: f64,
    /// Middle of that window, Hz.
    pub at_hz: f64,
    /// Highest line, Hz.
    pub to_hz: f64,
    /// The pair in which it is largest, as `zz`: acceleration first.
    pub pair: String,
    /// Share of what is left that lies in that window.
    pub concentrated: f64,
    /// Probability that chance leaves so much over the whole band.
    pub p_value: f64,
}

impl Adequacy {
    /// Of weighted residuals.
    pub fn of(data: &Data, residual: &DVector<f64>) -> Self {
        let (hz, power) = (data.hz(), powers(data, residual));
        let per_line = |k: usize| power.iter().map(|p| p[k]).sum::<f64>();
        let mean = data.correlated / (2.0 * data.pairs.len().max(1) as f64);
        // whole windows: of half a one a single line at the edge of the band, where records drift, would be half
        let [from, to] = [hz.first(), hz.last()].map(|edge| edge.copied().unwrap_or(0.0));
        let reach = 0.5 * WINDOW_HZ.min(to - from);
        let whole = |middle: &&f64| **middle >= from + reach && **middle <= to - reach;
        let windows = hz.iter().filter(whole).map(|middle| {
            let inside: Vec<usize> = (0..hz.len())
                .filter(|k| (hz[*k] - middle).abs() <= reach)
                .collect();
            let sum: f64 = inside.iter().map(|k| per_line(*k)).sum();
            (
                sum * mean / inside.len().max(1) as f64,
                sum,
                *middle,
                inside,
            )
        });
        let best = windows.max_by(|a, b| a.0.total_cmp(&b.0));
        let (local, sum, at_hz, inside) = best.unwrap_or((0.0, 0.0, 0.0, Vec::new()));
        let total = residual.norm_squared();
        let strength = |p: &usize| inside.iter().map(|k| power[*p][*k]).sum::<f64>();
        let pair = (0..power.len()).max_by(|a, b| strength(a).total_cmp(&strength(b)));
        let freedom = data.freedom().max(1.0);
        let chance = ChiSquared::new(freedom).map(|d| d.sf(total));
        Self {
            whole: total / freedom,
            local,
            at_hz,
            to_hz: hz.last().copied().unwrap_or(0.0),
            pair: pair.map_or(String::new(), |p| data.name(p)),
            concentrated: sum / total.max(f64::MIN_POSITIVE),
            p_value: chance.unwrap_or(1.0),
        }
    }

    /// Whether something is left that noise and small errors of the model do not explain.
    pub fn left(&self) -> bool {
        let plain = self.whole > PLAIN && self.p_value < CHANCE;
        self.whole > WHOLE || self.local > LOCAL || plain
    }

    /// What is seen, in words.
    pub fn description(&self) -> String {
        let place = format!("{:.1} Hz, most of it in {}", self.at_hz, self.pair);
        let axis = self
            .pair
            .chars()
            .last()
            .map(String::from)
            .unwrap_or_default();
        let known = AXES.contains(&axis.as_str());
        if self.at_hz > 0.9 * self.to_hz {
            return format!(
                "an error that grows towards the upper end of the band (largest about {place}): as of a resonance above it, of the sensor's mount or of the tool"
            );
        }
        match self.concentrated > 0.35 && known {
            true => format!(
                "an extra resonance about {place}: as of a body hung up elastically (an absorber, a loose part, a hose) that swings along {axis}"
            ),
            false => format!("an error over the whole band, largest about {place}"),
        }
    }
}

/// Per pair and line the weighted square.
fn powers(data: &Data, residual: &DVector<f64>) -> Vec<Vec<f64>> {
    let lines = data.s.len();
    let at = |p: usize, k: usize| {
        let i = 2 * (p * lines + k);
        residual[i].powi(2) + residual[i + 1].powi(2)
    };
    (0..data.pairs.len())
        .map(|p| (0..lines).map(|k| at(p, k)).collect())
        .collect()
}
