//! Bends of simple form in what a line leaves: an even part, a cubic part, a loop.

use super::force_rest::{Level, Rest};

/// A cycle that has this share of a bend's squares shows it: forces differ from cycle to cycle.
const KNOWN: f64 = 0.5;

impl Rest {
    /// Shares of the even part, of the cubic part and of the loop in what the line leaves.
    pub fn bends(&self, left: &[f64], noise: f64) -> [f64; 3] {
        let basis = self.bent(noise);
        basis.map(|own| dot(&own, left))
    }

    /// Squares of the bends of single cycles about their mean, in variances of readings that are
    /// independent, and how many are free: slow noise bends more than its scatter says.
    pub fn bend_scatter(&self, left: &[f64], noise: f64) -> ([f64; 3], f64) {
        let basis = self.bent(noise);
        let mut bends: Vec<[[f64; 2]; 3]> = Vec::new();
        for cycle in 0..self.cycles {
            let mut sums = vec![[0.0; 2]; self.count.len()];
            for (i, reading) in self.readings.iter().enumerate() {
                if reading.cycle == cycle && self.kept[i] > 0.0 {
                    let own = &mut sums[self.cells[i]];
                    (own[0], own[1]) = (own[0] + left[i], own[1] + 1.0);
                }
            }
            let seen: Vec<usize> = (0..sums.len()).filter(|c| sums[*c][1] > 0.0).collect();
            let own = |c: &usize| sums[*c][0] / sums[*c][1].sqrt() / (noise * self.rise[*c]);
            let bend = |b: &Vec<f64>| {
                let known: f64 = seen.iter().map(|c| b[*c] * b[*c]).sum();
                let sum: f64 = seen.iter().map(|c| b[*c] * own(c)).sum();
                [sum / known.max(KNOWN), known]
            };
            let all = basis.each_ref().map(bend);
            let shows = |k: usize| all[k][1] > KNOWN || basis[k].iter().all(|x| *x == 0.0);
            if noise > 0.0 && (0..3).all(shows) {
                bends.push(all);
            }
        }
        let square = |k: usize| {
            let known: f64 = bends.iter().map(|b| b[k][1]).sum();
            let mean = bends.iter().map(|b| b[k][1] * b[k][0]).sum::<f64>() / known.max(KNOWN);
            let off = bends.iter().map(|b| b[k][1] * (b[k][0] - mean).powi(2));
            off.sum::<f64>()
        };
        ([0, 1, 2].map(square), (bends.len() as f64 - 1.0).max(0.0))
    }

    /// The even part, the cubic part and the loop as unit vectors over the cells, across offset and line.
    fn bent(&self, noise: f64) -> [Vec<f64>; 3] {
        let levels = self.levels();
        let largest = levels.iter().fold(1e-300, |m: f64, l| m.max(l.force.abs()));
        let weights = self.weights(noise);
        let most = weights
            .iter()
            .fold(f64::MIN_POSITIVE, |m: f64, w| m.max(*w));
        let root: Vec<f64> = weights.iter().map(|w| w / most).collect();
        let shape = |of: fn(f64, f64) -> f64| -> Vec<f64> {
            let side = |l: &Level| if l.rising { 1.0 } else { -1.0 };
            let value = |(l, n): (&Level, &f64)| n * of(l.force / largest, side(l));
            levels.iter().zip(&root).map(value).collect()
        };
        let wanted = [
            shape(|_, _| 1.0),
            shape(|f, _| f),
            shape(|f, _| f.abs()),
            shape(|f, _| f * f * f),
            shape(|_, side| side),
        ];
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for mut own in wanted {
            let size = dot(&own, &own).sqrt();
            for before in &basis {
                let share = dot(&own, before);
                own.iter_mut()
                    .zip(before)
                    .for_each(|(o, b)| *o -= share * b);
            }
            let rest = dot(&own, &own).sqrt();
            let scale = if rest > 1e-6 * size { 1.0 / rest } else { 0.0 };
            basis.push(own.iter().map(|o| o * scale).collect());
        }
        [2, 3, 4].map(|k| std::mem::take(&mut basis[k]))
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
