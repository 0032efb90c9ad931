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
/// What is left may be so much of the noise (squares), and of the swing beside the probe's own noise: a part that swings at another frequency or
/// phase lacks the simulated swing as well, and keeps its own. Choices, no measurement.
const CALM: f64 = 2.0;
const BESIDE_PROBE: f64 = 0.5;
/// ... or of the swing alone, where a noise is stated and where none is. Choices, no measurement.
const OF_SWING: [f64; 2] = [0.1, 0.25];

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

    /// How much may be left beside so large a swing: mean squares, in deviations of the rows.
    fn calm(self, swing: f64, spread: &[f64]) -> f64 {
        let own = spread.iter().map(|s| (self.spread / s).powi(2));
        let own = own.sum::<f64>() / spread.len() as f64;
        let of_swing = OF_SWING[usize::from(!self.is_stated)] * swing;
        of_swing.max(CALM.min(own + BESIDE_PROBE * swing))
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
    let free = |columns: Vec<Vec<f64>>| -> Vec<Column> {
        let each = columns.into_iter();
        each.map(|column| (column, f64::INFINITY)).collect()
    };
    sets.filter(few)
        .any(|columns| lacks_first(&misses, &free(columns), &spread, probe))
}

/// What one of something adds, and how much of it there is before the data (standard deviation).
pub(super) type Column = (Vec<f64>, f64);

/// Whether what is missed is the first of these columns, and nothing much besides all of them.
pub(super) fn lacks_first(
    missed: &[f64],
    columns: &[Column],
    spread: &[f64],
    probe: Probe,
) -> bool {
    let white = |c: &[f64]| {
        let each = c.iter().zip(spread);
        DVector::from_iterator(c.len(), each.map(|(v, s)| v / s))
    };
    let reading = white(missed);
    let lengths: Vec<f64> = columns.iter().map(|c| length(&c.0, spread)).collect();
    let each = columns.iter().zip(&lengths);
    let units: Vec<DVector<f64>> = each.map(|(c, length)| white(&c.0) / *length).collect();
    let matrix = DMatrix::from_columns(&units);
    let gram = matrix.tr_mul(&matrix);
    let mut inner = gram.clone();
    for (i, (column, length)) in columns.iter().zip(&lengths).enumerate() {
        inner[(i, i)] += 1e-9 + (column.1 * length).powi(-2);
    }
    let Some(root) = inner.cholesky() else {
        return false;
    };
    let inverse = root.inverse();
    let amounts = &inverse * matrix.tr_mul(&reading);
    let free = reading.len() as f64 - (&inverse * gram).trace();
    let left = (&reading - &matrix * &amounts).norm_squared() / free.max(1.0);
    let unit = lengths[0];
    let missing = amounts[0] / unit;
    let error = (left.max(1.0) * inverse[(0, 0)]).sqrt() / unit;
    let [least, most, sure] = MISSING;
    let is_none = missing > least && missing < most && missing - 0.5 > sure * error;
    is_none && left < probe.calm(unit * unit / missed.len() as f64, spread)
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
        let station = |i: usize| Station::plain(1e-3 * i as f64);
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
    fn a_column_with_a_prior_takes_no_more_than_it_may() {
        let probe = Probe {
            spread: 1.0,
            is_stated: true,
        };
        let swing: Vec<f64> = (0..40).map(|i| 5.0 * (1.7 * f64::from(i)).sin()).collect();
        let spread = vec![1.0; 40];
        let lacks = |like: f64| {
            let columns = [(swing.clone(), f64::INFINITY), (swing.clone(), like)];
            lacks_first(&swing, &columns, &spread, probe)
        };
        assert!(lacks(0.01));
        // what may as well be the other says nothing
        assert!(!lacks(1.0));
    }

    #[test]
    fn a_part_that_swings_otherwise_is_not_still() {
        assert!(!still_as(|i, _| 4e-5 * (1.9 * i as f64).sin()));
        assert!(!still_as(|i, _| 4e-5 * (1.7 * i as f64).cos()));
    }
}
