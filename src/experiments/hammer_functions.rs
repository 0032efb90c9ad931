//! Hammer tests: FRFs and coherences as functions of a universal file.

use super::hammer_frf::{HammerFrf, InputFrf};
use super::hammer_given::ScatterFrom;
use crate::measurement::uff::{
    Abscissa, Axis, Dof, Function, Header, Kind, Quantity, Units, UniversalFile, Values,
};
use crate::signal::frf::Estimator;
use rustfft::num_complex::Complex64;

/// The universal file of a hammer test: per input and output the FRF and the coherence, in SI. DC,
/// which is not measured, is written as 0.
pub fn universal_file(frf: &HammerFrf, estimator: Estimator) -> UniversalFile {
    let pairs = frf
        .inputs
        .iter()
        .flat_map(|input| (0..frf.outputs.len()).map(move |o| (input, o)));
    let functions = pairs.flat_map(|(input, output)| {
        let coherence = (input.sums.hits > 1).then(|| coherence(frf, input, output));
        std::iter::once(response(frf, input, output, estimator)).chain(coherence)
    });
    UniversalFile {
        header: Some(Header {
            model: "ident frf".into(),
            description: "accelerance from hammer tests".into(),
            program: "ident".into(),
            writer: format!("ident {}", env!("CARGO_PKG_VERSION")),
            ..Header::default()
        }),
        units: Some(Units::default()),
        functions: functions.collect(),
        ..UniversalFile::default()
    }
}

fn response(frf: &HammerFrf, input: &InputFrf, output: usize, estimator: Estimator) -> Function {
    let zero = |h: &Complex64| {
        if h.is_finite() {
            *h
        } else {
            Complex64::new(0.0, 0.0)
        }
    };
    let values = input.frf(output, estimator).iter().map(zero).collect();
    let ordinate = Axis::new(Quantity::Acceleration, "Acceleration", "m/s2");
    let force = Axis::new(Quantity::ExcitationForce, "Force", "N");
    let what = match (frf.scatter_from, input.sums.hits) {
        (ScatterFrom::Hits | ScatterFrom::Coherence, n) => {
            format!("accelerance {estimator:?}, {n} hits")
        }
        _ => "accelerance as given".into(),
    };
    let kind = Kind::FrequencyResponse;
    function(
        frf,
        input,
        output,
        (kind, &what),
        Values::Complex(values),
        [ordinate, force],
    )
}

fn coherence(frf: &HammerFrf, input: &InputFrf, output: usize) -> Function {
    let zero = |g: &f64| if g.is_finite() { *g } else { 0.0 };
    let values = input.sums.coherence(output).iter().map(zero).collect();
    let ordinate = Axis::new(Quantity::Other(0), "Coherence", "NONE");
    let what = (Kind::Coherence, "ordinary coherence");
    function(
        frf,
        input,
        output,
        what,
        Values::Real(values),
        [ordinate, Axis::none()],
    )
}

fn function(
    frf: &HammerFrf,
    input: &InputFrf,
    output: usize,
    (kind, what): (Kind, &str),
    values: Values,
    [ordinate, denominator]: [Axis; 2],
) -> Function {
    let window = if frf.rate > 0.0 {
        format!(
            "exponential window on both channels, sigma = {} 1/s",
            frf.rate
        )
    } else {
        "NONE".into()
    };
    let response = &frf.outputs[output];
    Function {
        id: [
            what.to_string(),
            window,
            "NONE".into(),
            format!("response {response}, force {}", input.input),
            "NONE".into(),
        ],
        kind,
        numbers: [0, 1, 0],
        response: dof(response),
        reference: dof(&input.input),
        abscissa: Abscissa::Even {
            start: 0.0,
            step: 1.0 / frf.length_s,
        },
        values,
        double: true,
        z: 0.0,
        axes: [
            Axis::new(Quantity::Frequency, "Frequency", "Hz"),
            ordinate,
            denominator,
            Axis::none(),
        ],
    }
}

fn dof(name: &str) -> Dof {
    let known = ["x", "y", "z"].iter().position(|n| *n == name);
    Dof {
        entity: "NONE".into(),
        node: 1,
        direction: known.map_or(0, |i| i as i64 + 1),
    }
}
