//! The whole way: from a kind's statement to its answer.

use super::arrival::arrived;
use super::bank::{Bank, Fit};
use super::beside_rest::less_doubtful;
use super::blamed::blamed as causes;
use super::choice::{material, nothing};
use super::judgement::Judgement;
use super::leaves::{Leaves, Weighing};
use super::picked::{Picked, carrying, picked};
use super::posterior::Posterior;
use super::rest::{Span, explained};
use super::rounds;
use super::search::{Scored, search};
use super::statement::{Blamed, Experiment, Statement};
use super::told::{answer, scattering};
use super::verdict::name;
use crate::findings::answer::{Answer, Verdict};

/// A finished diagnosis.
#[derive(Debug, Clone)]
pub struct Found {
    /// The answer.
    pub answer: Answer,
    /// The chosen causes with their amounts.
    pub blamed: Vec<Blamed>,
    /// Those of the best set that what is left makes doubtful: they are not named, and what else is told stands beside them.
    pub doubted: Vec<Blamed>,
    /// What the present simulation misses, with the nuisances at their most probable: per row.
    pub missed: Vec<f64>,
    /// What the named causes make of it, per row.
    pub explained: Vec<f64>,
    /// What they leave, per row.
    pub left: Vec<f64>,
    /// Whether what is left is scatter alone.
    pub(super) scatters: bool,
    /// Most probable amounts of the nuisances beside the causes.
    pub(super) uncertain: Vec<f64>,
    /// Nats that these cost by what is known of them.
    pub(super) strain: f64,
    /// The best set of causes whether or not they are named: what a kind that is not linear is stated about.
    pub(super) lead: Vec<Blamed>,
    /// The best set of causes with what is uncertain beside them, where a pattern beat a part of them.
    pub(super) wider: Option<(Vec<Blamed>, Vec<f64>)>,
    /// Evidence of every set that was compared, over that of no cause, no prior in it: (effect and site of
    /// each cause, ln E).
    pub evidence: Vec<(Names, f64)>,
    /// ln E of no cause, what is uncertain being paid for: what evidence of several statements is compared by.
    pub(super) nothing: f64,
}

/// Effects with their sites.
pub(super) type Names = Vec<(&'static str, String)>;

/// Nats by which sets of a statement are worth more than its straight lines say, or less.
pub(super) type Raised = [(Names, f64)];

/// Diagnoses.
pub fn diagnose(experiment: &dyn Experiment, judgement: &Judgement) -> Found {
    let first = stated(experiment, &[], &[]);
    let found = about(experiment, (&first, &first.reading), &[], judgement);
    let found = match experiment.is_linear() || found.lead.is_empty() {
        true => found,
        false => rounds::settled(experiment, (first, found), judgement),
    };
    arrived(experiment, less_doubtful(experiment, found, judgement))
}

/// The statement without suspects that change nothing here: they have no column to be compared by.
pub(super) fn stated(
    experiment: &dyn Experiment,
    blamed: &[Blamed],
    uncertain: &[f64],
) -> Statement {
    shown(experiment.state_beside(blamed, uncertain))
}

/// A statement without suspects that change nothing.
pub(super) fn shown(mut statement: Statement) -> Statement {
    for suspect in &mut statement.suspects {
        suspect.members.retain(|m| !m.columns.is_empty());
    }
    statement.suspects.retain(|s| !s.members.is_empty());
    statement
}

/// The answer of one statement; `present`: the reading of the first one, about nothing.
pub(super) fn about(
    experiment: &dyn Experiment,
    (statement, present): (&Statement, &[f64]),
    raised: &Raised,
    judgement: &Judgement,
) -> Found {
    let mut bank = Bank::new(statement);
    let mut compared = search(&mut bank, judgement);
    raise(&bank, &mut compared, raised);
    let named = |s: &&Scored| s.suspects.iter().all(|s| bank.suspects[*s].named);
    let evidence = compared
        .iter()
        .filter(named)
        .map(|s| evidence_of(&bank, s, judgement))
        .collect();
    let story = compared.first().cloned();
    let sets = material(statement, &bank, compared, judgement);
    let rough = experiment.has_rough_laws();
    let nats = sets.first().filter(|_| rough).map(|s| worth(&bank, &s.fit));
    let mut posterior = Posterior::of(sets, judgement.exponent(nats));
    let span = Span::of(statement);
    let nothing = nothing(&posterior).fit;
    let base = nothing.posterior.ln_evidence - bank.room();
    let weighing = Weighing::new(statement, &bank, span.as_ref(), &nothing, judgement);
    let picked = picked(experiment, &weighing, &mut posterior, story.as_ref());
    // where laws are only nearly right the spring itself is fitted, not stated: its gains are those that decided
    let picked = match rough {
        true => picked,
        false => carrying(&weighing, &posterior, present, picked),
    };
    let Picked { set, leaves, gains } = picked;
    let Leaves {
        left,
        mut uncertain,
        strain,
        seen,
        rest,
    } = leaves;
    let mut blamed = causes(&bank, &set.fit);
    let named = name(
        experiment,
        &bank,
        &posterior,
        &set,
        (&blamed, &gains),
        judgement,
    );
    let mut answer = answer(
        experiment,
        statement,
        &bank,
        (&posterior, &set),
        (named, rest),
        (&weighing.missed, &left),
        judgement,
    );
    if let Some(seen) = seen.map(Into::into).or(rest.scatter.map(scattering)) {
        answer.unexplained.description = seen;
    }
    let mut own = set.suspects.iter().map(|s| bank.suspects[*s].named);
    blamed.retain(|_| own.next().unwrap_or(true));
    let competed = bank.suspects.iter().any(|s| !s.named);
    let open = competed && answer.verdict != Verdict::Sufficient;
    let leading = leading(&bank, &posterior).filter(|_| open);
    let in_front = leading.map(|fit| (causes(&bank, &fit), weighing.beside(&fit).1));
    let has_pattern = set.suspects.iter().any(|s| !bank.suspects[*s].named);
    let (mut lead, mut wider) = (blamed.clone(), None);
    match in_front {
        Some(first) if blamed.is_empty() => (lead, uncertain) = first,
        Some(more) if has_pattern && more.0.len() > blamed.len() => wider = Some(more),
        _ => {}
    }
    let missed = weighing.missed;
    let explained = missed.iter().zip(&left).map(|(m, l)| m - l).collect();
    Found {
        answer,
        blamed,
        doubted: Vec::new(),
        missed,
        explained,
        left,
        scatters: rest.scatter.is_some(),
        uncertain,
        strain,
        lead,
        wider,
        evidence,
        nothing: base,
    }
}

/// Sets with what they are worth more, best first again.
fn raise(bank: &Bank, compared: &mut [Scored], raised: &Raised) {
    if raised.is_empty() {
        return;
    }
    for set in compared.iter_mut() {
        let own = places(bank, set);
        let more = raised.iter().find(|(names, _)| *names == own);
        set.score += more.map_or(0.0, |(_, by)| *by);
    }
    compared.sort_by(|a, b| b.score.total_cmp(&a.score));
}

fn places(bank: &Bank, set: &Scored) -> Names {
    let own = set.suspects.iter().map(|s| &bank.suspects[*s]);
    own.map(|s| (s.effect, s.site.clone())).collect()
}

/// The best set of causes of the library.
fn leading(bank: &Bank, posterior: &Posterior) -> Option<Fit> {
    let named = |s: &&(Scored, f64)| s.0.suspects.iter().all(|s| bank.suspects[*s].named);
    posterior.sets.iter().find(named).map(|s| s.0.fit.clone())
}

/// Nats that all a set explains is worth beside the noise that it leaves.
fn worth(bank: &Bank, fit: &Fit) -> f64 {
    let rows = bank.whitened().len() as f64;
    0.5 * rows * explained(bank, fit).powi(2) / fit.posterior.noise_variance
}

fn evidence_of(bank: &Bank, set: &Scored, judgement: &Judgement) -> (Names, f64) {
    // the shapes' and the amounts' prices belong to the evidence; the odds of names do not
    let names = set.suspects.len() as f64;
    let shares: f64 = set.suspects.iter().map(|s| bank.suspects[*s].share).sum();
    let odds = judgement.name * names + judgement.companion * (names - 1.0).max(0.0) - shares;
    (places(bank, set), set.score + odds)
}
