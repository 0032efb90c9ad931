//! Springs behind dry contacts, beside the spring of a hinge.

use super::Mean;
use crate::effects::contract::Contact;

/// A spring (N·m/rad) behind a dry contact that slips at this deflection (rad).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slider {
    pub(super) stiffness: f64,
    pub(super) reach: f64,
}

impl Slider {
    /// Mean torque while moving by `travel`: first sticking, then slipping.
    pub(super) fn mean(&self, stop: f64, sign: f64, travel: f64) -> Mean {
        let stuck = (self.reach - sign * stop).max(0.0);
        if travel <= stuck {
            return Mean {
                torque: self.stiffness * (stop + 0.5 * sign * travel),
                slope: 0.5 * self.stiffness,
            };
        }
        let share = stuck / travel;
        let before = stop + 0.5 * sign * stuck;
        let torque = self.stiffness * (share * before + (1.0 - share) * sign * self.reach);
        Mean {
            torque,
            slope: 0.5 * self.stiffness * share * share,
        }
    }
}

/// The sliders beside a spring that answer as these contacts in its load path do.
pub(super) fn sliders(stiffness: f64, mut contacts: Vec<Contact>) -> Vec<Slider> {
    contacts.retain(|contact| contact.compliance > 0.0 && contact.slip_load > 0.0);
    contacts.sort_by(|a, b| a.slip_load.total_cmp(&b.slip_load));
    let held: f64 = contacts.iter().map(|contact| contact.compliance).sum();
    let (mut compliance, mut load, mut reach) = (1.0 / stiffness - held, 0.0, 0.0);
    let one = |contact: &Contact| {
        reach += compliance * (contact.slip_load - load);
        load = contact.slip_load;
        let before = 1.0 / compliance;
        compliance += contact.compliance;
        Slider {
            stiffness: before - 1.0 / compliance,
            reach,
        }
    };
    contacts.iter().map(one).collect()
}
