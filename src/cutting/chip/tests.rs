use super::*;
use std::f64::consts::PI;

const R: f64 = 8e-3;

fn tips(radii: &[f64]) -> Vec<Tip> {
    let tip = |radius: &f64| Tip {
        radius: *radius,
        aside: 0.0,
    };
    radii.iter().map(tip).collect()
}

fn bite(steady: &Steady, phi: f64, radii: &[f64]) -> f64 {
    steady
        .bite([phi.sin(), phi.cos()], 0, &tips(radii))
        .thickness
}

/// The chip along the ray of a tip from the tool's own axis, every place straight from the motion.
fn chip_of_a_shifted_axis(q: f64, runout: [f64; 2], teeth: usize, phi: f64) -> f64 {
    let place = |tooth: usize, turn: f64| {
        let at = phi + turn;
        let own = at + TAU * tooth as f64 / teeth as f64;
        let (ahead, aside) = (at, at + 0.5 * PI);
        let x = q * turn + R * own.sin() + runout[0] * ahead.sin() + runout[1] * aside.sin();
        let y = R * own.cos() + runout[0] * ahead.cos() + runout[1] * aside.cos();
        [x, y]
    };
    let ([sin, cos], own) = ([phi.sin(), phi.cos()], place(0, 0.0));
    let left = |tooth: usize| {
        let mut turn = -TAU * tooth as f64 / teeth as f64;
        for _ in 0..20 {
            let [x, y] = place(tooth, turn);
            turn -= ((x - own[0]) * cos - (y - own[1]) * sin) / R;
        }
        let [x, y] = place(tooth, turn);
        (own[0] - x) * sin + (own[1] - y) * cos
    };
    (1..teeth).map(left).fold(f64::MAX, f64::min)
}

#[test]
fn runout_moves_tips_outwards_and_aside() {
    let (q, teeth, runout) = (0.1e-3 * 3.0 / TAU, 3, [9e-6, -14e-6]);
    let steady = Steady::<f64> {
        feed_per_radian: q,
        stock: Stock::Full,
        before: 0.0,
    };
    let tool = crate::cutting::Tool::square(R, teeth, 0.0);
    let disc = tool.discs(1e-3)[0];
    let tips: Vec<Tip> = (0..teeth).map(|j| tool.tip(&disc, j, runout)).collect();
    for phi in [0.4_f64, 1.1, 2.0, 2.7] {
        let exact = chip_of_a_shifted_axis(q, runout, teeth, phi);
        let found = steady.bite([phi.sin(), phi.cos()], 0, &tips).thickness;
        assert!((found - exact).abs() < 1e-8, "{phi}: {found} {exact}");
    }
}

#[test]
fn a_slow_feed_leaves_the_first_order() {
    let c = 1e-6;
    let steady = Steady {
        feed_per_radian: c * 2.0 / TAU,
        stock: Stock::Full,
        before: 0.0,
    };
    for phi in [0.3, 1.2, 2.5] {
        let h = bite(&steady, phi, &[R, R]);
        assert!((h / (c * phi.sin()) - 1.0).abs() < 1e-3, "{h} at {phi}");
    }
}

#[test]
fn a_tooth_stands_where_its_surface_is() {
    // the earlier tooth's position, straight from its trochoid, lies on the ray
    let (q, teeth, k, phi) = (0.1e-3, 3.0, 2.0, 0.9_f64);
    let rho = left_by(q, [phi.sin(), phi.cos()], TAU * k / teeth, R);
    let point = [rho * phi.sin(), rho * phi.cos()];
    let nearest = (0..2_000_000)
        .map(|i| {
            let eps = -0.1 + 1e-7 * f64::from(i);
            let x = -q * (TAU * k / teeth - eps) + R * (phi + eps).sin();
            (x - point[0]).hypot(R * (phi + eps).cos() - point[1])
        })
        .fold(f64::MAX, f64::min);
    assert!(nearest < 2e-9, "{nearest}");
}

#[test]
fn a_higher_tooth_takes_what_the_lower_one_left() {
    let steady = Steady {
        feed_per_radian: 0.1e-3 * 2.0 / TAU,
        stock: Stock::Full,
        before: 0.0,
    };
    let radii = [R + 5e-6, R - 5e-6];
    let of = |tooth: usize| steady.bite([1.0, 0.0], tooth, &tips(&radii)).thickness;
    assert!((of(0) - 110e-6).abs() < 1e-9 && (of(1) - 90e-6).abs() < 1e-9);
    let deep = [R + 80e-6, R - 80e-6];
    assert!((steady.bite([1.0, 0.0], 0, &tips(&deep)).thickness - 200e-6).abs() < 1e-9);
    assert!(steady.bite([1.0, 0.0], 1, &tips(&deep)).thickness < 0.0);
}

#[test]
fn stock_on_one_side_is_met_there_only() {
    let q = 0.1e-3 / TAU;
    let left = Steady {
        feed_per_radian: q,
        stock: Stock::Left(R - 2e-3),
        before: 0.0,
    };
    let right = Steady {
        stock: Stock::Right(-(R - 2e-3)),
        before: 0.0,
        ..left
    };
    let reach = (0.75_f64).acos();
    assert!(bite(&left, 0.5 * reach, &[R]) > 0.0 && bite(&left, 1.1 * reach, &[R]) < 0.0);
    assert!(bite(&right, PI - 0.5 * reach, &[R]) > 0.0);
    assert!(bite(&right, PI - 1.1 * reach, &[R]) < 0.0);
}
