//! Elastic hysteresis: what contacts in the gear hold of the torque until they slip, one or many (Iwan 1966).

use super::channels::range;
use super::joint::Joint;
use super::presliding::dahl;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};

/// Shares of the torque's range over which a contact sticks.
const WIDTHS: [f64; 9] = [0.015, 0.03, 0.05, 0.08, 0.12, 0.18, 0.27, 0.4, 0.6];
/// Neighbouring contacts that act together.
const TOGETHER: [usize; 4] = [1, 2, 3, 5];
/// Shares of the torque's range over which many contacts slip, the weak ones first (Dahl 1968).
const REACHES: [f64; 5] = [0.03, 0.06, 0.12, 0.22, 0.4];

/// What contacts hold before the record: nothing, or all they can.
const BEGINS: [f64; 3] = [0.0, -1.0, 1.0];
/// Which of them holds all of either sign.
const BACK: usize = 1;
const FORTH: usize = 2;

/// Share of a loop that contacts of these widths miss of one of others. A choice: stated loops of Dahl, Bouc-Wen and Iwan had
/// companions of 3 to 10 % that were none.
const MISSES: f64 = 0.1;

/// As the engine takes it: one amount is half the width of the loop, rad.
pub(super) const EFFECT: Effect<Joint> = Effect {
    name: "hysteresis",
    summary: "The gear gives and takes back on different curves.",
    mechanism: "dry friction",
    law_error: MISSES,
    can_be: |_, _| true,
    places: |joint| vec![Place::new(&joint.site, loops(joint))],
    parameters: |_, blamed| vec![("width", 2.0 * blamed.amounts[0], "rad")],
    would_tell: "change the load at rest, slowly and in both directions: hysteresis follows the direction of the load, friction of the drive that of the motion",
};

fn loops(joint: &Joint) -> Vec<Member> {
    let torque = &joint.geared;
    let (low, high) = range(torque);
    if high <= low {
        return Vec::new();
    }
    let from = |begin: f64| {
        let single = WIDTHS.map(|w| held(torque, w * (high - low), begin));
        let together = |of: &[Vec<f64>]| {
            let at = |i: usize| of.iter().map(|c| c[i]).sum::<f64>() / of.len() as f64;
            Member::free(joint.column(at)).positive()
        };
        let each = TOGETHER.iter().flat_map(|many| single.windows(*many));
        let many = REACHES.map(|r| dahl(torque, r * (high - low), begin));
        let many = many.map(|column| Member::free(column).positive());
        let all = each.map(together).chain(many).enumerate();
        let shaped = all.map(|(own, member)| member.shaped(&[own as f64]));
        shaped.collect::<Vec<Member>>()
    };
    BEGINS.into_iter().flat_map(from).collect()
}

/// Half of what the loop that was found makes of all that its contacts can hold before the record.
pub(super) fn begun(joint: &Joint, blamed: &Blamed) -> Option<Vec<f64>> {
    let all = loops(joint);
    let (each, own) = (all.len() / BEGINS.len(), *blamed.shape.first()? as usize);
    let of = |begin: usize| Some(&all.get(begin * each + own)?.columns[0]);
    let (back, forth) = (of(BACK)?, of(FORTH)?);
    Some(joint.column(|i| 0.5 * (forth[i] - back[i])))
}

/// What a contact holds that slips at this torque, −1 to 1.
fn held(torque: &[f64], slips: f64, begin: f64) -> Vec<f64> {
    let mut held = begin;
    let mut before = torque[0];
    let of = |t: &f64| {
        held = (held + (t - before) / slips.max(f64::MIN_POSITIVE)).clamp(-1.0, 1.0);
        before = *t;
        held
    };
    torque.iter().map(of).collect()
}
