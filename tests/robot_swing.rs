//! Motion in time: energy, damping, the gap, and agreement with statics and linear theory.

use ident::ground::spatial::norm;
use ident::motion::swing::{Energy, State, SwingWork, energy, step, tool_offset};
use ident::motion::{self, Chain, Work};
use ident::robot::{Robot, builtin};

const POSE: [f64; 6] = [0.3, -1.3, 1.6, 0.4, 0.7, -0.2];
const STEP: f64 = 2e-4;

fn robot(damped: bool, gap: f64) -> Robot {
    let mut robot = builtin::named("kr210").unwrap().unwrap();
    for joint in &mut robot.joints {
        for spring in joint.drive.iter_mut().chain(joint.tilt.iter_mut()) {
            spring.damping *= f64::from(u8::from(damped));
        }
        joint.drive.as_mut().unwrap().backlash = vec![gap; usize::from(gap > 0.0)];
    }
    robot
}

/// Speeds that a blow on the tool leaves behind, m/s along x, y, z.
fn struck(chain: &Chain) -> State {
    let mut state = State::settled(chain, &POSE).unwrap();
    let mut work = Work::new(chain);
    motion::forward_kinematics(chain, &mut work, &state.angles());
    let columns = motion::jacobian(chain, &work);
    for (v, column) in state.v.iter_mut().zip(&columns) {
        *v = 0.01 * (column[0] - 0.7 * column[1] + 0.5 * column[2]);
    }
    state
}

fn run(chain: &Chain, state: &mut State, seconds: f64, mut see: impl FnMut(Energy)) {
    let mut space = SwingWork::new(chain);
    for _ in 0..(seconds / STEP).round() as usize {
        step(chain, &mut space, state, STEP, [0.0; 3], &POSE).unwrap();
        see(energy(chain, &mut space, state));
    }
}

/// Largest change of energy against the energy of the blow.
fn drift(gap: f64) -> f64 {
    let chain = motion::elastic(&robot(false, gap));
    let mut state = struck(&chain);
    let start = energy(&chain, &mut SwingWork::new(&chain), &state);
    let mut worst = 0.0_f64;
    run(&chain, &mut state, 10.0, |now| {
        worst = worst.max((now.total() - start.total()).abs())
    });
    println!(
        "gap {gap}: energy of the blow {} J, drift {worst} J",
        start.kinetic
    );
    worst / start.kinetic
}

#[test]
fn a_conservative_swing_keeps_its_energy() {
    assert!(drift(0.0) < 1e-6);
}

/// Blows against the stops of a gap excite everything at once; the springs still lose nothing, and
/// what is left (1.7e-6 of the blow at 0.2 ms) is the change of M along the step, second order in it.
#[test]
fn gaps_keep_the_energy_too() {
    assert!(drift(1e-4) < 1e-5);
}

#[test]
fn damping_only_takes_away() {
    let chain = motion::elastic(&robot(true, 5e-5));
    let mut state = struck(&chain);
    let start = energy(&chain, &mut SwingWork::new(&chain), &state);
    let mut last = start.total();
    run(&chain, &mut state, 3.0, |now| {
        assert!(now.total() <= last + 1e-9 * start.kinetic);
        last = now.total();
    });
    assert!(last < start.total() - 0.9 * start.kinetic);
}

#[test]
fn a_steady_force_ends_in_the_static_deflection() {
    let chain = motion::elastic(&robot(true, 0.0));
    let mut state = State::settled(&chain, &POSE).unwrap();
    let mut space = SwingWork::new(&chain);
    let before = tool_offset(&chain, &mut space, &state);
    for _ in 0..20_000 {
        step(
            &chain,
            &mut space,
            &mut state,
            STEP,
            [0.0, 200.0, -300.0],
            &POSE,
        )
        .unwrap();
    }
    let after = tool_offset(&chain, &mut space, &state);
    let moved = [0, 1, 2].map(|k| after[k] - before[k]);
    let q = chain.spread(&POSE);
    let (_, linear) =
        motion::statics::deflect(&chain, &mut Work::new(&chain), &q, [0.0, 200.0, -300.0]);
    let gap = norm([0, 1, 2].map(|k| moved[k] - linear[k]));
    assert!(gap < 0.01 * norm(linear), "{moved:?} {linear:?}");
}

#[test]
fn a_gap_moves_the_tool_between_its_stops() {
    let gap = 3e-4;
    let (tight, loose) = (robot(true, 0.0), robot(true, gap));
    let offset = |robot: &Robot| {
        let chain = motion::elastic(robot);
        let state = State::settled(&chain, &POSE).unwrap();
        let (mut space, v) = (SwingWork::new(&chain), state.v.clone());
        let mut moved = state.clone();
        step(&chain, &mut space, &mut moved, 1e-4, [0.0; 3], &POSE).unwrap();
        assert!(
            moved.v.iter().zip(&v).all(|(a, b)| (a - b).abs() < 1e-6),
            "settled states stay"
        );
        tool_offset(&chain, &mut space, &state)
    };
    assert!(norm(offset(&loose)) > norm(offset(&tight)) + 0.5 * gap);
}
