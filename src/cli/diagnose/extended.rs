//! An extended robot as a file.

use crate::robot::{Robot, write};

/// Its text, labelled where the measurements were simulated.
pub fn text(robot: &Robot, synthetic: bool) -> String {
    let label = match synthetic {
        true => "# synthetic: extended from simulated measurements\n",
        false => "",
    };
    format!("{label}{}", write::write(robot))
}
