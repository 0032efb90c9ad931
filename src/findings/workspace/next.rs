//! The experiment that would tell: each proposal is simulated with one candidate and fitted with the
//! others, on top of what was measured already; the one that leaves most is proposed.

use super::bound::Bound;
use super::columns::Columns;
use super::field::{Field, Springs};
use super::patterns::Scene;
use super::seats::{Column, Seats};
use crate::fit::force_shapes::Shapes;
use crate::fit::force_steps::Setup;
use crate::fit::weighing::Weighing;
use crate::ground::spatial::{V3, norm};
use crate::robot::Robot;
use nalgebra::{DMatrix, DVector};

/// What is known before another experiment.
pub struct Known<'a> {
    /// The test as it was done.
    pub scene: &'a Scene<'a>,
    /// Its set-ups.
    pub shapes: &'a Shapes,
    /// The springs over its rows.
    pub springs: &'a Springs,
    /// The columns of all seats over its rows.
    pub columns: &'a Columns,
    /// Everybody who may be blamed.
    pub seats: &'a Seats,
    /// Relative standard deviation of a set-up.
    pub repeatability: f64,
}

/// One that may be to blame: its seat, columns and their amounts.
pub struct Suspect {
    /// Index of the seat.
    pub seat: usize,
    /// The columns of its form.
    pub columns: Vec<usize>,
    /// Their amounts.
    pub amounts: Vec<f64>,
}

/// An experiment that could be done.
struct Probe {
    text: String,
    robot: Robot,
    points: Vec<Vec<f64>>,
    /// Where the displacement is read if not at the tool: behind which joint, and where at zero.
    sensor: Option<(usize, V3)>,
    /// Causes that it leaves no room for.
    trusted: &'static [&'static str],
    /// All three components are read.
    complete: bool,
}

/// Below this the candidates stay as they are, nats.
const TELLS: f64 = 3.0;
/// More separation than this is no better, nats.
const ENOUGH: f64 = 30.0;
/// No model is right to better than this share of a deflection.
const MODEL: f64 = 0.01;

/// The best proposal in words, with the separation that it would give: the one that tells the first
/// suspect from most others.
pub fn would_tell(known: &Known, suspects: &[Suspect]) -> String {
    let mut best: (f64, Vec<f64>, String) = (0.0, Vec::new(), String::new());
    for probe in probes(known) {
        let nats = separations(known, &probe, suspects);
        let worth = nats.iter().map(|n| n.min(ENOUGH)).sum();
        if worth > 1.1 * best.0 {
            best = (worth, nats, probe.text);
        }
    }
    let told: Vec<f64> = best.1.into_iter().filter(|n| *n > TELLS).collect();
    let least = told.iter().fold(f64::INFINITY, |m, n| n.min(m));
    let nats = if least > 999.0 {
        "more than 999".into()
    } else {
        format!("{least:.0}")
    };
    match told.len() {
        0 => "an axis test (`ident stiffness`) of each candidate: other postures, another tool, sensors on foot and link and dead weights would not, as simulated".into(),
        n if n + 1 == suspects.len() => format!("{} (simulated, this separates them by {nats} nats)", best.2),
        n => format!(
            "{} (simulated, this separates the first from {n} of the {} others by {nats} nats), then an axis test (`ident stiffness`)",
            best.2,
            suspects.len() - 1
        ),
    }
}

fn probes(known: &Known) -> Vec<Probe> {
    let robot = known.scene.robot;
    let points = known.scene.points;
    let plain = |text: &str, points: Vec<Vec<f64>>| Probe {
        text: text.into(),
        robot: robot.clone(),
        points,
        sensor: None,
        trusted: &[],
        complete: false,
    };
    let moved =
        |by: [f64; 6]| -> Vec<Vec<f64>> { points.iter().map(|q| turned(robot, q, by)).collect() };
    let mut lateral = robot.clone();
    let tool = known.scene.robot.tool.rotation;
    for (k, tcp) in lateral.tool.tcp.iter_mut().enumerate() {
        *tcp += 0.4 * tool[k][0] + 0.2 * tool[k][1];
    }
    let gauged = Probe {
        trusted: &["sensor_gain"],
        ..plain(
            "check the displacement sensors against a gauge block, then repeat",
            points.to_vec(),
        )
    };
    let weights = Probe {
        trusted: &["force_gain", "load_misalignment"],
        ..plain(
            "load with known dead weights, sideways over a pulley, instead of the force sensor",
            points.to_vec(),
        )
    };
    let all = Probe {
        complete: true,
        ..plain(
            "repeat and read all three components of the displacement",
            points.to_vec(),
        )
    };
    let foot = |text: &str, after: usize, at: V3| Probe {
        sensor: Some((after, at)),
        complete: true,
        trusted: &["sensor_gain"],
        ..plain(text, points.to_vec())
    };
    let first = robot.joints.first().map_or([0.0; 3], |j| j.point);
    let mut found = vec![
        plain(
            "repeat the points with the wrist turned (A4 by 60°, A5 by −50°, A6 by 70°)",
            moved([0.0, 0.0, 0.0, 60.0, -50.0, 70.0]),
        ),
        plain(
            "repeat with the arm folded (A2 back by 30°, A3 in by 40°)",
            moved([0.0, -30.0, 40.0, 0.0, 0.0, 0.0]),
        ),
        plain(
            "repeat with the arm stretched (A2 forward by 20°, A3 out by 40°)",
            moved([0.0, 20.0, -40.0, 0.0, 0.0, 0.0]),
        ),
        plain(
            "repeat the points with A1 turned by 60°",
            moved([60.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        ),
        Probe {
            robot: lateral,
            ..plain(
                "repeat with force and sensor on a bar 0.4 m to the side of the tool, a second lever",
                points.to_vec(),
            )
        },
        foot(
            "put a displacement sensor on the foot of the robot while the tool is loaded",
            0,
            [0.4, 0.4, 0.1],
        ),
        foot(
            "put a displacement sensor on link 1, beside A2, while the tool is loaded",
            1,
            [first[0] + 0.3, first[1] + 0.3, first[2] + 0.2],
        ),
        gauged,
        weights,
    ];
    if known
        .shapes
        .setups
        .iter()
        .any(|s| s.lines.iter().any(Option::is_none))
    {
        found.insert(0, all);
    }
    found
}

/// Joint angles moved by so many degrees, inside the limits: what does not fit turns the other way.
fn turned(robot: &Robot, q: &[f64], by: [f64; 6]) -> Vec<f64> {
    let joint = |(i, q): (usize, &f64)| {
        let [low, high] = robot.joints[i].limits;
        let by = by.get(i).copied().unwrap_or(0.0).to_radians();
        let inside = |x: f64| (low..=high).contains(&x);
        match (inside(q + by), inside(q - by)) {
            (true, _) => q + by,
            (false, true) => q - by,
            (false, false) => *q,
        }
    };
    q.iter().enumerate().map(joint).collect()
}

/// Nats by which the first suspect and each other would stand out from one another.
fn separations(known: &Known, probe: &Probe, suspects: &[Suspect]) -> Vec<f64> {
    let scene = Scene::seen_at(&probe.robot, &probe.points, probe.sensor);
    let mut weighing = Weighing::new(
        &complete(&known.shapes.setups, probe.complete),
        known.repeatability,
    );
    weighing.tolerate(|p, d| MODEL * norm(scene.reference[p][d]));
    weighing.about_slopes(|p, d| scene.reference[p][d]);
    let springs = match probe.sensor {
        None => Springs::of(&weighing, &probe.robot, &probe.points, known.springs.spread).columns,
        Some(_) => DMatrix::zeros(weighing.len(), known.springs.columns.ncols()),
    };
    let seen = |suspect: &Suspect| -> Vec<DVector<f64>> {
        let own = &known.seats.seats[suspect.seat];
        let name = own.cause.card().name;
        let new = |column: &usize| match probe.trusted.contains(&name) {
            true => DVector::zeros(weighing.len()),
            false => {
                let Column { prior, .. } = known.seats.columns[*column];
                let step = (*column - own.first, prior);
                let pattern = scene.pattern(own.cause, &own.site, step, known.shapes);
                weighing.whiten(|p, d| pattern.slopes.at(p)[d])
            }
        };
        let both = |c: &usize| stacked(&known.columns.column(*c), &new(c));
        suspect.columns.iter().map(both).collect()
    };
    let columns: Vec<Vec<DVector<f64>>> = suspects.iter().map(seen).collect();
    let springs = Springs {
        columns: rows(&known.springs.columns, &springs),
        spread: known.springs.spread,
    };
    let left = |a: usize, b: usize| {
        let signal = columns[a].iter().zip(&suspects[a].amounts);
        let zero = DVector::zeros(springs.columns.nrows());
        let signal = signal.fold(zero, |sum, (column, x)| sum + column * *x);
        imitated(&signal, &columns[b], &springs)
    };
    let others = 1..suspects.len();
    others.map(|b| left(0, b).min(left(b, 0))).collect()
}

/// Nats of a signal that a rival, its amounts free, leaves.
fn imitated(signal: &DVector<f64>, rival: &[DVector<f64>], springs: &Springs) -> f64 {
    let n = rival.len();
    let wide = (vec![1e6; n], vec![Bound::Low(f64::MIN); n]);
    let field = Field::new(signal, &Columns::wide(rival.to_vec()), springs, wide);
    let all: Vec<usize> = (0..n).collect();
    (0.5 * field.base - field.amounts(&all, |_| 1.0).nats).max(0.0)
}

/// The set-ups with every component read, if asked for.
fn complete(setups: &[Setup], all: bool) -> Vec<Setup> {
    let mut setups = setups.to_vec();
    for setup in setups.iter_mut().filter(|_| all) {
        let known = setup.lines.iter().flatten().next().copied();
        setup
            .lines
            .iter_mut()
            .for_each(|line| *line = line.or(known));
    }
    setups
}

fn stacked(a: &DVector<f64>, b: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(a.len() + b.len(), a.iter().chain(b.iter()).copied())
}

fn rows(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let n = a.nrows();
    DMatrix::from_fn(n + b.nrows(), a.ncols(), |i, j| match i < n {
        true => a[(i, j)],
        false => b[(i - n, j)],
    })
}
