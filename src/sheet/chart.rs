//! A chart: panels stacked above each other, each with two axes and its series.

/// One axis. SI prefixes are chosen by the caller (see [`super::number::prefix`]).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Axis {
    /// What is drawn along it, as in "Moment".
    pub label: String,
    /// Its unit, as in "N·m"; empty for a pure number.
    pub unit: String,
    /// Logarithmic; values that are not positive are then left out.
    pub log: bool,
}

impl Axis {
    /// A linear axis.
    pub fn new(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            unit: unit.into(),
            log: false,
        }
    }

    /// The same axis, logarithmic.
    #[must_use]
    pub fn log(mut self) -> Self {
        self.log = true;
        self
    }
}

/// How a series is drawn. Marks differ in form and lightness, so they are told apart in grey.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Mark {
    /// One marker for each point.
    Points,
    /// Solid line; a point that is not finite interrupts it.
    #[default]
    Line,
    /// Dashed line.
    Dashed,
    /// Dotted line.
    Dotted,
    /// Area between [`Series::lower_upper`].
    Band,
    /// Bars from zero; series of one panel stand side by side.
    Bars,
    /// A rectangle of [`Series::cell`] about each point: one class of a map, the classes from little to much.
    Cells,
}

/// Points that belong together under one name. A name keeps its look in all panels of a chart.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Series {
    /// Name in the legend; empty: not in the legend.
    pub name: String,
    /// How it is drawn.
    pub mark: Mark,
    /// x and y of each point, in the units of the axes.
    pub points: Vec<[f64; 2]>,
    /// Lower and upper end at each point: the edges of a band, whiskers on points and bars.
    pub lower_upper: Option<Vec<[f64; 2]>>,
    /// Drawn stronger than its neighbours: lines wide and below thinner ones, markers large and on top.
    pub emphasis: bool,
    /// Width and height of a cell, in the units of the axes.
    pub cell: [f64; 2],
}

impl Series {
    /// A series of any mark.
    pub fn new(name: impl Into<String>, mark: Mark, points: Vec<[f64; 2]>) -> Self {
        Self {
            name: name.into(),
            mark,
            points,
            ..Self::default()
        }
    }

    /// Markers.
    pub fn points(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::new(name, Mark::Points, points)
    }

    /// A solid line.
    pub fn line(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::new(name, Mark::Line, points)
    }

    /// A dashed line.
    pub fn dashed(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::new(name, Mark::Dashed, points)
    }

    /// A dotted line.
    pub fn dotted(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::new(name, Mark::Dotted, points)
    }

    /// An area given by `[x, lower, upper]`.
    pub fn band(name: impl Into<String>, edges: &[[f64; 3]]) -> Self {
        let middle = |&[x, low, high]: &[f64; 3]| [x, 0.5 * (low + high)];
        let series = Self::new(name, Mark::Band, edges.iter().map(middle).collect());
        series.between(edges.iter().map(|&[_, low, high]| [low, high]).collect())
    }

    /// One bar for each category of the panel.
    pub fn bars(name: impl Into<String>, values: &[f64]) -> Self {
        let points = values.iter().enumerate().map(|(i, &y)| [i as f64, y]);
        Self::new(name, Mark::Bars, points.collect())
    }

    /// Cells of one class of a map about their middles.
    pub fn cells(name: impl Into<String>, points: Vec<[f64; 2]>, cell: [f64; 2]) -> Self {
        Self {
            cell,
            ..Self::new(name, Mark::Cells, points)
        }
    }

    /// The same series with lower and upper ends.
    #[must_use]
    pub fn between(mut self, lower_upper: Vec<[f64; 2]>) -> Self {
        self.lower_upper = Some(lower_upper);
        self
    }

    /// The same series, emphasised.
    #[must_use]
    pub fn emphasised(mut self) -> Self {
        self.emphasis = true;
        self
    }
}

/// One pair of axes with its series.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Panel {
    /// Horizontal axis. Neighbouring panels with equal x axes share it.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// What is drawn, the first below the later ones.
    pub series: Vec<Series>,
    /// Names of the places 0, 1, 2 ... on the x axis of a bar chart; else empty.
    pub categories: Vec<String>,
    /// One short sentence above the panel.
    pub note: Option<String>,
    /// A unit is as long on either axis: a map, not a curve.
    pub equal: bool,
    /// Short names of places in the panel, beside them: x, y, name.
    pub names: Vec<([f64; 2], String)>,
}

impl Panel {
    /// A panel without series.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self {
            x,
            y,
            ..Self::default()
        }
    }

    /// The same panel with one more series.
    #[must_use]
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// The same panel over named places.
    #[must_use]
    pub fn over<S: Into<String>>(mut self, categories: impl IntoIterator<Item = S>) -> Self {
        self.categories = categories.into_iter().map(Into::into).collect();
        self
    }

    /// The same panel as a map: a unit is as long on either axis.
    #[must_use]
    pub fn equal_axes(mut self) -> Self {
        self.equal = true;
        self
    }

    /// The same panel with the name of a place beside it.
    #[must_use]
    pub fn named(mut self, place: [f64; 2], name: impl Into<String>) -> Self {
        self.names.push((place, name.into()));
        self
    }

    /// The same panel with a note above it.
    #[must_use]
    pub fn noted(mut self, note: impl Into<String>) -> Self {
        self.note = Some(note.into());
        self
    }
}

/// A figure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chart {
    /// Stem of its file, as in `axis6-loop`.
    pub name: String,
    /// What it shows, in a few words.
    pub title: String,
    /// From top to bottom.
    pub panels: Vec<Panel>,
    /// What the reader shall see in it, in whole sentences.
    pub caption: String,
    /// Shows data that nobody measured: labelled so in the figure.
    pub synthetic: bool,
}

impl Chart {
    /// A chart without panels.
    pub fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        caption: impl Into<String>,
    ) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            caption: caption.into(),
            ..Self::default()
        }
    }

    /// The same chart with one more panel below.
    #[must_use]
    pub fn with(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// The same chart, of data that were (not) made up.
    #[must_use]
    pub fn synthetic(mut self, synthetic: bool) -> Self {
        self.synthetic = synthetic;
        self
    }
}
