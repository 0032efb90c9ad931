//! What the reading of a load that goes in steps leaves open: how it was rounded, which is the same as long as it stands.

use super::families::View;
use crate::findings::engine::Nuisance;
use crate::ground::stats::{mean, quantile};
use crate::signal::lattice::{gaps, least_of, step};

/// Difference of loads over the largest that are one reading.
const EQUAL: f64 = 1e-6;
/// Most stands of a load, a choice for time.
const MOST: usize = 120;
/// Steps of a lattice that the load goes from one long stand to the next on average, at the least: weights that are known go one, and nothing is
/// rounded. Long is half of what nine of ten do not exceed. Choices; whether it is rounded is told by the evidence.
const WAY: f64 = 1.2;

/// Share of the noise that what digits leave open must be to count, and rows for which a load that goes smoothly stands where it turns. Choices.
pub(super) const GOOD_PART: f64 = 0.25;
const TURNS: usize = 4;

/// Rows from which to which the load stands.
struct Stand {
    rows: std::ops::Range<usize>,
    load: f64,
}

/// Every stand of a load, of one row too.
fn stands(view: &View) -> Vec<Stand> {
    let mut all: Vec<Stand> = Vec::new();
    for (i, u) in view.read.iter().enumerate() {
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

/// How far readings are off where a load is read in coarse steps: by one amount as long as it stands. `scale`: deflection at the largest
/// load; `noise`: of a reading. None: it is not read in coarser steps than those that it takes.
pub(super) fn rounding(view: &View, scale: f64, noise: f64) -> Vec<Nuisance> {
    match view.stepped {
        true => of_stairs(view, scale),
        false => of_turns(view, scale, noise),
    }
}

/// Of a load that goes smoothly: it stands where it turns.
fn of_turns(view: &View, scale: f64, noise: f64) -> Vec<Nuisance> {
    let Some(spread) = open(view, scale).filter(|open| *open > GOOD_PART * noise) else {
        return Vec::new();
    };
    let all = stands(view);
    let long: Vec<&Stand> = all.iter().filter(|s| s.rows.len() >= TURNS).collect();
    match long.len() > MOST {
        true => Vec::new(),
        false => long.iter().map(|s| during(view, &s.rows, spread)).collect(),
    }
}

/// What the digits of a load that goes smoothly leave open, standard deviation in the unit of `scale`; none of one that goes in steps.
pub(super) fn open(view: &View, scale: f64) -> Option<f64> {
    let step = step(&view.read).filter(|_| !view.stepped);
    // Widrow and Kollár 2008
    step.map(|step| step * scale / 12.0_f64.sqrt())
}

/// Of a load that goes in steps.
fn of_stairs(view: &View, scale: f64) -> Vec<Nuisance> {
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
        let found = rounding(&view(&stair(&loads, 12)), 1.0, 0.01);
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
        assert!(rounding(&view(&stair(&weights, 12)), 1.0, 0.01).is_empty());
        let ramp: Vec<f64> = (0..200).map(|i| (f64::from(i) / 20.0).sin()).collect();
        assert!(rounding(&view(&ramp), 1.0, 0.01).is_empty());
    }

    #[test]
    fn a_sine_that_is_read_in_steps_is_rounded_where_it_turns() {
        let read = |i: u32| (50.0 * (f64::from(i) / 40.0).sin()).round() / 50.0;
        let load: Vec<f64> = (0..754).map(read).collect();
        let found = rounding(&view(&load), 1.0, 0.01);
        assert!(found.len() >= 6, "{}", found.len());
        let turns = |n: &&crate::findings::engine::Nuisance| {
            n.column
                .iter()
                .zip(&load)
                .any(|(c, u)| *c > 0.0 && u.abs() > 0.99)
        };
        assert!(found.iter().filter(turns).count() >= 6);
        // beside a noise that is far larger nothing is open
        assert!(rounding(&view(&load), 1.0, 0.1).is_empty());
    }
}
