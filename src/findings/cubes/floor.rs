//! Cubes of the foundation (`after` 0) where it gives way and the robot file says nothing of it: on the foot of the robot,
//! which moves, or on the floor beside it, which does not. No column of the file says which; the data do.

use super::about::About;
use super::{Case, softer};
use crate::causes::CAUSES;
use crate::findings::engine::{Blamed, Member, Suspect};
use crate::findings::physics;

/// Its name.
const NAME: &str = "base_compliance";
/// What the shape of such a cause ends with.
const FLOOR: f64 = 1.0;

/// Whether a cause has them on the floor.
pub(super) fn is_one(blamed: &Blamed) -> bool {
    blamed.effect == NAME && blamed.shape.get(1) == Some(&FLOOR)
}

/// The causes of the robot, a soft foundation with cubes on the foot and on the floor; once it was found, as it was found.
pub(super) fn suspects(case: &Case) -> Vec<Suspect> {
    let mut all = physics::suspects(case);
    let is_added = |b: &Blamed| b.effect == NAME && !softer::is_one(b);
    let is_told = case.about.causes.iter().any(is_added);
    let is_shown = case.test.facts.cubes.iter().any(|cube| cube.after == 0);
    if !is_shown || is_told && !case.about.is_floor {
        return all;
    }
    for own in all.iter_mut().filter(|s| s.effect == NAME) {
        match is_told {
            true => own.members.iter_mut().for_each(|m| m.shape.push(FLOOR)),
            false => own.members.extend(on_the_floor(case, &own.site)),
        }
    }
    all
}

/// What a soft foundation makes of cubes where those of the foundation stand still.
fn on_the_floor(case: &Case, site: &str) -> Vec<Member> {
    let floor = case.with(About {
        is_floor: true,
        ..case.about.clone()
    });
    let law = CAUSES.iter().find(|cause| cause.card().name == NAME);
    let mut members = law.map_or(Vec::new(), |law| physics::members(&floor, *law, site));
    members.iter_mut().for_each(|m| m.shape.push(FLOOR));
    members
}
