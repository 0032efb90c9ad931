//! Motion in time: energy, damping, the gap, and agreement with statics and linear theory.

use ident::effects::{Composite, Scene};
use ident::ground::spatial::norm;
use ident::motion::swing::{Energy, State, SwingWork, energy, step, tool_offset};
use ident::motion::{self, Chain, Work};
use ident::robot::{Body, JointEffect, Robot, Spring, builtin};

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

/// Axis 6 of the example, somewhat wider: width rad, slip load N·m, spread, tilt.
const HYSTERESIS: [f64; 4] = [1.2e-4, 348.0, 1.09, -0.377];

/// The robot with hysteresis in every drive, its slip load in proportion to the stiffness.
fn hysteretic() -> Robot {
    let mut robot = robot(false, 0.0);
    for joint in &mut robot.joints {
        let drive = joint.drive.as_mut().unwrap();
        let [width, slip, spread, tilt] = HYSTERESIS;
        let values = vec![width, slip * drive.stiffness / 3.14e5, spread, tilt];
        drive.effects = vec![JointEffect::new("hysteresis", values).unwrap()];
    }
    robot
}

#[test]
fn hysteresis_only_takes_away() {
    let chain = motion::elastic(&hysteretic());
    let mut state = struck(&chain);
    let start = energy(&chain, &mut SwingWork::new(&chain), &state);
    let mut last = start.total();
    run(&chain, &mut state, 2.0, |now| {
        assert!(now.total() <= last + 1e-9 * start.kinetic);
        last = now.total();
    });
    let lost = (start.total() - last) / start.kinetic;
    println!("hysteresis took {lost} of the blow");
    assert!(lost > 0.05);
}

/// Contacts that never slip are springs: they store, and lose nothing.
#[test]
fn contacts_that_stick_keep_the_energy() {
    let mut robot = hysteretic();
    for joint in &mut robot.joints {
        let effect = &mut joint.drive.as_mut().unwrap().effects[0];
        effect.values[0] *= 1e4;
        effect.values[1] *= 1e4;
    }
    let chain = motion::elastic(&robot);
    let mut state = struck(&chain);
    let start = energy(&chain, &mut SwingWork::new(&chain), &state);
    run(&chain, &mut state, 1.0, |now| {
        assert!((now.total() - start.total()).abs() < 1e-6 * start.kinetic);
    });
}

/// One hinge, pressed slowly to and fro: the loop in time is the loop of the effect.
#[test]
fn a_slow_cycle_is_the_loop_of_the_effect() {
    let (lever, inertia, k) = (0.5, 2.0, 3.14e5);
    let mut chain = Chain::default();
    chain.gravity = [0.0; 3];
    let body = Body {
        mass: 10.0,
        com: [0.0; 3],
        inertia: [inertia, inertia, inertia, 0.0, 0.0, 0.0],
    };
    let effect = JointEffect::new("hysteresis", HYSTERESIS.to_vec()).unwrap();
    let spring = Spring {
        effects: vec![effect],
        ..Spring::new(k, 0.2 * (k * inertia).sqrt())
    };
    chain.drives.push(0);
    chain.push("A6", [0.0, 0.0, 1.0], [0.0; 3], Some(body), Some(spring));
    chain.end_at([lever, 0.0, 0.0], ident::ground::spatial::IDENTITY);
    // two cycles of 20 s to 400 N·m, in steps of 2 ms; the damper settles the hinge
    // within 25 ms and adds 0.3 % to the loss
    let (steps, h) = (20_000, 2e-3);
    let moment = |t: f64| 400.0 * (std::f64::consts::TAU * t / 20.0).sin();
    let (mut state, mut space) = (State::relaxed(&chain, &[0.0]), SwingWork::new(&chain));
    let (mut time, mut load, mut bend) = (vec![0.0], vec![0.0], vec![0.0]);
    for i in 0..steps {
        let at = (i as f64 + 0.5) * h;
        let force = [0.0, moment(at) / lever, 0.0];
        step(&chain, &mut space, &mut state, h, force, &[0.0]).unwrap();
        time.push((i + 1) as f64 * h);
        load.push(moment((i + 1) as f64 * h));
        bend.push(state.bend[0]);
    }
    let scene = Scene::new(time, load.clone(), k, 2);
    let model = Composite::named(&["hysteresis"]).unwrap();
    let p = [&[k], &HYSTERESIS[..]].concat();
    let wanted = model.predict(&p, &scene);
    let worst = bend
        .iter()
        .zip(&wanted)
        .fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    let area = |x: &[f64]| {
        let last = steps / 2..steps;
        last.map(|i| 0.5 * (load[i] + load[i + 1]) * (x[i + 1] - x[i]))
            .sum::<f64>()
    };
    let (found, expected) = (area(&bend), area(&wanted));
    println!("loop: largest difference {worst:e} rad, loss {found} J instead of {expected} J");
    assert!(worst < 0.01 * HYSTERESIS[0], "{worst}");
    assert!(expected > 0.0 && (found / expected - 1.0).abs() < 0.01);
}
