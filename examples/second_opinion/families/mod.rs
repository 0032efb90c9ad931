//! Families of shapes: every cause in all the forms that its mechanism allows.
//!
//! A cause is never one formula. Each file holds one mechanism: single shapes on a grid fine enough that
//! its steps do not look like a second cause, and flexible members (densities of slip loads, spectra of
//! relaxation times, smooth drifts) that cover laws nobody has written down. The laws of `ident::effects`
//! are members too, so that an effect needs no file here to be found.

mod constant;
mod delay;
mod even;
mod linear_memory;
mod odd;
mod rate_independent;
mod shape;
mod stiffness_over_time;
mod time;
mod view;

pub use shape::Shapes;
pub use view::View;

use ident::effects::{Effect, contract::Role};
use ident::findings::engine::{Member, Suspect};
use ident::fit::candidates::Candidates;
use ident::fit::observation::Observation;
use std::collections::BTreeMap;

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
    data: &Observation,
    site: &dyn Fn(&'static str) -> String,
) -> Vec<Suspect> {
    let view = View::of(data);
    let mut laws: BTreeMap<&'static str, Vec<Member>> = laws(library, data, &view);
    let mut order: Vec<&'static dyn Effect> = Vec::new();
    for effect in library.iter().filter(|e| e.role() == Role::Shape) {
        if !order.iter().any(|o| o.card().cause == effect.card().cause) {
            order.push(*effect);
        }
    }
    let mut all = Vec::new();
    for effect in order {
        let cause = effect.card().cause;
        let family = FAMILIES.iter().find(|f| f.cause == cause);
        if family.is_some_and(|f| !(f.suits)(&view)) {
            continue;
        }
        let mut members = laws.remove(cause).unwrap_or_default();
        members.extend(family.into_iter().flat_map(|f| (f.members)(&view).members));
        if members.is_empty() {
            continue;
        }
        all.push(Suspect {
            effect: cause,
            site: site(cause),
            summary: ident::effects::named(cause)
                .map_or(effect.card().summary, |e| e.card().summary),
            mechanism: family.map_or(cause, |f| f.mechanism),
            share: 0.0,
            members,
        });
    }
    all
}

/// The laws of the library over their grids, by cause.
fn laws(
    library: &[&'static dyn Effect],
    data: &Observation,
    view: &View,
) -> BTreeMap<&'static str, Vec<Member>> {
    let shapes: Vec<&'static dyn Effect> = library
        .iter()
        .copied()
        .filter(|e| e.role() == Role::Shape)
        .collect();
    let candidates = Candidates::new(&shapes, data);
    let mut laws: BTreeMap<&'static str, Vec<Member>> = BTreeMap::new();
    for (index, atom) in candidates.atoms.iter().enumerate() {
        let mut column = atom.column.clone();
        data.cosine.restore(&mut column);
        if let Some(column) = view.beyond_spring(&column) {
            let member = Member::free(column).shaped(&atom.p);
            let own = laws.entry(candidates.cause(index)).or_default();
            own.push(match atom.one_signed {
                true => member.positive(),
                false => member,
            });
        }
    }
    laws
}
