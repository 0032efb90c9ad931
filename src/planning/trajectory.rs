//! `trajectory.csv`: one row per cycle.

use super::plan::{Plan, Row};
use crate::ground::units::DEGREE;
use crate::measurement::front::{self, quoted};
use crate::path::quaternion::angles;
use rayon::prelude::*;
use std::fmt::Write;

/// Decimals of every number.
const DECIMALS: i32 = 10;
/// Rows of one part that is written by itself.
const PART: usize = 4096;
const HEADER: &str = "time_s,x_mm,y_mm,z_mm,a_deg,b_deg,c_deg,\
    q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,feed_m_s\n";

/// The file's text. `inputs`: path and SHA-256 of every file that it rests on, the job first.
pub fn text(plan: &Plan, inputs: &[(String, String)]) -> String {
    let parts: Vec<String> = plan.rows.par_chunks(PART).map(part).collect();
    let mut out = head(plan, inputs);
    out.push_str(HEADER);
    parts.iter().for_each(|part| out.push_str(part));
    out
}

fn head(plan: &Plan, inputs: &[(String, String)]) -> String {
    let mut out = String::from("# kind = \"trajectory\"\n");
    let job = inputs.first().map_or("", |input| input.0.as_str());
    let _ = writeln!(out, "# job = {}", quoted(job));
    let _ = writeln!(out, "# robot = {}", quoted(&plan.cell.robot.name));
    let _ = writeln!(out, "# cycle_ms = {:?}", plan.cycle * 1e3);
    let _ = writeln!(out, "# version = {}", quoted(env!("CARGO_PKG_VERSION")));
    let _ = writeln!(out, "# frame = \"workpiece\"");
    out + &front::inputs(inputs)
}

fn part(rows: &[Row]) -> String {
    let mut out = String::with_capacity(rows.len() * 220);
    for row in rows {
        line(&mut out, row);
    }
    out
}

fn line(out: &mut String, row: &Row) {
    number(out, row.t);
    let place = row.point.map(|x| x * 1e3);
    let turned = angles(&row.orientation.matrix()).map(|angle| angle / DEGREE);
    let joints = row.q.map(|q| q / DEGREE);
    let all = place.iter().chain(&turned).chain(&joints);
    for value in all.chain(&[row.feed]) {
        out.push(',');
        number(out, *value);
    }
    out.push('\n');
}

/// A number with [`DECIMALS`] decimals, in whole numbers where they hold it.
fn number(out: &mut String, value: f64) {
    let scaled = (value * 1e10).round();
    if scaled.abs() >= 9e15 {
        let _ = write!(out, "{value:.*}", DECIMALS as usize);
        return;
    }
    let digits = scaled as i64;
    if digits < 0 {
        out.push('-');
    }
    let size = digits.unsigned_abs();
    let (whole, rest) = (size / 10_u64.pow(10), size % 10_u64.pow(10));
    let mut text = [b'0'; 20];
    let mut at = 20;
    let mut left = rest;
    for _ in 0..10 {
        at -= 1;
        text[at] = b'0' + (left % 10) as u8;
        left /= 10;
    }
    at -= 1;
    text[at] = b'.';
    let mut left = whole;
    loop {
        at -= 1;
        text[at] = b'0' + (left % 10) as u8;
        left /= 10;
        if left == 0 {
            break;
        }
    }
    out.extend(text[at..].iter().map(|digit| char::from(*digit)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_formatter() {
        for value in [
            0.0,
            -0.0,
            1.0,
            -1.5,
            1_234.567_891_2,
            1e-10,
            -179.999_999_999_97,
            3.2e8,
        ] {
            let mut out = String::new();
            number(&mut out, value);
            let back: f64 = out.parse().unwrap();
            assert!((back - value).abs() <= 0.51e-10, "{out} {value}");
            assert_eq!(out.split('.').nth(1).map(str::len), Some(10), "{out}");
        }
    }
}
