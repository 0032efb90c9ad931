//! Fewer points for the same picture: what falls on the same pixel is drawn once, extremes stay.

use std::collections::HashSet;

/// A line may run this far beside its points, px: less than what is drawn can show.
const STRAIGHT: f64 = 0.15;

/// A point in axis coordinates.
pub(super) type Point = [f64; 2];

/// The pixels of a panel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pixels {
    /// Axis coordinate of the pixel (0, 0).
    pub origin: Point,
    /// Pixels in one unit of each axis.
    pub per_unit: Point,
}

impl Pixels {
    /// How far a line travels up and down, in pixels.
    pub fn rise(&self, line: &[Point]) -> f64 {
        let steps = line.windows(2).map(|pair| (pair[1][1] - pair[0][1]).abs());
        steps.sum::<f64>() * self.per_unit[1]
    }

    /// Distance of a point from the piece of line between two others, in pixels.
    fn distance(&self, point: Point, from: Point, to: Point) -> f64 {
        let px = |a: Point, b: Point| [0, 1].map(|k| (a[k] - b[k]) * self.per_unit[k]);
        let (line, own) = (px(to, from), px(point, from));
        let length = line[0].hypot(line[1]);
        if length == 0.0 {
            return own[0].hypot(own[1]);
        }
        let along = (own[0] * line[0] + own[1] * line[1]) / length;
        let across = (own[0] * line[1] - own[1] * line[0]) / length;
        across.hypot((along - along.clamp(0.0, length)).abs())
    }

    fn column(&self, point: Point) -> i64 {
        ((point[0] - self.origin[0]) * self.per_unit[0]).floor() as i64
    }

    fn cell(&self, point: Point, size: f64) -> (i64, i64) {
        let at = |k: usize| (point[k] - self.origin[k]) * self.per_unit[k] / size;
        (at(0).floor() as i64, at(1).floor() as i64)
    }
}

/// Markers: one for each occupied cell, the cells growing until there are at most `budget`.
pub(super) fn markers(points: &[Point], pixels: &Pixels, budget: usize) -> Vec<Point> {
    let extremes = extremes(points);
    let mut size = 1.0;
    loop {
        let mut seen = HashSet::new();
        let first = |i: &usize| seen.insert(pixels.cell(points[*i], size)) || extremes.contains(i);
        let kept: Vec<usize> = (0..points.len()).filter(first).collect();
        if kept.len() <= budget.max(8) || size > 1e4 {
            return kept.into_iter().map(|i| points[i]).collect();
        }
        size *= 1.5;
    }
}

/// A line as one or several pieces with at most about `budget` points together.
pub(super) fn line(points: &[Point], pixels: &Pixels, budget: usize) -> Vec<Vec<Point>> {
    let runs = bent(&per_column(points, pixels), pixels);
    if runs.len() <= budget {
        return vec![runs];
    }
    let pieces = unseen(&runs, pixels);
    match pieces.iter().map(Vec::len).sum::<usize>() {
        total if total <= budget => pieces,
        _ => vec![strided(&runs, budget)],
    }
}

/// Runs between gaps: if there are more than `most`, one for each pair of end pixels, and then only
/// every so many.
pub(super) fn apart<T>(
    mut runs: Vec<Vec<T>>,
    pixels: &Pixels,
    most: usize,
    point: impl Fn(&T) -> Point,
) -> Vec<Vec<T>> {
    if runs.len() <= most {
        return runs;
    }
    let mut seen = HashSet::new();
    let cell = |end: Option<&T>| end.map(|end| pixels.cell(point(end), 1.0));
    runs.retain(|run| seen.insert((cell(run.first()), cell(run.last()))));
    let stride = runs.len() / most.max(1) + 1;
    runs.into_iter().step_by(stride).collect()
}

/// First, lowest, highest and last point of each run of points in one pixel column.
fn per_column(points: &[Point], pixels: &Pixels) -> Vec<Point> {
    let mut kept = Vec::new();
    let runs = points.chunk_by(|a, b| pixels.column(*a) == pixels.column(*b));
    for run in runs {
        let by_y = |a: &usize, b: &usize| run[*a][1].total_cmp(&run[*b][1]);
        let low = (0..run.len()).min_by(by_y).unwrap_or(0);
        let high = (0..run.len()).max_by(by_y).unwrap_or(0);
        let mut four = vec![0, low, high, run.len() - 1];
        four.sort_unstable();
        four.dedup();
        kept.extend(four.into_iter().map(|i| run[i]));
    }
    kept
}

/// Leaves out what lies on the straight line between its neighbours, to within [`STRAIGHT`] of a pixel
/// (Douglas and Peucker 1973).
fn bent(points: &[Point], pixels: &Pixels) -> Vec<Point> {
    let mut kept = vec![false; points.len()];
    let mut open = vec![(0, points.len().saturating_sub(1))];
    while let Some((from, to)) = open.pop() {
        let ends = [from, to].into_iter().filter(|i| *i < points.len());
        ends.for_each(|i| kept[i] = true);
        let off = |i: &usize| pixels.distance(points[*i], points[from], points[to]);
        let worst = (from + 1..to).max_by(|a, b| off(a).total_cmp(&off(b)));
        if let Some(worst) = worst.filter(|i| off(i) > STRAIGHT) {
            open.extend([(from, worst), (worst, to)]);
        }
    }
    let kept = kept.iter().zip(points).filter(|(kept, _)| **kept);
    kept.map(|(_, point)| *point).collect()
}

/// Leaves out segments that join the same two pixels as one that is already drawn.
fn unseen(points: &[Point], pixels: &Pixels) -> Vec<Vec<Point>> {
    let mut seen = HashSet::new();
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    let mut drawing = false;
    for pair in points.windows(2) {
        let (a, b) = (pixels.cell(pair[0], 1.0), pixels.cell(pair[1], 1.0));
        let fresh = seen.insert((a.min(b), a.max(b)));
        if fresh && !drawing {
            pieces.push(vec![pair[0]]);
        }
        if let (true, Some(piece)) = (fresh, pieces.last_mut()) {
            piece.push(pair[1]);
        }
        drawing = fresh;
    }
    pieces
}

fn strided(points: &[Point], budget: usize) -> Vec<Point> {
    let extremes = extremes(points);
    let stride = points.len() / budget.max(1) + 1;
    let kept = |i: &usize| i.is_multiple_of(stride) || extremes.contains(i);
    (0..points.len()).filter(kept).map(|i| points[i]).collect()
}

/// Indices of the points that are furthest left, right, down and up.
fn extremes(points: &[Point]) -> Vec<usize> {
    let by = |k: usize| move |a: &usize, b: &usize| points[*a][k].total_cmp(&points[*b][k]);
    let all = || 0..points.len();
    let ends = [0, 1].map(|k| [all().min_by(by(k)), all().max_by(by(k))]);
    ends.into_iter().flatten().flatten().collect()
}

/// Edges of a band as `[x, lower, upper]`: the widest in each run of points in one pixel column.
pub(super) fn band(edges: &[[f64; 3]], pixels: &Pixels) -> Vec<[f64; 3]> {
    let column = |edge: &[f64; 3]| pixels.column([edge[0], edge[1]]);
    let widest = |run: &[[f64; 3]]| {
        let low = run.iter().map(|e| e[1]).fold(f64::INFINITY, f64::min);
        let high = run.iter().map(|e| e[2]).fold(f64::NEG_INFINITY, f64::max);
        [run[0][0], low, high]
    };
    let mut kept: Vec<_> = edges
        .chunk_by(|a, b| column(a) == column(b))
        .map(widest)
        .collect();
    // The last run must reach the last point.
    if let (Some(last), Some(end)) = (edges.last(), kept.last().copied())
        && end[0] != last[0]
    {
        kept.push([last[0], end[1], end[2]]);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIXELS: Pixels = Pixels {
        origin: [0.0, 0.0],
        per_unit: [1.0, 100.0],
    };

    fn noisy(count: usize) -> Vec<Point> {
        let y = |i: usize| (i as f64 * 12.9898).sin() * 0.5;
        let mut points: Vec<Point> = (0..count)
            .map(|i| [600.0 * i as f64 / count as f64, y(i)])
            .collect();
        points[count / 3][1] = 7.0;
        points[count / 2][1] = -5.0;
        points
    }

    fn holds_extremes(points: &[Point]) -> bool {
        points.iter().any(|p| p[1] == 7.0) && points.iter().any(|p| p[1] == -5.0)
    }

    #[test]
    fn lines_keep_extremes() {
        let pieces = line(&noisy(1_000_000), &PIXELS, 10_000);
        assert_eq!(pieces.len(), 1);
        assert!(pieces[0].len() <= 2400);
        assert!(holds_extremes(&pieces[0]));
        assert!(holds_extremes(
            &line(&noisy(100_000), &PIXELS, 100).concat()
        ));
    }

    #[test]
    fn straight_lines_need_their_ends_only() {
        let slope = |i: usize| [i as f64, 0.5 * (i as f64).min(300.0)];
        let points: Vec<Point> = (0..600).map(slope).collect();
        let pieces = line(&points, &PIXELS, 10_000);
        assert_eq!(pieces, [vec![points[0], points[300], points[599]]]);
        let there_and_back = [[0.0, 0.0], [5.0, 1.0], [2.0, 0.4]];
        assert_eq!(line(&there_and_back, &PIXELS, 100)[0].len(), 3);
    }

    #[test]
    fn loops_are_drawn_once() {
        let turn = |i: usize| {
            [
                300.0 + 290.0 * (i as f64 * 0.01).cos(),
                (i as f64 * 0.01).sin(),
            ]
        };
        let points: Vec<Point> = (0..200_000).map(turn).collect();
        let pieces = line(&points, &PIXELS, 8_000);
        assert!(pieces.iter().map(Vec::len).sum::<usize>() <= 8_000);
    }

    #[test]
    fn markers_keep_extremes_within_the_budget() {
        let kept = markers(&noisy(200_000), &PIXELS, 5_000);
        assert!(kept.len() <= 5_000);
        assert!(holds_extremes(&kept));
        assert!(markers(&[], &PIXELS, 10).is_empty());
    }

    #[test]
    fn bands_keep_their_widest() {
        let edges = [[0.1, 1.0, 2.0], [0.2, 0.0, 3.0], [0.9, 1.0, 2.0]];
        assert_eq!(band(&edges, &PIXELS), [[0.1, 0.0, 3.0], [0.9, 0.0, 3.0]]);
    }
}
