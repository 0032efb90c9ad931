//! From what was compared to what is said.

use super::adequacy::Adequacy;
use super::data::{Data, Grid};
use super::diagnosis::{Diagnosis, UNIT};
use super::hanging::hanging;
use super::linearity::{Linearity, linearity};
use super::map::{Fit, fit, ln_odds, singular};
use super::point::Point;
use super::prediction::Machine;
use super::search::Found;
use super::set::{Set, sets};
use super::strayed::strayed;
use super::suspect::Suspect;
use super::{discrepancy, doubled, extended};
use crate::experiments::hammer_frf::{HammerFrf, Settings};
use crate::findings::answer::{Answer, Discrepancy, Structure, Verdict};
use crate::findings::belief::Belief;
use crate::findings::engine::judgement::Judgement;
use crate::findings::engine::posterior::{Posterior, Weighed};
use crate::findings::engine::rest::Rest;
use crate::findings::engine::verdict::{Named, verdict};
use crate::ground::problem::Outcome;
use crate::measurement::hammer::HammerRecord;

/// A law may miss nature by this share of its size; such a misfit is worth these nats at most.
const FORMULA_ERROR: f64 = 0.05;
const TOLERATED_NATS: f64 = 5.0;
/// Folds of hits for the gain.
const FOLDS: usize = 2;
/// A cause alone is named as well where no more of the error's variance is left above the noise than this share of what is
/// left without it: drift below the lowest mode weighs much and is little. A tenth of the variance that [`judgement`](super::diagnosis::judgement)
/// leaves open.
const LITTLE: f64 = 0.005;

/// Steps of the fit of a set without what has no name.
const STEPS: usize = 8;

/// The chosen set.
struct Told {
    /// As it was chosen.
    whole: Fit,
    /// With what has a name alone.
    named: Fit,
    /// What would hang at the tool in the place of a cause, in words.
    rival: Option<String>,
}

/// Everything that the steps of a diagnosis share.
pub(super) struct Case<'a> {
    pub(super) machine: Machine<'a>,
    pub(super) suspects: Vec<Suspect>,
    pub(super) frf: HammerFrf,
    pub(super) sharp: Data,
    pub(super) grid: Grid,
    pub(super) settings: Settings,
    pub(super) judgement: Judgement,
}

impl Case<'_> {
    /// Names what is found and judges what is left.
    pub(super) fn conclude(self, found: &Found, record: &HammerRecord) -> Outcome<Diagnosis> {
        let (sets, nothing) = self.weighed(found)?;
        let posterior = Posterior::of(sets, self.judgement.temper);
        let best = posterior.sets.first().map_or(&nothing, |s| &s.0);
        let (chosen, mut named) = self.name(&posterior, best)?;
        let rival = self.hung_rival(&posterior, &chosen);
        let chosen = self.told(chosen.fit, rival)?;
        let double = doubled::cause(
            &self.machine,
            record,
            &self.settings,
            self.grid,
            &self.frf,
            &chosen.whole,
        );
        named.causes.extend(double);
        let adequacy = Adequacy::of(&self.sharp, &chosen.named.residual);
        let level = linearity(&self.frf, self.grid);
        self.answer(&posterior, &chosen, named, &adequacy, level)
    }

    /// The posterior with the instruments summed out.
    fn belief(&self, posterior: &Posterior<Set>) -> Belief {
        let sees = self.suspects.iter();
        let sees = sees.filter(|s| s.is_physical() && s.is_named());
        let weighed = posterior.sets.iter().map(|(set, p)| {
            let mut robot = self.machine.robot.clone();
            let each = set.fit.point.each().into_iter();
            let physical = each.filter(|(suspect, _)| suspect.is_physical() && suspect.is_named());
            let causes = physical.map(|(suspect, amounts)| {
                suspect.cause.alter(&mut robot, &suspect.site, &amounts);
                suspect.place()
            });
            let causes: Vec<_> = causes.collect();
            let odds = ln_odds(causes.len());
            (causes, *p, odds, robot)
        });
        Belief::new(sees.map(Suspect::place).collect(), weighed)
    }

    /// The sets that were compared, and the empty one.
    fn weighed(&self, found: &Found) -> Outcome<(Vec<Set>, Set)> {
        let temper = self.temper(found);
        let nothing = match found.fits.iter().find(|f| f.point.set.is_empty()) {
            Some(fit) => fit.clone(),
            None => fit(&self.machine, &self.sharp, Point::nothing(), 10)?,
        };
        let nothing = Set::of(nothing, &self.suspects, temper).ok_or_else(singular)?;
        Ok((sets(&found.fits, &self.suspects, temper), nothing))
    }

    /// A misfit larger than the noise of even the best set makes all of them less sure, and so does
    /// the size of what is explained: a law that misses nature by a few percent still counts as right.
    fn temper(&self, found: &Found) -> f64 {
        let least =
            |of: &dyn Fn(&Fit) -> f64| found.fits.iter().map(of).fold(f64::INFINITY, f64::min);
        let mean = least(&|f| 2.0 * f.misfit) / self.sharp.freedom();
        let nothing = found.fits.iter().find(|f| f.point.set.is_empty());
        let nats = nothing.map_or(0.0, |n| n.cost - least(&|f| f.cost));
        1.0 / mean.max(1.0) / (1.0 + FORMULA_ERROR.powi(2) * nats.max(0.0) / TOLERATED_NATS)
    }

    /// Hits to fit and hits to judge by; lines, where a direction was hit but once.
    pub(super) fn apart(&self) -> Vec<[Data; 2]> {
        let doubting = |both: [Data; 2]| both.map(|data| data.doubting(self.sharp.doubt));
        let hits = (0..FOLDS).map(|k| Data::fold(&self.frf, self.grid, k, FOLDS).map(doubting));
        let lines = || (0..FOLDS).map(|k| self.sharp.stretches(k, FOLDS));
        hits.collect::<Option<_>>()
            .unwrap_or_else(|| lines().collect())
    }

    fn answer(
        self,
        posterior: &Posterior<Set>,
        chosen: &Told,
        named: Named,
        adequacy: &Adequacy,
        level: Option<Linearity>,
    ) -> Outcome<Diagnosis> {
        let before = discrepancy::simulated(&self.machine, &self.sharp, &Point::nothing())?;
        let after = discrepancy::simulated(&self.machine, &self.sharp, &chosen.named.point)?;
        let (rms, place) = discrepancy::between(&self.sharp, &before);
        let (left_rms, _) = discrepancy::between(&self.sharp, &after);
        let noise = discrepancy::noise(&self.sharp);
        let share = ((left_rms.powi(2) - noise.powi(2)) / rms.powi(2)).clamp(0.0, 1.0);
        let bent = level.as_ref().filter(|level| level.broken());
        let spread = &self.machine.known.laboratory.instrument;
        let whole = &chosen.whole.point;
        let strayed = strayed(&whole.theta, spread).or_else(|| hanging(whole));
        let left = adequacy.left() || bent.is_some() || strayed.is_some();
        let explained = match strayed {
            Some(_) => 0.0,
            None => self.explained(posterior, &chosen.named, left_rms)?,
        };
        let rest = Rest {
            nats: -adequacy.p_value.max(f64::MIN_POSITIVE).ln(),
            share: (1.0 - explained).max(0.0).sqrt(),
            is_left: left,
            scatter: None,
        };
        let verdict = verdict(&named, &rest, &self.judgement);
        let description = match (bent, strayed, adequacy.left(), &chosen.rival) {
            (Some(level), ..) => level.description(),
            (None, Some(strayed), ..) => strayed,
            (None, None, true, _) => adequacy.description(),
            (None, None, false, Some(rival)) => {
                format!("nothing above the noise; but all of it may be {rival}")
            }
            (None, None, false, None) => "nothing above the noise".into(),
        };
        let unknown = verdict == Verdict::UnknownCause;
        let named = if unknown { Named::default() } else { named };
        let extended = extended::robot(&self.machine, &chosen.named, &named.causes);
        let candidates = posterior.sets.iter().take(8);
        let candidates = candidates.map(|(Set { fit, .. }, p)| {
            let names = fit.point.set.iter();
            let names = names.map(|s| format!("{} at {}", s.name(), s.site));
            (names.collect(), *p, self.nats(posterior, fit))
        });
        let answer = Answer {
            verdict,
            discrepancy: Discrepancy {
                rms,
                noise_rms: noise,
                place,
            },
            causes: named.causes,
            groups: named.groups,
            unexplained: Structure {
                share_of_variance: share,
                shape: discrepancy::spectrum(&self.sharp, &after),
                over_time: Vec::new(),
                description,
            },
            p_value: adequacy.p_value,
            candidates: candidates.collect(),
            unit: UNIT,
            noise: format!(
                "the scatter of {} hits, and {:.2} % of the accelerance, which a linear model of a robot misses",
                self.frf.screened.iter().filter(|h| h.used()).count(),
                100.0 * self.sharp.model_error()
            ),
            unstated: false,
            doubts: Vec::new(),
        };
        Ok(Diagnosis {
            belief: self.belief(posterior),
            answer,
            data: self.sharp,
            before,
            after,
            extended,
            frf: self.frf,
            level,
        })
    }

    /// What would hang at the tool if a cause of the set did not act, where the data cannot rule that out.
    fn hung_rival(&self, posterior: &Posterior<Set>, chosen: &Set) -> Option<String> {
        let outside = |s: &usize| !self.suspects[*s].is_named();
        let open = chosen
            .suspects()
            .iter()
            .flat_map(|at| posterior.stand_ins(chosen, *at));
        let (rival, _) = open
            .into_iter()
            .find(|(s, odds)| outside(s) && *odds > self.judgement.ambiguous)?;
        let mut sets = posterior.sets.iter().map(|s| &s.0);
        let set = sets.find(|set| set.suspects().contains(&rival))?;
        hanging(&set.fit.point)
    }

    /// What is told of a chosen fit: what has no name is left out, and the rest fitted anew.
    fn told(&self, whole: Fit, rival: Option<String>) -> Outcome<Told> {
        let is_named = whole.point.set.iter().all(Suspect::is_named);
        let named = match is_named {
            true => whole.clone(),
            false => {
                let point = whole.point.with_only(Suspect::is_named);
                fit(&self.machine, &self.sharp, point, STEPS)?
            }
        };
        Ok(Told {
            whole,
            named,
            rival,
        })
    }

    /// Share of the weighted misfit of the present simulation that the chosen cause takes away, all of it where nearly
    /// nothing is left (`left_rms`). While something is left several may imitate an unknown one together: they count as nothing.
    fn explained(&self, posterior: &Posterior<Set>, chosen: &Fit, left_rms: f64) -> Outcome<f64> {
        let (Some(nothing), 1) = (posterior.set(&[]), chosen.point.set.len()) else {
            return Ok(0.0);
        };
        let nothing = &nothing.fit;
        let without = discrepancy::simulated(&self.machine, &self.sharp, &nothing.point)?;
        let noise = discrepancy::noise(&self.sharp).powi(2);
        let above = |rms: f64| (rms.powi(2) - noise).max(0.0);
        let without = above(discrepancy::between(&self.sharp, &without).0);
        Ok(match above(left_rms) < LITTLE * without {
            true => 1.0,
            false => 1.0 - chosen.misfit / nothing.misfit.max(f64::MIN_POSITIVE),
        })
    }

    /// What a fit explains of what nothing explains.
    pub(super) fn nats(&self, posterior: &Posterior<Set>, fit: &Fit) -> f64 {
        let nothing = posterior.set(&[]);
        nothing.map_or(0.0, |nothing| nothing.fit.cost - fit.cost)
    }
}
