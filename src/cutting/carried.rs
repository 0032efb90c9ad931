//! One mode through a tooth passing: collocated at Chebyshev nodes while teeth cut, exact while none does.

use super::chebyshev::{Stretch, differentiation, nodes};
use super::stability::TipMode;
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// Nodes per oscillation of the fastest mode, and nodes besides.
const PER_OSCILLATION: f64 = 4.5;
const BESIDES: f64 = 14.0;
/// What is carried along one mode: its two states and its answers, as functions of the states at the start
/// and of the forces at all nodes.
pub struct Carried {
    /// η and η'/ω at the end.
    pub state: DMatrix<f64>,
    /// η at the nodes.
    pub answers: DMatrix<f64>,
}

/// The nodes of a stretch, s; none where no tooth cuts. `fastest`: circular frequency of the fastest mode, rad/s.
pub fn places(stretch: &Stretch, fastest: f64, refine: f64) -> Vec<f64> {
    if !stretch.cutting {
        return Vec::new();
    }
    let swings = fastest * stretch.length_s / TAU;
    let count = (refine * (PER_OSCILLATION * swings + BESIDES)).ceil() as usize;
    let start = stretch.middle_s - 0.5 * stretch.length_s;
    let at = |u: f64| start + stretch.length_s * u;
    nodes(count).into_iter().map(at).collect()
}

/// One mode through the whole tooth passing, `total` nodes in all.
pub fn carried(mode: &TipMode, grid: &[(Stretch, Vec<f64>)], total: usize) -> Carried {
    let mut state = DMatrix::zeros(2, 2 + total);
    (state[(0, 0)], state[(1, 1)]) = (1.0, 1.0);
    let mut answers = DMatrix::zeros(total, 2 + total);
    let mut first = 0;
    for (stretch, times) in grid {
        if times.is_empty() {
            state = free(mode, stretch.length_s) * state;
            continue;
        }
        let solved = collocated(mode, stretch.length_s, times.len());
        let n = times.len();
        let mut from = DMatrix::zeros(2 + n, 2 + total);
        from.view_mut((0, 0), (2, 2 + total)).copy_from(&state);
        (0..n).for_each(|j| from[(2 + j, 2 + first + j)] = 1.0);
        let all = solved * from;
        answers
            .view_mut((first, 0), (n, 2 + total))
            .copy_from(&all.view((0, 0), (n, 2 + total)));
        state.row_mut(0).copy_from(&all.row(n - 1));
        state.row_mut(1).copy_from(&all.row(2 * n - 1));
        first += n;
    }
    Carried { state, answers }
}

/// The mode without a force over a time, states η and η'/ω.
fn free(mode: &TipMode, time_s: f64) -> DMatrix<f64> {
    let (z, turn) = (mode.damping_ratio, mode.omega * time_s);
    let root = (1.0 - z * z).abs().sqrt().max(1e-7);
    let (s, c) = match z < 1.0 {
        true => {
            let decay = (-z * turn).exp();
            let (sin, cos) = (root * turn).sin_cos();
            (decay * sin / root, decay * cos)
        }
        false => {
            let [slow, fast] = [(root - z) * turn, (-root - z) * turn].map(f64::exp);
            (0.5 * (slow - fast) / root, 0.5 * (slow + fast))
        }
    };
    DMatrix::from_row_slice(2, 2, &[c + z * s, s, -s, c - z * s])
}

/// η at all nodes, then η'/ω, as functions of both at the first node and of the modal force at the nodes.
fn collocated(mode: &TipMode, length_s: f64, n: usize) -> DMatrix<f64> {
    let slope = differentiation(n);
    let w = mode.omega * length_s;
    let mut system = DMatrix::zeros(2 * n, 2 * n);
    let mut right = DMatrix::zeros(2 * n, 2 + n);
    for i in 1..n {
        for j in 0..n {
            system[(i, j)] = slope[(i, j)];
            system[(n + i, n + j)] = slope[(i, j)];
        }
        system[(i, n + i)] -= w;
        system[(n + i, i)] += w;
        system[(n + i, n + i)] += 2.0 * mode.damping_ratio * w;
        right[(n + i, 2 + i)] = w / mode.stiffness;
    }
    (system[(0, 0)], system[(n, n)]) = (1.0, 1.0);
    (right[(0, 0)], right[(n, 1)]) = (1.0, 1.0);
    let fallback = DMatrix::zeros(2 * n, 2 + n);
    system.lu().solve(&right).unwrap_or(fallback)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mode_swings_on_freely_as_collocation_says() {
        for damping_ratio in [0.01, 0.5, 1.7] {
            let mode = TipMode {
                direction: [1.0, 0.0, 0.0],
                omega: 300.0,
                damping_ratio,
                stiffness: 2e6,
            };
            let (exact, n) = (free(&mode, 0.02), 40);
            let nodes = collocated(&mode, 0.02, n);
            for s in 0..2 {
                assert!((nodes[(n - 1, s)] - exact[(0, s)]).abs() < 1e-9);
                assert!((nodes[(2 * n - 1, s)] - exact[(1, s)]).abs() < 1e-9);
            }
        }
    }
}
