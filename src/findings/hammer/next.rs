//! Which experiment would tell two explanations apart: each is simulated with both, and what the
//! present uncertainties could imitate does not count.

use super::data::{Data, Pair};
use super::map::{Fit, weights};
use super::point::Point;
use super::prediction::{Machine, stack};
use super::structure::Structure;
use crate::ground::problem::Outcome;
use crate::ground::products::gram;
use crate::motion::frf::C64;
use crate::robot::{Body, Robot};
use nalgebra::{DMatrix, DVector};
use std::sync::Mutex;

/// A proposed experiment must separate by this many nats.
const ENOUGH: f64 = 5.0;
/// Lines of a simulated experiment are this many apart.
const STRIDE: usize = 3;
/// The known mass that is proposed, kg.
const KNOWN_MASS: f64 = 20.0;
/// Links on which a sensor is proposed.
const LINKS: [usize; 2] = [2, 3];
/// Step of a difference, in standard deviations or spreads.
const STEP: f64 = 1e-3;
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
    sensor: Option<usize>,
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
        _ => "none of the single tests simulated here (another pose, a known mass, a sensor on the foot or on a link, another accelerometer) separates them: hits at several poses together, ten per direction".into(),
    }
}

fn experiments(machine: &Machine) -> Vec<Experiment> {
    let dof = machine.robot.dof();
    let plain = |words: String| Experiment {
        words,
        mass: 0.0,
        turn: vec![0.0; dof],
        sensor: None,
        fresh: false,
    };
    let mut all = vec![
        Experiment {
            fresh: true,
            ..plain("the same hits with another, calibrated accelerometer, mounted anew".into())
        },
        Experiment {
            mass: KNOWN_MASS,
            ..plain(format!(
                "the same hits with a known mass of {KNOWN_MASS:.0} kg at the tool"
            ))
        },
        Experiment {
            sensor: Some(0),
            ..plain("the same hits with an accelerometer on the foot".into())
        },
    ];
    all.extend(
        LINKS
            .iter()
            .filter(|link| **link < dof)
            .map(|link| Experiment {
                sensor: Some(*link),
                ..plain(format!("the same hits with an accelerometer on link{link}"))
            }),
    );
    all.extend(TURNS.iter().map(|(words, turn)| {
        Experiment {
            turn: turn
                .iter()
                .copied()
                .chain(std::iter::repeat(0.0))
                .take(dof)
                .collect(),
            ..plain(format!("the same hits at another pose, {words}"))
        }
    }));
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
    let turned = machine.joints.iter().zip(&experiment.turn);
    let joints: Vec<f64> = turned.map(|(q, t)| q + t).collect();
    let robot = loaded(machine.robot, experiment.mass);
    let there = Machine {
        robot: &robot,
        joints: &joints,
        known: machine.known,
        seen: machine.seen.clone(),
        structure: Structure::of(&robot, &joints)?,
        sensor: experiment.sensor,
        masses: Mutex::default(),
    };
    let lines = thinned(data);
    let fresh = experiment.fresh || experiment.sensor.is_some();
    let (one, other) = (carried(a, fresh), carried(b, fresh));
    let shown = rows(&there, &one, &lines)?;
    let (told, mut columns) = slopes(&there, &other, &lines)?;
    let weights = weights(&lines);
    let apart = shown.iter().zip(&told).zip(&weights);
    let apart: Vec<f64> = apart.map(|((s, t), w)| (s - t) * w).collect();
    for mut column in columns.column_iter_mut() {
        column.iter_mut().zip(&weights).for_each(|(x, w)| *x *= w);
    }
    Ok(left(&DVector::from_vec(apart), &columns, &kept(b, &other)))
}

/// Prediction and slopes; of a sensor elsewhere by differences.
fn slopes(machine: &Machine, point: &Point, data: &Data) -> Outcome<(Vec<f64>, DMatrix<f64>)> {
    if machine.sensor.is_none() {
        let nuisance = machine.nuisance(point)?;
        let shown = machine.show(&nuisance, point, data)?;
        let found = machine.slopes(&nuisance, point, data, &shown)?;
        return Ok((found.values, found.columns));
    }
    let here = rows(machine, point, data)?;
    let nuisances = point.theta.len();
    let mut columns = Vec::new();
    for i in 0..nuisances + point.amounts.len() {
        let mut moved = point.clone();
        match i.checked_sub(nuisances) {
            None => moved.theta[i] += STEP,
            Some(k) => moved.amounts[k] += STEP,
        }
        let there = rows(machine, &moved, data)?;
        columns.extend(there.iter().zip(&here).map(|(t, h)| (t - h) / STEP));
    }
    let count = nuisances + point.amounts.len();
    let columns = DMatrix::from_vec(here.len(), count, columns);
    Ok((here, columns))
}

/// Half the square of what the present uncertainties (`precision`) do not imitate.
fn left(apart: &DVector<f64>, columns: &DMatrix<f64>, precision: &DMatrix<f64>) -> f64 {
    let across = columns.tr_mul(apart);
    let both = precision + gram(columns);
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
    fit.point
        .with_only(|suspect| suspect.is_physical() || !fresh)
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
        scatter: thin(&p.scatter),
        ..*p
    };
    Data {
        s: thin(&data.s),
        pairs: data.pairs.iter().map(pair).collect(),
        ..*data
    }
}
