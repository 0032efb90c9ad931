//! A survey as it swings, with a still of every mode for paper, and maps of modal assurance.

use super::modes::SurveyMode;
use crate::experiments::robot_picture::swinging;
use crate::ground::spatial::{V3, add, norm};
use crate::measurement::survey::Survey;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::fixed;
use crate::sheet::page::Block;
use rustfft::num_complex::Complex64;

/// Largest movement of a mode as drawn, over the size of the survey.
const DRAWN: f64 = 0.12;
/// Half the size of the cross at a point without wires, over the size of the survey.
const CROSS: f64 = 0.006;
/// From where a still is seen, as the view in space begins: turned about z, then tilted, rad.
const TURN: f64 = -0.6;
const TILT: f64 = 0.6;
/// Length of the drawn axes, over the size of the survey.
const TRIAD: f64 = 0.15;
/// Classes of a map of modal assurance.
const CLASSES: usize = 5;
const BREAK: V3 = [f64::NAN; 3];

/// A line of the wireframe: points, and how each swings to either side, in step and a quarter of a period early.
struct Wire {
    at: Vec<V3>,
    swing: [Vec<V3>; 2],
}

/// The modes as they swing, each with a still.
pub fn mode_blocks(survey: &Survey, modes: &[SurveyMode]) -> Vec<Block> {
    let blocks = modes.iter().enumerate().flat_map(|(i, mode)| {
        let hz = fixed(mode.mode.frequency_hz, 2);
        let percent = fixed(100.0 * mode.mode.damping_ratio, 2);
        let title = format!("Mode {} at {hz} Hz, damping {percent} %", i + 1);
        let wire = wire(survey, &mode.shape);
        let name = format!("survey-mode-{}", i + 1);
        [
            Block::Scene(swinging(
                &title,
                &wire.at,
                wire.swing.each_ref().map(Vec::as_slice),
            )),
            Block::Chart(still(&name, &title, survey, &wire)),
        ]
    });
    blocks.collect()
}

/// How every point moves in a shape: x, y, z; directions that were not measured stand still.
fn movements(survey: &Survey, shape: &[Complex64]) -> Vec<[Complex64; 3]> {
    let mut moved = vec![[Complex64::default(); 3]; survey.geometry.points.len()];
    for ((point, axis), value) in survey.dofs.iter().zip(shape) {
        moved[*point][*axis] = *value;
    }
    moved
}

/// All wires as one line with breaks; points on no wire as crosses.
fn wire(survey: &Survey, shape: &[Complex64]) -> Wire {
    let moved = movements(survey, shape);
    let most = moved
        .iter()
        .map(|v| norm(v.map(|x| x.norm())))
        .fold(0.0, f64::max);
    let size = norm(survey.geometry.extents());
    let by = if most > 0.0 { DRAWN * size / most } else { 0.0 };
    let mut wire = Wire {
        at: Vec::new(),
        swing: [Vec::new(), Vec::new()],
    };
    let mut push = |at: V3, point: Option<usize>| {
        let moved = point.map_or([Complex64::default(); 3], |i| moved[i]);
        wire.at.push(at);
        wire.swing[0].push(moved.map(|v| by * v.re));
        wire.swing[1].push(moved.map(|v| by * v.im));
    };
    let points = &survey.geometry.points;
    for run in &survey.geometry.wires {
        run.iter().for_each(|i| push(points[*i].at, Some(*i)));
        push(BREAK, None);
    }
    let wired = |i: &usize| survey.geometry.wires.iter().any(|run| run.contains(i));
    for i in (0..points.len()).filter(|i| !wired(i)) {
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                let mut end = points[i].at;
                end[axis] += side * CROSS * size;
                push(end, Some(i));
            }
            push(BREAK, None);
        }
    }
    wire
}

/// Where a point is on paper: across and up.
fn seen(p: &V3) -> [f64; 2] {
    let ((st, ct), (sl, cl)) = (TURN.sin_cos(), TILT.sin_cos());
    [
        ct * p[0] - st * p[1],
        cl * p[2] + sl * (st * p[0] + ct * p[1]),
    ]
}

/// One end of the swing over the survey at rest, for paper.
fn still(name: &str, title: &str, survey: &Survey, wire: &Wire) -> Chart {
    let ends = wire.at.iter().zip(&wire.swing[0]);
    let swung: Vec<[f64; 2]> = ends.map(|(p, w)| seen(&add(*p, *w))).collect();
    let rest: Vec<[f64; 2]> = wire.at.iter().map(seen).collect();
    let mut panel = Panel::new(
        Axis::new("across the view", "m"),
        Axis::new("up the view", "m"),
    )
    .equal_axes()
    .with(Series::line("one end of the swing, enlarged", swung))
    .with(Series::dotted("at rest", rest));
    let points = &survey.geometry.points;
    let corner: V3 = std::array::from_fn(|k| {
        let least = points
            .iter()
            .map(|point| point.at[k])
            .fold(f64::MAX, f64::min);
        least
            - if k == 2 {
                0.0
            } else {
                1.3 * TRIAD * norm(survey.geometry.extents())
            }
    });
    let mut triad = Vec::new();
    for (axis, label) in ["x", "y", "z"].into_iter().enumerate() {
        let mut end = corner;
        end[axis] += TRIAD * norm(survey.geometry.extents());
        triad.extend([seen(&corner), seen(&end), [f64::NAN; 2]]);
        panel = panel.named(seen(&end), label);
    }
    let caption = "The wires of the survey at rest and at one end of the swing, enlarged, seen as the view above begins. Directions that were not measured stand still.";
    Chart::new(name, title, caption)
        .synthetic(survey.record.synthetic)
        .with(panel.with(Series::line("axes", triad)))
}

/// A matrix of modal assurance, modes of the survey along y.
pub fn mac_chart(
    name: &str,
    title: &str,
    caption: &str,
    (x, y): (&str, &str),
    mac: &[Vec<f64>],
) -> Chart {
    let class = |v: f64| ((v * CLASSES as f64) as usize).min(CLASSES - 1);
    let all = mac.iter().enumerate().flat_map(|(i, row)| {
        let place = move |(j, v): (usize, &f64)| ([j as f64 + 1.0, i as f64 + 1.0], *v);
        row.iter().enumerate().map(place)
    });
    let all: Vec<([f64; 2], f64)> = all.filter(|(_, v)| v.is_finite()).collect();
    let mut panel = Panel::new(Axis::new(x, ""), Axis::new(y, "")).equal_axes();
    for k in 0..CLASSES {
        let end = |k: usize| fixed(k as f64 / CLASSES as f64, 1);
        let inside = all
            .iter()
            .filter(|(_, v)| class(*v) == k)
            .map(|(at, _)| *at);
        let label = format!("{} to {}", end(k), end(k + 1));
        panel = panel.with(Series::cells(label, inside.collect(), [0.96, 0.96]));
    }
    Chart::new(name, title, caption).with(panel)
}
