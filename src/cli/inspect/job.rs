//! The account of a job: what it says, and whether its files are there.

use super::{Account, title};
use crate::ground::problem::Outcome;
use crate::measurement::job::{Job, Stock};
use crate::report::json;
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;
use std::path::Path;

/// Reads and tells.
pub fn account(path: &Path) -> Outcome<Account> {
    let job = Job::read(path)?;
    Ok(Account {
        lines: lines(&job),
        json: document(&job),
        odd: odd(&job),
    })
}

fn lines(job: &Job) -> Vec<String> {
    let mut lines = title(&job.path, "job", job.synthetic);
    lines.push(format!(
        "robot {}, path {}",
        job.robot,
        job.toolpath.display()
    ));
    lines.push(match job.feed {
        Some(feed) => format!("feed {:.1} mm/min", feed * 6e4),
        None => "the feed is the path's own".into(),
    });
    let [x, y, z] = job.workpiece.frame.point;
    lines.push(format!(
        "workpiece at {x:.4}, {y:.4}, {z:.4} m in the base frame"
    ));
    if let Some(Stock::Box { min, max }) = &job.workpiece.stock {
        let [x, y, z] = [0, 1, 2].map(|i| (max[i] - min[i]) * 1e3);
        lines.push(format!("stock {x:.1} x {y:.1} x {z:.1} mm"));
    }
    if let Some(cutter) = &job.cutter {
        lines.push(format!(
            "tool {:.3} mm, {} teeth",
            cutter.diameter * 1e3,
            cutter.teeth
        ));
    }
    if let Some(material) = &job.material {
        lines.push(format!("material {}", material.name));
    }
    lines
}

fn document(job: &Job) -> Map<String, Value> {
    let further = job
        .inputs
        .iter()
        .map(|(path, hash)| (path.as_path(), hash.as_str()));
    let own = (job.path.as_path(), job.sha256.as_str());
    let inputs: Vec<(&Path, &str)> = [own].into_iter().chain(further).collect();
    let mut map = json::head("inspect", &inputs);
    let cutter = job.cutter.as_ref();
    map.insert("kind".into(), json!("job"));
    map.insert("synthetic".into(), json!(job.synthetic));
    map.insert("robot".into(), json!(job.robot));
    map.insert("path".into(), json!(job.toolpath.display().to_string()));
    map.insert("feed_m_s".into(), json!(job.feed));
    map.insert("adapt".into(), json!(job.adapt));
    map.insert("blend_radius_m".into(), json!(job.blend_radius));
    map.insert("cycle_s".into(), json!(job.cycle));
    map.insert("workpiece_m".into(), json!(job.workpiece.frame.point));
    map.insert("teeth".into(), json!(cutter.map(|c| c.teeth)));
    map.insert("diameter_m".into(), json!(cutter.map(|c| c.diameter)));
    let rpm = cutter.and_then(|c| c.spindle).map(|w| w / TAU * 60.0);
    map.insert("spindle_rpm".into(), json!(rpm));
    map.insert(
        "material".into(),
        json!(job.material.as_ref().map(|m| &m.name)),
    );
    map.insert("tolerance_m".into(), json!(job.limits.tolerance));
    map
}

fn odd(job: &Job) -> Vec<String> {
    let mut odd = Vec::new();
    if !job.toolpath.is_file() {
        odd.push(format!("the path {} is not there", job.toolpath.display()));
    }
    if let Some(Stock::Stl(file)) = &job.workpiece.stock
        && !file.is_file()
    {
        odd.push(format!("the stock {} is not there", file.display()));
    }
    odd
}
