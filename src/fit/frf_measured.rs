//! The FRFs of a hammer test as data of a tuning.

use super::frf_model::Measured;
use crate::experiments::hammer_frf::{HammerFrf, InputFrf};
use crate::experiments::hammer_variance::variance;

/// The rows of the Jacobian by name.
const ROWS: [&str; 3] = ["x", "y", "z"];

/// Every measured pair along the base axes from `from_hz` to `to_hz`, with variance and window.
/// Records that end before the decay need an exponential window: the model is evaluated at `jω + σ`,
/// but knows no end of the record.
pub fn measured(frf: &HammerFrf, from_hz: f64, to_hz: f64) -> Vec<Measured> {
    let inside = |k: &usize| (from_hz..=to_hz).contains(&frf.frequency_hz[*k]);
    let lines: Vec<usize> = (1..frf.frequency_hz.len()).filter(inside).collect();
    let row = |name: &str| ROWS.iter().position(|row| *row == name);
    let mut all = Vec::new();
    for input in &frf.inputs {
        for (o, name) in frf.outputs.iter().enumerate() {
            if let (Some(from), Some(to)) = (row(&input.input), row(name)) {
                all.push(pair(frf, input, o, [from, to], &lines));
            }
        }
    }
    all
}

fn pair(
    frf: &HammerFrf,
    input: &InputFrf,
    channel: usize,
    [from, to]: [usize; 2],
    lines: &[usize],
) -> Measured {
    Measured {
        input: from,
        output: to,
        frequency_hz: lines.iter().map(|k| frf.frequency_hz[*k]).collect(),
        rate: frf.rate,
        length_s: frf.length_s,
        frf: lines
            .iter()
            .map(|k| input.sums.lines[channel][*k].h1())
            .collect(),
        variance: variance(input, channel, lines),
    }
}
