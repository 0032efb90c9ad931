//! A corrected path as a CSV of kind `path`, dense enough that its corners need no blends.

use super::correction::Correction;
use crate::ground::spatial::{add, cross, norm, sub};
use crate::ground::units::DEGREE;
use crate::path::build::Part;
use crate::path::quaternion::angles;
use crate::planning::Plan;
use crate::planning::plan::Row;
use std::fmt::Write;

/// Largest turn between chords over their length: what keeps them this near to the corrected path, m.
const FINE: f64 = 1e-6;
/// Farthest points, m.
const FAR: f64 = 1e-3;

/// The file's text. `inputs`: path and SHA-256 of every file that it rests on, the job first.
pub fn text(
    plan: &Plan,
    correction: &Correction,
    method: &str,
    inputs: &[(String, String)],
    synthetic: bool,
) -> String {
    let quoted = |text: &str| toml::Value::String(text.to_string()).to_string();
    let mut out = String::from("# kind = \"path\"\n");
    if synthetic {
        out.push_str("# synthetic = true\n");
    }
    let job = inputs.first().map_or("", |input| input.0.as_str());
    let _ = writeln!(out, "# job = {}", quoted(job));
    let _ = writeln!(out, "# method = {}", quoted(method));
    let _ = writeln!(out, "# version = {}", quoted(env!("CARGO_PKG_VERSION")));
    let _ = writeln!(out, "# inputs = [");
    for (path, hash) in inputs {
        let (path, hash) = (quoted(path), quoted(hash));
        let _ = writeln!(out, "#   {{ path = {path}, sha256 = {hash} }},");
    }
    out.push_str("# ]\n");
    out.push_str("x_mm,y_mm,z_mm,a_deg,b_deg,c_deg,feed_mm_min,rapid,s_mm\n");
    for row in chosen(plan, correction) {
        line(&mut out, plan, row, correction);
    }
    out
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

fn line(out: &mut String, plan: &Plan, row: &Row, correction: &Correction) {
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
    let _ = writeln!(out, "{feed},{},{:.6}", u8::from(rapid), 1e3 * row.s);
}

/// Whether the piece at an arc length is a rapid motion, and its feed, m/s.
fn element(plan: &Plan, s: f64) -> (bool, Option<f64>) {
    let (Part::Element(k, _) | Part::Blend(k, _)) = plan.path.piece(s).part;
    let element = &plan.path.programme.elements[k];
    (element.rapid, element.feed)
}
