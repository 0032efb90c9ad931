//! Floor 9: siblings that ink a sheet: as text for a terminal, as SVG, as one HTML page, as a folder.

mod escape;
pub mod folder;
pub mod html;
pub mod json;
mod prose;
mod scene;
pub mod svg;
pub mod text;
mod wrap;
