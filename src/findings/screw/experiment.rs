//! The statement of a screw test for the engine.

use super::patterns::PATTERNS;
use super::{Case, EFFECTS, wear_zone};
use crate::findings::engine::{
    Aspects, Blamed, Experiment, Nuisance, Remaining, Statement, Suspect, White,
};
use crate::findings::table;
use crate::fit::screw::positions::in_mm;
use crate::ground::stats::farthest;
use crate::sheet::number::fixed;

impl Experiment for Case {
    fn unit(&self) -> &'static str {
        "m"
    }

    /// The place of a worn zone is not linear.
    fn is_linear(&self) -> bool {
        false
    }

    fn state(&self, about: &[Blamed]) -> Statement {
        let (noise, worth) = self.noise;
        Statement {
            reading: self.deviation.clone(),
            noise: Box::new(White {
                spread: vec![noise; self.rows()],
                rows: worth,
            }),
            // where the scale has its zero is nobody's fault
            nuisances: vec![Nuisance {
                column: vec![1.0; self.rows()],
                spread: f64::INFINITY,
            }],
            suspects: self.suspects(about),
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
        let target = worst.map_or(0.0, |i| self.test.readings[i].target);
        format!("largest at {} mm", fixed(in_mm(target), 1))
    }

    fn remaining(&self, left: &[f64]) -> Remaining {
        let mut shape: Vec<[f64; 2]> = Vec::new();
        for (reading, left) in self.test.readings.iter().zip(left) {
            match shape.iter_mut().find(|p| p[0] == reading.target) {
                Some(point) => point[1] += left,
                None => shape.push([reading.target, *left]),
            }
        }
        let count = |x: f64| self.test.readings.iter().filter(|r| r.target == x).count() as f64;
        shape.iter_mut().for_each(|p| p[1] /= count(p[0]));
        shape.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Remaining {
            shape,
            over_time: Vec::new(),
            description: "an error over the travel that no known effect has".into(),
        }
    }
}

impl Case {
    /// Everybody, a worn zone that was found with its neighbours in place and width.
    fn suspects(&self, about: &[Blamed]) -> Vec<Suspect> {
        let mut suspects = table::suspects(EFFECTS, self);
        for suspect in &mut suspects {
            let found = about.iter().find(|b| b.effect == suspect.effect);
            if let Some(zone) = found.filter(|b| b.effect == wear_zone::EFFECT.name) {
                suspect.members = wear_zone::about(self, &zone.shape);
            }
        }
        suspects.extend(table::patterns(PATTERNS, self));
        suspects
    }

    /// Any smooth error over the travel, over the way forth and back, and over the order of the readings.
    fn span(&self) -> Vec<Vec<f64>> {
        let u = table::unit_range(&self.at);
        let targets = self.targets();
        let mut span = table::waves(&u, (targets / 2).clamp(2, 36));
        for wave in table::waves(&u, (targets / 4).clamp(1, 12)) {
            span.push(
                wave.iter()
                    .zip(&self.side)
                    .map(|(w, s)| w * 2.0 * s)
                    .collect(),
            );
        }
        span.extend(table::waves(&self.progress, 6));
        span
    }

    /// Whole runs, then every fifth target of a run in another rhythm each.
    fn splits(&self) -> Vec<Vec<usize>> {
        let runs = self.runs();
        let of_run = |run: i64| runs.iter().position(|r| *r == run).unwrap_or(0);
        let by_run: Vec<usize> = self.test.readings.iter().map(|r| of_run(r.run)).collect();
        let spread: Vec<usize> = (0..self.rows()).map(|i| (i + i / 5) % 8).collect();
        match runs.len() {
            0..3 => vec![spread],
            _ => vec![by_run, spread],
        }
    }
}
