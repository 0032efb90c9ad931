//! What is wrong with a milled part: probed deviations less those that robot and cut are simulated to leave.

mod backlash;
mod corner_lag;
mod cutting_coefficients;
mod experiment;
mod robot;
mod stations;
mod thermal_growth;
mod tool_radius;
mod workpiece_offset;
mod workpiece_rotation;

use super::engine::Blamed;
use super::table::Effect;
use crate::ground::problem::Outcome;
use crate::ground::spatial::{M3, V3, dot};
use crate::measurement::milled_part::PartTest;
use crate::process::Planned;
use crate::process::setup::{Setup, Support};
pub use stations::{Row, Station};
use stations::{compliances, grouped, placed, rows, spreads, still};

/// Effects beside the causes of the whole robot (`robot`).
pub const EFFECTS: &[Effect<Case>] = &[
    cutting_coefficients::EFFECT,
    backlash::EFFECT,
    tool_radius::EFFECT,
    workpiece_offset::EFFECT,
    workpiece_rotation::EFFECT,
    corner_lag::EFFECT,
    thermal_growth::EFFECT,
];

/// A probed part beside the simulation of its job.
pub struct Case {
    /// The file.
    pub test: PartTest,
    /// The job.
    pub planned: Planned,
    /// The job, ready to be milled.
    pub setup: Setup,
    /// Where it was probed, in the order of the file; places that are not cut are left out.
    pub stations: Vec<Station>,
    /// Its rows, one for each direction across the feed that was measured.
    pub rows: Vec<Row>,
    /// What the simulation says, row by row, m.
    pub simulated: Vec<f64>,
    /// Measured less simulated, m.
    pub missed: Vec<f64>,
    /// Standard deviation of every row: the probe's, and what a simulation of this kind leaves, m.
    pub spread: Vec<f64>,
    /// Change of every row by one of: all tangential, radial, axial cutting coefficients, all of the
    /// edge, each doubled (linearised), m.
    pub coefficients: Vec<Vec<f64>>,
    /// What springs alone leave, row by row, m: what a change is told from.
    still: Vec<f64>,
    /// Compliance of the tool at every station, m/N, workpiece frame.
    compliance: Vec<M3>,
}

/// Noise of a probe that states none, m.
const PROBE: f64 = 5e-6;

impl Case {
    /// Of a file and the job that it names.
    ///
    /// # Errors
    /// The job cannot be milled, or the file has a place that is not on its path.
    pub fn new(test: PartTest, planned: Planned) -> Outcome<Self> {
        let setup = planned.setup(None)?;
        let (milled, _) = setup.run(Support::Coupled, |_| {})?;
        let stations = placed(&test, &setup, &milled).map_err(|p| p.in_text(&test.path))?;
        let rows = rows(&stations);
        let simulated: Vec<f64> = rows
            .iter()
            .map(|row| dot(row.across, stations[row.station].deviation))
            .collect();
        let own = rows.iter().zip(&simulated);
        let missed = own.map(|(row, s)| row.measured - s).collect();
        let probe = test.facts.probe_noise.unwrap_or(PROBE);
        let (still, coefficients) = grouped(&setup, &stations, &rows)?;
        Ok(Self {
            still,
            coefficients,
            compliance: compliances(&setup, &setup.robot, &stations)?,
            spread: spreads(&stations, &rows, probe),
            missed,
            simulated,
            rows,
            stations,
            setup,
            planned,
            test,
        })
    }

    /// A column over all rows.
    fn column(&self, of: impl Fn(&Station, &Row) -> f64) -> Vec<f64> {
        let each = self.rows.iter();
        each.map(|row| of(&self.stations[row.station], row))
            .collect()
    }

    /// How much more than in first order these causes change the rows, m: the cut is milled again with them,
    /// and the force gives way.
    fn beyond_first_order(&self, about: &[Blamed]) -> Vec<f64> {
        let mut setup = self.setup.clone();
        let altered: Vec<&Blamed> = about
            .iter()
            .filter(|blamed| {
                cutting_coefficients::alter(blamed, &mut setup)
                    || robot::alter(self, blamed, &mut setup)
            })
            .collect();
        let again = match altered.is_empty() {
            true => None,
            false => still(&setup, &self.stations, &self.rows).ok(),
        };
        let Some(again) = again else {
            return vec![0.0; self.rows.len()];
        };
        let linear = |row: usize| altered.iter().map(|b| b.part[row]).sum::<f64>();
        (0..self.rows.len())
            .map(|row| again[row] - self.still[row] - linear(row))
            .collect()
    }

    /// A displacement of the tool at every station, as the rows see it.
    fn seen(&self, moved: &[V3]) -> Vec<f64> {
        let each = self.rows.iter();
        each.map(|row| dot(row.across, moved[row.station]))
            .collect()
    }
}
