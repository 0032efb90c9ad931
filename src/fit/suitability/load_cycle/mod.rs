//! The gate for load cycles.

mod ceiling;
mod clipped;
mod clock;
mod coarse;
mod copied;
mod counted;
mod few_rows;
mod left_out;
mod long;
mod part_of_a_cycle;
mod rest;
mod reversed;
mod robot;
mod scale;
mod second_sensor;
mod unchanging;
mod unrelated;
mod wild_load;
mod wild_response;

pub use clipped::clipped;

use super::relation::Relation;
use super::{Doubt, Said};
use crate::fit::imposed::is_imposed;
use crate::fit::observation::tame;
use crate::measurement::cycles::Cycles;
use crate::measurement::load_cycle::LoadCycle;

/// What the rules look at: a file, and what several of them need.
pub struct Course<'a> {
    /// The file.
    pub file: &'a LoadCycle,
    /// Its load, cut into cycles, every row.
    pub cycles: Cycles,
    /// Its deflection, absurd lone readings replaced.
    pub deflection: Vec<f64>,
    /// How its deflection depends on its load.
    pub relation: Relation,
    /// Whether the displacement was imposed.
    pub imposed: bool,
}

/// One rule of this kind.
pub type Rule = super::Rule<for<'a, 'b> fn(&'b Course<'a>) -> Said>;

/// Every rule, in the order in which its findings are said.
pub const RULES: &[Rule] = &[
    unchanging::RULE,
    copied::RULE,
    few_rows::RULE,
    clock::RULE,
    part_of_a_cycle::RULE,
    wild_load::RULE,
    clipped::RULE,
    ceiling::RULE,
    reversed::RULE,
    unrelated::RULE,
    scale::RULE,
    second_sensor::RULE,
    robot::RULE,
    rest::RULE,
    wild_response::RULE,
    long::RULE,
    left_out::RULE,
    counted::RULE,
    coarse::RULE,
];

/// What is odd about a file, the gravest first.
pub fn doubts(file: &LoadCycle) -> Vec<Doubt> {
    let mut deflection = file.deflection.clone();
    tame(&mut deflection);
    let course = Course {
        file,
        cycles: Cycles::find(&file.load),
        relation: Relation::of(&file.load, &deflection),
        deflection,
        imposed: is_imposed(file),
    };
    super::doubts(RULES, |look| look(&course))
}
