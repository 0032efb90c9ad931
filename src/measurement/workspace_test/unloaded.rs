//! Files that hold one force a set-up and cycle: their displacements count from the unloaded robot.

use super::Step;
use std::collections::BTreeMap;

/// Forces of one cycle that differ by less than this share of the largest are one force: a load cell scatters by
/// thousandths, and nobody steps by so little.
const ONE_FORCE: f64 = 0.02;
/// Readings at one force scatter by less than this share of the displacement: where they do not, the force was changed
/// and its channel did not tell.
const ONE_DISPLACEMENT: f64 = 0.5;

/// The steps with the unloaded robot before every cycle, where no cycle of the file changes its force; `None` where
/// one does, and where displacements show that the force changed untold.
pub(super) fn with_unloaded(steps: &[Step]) -> Option<Vec<Step>> {
    let mut cycles: BTreeMap<(usize, usize, i64), Vec<Step>> = BTreeMap::new();
    for step in steps {
        let key = (step.point, step.direction, step.cycle);
        cycles.entry(key).or_default().push(*step);
    }
    cycles.values().all(|own| is_one(own)).then(|| {
        let whole = cycles.into_values();
        whole
            .flat_map(|own| std::iter::once(before(&own)).chain(own))
            .collect()
    })
}

/// Whether these steps are one load.
fn is_one(own: &[Step]) -> bool {
    let [low, high] = extremes(own.iter().map(|s| s.force));
    let one_force = high - low <= ONE_FORCE * low.abs().max(high.abs());
    let still = |k: usize| {
        let [low, high] = extremes(
            own.iter()
                .map(|s| s.displacement[k])
                .filter(|d| !d.is_nan()),
        );
        (low <= high).then(|| [high - low, low.abs().max(high.abs())])
    };
    let each: Vec<[f64; 2]> = (0..3).filter_map(still).collect();
    let largest = |k: usize| each.iter().map(|e| e[k]).fold(0.0, f64::max);
    one_force && high.abs() > 0.0 && largest(0) <= ONE_DISPLACEMENT * largest(1)
}

fn extremes(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| {
        [a.min(x), b.max(x)]
    })
}

/// The unloaded robot before a cycle, in the components that were measured.
fn before(own: &[Step]) -> Step {
    let measured = |k: usize| own.iter().any(|s| !s.displacement[k].is_nan());
    Step {
        force: 0.0,
        displacement: [0, 1, 2].map(|k| if measured(k) { 0.0 } else { f64::NAN }),
        ..own[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(cycle: i64, force: f64, dx: f64) -> Step {
        Step {
            point: 0,
            direction: 0,
            cycle,
            force,
            displacement: [dx, f64::NAN, 0.1 * dx],
        }
    }

    #[test]
    fn one_force_counts_from_the_unloaded_robot() {
        let steps = [step(1, 100.0, 1e-4), step(2, 100.2, 1.01e-4)];
        let all = with_unloaded(&steps).unwrap();
        let forces: Vec<f64> = all.iter().map(|s| s.force).collect();
        assert_eq!(forces, [0.0, 100.0, 0.0, 100.2]);
        assert!(all[0].displacement[0] == 0.0 && all[0].displacement[1].is_nan());
    }

    #[test]
    fn a_file_with_steps_keeps_its_own_zero() {
        let steps = [
            step(1, 100.0, 1e-4),
            step(1, 200.0, 2e-4),
            step(2, 100.0, 1e-4),
        ];
        assert!(with_unloaded(&steps).is_none());
    }

    #[test]
    fn a_force_channel_that_stands_still_while_the_robot_moves_is_no_single_force() {
        let steps = [
            step(1, 100.0, 0.0),
            step(1, 100.0, 1e-4),
            step(1, 100.0, 2e-4),
        ];
        assert!(with_unloaded(&steps).is_none());
        assert!(with_unloaded(&[step(1, 0.0, 1e-4)]).is_none());
    }
}
