//! A corrected path as a CSV of kind `path`: points so dense that the chords follow it, run through without a stop
//! wherever the programmed path does not stop.

use super::correction::Correction;
use super::points::{self, Point, points};
use crate::ground::units::DEGREE;
use crate::measurement::front::{self, quoted};
use crate::path::build::Part;
use crate::path::corner::{Corner, Passage};
use crate::path::quaternion::angles;
use crate::planning::Plan;
use std::collections::BTreeSet;
use std::fmt::Write;

/// Where chords are asked to be rounded before a point, m: half of the longest.
const JOINT: f64 = 0.5 * points::FAR;

/// The file's text. `inputs`: path and SHA-256 of every file that it rests on, the job first.
pub fn text(
    plan: &Plan,
    correction: &Correction,
    method: &str,
    inputs: &[(String, String)],
    synthetic: bool,
) -> String {
    let mut out = String::from("# kind = \"path\"\n");
    if synthetic {
        out.push_str("# synthetic = true\n");
    }
    let job = inputs.first().map_or("", |input| input.0.as_str());
    let _ = writeln!(out, "# job = {}", quoted(job));
    let _ = writeln!(out, "# method = {}", quoted(method));
    let _ = writeln!(out, "# version = {}", quoted(env!("CARGO_PKG_VERSION")));
    out.push_str(&front::inputs(inputs));
    out.push_str("x_mm,y_mm,z_mm,a_deg,b_deg,c_deg,feed_mm_min,rapid,blend_mm,s_mm\n");
    let points = points(plan, correction);
    let stops = stops(plan, &points);
    for (i, point) in points.iter().enumerate() {
        let blend = if stops.contains(&i) { 0.0 } else { JOINT };
        line(&mut out, plan, point, blend);
    }
    out
}

/// The points at which the programmed path stops.
fn stops(plan: &Plan, points: &[Point]) -> BTreeSet<usize> {
    let stop = |corner: &&Corner| corner.passage == Passage::Stop;
    let corners = plan.path.corners.iter().filter(stop);
    let nearest = |corner: &Corner| {
        let away = |i: &usize| (points[*i].s - corner.begin).abs();
        (0..points.len()).min_by(|a, b| away(a).total_cmp(&away(b)))
    };
    corners.filter_map(nearest).collect()
}

fn line(out: &mut String, plan: &Plan, point: &Point, blend: f64) {
    let place = point.place.map(|x| 1e3 * x + 0.0);
    let turned = angles(&point.orientation.matrix()).map(|a| a / DEGREE + 0.0);
    for x in place {
        let _ = write!(out, "{x:.6},");
    }
    for a in turned {
        let _ = write!(out, "{a:.7},");
    }
    let (rapid, feed) = element(plan, point.s);
    let feed = feed.map_or(String::new(), |f| format!("{:.3}", f * 60e3));
    let (rapid, blend, s) = (u8::from(rapid), 1e3 * blend, 1e3 * point.s);
    let _ = writeln!(out, "{feed},{rapid},{blend:.3},{s:.6}");
}

/// Whether the piece at an arc length is a rapid motion, and its feed, m/s.
fn element(plan: &Plan, s: f64) -> (bool, Option<f64>) {
    let (Part::Element(k, _) | Part::Blend(k, _)) = plan.path.piece(s).part;
    let element = &plan.path.programme.elements[k];
    (element.rapid, element.feed)
}
