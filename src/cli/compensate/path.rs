//! The compensated path as a CSV of kind `path`, dense enough that its corners need no blends.

use super::Result;
use crate::compensation::Correction;
use crate::ground::spatial::{add, norm, sub};
use crate::ground::units::DEGREE;
use crate::path::quaternion::angles;
use crate::planning::Plan;
use crate::planning::plan::Row;
use std::fmt::Write;

/// Largest distance of a chord from the corrected path, m.
const FINE: f64 = 1e-6;
/// Farthest points, m.
const FAR: f64 = 1e-3;

/// The file's text.
pub fn text(result: &Result) -> String {
    let quoted = |text: &str| toml::Value::String(text.to_string()).to_string();
    let mut out = String::from("# kind = \"path\"\n");
    let inputs = result.inputs();
    let job = inputs.first().map_or("", |input| input.0.as_str());
    let _ = writeln!(out, "# job = {}", quoted(job));
    let _ = writeln!(out, "# method = {}", quoted(result.method.name));
    let _ = writeln!(out, "# version = {}", quoted(env!("CARGO_PKG_VERSION")));
    let _ = writeln!(out, "# inputs = [");
    for (path, hash) in &inputs {
        let _ = writeln!(
            out,
            "#   {{ path = {}, sha256 = {} }},",
            quoted(path),
            quoted(hash)
        );
    }
    out.push_str("# ]\n");
    out.push_str("x_mm,y_mm,z_mm,a_deg,b_deg,c_deg,feed_mm_min,rapid,s_mm\n");
    let plan = &result.planned.plan;
    for row in chosen(plan, &result.found.correction) {
        line(&mut out, plan, row, &result.found.correction);
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
    let turn = crate::ground::spatial::cross(ab, bc);
    norm(turn) > FINE * norm(add(ab, bc)).max(1e-9)
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
    let element = element(plan, row.s);
    let feed = element
        .1
        .map_or(String::new(), |f| format!("{:.3}", f * 60e3));
    let _ = writeln!(out, "{feed},{},{:.6}", u8::from(element.0), 1e3 * row.s);
}

/// Whether the piece at an arc length is a rapid motion, and its feed, m/s.
fn element(plan: &Plan, s: f64) -> (bool, Option<f64>) {
    use crate::path::build::Part;
    let (Part::Element(k, _) | Part::Blend(k, _)) = plan.path.piece(s).part;
    let element = &plan.path.programme.elements[k];
    (element.rapid, element.feed)
}
