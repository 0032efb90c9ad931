//! `[rig]` of `campaign.toml`: what the laboratory can build, so that only such set-ups are proposed.

use super::workspace_test::DIRECTIONS;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::vector::V3;
use serde::Deserialize;
use std::path::Path;

/// What can be built; everything, where nothing is stated.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rig {
    /// Corners of the box in which a load can be brought onto the tool, m, base frame.
    pub tool: Option<[V3; 2]>,
    /// Boxes that the tool must stay out of, m, base frame.
    pub keep_out: Vec<[V3; 2]>,
    /// Directions in which a load can be brought: 0 x, 1 y, 2 z.
    pub directions: Option<Vec<usize>>,
    /// Places where a sensor can stand: `tool`, `link1` .., `foot`.
    pub sensors: Option<Vec<String>>,
    /// Whether bars can lengthen the tool.
    pub bars: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    tool_min_m: Option<V3>,
    tool_max_m: Option<V3>,
    #[serde(default)]
    keep_out: Vec<Corners>,
    directions: Option<Vec<String>>,
    sensors: Option<Vec<String>>,
    bars: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Corners {
    min_m: V3,
    max_m: V3,
}

impl Rig {
    /// That of the folder of a campaign.
    ///
    /// # Errors
    /// A `campaign.toml` that is no TOML, a key or a value of `[rig]` that is not understood.
    pub fn of_folder(folder: &Path) -> Outcome<Self> {
        let path = folder.join("campaign.toml");
        let Ok(text) = std::fs::read_to_string(&path) else {
            return Ok(Self::default());
        };
        Self::of_text(&text).map_err(|problem| problem.in_column("rig").at_line(1).in_file(&path))
    }

    fn of_text(text: &str) -> Outcome<Self> {
        let remedy = "write [rig] with tool_min_m, tool_max_m, keep_out, directions, sensors, bars";
        let refused =
            |what: &str| Problem::new(format!("is not understood: {}", what.trim()), remedy);
        let mut table: toml::Table = text
            .parse()
            .map_err(|e: toml::de::Error| refused(e.message()))?;
        let Some(rig) = table.remove("rig") else {
            return Ok(Self::default());
        };
        let text: Text = rig
            .try_into()
            .map_err(|e: toml::de::Error| refused(e.message()))?;
        let tool = match (text.tool_min_m, text.tool_max_m) {
            (None, None) => None,
            (low, high) => Some([low.unwrap_or([f64::MIN; 3]), high.unwrap_or([f64::MAX; 3])]),
        };
        let boxes = text
            .keep_out
            .into_iter()
            .map(|corners| [corners.min_m, corners.max_m]);
        let rig = Self {
            tool,
            keep_out: boxes.collect(),
            directions: text
                .directions
                .map(|names| directions(&names))
                .transpose()?,
            sensors: text.sensors,
            bars: text.bars,
        };
        let sound = |[low, high]: &[V3; 2]| (0..3).all(|i| low[i] <= high[i]);
        match rig.tool.iter().chain(&rig.keep_out).all(sound) {
            true => Ok(rig),
            false => Err(refused(
                "a box whose lower corner is not below its upper one",
            )),
        }
    }

    /// Whether anything is stated.
    pub fn is_free(&self) -> bool {
        *self == Self::default()
    }

    /// Whether a load can be brought onto the tool at this place, m, base frame.
    pub fn reaches(&self, tip: V3) -> bool {
        let inside = |[low, high]: &[V3; 2]| (0..3).all(|i| tip[i] >= low[i] && tip[i] <= high[i]);
        self.tool.as_ref().is_none_or(inside) && !self.keep_out.iter().any(inside)
    }

    /// Whether a load can be brought in this direction.
    pub fn pulls(&self, direction: usize) -> bool {
        let known = self.directions.as_ref();
        known.is_none_or(|all| all.contains(&direction))
    }

    /// Whether a sensor can stand there.
    pub fn sees(&self, place: &str) -> bool {
        let known = self.sensors.as_ref();
        known.is_none_or(|all| all.iter().any(|one| one == place))
    }
}

fn directions(names: &[String]) -> Outcome<Vec<usize>> {
    let number = |name: &String| {
        DIRECTIONS
            .iter()
            .position(|known| *known == name.as_str())
            .ok_or_else(|| {
                let remedy = "give directions = [\"x\", \"y\", \"z\"], or some of them";
                Problem::new(format!("`{name}` is no direction"), remedy)
            })
    };
    names.iter().map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rig_says_what_can_be_built_and_slips_are_refused() {
        let rig = Rig::of_text(
            "kind = \"workspace\"\n[rig]\ntool_min_m = [1.0, -0.5, 0.4]\ntool_max_m = [2.0, 0.5, 1.5]\n\
             directions = [\"x\", \"z\"]\nsensors = [\"tool\"]\n\
             keep_out = [{ min_m = [1.4, -0.1, 0.4], max_m = [1.6, 0.1, 0.9] }]\n",
        )
        .unwrap();
        assert!(
            rig.reaches([1.2, 0.0, 1.0])
                && !rig.reaches([1.5, 0.0, 0.5])
                && !rig.reaches([3.0, 0.0, 1.0])
        );
        assert!(rig.pulls(0) && !rig.pulls(1) && rig.sees("tool") && !rig.sees("foot"));
        assert!(Rig::of_text("kind = \"workspace\"\n").unwrap().is_free());
        for wrong in [
            "[rig]\ntool_min = [0, 0, 0]\n",
            "[rig]\ndirections = [\"up\"]\n",
            "[rig]\ntool_min_m = [1.0, 0.0, 0.0]\ntool_max_m = [0.0, 1.0, 1.0]\n",
        ] {
            assert!(Rig::of_text(wrong).is_err(), "{wrong}");
        }
    }
}
