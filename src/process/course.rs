//! `course.csv`: force and deviation over the path.

use super::run::Cut;
use crate::measurement::front::{self, quoted};
use std::fmt::Write;

const HEADER: &str = "time_s,s_mm,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,dx_mm,dy_mm,dz_mm\n";

/// The file's text. `inputs`: path and SHA-256 of every file that it rests on, the job first; `support`
/// names what carried the tool.
pub fn text(course: &[Cut], inputs: &[(String, String)], support: &str) -> String {
    let job = inputs.first().map_or("", |input| input.0.as_str());
    let mut out = String::from("# kind = \"course\"\n");
    let _ = writeln!(out, "# job = {}", quoted(job));
    let _ = writeln!(out, "# version = {}", quoted(env!("CARGO_PKG_VERSION")));
    let _ = writeln!(out, "# frame = \"workpiece\"");
    let _ = writeln!(out, "# robot_is = {}", quoted(support));
    out.push_str(&front::inputs(inputs));
    out.push_str(HEADER);
    course.iter().for_each(|cut| line(&mut out, cut));
    out
}

fn line(out: &mut String, cut: &Cut) {
    let mm = |v: [f64; 3]| v.map(|x| 1e3 * x + 0.0);
    let _ = write!(out, "{:.9},{:.6}", cut.time_s, 1e3 * cut.s_m);
    for x in mm(cut.tip) {
        let _ = write!(out, ",{x:.6}");
    }
    for f in cut.force {
        let _ = write!(out, ",{:.5}", f + 0.0);
    }
    for d in mm(cut.deviation) {
        let _ = write!(out, ",{d:.7}");
    }
    out.push('\n');
}
