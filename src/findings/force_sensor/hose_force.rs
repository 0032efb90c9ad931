//! The pull of a hose: from a place on the tool towards a far point, or any smooth load over the orientation, as
//! the even quadratic of the quaternion (one and the entries of R), on forces, moments or both.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{self, Effect, Place};
use crate::ground::spatial::{V3, cross, norm, of_quaternion, rotate_back, scale};
use crate::measurement::force_sensor::Reading;
use crate::path::quaternion::Quaternion;
use std::collections::BTreeSet;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "hose_force",
    summary: "A hose or cable pulls on the tool, smoothly over the orientation.",
    mechanism: "hose",
    // what its shapes miss of any hose
    law_error: 0.15,
    can_be: |_, _| true,
    places: |case| vec![Place::new("tool", members(case))],
    parameters: |case, blamed| {
        let square = |i: usize| (0..3).map(|c| blamed.part[6 * i + c].powi(2)).sum::<f64>();
        let n = case.test.readings.len();
        let mean = (0..n).map(square).sum::<f64>() / n as f64;
        vec![("force_rms", mean.sqrt(), "N")]
    },
    would_tell: "take the hose off and repeat",
};

/// The nine entries of R at a reading.
fn entries(case: &Case, i: usize) -> Vec<f64> {
    of_quaternion(case.test.readings[i].quaternion)
        .as_flattened()
        .to_vec()
}

/// Distance from the sensor at which a hose is tied to the tool, m: the scale of its moments, no more.
const TIED: f64 = 0.1;
/// Rings of directions between the vertical and the horizon in which the far end of a hose is looked for, and
/// how many lie on the horizon: a quarter of a radian apart, and what lies between is fitted along.
const RINGS: usize = 4;
const ON_HORIZON: f64 = 9.0;

/// Orientations from which a hose is wound: z upwards, and z downwards with x kept.
const UPRIGHT: [f64; 4] = [1.0, 0.0, 0.0, 0.0];
const HANGING: [f64; 4] = [0.0, 1.0, 0.0, 0.0];
/// Twist, in half turns, beyond which a wrist whose angle is off by a degree or two may have come the other way, and
/// part of the quaternion about z (a z within two degrees of turned over) below which its twist is anything: there the
/// orientation does not tell how a hose is wound.
const HALF_A_TURN: f64 = 0.98;
const UPSIDE_DOWN: f64 = 0.02;

fn members(case: &Case) -> Vec<Member> {
    let any = |channels: std::ops::Range<usize>| {
        let one = |own: usize, k: usize| {
            case.column(|i, c| if c == own { entries(case, i)[k] } else { 0.0 })
        };
        let columns = channels.flat_map(|own| (0..9).map(move |k| (own, k)));
        table::flexible(columns.map(|(own, k)| one(own, k)).collect())
    };
    match case.test.readings.len() {
        0..12 => Vec::new(),
        _ => {
            let windings = [UPRIGHT, HANGING].map(|from| windings(case, from));
            let ways = directions().into_iter();
            let tied = ways.flat_map(|way| {
                let each = windings.iter();
                each.flat_map(move |wound| table::flexible(towards(case, way, wound)))
            });
            tied.chain(any(0..3))
                .chain(any(0..6))
                .chain(any(3..6))
                .collect()
        }
    }
}

/// Directions over half a sphere, base frame: a pull the other way is one of the other sign.
fn directions() -> Vec<V3> {
    let mut all = vec![[0.0, 0.0, 1.0]];
    for ring in 1..=RINGS {
        let down = std::f64::consts::FRAC_PI_2 * ring as f64 / RINGS as f64;
        let count = (ON_HORIZON * down.sin()).round().max(3.0) as usize;
        let turn = if ring == RINGS {
            std::f64::consts::PI
        } else {
            std::f64::consts::TAU
        };
        let count = if ring == RINGS { count } else { 2 * count };
        all.extend((0..count).map(|k| {
            let about = turn * k as f64 / count as f64;
            [
                down.sin() * about.cos(),
                down.sin() * about.sin(),
                down.cos(),
            ]
        }));
    }
    all
}

/// A hose from the tool to a far point: it pulls that way, more or less as its end on the tool comes nearer
/// (which is first of all the end along the sensor's z), and with the lever of that end.
fn towards(case: &Case, way: V3, windings: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let aside = across(way);
    let pull =
        |i: usize, along: V3| rotate_back(&of_quaternion(case.test.readings[i].quaternion), along);
    let column = |of: &dyn Fn(usize) -> (V3, V3)| {
        case.column(|i, c| {
            let (force, moment) = of(i);
            if c < 3 { force[c] } else { moment[c - 3] }
        })
    };
    const NONE: V3 = [0.0; 3];
    let lever = |k: usize, force: V3| {
        cross(
            std::array::from_fn(|j| if j == k { TIED } else { 0.0 }),
            force,
        )
    };
    let near = |i: usize, power: i32| pull(i, way)[2].powi(power);
    let mut columns: Vec<Vec<f64>> = (0..3)
        .map(|power| column(&|i| (scale(near(i, power), pull(i, way)), NONE)))
        .collect();
    columns.push(column(&|i| {
        (NONE, scale(near(i, 1), lever(2, pull(i, way))))
    }));
    columns.extend(aside.map(|other| column(&|i| (pull(i, other), lever(2, pull(i, other))))));
    columns.extend([0, 1, 2].map(|k| column(&|i| (NONE, lever(k, pull(i, way))))));
    // the end on the tool moves against the far one: seen from the tool, a constant
    let unit = |k: usize| -> V3 { std::array::from_fn(|j| f64::from(u8::from(j == k))) };
    columns.extend([0, 1, 2].map(|k| column(&|_| (unit(k), NONE))));
    columns.extend(
        windings
            .iter()
            .map(|turn| column(&|i| (NONE, scale(TIED * turn[i], unit(2))))),
    );
    columns
}

/// How far a hose is wound in every reading, and one for every point of which nobody knows it.
fn windings(case: &Case, from: [f64; 4]) -> Vec<Vec<f64>> {
    let wound = |reading: &Reading| wound(reading.quaternion, from);
    let wound: Vec<Option<f64>> = case.test.readings.iter().map(wound).collect();
    let points = &case.points.0;
    let each = points.iter().zip(&wound);
    let unknown: BTreeSet<usize> = each
        .filter_map(|(point, wound)| wound.is_none().then_some(*point))
        .collect();
    let known = wound.iter().map(|w| w.unwrap_or(0.0)).collect();
    let at = |point| {
        points
            .iter()
            .map(|p| f64::from(u8::from(*p == point)))
            .collect()
    };
    std::iter::once(known)
        .chain(unknown.into_iter().map(at))
        .collect()
}

/// How far a hose along the sensor's z is wound, in half turns: the twist about z of the orientation, seen `from`
/// that in which it is not. `None` where the orientation does not tell it but the way on which the wrist came: after half
/// a turn either way, and where z has turned over.
fn wound(orientation: [f64; 4], from: [f64; 4]) -> Option<f64> {
    let [real, _, _, about] = Quaternion(from).inverse().times(Quaternion(orientation)).0;
    let twist = 2.0 * about.atan2(real) / std::f64::consts::PI;
    let twist = twist - 2.0 * (twist / 2.0).round();
    (real.hypot(about) > UPSIDE_DOWN && twist.abs() < HALF_A_TURN).then_some(twist)
}

/// Two directions across a third.
fn across(way: V3) -> [V3; 2] {
    let other = if way[2].abs() < 0.9 {
        [0.0, 0.0, 1.0]
    } else {
        [1.0, 0.0, 0.0]
    };
    let first = cross(way, other);
    let first = scale(norm(first).recip(), first);
    [first, cross(way, first)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_hanging_tool_winds_its_hose_as_a6_turns() {
        for (swing, turn) in [(0.0, 0.4), (0.9, -1.1), (-1.9, 2.9), (1.2, -3.0)] {
            let ((s, c), (t, u)) = (f64::sin_cos(0.5 * swing), f64::sin_cos(0.5 * turn));
            // about x by half a turn, then about the new y by the swing, then about the new z
            let orientation = [-s * t, c * u, -c * t, s * u];
            let found = wound(orientation, HANGING).unwrap();
            assert!((found - turn / PI).abs() < 1e-12, "{found} {turn}");
            let turned = orientation.map(|q| -q);
            assert!((wound(turned, HANGING).unwrap() - found).abs() < 1e-12);
        }
        assert_eq!(wound([0.0, 1.0, 0.0, 0.0], UPRIGHT), None);
        assert_eq!(wound([0.0, 0.0, 0.0, 1.0], UPRIGHT), None);
    }
}
