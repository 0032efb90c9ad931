//! Joints that are more than a spring: gaps and dry contacts beside the linear robot.
//!
//! The linear robot holds such a joint with its spring k x; what its law gives instead (a gap in series,
//! sliders beside the spring: [`HingeLaw`]) is put back as a torque, c = k x − T(x), constant over a step and
//! taken at the mean over the way of that step: work is stored or lost to the contacts, and none is made
//! (discrete gradient: Gonzalez 1996).

use super::oscillator::{Oscillator, along};
use super::pose::Held;
use crate::ground::spatial::{V3, add, dot, scale};
use crate::ground::stats::largest;
use crate::motion::Chain;
use crate::motion::hinge_law::{HingeLaw, Memory};
use crate::motion::modes::Modal;
use crate::motion::statics::springs;
use nalgebra::DMatrix;

/// One such joint.
#[derive(Debug, Clone)]
struct Hinge {
    /// Which elastic coordinate it is.
    coordinate: usize,
    stiffness: f64,
    law: HingeLaw,
    memory: Memory,
    /// Present deflection, rad.
    place: f64,
    /// Torque c over the last step, N·m.
    last: f64,
    /// The same over the next one, should it go on as it did.
    next: f64,
    /// Energy in it, J.
    stored: f64,
}

/// All of a robot.
#[derive(Debug, Clone)]
pub struct Loose {
    hinges: Vec<Hinge>,
    work: Work,
}

/// What a step works with, joint by joint.
#[derive(Debug, Clone, Default)]
struct Work {
    /// Deflections without what the joints do, and with it, rad.
    free: Vec<f64>,
    with: Vec<f64>,
    /// By how much these torques do not lead to these deflections yet, rad.
    rest: Vec<f64>,
    /// Torques c, N·m, and how they change with the deflection.
    torques: Vec<f64>,
    slopes: Vec<f64>,
    step: Vec<f64>,
}

/// How the loose joints answer within a step of one length at one pose.
#[derive(Debug, Clone, Default)]
pub struct Ports {
    /// Deflection of each joint per mode.
    rows: Vec<Vec<f64>>,
    /// Change of the state by a torque of one on each.
    gains: Vec<Vec<f64>>,
    /// Deflection of each by a torque of one on each, rad/(N·m).
    answer: DMatrix<f64>,
    /// How far to go for what is left of the deflections: the inverse of their slope when it was taken last.
    steps: DMatrix<f64>,
    /// Deflection of each by a force at the tool, rad/N.
    by_force: Vec<V3>,
}

/// Rounds at most; the laws are chains of straight pieces.
const ROUNDS: usize = 16;
/// The first rounds go by the slopes that were taken last: the laws are chains of straight pieces, on which joints stay for
/// many steps. Then by Newton.
const STALE: usize = 2;
/// A torque this near to its law is met, as a share of the spring's own over the largest deflection.
const NEAR: f64 = 1e-7;
/// Static rounds: force and gap settle between each other.
const STATIC: usize = 8;

impl Loose {
    /// The joints of a chain that have gaps or contacts, at rest under the weight: every gap closed on the
    /// side to which that presses, and no load on the contacts.
    pub fn of(chain: &Chain, held: &Held) -> Self {
        let own = springs(chain)
            .enumerate()
            .filter_map(|(coordinate, (_, spring))| {
                let plain = spring.gap() <= 0.0 && spring.contacts().is_empty();
                (!plain).then_some(())?;
                let law = HingeLaw::of(spring);
                let place = law.settled(-held.weight[coordinate]);
                let memory = law.at_rest(place);
                let last = spring.stiffness * place - memory.torque;
                Some(Hinge {
                    coordinate,
                    stiffness: spring.stiffness,
                    last,
                    next: last,
                    stored: law.stored(&memory),
                    memory,
                    law,
                    place,
                })
            });
        Self {
            hinges: own.collect(),
            work: Work::default(),
        }
    }

    /// Whether the robot is linear.
    pub fn is_empty(&self) -> bool {
        self.hinges.is_empty()
    }

    /// Torques on the elastic coordinates that put the springs of the linear robot where these joints rest.
    pub fn held(&self, loads: &mut [f64]) {
        for hinge in &self.hinges {
            loads[hinge.coordinate] = hinge.stiffness * hinge.place;
        }
    }

    /// How they answer within the steps of `oscillator`.
    pub fn ports(&self, modal: &Modal, oscillator: &Oscillator) -> Ports {
        let n = modal.n;
        let row = |hinge: &Hinge| modal.shape[hinge.coordinate * n..][..n].to_vec();
        let rows: Vec<Vec<f64>> = self.hinges.iter().map(row).collect();
        // Φᵀ e is the row of Φ
        let gains: Vec<Vec<f64>> = rows.iter().map(|row| oscillator.pushed(row)).collect();
        let answer = DMatrix::from_fn(rows.len(), rows.len(), |i, j| along(&rows[i], &gains[j]));
        let by_force = rows.iter().map(|row| oscillator.bent_by_force(row));
        Ports {
            steps: DMatrix::identity(rows.len(), rows.len()),
            by_force: by_force.collect(),
            rows,
            gains,
            answer,
        }
    }

    /// Torques c over a step at whose end the linear robot alone would have `state`, with a force at the tool
    /// still to come.
    pub fn torques(&mut self, ports: &mut Ports, state: &[f64], force: V3) -> &[f64] {
        let Self { hinges, work } = self;
        let free = ports.rows.iter().zip(&ports.by_force);
        work.free.clear();
        work.free
            .extend(free.map(|(row, by)| along(row, state) + dot(*by, force)));
        work.torques.clear();
        work.torques.extend(hinges.iter().map(|hinge| hinge.next));
        work.with.clone_from(&work.free);
        ports.answered(&work.torques, &mut work.with);
        for round in 0..ROUNDS {
            work.ask(hinges);
            ports.answered(&work.torques, &mut work.rest);
            if largest(&work.rest) <= NEAR * largest(&work.with) {
                break;
            }
            if round >= STALE {
                ports.anew(&work.slopes);
            }
            work.step.clear();
            work.step.resize(work.rest.len(), 0.0);
            add_product(&ports.steps, &work.rest, &mut work.step);
            let each = work.with.iter_mut().zip(&work.step);
            each.for_each(|(x, step)| *x += step);
        }
        &self.work.torques
    }

    /// Takes the step to `state`.
    pub fn take(&mut self, ports: &Ports, state: &[f64]) -> f64 {
        let moves = self.hinges.iter_mut().zip(&ports.rows);
        moves.map(|(hinge, row)| hinge.go(along(row, state))).sum()
    }

    /// What they keep beyond the springs of the linear robot, J.
    pub fn stored(&self) -> f64 {
        let own = |hinge: &Hinge| hinge.stored - 0.5 * hinge.stiffness * hinge.place.powi(2);
        self.hinges.iter().map(own).sum()
    }

    /// Where they let the tool go under weight and a force (N) beyond what their springs do, m, workpiece axes.
    pub fn slack(&self, held: &Held, force: V3) -> V3 {
        let one = |hinge: &Hinge| {
            let torque = hinge.load(held, force);
            let beyond = hinge.under(torque) - torque / hinge.stiffness;
            scale(beyond, held.linear.tool[hinge.coordinate])
        };
        self.hinges.iter().map(one).fold([0.0; 3], add)
    }

    /// Solves for the place of the tool where force and slack depend on each other: `solved` gives place and
    /// force for a slack.
    ///
    /// # Errors
    /// Those of `solved`.
    pub fn settle<E>(
        &self,
        held: &Held,
        slack: V3,
        solved: impl Fn(V3) -> Result<(V3, V3), E>,
    ) -> Result<(V3, V3, V3), E> {
        let (mut slack, mut found) = (slack, solved(slack)?);
        for round in 0..STATIC {
            let next = self.slack(held, found.1);
            // what flips to and fro between two sides rests between them
            let step = if round < 2 { 1.0 } else { 0.5 };
            let moved = scale(step, add(next, scale(-1.0, slack)));
            slack = add(slack, moved);
            found = solved(slack)?;
            if dot(moved, moved) < 1e-20 {
                break;
            }
        }
        Ok((found.0, found.1, slack))
    }

    /// Goes to rest under weight and a force (N) at a pose.
    pub fn rest(&mut self, held: &Held, force: V3) {
        for hinge in &mut self.hinges {
            let place = hinge.under(hinge.load(held, force));
            hinge.go(place);
        }
    }
}

impl Work {
    /// Torques at the deflections that are assumed, and how far these are from those without torques.
    fn ask(&mut self, hinges: &[Hinge]) {
        self.rest.clear();
        self.slopes.clear();
        for (i, hinge) in hinges.iter().enumerate() {
            let (torque, slope) = hinge.missing(self.with[i]);
            self.torques[i] = torque;
            self.slopes.push(slope);
            self.rest.push(self.free[i] - self.with[i]);
        }
    }
}

impl Ports {
    /// Adds what torques on the joints change.
    pub fn push(&self, state: &mut [f64], torques: &[f64]) {
        for (gain, torque) in self.gains.iter().zip(torques) {
            let own = state.iter_mut().zip(gain);
            own.for_each(|(value, gain)| *value += torque * gain);
        }
    }

    /// Adds the deflections under torques.
    fn answered(&self, torques: &[f64], sum: &mut [f64]) {
        add_product(&self.answer, torques, sum);
    }

    /// Takes the slopes of the torques anew: what is left of the deflections changes by 1 − A T′ with them.
    fn anew(&mut self, slopes: &[f64]) {
        let n = slopes.len();
        let slope = DMatrix::from_fn(n, n, |i, j| {
            f64::from(u8::from(i == j)) - self.answer[(i, j)] * slopes[j]
        });
        if let Some(steps) = slope.try_inverse() {
            self.steps = steps;
        }
    }
}

/// Adds a square matrix times a vector.
fn add_product(matrix: &DMatrix<f64>, vector: &[f64], sum: &mut [f64]) {
    let columns = matrix.as_slice().chunks_exact(vector.len().max(1));
    for (column, share) in columns.zip(vector) {
        let own = sum.iter_mut().zip(column);
        own.for_each(|(sum, entry)| *sum += entry * share);
    }
}

impl Hinge {
    /// Mean of k x − T(x) on the way to `to`, N·m, and its slope.
    fn missing(&self, to: f64) -> (f64, f64) {
        let mean = self.law.mean(&self.memory, self.place, to);
        let spring = 0.5 * self.stiffness * (self.place + to);
        (spring - mean.torque, 0.5 * self.stiffness - mean.slope)
    }

    /// Goes on; what is lost to dry contacts, J.
    fn go(&mut self, to: f64) -> f64 {
        let mean = self.law.step(&mut self.memory, self.place, to);
        let before = self.last;
        self.last = 0.5 * self.stiffness * (self.place + to) - mean;
        self.next = 2.0 * self.last - before;
        let work = mean * (to - self.place);
        self.place = to;
        let before = std::mem::replace(&mut self.stored, self.law.stored(&self.memory));
        work - (self.stored - before)
    }

    /// Torque on it from weight and a force at the tool, N·m.
    fn load(&self, held: &Held, force: V3) -> f64 {
        dot(held.linear.tool[self.coordinate], force) - held.weight[self.coordinate]
    }

    fn under(&self, torque: f64) -> f64 {
        self.law.under(&self.memory, self.place, torque)
    }
}
