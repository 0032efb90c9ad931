//! `[workpiece]`: where the part stands, and what it is cut from.

use super::beside;
use crate::ground::problem::Outcome;
use crate::ground::spatial::{Pose, V3, roll_pitch_yaw};
use crate::ground::units::DEGREE;
use crate::measurement::keys::Keys;
use std::path::{Path, PathBuf};

/// Where the part stands, and what it is cut from.
#[derive(Debug, Clone, PartialEq)]
pub struct Workpiece {
    /// The workpiece frame in the base frame; columns of its rotation are the workpiece's axes.
    pub frame: Pose,
    /// The material before the first cut.
    pub stock: Option<Stock>,
}

/// The material before the first cut, in the workpiece frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Stock {
    /// A box along the axes of the workpiece frame.
    Box {
        /// Lowest corner, m.
        min: V3,
        /// Highest corner, m.
        max: V3,
    },
    /// A closed surface in an STL file (whose numbers are mm), looked up already.
    Stl(PathBuf),
}

const KEYS: &[&str] = &[
    "origin_m",
    "abc_deg",
    "stock_min_mm",
    "stock_max_mm",
    "stock",
];

impl Workpiece {
    pub(super) fn of(job: &Keys<'_>, path: &Path) -> Outcome<Self> {
        let example = "[workpiece] with origin_m = [1.5, 0.0, 0.8], its place in the base frame";
        let keys = job.table("workpiece", KEYS)?;
        let keys = keys.ok_or_else(|| job.missing("workpiece", example))?;
        let origin = keys.vector("origin_m")?;
        let [a, b, c] = keys.vector("abc_deg")?.unwrap_or_default();
        Ok(Self {
            frame: Pose {
                point: origin
                    .ok_or_else(|| keys.missing("origin_m", "origin_m = [1.5, 0.0, 0.8]"))?,
                rotation: roll_pitch_yaw(c * DEGREE, b * DEGREE, a * DEGREE),
            },
            stock: stock(&keys, path)?,
        })
    }
}

fn stock(keys: &Keys<'_>, path: &Path) -> Outcome<Option<Stock>> {
    let (min, max) = (keys.vector("stock_min_mm")?, keys.vector("stock_max_mm")?);
    match (keys.name("stock")?, min, max) {
        (None, None, None) => Ok(None),
        (Some(name), None, None) => Ok(Some(Stock::Stl(beside(path, name)))),
        (None, Some(min), Some(max)) => block(keys, min, max).map(Some),
        (None, Some(_), None) => {
            Err(keys.missing("stock_max_mm", "stock_max_mm = [200.0, 120.0, 0.0]"))
        }
        (None, None, Some(_)) => {
            Err(keys.missing("stock_min_mm", "stock_min_mm = [0.0, 0.0, -30.0]"))
        }
        (Some(_), ..) => Err(keys.problem(
            "stock",
            "stands beside a box",
            "leave out `stock`, or `stock_min_mm` and `stock_max_mm`",
        )),
    }
}

fn block(keys: &Keys<'_>, min: V3, max: V3) -> Outcome<Stock> {
    match (0..3).find(|&i| min[i] >= max[i]) {
        None => Ok(Stock::Box {
            min: min.map(|x| x * 1e-3),
            max: max.map(|x| x * 1e-3),
        }),
        Some(i) => {
            let what = format!("is not above `stock_min_mm` along {}", ["x", "y", "z"][i]);
            let remedy = "write the lowest corner as stock_min_mm, the highest as stock_max_mm";
            Err(keys.problem("stock_max_mm", what, remedy))
        }
    }
}
