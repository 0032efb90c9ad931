//! Two sets of fits beside each other: what changed by more than its intervals.
//!
//! A change is judged by its share of the two standard errors together, and all of them at once: with
//! thirty parameters one or two would seem to have changed by chance. Holm's step-down (1979) keeps the
//! probability of a single false change at 5 %.

use super::parameter::{Identified, Z95};
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::stats::above;
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

/// Probability of a false change, over all parameters.
const LEVEL: f64 = 0.05;

/// A stored fit, whatever verb wrote it.
#[derive(Debug, Clone)]
pub struct AnyFit {
    /// The file.
    pub path: PathBuf,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Which kind of fit: its `schema`.
    pub kind: String,
    /// What was identified.
    pub parameters: Vec<Identified>,
}

/// One parameter of both sides.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// Name of the files without ending.
    pub fit: String,
    /// Which kind of fit, as [`AnyFit::kind`].
    pub kind: String,
    /// The parameter before and after.
    pub sides: [Identified; 2],
    /// After less before, and its standard error; `None` where a side has no number.
    pub change: Option<[f64; 2]>,
    /// Whether it changed beyond its intervals, all parameters taken together.
    pub changed: bool,
}

/// Everything that was compared.
#[derive(Debug, Clone, Default)]
pub struct Comparison {
    /// Parameters of both sides, in the order of the first.
    pub pairs: Vec<Pair>,
    /// Fits or parameters of one side only: 0 the first, 1 the second.
    pub alone: Vec<(usize, String)>,
}

/// Reads a file of parameters; `None` where it is another TOML file (a robot).
///
/// # Errors
/// It cannot be read, or its parameters are no parameters.
pub fn read(path: &Path) -> Outcome<Option<AnyFit>> {
    let bytes = files::read_bytes(path)?;
    let refused = |what: &str| {
        let remedy = "give fits that `ident` wrote under fits/";
        Problem::new(format!("is no fit: {what}"), remedy)
            .at_line(1)
            .in_file(path)
    };
    let text = std::str::from_utf8(&bytes).map_err(|_| refused("not UTF-8 text"))?;
    let mut table: toml::Table = text.parse().map_err(|_| refused("not TOML"))?;
    let kind = table.get("schema").and_then(toml::Value::as_str);
    let Some(kind) = kind.filter(|s| s.starts_with("ident-")).map(String::from) else {
        return Ok(None);
    };
    let Some(parameters) = table.remove("parameters") else {
        return Ok(None);
    };
    let parameters = parameters.try_into();
    let parameters = parameters.map_err(|e: toml::de::Error| refused(e.message()))?;
    Ok(Some(AnyFit {
        path: path.to_path_buf(),
        sha256: Sha256::digest(&bytes)
            .iter()
            .map(|b| format!("{b:02x}"))
            .collect(),
        kind,
        parameters,
    }))
}

impl AnyFit {
    /// Name of the file without ending.
    pub fn name(&self) -> String {
        let stem = self.path.file_stem().unwrap_or_default();
        stem.to_string_lossy().to_string()
    }
}

impl Comparison {
    /// Of two sets of fits. Two single files are compared whatever they are called.
    pub fn of(before: &[AnyFit], after: &[AnyFit]) -> Self {
        let single = before.len() == 1 && after.len() == 1;
        let mut all = Self::default();
        for first in before {
            let same = |other: &&AnyFit| single || other.name() == first.name();
            match after.iter().find(same) {
                Some(second) => all.take(first, second),
                None => all.alone.push((0, first.name())),
            }
        }
        let only = |fit: &&AnyFit| !single && before.iter().all(|first| first.name() != fit.name());
        all.alone
            .extend(after.iter().filter(only).map(|fit| (1, fit.name())));
        all.judge();
        all
    }

    fn take(&mut self, before: &AnyFit, after: &AnyFit) {
        let same = |a: &Identified, b: &Identified| (&a.site, &a.name) == (&b.site, &b.name);
        let called = |p: &Identified| format!("{} of {} in {}", p.name, p.site, before.name());
        for first in &before.parameters {
            match after.parameters.iter().find(|second| same(first, second)) {
                Some(second) => self.pairs.push(Pair {
                    fit: before.name(),
                    kind: before.kind.clone(),
                    change: change(first, second),
                    sides: [first.clone(), second.clone()],
                    changed: false,
                }),
                None => self.alone.push((0, called(first))),
            }
        }
        let only = after.parameters.iter();
        let only = only.filter(|second| before.parameters.iter().all(|first| !same(first, second)));
        self.alone.extend(only.map(|second| (1, called(second))));
    }

    /// Holm's step-down over all changes.
    fn judge(&mut self) {
        let mut order: Vec<(usize, f64)> = self
            .pairs
            .iter()
            .enumerate()
            .filter_map(|(i, pair)| Some((i, pair.probability()?)))
            .collect();
        order.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        let count = order.len();
        for (rank, (i, probability)) in order.into_iter().enumerate() {
            if probability > LEVEL / (count - rank) as f64 {
                break;
            }
            self.pairs[i].changed = true;
        }
    }

    /// What changed, the surest first.
    pub fn changed(&self) -> Vec<&Pair> {
        let mut all: Vec<&Pair> = self.pairs.iter().filter(|pair| pair.changed).collect();
        let size = |pair: &Pair| pair.in_errors().map_or(0.0, f64::abs);
        all.sort_by(|a, b| size(b).total_cmp(&size(a)));
        all
    }
}

impl Pair {
    /// The change in its standard errors.
    pub fn in_errors(&self) -> Option<f64> {
        self.change.map(|[change, error]| change / error)
    }

    /// Of a change at least this large if nothing changed.
    fn probability(&self) -> Option<f64> {
        let size = self.in_errors()?.abs();
        Some(2.0 * above(size))
    }
}

/// After less before with its standard error; `None` without numbers of one unit on both sides, where a limit
/// on what was not found counts as one.
fn change(before: &Identified, after: &Identified) -> Option<[f64; 2]> {
    if before.unit != after.unit {
        return None;
    }
    // What is not there, and how large it may be at most: zero, with that as its 95 % end.
    let side = |p: &Identified| match (p.value, p.limit95) {
        (Some(value), _) => {
            let half = p.ci95.map(|[low, high]| 0.5 * (high - low) / Z95);
            Some([value, half.or(p.stderr)?])
        }
        (None, Some(limit)) => Some([0.0, limit / Z95]),
        (None, None) => None,
    };
    let ([from, first], [to, second]) = (side(before)?, side(after)?);
    let error = first.hypot(second);
    let known = before.value.is_some() || after.value.is_some();
    (known && error > 0.0).then_some([to - from, error])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    fn fit(name: &str, values: &[[f64; 2]]) -> AnyFit {
        let one = |(i, [value, error]): (usize, &[f64; 2])| {
            Identified::new(
                "stiffness",
                &format!("A{}", i + 1),
                *value,
                "N·m/rad",
                *error,
                "",
            )
        };
        AnyFit {
            path: format!("{name}.toml").into(),
            sha256: String::new(),
            kind: "ident-fit/1".into(),
            parameters: values.iter().enumerate().map(one).collect(),
        }
    }

    #[test]
    fn a_real_change_is_found_and_chance_among_thirty_rarely() {
        let mut random = Random::new(5);
        let (mut false_changes, mut found) = (0, 0);
        for _ in 0..400 {
            let mut values = |shift: f64| -> Vec<[f64; 2]> {
                let one = |i: usize| {
                    [
                        100.0 + random.normal() + if i == 7 { shift } else { 0.0 },
                        1.0,
                    ]
                };
                (0..30).map(one).collect()
            };
            let (before, after) = (fit("a", &values(0.0)), fit("a", &values(8.0)));
            let comparison = Comparison::of(&[before], &[after]);
            found += usize::from(comparison.pairs[7].changed);
            let others = comparison.pairs.iter().enumerate();
            false_changes += usize::from(others.filter(|(i, _)| *i != 7).any(|(_, p)| p.changed));
        }
        assert!(found > 380, "{found}");
        // 5 % of 400 are 20, with a standard deviation of 4.4.
        assert!(false_changes < 34, "{false_changes}");
    }

    #[test]
    fn what_one_side_does_not_know_is_told_and_never_a_change() {
        let (mut a, b) = (fit("a", &[[1.0, 0.1], [2.0, 0.1]]), fit("a", &[[1.0, 0.1]]));
        a.parameters[0] = a.parameters[0]
            .clone()
            .without_value(super::super::parameter::Status::NotIdentifiable);
        let comparison = Comparison::of(&[a], &[b, fit("b", &[[1.0, 0.1]])]);
        assert!(comparison.changed().is_empty() && comparison.pairs[0].change.is_none());
        assert_eq!(
            comparison.alone,
            [(0, "stiffness of A2 in a".into()), (1, "b".into())]
        );
    }
}
