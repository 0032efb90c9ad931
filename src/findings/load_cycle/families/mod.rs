//! Families of shapes: every cause in all the forms that its mechanism allows.
//!
//! A cause is never one formula. Each file holds one mechanism: single shapes on a grid fine enough that
//! its steps do not look like a second cause, and flexible members (densities of slip loads, spectra of
//! relaxation times, smooth drifts) that cover laws nobody has written down. The laws of `crate::effects`
//! are members too, so that an effect needs no file here to be found.

mod constant;
mod delay;
mod even;
mod jumps;
mod law;
mod linear_memory;
mod odd;
mod rate_independent;
mod shape;
mod stiffness_over_time;
mod time;
mod view;

pub use shape::Shapes;
pub use view::View;

use crate::effects::{Effect, contract::Role};
use crate::findings::engine::{Member, Suspect};
use crate::fit::observation::Observation;

/// The shapes of one cause.
pub struct Family {
    /// The cause that they speak for.
    pub cause: &'static str,
    /// Causes of one mechanism are mostly one law of another shape.
    pub mechanism: &'static str,
    /// Whether this load can show it at all.
    pub suits: fn(&View) -> bool,
    /// Its shapes under this load.
    pub members: fn(&View) -> Shapes,
}

/// Every family.
pub const FAMILIES: &[Family] = &[
    odd::BACKLASH,
    odd::SOFT_ZONE,
    odd::CUBIC_STIFFNESS,
    even::ASYMMETRY,
    rate_independent::HYSTERESIS,
    rate_independent::COULOMB_FRICTION,
    linear_memory::CREEP,
    stiffness_over_time::LOOSENING,
    time::SLIP,
    time::THERMAL_DRIFT,
    delay::TIME_SKEW,
    constant::SENSOR_OFFSET,
];

/// Everyone who may be to blame in a library of effects, under the load of a record. `site`: of a cause.
pub fn suspects(
    library: &[&'static dyn Effect],
    (data, view): (&Observation, &View),
    site: &dyn Fn(&'static str) -> String,
) -> Vec<Suspect> {
    let shapes: Vec<&'static dyn Effect> = library
        .iter()
        .copied()
        .filter(|e| e.role() == Role::Shape)
        .collect();
    let mut causes: Vec<&'static str> = Vec::new();
    for effect in &shapes {
        let cause = effect.card().cause;
        if !causes.contains(&cause) {
            causes.push(cause);
        }
    }
    let suspect = |cause: &'static str| {
        let own: Vec<_> = shapes
            .iter()
            .copied()
            .filter(|e| e.card().cause == cause)
            .collect();
        suspect(cause, &own, data, view).map(|s| Suspect {
            site: site(cause),
            ..s
        })
    };
    causes.into_iter().filter_map(suspect).collect()
}

/// One cause: its laws over their grids, and the shapes of its family.
fn suspect(
    cause: &'static str,
    laws: &[&'static dyn Effect],
    data: &Observation,
    view: &View,
) -> Option<Suspect> {
    let family = FAMILIES.iter().find(|f| f.cause == cause);
    if family.is_some_and(|f| !(f.suits)(view)) {
        return None;
    }
    let alone = family.is_none();
    // under loads of one sign a gap at zero is a zero that is off, and shows as that
    let own = laws
        .iter()
        .filter(|law| view.two_sided || law.card().name != "backlash")
        .flat_map(|law| law::members(*law, alone, data, view));
    let wide = family.into_iter().flat_map(|f| (f.members)(view).members);
    let members: Vec<Member> = own.chain(wide).collect();
    let summary = crate::effects::named(cause).or(laws.first().copied());
    (!members.is_empty()).then(|| Suspect {
        effect: cause,
        site: String::new(),
        summary: summary.map_or("", |e| e.card().summary),
        mechanism: family.map_or(cause, |f| f.mechanism),
        share: 0.0,
        members,
        named: true,
        law_error: 0.0,
        can_be: |_, _| true,
    })
}
