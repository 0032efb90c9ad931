//! How far the simulation is off, and what is left, in numbers and words.

use super::adequacy::{Adequacy, Squares};
use super::case::Case;
use super::set::Set;
use crate::findings::answer::{Discrepancy, Structure};
use crate::ground::stats::rms;
use crate::measurement::workspace_test::DIRECTIONS;

impl Case<'_> {
    pub(super) fn adequacy(&self, set: &Set) -> Adequacy {
        let mut left = self.readings.clone();
        let columns = self.columns_of(set);
        for (column, amount) in columns.iter().zip(self.amounts(set)) {
            left.axpy(-amount, &self.columns.column(*column), 1.0);
        }
        let n = self.slopes();
        let levels = left.rows(n, self.levels).norm_squared();
        let bends = |c: &&usize| !self.seats.columns[**c].pattern.left.is_empty();
        let bent = columns.iter().filter(bends).count() as f64;
        let all = self.springs.left(&left);
        Adequacy::of(
            Squares {
                sum: all - levels,
                freedom: (n as f64 - columns.len() as f64).max(1.0),
            },
            Squares {
                sum: levels,
                freedom: (self.shapes.freedom() - bent).max(1.0),
            },
            self.field.base,
            (
                self.shapes.bends(left.rows(n, self.levels).as_slice()),
                self.shapes.wander.iter().fold(0.0, |m, w| w.max(m)),
            ),
        )
    }

    pub(super) fn discrepancy(&self) -> Discrepancy {
        let mut worst = (0.0, String::new());
        let (mut squares, mut count) = (0.0, 0.0);
        for setup in &self.shapes.setups {
            let simulated = self.scene.base.slopes[setup.point][setup.direction];
            for k in 0..3 {
                let Some(line) = setup.lines[k] else { continue };
                let error = (line.slope - simulated[k]) * self.force();
                squares += error * error;
                count += 1.0;
                if error.abs() > worst.0 {
                    let (p, d) = (setup.point + 1, DIRECTIONS[setup.direction]);
                    let along = match k == setup.direction {
                        true => String::new(),
                        false => format!(" under force in {d}"),
                    };
                    worst = (
                        error.abs(),
                        format!("largest at point {p} in {}{along}", DIRECTIONS[k]),
                    );
                }
            }
        }
        Discrepancy {
            rms: (squares / f64::max(count, 1.0)).sqrt(),
            noise_rms: self.unit(),
            place: worst.1,
        }
    }

    pub(super) fn structure(
        &self,
        chosen: &Set,
        adequacy: &Adequacy,
        strange: Option<usize>,
    ) -> Structure {
        let explained = self.explained(chosen);
        let mut shape = Vec::new();
        let mut worst = (0.0, String::new());
        for (i, setup) in self.shapes.setups.iter().enumerate() {
            let Some(line) = setup.lines[setup.direction] else {
                continue;
            };
            let own = explained[setup.point][setup.direction][setup.direction];
            let left = (line.slope - own) * self.force();
            shape.push([i as f64 + 1.0, left]);
            if left.abs() > worst.0 {
                let place = format!(
                    "point {} in {}",
                    setup.point + 1,
                    DIRECTIONS[setup.direction]
                );
                worst = (left.abs(), place);
            }
        }
        let description = match strange {
            Some(seat) => {
                let own = &self.seats.seats[seat];
                format!("as if {} {}.", own.site, own.cause.card().summary)
            }
            None if adequacy.wanders() => "a zero that moves from cycle to cycle.".to_string(),
            None if adequacy.is_bent() => {
                "displacement that is not in proportion to the force.".to_string()
            }
            None => format!(
                "stiffness that depends on the posture in its own way, most at {}.",
                worst.1
            ),
        };
        Structure {
            share_of_variance: adequacy.share,
            shape,
            over_time: Vec::new(),
            description,
        }
    }

    pub(super) fn noise(&self) -> String {
        let used: Vec<f64> = self
            .shapes
            .noise
            .iter()
            .copied()
            .filter(|n| *n > 0.0)
            .collect();
        let rms = rms(&used);
        let repeatability = self.test.facts.setup_repeatability;
        let shared = repeatability.map_or("no stated repeatability".to_string(), |r| {
            format!("{:.1} % of every set-up", 100.0 * r)
        });
        format!("{:.1} µm a reading and {shared}", 1e6 * rms)
    }
}
