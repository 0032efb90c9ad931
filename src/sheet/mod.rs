//! Floor 1: what a reader shall see, as data: numbers with units, tables, charts, verdicts. No ink:
//! the floor `report` draws a sheet as text, HTML or SVG.

pub mod chart;
pub mod number;
pub mod page;
pub mod scene;
pub mod table;
