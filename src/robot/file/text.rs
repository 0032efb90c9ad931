//! The tables and keys of a robot file, as they are written (`formats.md`, section 2).

use super::super::spring::{Intervals, Spring};
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
    pub(super) max_acceleration_deg_s2: Option<f64>,
    pub(super) drive: Option<SpringText>,
    pub(super) tilt: Option<SpringText>,
    pub(super) link: Option<BodyText>,
    pub(super) source: Option<String>,
}

/// A table that carries the keys of a spring beside its own. Written by a macro, as `serde` refuses
/// unknown keys, and keeps their lines, only in tables that are flat.
macro_rules! with_spring {
    ($name:ident { $($key:ident: $kind:ty),* }) => {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(super) struct $name {
            $($key: $kind,)*
            #[serde(rename = "stiffness_Nm_rad")]
            stiffness: f64,
            #[serde(rename = "damping_Nms_rad", default)]
            damping: f64,
            #[serde(rename = "backlash_rad", default)]
            backlash: OneOrMany,
            #[serde(default)]
            effects: Vec<toml::Table>,
            source: Option<String>,
            #[serde(rename = "stiffness_ci95_Nm_rad")]
            stiffness_ci95: Option<[f64; 2]>,
            #[serde(rename = "damping_ci95_Nms_rad")]
            damping_ci95: Option<[f64; 2]>,
            #[serde(rename = "backlash_ci95_rad")]
            backlash_ci95: Option<[f64; 2]>,
            stiffness_rel_std: Option<f64>,
        }

        impl $name {
            /// The spring, its effects as written, and the keys of the table itself.
            pub(super) fn parts(self) -> (Spring, Vec<toml::Table>, ($($kind,)*)) {
                let spring = Spring {
                    stiffness: self.stiffness,
                    damping: self.damping,
                    backlash: self.backlash.gaps(),
                    effects: Vec::new(),
                    source: self.source,
                    ci95: Intervals {
                        stiffness: self.stiffness_ci95,
                        damping: self.damping_ci95,
                        backlash: self.backlash_ci95,
                    },
                    stiffness_rel_std: self.stiffness_rel_std,
                };
                (spring, self.effects, ($(self.$key,)*))
            }
        }
    };
}

with_spring!(SpringText {});
with_spring!(ElasticText {
    name: String,
    after: usize,
    axis: V3,
    point_m: V3,
    body: Option<BodyText>
});

/// One gap or a list of gaps in series.
#[derive(Deserialize)]
#[serde(untagged)]
enum OneOrMany {
    One(f64),
    Many(Vec<f64>),
}

impl OneOrMany {
    /// The gaps that are there.
    fn gaps(self) -> Vec<f64> {
        let mut gaps = match self {
            Self::One(gap) => vec![gap],
            Self::Many(gaps) => gaps,
        };
        gaps.retain(|gap| *gap != 0.0);
        gaps
    }
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
    pub(super) spindle_axis: Option<V3>,
    pub(super) body: Option<BodyText>,
    pub(super) source: Option<String>,
}
