//! What `ident frf` tells of frequency responses that another program estimated.

use super::complex;
use crate::experiments::hammer_frf::{HammerFrf, InputFrf};
use crate::experiments::hammer_variance::variance;
use crate::report::json;
use crate::report::text::table;
use crate::sheet::number::{fixed, significant};
use crate::sheet::table::Table;
use crate::signal::frf::Estimator;
use crate::signal::outliers::median;
use serde_json::{Value, json};

/// One response over one force.
pub fn channel(frf: &HammerFrf, input: &InputFrf, output: usize) -> Value {
    json!({
        "input": input.input,
        "output": frf.outputs[output],
        "unit": "(m/s²)/N",
        "frequency_Hz": frf.frequency_hz,
        "given": complex(&input.frf(output, Estimator::H1)),
        "coherence": json::numbers(&input.sums.coherence(output)),
        "stderr": json::numbers(&deviation(input, output)),
    })
}

/// Standard deviation of every value; not a number at the first line.
fn deviation(input: &InputFrf, output: usize) -> Vec<f64> {
    let lines: Vec<usize> = (1..input.sums.lines[output].len()).collect();
    let values = variance(input, output, &lines);
    std::iter::once(f64::NAN)
        .chain(values.iter().map(|v| v.sqrt()))
        .collect()
}

/// The account.
pub fn account(frf: &HammerFrf) -> String {
    let last = frf.frequency_hz.last().copied().unwrap_or(0.0);
    let mut text = format!(
        "FRFs as given, every {} Hz up to {} Hz; their scatter: {}\n",
        significant(1.0 / frf.length_s, 4),
        significant(last, 5),
        frf.scatter_from.sentence()
    );
    if frf.rate > 0.0 {
        text += &format!(
            "exponential window: the FRF is H(jω + σ), σ = {:.4} 1/s\n",
            frf.rate
        );
    }
    let header = [
        "in",
        "out",
        "highest at Hz",
        "(m/s²)/N",
        "coherence",
        "scatter %",
    ];
    let mut rows = Table::new("", header).numeric(2..6);
    for input in &frf.inputs {
        (0..frf.outputs.len()).for_each(|o| rows.push(row(frf, input, o)));
    }
    text + &table(&rows)
}

fn row(frf: &HammerFrf, input: &InputFrf, output: usize) -> [String; 6] {
    let h = input.frf(output, Estimator::H1);
    let size = |k: &usize| h[*k].norm();
    let peak = (1..h.len())
        .max_by(|a, b| size(a).total_cmp(&size(b)))
        .unwrap_or(0);
    let coherence = input.sums.coherence(output);
    let known: Vec<f64> = coherence.into_iter().filter(|g| g.is_finite()).collect();
    let deviation = deviation(input, output);
    let relative = (1..h.len())
        .filter(|k| size(k) > 0.0)
        .map(|k| deviation[k] / size(&k));
    let coherence = match known.is_empty() {
        true => "-".into(),
        false => fixed(median(&known), 4),
    };
    [
        input.input.clone(),
        frf.outputs[output].clone(),
        fixed(frf.frequency_hz[peak], 3),
        significant(h[peak].norm(), 4),
        coherence,
        fixed(100.0 * median(&relative.collect::<Vec<_>>()), 2),
    ]
}
