//! Whether a part shows the swing that its robot is simulated to make. Dampings come from hammer tests in other poses, or from nowhere:
//! a robot that swings less than its file says leaves a smooth surface.

use super::noise::Uneven;
use super::probe;
use super::stations::{Row, Station, spreads};
use crate::findings::engine::{Alone, Nuisance, Statement};
use crate::findings::table::{unit_range, waves};
use crate::ground::stats::{difference, rms};
use crate::measurement::milled_part::PartTest;

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
    let sets = (0..SMOOTH[0]).map(|k| smooth((stations, rows), simulated.alone, less(k)));
    let few = |smooth: &Vec<Vec<f64>>| 2 * (smooth.len() + 1) <= rows.len();
    let misses = rows.iter().zip(simulated.coupled);
    let misses: Vec<f64> = misses.map(|(row, s)| row.measured - s).collect();
    let less = difference(simulated.alone, simulated.coupled);
    let beside = |smooth: Vec<Vec<f64>>| {
        let noise = Uneven {
            spread: spread.clone(),
            rows: 0.0,
        };
        let free = smooth.into_iter().map(|column| Nuisance {
            column,
            spread: f64::INFINITY,
        });
        Statement {
            nuisances: free.collect(),
            ..Statement::bare(misses.clone(), Box::new(noise))
        }
    };
    sets.filter(few)
        .any(|smooth| lacks(&beside(smooth), &less, probe))
}

/// Whether what is missed is all of a swing (`less`: what its absence adds), and nothing much besides what is uncertain.
pub(super) fn lacks(missed: &Statement, less: &[f64], probe: Probe) -> bool {
    let alone = Alone::of(missed, less);
    let Some([missing, error]) = alone.amount else {
        return false;
    };
    let [least, most, sure] = MISSING;
    let error = error * alone.left.max(1.0).sqrt();
    let is_none = missing > least && missing < most && missing - 0.5 > sure * error;
    let swing = rms(&missed.noise.whiten(less)).powi(2);
    is_none && alone.left < probe.calm(swing, missed.noise.spread())
}

/// A workpiece that stands elsewhere, so many waves in either direction, and so many times what is simulated without a swing.
fn smooth(
    (stations, rows): (&[Station], &[Row]),
    alone: &[f64],
    count: [usize; 2],
) -> Vec<Vec<f64>> {
    let along: Vec<f64> = rows.iter().map(|r| stations[r.station].s_m).collect();
    let over = unit_range(&along);
    let datum = (0..3).map(|k| rows.iter().map(|row| row.across[k]).collect());
    let mut all: Vec<Vec<f64>> = datum.collect();
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
        let own = wave.iter().zip(alone);
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
    fn what_may_as_well_be_something_else_is_not_missing() {
        let probe = Probe {
            spread: 1.0,
            is_stated: true,
        };
        let swing: Vec<f64> = (0..40).map(|i| 5.0 * (1.7 * f64::from(i)).sin()).collect();
        let lacking = |spread: f64| {
            let noise = Uneven {
                spread: vec![1.0; 40],
                rows: 0.0,
            };
            let like = Nuisance {
                column: swing.clone(),
                spread,
            };
            let missed = Statement {
                nuisances: vec![like],
                ..Statement::bare(swing.clone(), Box::new(noise))
            };
            lacks(&missed, &swing, probe)
        };
        assert!(lacking(0.01));
        assert!(!lacking(1.0));
    }

    #[test]
    fn a_part_that_swings_otherwise_is_not_still() {
        assert!(!still_as(|i, _| 4e-5 * (1.9 * i as f64).sin()));
        assert!(!still_as(|i, _| 4e-5 * (1.7 * i as f64).cos()));
    }
}
