//! Play in a drive: the link lies on one flank of the gap and changes to the other where the joint turns
//! back, or where the load on it changes its sign.

use super::Case;
use super::stations::levers;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::ground::spatial::{V3, scale};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "backlash",
    summary: "A drive has play: its link changes the flank where the joint turns back or its load changes sign.",
    mechanism: "backlash",
    places: |case| {
        let joints = case.setup.robot.joints.iter().enumerate();
        joints
            .filter(|(_, joint)| joint.drive.is_some())
            .map(|(i, joint)| Place::new(joint.name.clone(), members(case, i, &joint.name)))
            .collect()
    },
    parameters: |_, blamed| vec![("gap", blamed.amounts[0], "rad")],
    would_tell: "load the joint to and fro past zero (`ident stiffness`)",
};

/// Share of its greatest size below which speed or torque chooses no flank.
const IDLE: f64 = 0.02;

fn members(case: &Case, joint: usize, site: &str) -> Vec<Member> {
    let Some(levers) = levers(&case.setup, &case.stations, site) else {
        return Vec::new();
    };
    let speeds: Vec<f64> = case.stations.iter().map(|s| -s.speeds[joint]).collect();
    let cut: Vec<f64> = levers.iter().map(|l| l.cut).collect();
    let loaded: Vec<f64> = levers.iter().map(|l| l.cut + l.weight).collect();
    let by_flank = |(form, drive): (usize, &Vec<f64>)| {
        let side = flanks(drive)?;
        let moved: Vec<V3> = levers
            .iter()
            .zip(&side)
            .map(|(l, side)| scale(0.5 * side, l.motion))
            .collect();
        Some(
            Member::free(case.seen(&moved))
                .positive()
                .shaped(&[-1.0, form as f64]),
        )
    };
    [speeds, cut, loaded]
        .iter()
        .enumerate()
        .filter_map(by_flank)
        .collect()
}

/// +1 or −1, kept while what drives it is idle; none where it never changes.
fn flanks(drive: &[f64]) -> Option<Vec<f64>> {
    let most = drive.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
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
    use super::flanks;

    #[test]
    fn a_flank_is_kept_while_nothing_drives() {
        let side = flanks(&[0.0, 1.0, 0.001, -2.0, 0.0]).unwrap();
        assert_eq!(side, [1.0, 1.0, 1.0, -1.0, -1.0]);
        assert!(flanks(&[1.0, 2.0, 0.5]).is_none());
        assert!(flanks(&[0.0, 0.0]).is_none());
    }
}
