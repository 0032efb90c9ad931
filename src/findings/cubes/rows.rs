//! One row for each number that was measured; rotations times a length, so that all rows are metres.

use crate::experiments::cubes::Setup;
use crate::measurement::cubes::{CubeTest, Reading};

/// One measured number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Number of the test.
    pub test: i64,
    /// Index of the cube.
    pub cube: usize,
    /// 0 to 2: displacement along x, y, z; 3 to 5: rotation about them.
    pub component: usize,
    /// Index of its reading in the file.
    pub reading: usize,
    /// m.
    pub measured: f64,
}

pub(super) fn rows(test: &CubeTest, arm: f64) -> Vec<Row> {
    let mut rows = Vec::new();
    for (i, reading) in test.readings.iter().enumerate() {
        for (component, moved) in reading
            .moved
            .iter()
            .enumerate()
            .filter(|(_, m)| !m.is_nan())
        {
            let measured = if component < 3 { *moved } else { moved * arm };
            rows.push(Row {
                test: reading.test,
                cube: reading.cube,
                component,
                reading: i,
                measured,
            });
        }
    }
    rows
}

/// What a robot shows under the loads of a file after `change`, row by row, m.
pub(super) fn model(
    setup: &Setup,
    test: &CubeTest,
    rows: &[Row],
    arm: f64,
    change: impl Fn(Reading) -> Reading,
) -> Vec<f64> {
    let compliances: Vec<f64> = setup.sites.iter().map(|site| site.compliance).collect();
    let mut bent = None;
    let mut moved: Vec<[f64; 6]> = Vec::with_capacity(test.readings.len());
    for reading in &test.readings {
        let load = change(*reading);
        let key = (load.force, load.moment);
        if !bent.as_ref().is_some_and(|(known, _)| *known == key) {
            bent = Some((key, setup.bent(&load, &compliances)));
        }
        moved.extend(bent.iter().map(|(_, bent)| setup.moved(bent, reading.cube)));
    }
    let row =
        |row: &Row| moved[row.reading][row.component] * if row.component < 3 { 1.0 } else { arm };
    rows.iter().map(row).collect()
}
