//! The range of an axis and the place of a value on it.

use crate::sheet::chart::{Axis, Mark, Panel, Series};

/// An axis with its range. Coordinates are the values, or their decimal logarithms on a log axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    pub log: bool,
    pub low: f64,
    pub high: f64,
    /// Whether any value was there to give the range.
    pub filled: bool,
}

impl Scale {
    /// The range of some values, with `margin` of it on both sides.
    pub fn of(log: bool, values: impl Iterator<Item = f64>, margin: f64) -> Self {
        let places = values.filter_map(|value| coordinate(log, value));
        let ends = places.fold(None, |ends: Option<(f64, f64)>, v| match ends {
            None => Some((v, v)),
            Some((low, high)) => Some((low.min(v), high.max(v))),
        });
        let (low, high) = ends.map_or((0.0, 1.0), widened);
        let air = margin * (high - low);
        Self {
            log,
            low: low - air,
            high: high + air,
            filled: ends.is_some(),
        }
    }

    fn span(&self) -> f64 {
        self.high - self.low
    }

    /// The same middle with another span.
    fn about(self, span: f64) -> Self {
        let middle = 0.5 * (self.low + self.high);
        Self {
            low: middle - 0.5 * span,
            high: middle + 0.5 * span,
            ..self
        }
    }

    /// Coordinate of a value; none for what cannot be drawn.
    pub fn coordinate(&self, value: f64) -> Option<f64> {
        coordinate(self.log, value)
    }
}

// Beyond these, differences overflow and steps underflow.
const HUGE: f64 = 1e290;
const TINY: f64 = 1e-290;

fn coordinate(log: bool, value: f64) -> Option<f64> {
    let place = if log { value.log10() } else { value };
    let place = if place.abs() < TINY { 0.0 } else { place };
    (place.abs() < HUGE).then_some(place)
}

/// A range that is wide enough to be divided in floating point.
fn widened((low, high): (f64, f64)) -> (f64, f64) {
    let size = low.abs().max(high.abs());
    if high - low > 1e-9 * size {
        return (low, high);
    }
    let air = if size > 0.0 { 0.05 * size } else { 1.0 };
    (low - air, high + air)
}

/// Range of the x axis over all panels that share it.
pub(super) fn x_of(panels: &[&Panel]) -> Scale {
    let categories = panels.iter().map(|panel| panel.categories.len()).max();
    if let Some(count) = categories.filter(|&count| count > 0) {
        return Scale {
            log: false,
            low: -0.5,
            high: count as f64 - 0.5,
            filled: true,
        };
    }
    let log = panels.iter().any(|panel| panel.x.log);
    let all = panels.iter().flat_map(|panel| &panel.series);
    Scale::of(log, all.flat_map(x_values), 0.02)
}

fn x_values(series: &Series) -> Vec<f64> {
    let half = match series.mark {
        Mark::Bars => 0.5 * spacing(&series.points),
        Mark::Cells => 0.5 * series.cell[0],
        _ => 0.0,
    };
    let ends = series
        .points
        .iter()
        .flat_map(|p| [p[0] - half, p[0] + half]);
    ends.collect()
}

/// Range of the y axis of a panel. Bars without negative values stand on the lower end.
pub(super) fn y_of(panel: &Panel) -> Scale {
    let values = panel.series.iter().flat_map(y_values);
    let bars = panel.series.iter().any(|series| series.mark == Mark::Bars);
    let zero = (bars && !panel.y.log).then_some(0.0);
    let mut scale = Scale::of(panel.y.log, values.chain(zero), 0.05);
    if bars && !panel.y.log {
        let air = 0.05 / 1.1 * (scale.high - scale.low);
        scale.low = if (scale.low + air).abs() < 1e-6 * air {
            0.0
        } else {
            scale.low
        };
        scale.high = if (scale.high - air).abs() < 1e-6 * air {
            0.0
        } else {
            scale.high
        };
    }
    scale
}

/// Widens the scales of panels that share x until a unit is as long on both axes. `aspect`: width of a
/// data area over its height.
pub(super) fn equalise(scales: &mut [(Scale, Scale)], aspect: f64) {
    let spans = scales.iter().map(|(x, y)| x.span().max(aspect * y.span()));
    let span = spans.fold(0.0, f64::max);
    for (x, y) in scales {
        *x = x.about(span);
        *y = y.about(span / aspect);
    }
}

fn y_values(series: &Series) -> Vec<f64> {
    let middle = series.points.iter().map(|p| p[1]);
    let ends = series.lower_upper.iter().flatten().flatten().copied();
    match series.mark {
        Mark::Band => ends.collect(),
        Mark::Cells => edges(series),
        _ => middle.chain(ends).collect(),
    }
}

/// Lower and upper edges of cells.
fn edges(series: &Series) -> Vec<f64> {
    let half = 0.5 * series.cell[1];
    let ends = series.points.iter();
    ends.flat_map(|p| [p[1] - half, p[1] + half]).collect()
}

/// Smallest distance between neighbouring points: the room of one bar.
pub(super) fn spacing(points: &[[f64; 2]]) -> f64 {
    let gaps = points
        .windows(2)
        .map(|pair| (pair[1][0] - pair[0][0]).abs());
    let least = gaps.filter(|gap| *gap > 0.0).fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 1.0 }
}

/// Label of an axis, as in "Moment in N·m" or "Angle in 10⁻⁶ rad".
pub(super) fn label(axis: &Axis, exponent: i32) -> String {
    let power = match exponent {
        0 => String::new(),
        _ => format!("10{}", super::ticks::superscript(exponent)),
    };
    let unit = [power.as_str(), axis.unit.as_str()];
    let unit: Vec<&str> = unit.into_iter().filter(|part| !part.is_empty()).collect();
    match (axis.label.is_empty(), unit.is_empty()) {
        (false, false) => format!("{} in {}", axis.label, unit.join(" ")),
        (true, _) => unit.join(" "),
        (_, true) => axis.label.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_survive_anything() {
        let empty = Scale::of(false, [f64::NAN, f64::INFINITY].into_iter(), 0.0);
        assert_eq!((empty.low, empty.high, empty.filled), (0.0, 1.0, false));
        let one = Scale::of(false, [3.0].into_iter(), 0.0);
        assert!(one.low < 3.0 && one.high > 3.0);
        let log = Scale::of(true, [-1.0, 0.0, 10.0, 1000.0].into_iter(), 0.0);
        assert_eq!((log.low, log.high), (1.0, 3.0));
        assert!(Scale::of(false, [f64::MAX, -f64::MAX].into_iter(), 0.0).low == 0.0);
    }

    #[test]
    fn bars_stand_on_zero() {
        let panel = Panel::default().with(Series::bars("a", &[1.0, 2.0]));
        assert_eq!(y_of(&panel).low, 0.0);
        assert!(y_of(&panel).high > 2.0);
    }

    #[test]
    fn maps_have_equal_units() {
        let of = |low: f64, high: f64| Scale::of(false, [low, high].into_iter(), 0.0);
        let mut both = [(of(0.0, 1.0), of(0.0, 4.0)), (of(0.0, 1.0), of(-1.0, 1.0))];
        equalise(&mut both, 2.0);
        for (x, y) in both {
            assert_eq!((x.low, x.high, y.high - y.low), (-3.5, 4.5, 4.0));
        }
    }

    #[test]
    fn labels_name_the_unit() {
        assert_eq!(label(&Axis::new("Moment", "N·m"), 0), "Moment in N·m");
        assert_eq!(label(&Axis::new("Angle", "rad"), -6), "Angle in 10⁻⁶ rad");
        assert_eq!(label(&Axis::new("Coherence", ""), 0), "Coherence");
    }
}
