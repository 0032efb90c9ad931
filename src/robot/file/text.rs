//! The tables and keys of a robot file, as they are written (`formats.md`, section 2).

use crate::ground::spatial::{M3, V3};
use serde::Deserialize;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RobotText {
    pub(super) name: String,
    #[serde(default)]
    pub(super) source: String,
    #[serde(default)]
    pub(super) notes: Vec<String>,
    pub(super) joints: Vec<Spanned<JointText>>,
    pub(super) tool: Option<Spanned<ToolText>>,
    #[serde(default)]
    pub(super) elastic: Vec<Spanned<ElasticText>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct JointText {
    pub(super) name: String,
    pub(super) axis: V3,
    pub(super) point_m: V3,
    pub(super) limits_deg: Option<[f64; 2]>,
    pub(super) max_speed_deg_s: Option<f64>,
    pub(super) drive: Option<SpringText>,
    pub(super) tilt: Option<SpringText>,
    pub(super) link: Option<BodyText>,
    pub(super) source: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SpringText {
    #[serde(rename = "stiffness_Nm_rad")]
    pub(super) stiffness: f64,
    #[serde(rename = "damping_Nms_rad", default)]
    pub(super) damping: f64,
    #[serde(rename = "backlash_rad", default)]
    pub(super) backlash: OneOrMany,
    #[serde(default)]
    pub(super) effects: Vec<toml::Table>,
    pub(super) source: Option<String>,
    #[serde(rename = "stiffness_ci95_Nm_rad")]
    pub(super) stiffness_ci95: Option<[f64; 2]>,
    #[serde(rename = "damping_ci95_Nms_rad")]
    pub(super) damping_ci95: Option<[f64; 2]>,
    #[serde(rename = "backlash_ci95_rad")]
    pub(super) backlash_ci95: Option<[f64; 2]>,
}

/// One gap or a list of gaps in series.
#[derive(Deserialize)]
#[serde(untagged)]
pub(super) enum OneOrMany {
    One(f64),
    Many(Vec<f64>),
}

impl Default for OneOrMany {
    fn default() -> Self {
        Self::One(0.0)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyText {
    pub(super) mass_kg: f64,
    pub(super) com_m: V3,
    pub(super) inertia_kgm2: [f64; 6],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ToolText {
    pub(super) flange_m: Option<V3>,
    pub(super) tcp_m: V3,
    pub(super) rotation: Option<M3>,
    pub(super) body: Option<BodyText>,
    pub(super) source: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ElasticText {
    pub(super) name: String,
    pub(super) after: usize,
    pub(super) axis: V3,
    pub(super) point_m: V3,
    #[serde(rename = "stiffness_Nm_rad")]
    pub(super) stiffness: f64,
    #[serde(rename = "damping_Nms_rad", default)]
    pub(super) damping: f64,
    #[serde(rename = "backlash_rad", default)]
    pub(super) backlash: OneOrMany,
    #[serde(default)]
    pub(super) effects: Vec<toml::Table>,
    pub(super) source: Option<String>,
    #[serde(rename = "stiffness_ci95_Nm_rad")]
    pub(super) stiffness_ci95: Option<[f64; 2]>,
    #[serde(rename = "damping_ci95_Nms_rad")]
    pub(super) damping_ci95: Option<[f64; 2]>,
}
