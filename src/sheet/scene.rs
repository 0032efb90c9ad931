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
