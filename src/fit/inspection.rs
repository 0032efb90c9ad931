//! What a load-cycle file holds, before anything is fitted, and what looks odd about it.

use super::candidates::Candidates;
use super::observation::Observation;
use super::screen::screen;
use crate::measurement::load_cycle::LoadCycle;
use crate::sheet::number::engineering;
use crate::signal::outliers::{isolated, median, robust_std};
use crate::signal::smooth::noise;

/// What was found.
pub struct Inspection {
    /// Lines for the reader: name and value.
    pub lines: Vec<(String, String)>,
    /// Median sampling interval, s.
    pub step: f64,
    /// Cycles.
    pub cycles: usize,
    /// Turning points.
    pub turning: usize,
    /// Duration of the unloaded start, s.
    pub rest: f64,
    /// Noise of load and deflection channels, SI, in file order.
    pub noise: Vec<f64>,
    /// What looks odd.
    pub odd: Vec<String>,
}

/// Looks at a file.
pub fn inspect(file: &LoadCycle) -> Inspection {
    let data = Observation::of(file, 2000);
    let steps: Vec<f64> = file.time.windows(2).map(|w| w[1] - w[0]).collect();
    let step = median(&steps);
    let jitter = if step > 0.0 {
        robust_std(&steps) / step
    } else {
        0.0
    };
    let rest = data.scene.time[data.cycles.first_loaded] - data.scene.time[0];
    let mut levels = vec![noise(&file.load), sensor_noise(&data)];
    levels.extend(file.second.as_ref().map(|s| noise(s)));
    let mut found = Inspection {
        lines: Vec::new(),
        step,
        cycles: data.cycles.count(),
        turning: data.cycles.turning.len(),
        rest,
        noise: levels,
        odd: Vec::new(),
    };
    found.lines = lines(file, &found, jitter);
    found.odd = odd(file, &data, &found, jitter);
    found
}

fn lines(file: &LoadCycle, found: &Inspection, jitter: f64) -> Vec<(String, String)> {
    let (low, high) = range(&file.load);
    let (dl, dh) = range(&file.deflection);
    let unit = file.port.deflection_unit();
    let mut lines = vec![
        (
            "sampling".into(),
            format!(
                "every {} (spread {:.1} %)",
                engineering(found.step, 4, "s"),
                100.0 * jitter
            ),
        ),
        (
            "load range".into(),
            format!(
                "{} to {}",
                engineering(low, 4, file.port.load_unit()),
                engineering(high, 4, file.port.load_unit())
            ),
        ),
        (
            "deflection range".into(),
            format!(
                "{} to {}",
                engineering(dl, 4, unit),
                engineering(dh, 4, unit)
            ),
        ),
        (
            "cycles".into(),
            format!("{} with {} turning points", found.cycles, found.turning),
        ),
        ("unloaded start".into(), engineering(found.rest, 3, "s")),
        (
            "noise of the load".into(),
            engineering(found.noise[0], 2, file.port.load_unit()),
        ),
        (
            "noise of the deflection".into(),
            engineering(found.noise[1], 2, unit),
        ),
    ];
    if let Some(second) = found.noise.get(2) {
        lines.push((
            "noise of the second deflection".into(),
            engineering(*second, 2, unit),
        ));
    }
    lines
}

fn odd(file: &LoadCycle, data: &Observation, found: &Inspection, jitter: f64) -> Vec<String> {
    let mut odd = Vec::new();
    let (low, high) = range(&file.load);
    let (dl, dh) = range(&file.deflection);
    if high <= low {
        odd.push("the load never changes".into());
    }
    if dh <= dl {
        odd.push("the deflection never changes".into());
    }
    if found.turning < 2 {
        odd.push("fewer than two turning points: this is no full load cycle".into());
    }
    if jitter > 0.2 {
        odd.push(format!(
            "sampling is uneven (spread {:.0} %)",
            100.0 * jitter
        ));
    }
    if !data.wild.is_empty() {
        odd.push(format!("{} lone wild readings", data.wild.len()));
    }
    if !isolated(&file.load, 12.0).is_empty() {
        odd.push("the load has lone wild readings".into());
    }
    if let Some(stated) = file
        .facts
        .rest
        .filter(|s| (s - found.rest).abs() > 0.5 * s.max(1.0))
    {
        odd.push(format!(
            "front matter states {stated} s of unloaded start, found {:.2} s",
            found.rest
        ));
    }
    if correlation(&file.load, &file.deflection) < 0.0 {
        odd.push(
            "deflection runs against the load: a sign is wrong, or the columns are swapped".into(),
        );
    }
    if file.left_out > 0 {
        odd.push(format!(
            "{} rows lack a value and are left out",
            file.left_out
        ));
    }
    if repeated(&file.deflection) > 0.5 {
        odd.push("most readings repeat one before: the converter is coarse".into());
    }
    odd
}

fn sensor_noise(data: &Observation) -> f64 {
    let candidates = Candidates::new(&crate::effects::shapes(crate::effects::EFFECTS), data);
    screen(data, &candidates).colour.rms
}

fn range(values: &[f64]) -> (f64, f64) {
    values
        .iter()
        .fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(*v), h.max(*v)))
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len() as f64;
    let (ma, mb) = (a.iter().sum::<f64>() / n, b.iter().sum::<f64>() / n);
    a.iter().zip(b).map(|(x, y)| (x - ma) * (y - mb)).sum()
}

/// Share of neighbouring readings that are exactly equal.
fn repeated(values: &[f64]) -> f64 {
    let equal = values.windows(2).filter(|w| w[0] == w[1]).count();
    equal as f64 / (values.len().max(2) - 1) as f64
}
