//! The statement of a force-sensor test for the engine.

use super::patterns::PATTERNS;
use super::{Case, EFFECTS};
use crate::findings::engine::{Aspects, Blamed, Experiment, Nuisance, Remaining, Statement, White};
use crate::findings::table;
use crate::fit::force_sensor::remainder::terms;
use crate::ground::stats::farthest;

/// Relative standard deviation of a nominal weight and centre where none is stated.
const USUAL: f64 = 0.01;
/// Centres are known to this at best, m.
const PLACE: f64 = 5e-4;

impl Experiment for Case {
    fn unit(&self) -> &'static str {
        "N"
    }

    /// Turns of some degrees, and two causes that multiply, are not linear.
    fn is_linear(&self) -> bool {
        false
    }

    fn is_settled(&self, before: &Statement, after: &Statement) -> bool {
        after.reads_as(before)
    }

    fn state_beside(&self, about: &[Blamed], uncertain: &[f64]) -> Statement {
        self.beside(about, uncertain).state(&[])
    }

    fn state(&self, _: &[Blamed]) -> Statement {
        let (noise, worth) = self.noise;
        Statement {
            reading: self.missed.clone(),
            noise: Box::new(White {
                spread: vec![noise; self.rows()],
                rows: worth,
            }),
            nuisances: self.nuisances(),
            suspects: [
                table::suspects(EFFECTS, self),
                table::patterns(PATTERNS, self),
            ]
            .concat(),
            span: self.span(),
            splits: self.splits(),
            aspects: Aspects::default(),
        }
    }

    fn parameters(&self, blamed: &Blamed) -> Vec<(&'static str, f64, &'static str)> {
        table::parameters(EFFECTS, self, blamed)
    }

    fn would_tell(&self, rivals: &[(&'static str, String)]) -> String {
        table::would_tell(EFFECTS, rivals)
    }

    fn place(&self, missed: &[f64]) -> String {
        let worst = farthest(missed);
        let point = worst.map_or(0, |row| self.points.1[self.points.0[row / 6]]);
        format!("largest at point {point}")
    }

    fn remaining(&self, left: &[f64]) -> Remaining {
        let size = |i: usize| (0..3).map(|c| left[6 * i + c].powi(2)).sum::<f64>().sqrt();
        Remaining {
            shape: (0..self.test.readings.len()).map(|i| [(i + 1) as f64, size(i)]).collect(),
            over_time: Vec::new(),
            description: "a load over the orientations that no known effect has (size over the number of the reading)".into(),
        }
    }
}

impl Case {
    /// Weight and centre within what is stated; without a statement, anything.
    fn nuisances(&self) -> Vec<Nuisance> {
        let rel = self.test.facts.nominal_rel_std.unwrap_or(USUAL);
        let spread = |j: usize| match (j, self.stated) {
            (0, [true, _]) => rel * self.nominal[0],
            (1..4, [_, true]) => (rel * self.nominal[j].abs()).max(PLACE),
            _ => f64::INFINITY,
        };
        (0..4)
            .map(|j| Nuisance {
                column: self.parameter(j),
                spread: spread(j),
            })
            .collect()
    }

    /// Products of terms of the quaternion (degree four), by channel, and waves over the order.
    fn span(&self) -> Vec<Vec<f64>> {
        let readings = &self.test.readings;
        let quartic = |i: usize, k: usize, l: usize| {
            let t = terms(readings[i].quaternion);
            t[k] * t[l]
        };
        let mut span = Vec::new();
        for own in 0..6 {
            for k in 0..10 {
                let pair = (k * 7 + 3 * own) % 10;
                span.push(self.column(|i, c| {
                    if c == own {
                        quartic(i, k, k.max(pair))
                    } else {
                        0.0
                    }
                }));
            }
        }
        for wave in table::waves(&self.progress, 4) {
            for own in 0..3 {
                span.push(self.column(|i, c| if c == own { wave[i] } else { 0.0 }));
            }
        }
        span.retain(|column: &Vec<f64>| column.iter().any(|x| *x != 0.0));
        span
    }

    /// Whole points, then channels here and there.
    fn splits(&self) -> Vec<Vec<usize>> {
        let by_point = (0..self.rows())
            .map(|row| self.points.0[row / 6] % 8)
            .collect();
        let spread = (0..self.rows()).map(|row| (row + row / 6) % 6).collect();
        vec![by_point, spread]
    }
}
