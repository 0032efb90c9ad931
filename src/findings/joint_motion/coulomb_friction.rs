//! Dry friction between motor and spring.

use super::balanced;
use super::channels::Channels;
use super::friction::sign;
use super::joint::Joint;
use super::presliding::dahl;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};

/// Shares of the top speed over which friction changes sign.
const SIGN_WIDTHS: [f64; 3] = [0.005, 0.03, 0.1];
/// Share of the top speed below which a joint rests.
pub(super) const AT_REST: f64 = 0.01;
/// What of the friction of the last motion may hold through a rest.
const HELD: [f64; 2] = [0.6, 1.0];

/// Motion of the link over which it builds up, rad ...
const REACHES: [f64; 5] = [2e-4, 5e-4, 1.2e-3, 3e-3, 8e-3];
/// ... what holds before the record, ...
const BEGINS: [f64; 3] = [0.0, -1.0, 1.0];
/// ... and by how much it is greater below which share of the top speed (Stribeck 1902).
const STICTION: [(f64, f64); 5] = [
    (0.0, 1.0),
    (0.15, 0.03),
    (0.15, 0.1),
    (0.4, 0.03),
    (0.4, 0.1),
];

/// Share of the readings in which a joint must move either way: motion in one direction alone makes friction a zero.
const SELDOM: f64 = 0.04;

/// As the engine takes it: one amount is the twist that it takes, rad.
pub(super) const EFFECT: Effect<Joint> = Effect {
    name: "coulomb_friction",
    summary: "Dry friction between motor and spring takes torque that never reaches the link.",
    mechanism: "dry friction",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |joint| {
        let top = joint.data.top_speed().max(f64::MIN_POSITIVE);
        let speed = &joint.data.speed;
        let mut signs = SIGN_WIDTHS
            .map(|w| joint.column(|i| (speed[i] / (w * top)).tanh()))
            .to_vec();
        signs.extend(HELD.map(|held| held_sign(speed, AT_REST * top, held)));
        // the torque jumps with it, and is smoothed
        let smooth: Vec<Vec<f64>> = signs.iter().map(|c| joint.data.smoothed(c)).collect();
        signs.extend(smooth);
        let mut members: Vec<Member> = signs.into_iter().map(Member::free).collect();
        members.extend(built_up(joint));
        members.retain(|m| balanced(&m.columns[0], 0.5, SELDOM));
        let members = members.into_iter().map(Member::positive);
        vec![Place::new(&joint.site, members.collect())]
    },
    parameters: |_, blamed| vec![("twist", blamed.amounts[0], "rad")],
    would_tell: "reverse the motion slowly at constant load, then change the load at rest: friction of the drive follows the direction of motion",
};

/// Sign of the motion; at rest, so much of that of the last motion.
fn held_sign(speed: &[f64], still: f64, held: f64) -> Vec<f64> {
    let mut last = 0.0;
    let of = |v: &f64| match v.abs() > still {
        true => {
            last = v.signum();
            last
        }
        false => held * last,
    };
    speed.iter().map(of).collect()
}

/// Friction that builds up after a reversal and is greater in slow motion; its shape is the reach.
fn built_up(joint: &Joint) -> Vec<Member> {
    let begun = REACHES.iter().flat_map(|r| BEGINS.map(|b| (*r, b)));
    let of = |(reach, begin): (f64, f64)| {
        let columns = STICTION.map(|stiction| column(&joint.data, (reach, begin), stiction));
        columns.map(|column| Member::free(column).shaped(&[reach]))
    };
    begun.flat_map(of).collect()
}

fn column(data: &Channels, (reach, begin): (f64, f64), (more, slow): (f64, f64)) -> Vec<f64> {
    let top = data.top_speed().max(f64::MIN_POSITIVE);
    let stick = |v: &f64| more * (-(v / (slow * top)).powi(2)).exp();
    let held = dahl(&data.motor, reach, begin).into_iter();
    let each: Vec<f64> = held
        .zip(&data.speed)
        .map(|(held, v)| held * (1.0 + stick(v)))
        .collect();
    data.smoothed(&each)
}

/// Columns that together make dry friction by any of these laws, nearly: its sign, built up over every reach, greater in slow
/// motion by either measure.
pub(super) fn dry(data: &Channels) -> Vec<Vec<f64>> {
    let built = REACHES.map(|reach| column(data, (reach, 0.0), STICTION[0]));
    let more = [STICTION[3], STICTION[4]].map(|stiction| column(data, (REACHES[0], 0.0), stiction));
    let mut all = vec![sign(data)];
    all.extend(built.into_iter().chain(more));
    all
}

/// Half of what the friction that was found makes of all that it can hold before the record: until it has built up, or,
/// where its sign alone is told, until the first motion.
pub(super) fn begun(joint: &Joint, blamed: &Blamed) -> Vec<f64> {
    let data = &joint.data;
    match blamed.shape.first() {
        Some(reach) => {
            let [back, forth] = [-1.0, 1.0].map(|begin| dahl(&data.motor, *reach, begin));
            data.smoothed(&joint.column(|i| 0.5 * (forth[i] - back[i])))
        }
        None => {
            let still = AT_REST * data.top_speed();
            let first = data.speed.iter().position(|v| v.abs() > still);
            joint.column(|i| f64::from(u8::from(first.is_some_and(|f| i < f))))
        }
    }
}
