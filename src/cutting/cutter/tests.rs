//! Forces, volumes and chips against closed forms.

use super::{Cutter, Fineness};
use crate::cutting::dexel::Stock;
use crate::cutting::{Material, Tool};
use crate::ground::spatial::{V3, add, norm, scale, sub};
use std::f64::consts::{FRAC_PI_6, PI, TAU};

const MM: f64 = 1e-3;
const UP: V3 = [0.0, 0.0, 1.0];

fn cutter(tool: &Tool, width: f64, spacing: f64) -> Cutter {
    // material beside the line y = 0 that the tool follows: y from -width-R.. as the cut needs
    let al7075 = Material::linear_edge([1319.41, 788.83, 48.75, 19.65, 26.77, 2.05]);
    let stock = Stock::block(
        [0.0, -20.0 * MM, -10.0 * MM],
        [60.0 * MM, width, 0.0],
        spacing,
    );
    let fineness = Fineness {
        spacing_m: spacing,
        ..Fineness::usual(tool)
    };
    Cutter::new(tool, &al7075, stock.unwrap(), fineness, UP)
}

fn go(cutter: &mut Cutter, from: V3, to: V3, step: f64) {
    let way = sub(to, from);
    let count = (norm(way) / step).ceil() as usize;
    for i in 0..=count {
        let at = add(from, scale(i as f64 / count as f64, way));
        cutter.advance(at, UP).unwrap();
    }
}

/// Tooth angles of a slot and a half-down cut, and their mean forces in closed form, N = 2, a = 2 mm,
/// c = 0.1 mm (Altintas).
const CLOSED: [([f64; 2], V3); 2] = [
    ([0.0, PI], [-112.9676, 156.9602, 10.3070]),
    ([0.5 * PI, PI], [-1.9761, 120.6316, 5.1535]),
];
const AL7075: [f64; 6] = [1319.41, 788.83, 48.75, 19.65, 26.77, 2.05];

/// Mean forces of a slot and a half-down cut by dexels, a = 2 mm, c = 0.1 mm.
fn by_dexels(radius: f64, helix: f64, spacing: f64) -> [V3; 2] {
    [2.0 * radius, 0.0].map(|width| {
        let tool = Tool::square(radius, 2, helix);
        let low = [0.0, -2.0 * radius, -5.0 * MM];
        let stock = Stock::block(low, [4.0 * radius, width, 0.0], spacing);
        let fineness = Fineness {
            spacing_m: spacing,
            ..Fineness::usual(&tool)
        };
        let material = Material::linear_edge(AL7075);
        let mut cutter = Cutter::new(&tool, &material, stock.unwrap(), fineness, UP);
        let at = |x: f64| [x * radius, 0.0, -2.0 * MM];
        go(&mut cutter, at(-1.1), at(2.0), 0.0125 * radius);
        cutter.mean_load([0.1 * MM, 0.0, 0.0]).force
    })
}

/// What the closed forms leave out, to second order in chip over radius: the chip of trochoids is
/// c sin φ + c²/R (cos² φ / 2 - N/2π sin φ cos φ), and it begins and ends c/2R beyond 0 and π.
fn second_order(radius: f64, [from, to]: [f64; 2]) -> V3 {
    let [tc, rc, ac, te, re, ae] = AL7075;
    let (share, square, steps) = (2.0 * 2.0 / TAU, 0.01 / (radius / MM), 2000);
    let mut sum = [0.0; 3];
    for i in 0..steps {
        let phi = from + (to - from) * (i as f64 + 0.5) / steps as f64;
        let (s, c) = phi.sin_cos();
        let chip = square * (0.5 * c * c - 2.0 / TAU * s * c) * (to - from) / steps as f64;
        let more = [-tc * c - rc * s, tc * s - rc * c, ac];
        sum = add(sum, scale(chip, more));
    }
    let beyond = 0.5 * square / 0.1;
    for (phi, side) in [(0.0, 1.0), (PI, -1.0)] {
        if phi == from || phi == to {
            sum = add(sum, scale(beyond, [-te * side, -re * side, ae]));
        }
    }
    scale(share, sum)
}

/// The worst difference from what is expected, as a share of the force.
fn off(found: [V3; 2], expected: impl Fn(usize) -> V3) -> f64 {
    let worst = |i: usize| {
        let apart = sub(found[i], expected(i)).map(f64::abs);
        apart.into_iter().fold(0.0, f64::max) / norm(CLOSED[i].1)
    };
    worst(0).max(worst(1))
}

#[test]
fn mean_forces_are_those_of_the_closed_form_where_the_chip_is_small_beside_the_tool() {
    for helix in [0.0, FRAC_PI_6] {
        for spacing in [2.0 * MM, 1.85 * MM] {
            let off = off(by_dexels(40.0 * MM, helix, spacing), |i| CLOSED[i].1);
            println!("40 mm, {helix:.2}: {off:.5} from the closed form");
            assert!(off < 0.003, "{off}");
        }
    }
}

/// At 8 mm the closed forms, which are of first order in chip over radius, are themselves 0.56 % off the
/// chip of trochoids; the dexels are not.
#[test]
fn mean_forces_of_a_usual_tool_are_those_of_its_trochoids() {
    for helix in [0.0, FRAC_PI_6] {
        for spacing in [0.4 * MM, 0.37 * MM] {
            let found = by_dexels(8.0 * MM, helix, spacing);
            let exact = |i: usize| add(CLOSED[i].1, second_order(8.0 * MM, CLOSED[i].0));
            let [off, first] = [off(found, exact), off(found, |i| CLOSED[i].1)];
            println!("8 mm, {helix:.2}: {off:.5} from second order, {first:.5} from first");
            assert!(off < 0.004, "{off}");
        }
    }
}

/// Mean force of a tool whose material ends at a wall beside its way (y from `low` to `high`), along the rays of its trochoids: what
/// an earlier tooth left there, as far as it lies in the material. 2 teeth, c = 0.1 mm.
fn beside_walls(radius: f64, depth: f64, [low, high]: [f64; 2]) -> V3 {
    let ([tc, rc, ac, te, re, ae], per, count) = (AL7075, 0.1 * MM, 7200);
    let mut sum = [0.0; 3];
    for i in 0..count {
        let phi = TAU * (f64::from(i) + 0.5) / f64::from(count);
        let (s, c) = phi.sin_cos();
        // the tooth before stood on this ray an angle later, the tool that much nearer
        let back = |aside: f64| per * (aside / PI - 1.0);
        let aside = (0..20).fold(0.0_f64, |aside, _| (-back(aside) * c / radius).asin());
        let (x, y) = ((phi + aside).sin(), (phi + aside).cos());
        let chip = radius - (back(aside) + radius * x) * s - radius * y * c;
        let (inner, outer) = ((radius - chip) * c, radius * c);
        let within = inner.max(outer).min(high) - inner.min(outer).max(low);
        let h = chip * (within / (outer - inner).abs()).max(0.0) / MM;
        if chip > 0.0 && within > 0.0 {
            let (t, r) = (tc * h + te, rc * h + re);
            let force = [-t * c - r * s, t * s - r * c, ac * h + ae];
            sum = add(sum, scale(2.0 * depth / MM / f64::from(count), force));
        }
    }
    sum
}

#[test]
fn mean_forces_beside_a_wall_are_those_of_the_trochoids() {
    let (radius, helix) = (8.0 * MM, FRAC_PI_6);
    let tool = Tool::square(radius, 2, helix);
    for depth in [1.0 * MM, 2.0 * MM, 3.3 * MM] {
        for sides in [
            [-20.0, -7.0],
            [-20.0, -2.3],
            [-20.0, 4.0],
            [5.0, 20.0],
            [-4.0, 20.0],
        ] {
            let [low, high] = sides.map(|y| y * MM);
            let stock = Stock::block([0.0, low, -5.0 * MM], [30.0 * MM, high, 0.0], 0.4 * MM);
            let material = Material::linear_edge(AL7075);
            let usual = Fineness::usual(&tool);
            let mut cutter = Cutter::new(&tool, &material, stock.unwrap(), usual, UP);
            let at = |x: f64| [x * MM, 0.0, -depth];
            go(&mut cutter, at(-9.0), at(15.0), 0.1 * MM);
            let before = cutter.removed();
            go(&mut cutter, at(15.0), at(20.0), 0.1 * MM);
            let force = cutter.mean_load([0.1 * MM, 0.0, 0.0]).force;
            let exact = beside_walls(radius, depth, [low, high]);
            let off = norm(sub(force, exact)) / norm(exact);
            let area = depth * (high.min(radius) - low.max(-radius));
            let volume = (cutter.removed() - before) / (5.0 * MM * area) - 1.0;
            println!("{depth:.4} {sides:?}: {off:.5}, volume {volume:.5}");
            assert!(off < 0.005 && volume.abs() < 3e-3, "{force:?} {exact:?}");
        }
    }
}

#[test]
fn removed_volumes_are_those_of_the_closed_form() {
    let tool = Tool::square(8.0 * MM, 2, 0.0);
    let mut slot = cutter(&tool, 20.0 * MM, 0.4 * MM);
    go(
        &mut slot,
        [-20.0 * MM, 0.0, -2.0 * MM],
        [30.0 * MM, 0.0, -2.0 * MM],
        0.1 * MM,
    );
    let end = 0.5 * PI * 64.0;
    let exact = (30.0 * 16.0 + end) * 2.0;
    assert!(
        (slot.removed() * 1e9 / exact - 1.0).abs() < 2e-3,
        "{} {exact}",
        slot.removed() * 1e9
    );
    // a second pass half beside the first: only the new half
    let before = slot.removed();
    go(
        &mut slot,
        [30.0 * MM, 0.0, 5.0 * MM],
        [70.0 * MM, 30.0 * MM, 5.0 * MM],
        1.0 * MM,
    );
    go(
        &mut slot,
        [70.0 * MM, -6.3 * MM, 5.0 * MM],
        [70.0 * MM, -6.3 * MM, -2.0 * MM],
        0.5 * MM,
    );
    go(
        &mut slot,
        [70.0 * MM, -6.3 * MM, -2.0 * MM],
        [-10.0 * MM, -6.3 * MM, -2.0 * MM],
        0.1 * MM,
    );
    // beyond the first slot's end the whole width, before it 6.3 mm
    let n = 400_000;
    let area: f64 = (0..n)
        .map(|i| {
            let y = -14.3 + 16.0 * (i as f64 + 0.5) / n as f64;
            let slot = if y > -8.0 && y < 8.0 {
                30.0 + (64.0 - y * y).max(0.0).sqrt()
            } else {
                0.0
            };
            (60.0 - slot) * 16.0 / n as f64
        })
        .sum();
    let exact = 2.0 * area;
    let got = (slot.removed() - before) * 1e9;
    assert!((got / exact - 1.0).abs() < 2e-3, "{got} {exact}");
}

#[test]
fn ramps_and_arcs_have_their_volume() {
    let tool = Tool::square(5.0 * MM, 2, 0.0);
    let mut ramp = cutter(&tool, 20.0 * MM, 0.25 * MM);
    go(
        &mut ramp,
        [20.0 * MM, 0.0, 0.0],
        [50.0 * MM, 0.0, -3.0 * MM],
        0.1 * MM,
    );
    // mean depth of a ramp's slot: its bottom is level under the tool, so the deepest counts
    let n = 400_000;
    let depth = |x: f64, y: f64| {
        let half = (25.0 - y * y).max(0.0).sqrt();
        let reach = (x + half).min(50.0);
        if reach < 20.0 || x - half > 50.0 {
            0.0
        } else {
            ((reach - 20.0) / 10.0).max(0.0)
        }
    };
    let (mut sum, rows) = (0.0, 400);
    for j in 0..rows {
        let y = -5.0 + 10.0 * (j as f64 + 0.5) / rows as f64;
        for i in 0..n / rows {
            let x = 15.0 + 40.0 * (i as f64 + 0.5) / (n / rows) as f64;
            let half = (25.0 - y * y).max(0.0).sqrt();
            if x > 20.0 - half && x < 50.0 + half {
                sum += depth(x, y) * 400.0 / n as f64;
            }
        }
    }
    let got = ramp.removed() * 1e9;
    assert!((got / sum - 1.0).abs() < 2e-3, "{got} {sum}");
    let mut arc = cutter(&tool, 20.0 * MM, 0.25 * MM);
    let at = |a: f64| {
        [
            30.0 * MM + 12.0 * MM * a.sin(),
            -12.0 * MM * a.cos(),
            -2.0 * MM,
        ]
    };
    for i in 0..=400 {
        let before = at(PI * f64::from(i) / 400.0);
        arc.advance(before, UP).unwrap();
    }
    // the plunge at the first place is not swept: half a disc of the front, then the ring
    let ring = 0.5 * PI * (17.0 * 17.0 - 7.0 * 7.0) * 2.0;
    let got = arc.removed() * 1e9;
    assert!((got / ring - 1.0).abs() < 2e-3, "{got} {ring}");
}

/// The second of two equal depths at a wall takes what the first one took: the wall that it left above touches the tool and is
/// not cut.
#[test]
fn a_wall_that_an_earlier_depth_left_adds_no_force() {
    for (spacing, depth) in [(0.4 * MM, 1.7 * MM), (0.37 * MM, 1.1 * MM)] {
        let tool = Tool::square(8.0 * MM, 4, FRAC_PI_6);
        for side in [1.0 * MM, 3.3 * MM] {
            let mut cutter = cutter(&tool, side, spacing);
            let mut level = |n: f64| {
                let at = |x: f64| [x * MM, -8.0 * MM + side, -n * depth];
                cutter.jump([-20.0 * MM, -8.0 * MM + side, 5.0 * MM], UP);
                cutter.jump(at(-9.0), UP);
                go(&mut cutter, at(-9.0), at(30.0), 0.1 * MM);
                let load = cutter.mean_load([0.1 * MM, 0.0, 0.0]).force;
                go(&mut cutter, at(30.0), at(70.0), 0.1 * MM);
                load
            };
            let [first, second] = [level(1.0), level(2.0)];
            let off = norm(sub(second, first)) / norm(first);
            println!("{spacing:.5} {depth:.4} {side:.4}: {off:.4}");
            assert!(off < 0.005, "{first:?} {second:?}");
        }
    }
}
