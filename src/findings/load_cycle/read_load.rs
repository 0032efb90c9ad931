//! What the reading of a load that goes in steps leaves open: how it was rounded, which is the same as long as it stands.

use super::families::View;
use crate::findings::engine::Nuisance;
use crate::ground::stats::{mean, quantile};
use crate::signal::lattice::{gaps, least_of};

/// Difference of loads over the largest that are one reading.
const EQUAL: f64 = 1e-6;
/// Most stands of a load, a choice for time.
const MOST: usize = 120;
/// Steps of a lattice that the load goes from one long stand to the next on average, at the least: weights that are known go one, and nothing is
/// rounded. Long is half of what nine of ten do not exceed. Choices; whether it is rounded is told by the evidence.
const WAY: f64 = 1.2;

/// Rows from which to which the load stands.
struct Stand {
    rows: std::ops::Range<usize>,
    load: f64,
}

/// Every stand of a load, of one row too.
fn stands(view: &View) -> Vec<Stand> {
    let mut all: Vec<Stand> = Vec::new();
    for (i, u) in view.u.iter().enumerate() {
        match all.last_mut().filter(|last| (last.load - u).abs() < EQUAL) {
            Some(last) => last.rows.end = i + 1,
            None => all.push(Stand {
                rows: i..i + 1,
                load: *u,
            }),
        }
    }
    all
}

/// How far readings are off where a stepped load is read in coarse steps: by one amount as long as it stands. `scale`: deflection at the largest
/// load. None: it does not go in steps, or is not read in coarser ones than those that it takes.
pub(super) fn rounding(view: &View, scale: f64) -> Vec<Nuisance> {
    let all = stands(view);
    let long: Vec<&Stand> = all.iter().filter(|s| s.rows.len() > 1).collect();
    if !view.stepped || long.len() > MOST {
        return Vec::new();
    }
    let lengths: Vec<f64> = long.iter().map(|s| s.rows.len() as f64).collect();
    let least = 0.5 * quantile(&lengths, 0.9);
    let rests = long.iter().filter(|s| s.rows.len() as f64 >= least);
    let rests: Vec<f64> = rests.map(|s| s.load).collect();
    let ways: Vec<f64> = rests.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
    let loads: Vec<f64> = long.iter().map(|s| s.load).collect();
    let Some(step) = least_of(&gaps(&loads)).filter(|step| mean(&ways) > WAY * step) else {
        return Vec::new();
    };
    // Widrow and Kollár 2008
    let spread = step * scale / 12.0_f64.sqrt();
    let own = long.into_iter();
    own.map(|s| during(view, &s.rows, spread)).collect()
}

/// One amount in some rows.
fn during(view: &View, rows: &std::ops::Range<usize>, spread: f64) -> Nuisance {
    let mut column = vec![0.0; view.rows()];
    column[rows.clone()].fill(1.0);
    Nuisance { column, spread }
}

#[cfg(test)]
mod tests {
    use super::rounding;
    use crate::findings::load_cycle::families::View;
    use crate::fit::observation::Observation;

    fn view(load: &[f64]) -> View {
        let time = (0..load.len()).map(|i| i as f64).collect();
        let reading = load.iter().map(|m| m / 1e6).collect();
        View::of(&Observation::from_channels(time, load.to_vec(), reading, 1))
    }

    /// Each load for so many rows.
    fn stair(loads: &[f64], rows: usize) -> Vec<f64> {
        let each = loads.iter().flat_map(|m| std::iter::repeat_n(*m, rows));
        each.collect()
    }

    #[test]
    fn a_load_that_goes_several_steps_at_a_time_is_rounded() {
        let loads = [
            0.0, 57.0, 95.0, 152.0, 209.0, 266.0, 209.0, 133.0, 76.0, 0.0, -57.0, -114.0, -171.0,
            -76.0,
        ];
        let found = rounding(&view(&stair(&loads, 12)), 1.0);
        assert_eq!(found.len(), loads.len());
        let spread = 19.0 / 266.0 / 12f64.sqrt();
        assert!(found.iter().all(|n| (n.spread / spread - 1.0).abs() < 1e-3));
        assert_eq!(found[1].column.iter().sum::<f64>(), 12.0);
    }

    #[test]
    fn known_weights_and_ramps_are_not() {
        let weights = [
            0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 4.0, 3.0, 2.0, 1.0, 0.0, -1.0, -2.0, -1.0,
        ];
        assert!(rounding(&view(&stair(&weights, 12)), 1.0).is_empty());
        let ramp: Vec<f64> = (0..200).map(|i| (f64::from(i) / 20.0).sin()).collect();
        assert!(rounding(&view(&ramp), 1.0).is_empty());
    }
}
