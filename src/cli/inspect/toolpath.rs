//! The account of a tool path: what its reader understood, and what it passed over.

use super::{Account, range, title};
use crate::ground::problem::Outcome;
use crate::ground::vector::V3;
use crate::measurement::toolpath::{Move, Orientation, READERS, Shape, Toolpath};
use crate::report::json;
use serde_json::{Map, Value, json};
use std::path::Path;

/// Whether files of that ending are paths and nothing else.
pub fn has_ending(ending: &str) -> bool {
    let own = READERS
        .iter()
        .filter(|reader| !reader.endings.contains(&"csv"));
    own.flat_map(|reader| reader.endings)
        .any(|known| *known == ending)
}

/// Reads and tells.
pub fn account(path: &Path) -> Outcome<Account> {
    let toolpath = Toolpath::read(path)?;
    let figures = Figures::of(&toolpath);
    Ok(Account {
        lines: lines(&toolpath, &figures),
        json: document(&toolpath, &figures),
        odd: odd(&toolpath, &figures),
    })
}

/// What is counted.
struct Figures {
    lines: usize,
    arcs: usize,
    rapids: usize,
    /// Moves without a feed that are not rapid.
    without_feed: usize,
    repeated: usize,
    /// Lowest and highest along x, y, z, mm.
    extent: [[f64; 2]; 3],
    /// Lowest and highest, mm/min; `None`: none stated.
    feed: Option<[f64; 2]>,
    orientations: &'static str,
}

impl Figures {
    fn of(path: &Toolpath) -> Self {
        let moves = path.moves.get(1..).unwrap_or_default();
        let count = |counted: &dyn Fn(&Move) -> bool| moves.iter().filter(|m| counted(m)).count();
        let curve = path.curve.iter().flat_map(|curve| curve.points.iter());
        let arcs = path.moves.windows(2).flat_map(|w| match w[1].shape {
            Shape::Arc(arc) => arc.turning_points(w[0].to),
            Shape::Line => Vec::new(),
        });
        let ends = path.moves.iter().map(|m| m.to);
        let points: Vec<V3> = ends.chain(arcs).chain(curve.copied()).collect();
        let feeds = moves.iter().filter_map(|m| m.feed);
        let feeds = feeds.chain(path.curve.iter().filter_map(|curve| curve.feed));
        let feed = range(feeds.map(|feed| feed * 6e4));
        let still = path
            .moves
            .windows(2)
            .filter(|w| w[0].to == w[1].to && w[1].shape == Shape::Line);
        Self {
            lines: count(&|m| m.shape == Shape::Line),
            arcs: count(&|m| m.shape != Shape::Line),
            rapids: count(&|m| m.rapid),
            without_feed: count(&|m| !m.rapid && m.feed.is_none()),
            repeated: still.count(),
            extent: [0, 1, 2].map(|axis| range(points.iter().map(|p| p[axis] * 1e3))),
            feed: (feed[0] <= feed[1]).then_some(feed),
            orientations: orientations(path),
        }
    }
}

/// What the file says of the tool's orientation.
fn orientations(path: &Toolpath) -> &'static str {
    let curve = path
        .curve
        .iter()
        .flat_map(|curve| curve.orientations.iter().copied());
    let mut all = path.moves.iter().map(|m| m.orientation).chain(curve);
    let Some(first) = all.next() else {
        return "none";
    };
    match (first, all.all(|other| other == first)) {
        (Orientation::Axis(_), true) => "one spindle axis, turn about it free",
        (Orientation::Axis(_), false) => "spindle axis changes, turn about it free",
        (Orientation::Full(_), true) => "one orientation",
        (Orientation::Full(_), false) => "orientation changes",
    }
}

fn lines(path: &Toolpath, figures: &Figures) -> Vec<String> {
    let mut lines = title(
        &path.path,
        &format!("path, read as {}", path.format),
        path.synthetic,
    );
    match &path.curve {
        Some(curve) => lines.push(format!(
            "a NURBS of degree {} with {} control points",
            curve.degree,
            curve.points.len()
        )),
        None => lines.push(format!(
            "{} points: {} lines and {} arcs, {} of them rapid",
            path.moves.len(),
            figures.lines,
            figures.arcs,
            figures.rapids
        )),
    }
    for (axis, [low, high]) in ["x", "y", "z"].into_iter().zip(figures.extent) {
        lines.push(format!("{axis} from {low:.3} to {high:.3} mm"));
    }
    lines.push(match figures.feed {
        None => "no feed is stated: the job does".into(),
        Some([low, high]) if low == high => format!("feed {low:.1} mm/min"),
        Some([low, high]) => format!("feed from {low:.1} to {high:.1} mm/min"),
    });
    lines.push(figures.orientations.into());
    for passed in &path.passed_over {
        lines.push(format!(
            "passed over: {} ({} times, first on line {})",
            passed.what, passed.count, passed.line
        ));
    }
    lines
}

fn document(path: &Toolpath, figures: &Figures) -> Map<String, Value> {
    let further = path
        .inputs
        .iter()
        .map(|(path, hash)| (path.as_path(), hash.as_str()));
    let inputs: Vec<(&Path, &str)> = [(path.path.as_path(), path.sha256.as_str())]
        .into_iter()
        .chain(further)
        .collect();
    let mut map = json::head("inspect", &inputs);
    map.insert("kind".into(), json!("path"));
    map.insert("format".into(), json!(path.format));
    map.insert("synthetic".into(), json!(path.synthetic));
    map.insert("points".into(), json!(path.moves.len()));
    map.insert("lines".into(), json!(figures.lines));
    map.insert("arcs".into(), json!(figures.arcs));
    map.insert("rapid".into(), json!(figures.rapids));
    map.insert(
        "extent_mm".into(),
        figures.extent.iter().map(|e| json::numbers(e)).collect(),
    );
    map.insert(
        "feed_mm_min".into(),
        figures
            .feed
            .map_or(Value::Null, |feed| json::numbers(&feed)),
    );
    map.insert("orientations".into(), json!(figures.orientations));
    let curve = path.curve.as_ref();
    let curve = curve.map(|c| json!({"degree": c.degree, "control_points": c.points.len()}));
    map.insert("curve".into(), json!(curve));
    let passed = path.passed_over.iter();
    let passed = passed.map(|p| json!({"what": p.what, "count": p.count, "line": p.line}));
    map.insert("passed_over".into(), passed.collect());
    map
}

fn odd(path: &Toolpath, figures: &Figures) -> Vec<String> {
    let mut odd = Vec::new();
    let partly = figures.without_feed > 0 && figures.feed.is_some();
    if partly {
        odd.push(format!("{} moves state no feed", figures.without_feed));
    }
    if figures.repeated > 0 && path.curve.is_none() {
        odd.push(format!("{} points repeat the one before", figures.repeated));
    }
    odd
}
