//! Whether a part shows the swing that its robot is simulated to make. Dampings come from hammer tests in other poses, or from nowhere:
//! a robot that swings less than its file says leaves a smooth surface.

use super::stations::{Row, Station, spreads};
use crate::findings::table::{unit_range, waves};
use nalgebra::{DMatrix, DVector};

/// Waves over the path that hold what causes do, in either direction across the feed, and those times what is simulated without a swing.
const SMOOTH: [usize; 2] = [10, 6];
/// Shares of the swing between which a part is taken to show none, and standard errors by which it must be beyond half of it: such a part
/// is nearer to one without. Choices, no measurement.
const MISSING: [f64; 3] = [0.6, 1.5, 3.0];
/// What is left may be so much of a stated noise (squares), or of the swing, where none is left: a part that swings at another frequency
/// or phase lacks the simulated swing as well, and keeps its own.
const CALM: [f64; 2] = [2.0, 0.1];

/// What is simulated, row by row, m.
pub(super) struct Simulated<'a> {
    /// Coupled in time.
    pub coupled: &'a [f64],
    /// By springs alone.
    pub alone: &'a [f64],
}

/// Whether the swing that is simulated is missing from what was probed, anything smooth beside it being free.
pub(super) fn is_still(
    (stations, rows): (&[Station], &[Row]),
    simulated: &Simulated,
    probe: f64,
) -> bool {
    let spread = spreads(stations, rows, probe, 0.0);
    let columns = columns(stations, rows, simulated);
    let white = |c: &[f64]| {
        let each = c.iter().zip(&spread);
        DVector::from_iterator(c.len(), each.map(|(v, s)| v / s))
    };
    let misses = rows.iter().zip(simulated.coupled);
    let misses: Vec<f64> = misses.map(|(row, s)| row.measured - s).collect();
    let reading = white(&misses);
    let white: Vec<DVector<f64>> = columns.iter().map(|c| white(c).normalize()).collect();
    let matrix = DMatrix::from_columns(&white);
    let free = reading.len().saturating_sub(columns.len());
    let mut inner = matrix.tr_mul(&matrix);
    (0..columns.len()).for_each(|i| inner[(i, i)] += 1e-9);
    let Some(root) = inner.cholesky().filter(|_| free > 0) else {
        return false;
    };
    let amounts = root.solve(&matrix.tr_mul(&reading));
    let left = (&reading - &matrix * &amounts).norm_squared() / free as f64;
    let unit = length(&columns[0], &spread);
    let (missing, error) = (
        amounts[0] / unit,
        (left * root.inverse()[(0, 0)]).sqrt() / unit,
    );
    let [least, most, sure] = MISSING;
    let is_none = missing > least && missing < most && missing - 0.5 > sure * error;
    is_none && left < CALM[0].max(CALM[1] * unit * unit / rows.len() as f64)
}

fn length(column: &[f64], spread: &[f64]) -> f64 {
    let each = column.iter().zip(spread);
    each.map(|(c, s)| (c / s).powi(2)).sum::<f64>().sqrt()
}

/// First what the swing adds less, then all that is smooth.
fn columns(stations: &[Station], rows: &[Row], simulated: &Simulated) -> Vec<Vec<f64>> {
    let each = simulated.alone.iter().zip(simulated.coupled);
    let swing: Vec<f64> = each.map(|(alone, coupled)| alone - coupled).collect();
    let along: Vec<f64> = rows.iter().map(|r| stations[r.station].s_m).collect();
    let over = unit_range(&along);
    let mut all = vec![swing];
    let level = vec![1.0; rows.len()];
    for wave in waves(&over, SMOOTH[0]).into_iter().chain([level.clone()]) {
        for wall in [true, false] {
            let own = wave.iter().zip(rows);
            all.push(
                own.map(|(w, r)| if r.left == wall { *w } else { 0.0 })
                    .collect(),
            );
        }
    }
    for wave in waves(&over, SMOOTH[1]).into_iter().chain([level]) {
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
        let mut random = Random::new(5);
        let station = |i: usize| Station::at_rest(1e-3 * i as f64);
        let stations: Vec<Station> = (0..150).map(station).collect();
        let alone: Vec<f64> = (0..150).map(|i| 2e-4 + 1e-6 * f64::from(i)).collect();
        let swing = |i: usize| 4e-5 * (1.7 * i as f64).sin();
        let coupled: Vec<f64> = (0..150).map(|i| alone[i] + swing(i)).collect();
        // a joint softer by a tenth beside it
        let row = |i: usize| Row {
            station: i,
            across: [0.0, 1.0, 0.0],
            left: true,
            measured: 1.1 * alone[i] + own(i, &swing) + 4e-6 * random.normal(),
        };
        let rows: Vec<Row> = (0..150).map(row).collect();
        let simulated = Simulated {
            coupled: &coupled,
            alone: &alone,
        };
        is_still((&stations, &rows), &simulated, 4e-6)
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
    fn a_part_that_swings_otherwise_is_not_still() {
        assert!(!still_as(|i, _| 4e-5 * (1.9 * i as f64).sin()));
        assert!(!still_as(|i, _| 4e-5 * (1.7 * i as f64).cos()));
    }
}
