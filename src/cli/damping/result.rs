//! The result of `ident damping` and its JSON.

use super::input::Input;
use crate::cli::Ending;
use crate::cli::frf::mode;
use crate::experiments::hammer_frf::HammerFrf;
use crate::experiments::hammer_given::ScatterFrom;
use crate::fit::damping::{Account, Pair, Request};
use crate::fit::damping_statement::good;
use crate::fit::damping_store::StoredProduct;
use crate::fit::frf_identifiability::Combination;
use crate::fit::frf_match::FrfMatch;
use crate::fit::frf_model::Kind;
use crate::fit::frf_nuisance::Pull;
use crate::report::json::{self, number, numbers};
use crate::sheet::number::significant;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// Everything that is reported.
pub struct Damped {
    /// What went in.
    pub input: Input,
    /// What was asked for.
    pub request: Request,
    /// What came out.
    pub account: Account,
}

impl Damped {
    /// Comparison tests of the campaign that were not taken.
    pub fn passed_over(&self) -> Vec<String> {
        let left = self.input.passed_over.iter().map(|path| path.display());
        let said = left.map(|path| {
            format!(
                "{path} is a comparison test and left out; `ident damping --frf {path}` tunes to it"
            )
        });
        said.collect()
    }

    /// Hits that were left out, with why, in one sentence.
    pub fn left_out(&self) -> Option<String> {
        let hits = || self.input.tests.iter().flat_map(|test| &test.frf.screened);
        let left: Vec<String> = hits()
            .filter_map(|hit| Some(format!("{} {} ({})", hit.direction, hit.hit, hit.why()?)))
            .collect();
        let count = format!("{} of {} hits are left out", left.len(), hits().count());
        (!left.is_empty()).then(|| format!("{count}: {}.", left.join("; ")))
    }

    /// Whether something needs attention: a hit left out, a remark, an FRF that is not met.
    pub fn ending(&self) -> Ending {
        let mut tests = self.input.tests.iter();
        let left =
            tests.any(|t| !t.frf.remarks.is_empty() || t.frf.screened.iter().any(|h| !h.used()));
        Ending::attention_if(left || !self.met() || !self.of_model().is_empty())
    }

    /// Whether every pair is met in shape and scale.
    pub fn met(&self) -> bool {
        let good = |pair: &Pair| good(&pair.matches[1]);
        self.account.pairs.iter().flatten().all(good)
    }

    /// Whether any of the data was simulated.
    pub fn synthetic(&self) -> bool {
        self.input.tests.iter().any(|test| test.record.synthetic)
    }

    /// The combinations of constants that the data fix, as in `A4^0.70 · A6^-0.70`.
    pub fn combinations(&self) -> Vec<StoredProduct> {
        let constants = &self.account.constants;
        let factor = |(i, weight): &(usize, f64)| {
            let kind = match constants[*i].kind {
                Kind::Damping => "",
                Kind::Stiffness => " stiffness",
                Kind::Mass => " mass",
                Kind::Weight => " weight",
                Kind::Body => " bodies",
                Kind::Instrument => " instrument",
            };
            format!("{}{kind}^{}", constants[*i].site, significant(*weight, 2))
        };
        let values = &self.account.tuned.values;
        let change = |(i, weight): &(usize, f64)| weight * (values[*i] / constants[*i].start).ln();
        let known = self.account.supported;
        let fixed = self
            .account
            .tuned
            .uncertainty
            .fixed
            .iter()
            .filter(|_| known);
        let product = |one: &Combination| StoredProduct {
            product: one
                .weights
                .iter()
                .map(factor)
                .collect::<Vec<_>>()
                .join(" · "),
            times_before: one.weights.iter().map(change).sum::<f64>().exp(),
            relative_stderr: one.ln_std,
        };
        fixed.map(product).collect()
    }

    /// The document of `formats.md`.
    pub fn json(&self) -> Map<String, Value> {
        let tests = &self.input.tests;
        let robot = self.input.robot.input();
        let mut inputs: Vec<(&Path, &str)> = tests
            .iter()
            .map(|t| (t.path.as_path(), t.record.sha256.as_str()))
            .collect();
        let robot_path = PathBuf::from(&robot.0);
        inputs.push((&robot_path, &robot.1));
        let mut map = json::head("damping", &inputs);
        let account = &self.account;
        map.insert("synthetic".into(), json!(self.synthetic()));
        map.insert("frf".into(), self.frf());
        map.insert(
            "modes".into(),
            tests
                .iter()
                .flat_map(|t| t.modes.iter().map(mode))
                .collect(),
        );
        map.insert("parameters".into(), json!(account.parameters));
        map.insert("fixed_combinations".into(), self.combinations_json());
        map.insert("priors".into(), self.priors());
        map.insert("stiffnesses_fitted_along".into(), self.pulls());
        map.insert("match".into(), self.matches(1));
        map.insert("match_before".into(), self.matches(0));
        map.insert("poses".into(), self.poses());
        map.insert(
            "fit".into(),
            json!({
                "reduced_chi_square": number(account.tuned.reduced_chi_square),
                "agreeing_starts": number(account.tuned.agreeing_starts),
                "band_Hz": [self.request.from_hz, self.request.settings.band_hz],
            }),
        );
        map.insert("doubts".into(), json!(self.input.doubts));
        map.insert(
            "remarks".into(),
            json!([self.remarks(), self.passed_over()].concat()),
        );
        map
    }

    fn frf(&self) -> Value {
        let tests = &self.input.tests;
        let hits = || {
            tests
                .iter()
                .flat_map(|t| t.frf.screened.iter().map(move |h| (t, h)))
        };
        let rejected = hits().filter(|(_, hit)| !hit.used()).map(|(test, hit)| {
            let label = hit.hit.parse::<u64>().map_or(json!(hit.hit), |n| json!(n));
            json!({"file": test.path.display().to_string(), "direction": hit.direction, "hit": label, "why": hit.why()})
        });
        let first = tests.first().map(|t| &t.frf);
        json!({
            "estimator": match tests.iter().all(|t| t.frf.scatter_from == ScatterFrom::Hits) {
                true => "H1",
                false => "as given",
            },
            "scatter": tests.iter().map(|t| t.frf.scatter_from.sentence()).collect::<Vec<_>>(),
            "resolution_Hz": first.map(|f| number(1.0 / f.length_s)),
            "exponential_rate_1_s": first.map(|f: &HammerFrf| number(f.rate)),
            "hits_used": hits().filter(|(_, hit)| hit.used()).count(),
            "hits_rejected": rejected.collect::<Vec<_>>(),
        })
    }

    fn combinations_json(&self) -> Value {
        let all = self
            .account
            .tuned
            .uncertainty
            .fixed
            .iter()
            .zip(self.combinations());
        all.map(|(one, said)| {
            let constant = |i: usize| &self.account.parameters[i];
            let weights: Vec<Value> = one
                .weights
                .iter()
                .map(|(i, w)| json!({"name": constant(*i).name, "site": constant(*i).site, "exponent": w}))
                .collect();
            json!({"product": said.product, "factors": weights, "times_before": number(said.times_before), "relative_stderr": number(said.relative_stderr)})
        })
        .collect()
    }

    fn priors(&self) -> Value {
        let constants = self.account.constants.iter().zip(&self.account.parameters);
        let stated = constants.filter_map(|(constant, parameter)| {
            let spread = constant.prior_ln_std?;
            Some(json!({"name": parameter.name, "site": constant.site, "value": constant.start, "relative_std": spread}))
        });
        stated.collect()
    }

    fn pulls(&self) -> Value {
        let one = |pull: &Pull| json!({"site": pull.site, "robot": number(pull.stated), "times_robot": number(pull.times), "relative_std": number(pull.prior_ln_std), "deviations": number(pull.deviations())});
        self.account.pulls.iter().map(one).collect()
    }

    /// Per direction pair; over several poses the worst of each measure.
    fn matches(&self, which: usize) -> Value {
        let mut map: Map<String, Value> = Map::new();
        let mut names: Vec<&String> = self
            .account
            .pairs
            .iter()
            .flatten()
            .map(|p| &p.name)
            .collect();
        names.sort();
        names.dedup();
        for name in names {
            let same = self
                .account
                .pairs
                .iter()
                .flatten()
                .filter(|pair| pair.name == *name);
            let worst = same
                .map(|pair| pair.matches[which])
                .reduce(|a, b| FrfMatch {
                    frac: a.frac.min(b.frac),
                    log_error_db: a.log_error_db.max(b.log_error_db),
                });
            map.extend(worst.map(|worst| (name.clone(), matched(&worst))));
        }
        Value::Object(map)
    }

    fn poses(&self) -> Value {
        let tests = self.input.tests.iter().zip(&self.account.pairs);
        tests
            .map(|(test, pairs)| {
                let pairs = pairs
                    .iter()
                    .map(|p| (p.name.clone(), matched(&p.matches[1])));
                let degrees = test.record.joint_angles.iter().flatten();
                let degrees: Vec<f64> = degrees
                    .map(|q| (q / crate::ground::units::DEGREE * 1e9).round() / 1e9)
                    .collect();
                json!({
                    "file": test.path.display().to_string(),
                    "joint_angles_deg": numbers(&degrees),
                    "match": pairs.collect::<Map<String, Value>>(),
                })
            })
            .collect()
    }
}

fn matched(found: &FrfMatch) -> Value {
    json!({"frac": number(found.frac), "log_error_dB": number(found.log_error_db)})
}
