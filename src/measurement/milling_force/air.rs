//! Where a record begins before the tool is in the stock, or runs on after it has left.

use super::{CutFacts, FEWEST_ROWS, Record};
use crate::ground::spatial::{V3, norm, sub};
use crate::ground::stats::{median, quantile, rms};
use std::f64::consts::TAU;
use std::ops::Range;

/// Fewest rows of a stretch of whole turns that is looked at.
const ROWS: f64 = 16.0;
/// Share of the force by which readings may scatter in air, and by which they may differ from one turn to the next there. A choice.
const QUIET: f64 = 0.15;
const STILL: f64 = 0.02;
/// Share of the force that readings in air, which a zero may shift, stay below: what is as large is a steady cut. A choice.
const SHIFTED: f64 = 0.25;
/// Share of the force by which the mean of whole turns leaves that of air: a cut that begins to chatter keeps its own. A choice.
const PUSHED: f64 = 0.05;
/// Turns that must be left in the stock.
const TURNS: f64 = 2.0;

/// The rows in which the tool is in the stock as far as it ever is. It is on its way there, and out, for as long as it feeds its radius.
pub(super) fn in_stock(record: &Record, cut: &CutFacts, radius_m: f64) -> Range<usize> {
    let whole = 0..record.time.len();
    let (Some(first), Some(last)) = (record.time.first(), record.time.last()) else {
        return whole;
    };
    let turn = TAU / cut.spindle_rad_s;
    let step = (last - first) / (record.time.len() - 1) as f64;
    let stretch = turn * (ROWS * step / turn).ceil();
    let way = radius_m / cut.feed_m_s + stretch;
    let air = |from_end| {
        let air = air(&stretches(record, stretch, from_end), record);
        air.map_or(0.0, |count| count as f64 * stretch + way)
    };
    let [begin, end] = [first + air(false), last - air(true)];
    let rows = |t: f64| record.time.partition_point(|own| *own < t);
    let kept = rows(begin)..rows(end).max(rows(begin)) + usize::from(end == *last);
    match end - begin > TURNS * turn && kept.len() >= FEWEST_ROWS {
        true => kept,
        false => whole,
    }
}

/// Readings over whole turns: their mean, and how far they are from it, N.
struct Stretch {
    mean: V3,
    scatter: f64,
    size: f64,
}

/// One after the other, from either end, with its number.
fn stretches(record: &Record, length: f64, from_end: bool) -> Vec<(usize, Stretch)> {
    let (first, last) = (record.time[0], record.time[record.time.len() - 1]);
    let count = ((last - first) / length) as usize;
    let rows = |t: f64| record.time.partition_point(|own| *own < t);
    let one = |k: usize| {
        let [near, far] = [k, k + 1].map(|k| k as f64 * length);
        let rows = match from_end {
            true => rows(last - far)..rows(last - near),
            false => rows(first + near)..rows(first + far),
        };
        (!rows.is_empty()).then(|| (k, Stretch::of(&record.force[rows])))
    };
    (0..count).filter_map(one).collect()
}

impl Stretch {
    fn of(force: &[V3]) -> Self {
        let mean = [0, 1, 2].map(|k| {
            let sum: f64 = force.iter().map(|f| f[k]).sum();
            sum / force.len() as f64
        });
        Self {
            mean,
            scatter: beside(force, mean),
            size: beside(force, [0.0; 3]),
        }
    }
}

/// How far forces are from one, N rms.
fn beside(force: &[V3], from: V3) -> f64 {
    rms(&force
        .iter()
        .map(|f| norm(sub(*f, from)))
        .collect::<Vec<_>>())
}

/// Stretches in air from the end that they begin at; none: the tool is in the stock there, or never.
fn air(stretches: &[(usize, Stretch)], record: &Record) -> Option<usize> {
    let outermost = &stretches.first()?.1;
    let force = beside(&record.force, outermost.mean);
    let sizes: Vec<f64> = stretches.iter().map(|s| s.1.size).collect();
    let is_quiet = |s: &Stretch| s.scatter < QUIET * force;
    if !is_quiet(outermost) || norm(outermost.mean) > SHIFTED * quantile(&sizes, 0.9) {
        return None;
    }
    // a zero may drift
    let mut before = &stretches[0];
    let mut air = 0;
    for own in stretches {
        let still = STILL * force * (own.0 - before.0).max(1) as f64;
        if !is_quiet(&own.1) || norm(sub(own.1.mean, before.1.mean)) > still {
            break;
        }
        (before, air) = (own, air + 1);
    }
    let rest = stretches.get(air..).filter(|rest| !rest.is_empty())?;
    let pushed: Vec<f64> = rest
        .iter()
        .map(|s| norm(sub(s.1.mean, before.1.mean)))
        .collect();
    let is_cut = median(&pushed) > (PUSHED * force).max(norm(outermost.mean));
    (air > 0 && is_cut).then(|| before.0 + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measurement::milling_force::CutSide;

    /// Turns of 0.01 s, a way in of 0.05 s.
    const CUT: CutFacts = CutFacts {
        spindle_rad_s: TAU * 100.0,
        feed_m_s: 0.1,
        depth_m: 1e-3,
        width_m: 5e-3,
        side: CutSide::Down,
    };

    /// A second of a force, in the stock as far as `share` of the time says, with a shifted zero.
    fn record(share: impl Fn(f64) -> f64) -> Record {
        let time: Vec<f64> = (0..4000).map(|i| 2.5e-4 * f64::from(i)).collect();
        let force = |t: &f64| {
            let pulse = (TAU * 200.0 * t).sin().max(0.0);
            [
                20.0 + 200.0 * share(*t) * pulse,
                -100.0 * share(*t) * pulse,
                0.01 * (1e3 * t).sin(),
            ]
        };
        Record {
            force: time.iter().map(force).collect(),
            row: (0..time.len()).collect(),
            begins_s: time[0],
            time,
        }
    }

    #[test]
    fn air_goes_with_the_way_in_and_out() {
        let both = record(|t| (20.0 * (t - 0.2)).min(20.0 * (0.9 - t)).clamp(0.0, 1.0));
        let kept = in_stock(&both, &CUT, 5e-3);
        assert!((1000..1160).contains(&kept.start), "{kept:?}");
        assert!((3240..3400).contains(&kept.end), "{kept:?}");
    }

    #[test]
    fn air_may_drift_and_miss_rows() {
        let mut drifts = record(|t| (20.0 * (t - 0.4)).clamp(0.0, 1.0));
        for (t, f) in drifts.time.iter().zip(&mut drifts.force) {
            f[0] += 30.0 * t;
        }
        let keep = |i: &usize| !(400..1000).contains(i);
        let kept: Vec<usize> = (0..4000).filter(keep).collect();
        let gapped = Record {
            time: kept.iter().map(|i| drifts.time[*i]).collect(),
            force: kept.iter().map(|i| drifts.force[*i]).collect(),
            row: kept,
            begins_s: drifts.begins_s,
        };
        let first = gapped.time[in_stock(&gapped, &CUT, 5e-3).start];
        assert!((0.45..0.5).contains(&first), "{first}");
    }

    #[test]
    fn a_cut_all_along_stays_whole() {
        let of = |share: fn(f64) -> f64| in_stock(&record(share), &CUT, 5e-3);
        assert_eq!(of(|_| 1.0), 0..4000);
        // one that wanes, one that is never in the stock, one that is there for less than two turns
        assert_eq!(of(|t| 1.0 - 0.7 * t), 0..4000);
        assert_eq!(of(|_| 0.0), 0..4000);
        assert_eq!(of(|t| f64::from(u8::from(t > 0.98))), 0..4000);
        // a steady force that chatters from its middle
        let mut chatters = record(|_| 0.0);
        for (t, f) in chatters.time.iter().zip(&mut chatters.force) {
            f[1] += 300.0 * f64::from(u8::from(*t > 0.5)) * (TAU * 333.0 * t).sin();
        }
        assert_eq!(in_stock(&chatters, &CUT, 5e-3), 0..4000);
    }
}
