//! Which experiment would tell two explanations apart: each is simulated with both, and what the
//! present uncertainties could imitate does not count.

use super::data::{Data, Pair};
use super::map::{Fit, weights};
use super::prediction::{Machine, Point, stack};
use super::structure::Structure;
use crate::ground::problem::Outcome;
use crate::motion::frf::C64;
use crate::robot::{Body, Robot};
use nalgebra::{DMatrix, DVector};

/// A proposed experiment must separate by this many nats.
const ENOUGH: f64 = 5.0;
/// Lines of a simulated experiment are this many apart.
const STRIDE: usize = 3;
/// The known mass that is proposed, kg.
const KNOWN_MASS: f64 = 20.0;
/// Turn of the joints for another pose, rad.
const TURNS: [(&str, [f64; 6]); 2] = [
    (
        "with A3 turned by 40° and A5 by −40°",
        [0.0, 0.0, 0.7, 0.0, -0.7, 0.0],
    ),
    (
        "with A2 turned by 25° and A4 by 60°",
        [0.0, 0.44, 0.0, 1.05, 0.0, 0.0],
    ),
];

/// One experiment: what to do in words, and how robot, pose and instrument differ.
struct Experiment {
    words: String,
    mass: f64,
    turn: Vec<f64>,
    fresh: bool,
}

/// The experiment that separates `a` from `b` best, in words with its nats.
pub fn would_tell(machine: &Machine, data: &Data, a: &Fit, b: &Fit) -> String {
    let tried = experiments(machine).into_iter();
    let rated = tried.filter_map(|e| Some((separation(machine, data, &e, a, b).ok()?, e)));
    match rated.max_by(|x, y| x.0.total_cmp(&y.0)) {
        Some((nats, best)) if nats > ENOUGH => {
            format!("{} (separates them by {nats:.0} nats)", best.words)
        }
        _ => format!(
            "none of the hammer tests simulated here (another pose, a known mass, another accelerometer) separates them; {}",
            "load cycles of the axes named, with a second sensor on the foot"
        ),
    }
}

fn experiments(machine: &Machine) -> Vec<Experiment> {
    let dof = machine.robot.dof();
    let still = vec![0.0; dof];
    let mut all = vec![
        Experiment {
            words: "the same hits with another, calibrated accelerometer, mounted anew".into(),
            mass: 0.0,
            turn: still.clone(),
            fresh: true,
        },
        Experiment {
            words: format!("the same hits with a known mass of {KNOWN_MASS:.0} kg at the tool"),
            mass: KNOWN_MASS,
            turn: still,
            fresh: false,
        },
    ];
    for (words, turn) in TURNS {
        all.push(Experiment {
            words: format!("the same hits at another pose, {words}"),
            mass: 0.0,
            turn: turn
                .iter()
                .copied()
                .chain(std::iter::repeat(0.0))
                .take(dof)
                .collect(),
            fresh: false,
        });
    }
    all
}

/// Nats by which the experiment tells `a` from `b`, if `a` is right.
fn separation(
    machine: &Machine,
    data: &Data,
    experiment: &Experiment,
    a: &Fit,
    b: &Fit,
) -> Outcome<f64> {
    let joints: Vec<f64> = machine
        .joints
        .iter()
        .zip(&experiment.turn)
        .map(|(q, t)| q + t)
        .collect();
    let robot = loaded(machine.robot, experiment.mass);
    let there = Machine {
        robot: &robot,
        joints: &joints,
        known: machine.known,
        seen: machine.seen.clone(),
        structure: Structure::of(&robot, &joints)?,
        masses: Default::default(),
    };
    let lines = thinned(data);
    let (one, other) = (carried(a, experiment.fresh), carried(b, experiment.fresh));
    let shown = rows(&there, &one, &lines)?;
    let nuisance = there.nuisance(&other)?;
    let told = there.slopes(&nuisance, &other, &lines)?;
    let weights = weights(&lines);
    let apart: Vec<f64> = shown
        .iter()
        .zip(&told.values)
        .zip(&weights)
        .map(|((s, t), w)| (s - t) * w)
        .collect();
    let mut columns = told.columns;
    for mut column in columns.column_iter_mut() {
        column.iter_mut().zip(&weights).for_each(|(x, w)| *x *= w);
    }
    Ok(left(&DVector::from_vec(apart), &columns, &kept(b, &other)))
}

/// Half the square of what the present uncertainties (`precision`) do not imitate.
fn left(apart: &DVector<f64>, columns: &DMatrix<f64>, precision: &DMatrix<f64>) -> f64 {
    let across = columns.tr_mul(apart);
    let both = precision + columns.transpose() * columns;
    let imitated = both
        .cholesky()
        .map_or(0.0, |f| across.dot(&f.solve(&across)));
    0.5 * (apart.norm_squared() - imitated).max(0.0)
}

/// The present precision of what `point` still holds.
fn kept(fit: &Fit, point: &Point) -> DMatrix<f64> {
    let count = point.theta.len() + point.amounts.len();
    match count == fit.precision.nrows() {
        true => fit.precision.clone(),
        false => fit.precision.view((0, 0), (count, count)).into_owned(),
    }
}

/// The explanation taken along; a fresh instrument leaves its faults behind.
fn carried(fit: &Fit, fresh: bool) -> Point {
    let mut point = Point::nothing();
    point.theta.clone_from(&fit.point.theta);
    for (suspect, amounts) in fit.point.each() {
        if suspect.is_physical() || !fresh {
            let scaled: Vec<f64> = amounts
                .iter()
                .zip(suspect.spreads())
                .map(|(a, s)| a / s)
                .collect();
            point = point.and(suspect, &scaled);
        }
    }
    point
}

fn rows(machine: &Machine, point: &Point, data: &Data) -> Outcome<Vec<f64>> {
    let nuisance = machine.nuisance(point)?;
    let mut rows = Vec::with_capacity(data.rows());
    stack(data, &machine.predict(&nuisance, point, data)?, &mut rows);
    Ok(rows)
}

fn loaded(robot: &Robot, mass: f64) -> Robot {
    let mut robot = robot.clone();
    if mass > 0.0 {
        let more = Body {
            mass,
            com: robot.tool.tcp,
            inertia: [0.0; 6],
        };
        robot.tool.body = Some(robot.tool.body.unwrap_or(Body::NOTHING).with(&more));
    }
    robot
}

fn thinned(data: &Data) -> Data {
    fn thin<T: Copy>(all: &[T]) -> Vec<T> {
        all.iter().copied().step_by(STRIDE).collect()
    }
    let pair = |p: &Pair| Pair {
        frf: thin::<C64>(&p.frf),
        weight: thin(&p.weight),
        ..p.clone()
    };
    Data {
        s: thin(&data.s),
        pairs: data.pairs.iter().map(pair).collect(),
        correlated: data.correlated,
    }
}
