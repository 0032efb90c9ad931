//! Hammer tests of robots whose dampings nobody knows and whose file is right otherwise.

use super::case::Case;
use super::dynamics::Dynamics;
use super::family::{self, Spread};
use super::hammer::{Plan, Scene};
use super::hammer_case::{note, text};
use super::poses::random_pose;
use super::random::Random;
use nalgebra::DMatrix;

/// Bodies as in the file, stiffnesses as far off as it says, dampings by up to a factor of three either
/// way; sensors from quiet to noisy.
pub fn damping_case(seed: u64) -> (Case, Vec<Mode>) {
    let mut random = Random::new(seed, "damping");
    let file = family::draw(0, &mut random);
    let stiffness = random.choose(&[0.003, 0.03]);
    let spread = Spread {
        stiffness,
        damping: 0.4,
        mass: 0.0,
        com: 0.0,
        inertia: 0.0,
    };
    let real = family::real(&file, spread, &mut random);
    let mut plan = Plan::draw(&real, random_pose(&file, &mut random), &mut random);
    plan.noise.size = random.log_uniform(0.003, 0.1);
    let modes = poles(&Dynamics::of(&real, &plan.pose));
    let case = Case {
        kind: "damping".into(),
        seed,
        truths: Vec::new(),
        csv: text(&Scene::new(real.clone()), &plan, stiffness, &mut random),
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
