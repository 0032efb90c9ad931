//! The robot with the named physical causes in it.

use super::map::Fit;
use super::prediction::Machine;
use crate::findings::answer::Cause;
use crate::robot::Robot;

/// The robot of `machine` with those causes of `fit` that were named and are physical; none without.
pub fn robot(machine: &Machine, fit: &Fit, named: &[Cause]) -> Option<Robot> {
    let mut robot = machine.robot.clone();
    let mut notes = Vec::new();
    for (suspect, amounts) in fit.point.each() {
        let mine = |c: &&Cause| c.effect == suspect.name() && c.site == suspect.site;
        let Some(cause) = named.iter().find(mine).filter(|_| suspect.is_physical()) else {
            continue;
        };
        suspect.cause.alter(&mut robot, &suspect.site, &amounts);
        let numbers = cause
            .parameters
            .iter()
            .map(|(name, value, unit)| format!("{name} {value:.4e} {unit}"));
        notes.push(format!(
            "`ident diagnose`: {} at {} ({})",
            cause.effect,
            cause.site,
            numbers.collect::<Vec<_>>().join(", ")
        ));
    }
    if notes.is_empty() {
        return None;
    }
    robot.notes.extend(notes);
    Some(robot)
}
