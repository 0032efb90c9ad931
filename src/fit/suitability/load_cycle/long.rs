//! More cycles than are fitted.

use super::{Course, Rule};
use crate::fit::observation::Part;
use crate::fit::suitability::{Said, Weight};

/// A record of very many cycles is fitted by its first ones, as averaging would mix cycles.
pub const RULE: Rule = Rule {
    name: "long",
    remedy: "cut the file into pieces to see the later cycles",
    look,
};

fn look(on: &Course) -> Said {
    let part = Part::of_cycles(
        &on.cycles,
        on.file.load.len(),
        crate::fit::observation::MOST_ROWS,
    );
    part.sentence()
        .map(|said| (Weight::Note, said))
        .into_iter()
        .collect()
}
