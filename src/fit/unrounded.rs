//! A load that is read in coarse steps, as it may have been: the smoothest course within half a step of every reading, as far as the
//! deflection does not go these steps too. Weights do go in steps, and a hand that trembles is seen in what was read of it.
//!
//! The course minimises the sum of squared second differences over time and, lightly, of the ways from the readings, with
//! |course − reading| ≤ step/2: a convex programme (Clarabel; Goulart and
//! Chen 2024). Rounding that is left in a load is an error of it that neighbours know (errors in variables, Fuller 1987): a delay beside a
//! creep averages neighbours, and "explains" what is nobody's cause.

use crate::effects::Scene;
use crate::ground::stats::{difference, mean, median};
use crate::signal::outliers::{robust_std, third_differences};
use crate::signal::steps::goes_in_steps;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};

/// Weight of the way from a reading beside the squared second differences, where a reading stands for one row; it falls as the fourth power of these
/// rows, as the width does over which a spline averages. On three records by a stranger, which stand for 1.1 to 3.6 rows, what a spring with curves of
/// the load leaves is least from 1e-3 to 1e-2 times that power.
const FIRM: f64 = 3e-3;
/// Shortest time between two rows, of the median one: rows that stand at one time bend nothing infinitely.
const SHORTEST: f64 = 1e-2;

/// What rounding of the load leaves open is negligible below this share of the readings' noise.
const OPEN: f64 = 0.25;
/// Changes from step to step, a move, from which on a load is rounded, and differences below which two steps are one, of the largest. Choices.
const CHANGES: f64 = 0.2;
const EQUAL: f64 = 1e-3;
/// Share of the steps of a load that its deflection follows, from which on it goes in steps.
const MOSTLY: f64 = 0.7;

/// The load of a scene that is read in such a step, without the part of the steps that its deflection does not follow; `None` where the step is
/// negligible beside the noise of the `reading`, or the load goes in steps, whatever they are rounded to.
pub fn unrounded(scene: &Scene, reading: &[f64], step: f64) -> Option<Vec<f64>> {
    if !is_rounded(&scene.load) {
        return None;
    }
    let k = scene.load_scale / scene.deflection_scale;
    let noise = robust_std(&third_differences(reading));
    // Widrow and Kollár 2008
    if step / 12f64.sqrt() <= OPEN * noise * k {
        return None;
    }
    let smooth = smoothest(&scene.time, &scene.load, step)?;
    let over: Vec<f64> = smooth.iter().map(|m| m / scene.load_scale).collect();
    if goes_in_steps(&over) {
        return None;
    }
    let kept = followed((&scene.load, &smooth), reading, k);
    let each = scene.load.iter().zip(&smooth);
    (kept < MOSTLY).then(|| {
        each.map(|(read, smooth)| smooth + kept * (read - smooth))
            .collect()
    })
}

/// Whether a load that lies on a lattice was rounded to it: what moves smoothly between the lines takes now one step, now none or two. One that takes
/// the same in every row was set so.
fn is_rounded(read: &[f64]) -> bool {
    let ways: Vec<f64> = read.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
    let largest = ways.iter().fold(0.0_f64, |most, way| most.max(*way));
    let moves = ways.iter().filter(|way| **way > EQUAL * largest).count();
    let other = |w: &&[f64]| (w[1] - w[0]).abs() > EQUAL * largest;
    let changes = ways.windows(2).filter(other).count();
    changes as f64 > CHANGES * moves as f64
}

/// Share of the steps of a load, that is of what was read less a smooth course, which its deflection follows, from row to row and as long as a
/// reading stands; `k`: load over deflection.
fn followed((read, smooth): (&[f64], &[f64]), reading: &[f64], k: f64) -> f64 {
    let steps = difference(read, smooth);
    let seen = reading.iter().zip(smooth).map(|(y, s)| k * y - s);
    let seen: Vec<f64> = seen.collect();
    // a difference of two rows has twice the variance of a row
    let apart = |v: &[f64]| -> Vec<f64> {
        v.windows(2)
            .map(|w| (w[1] - w[0]) * 0.5f64.sqrt())
            .collect()
    };
    let mut pairs = vec![(apart(&steps), apart(&seen))];
    pairs.extend(stands(read).map(|rows| (off_mean(&steps[rows.clone()]), off_mean(&seen[rows]))));
    let each = pairs.iter().flat_map(|(a, b)| a.iter().zip(b));
    let (own, both) = each.fold((0.0, 0.0), |(own, both), (a, b)| {
        (own + a * a, both + a * b)
    });
    (both / own.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
}

/// Rows for which a reading stands, one after the other.
fn stands(read: &[f64]) -> impl Iterator<Item = std::ops::Range<usize>> {
    let mut from = 0;
    read.chunk_by(|a, b| a == b).map(move |stand| {
        from += stand.len();
        from - stand.len()..from
    })
}

/// Values less their mean.
fn off_mean(values: &[f64]) -> Vec<f64> {
    let usual = mean(values);
    values.iter().map(|v| v - usual).collect()
}

/// The smoothest course within half a `step` of every reading, unit of the readings; `None` where the solver finds none.
fn smoothest(time: &[f64], read: &[f64], step: f64) -> Option<Vec<f64>> {
    let n = read.len();
    if n < 3 || step.is_nan() || step <= 0.0 {
        return None;
    }
    // the way from the reading in half steps: every number lies within one
    let half = 0.5 * step;
    let bend = bends(time);
    let smooth = squared(&bend, n, FIRM / rows_of_a_step(read).powi(4));
    let mut linear = vec![0.0; n];
    for (i, weights) in bend.iter().enumerate() {
        let own: f64 = (0..3).map(|k| weights[k] * read[i + k] / half).sum();
        (0..3).for_each(|k| linear[i + k] += weights[k] * own);
    }
    let off = within_one(&smooth, &linear)?;
    Some(
        read.iter()
            .zip(off)
            .map(|(read, off)| read + half * off)
            .collect(),
    )
}

/// Minimises ½ xᵀPx + qᵀx over |x| ≤ 1.
fn within_one(smooth: &CscMatrix<f64>, linear: &[f64]) -> Option<Vec<f64>> {
    let n = linear.len();
    let both = [-1.0, 1.0].repeat(n);
    let rows: Vec<usize> = (0..n).flat_map(|i| [i, n + i]).collect();
    let ends = (0..=n).map(|i| 2 * i).collect();
    let sides = CscMatrix::new(2 * n, n, ends, rows, both);
    let settings = DefaultSettings {
        verbose: false,
        ..DefaultSettings::default()
    };
    let cones = [NonnegativeConeT(2 * n)];
    let ones = vec![1.0; 2 * n];
    let solver = DefaultSolver::new(smooth, linear, &sides, &ones, &cones, settings);
    let mut solver = solver.ok()?;
    solver.solve();
    let found = &solver.solution;
    match found.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {
            Some(found.x.iter().map(|x| x.clamp(-1.0, 1.0)).collect())
        }
        _ => None,
    }
}

/// Weights of three neighbours in their second difference over time, in the median time between rows.
fn bends(time: &[f64]) -> Vec<[f64; 3]> {
    let apart: Vec<f64> = time.windows(2).map(|w| w[1] - w[0]).collect();
    let usual = median(&apart).max(f64::MIN_POSITIVE);
    let apart: Vec<f64> = apart.iter().map(|h| (h / usual).max(SHORTEST)).collect();
    let of = |h: &[f64]| [1.0 / h[0], -1.0 / h[0] - 1.0 / h[1], 1.0 / h[1]];
    apart.windows(2).map(of).collect()
}

/// Rows for which a reading stands on average.
fn rows_of_a_step(read: &[f64]) -> f64 {
    let moves = read.windows(2).filter(|w| w[0] != w[1]).count();
    read.len() as f64 / moves.max(1) as f64
}

/// Upper triangle of the matrix of the summed squares of what three weights in a row make, and of every number by `firm`.
fn squared(bend: &[[f64; 3]], n: usize, firm: f64) -> CscMatrix<f64> {
    // diagonals: own, with the one before, with the one before that
    let mut diagonals = [vec![firm; n], vec![0.0; n], vec![0.0; n]];
    for (i, weights) in bend.iter().enumerate() {
        for a in 0..3 {
            (0..=a).for_each(|b| diagonals[a - b][i + a] += weights[a] * weights[b]);
        }
    }
    let entry = |column: usize, before: usize| (column - before, diagonals[before][column]);
    let column = |column: usize| {
        (0..=column.min(2))
            .rev()
            .map(move |before| (column, before))
    };
    let entries = (0..n).flat_map(column);
    let (rows, values) = entries.map(|(at, before)| entry(at, before)).unzip();
    // three in a column, but for the first two
    let ends = (0..=n).map(|c| (3 * c).saturating_sub([0, 2, 3][c.min(2)]));
    CscMatrix::new(n, n, ends.collect(), rows, values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;
    use crate::ground::stats::rms;

    const STEP: f64 = 0.1;

    fn rounded(v: &f64) -> f64 {
        STEP * (v / STEP).round()
    }

    fn sine(rows: usize) -> Vec<f64> {
        let at = |i: usize| (i as f64 * std::f64::consts::TAU / rows as f64).sin();
        (0..3 * rows).map(at).collect()
    }

    /// A scene under this load, read as it is rounded, and the deflection of a stiffness of one with noise.
    fn scene(load: &[f64]) -> (Scene, Vec<f64>) {
        let time = (0..load.len()).map(|i| i as f64).collect();
        let mut random = Random::new(5);
        let reading = load.iter().map(|v| v + 0.02 * random.normal()).collect();
        let read = load.iter().map(rounded).collect();
        (Scene::new(time, read, 1.0, 3), reading)
    }

    #[test]
    fn a_sine_that_is_read_in_steps_is_found_to_a_fraction_of_them() {
        for rows in [60, 400] {
            let truth = sine(rows);
            let (scene, reading) = scene(&truth);
            let found = unrounded(&scene, &reading, STEP).unwrap();
            let off = |v: &[f64]| rms(&difference(v, &truth));
            let left = off(&found) / off(&scene.load);
            assert!(left < 0.5, "{left} of the rounding is left");
            let far = difference(&found, &scene.load);
            assert!(far.iter().all(|d| d.abs() <= 0.5 * STEP + 1e-9));
        }
    }

    #[test]
    fn weights_go_in_steps() {
        let truth: Vec<f64> = sine(400).iter().map(rounded).collect();
        let (scene, reading) = scene(&truth);
        assert_eq!(unrounded(&scene, &reading, STEP), None);
    }

    #[test]
    fn a_triangle_that_takes_one_step_in_every_row_is_not_rounded() {
        let up = |i: usize| STEP * (20 - (i % 40).abs_diff(20)) as f64;
        let (scene, reading) = scene(&(0..240).map(up).collect::<Vec<_>>());
        assert_eq!(unrounded(&scene, &reading, STEP), None);
    }

    #[test]
    fn a_step_below_the_noise_is_left() {
        let (scene, _) = scene(&sine(60));
        let mut random = Random::new(6);
        let reading: Vec<f64> = sine(60).iter().map(|v| v + random.normal()).collect();
        assert_eq!(unrounded(&scene, &reading, STEP), None);
    }

    #[test]
    fn nothing_is_made_of_two_rows_or_no_step() {
        assert_eq!(smoothest(&[0.0, 1.0], &[0.0, 1.0], 0.1), None);
        let three = [0.0, 1.0, 2.0];
        assert_eq!(smoothest(&three, &[0.0, 1.0, 0.0], f64::NAN), None);
    }
}
