//! Whether a part shows the swing that its robot is simulated to make. Dampings come from hammer tests in other poses, or from nowhere:
//! a robot that swings less than its file says leaves a smooth surface.

use super::probe;
use super::stations::{Row, Station, spreads};
use crate::findings::table::{unit_range, waves};
use crate::measurement::milled_part::PartTest;
use nalgebra::{DMatrix, DVector};

/// Waves over the path that hold what causes do, in either direction across the feed, and those times what is simulated without a swing; where
/// there are few rows fewer of both, so that all that is smooth takes no more than half of the rows.
const SMOOTH: [usize; 2] = [10, 6];
/// Shares of the swing between which a part is taken to show none, and standard errors by which it must be beyond half of it: such a part
/// is nearer to one without. Choices, no measurement.
const MISSING: [f64; 3] = [0.6, 1.5, 3.0];
/// What is left may be so much of a noise that is stated, and of one that is not (squares) ...
const CALM: [f64; 2] = [2.0, 8.0];
/// ... or of the swing, where none is left: a part that swings at another frequency or phase lacks the simulated swing as well, and keeps its own.
const OF_SWING: f64 = 0.1;

/// What is simulated, row by row, m.
pub(super) struct Simulated<'a> {
    /// Coupled in time.
    pub coupled: &'a [f64],
    /// By springs alone.
    pub alone: &'a [f64],
}

/// What a probe is good for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Probe {
    /// Standard deviation, m.
    pub spread: f64,
    /// Whether the file says so.
    pub is_stated: bool,
}

impl Probe {
    /// That of a file.
    pub fn of(test: &PartTest) -> Self {
        Self {
            spread: probe(test),
            is_stated: test.facts.probe_noise.is_some(),
        }
    }

    /// How much of this noise may be left, squares.
    fn calm(self) -> f64 {
        CALM[usize::from(!self.is_stated)]
    }
}

/// Whether the swing that is simulated is missing from what was probed, anything smooth beside it being free: as little of that or as
/// much as so many rows can tell.
pub(super) fn is_still(
    (stations, rows): (&[Station], &[Row]),
    simulated: &Simulated,
    probe: Probe,
) -> bool {
    let spread = spreads(stations, rows, probe.spread, 0.0);
    let less = |k: usize| SMOOTH.map(|count| (count * (SMOOTH[0] - k)).div_ceil(SMOOTH[0]));
    let sets = (0..SMOOTH[0]).map(|k| columns((stations, rows), simulated, less(k)));
    let few = |columns: &Vec<Vec<f64>>| 2 * columns.len() <= rows.len();
    let misses = rows.iter().zip(simulated.coupled);
    let misses: Vec<f64> = misses.map(|(row, s)| row.measured - s).collect();
    let calm = probe.calm();
    sets.filter(few)
        .any(|columns| lacks_first(&misses, &columns, &spread, calm))
}

/// Whether what is missed is the first of these columns, and nothing much besides all of them.
fn lacks_first(missed: &[f64], columns: &[Vec<f64>], spread: &[f64], calm: f64) -> bool {
    let white = |c: &[f64]| {
        let each = c.iter().zip(spread);
        DVector::from_iterator(c.len(), each.map(|(v, s)| v / s))
    };
    let reading = white(missed);
    let white: Vec<DVector<f64>> = columns.iter().map(|c| white(c).normalize()).collect();
    let matrix = DMatrix::from_columns(&white);
    let free = reading.len() - columns.len();
    let mut inner = matrix.tr_mul(&matrix);
    (0..columns.len()).for_each(|i| inner[(i, i)] += 1e-9);
    let Some(root) = inner.cholesky() else {
        return false;
    };
    let amounts = root.solve(&matrix.tr_mul(&reading));
    let left = (&reading - &matrix * &amounts).norm_squared() / free as f64;
    let unit = length(&columns[0], spread);
    let missing = amounts[0] / unit;
    let error = (left * root.inverse()[(0, 0)]).sqrt() / unit;
    is_none([missing, error]) && is_calm(left, unit * unit / missed.len() as f64, calm)
}

/// Whether all of the swing is missing; `missing`: a share and its standard error.
fn is_none([missing, error]: [f64; 2]) -> bool {
    let [least, most, sure] = MISSING;
    missing > least && missing < most && missing - 0.5 > sure * error
}

/// Whether what is left is little; all of it mean squares in noise deviations.
fn is_calm(left: f64, swing: f64, calm: f64) -> bool {
    left < calm.max(OF_SWING * swing)
}

/// Whether a part that springs alone were taken to carry lacks the swing, so much of it being found beside causes, and so much left.
pub(super) fn lacks_swing(
    shown: f64,
    [swing, left]: [&[f64]; 2],
    (spread, probe): (&[f64], Probe),
) -> bool {
    let mean = |column: &[f64]| length(column, spread).powi(2) / column.len() as f64;
    let [swing, left] = [mean(swing), mean(left)];
    let error = (left / (swing * spread.len() as f64)).sqrt();
    is_none([1.0 - shown, error]) && is_calm(left, swing, probe.calm())
}

fn length(column: &[f64], spread: &[f64]) -> f64 {
    let each = column.iter().zip(spread);
    each.map(|(c, s)| (c / s).powi(2)).sum::<f64>().sqrt()
}

/// First what the swing adds less, then a workpiece that stands elsewhere, and so many waves.
fn columns(
    (stations, rows): (&[Station], &[Row]),
    simulated: &Simulated,
    count: [usize; 2],
) -> Vec<Vec<f64>> {
    let each = simulated.alone.iter().zip(simulated.coupled);
    let swing: Vec<f64> = each.map(|(alone, coupled)| alone - coupled).collect();
    let along: Vec<f64> = rows.iter().map(|r| stations[r.station].s_m).collect();
    let over = unit_range(&along);
    let mut all = vec![swing];
    all.extend((0..3).map(|k| rows.iter().map(|row| row.across[k]).collect()));
    let level = vec![1.0; rows.len()];
    for wave in waves(&over, count[0]).into_iter().chain([level.clone()]) {
        for wall in [true, false] {
            let own = wave.iter().zip(rows);
            all.push(
                own.map(|(w, r)| if r.left == wall { *w } else { 0.0 })
                    .collect(),
            );
        }
    }
    for wave in waves(&over, count[1]).into_iter().chain([level]) {
        let own = wave.iter().zip(simulated.alone);
        all.push(own.map(|(w, s)| w * s).collect());
    }
    all.retain(|c| c.iter().any(|x| *x != 0.0));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    fn still(share: f64) -> bool {
        still_as(|i, swing| share * swing(i))
    }

    fn still_as(own: impl Fn(usize, &dyn Fn(usize) -> f64) -> f64) -> bool {
        among(150, own)
    }

    fn among(count: usize, own: impl Fn(usize, &dyn Fn(usize) -> f64) -> f64) -> bool {
        let mut random = Random::new(5);
        let station = |i: usize| Station::at_rest(1e-3 * i as f64);
        let stations: Vec<Station> = (0..count).map(station).collect();
        let alone: Vec<f64> = (0..count).map(|i| 2e-4 + 1e-6 * i as f64).collect();
        let swing = |i: usize| 4e-5 * (1.7 * i as f64).sin();
        let coupled: Vec<f64> = (0..count).map(|i| alone[i] + swing(i)).collect();
        // a joint softer by a tenth beside it
        let row = |i: usize| Row {
            station: i,
            across: [0.0, 1.0, 0.0],
            left: true,
            measured: 1.1 * alone[i] + own(i, &swing) + 4e-6 * random.normal(),
        };
        let rows: Vec<Row> = (0..count).map(row).collect();
        let simulated = Simulated {
            coupled: &coupled,
            alone: &alone,
        };
        is_still(
            (&stations, &rows),
            &simulated,
            Probe {
                spread: 4e-6,
                is_stated: true,
            },
        )
    }

    #[test]
    fn a_part_without_the_swing_is_told_from_one_with_a_little_less() {
        assert!(still(0.0));
        assert!(still(0.2));
        assert!(!still(0.8));
        assert!(!still(1.3));
        assert!(!still(-1.0));
    }

    #[test]
    fn a_few_rows_tell_it_as_well() {
        assert!(among(24, |_, _| 0.0));
        assert!(!among(24, |i, swing| swing(i)));
        assert!(!among(24, |i, _| 4e-5 * (1.7 * i as f64).cos()));
    }

    #[test]
    fn a_part_that_swings_otherwise_is_not_still() {
        assert!(!still_as(|i, _| 4e-5 * (1.9 * i as f64).sin()));
        assert!(!still_as(|i, _| 4e-5 * (1.7 * i as f64).cos()));
    }
}
