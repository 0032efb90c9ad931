//! The robot in space and on paper: its line, who gives way how much, how it swings.

use crate::ground::problem::Outcome;
use crate::ground::spatial::{V3, add, norm, scale, sub};
use crate::motion::modes::{complex_modes, modal};
use crate::motion::skeleton::{Share, Skeleton, swing};
use crate::motion::{Work, elastic, linearise};
use crate::robot::{Robot, check};
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::fixed;
use crate::sheet::page::Block;
use crate::sheet::scene::{Scene, Strand};

/// Distance below which two places are written as one, m.
const TOGETHER: f64 = 0.02;
/// Largest movement of a mode as drawn, over the size of the robot.
const DRAWN: f64 = 0.12;
/// Damping ratio from which a mode does not swing.
const OVERDAMPED: f64 = 0.9;

/// A mode of the robot at a posture.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnMode {
    /// Natural frequency, Hz.
    pub frequency_hz: f64,
    /// Share of critical damping.
    pub damping_ratio: f64,
    /// How far each point of the robot's line swings to either side as drawn, m.
    pub swing: Vec<V3>,
}

/// The first modes that swing, `most` of them, of the robot at joint angles (rad).
///
/// # Errors
/// A robot without bodies or without springs.
pub fn modes(
    robot: &Robot,
    joints: &[f64],
    line: &Skeleton,
    most: usize,
) -> Outcome<Vec<DrawnMode>> {
    check::dynamics(robot)?;
    let chain = elastic(robot);
    let linear = linearise(&chain, &mut Work::new(&chain), &chain.spread(joints))?;
    let all = complex_modes(&linear, &modal(&linear)?);
    let swings = all
        .into_iter()
        .filter(|mode| mode.damping_ratio < OVERDAMPED);
    let drawn = swings.take(most).map(|mode| DrawnMode {
        frequency_hz: mode.frequency_hz,
        damping_ratio: mode.damping_ratio,
        swing: enlarged(line, &swing(robot, joints, &mode.shape)),
    });
    Ok(drawn.collect())
}

/// Modes as they swing, each with a figure for paper whose name begins with `stem`.
pub fn mode_blocks(robot: &Skeleton, modes: &[DrawnMode], stem: &str) -> Vec<Block> {
    let caption = "At rest, and dashed one end of the swing, enlarged. The frequencies are those of the springs without gaps.";
    let blocks = modes.iter().enumerate().flat_map(|(i, mode)| {
        let (hz, percent) = (
            fixed(mode.frequency_hz, 2),
            fixed(100.0 * mode.damping_ratio, 2),
        );
        let title = format!("Mode {} at {hz} Hz, damping {percent} %", i + 1);
        let ends = robot.line.iter().zip(&mode.swing);
        let moved: Vec<V3> = ends.map(|(p, w)| add(*p, *w)).collect();
        let figure = Chart::new(format!("{stem}{}", i + 1), title.clone(), caption);
        [
            Block::Scene(swinging(&title, &robot.line, [&mode.swing, &[]])),
            Block::Chart(chart(figure, robot, Some(("swung", &moved)))),
        ]
    });
    blocks.collect()
}

/// Places with what is written there: joints, or joints with their shares.
fn labels(skeleton: &Skeleton, shares: &[Share]) -> Vec<(V3, String, Option<f64>)> {
    let most = shares.iter().map(|share| share.share).fold(0.0, f64::max);
    let plain = skeleton.names.iter().zip(&skeleton.line[1..]);
    let plain = plain.map(|(name, at)| (*at, name.clone(), None));
    let told = shares.iter().map(|one| {
        let text = format!("{} {:.0} %", one.site, 100.0 * one.share);
        (one.point, text, Some((one.share / most).clamp(0.0, 1.0)))
    });
    let all: Vec<(V3, String, Option<f64>)> = match shares.is_empty() {
        true => plain.collect(),
        false => told.collect(),
    };
    let mut found: Vec<(V3, String, Option<f64>)> = Vec::new();
    for (at, text, tint) in all {
        match found.iter_mut().find(|one| norm(sub(one.0, at)) < TOGETHER) {
            Some(one) => {
                one.1 += &format!(", {text}");
                one.2 = one.2.zip(tint).map(|(a, b)| a.max(b));
            }
            None => found.push((at, text, tint)),
        }
    }
    found
}

fn millimetres(points: &[V3]) -> Vec<V3> {
    points.iter().map(|p| scale(1e3, *p)).collect()
}

/// The robot that a reader can turn, joints coloured by their share; further postures are drawn thin.
pub fn scene(title: &str, robot: &Skeleton, shares: &[Share], others: &[Skeleton]) -> Scene {
    let links = Strand {
        name: "robot".into(),
        points: millimetres(&robot.line),
        ..Strand::default()
    };
    let thin = |points: &mut Vec<V3>, other: &Skeleton| {
        points.extend(millimetres(&other.line));
        points.push([f64::NAN; 3]);
    };
    let mut rest = Vec::new();
    others.iter().for_each(|other| thin(&mut rest, other));
    let rest = (!rest.is_empty()).then(|| Strand {
        name: "other postures".into(),
        points: rest,
        thin: true,
        ..Strand::default()
    });
    let disc = |(at, name, tint): (V3, String, Option<f64>)| Strand {
        name,
        points: millimetres(&[at]),
        tint,
        disc: true,
        ..Strand::default()
    };
    let discs = labels(robot, shares).into_iter().map(disc);
    Scene {
        title: title.into(),
        unit: "mm".into(),
        strands: [links].into_iter().chain(rest).chain(discs).collect(),
    }
}

/// How far a swing is drawn: its largest movement becomes a fixed share of the robot.
fn enlarged(robot: &Skeleton, swing: &[V3]) -> Vec<V3> {
    let most = swing.iter().map(|v| norm(*v)).fold(0.0, f64::max);
    let size = robot.line.iter().map(|p| norm(*p)).fold(0.0, f64::max);
    let by = if most > 0.0 { DRAWN * size / most } else { 0.0 };
    swing.iter().map(|v| scale(by, *v)).collect()
}

/// Lines at rest and as they swing, m: as large as `swing` is given, and as `lead` a quarter of a
/// period earlier.
pub fn swinging(title: &str, line: &[V3], [swing, lead]: [&[V3]; 2]) -> Scene {
    let still = Strand {
        name: "at rest".into(),
        points: millimetres(line),
        thin: true,
        ..Strand::default()
    };
    let moving = Strand {
        name: "swinging, enlarged".into(),
        points: millimetres(line),
        swing: millimetres(swing),
        lead: millimetres(lead),
        ..Strand::default()
    };
    Scene {
        title: title.into(),
        unit: "mm".into(),
        strands: vec![moving, still],
    }
}

/// From the side and from above, for paper: `moved` is a second line, dashed.
pub fn chart(chart: Chart, robot: &Skeleton, moved: Option<(&str, &[V3])>) -> Chart {
    let view = |name: &str, [a, b]: [usize; 2]| {
        let axes = ["x", "y", "z"].map(|axis| Axis::new(axis, "m"));
        let flat = |p: &V3| [p[a], p[b]];
        let mut panel = Panel::new(axes[a].clone(), axes[b].clone())
            .noted(name)
            .equal_axes()
            .with(Series::line("robot", robot.line.iter().map(flat).collect()));
        if let Some((what, line)) = moved {
            panel = panel.with(Series::dashed(what, line.iter().map(flat).collect()));
        }
        let labels = labels(robot, &[]);
        let places = labels.iter().map(|one| flat(&one.0)).collect();
        panel = panel.with(Series::points("joints", places));
        labels
            .into_iter()
            .fold(panel, |panel, (at, text, _)| panel.named(flat(&at), text))
    };
    chart
        .with(view("from the side", [0, 2]))
        .with(view("from above", [0, 1]))
}
