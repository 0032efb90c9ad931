//! The law of time along a path: travels between halts, and turns on the spot.

use super::build::{Part, Path, Piece, Side};
use super::double_s::{Limits, Phase};
use super::element::{Element, SpotTurn};
use super::profile::{Step, append, lower, profile};
use super::quaternion::Quaternion;
use crate::ground::vector::{V3, norm, scale};

/// A turn on the spot runs as if its angle were swept by this lever: its speed, acceleration and jerk
/// are those of the path divided by it, m.
pub const TURN_LEVER: f64 = 0.1;

/// Speeds that a path is run at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feeds {
    /// Feed of cuts, m/s, instead of what the path states.
    pub feed: Option<f64>,
    /// Feed where neither says one, m/s.
    pub fallback: f64,
    /// Rapid motions, m/s.
    pub rapid: f64,
}

/// What happens between two halts, or at one.
#[derive(Debug, Clone)]
pub enum Stage {
    /// Along the path: phases over its arc length.
    Travel(Vec<Phase>),
    /// On the spot at this arc length (m): phases over angle times [`TURN_LEVER`].
    Turn(SpotTurn, f64, Vec<Phase>),
}

/// Everything in time.
#[derive(Debug, Clone)]
pub struct Timeline {
    /// In order, without gaps.
    pub stages: Vec<Stage>,
    /// Length in time, s.
    pub duration: f64,
}

/// Where the tool is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Arc length, m.
    pub s: f64,
    /// Place, m.
    pub point: V3,
    /// Orientation without the free turn about the spindle.
    pub orientation: Quaternion,
    /// Feed, m/s.
    pub feed: f64,
}

impl Feeds {
    /// The speed asked for on a piece, m/s: on a blend the lower of its two elements.
    pub fn of(&self, path: &Path, piece: &Piece) -> f64 {
        let own = |k: usize| self.of_element(&path.programme.elements[k]);
        match piece.part {
            Part::Element(k, _) => own(k),
            Part::Blend(k, _) => own(k).min(own(k + 1)),
        }
    }

    /// The speed asked for on an element, m/s.
    pub fn of_element(&self, element: &Element) -> f64 {
        match element.rapid {
            true => self.rapid,
            false => self.feed.or(element.feed).unwrap_or(self.fallback),
        }
    }

    /// The speeds asked for along the whole path.
    pub fn steps(&self, path: &Path) -> Vec<Step> {
        let mut steps = Vec::new();
        for piece in &path.pieces {
            append(&mut steps, [piece.begin, piece.end()], self.of(path, piece));
        }
        steps
    }
}

impl Timeline {
    /// Runs the path at the speeds of `steps`; `slow` gives the share of its usual speed for a turn
    /// on the spot, which is stretched in time so that its joints accelerate by the square of it.
    pub fn run(path: &Path, steps: &[Step], limits: &Limits, slow: &[f64]) -> Self {
        let (mut stages, mut t, mut first) = (Vec::new(), 0.0, 0);
        let mut slow = slow.iter();
        for (k, halt) in path.halts.iter().enumerate() {
            for turn in &halt.turns {
                let way = norm(turn.ends[0].way_to(turn.ends[1])) * TURN_LEVER;
                let here = steps.partition_point(|step| step.end < halt.at);
                let speed = steps.get(here);
                let share = *slow.next().unwrap_or(&1.0);
                let speed = speed.map_or(0.01, |step| step.speed) * share;
                let whole = Step {
                    begin: 0.0,
                    end: way,
                    speed,
                };
                let phases = profile(&[whole], &limits.slowed(share), t);
                t = end_of(&phases, t);
                stages.push(Stage::Turn(*turn, halt.at, phases));
            }
            let Some(next) = path.halts.get(k + 1) else {
                break;
            };
            while steps.get(first).is_some_and(|step| step.end <= halt.at) {
                first += 1;
            }
            let part = cut(&steps[first..], [halt.at, next.at]);
            let phases = profile(&part, limits, t);
            t = end_of(&phases, t);
            stages.push(Stage::Travel(phases));
        }
        Self {
            stages,
            duration: t,
        }
    }

    /// States at k·`cycle` from 0 to the first at or after the end.
    pub fn sample(&self, path: &Path, cycle: f64) -> Vec<State> {
        let count = (self.duration / cycle - 1e-9).ceil().max(0.0) as usize;
        let mut states = Vec::with_capacity(count + 1);
        let (mut stage, mut phase) = (0, 0);
        for k in 0..=count {
            let t = (k as f64 * cycle).min(self.duration);
            (stage, phase) = self.find(stage, phase, t);
            states.push(self.state(path, stage, phase, t));
        }
        states
    }

    /// The phase at `t`, searched from the one before.
    fn find(&self, mut stage: usize, mut phase: usize, t: f64) -> (usize, usize) {
        loop {
            let phases = self.stages.get(stage).map_or(&[][..], Stage::phases);
            let over = |phase: &Phase| phase.begin + phase.duration <= t;
            while phases.get(phase).is_some_and(over) {
                phase += 1;
            }
            if phase < phases.len() || stage + 1 >= self.stages.len() {
                return (stage, phase);
            }
            (stage, phase) = (stage + 1, 0);
        }
    }

    fn state(&self, path: &Path, stage: usize, phase: usize, t: f64) -> State {
        match self.stages.get(stage) {
            Some(Stage::Travel(phases)) => travelled(path, phases, phase, t),
            Some(Stage::Turn(turn, s, phases)) => turned(path, turn, *s, at(phases, phase, t)[0]),
            None => travelled(path, &[], 0, t),
        }
    }
}

impl Stage {
    /// Its phases.
    pub fn phases(&self) -> &[Phase] {
        match self {
            Self::Travel(phases) | Self::Turn(.., phases) => phases,
        }
    }
}

fn travelled(path: &Path, phases: &[Phase], phase: usize, t: f64) -> State {
    let [s, feed, _] = at(phases, phase, t);
    let s = s.min(path.length);
    let start = phases.first().is_some_and(|first| s <= first.s);
    let side = if start { Side::After } else { Side::Before };
    State {
        s,
        point: path.point(s),
        orientation: path.orientation(s, side),
        feed: feed.max(0.0),
    }
}

fn turned(path: &Path, turn: &SpotTurn, s: f64, way: f64) -> State {
    let whole = turn.ends[0].way_to(turn.ends[1]);
    let share = (way / (norm(whole) * TURN_LEVER)).min(1.0);
    State {
        s,
        point: path.point(s),
        orientation: turn.ends[0].turned(scale(share, whole)),
        feed: 0.0,
    }
}

/// Arc length, speed and acceleration; after the last phase those of its end, at rest.
fn at(phases: &[Phase], phase: usize, t: f64) -> [f64; 3] {
    match (phases.get(phase), phases.last()) {
        (Some(phase), _) => phase.at(t),
        (None, Some(last)) => [last.at(last.begin + last.duration)[0], 0.0, 0.0],
        (None, None) => [0.0; 3],
    }
}

fn end_of(phases: &[Phase], begin: f64) -> f64 {
    phases
        .last()
        .map_or(begin, |last| last.begin + last.duration)
}

/// The steps between two arc lengths.
fn cut(steps: &[Step], [begin, end]: [f64; 2]) -> Vec<Step> {
    let inside = steps.iter().take_while(|step| step.begin < end);
    let whole = [Step {
        begin,
        end,
        speed: f64::INFINITY,
    }];
    let clipped = inside.map(|step| Step {
        begin: step.begin.max(begin),
        end: step.end.min(end),
        ..*step
    });
    let clipped: Vec<Step> = clipped.filter(|step| step.end > step.begin).collect();
    lower(&clipped, &whole)
}
