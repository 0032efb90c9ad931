//! Whether what is louder swings: a swing comes back after its period, noise of any colour does not.

use crate::ground::stats::mean;
use crate::signal::swing::swing;
use std::ops::Range;

/// Lags, rows, at which a swing is sought.
const LAGS: usize = 60;
/// Standard errors below zero of half a period, and above of a whole one.
const FAR: (f64, f64) = (4.0, 3.0);

/// Share of its squares that one swing must take of a piece from its largest reading on, and nats of that beyond how many were
/// tried: of louder white noise one in some thousand pieces reaches it.
const DIES_AWAY: (f64, f64) = (0.5, 10.0);

/// Whether some pieces swing: one of them dies away, or all together come back after a period.
pub fn is_swinging(residual: &[f64], pieces: &[(Range<usize>, f64)]) -> bool {
    let runs = merged(pieces);
    let tried = runs.len() as f64;
    runs.iter()
        .any(|run| dies_away(&residual[run.clone()], tried))
        || comes_back(residual, &runs)
}

/// Whether the readings of a piece are one swing that dies away after the largest of them; that one left out, or a lone reading
/// would pass for a swing of a row. `pieces`: how many are looked at.
fn dies_away(own: &[f64], pieces: f64) -> bool {
    let size = |i: &usize| own[*i].abs();
    let first = (0..own.len()).max_by(|a, b| size(a).total_cmp(&size(b)));
    let from = &own[(first.unwrap_or(0) + 1).min(own.len())..];
    let (share, shapes) = swing(from);
    let nats = -0.5 * from.len() as f64 * (1.0 - share).max(f64::EPSILON).ln();
    share > DIES_AWAY.0 && nats > DIES_AWAY.1 + (shapes.max(1) as f64 * pieces).ln()
}

/// Whether the readings in some pieces, beyond what the others hold as well (a line of the mains), first turn against
/// themselves and then come back.
fn comes_back(residual: &[f64], runs: &[Range<usize>]) -> bool {
    let others = between(runs, residual.len());
    let rows = |runs: &[Range<usize>]| runs.iter().map(ExactSizeIterator::len).sum::<usize>();
    let (own, rest) = (rows(runs), rows(&others));
    if own == 0 || rest == 0 {
        return false;
    }
    let longest = runs.iter().map(ExactSizeIterator::len).max().unwrap_or(0);
    let excess = |lag: usize| covariance(residual, runs, lag) - covariance(residual, &others, lag);
    let (size, all) = (excess(0), covariance(residual, runs, 0));
    let error = all / (own as f64).sqrt();
    let each: Vec<f64> = (1..=LAGS.min(longest / 2)).map(excess).collect();
    let against = each.iter().position(|c| *c < -FAR.0 * error);
    let back = against.is_some_and(|at| each[at..].iter().any(|c| *c > FAR.1 * error));
    size > 0.0 && back
}

/// Pieces that overlap or touch as one.
fn merged(pieces: &[(Range<usize>, f64)]) -> Vec<Range<usize>> {
    let mut all: Vec<Range<usize>> = Vec::new();
    for (own, _) in pieces {
        match all.last_mut().filter(|last| last.end >= own.start) {
            Some(last) => last.end = last.end.max(own.end),
            None => all.push(own.clone()),
        }
    }
    all
}

fn between(runs: &[Range<usize>], rows: usize) -> Vec<Range<usize>> {
    let starts = std::iter::once(0).chain(runs.iter().map(|r| r.end));
    let ends = runs.iter().map(|r| r.start).chain([rows]);
    starts
        .zip(ends)
        .filter(|(a, b)| b > a)
        .map(|(a, b)| a..b)
        .collect()
}

/// Mean product of values of one run so many rows apart, each run about its mean, over all rows.
fn covariance(values: &[f64], runs: &[Range<usize>], lag: usize) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for run in runs {
        let own = &values[run.clone()];
        let middle = mean(own);
        let pairs = own.iter().zip(own.iter().skip(lag));
        sum += pairs.map(|(a, b)| (a - middle) * (b - middle)).sum::<f64>();
        count += own.len() as f64;
    }
    sum / count.max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    fn record(loud: impl Fn(usize, &mut Random) -> f64) -> Vec<f64> {
        let mut random = Random::new(4);
        let one = |i: usize| match (300..360).contains(&i) {
            true => loud(i - 300, &mut random),
            false => random.normal(),
        };
        (0..900).map(one).collect()
    }

    #[test]
    fn a_swing_that_dies_away_is_told_from_louder_noise() {
        let pieces = [(300..330, 3.0), (320..360, 2.0)];
        let swing = record(|i, r| {
            let at = i as f64;
            10.0 * (-at / 25.0).exp() * (0.6 * at).sin() + r.normal()
        });
        assert!(is_swinging(&swing, &pieces));
        assert!(!is_swinging(&record(|_, r| 4.0 * r.normal()), &pieces));
    }
}
