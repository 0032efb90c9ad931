//! Set-ups that are missing, or broken off.

use super::{Loaded, Rule, names};
use crate::fit::force_steps::Setup;
use crate::fit::suitability::{Said, Weight};

/// A file that was cut off holds fewer points than it states, or a set-up with fewer steps.
pub const RULE: Rule = Rule {
    name: "few",
    remedy: "check that the whole file was copied; leave points that were not measured out of `joint_angles_deg`",
    look,
};

/// Share of the usual number of steps below which a set-up is broken off.
const BROKEN_OFF: f64 = 0.75;

fn look(on: &Loaded) -> Said {
    let points = on.test.facts.joint_angles.len();
    let missing: Vec<String> = (0..points)
        .filter(|p| on.setups.iter().all(|s| s.point != *p))
        .map(|p| format!("P{}", p + 1))
        .collect();
    let mut found = Vec::new();
    if !missing.is_empty() {
        let what = format!("joint angles but no steps: {}", missing.join(", "));
        found.push((Weight::Odd, what));
    }
    let directions = |p: usize| on.setups.iter().filter(|s| s.point == p).count();
    let most = (0..points).map(directions).max().unwrap_or(0);
    let partly: Vec<String> = (0..points)
        .filter(|p| (1..most).contains(&directions(*p)))
        .map(|p| format!("P{}", p + 1))
        .collect();
    if !partly.is_empty() {
        let what = format!(
            "loaded in fewer directions than the other points: {}",
            partly.join(", ")
        );
        found.push((Weight::Odd, what));
    }
    let mut rows: Vec<usize> = on.setups.iter().map(|s| s.rows).collect();
    rows.sort_unstable();
    let usual = rows.get(rows.len() / 2).copied().unwrap_or(0) as f64;
    let short = |s: &&Setup| (s.rows as f64) < BROKEN_OFF * usual;
    if on.setups.iter().any(|s| short(&s)) {
        let what = format!(
            "fewer steps than the usual {usual}: {}",
            names(on.setups.iter().filter(short))
        );
        found.push((Weight::Odd, what));
    }
    found
}
