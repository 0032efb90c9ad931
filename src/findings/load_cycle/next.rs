//! The next experiment: which schedule would tell the candidates apart, by computed separation.

use crate::effects::{Composite, Scene};
use crate::experiments::schedule::SCHEDULES;
use crate::fit::least_squares::{Problem, minimise};
use crate::fit::observation::{Observation, Part};
use crate::inference::descent::Stop;
use crate::measurement::cycles::Cycles;
use crate::signal::colour::Colour;
use crate::signal::cosine::Cosine;

/// An experiment with what it would separate.
#[derive(Debug, Clone, PartialEq)]
pub struct Proposal {
    /// What to do.
    pub about: String,
    /// Nats by which the candidates' predictions would then differ, after re-fitting the rest.
    pub separation: f64,
}

/// Rows of a simulated experiment.
const ROWS: usize = 400;

/// The best schedule for telling `winner` (with its parameters) from `rivals` (with theirs).
pub fn propose(
    winner: (&Composite, &[f64]),
    rivals: &[(&Composite, &[f64])],
    data: &Observation,
    noise: f64,
) -> Proposal {
    let cycles = data.cycles.count().clamp(3, 6);
    let period = data.scene.period;
    let mut best = Proposal {
        about: "repeat the same cycles more often".into(),
        separation: 0.0,
    };
    for schedule in SCHEDULES {
        let largest = data.scene.load_scale;
        let step = period * cycles as f64 / ROWS as f64;
        let (time, load) = schedule.history(cycles, period, 0.05 * period, step, largest);
        let separation = rivals
            .iter()
            .map(|rival| separation(winner, *rival, (&time, &load), data, noise))
            .fold(f64::INFINITY, f64::min);
        if separation.is_finite() && separation > best.separation {
            best = Proposal {
                about: schedule.about.to_string(),
                separation,
            };
        }
    }
    best
}

/// How badly the rival, re-fitted, imitates the winner under a load history, in nats.
fn separation(
    winner: (&Composite, &[f64]),
    rival: (&Composite, &[f64]),
    history: (&[f64], &[f64]),
    data: &Observation,
    noise: f64,
) -> f64 {
    let (time, load) = (history.0.to_vec(), history.1.to_vec());
    let cycles = Cycles::find(&load);
    let scene = Scene {
        time,
        load,
        duration: data.scene.duration,
        ..data.scene.clone()
    };
    let reading = winner.0.predict(winner.1, &scene);
    let n = reading.len();
    let colour = Colour::white(n, noise);
    let simulated = Observation {
        scene,
        reading,
        cycles,
        cosine: Cosine::new(n),
        block: 1,
        wild: Vec::new(),
        part: Part::default(),
        read: None,
        hums: Vec::new(),
    };
    let ignored = vec![false; n];
    let problem = Problem {
        model: rival.0,
        data: &simulated,
        colour: &colour,
        ignored: &ignored,
    };
    0.5 * minimise(&problem, rival.1, Stop::at_share(12, 1e-4)).chi2
}
