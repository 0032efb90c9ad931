//! The statement of a cubes test for the engine.

use super::patterns::PATTERNS;
use super::{Case, EFFECTS, floor};
use crate::findings::engine::{Aspects, Blamed, Experiment, Nuisance, Remaining, Statement, White};
use crate::findings::physics;
use crate::findings::table;
use crate::ground::stats::{self, farthest};

impl Experiment for Case {
    fn unit(&self) -> &'static str {
        "m"
    }

    /// Loads turned by degrees, and causes that multiply, are not linear.
    fn is_linear(&self) -> bool {
        false
    }

    fn is_settled(&self, before: &Statement, after: &Statement) -> bool {
        after.reads_as(before)
    }

    fn state_beside(&self, about: &[Blamed], uncertain: &[f64]) -> Statement {
        match about {
            [] => self.state(&[]),
            _ => {
                let case = self.beside(about, uncertain);
                let mut statement = case.state(&[]);
                case.whole(&mut statement);
                statement
            }
        }
    }

    fn state(&self, _: &[Blamed]) -> Statement {
        let mut suspects = floor::suspects(self);
        suspects.extend(table::suspects(EFFECTS, self));
        suspects.extend(table::patterns(PATTERNS, self));
        let known = self
            .robot
            .springs()
            .filter(|(site, _)| self.springs.contains(site));
        let springs = known.map(|(site, spring)| physics::spring(self, &site, spring));
        Statement {
            reading: self.missed.clone(),
            noise: Box::new(White {
                spread: vec![self.noise; self.rows.len()],
                rows: self.worth,
            }),
            nuisances: springs.chain(self.frame()).collect(),
            suspects,
            span: self.span(),
            splits: self.splits(),
            aspects: Aspects::default(),
        }
    }

    fn parameters(&self, blamed: &Blamed) -> Vec<(&'static str, f64, &'static str)> {
        let of_the_robot = || physics::parameters(self, blamed);
        match blamed.shape.first() {
            Some(form) if *form >= 0.0 => {
                of_the_robot().unwrap_or_else(|| table::parameters(EFFECTS, self, blamed))
            }
            _ => table::parameters(EFFECTS, self, blamed),
        }
    }

    fn would_tell(&self, rivals: &[(&'static str, String)]) -> String {
        table::would_tell_or(
            EFFECTS,
            rivals,
            "put a cube between them, or load by a moment of the bar",
        )
    }

    fn place(&self, missed: &[f64]) -> String {
        let worst = farthest(missed);
        worst.map_or("nowhere".into(), |i| {
            let row = self.rows[i];
            format!(
                "largest at cube {} in test {}",
                self.test.facts.cubes[row.cube].name, row.test
            )
        })
    }

    fn remaining(&self, left: &[f64]) -> Remaining {
        let cubes = 0..self.test.facts.cubes.len();
        let rms = |cube: usize| {
            let own: Vec<f64> = self
                .rows
                .iter()
                .zip(left)
                .filter(|(r, _)| r.cube == cube)
                .map(|(_, l)| *l)
                .collect();
            stats::rms(&own)
        };
        Remaining {
            shape: cubes.map(|cube| [cube as f64, rms(cube)]).collect(),
            over_time: Vec::new(),
            description:
                "movement of cubes that no known effect makes (over the number of the cube)".into(),
        }
    }
}

impl Case {
    /// One translation of the frame per test and direction.
    fn frame(&self) -> Vec<Nuisance> {
        let Some(spread) = self.test.facts.frame_std.filter(|s| *s > 0.0) else {
            return Vec::new();
        };
        let tests = self.tests();
        let one = |(test, k): (i64, usize)| {
            let own =
                |row: &super::Row| f64::from(u8::from(row.test == test && row.component == k));
            Nuisance {
                column: self.rows.iter().map(own).collect(),
                spread,
            }
        };
        tests
            .into_iter()
            .flat_map(|test| (0..3).map(move |k| (test, k)))
            .map(one)
            .collect()
    }

    /// Any linear answer of any cube to the sizes of the loads, by component.
    fn span(&self) -> Vec<Vec<f64>> {
        let mut span = Vec::new();
        for cube in 0..self.test.facts.cubes.len() {
            for component in 0..6 {
                let own = |row: &super::Row| {
                    f64::from(u8::from(row.cube == cube && row.component == component))
                };
                let column: Vec<f64> = self.rows.iter().map(own).collect();
                if column.contains(&1.0) {
                    for axis in 0..3 {
                        let load = |i: usize| {
                            let reading = &self.test.readings[self.rows[i].reading];
                            reading.force[axis] / 1000.0 + reading.moment[axis] / 500.0
                        };
                        span.push((0..column.len()).map(|i| column[i] * load(i)).collect());
                    }
                }
            }
        }
        span.retain(|column: &Vec<f64>| column.iter().any(|x| *x != 0.0));
        span
    }

    /// Whole tests, whole cubes, then numbers here and there.
    fn splits(&self) -> Vec<Vec<usize>> {
        let tests = self.tests();
        let of_test = |t: i64| tests.iter().position(|known| *known == t).unwrap_or(0) % 8;
        let by_test = self.rows.iter().map(|r| of_test(r.test)).collect();
        let by_cube = self.rows.iter().map(|r| r.cube % 8).collect();
        let spread = (0..self.rows.len()).map(|i| (i + i / 6) % 8).collect();
        vec![by_test, by_cube, spread]
    }
}
