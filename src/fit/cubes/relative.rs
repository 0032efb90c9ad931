//! What happens between subsequent cubes: how far one turned against the other, and the moment there.

use crate::experiments::cubes::Setup;
use crate::ground::spatial::V3;
use crate::measurement::cubes::{CubeTest, Reading};

/// Two subsequent cubes under one load, base frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Relative {
    /// Index of the file.
    pub file: usize,
    /// Number of the test.
    pub test: i64,
    /// The cube nearer to the foundation.
    pub from: String,
    /// The next cube.
    pub to: String,
    /// Rotation of the second against the first, rad; NaN where not measured.
    pub rotation: V3,
    /// Displacement of the second against a point that the first would carry there, m; NaN where not measured.
    pub shift: V3,
    /// Moment of the load about `about`, N·m.
    pub moment: V3,
    /// The last hinge between the two, or half way where there is none, m.
    pub about: V3,
}

/// All pairs of all tests, in the order of the files; repeated readings of a cube count once, with their mean.
pub fn relative(tests: &[CubeTest], setups: &[Setup]) -> Vec<Relative> {
    let mut out = Vec::new();
    for (file, (test, setup)) in tests.iter().zip(setups).enumerate() {
        let mut order: Vec<usize> = (0..test.facts.cubes.len()).collect();
        order.sort_by_key(|cube| setup.hinges_before(*cube));
        let mut numbers: Vec<i64> = Vec::new();
        for reading in &test.readings {
            if !numbers.contains(&reading.test) {
                numbers.push(reading.test);
            }
        }
        for number in numbers {
            let own: Vec<&Reading> = test.readings.iter().filter(|r| r.test == number).collect();
            let there: Vec<(usize, [f64; 6])> = order
                .iter()
                .filter_map(|cube| Some((*cube, mean(&own, *cube)?)))
                .collect();
            for pair in there.windows(2) {
                out.push(between(file, test, setup, own[0], [pair[0], pair[1]]));
            }
        }
    }
    out
}

fn mean(own: &[&Reading], cube: usize) -> Option<[f64; 6]> {
    let list: Vec<&&Reading> = own.iter().filter(|r| r.cube == cube).collect();
    let component = |c: usize| list.iter().map(|r| r.moved[c]).sum::<f64>() / list.len() as f64;
    (!list.is_empty()).then(|| std::array::from_fn(component))
}

fn between(
    file: usize,
    test: &CubeTest,
    setup: &Setup,
    reading: &Reading,
    [a, b]: [(usize, [f64; 6]); 2],
) -> Relative {
    let (from, to) = (&test.facts.cubes[a.0], &test.facts.cubes[b.0]);
    let lever: V3 = std::array::from_fn(|k| to.centre[k] - from.centre[k]);
    let turn = [a.1[3], a.1[4], a.1[5]];
    let carried = crate::ground::spatial::cross(turn, lever);
    let about = setup.between(a.0, b.0);
    Relative {
        file,
        test: reading.test,
        from: from.name.clone(),
        to: to.name.clone(),
        rotation: std::array::from_fn(|k| b.1[3 + k] - a.1[3 + k]),
        shift: std::array::from_fn(|k| b.1[k] - a.1[k] - carried[k]),
        moment: setup.moment_about(reading, about),
        about,
    }
}
