//! ident's side of `beside_pinocchio.py`: `cargo bench --bench beside -- URDF STATES 6|18 PASSES`.
//!
//! STATES is text: the number of states and of hinges n, then per state q, v, a and torque (4 n numbers).
//! 6: the URDF as it is. 18: every joint followed by two virtual ones, link on the last. With 0 passes
//! prints what ident computes at every state as JSON, else microseconds per call.

#[path = "../../tests/robot_common/mod.rs"]
mod robot_common;

use ident::motion::{self, Chain, Work, statics};
use ident::robot::{Robot, Spring, load};
use serde_json::{Value, json};
use std::hint::black_box;
use std::time::Instant;

/// Angles, speeds, accelerations and torques of every hinge.
struct State([Vec<f64>; 4]);

fn main() {
    // `--bench` comes from cargo
    let typed: Vec<String> = std::env::args()
        .skip(1)
        .filter(|argument| argument != "--bench")
        .collect();
    let [urdf, states, hinges, passes] = typed.as_slice() else {
        println!("usage: beside URDF STATES 6|18 PASSES (see benches/peers/README.md)");
        return;
    };
    let robot = load::load(urdf, None).unwrap().robot;
    let chain = chain_of(&robot, hinges == "18");
    let states = read_states(&std::fs::read_to_string(states).unwrap(), chain.len());
    let answer = match passes.parse().unwrap() {
        0 => states.iter().map(|state| answers(&chain, state)).collect(),
        passes => times(&chain, &states, passes),
    };
    println!("{answer}");
}

/// The chain with springs of 1e6·(1 + i) N·m/rad, as in pinocchio.cpp.
fn chain_of(robot: &Robot, with_virtual_axes: bool) -> Chain {
    let mut chain = match with_virtual_axes {
        true => robot_common::virtual18(robot),
        false => motion::rigid(robot),
    };
    for (i, spring) in chain.springs.iter_mut().enumerate() {
        *spring = Some(Spring::new(1e6 * (1.0 + i as f64), 0.0));
    }
    chain
}

fn read_states(text: &str, hinges: usize) -> Vec<State> {
    let mut numbers = text.split_whitespace().map(|word| word.parse().unwrap());
    let mut next = || -> f64 { numbers.next().unwrap() };
    let (count, n) = (next() as usize, next() as usize);
    assert_eq!(n, hinges, "the states belong to another chain");
    let mut vector = || (0..n).map(|_| next()).collect();
    (0..count)
        .map(|_| State(std::array::from_fn(|_| vector())))
        .collect()
}

fn answers(chain: &Chain, State([q, v, a, torque]): &State) -> Value {
    let mut work = Work::new(chain);
    let rows = |flat: &[f64]| flat.chunks(chain.len()).map(<[f64]>::to_vec).collect();
    let pose = motion::forward_kinematics(chain, &mut work, q);
    let columns = motion::jacobian(chain, &work);
    let jacobian: Vec<f64> = (0..6)
        .flat_map(|row| columns.iter().map(move |column| column[row]))
        .collect();
    let (mass, jacobian): (Vec<Vec<f64>>, Vec<Vec<f64>>) =
        (rows(motion::crba(chain, &mut work, q)), rows(&jacobian));
    json!({
        "point": pose.point,
        "rotation": pose.rotation,
        "jacobian": jacobian,
        "M": mass,
        "G": motion::gravity_torque(chain, &mut work, q).to_vec(),
        "RNEA": motion::rnea(chain, &mut work, q, v, a).to_vec(),
        "ABA": motion::aba(chain, &mut work, q, v, torque).to_vec(),
        "compliance": statics::deflect(chain, &mut work, q, [0.0; 3]).0,
    })
}

fn times(chain: &Chain, states: &[State], passes: usize) -> Value {
    let mut work = Work::new(chain);
    json!({
        "forward dynamics": time(states, passes, |State([q, v, _, torque])| {
            motion::aba(chain, &mut work, q, v, torque)[0]
        }),
        "RNEA": time(states, passes, |State([q, v, a, _])| {
            motion::rnea(chain, &mut work, q, v, a)[0]
        }),
        "CRBA": time(states, passes, |State([q, ..])| motion::crba(chain, &mut work, q)[0]),
        "compliance": time(states, passes, |State([q, ..])| {
            statics::deflect(chain, &mut work, q, [0.0; 3]).0[0][0]
        }),
    })
}

/// Microseconds per call, in the fastest of `passes` rounds over all states: short rounds escape
/// other programs.
fn time(states: &[State], passes: usize, mut call: impl FnMut(&State) -> f64) -> f64 {
    let mut round = || {
        let start = Instant::now();
        for state in states {
            black_box(call(black_box(state)));
        }
        start.elapsed().as_secs_f64() * 1e6 / states.len() as f64
    };
    (0..passes).map(|_| round()).fold(f64::INFINITY, f64::min)
}
