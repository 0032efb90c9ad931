//! Linearisation, modes and frequency responses against independent routes.

use ident::ground::dual::{Dual, Scalar};
use ident::motion::frf::{C64, FrfWork, lines, response};
use ident::motion::linear::{Linear, gravity_stiffness};
use ident::motion::modes::{complex_modes, modal};
use ident::motion::{self, Chain, Work, linearise};
use ident::robot::{Robot, builtin};
use nalgebra::DMatrix;
use std::f64::consts::TAU;

const POSE: [f64; 6] = [0.3, -1.3, 1.6, 0.4, 0.7, -0.2];

/// Damping that is not proportional to stiffness, so that modes couple.
fn robot() -> Robot {
    let mut robot = builtin::named("kr210").unwrap().unwrap();
    for (i, joint) in robot.joints.iter_mut().enumerate() {
        joint.drive.as_mut().unwrap().damping *= 1.0 + 0.7 * i as f64;
    }
    robot
}

fn setup(robot: &Robot) -> (Chain, Linear) {
    let chain = motion::elastic(robot);
    let linear = linearise(&chain, &mut Work::new(&chain), &chain.spread(&POSE)).unwrap();
    (chain, linear)
}

/// J (K + sD + s²M)⁻¹ Jᵀ by a dense complex inverse.
fn dense(linear: &Linear, s: C64) -> DMatrix<C64> {
    let n = linear.n;
    let at = |m: &[f64], i: usize, j: usize| m[i * n + j];
    let a = DMatrix::from_fn(n, n, |i, j| {
        C64::from(at(&linear.stiffness, i, j))
            + s * at(&linear.damping, i, j)
            + s * s * at(&linear.mass, i, j)
    });
    let j = DMatrix::from_fn(3, n, |axis, i| C64::from(linear.tool[i][axis]));
    &j * a.lu().solve(&j.transpose()).unwrap()
}

fn agree(robot: &Robot) {
    let (_, linear) = setup(robot);
    let modal = modal(&linear).unwrap();
    let s: Vec<C64> = lines(120.0, 7.3)
        .iter()
        .map(|f| C64::new(-1.5, TAU * f))
        .collect();
    let got = response(&modal, &mut FrfWork::default(), &s);
    assert_eq!(got.len(), s.len());
    for (response, s) in got.iter().zip(&s) {
        let wanted = dense(&linear, *s);
        let size = wanted.iter().map(|x| x.norm()).fold(0.0, f64::max);
        for a in 0..3 {
            for b in 0..3 {
                assert!(
                    (response[a][b] - wanted[(a, b)]).norm() < 1e-9 * size,
                    "{s} {a}{b}"
                );
            }
        }
    }
}

#[test]
fn response_equals_a_dense_inverse() {
    agree(&robot());
    agree(&builtin::named("kr210").unwrap().unwrap());
    agree(&builtin::named("kr300").unwrap().unwrap());
}

#[test]
fn at_rest_the_response_is_the_static_compliance() {
    let (chain, linear) = setup(&robot());
    let modal = modal(&linear).unwrap();
    let got = response(&modal, &mut FrfWork::default(), &[C64::new(0.0, 0.0)]);
    let mut work = Work::new(&chain);
    let (c, _) = motion::statics::deflect(&chain, &mut work, &chain.spread(&POSE), [0.0; 3]);
    for a in 0..3 {
        for b in 0..3 {
            assert!((got[0][a][b].re - c[a][b]).abs() < 1e-11 * c[a][a].max(c[b][b]));
        }
    }
}

#[test]
fn damped_modes_are_roots() {
    for robot in [robot(), builtin::named("kr300").unwrap().unwrap()] {
        let (_, linear) = setup(&robot);
        let modal = modal(&linear).unwrap();
        let modes = complex_modes(&linear, &modal);
        for mode in modes.iter().take(6) {
            let size = mode.frequency_hz * TAU;
            let root = C64::new(
                -mode.damping_ratio,
                (1.0 - mode.damping_ratio.powi(2)).sqrt(),
            ) * size;
            let near = dense(&linear, root * (1.0 + 1e-7)).norm();
            let off = dense(&linear, root * 1.2).norm();
            assert!(near > 1e3 * off, "{} Hz is no pole", mode.frequency_hz);
        }
    }
}

#[test]
fn gravity_stiffness_is_the_derivative_of_gravity() {
    let (chain, _) = setup(&robot());
    let q = chain.spread(&POSE);
    let n = chain.len();
    let mut work = Work::new(&chain);
    linearise(&chain, &mut work, &q).unwrap();
    let k = gravity_stiffness(&chain, &work);
    let q: Vec<Dual<18>> = (0..n).map(|i| Dual::variable(q[i], i)).collect();
    let mut work = Work::<Dual<18>>::new(&chain);
    let g = motion::gravity_torque(&chain, &mut work, &q);
    for i in 0..n {
        for j in 0..n {
            assert!(
                (g[i].eps[j] - k[i * n + j]).abs() < 1e-9,
                "{i},{j}: {} {}",
                g[i].eps[j],
                k[i * n + j]
            );
        }
    }
}

#[test]
fn dual_numbers_differentiate_the_dynamics() {
    let (chain, _) = setup(&robot());
    let n = chain.len();
    let q0: Vec<f64> = (0..n).map(|i| 0.1 * i as f64 - 0.7).collect();
    let (v0, t0) = (vec![0.3; n], vec![50.0; n]);
    let lift = |x: &[f64]| {
        x.iter()
            .map(|x| Dual::<2>::constant(*x))
            .collect::<Vec<_>>()
    };
    let mut q = lift(&q0);
    q[1] = Dual::variable(q0[1], 0);
    let mut torque = lift(&t0);
    torque[3] = Dual::variable(t0[3], 1);
    let mut work = Work::<Dual<2>>::new(&chain);
    let exact = motion::aba(&chain, &mut work, &q, &lift(&v0), &torque).to_vec();
    let mut plain = Work::new(&chain);
    let mut at = |h: f64| {
        let mut q = q0.clone();
        q[1] += h;
        motion::aba(&chain, &mut plain, &q, &v0, &t0).to_vec()
    };
    let (up, down) = (at(1e-6), at(-1e-6));
    let size = exact.iter().map(|a| a.eps[0].abs()).fold(0.0, f64::max);
    for i in 0..n {
        let difference = (up[i] - down[i]) / 2e-6;
        assert!((exact[i].eps[0] - difference).abs() < 1e-6 * size, "{i}");
    }
    let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == 3))).collect();
    motion::crba(&chain, &mut plain, &q0);
    let m = plain.mass_matrix();
    let back: Vec<f64> = (0..n)
        .map(|i| (0..n).map(|j| m[i * n + j] * exact[j].eps[1]).sum())
        .collect();
    for i in 0..n {
        assert!((back[i] - unit[i]).abs() < 1e-9, "M dq̈/dτ = 1");
    }
}
