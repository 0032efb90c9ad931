//! The figures of `ident damping`.

use crate::experiments::hammer_frf::{HammerFrf, InputFrf};
use crate::experiments::hammer_modes::stabilisation;
use crate::fit::damping::{AXES, Pair, Test};
use crate::ground::files;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::signal::modal_model::frequency;
use rustfft::num_complex::Complex64;

/// Half width of the band about the measured magnitude, in standard deviations.
const BAND: f64 = 1.96;

fn frequencies() -> Axis {
    Axis::new("Frequency", "Hz")
}

fn accelerance() -> Axis {
    Axis::new("Accelerance", "(m/s²)/N").log()
}

/// Where the pair stands in the FRFs of its test: input and output.
fn channel<'a>(frf: &'a HammerFrf, pair: &Pair) -> Option<(&'a InputFrf, usize)> {
    let input = frf
        .inputs
        .iter()
        .find(|i| i.input == AXES[pair.measured.input])?;
    let output = frf
        .outputs
        .iter()
        .position(|o| *o == AXES[pair.measured.output])?;
    Some((input, output))
}

/// Magnitude, phase and coherence of one pair: measured with its band, simulated before and after.
pub fn pair(test: &Test, pair: &Pair, stem: &str) -> Chart {
    let caption = format!(
        "Force along {}, acceleration along {}: FRAC {:.4} before, {:.4} after; mean amplitude error {:.2} dB before, {:.2} dB after. The band is the 95 % interval of the measured magnitude.",
        AXES[pair.measured.input],
        AXES[pair.measured.output],
        pair.matches[0].frac,
        pair.matches[1].frac,
        pair.matches[0].log_error_db,
        pair.matches[1].log_error_db,
    );
    Chart::new(
        stem,
        format!("H_{} of {}", pair.name, files::name(&test.path)),
        caption,
    )
    .synthetic(test.record.synthetic)
    .with(magnitude(pair))
    .with(phase(pair))
    .with(coherence(&test.frf, pair))
}

fn over(pair: &Pair, values: &[Complex64], of: impl Fn(&Complex64) -> f64) -> Vec<[f64; 2]> {
    let lines = pair.measured.frequency_hz.iter().zip(values);
    lines.map(|(f, h)| [*f, of(h)]).collect()
}

fn magnitude(pair: &Pair) -> Panel {
    let measured = &pair.measured;
    let rows = measured
        .frequency_hz
        .iter()
        .zip(&measured.frf)
        .zip(&measured.variance);
    let band: Vec<[f64; 3]> = rows
        .map(|((f, h), variance)| {
            let half = BAND * (0.5 * variance).sqrt();
            [*f, (h.norm() - half).max(0.05 * h.norm()), h.norm() + half]
        })
        .collect();
    let size = |h: &Complex64| h.norm();
    Panel::new(frequencies(), accelerance())
        .with(Series::band("95 % interval", &band))
        .with(Series::line("measured", over(pair, &measured.frf, size)))
        .with(Series::dotted(
            "simulated before",
            over(pair, &pair.before, size),
        ))
        .with(Series::dashed(
            "simulated after",
            over(pair, &pair.after, size),
        ))
}

fn phase(pair: &Pair) -> Panel {
    let degrees = |h: &Complex64| h.arg().to_degrees();
    Panel::new(frequencies(), Axis::new("Phase", "°"))
        .with(Series::line(
            "measured",
            over(pair, &pair.measured.frf, degrees),
        ))
        .with(Series::dotted(
            "simulated before",
            over(pair, &pair.before, degrees),
        ))
        .with(Series::dashed(
            "simulated after",
            over(pair, &pair.after, degrees),
        ))
}

fn coherence(frf: &HammerFrf, pair: &Pair) -> Panel {
    let known = channel(frf, pair).map(|(input, output)| input.sums.coherence(output));
    let inside = |f: f64| {
        let lines = &pair.measured.frequency_hz;
        lines.first().is_some_and(|low| f >= *low) && lines.last().is_some_and(|high| f <= *high)
    };
    let lines = frf.frequency_hz.iter().zip(known.iter().flatten());
    let points = lines
        .filter(|(f, _)| inside(**f))
        .map(|(f, c)| [*f, *c])
        .collect();
    Panel::new(frequencies(), Axis::new("Coherence", "")).with(Series::line("coherence", points))
}

/// The driving-point FRF of every hit that was used, one over the other.
pub fn hits(test: &Test, pair: &Pair, stem: &str) -> Option<Chart> {
    let (input, output) = channel(&test.frf, pair)?;
    if input.hits.is_empty() {
        return None;
    }
    let top = *pair.measured.frequency_hz.last()?;
    let low = *pair.measured.frequency_hz.first()?;
    let mut panel = Panel::new(frequencies(), accelerance());
    let used = test.frf.screened.iter();
    let used = used.filter(|hit| hit.used() && hit.direction == input.input);
    for (hit, label) in input.hits.iter().zip(used) {
        let lines = test.frf.frequency_hz.iter().zip(hit.ratio(output));
        let inside = lines.filter(|(f, _)| (low..=top).contains(*f));
        let points = inside.map(|(f, h)| [*f, h.norm()]).collect();
        panel = panel.with(Series::line(format!("hit {}", label.hit), points));
    }
    let used = input.hits.len();
    let title = format!("H_{} of {}, hit by hit", pair.name, files::name(&test.path));
    let caption = format!("{used} hits of different force: a linear structure gives one curve.");
    Some(
        Chart::new(stem, title, caption)
            .synthetic(test.record.synthetic)
            .with(panel),
    )
}

/// Poles over the order of the polynomial, and the modes that were taken.
pub fn poles(test: &Test, to_hz: f64, stem: &str) -> Chart {
    let chart = stabilisation(&test.frf, to_hz);
    let seen = |stable: bool| -> Vec<[f64; 2]> {
        let some = chart.iter().filter(|point| point.stable == stable);
        let placed = some.map(|point| [frequency(point.pole), point.order as f64]);
        placed.filter(|[hz, _]| *hz <= 1.1 * to_hz).collect()
    };
    let top = chart.iter().map(|point| point.order).max().unwrap_or(1) as f64;
    let mut panel = Panel::new(frequencies(), Axis::new("Order", ""))
        .with(Series::points("new pole", seen(false)))
        .with(Series::points("stable pole", seen(true)).emphasised());
    let gap = [f64::NAN, f64::NAN];
    let line = |hz: f64| [[hz, 0.0], [hz, top], gap];
    let taken = test.modes.iter().flat_map(|mode| line(mode.frequency_hz));
    panel = panel.with(Series::dashed("mode taken", taken.collect()));
    let caption = "A pole is stable where the order before had it too, within 1 % in frequency and 20 % in damping.";
    let title = format!("Stabilisation, {}", files::name(&test.path));
    Chart::new(stem, title, caption)
        .synthetic(test.record.synthetic)
        .with(panel)
}
