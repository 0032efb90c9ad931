//! What to measure next where a motion leaves a question open.

use super::columns::Kind;

/// What would fix the stiffness of a joint.
pub const FOR_STIFFNESS: &str = "hold the joint at rest in poses of different gravity load, coming to each slowly from both sides, and read both encoders there; or press on the arm with a known force with the brakes on";

/// What would tell two kinds apart.
pub fn would_tell(a: Kind, b: Kind) -> &'static str {
    let pair = |x, y| (a == x && b == y) || (a == y && b == x);
    if pair(Kind::Rate, Kind::Rate) {
        "hold the joint with the brakes on and load it at two rates, or move it at two constant speeds with and without payload: a delay follows the speed alone, friction the torque"
    } else if pair(Kind::Coulomb, Kind::Hysteresis) {
        "reverse the motion slowly at constant load, then change the load at rest: friction of the drive follows the direction of motion, hysteresis that of the load"
    } else if a == Kind::Offset || b == Kind::Offset {
        "return to one pose several times during the record: a zero that jumped stays where it went"
    } else if a == Kind::Rate || b == Kind::Rate {
        "repeat the motion at half the speed: what a delay adds halves, nothing else does"
    } else if a == Kind::Backlash || b == Kind::Backlash {
        "let the torque pass zero slowly, once with and once without reversing the motion: a gap follows the sign of the torque, friction that of the speed"
    } else {
        "repeat the motion slowly, with holds, and with reversals at different loads"
    }
}
