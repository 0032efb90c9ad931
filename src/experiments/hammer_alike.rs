//! Hammer tests: how much of what hits differ is alike on all lines. A force read too large, or one that points a little
//! towards another direction, moves a whole FRF along those that were measured; the rest differs from line to line.

use super::hammer_frf::InputFrf;
use super::hammer_variance::Parts;
use crate::motion::frf::C64;
use crate::signal::frf::{Estimator, Line};
use crate::signal::jackknife::{covariance, left_out};
use nalgebra::{DMatrix, DVector};

/// The share of the variance of the `hits` of one direction, 0 to 1, that real sums of the FRFs of all directions
/// explain hit by hit. `parts` holds the variance per line of every output; `correlated` lines carry the information of one. A single
/// hit shows nothing: what is taken for it is a guess of its gain.
pub fn alike(
    inputs: &[InputFrf],
    own: usize,
    parts: &[(usize, Vec<Parts>)],
    lines: &[usize],
    correlated: f64,
) -> f64 {
    let input = &inputs[own];
    let hits = input.hits.len();
    if input.scatter.is_some() {
        return 0.0;
    }
    if hits < 2 {
        return 1.0;
    }
    let weighed = |values: Vec<Vec<C64>>| weighed(parts, &values);
    let along = inputs.iter().map(|input| {
        let of = |sums: &[Line]| lines.iter().map(|k| sums[*k].h1()).collect();
        weighed(parts.iter().map(|p| of(&input.sums.lines[p.0])).collect())
    });
    let directions = DMatrix::from_columns(&along.collect::<Vec<_>>()).qr().q();
    let each = parts.iter();
    let each = each.map(|p| left_out(&input.sums, &input.hits, p.0, Estimator::H1, lines));
    let each: Vec<Vec<Vec<C64>>> = each.collect();
    let moved = (0..hits).map(|hit| {
        let own = each.iter().map(|outputs| outputs[hit].clone());
        directions.tr_mul(&weighed(own.collect()))
    });
    let taken = covariance(&moved.collect::<Vec<_>>()).trace();
    let chance = directions.ncols() as f64 * correlated;
    let scatter = parts.iter().flat_map(|p| &p.1);
    let all: f64 = scatter.map(|p| 2.0 * p.hits / p.sum()).sum();
    let share = (taken - chance) / all.max(f64::MIN_POSITIVE);
    match share.is_nan() {
        // a line without force
        true => 0.0,
        false => share.clamp(0.0, 1.0),
    }
}

/// The `values` of every output, line by line, real parts and imaginary ones, in standard deviations of `parts`.
fn weighed(parts: &[(usize, Vec<Parts>)], values: &[Vec<C64>]) -> DVector<f64> {
    let rows = parts.iter().zip(values).flat_map(|((_, parts), values)| {
        let both = values.iter().zip(parts);
        both.flat_map(|(value, part)| {
            let unit = (2.0 / part.sum().max(f64::MIN_POSITIVE)).sqrt();
            [value.re * unit, value.im * unit]
        })
    });
    DVector::from_vec(rows.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::hammer_variance;
    use crate::ground::random::Random;
    use crate::signal::frf::{CrossSpectra, HitSpectra};

    const LINES: usize = 80;

    /// Two modes seen by two outputs under a force along `input`.
    fn frf(input: usize, output: usize, line: usize) -> C64 {
        let mode = |at: f64, size: f64| {
            let x = line as f64 / at;
            C64::new(size, 0.0) / C64::new(1.0 - x * x, 0.06 * x)
        };
        let shapes = [[1.0, 0.4], [-0.5, 0.9]];
        mode(30.0, shapes[0][input] * shapes[0][output])
            + mode(47.0, shapes[1][input] * shapes[1][output])
    }

    fn struck(
        input: usize,
        random: &mut Random,
        off: impl Fn(&mut Random, usize) -> [f64; 3],
    ) -> InputFrf {
        let hits: Vec<HitSpectra> = (0..5)
            .map(|hit| {
                let [gain, angle, noise] = off(random, hit);
                let mut response = |output: usize| -> Vec<C64> {
                    let at = |k: usize| {
                        let h = frf(input, output, k) * (1.0 + gain)
                            + frf(1 - input, output, k) * angle;
                        h * (C64::new(random.normal(), random.normal()) * noise + 1.0)
                    };
                    (0..LINES).map(at).collect()
                };
                HitSpectra {
                    responses: vec![response(0), response(1)],
                    force: vec![C64::new(1.0, 0.0); LINES],
                }
            })
            .collect();
        InputFrf {
            input: ["x", "y"][input].into(),
            sums: CrossSpectra::of(&hits),
            hits,
            noise_power: vec![0.0; 2],
            force_noise: None,
            scatter: None,
        }
    }

    fn share(off: impl Fn(&mut Random, usize) -> [f64; 3]) -> f64 {
        let mut random = Random::new(7);
        let inputs = [0, 1].map(|input| struck(input, &mut random, &off));
        let lines: Vec<usize> = (5..LINES).collect();
        let parts = |o| (o, hammer_variance::parts(&inputs[0], o, &lines));
        let parts: Vec<(usize, Vec<Parts>)> = (0..2).map(parts).collect();
        alike(&inputs, 0, &parts, &lines, 1.0)
    }

    /// Gains and angles are alike on all lines, a force that is read with noise is not, and half of either is half. They are
    /// large beside the least deviation of a line, which nothing shows to be alike.
    #[test]
    fn what_is_alike_on_all_lines_is_told_from_what_is_not() {
        let gain = share(|random, _| [0.05 * random.normal(), 0.0, 1e-4]);
        assert!(gain > 0.9, "{gain}");
        let angle = share(|random, _| [0.0, 0.05 * random.normal(), 1e-4]);
        assert!(angle > 0.8, "{angle}");
        let noise = share(|_, _| [0.0, 0.0, 0.02]);
        assert!(noise < 0.1, "{noise}");
        let both = share(|_, hit| {
            [
                [0.02, -0.02, 0.0, 0.02, -0.02][hit],
                0.0,
                0.02 / 2f64.sqrt(),
            ]
        });
        assert!((0.3..0.75).contains(&both), "{both}");
    }

    #[test]
    fn a_line_without_force_says_nothing() {
        let mut random = Random::new(7);
        let mut input = struck(0, &mut random, |_, _| [0.0, 0.0, 0.01]);
        for hit in &mut input.hits {
            hit.force[9] = C64::new(0.0, 0.0);
        }
        input.sums = CrossSpectra::of(&input.hits);
        let parts = vec![(
            0,
            vec![
                Parts {
                    response: 1.0,
                    hits: 1.0
                };
                LINES
            ],
        )];
        let lines: Vec<usize> = (0..LINES).collect();
        assert_eq!(alike(&[input], 0, &parts, &lines, 1.0), 0.0);
    }
}
