//! What is said of words that are not understood.

use crate::ground::problem::Problem;

pub(super) fn stray_centre() -> Problem {
    Problem::new(
        "I, J, K or R on a straight motion",
        "write G2 or G3 for an arc, or remove the words",
    )
}

/// `G2`, `G91.1`.
pub(super) fn shown(letter: char, tenths: i32) -> String {
    match tenths % 10 {
        0 => format!("{letter}{}", tenths / 10),
        tenth => format!("{letter}{}.{tenth}", tenths / 10),
    }
}

pub(super) fn refused(letter: char, tenths: i32) -> Problem {
    let what = format!(
        "`{}` may change the path and is not understood",
        shown(letter, tenths)
    );
    let remedy = "post lines and arcs (G0 to G3) without cycles, offsets, scaling and subprograms";
    Problem::new(what, remedy)
}
