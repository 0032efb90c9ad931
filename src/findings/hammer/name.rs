//! Causes, and what cannot be told apart, as they are named.

use super::case::Case;
use super::map::{Fit, fit};
use super::next::would_tell;
use super::set::{Set, place};
use super::suspect::Suspect;
use super::unseen::{folds, gain, without};
use crate::findings::answer::Cause;
use crate::findings::engine::posterior::{self, Posterior, Weighed};
use crate::findings::engine::rivals::{Rivals, runners_up};
use crate::findings::engine::verdict::Named;
use crate::findings::gain::Gain;
use crate::ground::problem::Outcome;

/// Steps of the fit of a set that was not compared.
const STEPS: usize = 8;

impl Case<'_> {
    /// Names the causes of `best`, one after the other dropping those without a gain or as well absent.
    pub(super) fn name(&self, posterior: &Posterior<Set>, best: &Set) -> Outcome<(Set, Named)> {
        let mut chosen = best.clone();
        loop {
            let folds = folds(&self.machine, self.apart(), &chosen.fit);
            let causes = self.causes(&chosen);
            let own = |(_, suspect, _): &Own| gain(&self.machine, &folds, suspect);
            let gains: Vec<Gain> = causes.iter().map(own).collect();
            let least = self.judgement.companion_needed;
            let needed = |at: usize| posterior.inclusion_of_place(&chosen, at) > least;
            let mut both = gains.iter().zip(&causes);
            let useless = both.position(|(g, own)| !(g.is_real() && needed(own.0)));
            let useless = match useless {
                None => self.small_beside_kin(posterior, &chosen, &causes)?,
                useless => useless,
            };
            let Some(useless) = useless else {
                let mut named = Named::default();
                let told = causes.into_iter().zip(gains);
                for (own, gain) in told.filter(|(own, _)| own.1.is_named()) {
                    self.sort_in(posterior, &chosen, own, gain, &mut named);
                }
                return Ok((chosen, named.sorted()));
            };
            let dropped = causes[useless].clone();
            chosen = self.less(posterior, &chosen, dropped)?;
        }
    }

    /// The cause, by its place in the set, that explains little beside another of its name: a link bends all along, and its mass lies
    /// before the bend and behind, of which one place tells the most, and another link the rest.
    fn small_beside_kin(
        &self,
        posterior: &Posterior<Set>,
        chosen: &Set,
        causes: &[Own],
    ) -> Outcome<Option<usize>> {
        let whole = self.nats(posterior, &chosen.fit);
        let bends = |(_, own): &(usize, &Own)| own.1.cause.behind().is_some();
        for (at, own) in causes.iter().enumerate().filter(bends) {
            let is_kin = |(i, other): (usize, &Own)| i != at && other.1.name() == own.1.name();
            if !causes.iter().enumerate().any(is_kin) {
                continue;
            }
            let rest = self.less(posterior, chosen, own.clone())?;
            let own = whole - self.nats(posterior, &rest.fit);
            if own < self.judgement.share_beside_kin.powi(2) * whole {
                return Ok(Some(at));
            }
        }
        Ok(None)
    }

    /// The causes of a set by their place among all suspects, with their amounts.
    fn causes(&self, set: &Set) -> Vec<Own> {
        let each = set.fit.point.each().into_iter();
        let own = |(suspect, amounts): (&Suspect, Vec<f64>)| {
            Some((place(&self.suspects, suspect)?, suspect.clone(), amounts))
        };
        each.filter_map(own).collect()
    }

    /// The set less one cause, as it was compared, or fitted anew.
    fn less(&self, posterior: &Posterior<Set>, chosen: &Set, (at, own, _): Own) -> Outcome<Set> {
        let others = posterior::without(chosen.suspects(), at);
        if let Some(known) = posterior.set(&others) {
            return Ok(known.clone());
        }
        let point = without(&chosen.fit.point, &own);
        let fit = fit(&self.machine, &self.sharp, point, STEPS)?;
        Ok(chosen.refitted(others, fit))
    }

    fn sort_in(
        &self,
        posterior: &Posterior<Set>,
        chosen: &Set,
        (at, suspect, amounts): Own,
        gain: Gain,
        named: &mut Named,
    ) {
        let named_ones = |s: usize| self.suspects[s].is_named();
        let rivals = Rivals::of(posterior, chosen, at, named_ones, &self.judgement);
        let probability = posterior.inclusion(at).min(self.judgement.certain);
        let probability = probability.min(gain.probability());
        if let Some(rival) = rivals.open.first() {
            let members = std::iter::once(&at).chain(&rivals.open);
            let places = members.map(|s| self.suspects[*s].place()).collect();
            let would_tell = self.would_tell(posterior, &chosen.fit, [at, *rival]);
            named.group((places, probability), would_tell, gain);
            return;
        }
        let others = runners_up(posterior, chosen, at, named_ones).into_iter();
        let others = others.map(|(s, p)| {
            let (effect, site) = self.suspects[s].place();
            (effect, site, p)
        });
        let (card, robot) = (suspect.cause.card(), self.machine.robot);
        named.causes.push(Cause {
            effect: card.name,
            probability,
            summary: card.summary,
            alternatives: others.collect(),
            ci95: Vec::new(),
            parameters: suspect.cause.said(robot, &suspect.site, &amounts),
            site: suspect.site,
            gain,
        });
    }

    /// What would tell a cause from one that can take its place.
    fn would_tell(
        &self,
        posterior: &Posterior<Set>,
        chosen: &Fit,
        [own, rival]: [usize; 2],
    ) -> String {
        let holds = |set: &Set| set.suspects().contains(&rival) && !set.suspects().contains(&own);
        let mut sets = posterior.sets.iter().map(|s| &s.0);
        let other = sets.find(|set| holds(set)).map_or(chosen, |set| &set.fit);
        would_tell(&self.machine, &self.sharp, chosen, other)
    }
}

/// A cause by its place among all suspects, with its amounts, SI.
type Own = (usize, Suspect, Vec<f64>);
