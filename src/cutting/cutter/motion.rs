//! The tool along its way: what it meets there, and what it leaves behind.

use super::Cutter;
use crate::cutting::dexel::Solid;
use crate::cutting::dexel::engagement::APART;
use crate::cutting::dexel::frame::Frame;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{V3, add, norm, scale, sub, unit};
use crate::ground::stats::mean;

/// The latest way, as a share of the radius, that is known as places instead of being taken from the
/// rays: its end lies two spacings within the front.
const LATEST: f64 = 0.6;

impl Cutter {
    /// Moves the tool to `tip` with its axis along `axis`, in a straight line from where it was, takes
    /// what it meets, and looks what it stands in there: beside a wall as far as half of the chip lies in it that
    /// this motion takes, the passing of one tooth.
    ///
    /// # Errors
    /// Material above the flutes.
    pub fn advance(&mut self, tip: V3, axis: V3) -> Outcome<()> {
        if self.place.is_none() {
            self.mark = tip;
        }
        let (from, _) = self.place.unwrap_or((tip, axis));
        self.place = Some((tip, axis));
        let way = sub(tip, from);
        if turned_from(axis, self.engagement.frame.z) {
            self.engagement.frame = Frame::towards(self.forward, axis);
        }
        let axis = self.engagement.frame.z;
        // in the middle of the way the engagement is its mean, to second order
        let middle = add(from, scale(0.5, way));
        let curved = self.curved(middle, way);
        self.engagement.look(&self.stock, middle, way, &curved);
        let [swept, by_the_end] = self.engagement.swept(way);
        self.removed += swept;
        self.drilled += by_the_end;
        self.leave(from, tip, axis);
        self.check_flutes()
    }

    /// Puts the tool somewhere else without cutting on the way.
    pub fn jump(&mut self, tip: V3, axis: V3) {
        self.settle();
        if self.place.is_none() {
            self.stood_in = self.standing_in(tip, axis);
        }
        self.place = Some((tip, axis));
        self.mark = tip;
    }

    /// Volume of stock where the tool stands at a place, m³.
    fn standing_in(&self, tip: V3, axis: V3) -> f64 {
        if !self.near(tip, axis, 0.0) {
            return 0.0;
        }
        let mut without = self.stock.clone();
        without.remove(&self.solid(tip, axis));
        let [before, after] = [&self.stock, &without].map(|stock| mean(&stock.volumes()));
        before - after
    }

    /// Latest places that a straight motion does not leave behind by itself.
    fn curved(&self, tip: V3, way: V3) -> Vec<Solid> {
        const ALIGNED: f64 = 1e-10;
        let ahead = unit(way);
        let aside = |solid: &&Solid| {
            let from = unit(sub(tip, solid.tip));
            let turned = turned_from(solid.axis, self.engagement.frame.z);
            match (ahead, from) {
                (Some(a), Some(f)) => turned || norm(sub(a, f)) > ALIGNED.sqrt(),
                _ => turned,
            }
        };
        self.latest.iter().filter(aside).copied().collect()
    }

    /// Notes the places between two and takes the old ones from the stock.
    fn leave(&mut self, from: V3, tip: V3, axis: V3) {
        let way = sub(tip, self.mark);
        let count = (norm(way) / (APART * self.fineness.spacing_m)) as usize;
        let first = usize::from(self.latest.is_empty() && from == tip);
        let mark = self.mark;
        for i in 1..=count.max(first) {
            let place = add(mark, scale(i as f64 / count.max(1) as f64, way));
            if self.near(place, axis, 0.0) {
                let solid = self.solid(place, axis);
                self.latest.push_back(solid);
            }
            self.mark = place;
        }
        let keep = LATEST * self.tool.radius_m;
        while let Some(oldest) = self.latest.front().copied() {
            if norm(sub(tip, oldest.tip)) < keep && self.latest.len() < 1000 {
                break;
            }
            self.stock.remove(&oldest);
            self.latest.pop_front();
        }
    }

    /// Takes all that is still noted as latest way.
    pub fn settle(&mut self) {
        for solid in std::mem::take(&mut self.latest) {
            self.stock.remove(&solid);
        }
    }

    fn check_flutes(&self) -> Outcome<()> {
        let rings = self.engagement.rings();
        let all = rings.len() == self.engagement.all_rings().len();
        if !all || self.engagement.depth_m() < self.tool.flute_m * (1.0 - 1e-9) {
            return Ok(());
        }
        Err(Problem::new(
            format!(
                "the tool cuts deeper than its flutes, {:.1} mm",
                1e3 * self.tool.flute_m
            ),
            "cut in several depths, or give a longer `flute_mm`",
        ))
    }
}

/// Whether an axis differs from another by more than rounding.
fn turned_from(axis: V3, other: V3) -> bool {
    norm(sub(axis, other)) > 1e-9
}
