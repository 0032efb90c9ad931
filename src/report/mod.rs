//! Floor 8: siblings that ink a sheet: as text for a terminal, as SVG, as one HTML page, as a folder.

mod escape;
pub mod json;
pub mod svg;
mod wrap;
