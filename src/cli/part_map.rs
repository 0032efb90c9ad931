//! A part seen from above, its places in classes of size: what `mill` and `compensate` draw.

use crate::sheet::chart::{Axis, Panel, Series};
use crate::sheet::number::significant;

/// Number of classes of a map.
const CLASSES: usize = 5;

/// The largest of every n, so that no more than `most` are left and no peak is lost.
pub fn thinned<T: Copy>(all: &[T], most: usize, size: impl Fn(&T) -> f64) -> Vec<T> {
    let every = all.len().div_ceil(most).max(1);
    let largest = |few: &[T]| {
        few.iter()
            .copied()
            .max_by(|a, b| size(a).total_cmp(&size(b)))
    };
    all.chunks(every).filter_map(largest).collect()
}

/// Points on a map (mm), sorted into classes of equal width from 0 to `top`.
pub fn classes<T>(
    all: &[T],
    place: impl Fn(&T) -> [f64; 2],
    size: impl Fn(&T) -> f64,
    top: f64,
    unit: &str,
) -> Panel {
    let panel = Panel::new(Axis::new("x", "mm"), Axis::new("y", "mm")).equal_axes();
    if top <= 0.0 {
        let points = all.iter().map(place).collect();
        return panel.with(Series::points(format!("0 {unit}"), points));
    }
    let class = |x: f64| ((x / top * CLASSES as f64) as usize).min(CLASSES - 1);
    let end = |i: usize| significant(top * i as f64 / CLASSES as f64, 2);
    (0..CLASSES).fold(panel, |panel, i| {
        let inside: Vec<[f64; 2]> = all
            .iter()
            .filter(|t| class(size(t)) == i)
            .map(&place)
            .collect();
        match inside.is_empty() {
            true => panel,
            false => {
                let name = format!("{} to {} {unit}", end(i), end(i + 1));
                panel.with(Series::points(name, inside))
            }
        }
    })
}
