//! A corrected path as a CSV of kind `path`: points so dense that the chords follow it, run through without a stop
//! wherever the programmed path does not stop.

use super::correction::Correction;
use crate::ground::spatial::{add, cross, norm, sub};
use crate::ground::units::DEGREE;
use crate::measurement::front::{self, quoted};
use crate::path::build::Part;
use crate::path::corner::{Corner, Passage};
use crate::path::quaternion::angles;
use crate::planning::Plan;
use crate::planning::plan::Row;
use std::collections::BTreeSet;
use std::fmt::Write;

/// Largest turn between chords over their length: what keeps them this near to the corrected path, m.
const FINE: f64 = 1e-6;
/// Farthest points, m.
const FAR: f64 = 1e-3;
/// Where chords are asked to be rounded before a point, m: half of the longest.
const JOINT: f64 = 0.5 * FAR;

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
    let rows = chosen(plan, correction);
    let stops = stops(plan, &rows);
    for (i, row) in rows.into_iter().enumerate() {
        let blend = if stops.contains(&i) { 0.0 } else { JOINT };
        line(&mut out, plan, row, correction, blend);
    }
    out
}

/// The rows that stand where the programmed path stops.
fn stops(plan: &Plan, rows: &[&Row]) -> BTreeSet<usize> {
    let stop = |corner: &&Corner| corner.passage == Passage::Stop;
    let corners = plan.path.corners.iter().filter(stop);
    let nearest = |corner: &Corner| {
        let away = |i: &usize| (rows[*i].s - corner.begin).abs();
        (0..rows.len()).min_by(|a, b| away(a).total_cmp(&away(b)))
    };
    corners.filter_map(nearest).collect()
}

/// Rows whose chords follow the corrected path.
fn chosen<'a>(plan: &'a Plan, correction: &Correction) -> Vec<&'a Row> {
    let place = |row: &Row| add(row.point, correction.at(row.s));
    let mut chosen: Vec<&Row> = Vec::new();
    let rows = &plan.rows;
    for (i, row) in rows.iter().enumerate() {
        let Some(last) = chosen.last() else {
            chosen.push(row);
            continue;
        };
        let way = row.s - last.s;
        let ends = i + 1 == rows.len();
        let moved = way > 1e-6;
        let far = moved
            && (way >= FAR * (1.0 - 1e-9) || bends(place(last), place(row), rows, i, correction));
        if far || (ends && moved) {
            chosen.push(row);
        }
    }
    chosen
}

/// Whether the next row leaves the line through two places.
fn bends(a: [f64; 3], b: [f64; 3], rows: &[Row], i: usize, correction: &Correction) -> bool {
    let Some(next) = rows.get(i + 1) else {
        return true;
    };
    let c = add(next.point, correction.at(next.s));
    let (ab, bc) = (sub(b, a), sub(c, b));
    norm(cross(ab, bc)) > FINE * norm(add(ab, bc)).max(1e-9)
}

fn line(out: &mut String, plan: &Plan, row: &Row, correction: &Correction, blend: f64) {
    let place = add(row.point, correction.at(row.s)).map(|x| 1e3 * x + 0.0);
    let turned = angles(&row.orientation.matrix()).map(|a| a / DEGREE + 0.0);
    for x in place {
        let _ = write!(out, "{x:.6},");
    }
    for a in turned {
        let _ = write!(out, "{a:.7},");
    }
    let (rapid, feed) = element(plan, row.s);
    let feed = feed.map_or(String::new(), |f| format!("{:.3}", f * 60e3));
    let (rapid, blend, s) = (u8::from(rapid), 1e3 * blend, 1e3 * row.s);
    let _ = writeln!(out, "{feed},{rapid},{blend:.3},{s:.6}");
}

/// Whether the piece at an arc length is a rapid motion, and its feed, m/s.
fn element(plan: &Plan, s: f64) -> (bool, Option<f64>) {
    let (Part::Element(k, _) | Part::Blend(k, _)) = plan.path.piece(s).part;
    let element = &plan.path.programme.elements[k];
    (element.rapid, element.feed)
}
