//! The material that jobs load: the keys of `[material]`, with intervals and provenance.

use super::Found;
use crate::cutting::LINEAR_EDGE;
use crate::measurement::front::quoted;
use crate::sheet::number::significant;

/// Least spread that is written: no dynamometer is known better.
const LEAST_REL_STD: f64 = 1e-3;

/// The file's text.
pub fn text(found: &Found) -> String {
    let account = &found.account;
    let mut text = String::new();
    if found.synthetic() {
        text += "# synthetic: fitted to simulated measurements\n";
    }
    text += "# coefficients of dF = (K_c h + K_e) da; written by ident force\n";
    text += &format!("kind = \"material\"\nname = {}\n", quoted(&found.name));
    text += &format!("version = {}\n", quoted(env!("CARGO_PKG_VERSION")));
    text += &format!("synthetic = {}\n", found.synthetic());
    let input = |f: &crate::measurement::milling_force::MillingForce| {
        let path = quoted(&f.path.display().to_string());
        format!("{{ path = {path}, sha256 = \"{}\" }}", f.sha256)
    };
    let inputs: Vec<String> = found.files.iter().map(input).collect();
    text += &format!("inputs = [{}]\n", inputs.join(", "));
    let coefficients = LINEAR_EDGE.card().coefficients;
    for (c, p) in coefficients.iter().zip(&account.parameters) {
        let (Some(value), Some([low, high])) = (p.value, p.ci95) else {
            continue;
        };
        let interval = c.key.replacen('_', "_ci95_", 1);
        text += &format!("{} = {}\n", c.key, plain(value));
        text += &format!("{interval} = [{}, {}]\n", plain(low), plain(high));
    }
    let spread = account.rel_std.unwrap_or(0.0).max(LEAST_REL_STD);
    text += &format!("rel_std = {}\n", plain(spread.min(0.99)));
    for (p, key) in account.parameters[6..]
        .iter()
        .zip(["runout_um", "runout_angle_deg"])
    {
        if let Some(value) = p.value {
            text += &format!("{key} = {}\n", plain(value));
        }
    }
    text
}

/// Six significant digits, always a TOML float.
fn plain(value: f64) -> String {
    let rounded: f64 = significant(value, 6).parse().unwrap_or(value);
    format!("{rounded:?}")
}
