//! Hammer tests of robots whose dampings nobody knows: their file is right otherwise, or as uncertain as
//! files of real robots are.

use super::case::Case;
use super::dynamics::Dynamics;
use super::family::{self, Spread};
use super::hammer::{Plan, Scene};
use super::hammer_case::{note, text};
use super::poses::random_pose;
use super::robot::{M3, Robot};
use crate::blind_generator::random::Random;
use nalgebra::DMatrix;

/// Dampings off by up to a factor of three either way.
const DAMPING: f64 = 0.4;
/// What nobody knows better: masses, centres, inertias and springs of a robot file.
const UNCERTAIN: Spread = Spread {
    stiffness: 0.02,
    damping: DAMPING,
    mass: 0.02,
    com: 0.005,
    inertia: 0.05,
};
/// Calibration of hammer and sensor, relative.
const GAIN: f64 = 0.01;

/// Bodies as in the file, stiffnesses as far off as it says; sensors from quiet to noisy.
pub fn damping_case(seed: u64) -> (Case, Vec<Mode>) {
    let mut random = Random::new(seed, "damping");
    let file = family::draw(0, &mut random);
    let spread = Spread {
        stiffness: random.choose(&[0.003, 0.03]),
        damping: DAMPING,
        mass: 0.0,
        com: 0.0,
        inertia: 0.0,
    };
    case(seed, file, (spread, [1.0; 3]), [0.003, 0.1], &mut random)
}

/// Bodies and springs as uncertain as those of real robots, quiet sensors.
pub fn uncertain_case(seed: u64) -> (Case, Vec<Mode>) {
    let mut random = Random::new(seed, "uncertain damping");
    let file = family::draw(0, &mut random);
    case(
        seed,
        file,
        (UNCERTAIN, [1.0; 3]),
        [0.003, 0.01],
        &mut random,
    )
}

/// The same with hammer and sensor off their calibration, and any sensor.
pub fn miscalibrated_case(seed: u64) -> (Case, Vec<Mode>) {
    let mut random = Random::new(seed, "miscalibrated damping");
    let file = family::draw(0, &mut random);
    let gain = |random: &mut Random| 1.0 + GAIN * random.normal_within(2.5);
    let hammer = gain(&mut random);
    let sensor = std::array::from_fn(|_| gain(&mut random) / hammer);
    case(seed, file, (UNCERTAIN, sensor), [0.003, 0.1], &mut random)
}

fn case(
    seed: u64,
    file: Robot,
    (spread, gains): (Spread, [f64; 3]),
    noise: [f64; 2],
    random: &mut Random,
) -> (Case, Vec<Mode>) {
    let stiffness = spread.stiffness;
    let real = family::real(&file, spread, random);
    let mut plan = Plan::draw(&real, random_pose(&file, random), random);
    plan.noise.size = random.log_uniform(noise[0], noise[1]);
    let mut scene = Scene::new(real.clone());
    scene.sensor = M3::from_diagonal(&gains.into());
    let modes = poles(&Dynamics::of(&real, &plan.pose));
    let case = Case {
        kind: "damping".into(),
        seed,
        truths: Vec::new(),
        csv: text(&scene, &plan, stiffness, random),
        note: note(&plan, stiffness, &file),
        file,
        real,
    };
    (case, modes)
}

/// Frequency, Hz, and damping ratio.
pub type Mode = (f64, f64);

/// Modes by the eigenvalues of the state matrix, rising.
fn poles(dynamics: &Dynamics) -> Vec<Mode> {
    let n = dynamics.sites.len();
    let inverse = dynamics.mass.clone().try_inverse().unwrap();
    let mut state = DMatrix::zeros(2 * n, 2 * n);
    let mut put =
        |at: (usize, usize), block: DMatrix<f64>| state.view_mut(at, (n, n)).copy_from(&block);
    put((0, n), DMatrix::identity(n, n));
    put((n, 0), -&inverse * &dynamics.stiffness);
    put((n, n), -&inverse * &dynamics.damping);
    let poles = state.complex_eigenvalues();
    let upper = poles.iter().filter(|p| p.im > 0.0);
    let mut modes: Vec<Mode> = upper
        .map(|p| (p.norm() / std::f64::consts::TAU, -p.re / p.norm()))
        .collect();
    modes.sort_by(|a, b| a.0.total_cmp(&b.0));
    modes
}
