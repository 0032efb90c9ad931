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
    format!(
        "<div class=\"scene\">\n<canvas id=\"{id}\" tabindex=\"0\" role=\"img\" aria-label=\"{title}, in {unit}; \
         turn with the arrow keys, zoom with plus and minus\"></canvas>\n\
         <p class=\"note\">{title} (in {unit}). Drag to turn, roll to zoom.</p>\n\
         <script>\n{}(document.getElementById(\"{id}\"), [{}]);\n</script>\n</div>",
        SCRIPT.trim_end(),
        strands(&scene.strands)
    )
}

fn strands(strands: &[Strand]) -> String {
    let one = |strand: &Strand| {
        let name = plain(&strand.name);
        let thin = strand.thin;
        let mut points = String::new();
        for point in &strand.points {
            match point.iter().all(|x| x.is_finite()) {
                true => {
                    let [x, y, z] = point;
                    let _ = write!(points, "[{x:.3},{y:.3},{z:.3}],");
                }
                false => points.push_str("null,"),
            }
        }
        format!("{{name:\"{name}\",thin:{thin},points:[{points}]}}")
    };
    strands.iter().map(one).collect::<Vec<_>>().join(",\n")
}

/// Letters, digits and spaces: nothing that could end a string or a script.
fn plain(text: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '.' | ',');
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
                thin: false,
            }],
        };
        let html = ink(&scene, "scene-1");
        assert_eq!(html.matches("<script").count(), 1);
        assert_eq!(html.matches("</script").count(), 1);
        assert!(html.contains("points:[[1.000,2.000,3.000],null,]"));
    }
}
