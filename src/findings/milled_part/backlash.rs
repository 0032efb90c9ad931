//! Play in a drive: the link lies on one flank of the gap and changes to the other where the joint turns
//! back, or where the load on it changes its sign.

use super::hold::{Lever, levers};
use super::{Case, Station};
use crate::findings::bent;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};
use crate::ground::spatial::{V3, scale};
use crate::ground::stats::{largest, rms};
use crate::robot::Robot;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "backlash",
    summary: "A drive has play: its link changes the flank where the joint turns back or its load changes sign.",
    mechanism: "backlash",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        let joints = case.setup.robot.joints.iter().enumerate();
        joints
            .filter(|(_, joint)| joint.drive.is_some())
            .map(|(i, joint)| {
                let mut all = members(case, i, &joint.name);
                // without a swing a link goes nowhere unless its joint turns back or its load changes sign
                if case.swings() || case.is_short && !all.is_empty() {
                    all.extend(milled(case, &joint.name));
                }
                Place::new(joint.name.clone(), all)
            })
            .collect()
    },
    parameters: |_, blamed| vec![("gap", blamed.amounts[0], "rad")],
    would_tell: "load the joint to and fro past zero (`ident stiffness`)",
};

/// Share of its greatest size below which a torque chooses no flank.
const IDLE: f64 = 0.02;
/// Ways by which a joint turns back until its link follows, rad: at once, as a link that something presses, and the gaps of a
/// good and of a worn drive.
const GAPS: [f64; 3] = [1e-6, 2e-5, 2e-4];

/// Forms whose flank follows the cut alone, and the cut with the weight.
const BY_THE_CUT: usize = GAPS.len();
const BY_ALL: usize = BY_THE_CUT + 1;
/// Nats by which a link whose weight does not load it is less likely, where that makes a difference: one in ten, a choice. Some robots have
/// springs or counterweights that carry it.
const WEIGHTLESS: f64 = 2.3;

fn members(case: &Case, joint: usize, site: &str) -> Vec<Member> {
    let Some(levers) = levers(&case.setup, &case.stations, site) else {
        return Vec::new();
    };
    let sides = sides(case, joint, &levers);
    let ignores_weight = sides[BY_THE_CUT] != sides[BY_ALL];
    let member = |(form, side): (usize, &Vec<f64>)| {
        let rare = if form == BY_THE_CUT && ignores_weight {
            WEIGHTLESS
        } else {
            0.0
        };
        Member::free(case.answered(&moved(&levers, side)))
            .positive()
            .shaped(&[-1.0, form as f64])
            .rare(rare)
    };
    let each = sides.iter().enumerate();
    each.filter_map(|(form, side)| Some(member((form, side.as_ref()?))))
        .collect()
}

/// Gaps with which the part is milled, rad, and the standard deviation of one before the data.
const MILLED: [f64; 7] = [0.6e-4, 0.9e-4, 1.3e-4, 1.9e-4, 2.7e-4, 3.8e-4, 5.4e-4];
const ORDINARY: f64 = 3e-4;
/// The form of a gap with which the part is milled.
const BY_CUT: f64 = 9.0;

/// What gaps do to the part where robot and cut are coupled in time: the link goes from flank to flank as its load changes sign,
/// whatever loads it.
fn milled(case: &Case, site: &str) -> Vec<Member> {
    let changed = |gap: f64| {
        let mut robot = case.setup.robot.clone();
        open(&mut robot, site, gap);
        case.coupled(&robot)
    };
    let shows = |column: &Vec<f64>| rms(column) > case.probe() && case.holds_some_of(column);
    if is_pressed(case, site) {
        return Vec::new();
    }
    match changed(MILLED[4]).as_ref().is_some_and(shows) {
        true => bent::sized(&MILLED, ORDINARY, &[-1.0, BY_CUT], changed),
        false => Vec::new(),
    }
}

/// Times of the torque of the cut by which the weight presses a link to its flank for good.
const PRESSED: f64 = 3.0;

/// Whether the weight holds a link on one flank, whatever the cut and its swing do.
fn is_pressed(case: &Case, site: &str) -> bool {
    let levers = levers(&case.setup, &case.stations, site).unwrap_or_default();
    let cut = levers.iter().map(|l| l.cut.abs()).fold(0.0, f64::max);
    let all_above = levers.iter().all(|l| l.weight > PRESSED * cut);
    let all_below = levers.iter().all(|l| l.weight < -PRESSED * cut);
    all_above || all_below
}

/// Gives a drive play, rad.
fn open(robot: &mut Robot, site: &str, gap: f64) {
    let mut joints = robot.joints.iter_mut();
    let own = joints.find(|joint| joint.name == site);
    if let Some(drive) = own.and_then(|joint| joint.drive.as_mut()) {
        drive.backlash.push(gap);
    }
}

/// Whether it was found as the part is milled with it.
pub(super) fn is_milled(blamed: &Blamed) -> bool {
    blamed.effect == EFFECT.name && blamed.shape.get(1) == Some(&BY_CUT)
}

/// Puts it into the robot; false for others.
pub fn alter(blamed: &Blamed, robot: &mut Robot) -> bool {
    let own = is_milled(blamed);
    if own {
        open(robot, &blamed.site, blamed.amounts[0].max(0.0));
    }
    own
}

/// Flanks at every station, form by form: by the motion, by the cut, by cut and weight.
fn sides(case: &Case, joint: usize, levers: &[Lever]) -> Vec<Option<Vec<f64>>> {
    let cut: Vec<f64> = levers.iter().map(|l| l.cut).collect();
    let loaded: Vec<f64> = levers.iter().map(|l| l.cut + l.weight).collect();
    let by_motion = GAPS.map(|gap| followed(case, joint, gap));
    let by_load = [&cut, &loaded].map(|drive| flanks_in_time(&case.stations, drive));
    by_motion.into_iter().chain(by_load).collect()
}

/// [`flanks`] of stations in the order of the file.
fn flanks_in_time(stations: &[Station], drive: &[f64]) -> Option<Vec<f64>> {
    let time = |i: &usize| stations[*i].time_s;
    let mut order: Vec<usize> = (0..drive.len()).collect();
    order.sort_by(|a, b| time(a).total_cmp(&time(b)));
    let sorted: Vec<f64> = order.iter().map(|i| drive[*i]).collect();
    let told = flanks(&sorted)?;
    let mut side = vec![0.0; told.len()];
    order.iter().zip(told).for_each(|(i, s)| side[*i] = s);
    Some(side)
}

/// Where a gap of one lets the tool go, m/rad.
fn moved(levers: &[Lever], side: &[f64]) -> Vec<V3> {
    let each = levers.iter().zip(side);
    each.map(|(l, side)| scale(0.5 * side, l.motion)).collect()
}

/// Where the tool goes at every station, m, if this is to blame.
pub(super) fn moves(case: &Case, blamed: &Blamed) -> Option<Vec<V3>> {
    if blamed.effect != EFFECT.name || is_milled(blamed) {
        return None;
    }
    let mut joints = case.setup.robot.joints.iter();
    let joint = joints.position(|joint| joint.name == blamed.site)?;
    let levers = levers(&case.setup, &case.stations, &blamed.site)?;
    let side = sides(case, joint, &levers)
        .into_iter()
        .nth(blamed.shape[1] as usize)??;
    let all = moved(&levers, &side).into_iter();
    Some(all.map(|m| scale(blamed.amounts[0], m)).collect())
}

/// Where in its gap a link lies that its joint drags along: +1 where the joint turns backwards, rapid motions
/// included; none where it never turns back.
fn followed(case: &Case, joint: usize, gap: f64) -> Option<Vec<f64>> {
    let rows = case.setup.way.rows();
    let angles: Vec<f64> = rows.iter().map(|row| row.joints[joint]).collect();
    let sides = dragged(&angles, gap);
    let at = |s: &Station| {
        let after = rows.partition_point(|row| row.time_s < s.time_s);
        sides[after.min(sides.len() - 1)]
    };
    let side: Vec<f64> = case.stations.iter().map(at).collect();
    side.iter()
        .any(|s| (s - side[0]).abs() > 0.5)
        .then_some(side)
}

/// A link in a gap, at every angle of its joint: where it lies, -1 to +1.
fn dragged(angles: &[f64], gap: f64) -> Vec<f64> {
    let half = 0.5 * gap;
    let first = angles.iter().find(|a| (*a - angles[0]).abs() > gap);
    let towards = first.map_or(0.0, |a| (a - angles[0]).signum());
    let mut link = angles[0] - half * towards;
    let follow = |angle: &f64| {
        link = link.clamp(angle - half, angle + half);
        (link - angle) / half
    };
    angles.iter().map(follow).collect()
}

/// +1 or −1, kept while what drives it is idle; none where it never changes.
fn flanks(drive: &[f64]) -> Option<Vec<f64>> {
    let most = largest(drive);
    let clear = |d: &f64| d.abs() > IDLE * most;
    let mut now = drive.iter().find(|d| clear(d))?.signum();
    let side: Vec<f64> = drive
        .iter()
        .map(|d| {
            if clear(d) {
                now = d.signum();
            }
            now
        })
        .collect();
    side.iter().any(|s| *s != side[0]).then_some(side)
}

#[cfg(test)]
mod tests {
    use super::{dragged, flanks};

    #[test]
    fn a_link_follows_once_the_gap_is_taken() {
        let side = dragged(&[0.0, 1.0, 0.95, 0.8, 0.9], 0.1);
        let right = [-1.0, -1.0, 0.0, 1.0, -1.0];
        assert!(side.iter().zip(right).all(|(a, b)| (a - b).abs() < 1e-9));
    }

    #[test]
    fn a_link_that_something_presses_changes_its_flank_at_once() {
        let angles = [0.0, 1e-4, 2e-4, 1.9e-4, 1.5e-4];
        let pressed = dragged(&angles, 1e-6);
        let lags = dragged(&angles, 2e-4);
        assert!(
            (pressed[3] - 1.0).abs() < 1e-9 && lags[3] < 0.0,
            "{pressed:?} {lags:?}"
        );
    }

    #[test]
    fn a_flank_is_kept_while_nothing_drives() {
        let side = flanks(&[0.0, 1.0, 0.001, -2.0, 0.0]).unwrap();
        assert_eq!(side, [1.0, 1.0, 1.0, -1.0, -1.0]);
        assert!(flanks(&[1.0, 2.0, 0.5]).is_none());
        assert!(flanks(&[0.0, 0.0]).is_none());
    }
}
