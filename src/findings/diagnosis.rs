//! The diagnosis of one load-cycle file.

use super::adequacy::{self, Adequacy};
use super::ambiguity::{Posterior, temper};
use super::refine::{Refined, refine};
use super::search::search;
use crate::effects::{EFFECTS, Effect};
use crate::fit::candidates::Candidates;
use crate::fit::least_squares::Problem;
use crate::fit::normal::Normal;
use crate::fit::observation::Observation;
use crate::fit::screen::{Screen, screen};
use crate::measurement::load_cycle::LoadCycle;

/// The verdict on a simulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The simulation is right to within the noise.
    Sufficient,
    /// Causes found, nothing left.
    Explained,
    /// Causes found, structure remains.
    PartlyExplained,
    /// Structure that nobody in the library explains.
    UnknownCause,
    /// The data cannot separate the candidates.
    CannotTell,
}

impl Verdict {
    /// As in the JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sufficient => "sufficient",
            Self::Explained => "explained",
            Self::PartlyExplained => "partly-explained",
            Self::UnknownCause => "unknown-cause",
            Self::CannotTell => "cannot-tell",
        }
    }
}

/// A named cause.
#[derive(Debug, Clone)]
pub struct Cause {
    /// Its name.
    pub effect: &'static str,
    /// Probability that it is present.
    pub probability: f64,
    /// Runners-up.
    pub alternatives: Vec<(&'static str, f64)>,
}

/// Causes that these data cannot tell apart.
#[derive(Debug, Clone)]
pub struct Group {
    /// The candidates.
    pub effects: Vec<&'static str>,
    /// What would tell.
    pub would_tell: String,
}

/// What a diagnosis found.
pub struct Diagnosis {
    /// The verdict.
    pub verdict: Verdict,
    /// Named causes.
    pub causes: Vec<Cause>,
    /// Groups that cannot be separated.
    pub groups: Vec<Group>,
    /// Is anything left?
    pub adequacy: Adequacy,
    /// The chosen model.
    pub best: Option<Refined>,
}

/// How to diagnose.
#[derive(Clone)]
pub struct Settings {
    /// Effects to consider.
    pub library: Vec<&'static dyn Effect>,
    /// Rows beyond which neighbours are averaged.
    pub rows: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            library: EFFECTS.to_vec(),
            rows: 2000,
        }
    }
}

/// A stand-in with at least this share of the winner's probability cannot be ruled out.
const AMBIGUOUS: f64 = 0.05;
/// Structure counts as left when a test is below this p-value ...
const SIGNIFICANT: f64 = 1e-4;
/// ... and the unexplained share exceeds this.
const MATTERS: f64 = 0.1;

/// Diagnoses one file.
pub fn diagnose(file: &LoadCycle, settings: &Settings) -> Diagnosis {
    let data = Observation::of(file, settings.rows);
    let debug = std::env::var("IDENT_DEBUG").is_ok();
    let t0 = std::time::Instant::now();
    let candidates = Candidates::new(&settings.library, &data);
    let t1 = t0.elapsed();
    let screen = screen(&data, &candidates);
    let t2 = t0.elapsed();
    let normal = Normal::new(&candidates, &screen.colour);
    let found = search(&candidates, &normal, 14);
    let t3 = t0.elapsed();
    let rows = data.rows();
    let ceiling = 0.5 * (normal.base - screen.saturated).max(0.0);
    let tempering = temper(ceiling);
    let refined: Vec<Refined> = found
        .iter()
        .map(|f| refine(f, &candidates, &data, &screen.colour, normal.base, 12))
        .collect();
    let t4 = t0.elapsed();
    let posterior = Posterior::new(&refined, rows, tempering);
    if debug {
        eprintln!(
            "atoms {} rows {} | dict {:?} screen {:?} search {:?} refine {:?} ({} sets)",
            candidates.atoms.len(),
            rows,
            t1,
            t2 - t1,
            t3 - t2,
            t4 - t3,
            refined.len()
        );
        eprintln!(
            "colour {} rms {:.3e} base {:.1} sat {:.1} dim {} temper {:.4}",
            screen.colour.describe(),
            screen.colour.rms,
            normal.base,
            screen.saturated,
            screen.dimension,
            tempering
        );
        for (causes, p, i) in posterior.sets.iter().take(8) {
            let n = i.map_or(0.0, |i| refined[i].nats);
            eprintln!(
                "  {:.4} {:?} nats {:.1} p {:?}",
                p,
                causes,
                n,
                i.map(|i| &refined[i].optimum.p)
            );
        }
    }
    conclude(&posterior, &refined, &screen, &data, normal.base)
}

fn conclude(
    posterior: &Posterior,
    refined: &[Refined],
    screen: &Screen,
    data: &Observation,
    base: f64,
) -> Diagnosis {
    let best = posterior.sets[0].2.map(|i| refined[i].clone());
    let residual = match &best {
        Some(best) => residual_of(best, data, screen),
        None => base_residual(data, screen),
    };
    let dimension = best.as_ref().map_or(1, |b| b.dimension + 1);
    let adequacy = adequacy::judge(&residual, dimension, base, screen, data);
    let left = adequacy.p_value < SIGNIFICANT && adequacy.unexplained > MATTERS;
    let (causes, groups) = name_causes(posterior);
    let verdict = match (causes.is_empty(), groups.is_empty(), left) {
        (true, true, true) => Verdict::UnknownCause,
        (true, true, false) => Verdict::Sufficient,
        (_, _, true) if adequacy.unexplained > 0.35 => Verdict::UnknownCause,
        (_, _, true) => Verdict::PartlyExplained,
        (_, false, false) => Verdict::CannotTell,
        (_, true, false) => Verdict::Explained,
    };
    Diagnosis {
        verdict,
        causes,
        groups,
        adequacy,
        best,
    }
}

fn name_causes(posterior: &Posterior) -> (Vec<Cause>, Vec<Group>) {
    let mut causes = Vec::new();
    let mut groups = Vec::new();
    for cause in &posterior.sets[0].0 {
        let alternatives = posterior.stand_ins(cause, AMBIGUOUS);
        if alternatives.is_empty() {
            let probability = posterior.inclusion(cause);
            causes.push(Cause {
                effect: cause,
                probability,
                alternatives: posterior.stand_ins(cause, 1e-4),
            });
        } else {
            let mut effects = vec![*cause];
            effects.extend(alternatives.iter().map(|a| a.0));
            groups.push(Group {
                effects,
                would_tell: String::new(),
            });
        }
    }
    (causes, groups)
}

fn residual_of(best: &Refined, data: &Observation, screen: &Screen) -> Vec<f64> {
    let ignored = vec![false; data.rows()];
    Problem {
        model: &best.model,
        data,
        colour: &screen.colour,
        ignored: &ignored,
    }
    .residual(&best.optimum.p)
}

fn base_residual(data: &Observation, screen: &Screen) -> Vec<f64> {
    let model = crate::effects::Composite::new(&[]);
    let start = [data.scene.load_scale / data.scene.deflection_scale];
    let fit = super::refine::refine_from(model, &start, data, &screen.colour, 0.0, 12);
    residual_of(&fit, data, screen)
}
