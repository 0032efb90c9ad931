//! Lines in space that a reader can turn.

/// Lines of one kind.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Strand {
    /// Name in the legend.
    pub name: String,
    /// Points x, y, z in the scene's unit; one that is not finite interrupts the line.
    pub points: Vec<[f64; 3]>,
    /// Drawn thin.
    pub thin: bool,
    /// Colour from 0 (little) to 1 (most); none: by its place in the legend.
    pub tint: Option<f64>,
    /// Every point a disc with the name beside it, in place of a line.
    pub disc: bool,
    /// How far each point swings to either side, in the scene's unit; empty: it stands still.
    pub swing: Vec<[f64; 3]>,
    /// The same a quarter of a period earlier, where points do not pass their ends together; empty: they do.
    pub lead: Vec<[f64; 3]>,
}

/// A view in space. It stands beside a figure that shows the same on paper.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    /// What it shows.
    pub title: String,
    /// Unit of the points.
    pub unit: String,
    /// What is drawn.
    pub strands: Vec<Strand>,
}
