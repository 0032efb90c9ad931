//! What stands beside the coefficients: runout, bandwidth, angles, speeds, widths.

use super::{Answer, FIXED, FIXED_ANGLE, SEEN, at_begin, wrapped};
use crate::experiments::milling_force::{BANDWIDTH, PHASE, RUNOUT, SPEED, WIDTH};
use crate::fit::parameter::{Identified, Status, Z95};
use crate::ground::units::DEGREE;
use std::f64::consts::TAU;

impl Answer<'_> {
    pub(super) fn runout(&self) -> Vec<Identified> {
        let meaning = "distance of the tool's axis from the spindle's";
        let towards = "direction of the runout from tooth 1 at the tip, in the sense of rotation; tooth 1 is the one nearest to φ = 0 at the first sample of the first cut";
        let unseen = |name: &str, unit: &str, meaning: &str| {
            Identified::new(name, "tool", 0.0, unit, 0.0, meaning)
                .without_value(Status::NotIdentifiable)
        };
        let places = [0, 1].map(|k| self.layout.of_cut[0][RUNOUT + k]);
        let [Some(a), Some(b)] = places else {
            return vec![
                unseen("runout", "µm", meaning),
                unseen("runout_angle", "deg", towards),
            ];
        };
        let (x, y) = (self.p[a], self.p[b]);
        let size = x.hypot(y).max(1e-15);
        let spread = |u: f64, v: f64| {
            let c = self.covariance;
            (u * u * c[(a, a)] + 2.0 * u * v * c[(a, b)] + v * v * c[(b, b)])
                .max(0.0)
                .sqrt()
        };
        let (along, across) = (spread(x / size, y / size), spread(-y / size, x / size));
        let widest = self.stderr(a).max(self.stderr(b));
        let angle = y.atan2(x);
        let runout = Identified::new("runout", "tool", 1e6 * size, "µm", 1e6 * along, meaning);
        let turn = across / size;
        let towards = Identified::new(
            "runout_angle",
            "tool",
            angle / DEGREE,
            "deg",
            turn / DEGREE,
            towards,
        );
        let open = widest > FIXED * self.mean_feed().max(size);
        let (first, second) = match (open, size > self.seen() * along) {
            (true, _) => (Status::NotIdentifiable, Status::NotIdentifiable),
            (false, false) => (Status::AtBound, Status::NotIdentifiable),
            (false, true) if turn > FIXED_ANGLE => (Status::Identified, Status::NotIdentifiable),
            _ => (Status::Identified, Status::Identified),
        };
        let said = |found: Identified, status: Status| match status {
            Status::Identified => found,
            Status::AtBound => found.limited(status, 1e6 * (size + Z95 * along)),
            Status::NotIdentifiable => found.without_value(status),
        };
        vec![said(runout, first), said(towards, second)]
    }

    /// By what factor a runout must stand out of its standard error: the names of the teeth were chosen in every cut so that the
    /// runouts point one way, which noise alone does too. As seldom as a single cut's noise is beyond [`SEEN`] (Rayleigh's law),
    /// that of one of all choices is beyond this (Bonferroni).
    fn seen(&self) -> f64 {
        let teeth = self.cuts.first().map_or(1, |c| c.scene.tool.teeth);
        let choices = (self.cuts.len().max(1) - 1) as f64 * (teeth as f64).ln();
        (SEEN * SEEN + 2.0 * choices).sqrt()
    }

    pub(super) fn nuisance(&self) -> Vec<Identified> {
        let mut all = Vec::new();
        if let Some(j) = self.layout.of_cut.iter().find_map(|c| c[BANDWIDTH]) {
            let hz = self.p[j].exp();
            all.push(Identified::new(
                "bandwidth",
                "sensor",
                hz,
                "Hz",
                hz * self.stderr(j),
                "corner of the dynamometer's second-order low pass",
            ));
        }
        for (i, places) in self.layout.of_cut.iter().enumerate() {
            let site = format!("cut{}", i + 1);
            let one = |kind: usize, name: &str, factor: f64, unit: &str, meaning: &str| {
                let j = places[kind]?;
                let (value, stderr) = (factor * self.p[j], factor * self.stderr(j));
                Some(Identified::new(name, &site, value, unit, stderr, meaning))
            };
            let rpm = 60.0 / TAU * self.cuts[i].scene.cut.spindle_rad_s;
            all.extend(self.tooth_angle(i, &site));
            all.extend(one(
                SPEED,
                "speed_error",
                rpm,
                "rpm",
                "spindle speed less the stated one",
            ));
            all.extend(one(WIDTH, "width", 1e3, "mm", "width of cut"));
        }
        all
    }

    /// Where tooth 1 stands at the first sample that the file has of a cut.
    fn tooth_angle(&self, cut: usize, site: &str) -> Option<Identified> {
        let (places, data) = (&self.layout.of_cut[cut], &self.cuts[cut]);
        let (phase, speed) = (places[PHASE]?, places[SPEED]?);
        let since = data.scene.cut.spindle_rad_s * data.begins_s;
        let c = self.covariance;
        let variance =
            c[(phase, phase)] - 2.0 * since * c[(phase, speed)] + since * since * c[(speed, speed)];
        let angle = wrapped(at_begin(data, &self.layout.of_one(cut, self.p)));
        let stderr = variance.max(0.0).sqrt();
        let found = Identified::new(
            "tooth_angle",
            site,
            angle / DEGREE,
            "deg",
            stderr / DEGREE,
            "angle φ of tooth 1 at the first sample",
        );
        Some(match stderr < FIXED_ANGLE {
            true => found,
            false => found.without_value(Status::NotIdentifiable),
        })
    }
}
