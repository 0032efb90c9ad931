//! What the resolution of a sensor does to force steps: a reading is off by up to half a step, the same in every
//! cycle that repeats the load unless the noise is about as large.

use crate::measurement::workspace_test::WorkspaceTest;
use crate::signal::lattice::{gaps, least_of, step_of};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Step of the readings, m; zero where none shows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Rounding {
    step: f64,
}

impl Rounding {
    /// Of every component of a test. Cycles are looked at one by one, each has its own zero, unless all count from the unloaded robot:
    /// the only distance in a cycle is the displacement then.
    pub fn of(test: &WorkspaceTest) -> [Self; 3] {
        [0, 1, 2].map(|component| {
            let mut cycles: BTreeMap<Option<(usize, usize, i64)>, Vec<f64>> = BTreeMap::new();
            for step in &test.steps {
                let own = (step.point, step.direction, step.cycle);
                let own = cycles.entry((!test.from_unloaded).then_some(own));
                own.or_default().push(step.displacement[component]);
            }
            let mut all: Vec<f64> = cycles.values().flat_map(|values| gaps(values)).collect();
            let step = step_of(&mut all).or_else(|| least_of(&all));
            Self {
                step: step.unwrap_or(0.0),
            }
        })
    }

    /// Standard deviation of the error of one reading, m (Widrow and Kollár 2008: step over √12).
    pub fn error(self) -> f64 {
        self.step / 12.0_f64.sqrt()
    }

    /// Standard deviation of the part of it that repeated readings share, m, where these scatter by `scatter`: noise
    /// larger than half a step averages the rest out (Widrow and Kollár 2008, the first term of the series).
    pub fn shared(self, scatter: f64) -> f64 {
        if self.step <= 0.0 {
            return 0.0;
        }
        let noise = (scatter.powi(2) - self.error().powi(2)).max(0.0) / self.step.powi(2);
        self.error() * (-2.0 * PI * PI * noise).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::table::Table;

    /// One force a cycle: the displacement itself is the only distance in a cycle, and no step of the gauge.
    #[test]
    fn one_force_a_cycle_shows_the_step_of_the_gauge() {
        let mut text = "# kind = \"workspace\"\n# robot = \"kr210\"\n# joint_angles_deg = [[0.0, -85.0, 95.0, 0.0, 75.0, 0.0]]\npoint,direction,cycle,force_N,dx_mm,dy_mm,dz_mm\n".to_string();
        for (i, read) in [0.56, -0.56, 0.57, -0.56, 0.55, -0.57].iter().enumerate() {
            let force = if *read > 0.0 { 350.0 } else { -350.0 };
            text += &format!("1,x,{},{force},{read},,\n", i + 1);
        }
        let table = Table::from_reader("w.csv".as_ref(), text.as_bytes(), text.len() as u64);
        let test = WorkspaceTest::from_table(table.unwrap()).unwrap();
        assert!(test.from_unloaded);
        let step = Rounding::of(&test)[0].step;
        assert!((step / 1e-5 - 1.0).abs() < 1e-6, "{step}");
    }

    #[test]
    fn noise_larger_than_a_step_averages_rounding_out() {
        let coarse = Rounding { step: 1e-5 };
        assert!((coarse.shared(0.0) / coarse.error() - 1.0).abs() < 1e-12);
        assert!(coarse.shared(1e-5) < 1e-6 * coarse.error());
        assert_eq!(Rounding::default().shared(1e-6), 0.0);
    }
}
