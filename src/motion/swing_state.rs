//! Where an elastic robot is in its motion, and how it stands at rest.

use super::chain::Chain;
use super::hinge_law::{HingeLaw, Memory};
use super::statics::{Weight, equilibrium, springs};
use super::work::Work;
use crate::ground::problem::Outcome;

/// Where the robot is and what it is told.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Time, s.
    pub time: f64,
    /// Commanded angle θ of every hinge (virtual axes: 0), rad.
    pub command: Vec<f64>,
    /// q − θ of every hinge, rad: kept apart from θ, because stiff springs need all its digits.
    pub bend: Vec<f64>,
    /// Speed of every hinge on the link side, rad/s.
    pub v: Vec<f64>,
    /// What the elastic hinges remember, in the order of [`springs`].
    pub memory: Vec<Memory>,
}

impl State {
    /// At rest with all springs relaxed at the driven joint angles `joints` (rad).
    pub fn relaxed(chain: &Chain, joints: &[f64]) -> Self {
        let still = vec![0.0; chain.len()];
        Self {
            time: 0.0,
            command: chain.spread(joints),
            bend: still.clone(),
            memory: resting(chain, &still),
            v: still,
        }
    }

    /// At rest under its own weight, every gap closed on the side the weight presses to, and no load on
    /// the contacts of a hysteresis.
    ///
    /// # Errors
    /// No equilibrium: see [`equilibrium`].
    pub fn settled(chain: &Chain, joints: &[f64]) -> Outcome<Self> {
        let (mut state, mut work) = (Self::relaxed(chain, joints), Work::new(chain));
        let tight = equilibrium(
            chain,
            &mut work,
            &state.command,
            &state.bend,
            [0.0; 3],
            Weight::Acting,
        )?;
        let play = closed(chain, &tight.deflection);
        let rest = equilibrium(
            chain,
            &mut work,
            &state.command,
            &play,
            [0.0; 3],
            Weight::Acting,
        )?;
        state.bend = rest
            .deflection
            .iter()
            .zip(&play)
            .map(|(bend, play)| bend + play)
            .collect();
        state.memory = resting(chain, &state.bend);
        Ok(state)
    }

    /// Angle of every hinge on the link side, rad.
    pub fn angles(&self) -> Vec<f64> {
        self.command
            .iter()
            .zip(&self.bend)
            .map(|(command, bend)| command + bend)
            .collect()
    }
}

/// Half of every gap towards the side that the springs are bent to; a hinge without load floats in
/// the middle.
fn closed(chain: &Chain, bend: &[f64]) -> Vec<f64> {
    const UNLOADED: f64 = 1e-12;
    let mut play = vec![0.0; chain.len()];
    for (i, spring) in springs(chain).filter(|(i, _)| bend[*i].abs() > UNLOADED) {
        play[i] = 0.5 * spring.gap() * bend[i].signum();
    }
    play
}

/// Springs bent by `bend`, their contacts without load.
fn resting(chain: &Chain, bend: &[f64]) -> Vec<Memory> {
    springs(chain)
        .map(|(i, spring)| HingeLaw::of(spring).at_rest(-bend[i]))
        .collect()
}
