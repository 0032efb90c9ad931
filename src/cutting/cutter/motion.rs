//! The tool along its way: what it meets there, and what it leaves behind.

use super::Cutter;
use crate::cutting::dexel::Solid;
use crate::cutting::dexel::engagement::APART;
use crate::cutting::dexel::frame::Frame;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{V3, add, dot, norm, scale, sub, unit};
use crate::ground::stats::mean;

/// The latest way, as a share of the radius, that is known as places instead of being taken from the
/// rays: its end lies two spacings within the front.
const LATEST: f64 = 0.6;

/// Cosine between two motions from which on they are one: 2.6 degrees, a choice; corners and tight blends turn more from tooth to tooth.
const STRAIGHT_ON: f64 = 0.999;

impl Cutter {
    /// Moves the tool as [`Cutter::advance`] does; it was told to go `from` one place (m, workpiece frame) `to` another meanwhile. Where the cut is
    /// resolved less finely, what it stands in is looked at anew only as often as that: by what it was told, so that two runs of
    /// one way look at the same places.
    ///
    /// # Errors
    /// Material above the flutes.
    pub fn follow(&mut self, [from, to]: [V3; 2], tip: V3, axis: V3) -> Outcome<()> {
        let (patience, ahead) = (self.fineness.patience_m, unit(sub(to, from)));
        let goes_on = |before: &Option<V3>| match (ahead, before) {
            (Some(a), Some(b)) => dot(a, *b) > STRAIGHT_ON,
            _ => false,
        };
        let known = self.looked.as_ref();
        let is_known = known.is_some_and(|(at, way)| norm(sub(to, *at)) < patience && goes_on(way));
        let turns = turned_from(axis, self.engagement.frame.z);
        if is_known && !turns {
            let (before, _) = self.place.unwrap_or((tip, axis));
            self.place = Some((tip, axis));
            self.unbooked = add(self.unbooked, sub(tip, before));
            self.leave(before, tip, axis);
            return Ok(());
        }
        self.looked = Some((to, ahead));
        // an axis that turns is looked at every time, in the middle of its way
        let stretch = if turns { 0.0 } else { patience };
        let further = 0.5 * (stretch - norm(sub(to, from))).max(0.0);
        self.look_and_take(tip, axis, scale(further, ahead.unwrap_or_default()))
    }

    /// Moves the tool to `tip` with its axis along `axis`, in a straight line from where it was, takes
    /// what it meets, and looks what it stands in there: beside a wall as far as half of the chip lies in it that
    /// this motion takes, the passing of one tooth.
    ///
    /// # Errors
    /// Material above the flutes.
    pub fn advance(&mut self, tip: V3, axis: V3) -> Outcome<()> {
        self.look_and_take(tip, axis, [0.0; 3])
    }

    /// The same, looking `further` (m) than the middle of the way.
    fn look_and_take(&mut self, tip: V3, axis: V3, further: V3) -> Outcome<()> {
        self.book();
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
        let middle = add(add(from, scale(0.5, way)), further);
        let curved = self.curved(middle, way);
        self.engagement.look(&self.stock, middle, way, &curved);
        self.unbooked = way;
        self.book();
        self.leave(from, tip, axis);
        self.check_flutes()
    }

    /// Books what was taken since it was looked last.
    fn book(&mut self) {
        let way = std::mem::take(&mut self.unbooked);
        if way != [0.0; 3] {
            let [swept, by_the_end] = self.engagement.swept(way);
            self.removed += swept;
            self.drilled += by_the_end;
        }
    }

    /// Puts the tool somewhere else without cutting on the way.
    pub fn jump(&mut self, tip: V3, axis: V3) {
        self.settle();
        if self.place.is_none() {
            self.stood_in = self.standing_in(tip, axis);
        }
        self.place = Some((tip, axis));
        self.looked = None;
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
        self.book();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutting::cutter::Fineness;
    use crate::cutting::dexel::Stock;
    use crate::cutting::law::Material;
    use crate::cutting::tool::Tool;

    const MM: f64 = 1e-3;
    const UP: V3 = [0.0, 0.0, 1.0];

    /// Force times way, N·m, and volume of a cut along a wall, into a corner and out of it.
    fn milled(patience_m: f64) -> (V3, f64) {
        let tool = Tool::square(8.0 * MM, 3, 0.5);
        let low = [0.0, -20.0 * MM, -10.0 * MM];
        let stock = Stock::block(low, [60.0 * MM, 3.0 * MM, 0.0], 0.6 * MM).unwrap();
        let fineness = Fineness {
            spacing_m: 0.6 * MM,
            patience_m,
            ..Fineness::usual(&tool)
        };
        let material = Material::linear_edge([1319.41, 788.83, 48.75, 19.65, 26.77, 2.05]);
        let mut cutter = Cutter::new(&tool, &material, stock, fineness, UP);
        let corners = [[-9.0, 0.0], [30.0, 0.0], [30.0, -33.0]].map(|[x, y]| [x * MM, y * MM, -MM]);
        cutter.jump(corners[0], UP);
        let (mut sum, step) = ([0.0; 3], 0.05 * MM);
        for ends in corners.windows(2) {
            let way = sub(ends[1], ends[0]);
            let count = (norm(way) / step).round() as usize;
            let at = |i: usize| add(ends[0], scale(i as f64 / count as f64, way));
            for i in 0..count {
                cutter.follow([at(i), at(i + 1)], at(i + 1), UP).unwrap();
                let load = cutter.mean_load(scale(1.0 / count as f64, way));
                sum = add(sum, scale(step, load.force));
            }
        }
        cutter.settle();
        (sum, cutter.removed())
    }

    /// A tool that is looked at only every third passing of a tooth meets and takes the same but for a few thousandths.
    #[test]
    fn what_is_looked_at_less_often_is_met_alike() {
        let (every, third) = (milled(0.0), milled(0.15 * MM));
        let off = norm(sub(third.0, every.0)) / norm(every.0);
        assert!(every.0 != third.0 && off < 3e-3, "{off}");
        assert!(
            (third.1 / every.1 - 1.0).abs() < 3e-3,
            "{} {}",
            third.1,
            every.1
        );
    }
}
