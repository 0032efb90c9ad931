//! A view in space as a canvas with its own few lines of script: no library, no network. Without
//! scripts and on paper it is not there; the figure beside it is.

use super::escape::escape;
use crate::sheet::scene::{Scene, Strand};
use std::fmt::Write;

const SCRIPT: &str = include_str!("scene.js");

/// The element; `id` is unique in its page.
pub fn ink(scene: &Scene, id: &str) -> String {
    let title = escape(&scene.title);
    let unit = escape(&scene.unit);
    let swings = scene.strands.iter().any(|strand| !strand.swing.is_empty());
    let pause = if swings { ", space to stop" } else { "" };
    format!(
        "<div class=\"scene\">\n<canvas id=\"{id}\" tabindex=\"0\" role=\"img\" aria-label=\"{title}, in {unit}; \
         turn with the arrow keys, zoom with plus and minus{pause}\"></canvas>\n\
         <p class=\"note\">{title} (in {unit}). Drag to turn, roll to zoom{pause}.</p>\n\
         <script>\n{}(document.getElementById(\"{id}\"), [{}]);\n</script>\n</div>",
        SCRIPT.trim_end(),
        strands(&scene.strands)
    )
}

fn strands(strands: &[Strand]) -> String {
    let one = |strand: &Strand| {
        let name = plain(&strand.name);
        let (thin, points) = (strand.thin, listed(&strand.points));
        let mut more = String::new();
        if let Some(tint) = strand.tint {
            let _ = write!(more, ",tint:{tint:.3}");
        }
        if strand.disc {
            more.push_str(",disc:true");
        }
        if !strand.swing.is_empty() {
            let _ = write!(more, ",swing:[{}]", listed(&strand.swing));
        }
        if !strand.lead.is_empty() {
            let _ = write!(more, ",lead:[{}]", listed(&strand.lead));
        }
        format!("{{name:\"{name}\",thin:{thin},points:[{points}]{more}}}")
    };
    strands.iter().map(one).collect::<Vec<_>>().join(",\n")
}

fn listed(points: &[[f64; 3]]) -> String {
    let mut out = String::new();
    for [x, y, z] in points {
        let _ = match x.is_finite() && y.is_finite() && z.is_finite() {
            true => write!(out, "[{x:.3},{y:.3},{z:.3}],"),
            false => write!(out, "null,"),
        };
    }
    out
}

/// Letters, digits and spaces: nothing that could end a string or a script.
fn plain(text: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '.' | ',' | '%');
    text.chars().filter(kept).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_of_a_name_becomes_script() {
        let evil = "</script><script>alert(\"1\")//";
        let scene = Scene {
            title: evil.into(),
            unit: evil.into(),
            strands: vec![Strand {
                name: evil.into(),
                points: vec![[1.0, 2.0, 3.0], [f64::NAN; 3]],
                tint: Some(0.5),
                swing: vec![[0.0, 1.0, 0.0]],
                ..Strand::default()
            }],
        };
        let html = ink(&scene, "scene-1");
        assert_eq!(html.matches("<script").count(), 1);
        assert_eq!(html.matches("</script").count(), 1);
        assert!(html.contains(
            "points:[[1.000,2.000,3.000],null,],tint:0.500,swing:[[0.000,1.000,0.000],]"
        ));
    }
}
