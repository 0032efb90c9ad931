//! Slopes beside differences of what is predicted.

use super::*;
use crate::findings::hammer::data::Pair;
use crate::findings::hammer::suspect::suspects;
use crate::measurement::hammer_known;
use crate::motion::uncertain;
use crate::robot::{builtin, load::load};
use std::f64::consts::TAU;

/// Step of a difference, in spreads.
const APART: f64 = 1e-4;

fn lines() -> Data {
    let s: Vec<C64> = (2..16)
        .map(|k| C64::new(2.0, TAU * 3.0 * f64::from(k)))
        .collect();
    let pair = |(output, input): (usize, usize)| Pair {
        output,
        input,
        frf: vec![C64::default(); s.len()],
        weight: vec![1e3; s.len()],
        scatter: Vec::new(),
    };
    let all = (0..3).flat_map(|output| (0..3).map(move |input| (output, input)));
    Data {
        pairs: all.map(pair).collect(),
        s,
        correlated: 1.0,
        doubt: 1.0,
    }
}

/// The robot at a pose, with what is not known of it.
fn machine<'a>(robot: &'a Robot, data: &Data) -> Machine<'a> {
    let known = Known {
        stiffness: 0.05,
        damping: 0.25,
        laboratory: uncertain::Known::stated(hammer_known::Known::default()),
    };
    Machine::new(robot, &[0.3, -1.2, 1.7, 0.5, 0.8, 0.2], known, data).unwrap()
}

/// Causes at places whose slopes are not those of what is predicted, near their first starts (where two axes give way alike, any two
/// axes will do, and a slope along what turns them need not be one), numbers of bodies at `bodies`, of springs and dampers at 0.3.
fn off(bodies: f64) -> Vec<String> {
    let (robot, data) = (load(builtin::BUILTINS[0].0, None).unwrap().robot, lines());
    let machine = machine(&robot, &data);
    let all = suspects(&robot, &["x", "y", "z"].map(String::from));
    assert!(all.len() > 10, "{}", all.len());
    let mut off = Vec::new();
    for suspect in &all {
        let start = suspect.starts().remove(0).into_iter().enumerate();
        let start: Vec<f64> = start.map(|(k, x)| x + 0.03 * (k + 1) as f64).collect();
        let mut point = Point::nothing().and(suspect, &start);
        let nuisance = machine.nuisance(&point).unwrap();
        point.theta = vec![0.0; nuisance.len()];
        let springs = INSTRUMENT + nuisance.mass.nrows();
        point.theta[INSTRUMENT..springs].fill(bodies);
        point.theta[springs..].fill(0.3);
        let shown = machine.show(&nuisance, &point, &data).unwrap();
        let told = machine.slopes(&nuisance, &point, &data, &shown).unwrap();
        for index in 0..point.amounts.len() {
            let rows = |step: f64| {
                let mut moved = point.clone();
                moved.amounts[index] += step;
                let mut rows = Vec::new();
                let values = machine.predict(&nuisance, &moved, &data).unwrap();
                stack(&data, &values, &mut rows);
                DMatrix::from_vec(rows.len(), 1, rows)
            };
            let wanted = (rows(APART) - rows(-APART)) / (2.0 * APART);
            let apart = (told.columns.column(point.theta.len() + index) - &wanted).norm();
            if apart > 5e-3 * wanted.norm() {
                let (name, site) = (suspect.name(), &suspect.site);
                off.push(format!(
                    "{name} {site} {index}: {apart} of {}",
                    wanted.norm()
                ));
            }
        }
    }
    off
}

#[test]
fn slopes_of_amounts_are_those_of_what_is_predicted() {
    for bodies in [0.0, 0.3] {
        assert_eq!(off(bodies), Vec::<String>::new());
    }
}

/// What hangs at the tool pushes back with its apparent mass: of a point mass that slides along one direction on a spring, and goes along with the tool across
/// it.
#[test]
fn a_hung_body_is_an_apparent_mass_at_the_tool() {
    let (robot, data) = (load(builtin::BUILTINS[0].0, None).unwrap().robot, lines());
    let machine = machine(&robot, &data);
    let all = suspects(&robot, &["x", "y", "z"].map(String::from));
    let hung = all.iter().find(|s| !s.is_named()).unwrap();
    let shown = |point: Point| {
        let nuisance = machine.nuisance(&point).unwrap();
        let theta = vec![0.0; nuisance.len()];
        let point = Point { theta, ..point };
        let values = machine.predict(&nuisance, &point, &data).unwrap();
        let matrix = |a: &Accelerance| nalgebra::Matrix3::from_fn(|i, j| a[i][j]);
        values.iter().map(matrix).collect::<Vec<_>>()
    };
    let start = hung.starts().remove(7);
    let point = Point::nothing().and(hung, &start);
    let (mass, frequency) = (3.0, point.each()[0].1[3]);
    let omega = TAU * frequency;
    let (bare, with) = (shown(Point::nothing()), shown(point));
    // the direction turns with the joints: it is what makes the apparent mass smallest
    for ((bare, with), s) in bare.iter().zip(&with).zip(&data.s) {
        let own = bare.try_inverse().unwrap();
        let apparent = with.try_inverse().unwrap() - own;
        let spring = mass * omega * (C64::from(omega) + s * 0.04);
        let along = mass * spring / (spring + mass * s * s);
        let trace = apparent.trace() - (along + 2.0 * mass);
        // its weight bends the robot a little more, and turns with what it hangs at, which is no apparent mass: 3 kg · 9.81 m/s² over a fifth of
        // a metre, N/m
        let least = 2e-4 * own.norm() + 150.0 / s.norm_sqr();
        let size = along.norm() + 2.0 * mass;
        assert!(least < 0.1 * size, "{s}: {least} of {size}");
        assert!(trace.norm() < least, "{s}: {trace}");
        let squares = (apparent * apparent).trace() - (along * along + 2.0 * mass * mass);
        assert!(squares.norm() < 2.0 * size * least, "{s}: {squares}");
    }
}
