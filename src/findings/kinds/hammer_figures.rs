//! The figures of a diagnosed hammer test.

use crate::findings::hammer::Diagnosis;
use crate::findings::hammer::discrepancy::{Curves, noise_spectrum, spectrum};
use crate::motion::frf::C64;
use crate::sheet::chart::{Axis, Chart, Panel, Series};

/// Half width of the band about the measured magnitude, in standard deviations.
const BAND: f64 = 1.96;

/// Names of the curves: the same in every figure.
const NAMES: [&str; 3] = ["measured", "present simulation", "with the causes"];

fn frequencies() -> Axis {
    Axis::new("Frequency", "Hz")
}

fn accelerance() -> Axis {
    Axis::new("Accelerance", "(m/s²)/N").log()
}

/// One figure per direction that was struck: the driving point, magnitude and phase.
pub fn before_and_after(found: &Diagnosis, stem: &str) -> Vec<Chart> {
    let pairs = found.data.pairs.iter().enumerate();
    let driving = pairs.filter(|(_, pair)| pair.input == pair.output);
    driving
        .map(|(p, _)| driving_point(found, p, stem))
        .collect()
}

fn driving_point(found: &Diagnosis, p: usize, stem: &str) -> Chart {
    let name = found.data.name(p);
    Chart::new(
        format!("{stem}-{name}"),
        format!("Accelerance {name}: measured against simulated"),
        "Driving point at the tool, seen through an exponential window that all three curves share. The band is the 95 % interval of the measured magnitude, small errors of any model included. With the causes, what is uncertain although nothing is wrong (stiffnesses, dampings, masses, mounting) lies where it fits best within its spread.",
    )
    .with(magnitude(found, p))
    .with(phase(found, p))
}

/// Whether the extended model differs from the present simulation at all.
fn curves(found: &Diagnosis, p: usize) -> Vec<(&'static str, &[C64])> {
    let all = [
        found.data.pairs[p].frf.as_slice(),
        &found.before[p],
        &found.after[p],
    ];
    let named = NAMES.into_iter().zip(all);
    let shown = if found.causes_named() { 3 } else { 2 };
    named.take(shown).collect()
}

fn over(found: &Diagnosis, values: &[C64], of: impl Fn(&C64) -> f64) -> Vec<[f64; 2]> {
    let lines = found.data.hz().into_iter().zip(values);
    lines.map(|(hz, h)| [hz, of(h)]).collect()
}

fn line(number: usize, name: &str, points: Vec<[f64; 2]>) -> Series {
    match number {
        0 => Series::line(name, points),
        1 => Series::dotted(name, points),
        _ => Series::dashed(name, points),
    }
}

fn magnitude(found: &Diagnosis, p: usize) -> Panel {
    let pair = &found.data.pairs[p];
    let rows = found.data.hz().into_iter().zip(&pair.frf).zip(&pair.weight);
    let band: Vec<[f64; 3]> = rows
        .map(|((hz, h), w)| {
            let (size, half) = (h.norm(), BAND / (w * found.data.correlated.sqrt()));
            [hz, (size - half).max(0.05 * size), size + half]
        })
        .collect();
    let panel = Panel::new(frequencies(), accelerance());
    let panel = panel.with(Series::band("95 % interval", &band));
    let curves = curves(found, p).into_iter().enumerate();
    curves.fold(panel, |panel, (i, (name, values))| {
        panel.with(line(i, name, over(found, values, |h| h.norm())))
    })
}

fn phase(found: &Diagnosis, p: usize) -> Panel {
    let degrees = |h: &C64| h.arg().to_degrees();
    let curves = curves(found, p).into_iter().enumerate();
    let panel = Panel::new(frequencies(), Axis::new("Phase", "°"));
    curves.fold(panel, |panel, (i, (name, values))| {
        panel.with(line(i, name, over(found, values, degrees)))
    })
}

/// What is left over frequency, and where the FRF depends on the force, the softest hit against the
/// hardest.
pub fn remaining(found: &Diagnosis, stem: &str) -> Vec<Chart> {
    let left = |curves: &Curves| spectrum(&found.data, curves);
    let axis = Axis::new("Rms of measured − simulated", "(m/s²)/N").log();
    let mut panel = Panel::new(frequencies(), axis)
        .with(Series::line(
            "noise and tolerance",
            noise_spectrum(&found.data),
        ))
        .with(Series::dotted(NAMES[1], left(&found.before)));
    if found.causes_named() {
        panel = panel.with(Series::dashed(NAMES[2], left(&found.after)));
    }
    let chart = Chart::new(
        format!("{stem}-remaining"),
        "What no named cause explains",
        "Root mean square over all pairs of directions. Noise and tolerance: the scatter of the hits, and 0.45 % of the accelerance, which any linear model of a robot misses.",
    )
    .with(panel);
    std::iter::once(chart).chain(levels(found, stem)).collect()
}

fn levels(found: &Diagnosis, stem: &str) -> Option<Chart> {
    let level = found.level.as_ref().filter(|level| level.broken())?;
    let input = found
        .frf
        .inputs
        .iter()
        .find(|i| i.input == level.direction)?;
    let output = found
        .frf
        .outputs
        .iter()
        .position(|o| *o == level.direction)?;
    let force = |k: usize| input.hits[k].force.get(1).map_or(0.0, |f| f.norm());
    let mut order: Vec<usize> = (0..input.hits.len()).collect();
    order.sort_by(|a, b| force(*a).total_cmp(&force(*b)));
    let hz = found.data.hz();
    let (low, high) = (*hz.first()?, *hz.last()?);
    let curve = |k: usize| -> Vec<[f64; 2]> {
        let lines = found
            .frf
            .frequency_hz
            .iter()
            .zip(input.hits[k].ratio(output));
        let inside = lines.filter(|(hz, _)| (low..=high).contains(*hz));
        inside.map(|(hz, h)| [*hz, h.norm()]).collect()
    };
    let panel = Panel::new(frequencies(), accelerance())
        .with(Series::line("softest hit", curve(*order.first()?)))
        .with(Series::dashed("hardest hit", curve(*order.last()?)));
    let chart = Chart::new(
        format!("{stem}-levels"),
        format!("Accelerance {0}{0} at two levels of force", level.direction),
        "A linear robot gives one curve. Peaks that move or change their height with the force mean play, friction or a stiffness that depends on the amplitude.",
    );
    Some(chart.with(panel))
}
