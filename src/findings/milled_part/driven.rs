//! The part milled along another way than the programmed one: what the controller makes of that.

use super::stations::Station;
use crate::ground::spatial::{V3, norm, sub, unit};
use crate::process::way::Row;
use crate::process::{Planned, Way};

/// A way in the place of the programmed one, and when it passes where that one is at a time (s).
pub(super) struct Driven {
    /// The way.
    pub way: Way,
    /// When it passes a station, about.
    pub when: Box<dyn Fn(&Station) -> f64 + Send + Sync>,
}

impl Driven {
    /// The programmed way.
    pub fn as_told(way: &Way) -> Self {
        Self {
            way: way.clone(),
            when: Box::new(|s| s.time_s),
        }
    }

    /// Axes that lag behind by a first order, with a time constant (s), of commands that run in straight lines from cycle to cycle.
    pub fn late(way: &Way, tau_s: f64) -> Option<Self> {
        let mut last: Option<[Row; 2]> = None;
        let follow = |row: &Row| {
            let now = match &last {
                None => row.clone(),
                Some([told, followed]) => lagged([told, row], followed, tau_s),
            };
            last = Some([row.clone(), now.clone()]);
            now
        };
        Some(Self {
            way: Way::new(way.rows().iter().map(follow).collect())?,
            when: Box::new(move |s| s.time_s + tau_s),
        })
    }

    /// Corners that are blended from farther away than was asked for, m.
    pub fn blended(planned: &Planned, farther_m: f64) -> Option<Self> {
        let mut toolpath = planned.toolpath.clone();
        let raise = |blend: &mut Option<f64>| {
            if let Some(own) = blend.as_mut().filter(|own| **own > 0.0) {
                *own += farther_m;
            }
        };
        for step in &mut toolpath.moves {
            raise(&mut step.blend);
            raise(&mut step.own_blend);
        }
        let mut job = planned.job.clone();
        let is_told = toolpath.moves.iter().any(|step| step.blend.is_some());
        if job.blend_radius.is_some() || !is_told {
            job.blend_radius = Some(job.blend_radius.unwrap_or(0.0) + farther_m);
        }
        let planned = Planned::of(job, toolpath).ok()?.ok()?;
        let way = planned.setup(None).ok()?.way;
        let own = way.clone();
        Some(Self {
            way,
            when: Box::new(move |s| nearest(&own, s)),
        })
    }
}

/// Where axes are that lag: from one command to the next, and from where they were (x' = (u − x)/τ, u a straight line).
fn lagged(told: [&Row; 2], followed: &Row, tau_s: f64) -> Row {
    let [from, to] = told;
    let step = (to.time_s - from.time_s) / tau_s;
    let kept = (-step).exp();
    let one = |from: f64, to: f64, was: f64| {
        let behind = (to - from) / step;
        to - behind + kept * (was - from + behind)
    };
    let each = |a: V3, b: V3, was: V3| -> V3 { std::array::from_fn(|k| one(a[k], b[k], was[k])) };
    let joints = 0..to.joints.len();
    Row {
        time_s: to.time_s,
        s_m: one(from.s_m, to.s_m, followed.s_m),
        tip: each(from.tip, to.tip, followed.tip),
        axis: unit(each(from.axis, to.axis, followed.axis)).unwrap_or(to.axis),
        joints: joints
            .map(|j| one(from.joints[j], to.joints[j], followed.joints[j]))
            .collect(),
    }
}

/// When a way is nearest to a station, about where it has gone the share of its length that the programmed one has there.
fn nearest(way: &Way, s: &Station) -> f64 {
    let rows = way.rows();
    let gone = s.share * rows.last().map_or(0.0, |row| row.s_m);
    let about = |row: &&Row| (row.s_m - gone).abs() < ABOUT;
    let far = |row: &Row| norm(sub(row.tip, s.tip));
    let near = rows.iter().filter(about);
    let near = near.min_by(|a, b| far(a).total_cmp(&far(b)));
    near.map_or(s.time_s, |row| row.time_s)
}

/// How far a place may be along another way from where it is by its share, m: as much as a dozen blends take off.
const ABOUT: f64 = 10e-3;

#[cfg(test)]
mod tests {
    use super::Driven;
    use crate::process::Way;
    use crate::process::way::Row;

    /// On a ramp axes that lag are behind by speed times time constant, however long a cycle is.
    #[test]
    fn a_lag_is_its_time_constant_behind() {
        let row = |k: i32| Row {
            time_s: 0.012 * f64::from(k),
            s_m: 0.012 * f64::from(k),
            tip: [0.012 * f64::from(k), 0.0, 0.0],
            axis: [0.0, 0.0, 1.0],
            joints: vec![0.1; 6],
        };
        let way = Way::new((0..60).map(row).collect()).unwrap();
        for tau in [0.005, 0.02, 0.08] {
            let late = Driven::late(&way, tau).unwrap().way;
            let [told, last] = [&way, &late].map(|w| w.rows()[59].tip[0]);
            assert!(
                (told - last - tau).abs() < 1e-3 * tau,
                "{tau}: {}",
                told - last
            );
        }
    }
}
