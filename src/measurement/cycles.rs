//! Turning points and cycles of a load history.

use crate::ground::stats::{ends, largest};

/// A load history cut at its turning points.
#[derive(Debug, Clone, PartialEq)]
pub struct Cycles {
    /// Rows at which the load turns.
    pub turning: Vec<usize>,
    /// First rows of the cycles; a cycle runs to the next start, the last one to the end.
    pub starts: Vec<usize>,
    /// Cycle index of every row (rest before the first cycle belongs to it).
    pub of_row: Vec<usize>,
    /// First row that is loaded.
    pub first_loaded: usize,
}

/// Share of the largest load that a swing must exceed to count.
const SWING: f64 = 0.08;

impl Cycles {
    /// Finds turning points by a threshold on the swing, so that noise does not count, then cuts
    /// cycles where the load rises through its middle.
    pub fn find(load: &[f64]) -> Self {
        let largest = largest(load);
        let (low, high) = ends(load);
        let threshold = SWING * (high - low).max(0.0);
        let first_loaded = load
            .iter()
            .position(|v| v.abs() > 0.02 * largest)
            .unwrap_or(0);
        let turning = turning_points(load, threshold);
        let starts = cycle_starts(&turning, load, first_loaded);
        let of_row = rows_to_cycles(load.len(), &starts);
        Self {
            turning,
            starts,
            of_row,
            first_loaded,
        }
    }

    /// Number of cycles (at least 1).
    pub fn count(&self) -> usize {
        self.starts.len().max(1)
    }
}

fn turning_points(load: &[f64], threshold: f64) -> Vec<usize> {
    let mut turning = Vec::new();
    if threshold <= 0.0 {
        return turning;
    }
    let (mut extreme, mut rising) = (0, None);
    for (i, value) in load.iter().enumerate() {
        let swing = value - load[extreme];
        match rising {
            None if swing.abs() > threshold => {
                rising = Some(swing > 0.0);
                extreme = i;
            }
            Some(true) if swing < -threshold => {
                turning.push(extreme);
                (rising, extreme) = (Some(false), i);
            }
            Some(false) if swing > threshold => {
                turning.push(extreme);
                (rising, extreme) = (Some(true), i);
            }
            Some(up) if (swing > 0.0) == up => extreme = i,
            _ => {}
        }
    }
    turning
}

/// A cycle starts where the load passes its mid-range in the direction of the first swing.
fn cycle_starts(turning: &[usize], load: &[f64], first_loaded: usize) -> Vec<usize> {
    let mut starts = vec![first_loaded];
    let Some(first) = turning.first() else {
        return starts;
    };
    let upwards = load[*first] > load[first_loaded.saturating_sub(1)];
    for pair in turning.windows(2) {
        let rises = load[pair[1]] > load[pair[0]];
        if rises == upwards {
            let middle = 0.5 * (load[pair[0]] + load[pair[1]]);
            let crosses = |i: &usize| (load[*i] > middle) == rises;
            starts.push((pair[0]..pair[1]).find(crosses).unwrap_or(pair[1]));
        }
    }
    drop_short_end(&mut starts, load.len());
    starts
}

/// A last piece far shorter than the cycles before it belongs to the cycle before it.
fn drop_short_end(starts: &mut Vec<usize>, rows: usize) {
    if starts.len() < 3 {
        return;
    }
    let typical = starts[starts.len() - 1] - starts[starts.len() - 2];
    if rows - starts[starts.len() - 1] < typical / 2 {
        starts.pop();
    }
}

fn rows_to_cycles(rows: usize, starts: &[usize]) -> Vec<usize> {
    let mut of_row = vec![0; rows];
    for (cycle, start) in starts.iter().enumerate().skip(1) {
        of_row[*start..].iter_mut().for_each(|c| *c = cycle);
    }
    of_row
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_cycles_of_a_sine_after_rest() {
        let load: Vec<f64> = (0..1300)
            .map(|i| {
                if i < 100 {
                    0.0
                } else {
                    (f64::from(i - 100) * std::f64::consts::TAU / 400.0).sin()
                }
            })
            .collect();
        let cycles = Cycles::find(&load);
        assert_eq!(cycles.count(), 3);
        assert_eq!(cycles.turning.len(), 6);
        assert!((cycles.starts[1] as i64 - 500).abs() < 5);
    }

    #[test]
    fn a_constant_load_has_no_turning_point() {
        assert_eq!(Cycles::find(&[1.0; 50]).turning.len(), 0);
    }
}
