//! How well the size of a cause is known, where more than one law knows it: by how much these differ is then part of it.

use super::case::Case;
use super::refine::Refined;
use crate::effects::Effect;
use crate::fit::parameter::Z95;

/// Mean square, in noise deviations, that a law may leave: half a deviation beside the noise. Above it the law is not that of
/// the joint, and the error of its size is not known.
const LEFT: f64 = 1.25;

/// Causes whose size has an interval: those of which it was counted how often it holds the truth. A loop's size hangs on what the
/// law makes of its past.
const SIZED: [&str; 1] = ["backlash"];

impl Case<'_> {
    /// 95 % intervals of the size of a cause, by the name of the parameter: the hull of those of all laws that leave no more
    /// than the noise. None where only one law has such a parameter.
    pub(super) fn intervals(&self, chosen: &Refined, cause: &str) -> Vec<(&'static str, [f64; 2])> {
        if !SIZED.contains(&cause) {
            return Vec::new();
        }
        let laws = self.laws_of(cause);
        let names: Vec<&str> = laws.iter().map(|l| l.card().parameters[0].name).collect();
        if laws.len() < 2 || names.windows(2).any(|w| w[0] != w[1]) {
            return Vec::new();
        }
        let each = laws.iter().filter_map(|law| self.interval(chosen, *law));
        let hull = each.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        hull.map(|hull| (laws[0].card().parameters[0].name, hull))
            .into_iter()
            .collect()
    }

    /// The interval of the size of a law in place of that of its cause; `None` where it leaves more than the noise.
    fn interval(&self, chosen: &Refined, law: &'static dyn Effect) -> Option<[f64; 2]> {
        let others = chosen.model.effects()[1..].iter().copied();
        let own = others.filter(|e| e.card().cause != law.card().cause);
        let set: Vec<&'static dyn Effect> = own.chain([law]).collect();
        let fit = self.fitted(&set);
        let optimum = &fit.optimum;
        if optimum.chi2 > LEFT * self.data.rows() as f64 {
            return None;
        }
        let slots = fit.model.slots();
        let at = slots
            .iter()
            .position(|s| s.amplitude && s.effect.card().name == law.card().name)?;
        let free: Vec<usize> = (0..slots.len())
            .filter(|j| optimum.active[*j] == 0)
            .collect();
        let place = free.iter().position(|j| *j == at)?;
        let columns = optimum.jacobian.select_columns(&free);
        let covariance = columns.tr_mul(&columns).try_inverse()?;
        let half = Z95 * covariance[(place, place)].max(0.0).sqrt() * optimum.scale[at];
        half.is_finite()
            .then(|| [optimum.p[at] - half, optimum.p[at] + half])
    }
}
