//! What a load-cycle file holds, before anything is fitted, and what looks odd about it.

use super::candidates::Candidates;
use super::observation::Observation;
use super::screen::screen;
use super::suitability::Doubt;
use super::suitability::load_cycle::doubts;
use crate::ground::stats::ends;
use crate::measurement::cycles::Cycles;
use crate::measurement::load_cycle::LoadCycle;
use crate::sheet::number::engineering;
use crate::signal::outliers::{median, robust_std};
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
    let cycles = Cycles::find(&file.load);
    let steps: Vec<f64> = file.time.windows(2).map(|w| w[1] - w[0]).collect();
    let step = median(&steps);
    let jitter = if step > 0.0 {
        robust_std(&steps) / step
    } else {
        0.0
    };
    let rest = file.time[cycles.first_loaded] - file.time[0];
    let mut levels = vec![noise(&file.load), sensor_noise(&data)];
    levels.extend(file.second.as_ref().map(|s| noise(s)));
    let mut found = Inspection {
        lines: Vec::new(),
        step,
        cycles: cycles.count(),
        turning: cycles.turning.len(),
        rest,
        noise: levels,
        odd: Vec::new(),
    };
    found.lines = lines(file, &found, jitter);
    found.odd = doubts(file).iter().map(Doubt::sentence).collect();
    found
}

fn lines(file: &LoadCycle, found: &Inspection, jitter: f64) -> Vec<(String, String)> {
    let (low, high) = ends(&file.load);
    let (dl, dh) = ends(&file.deflection);
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

fn sensor_noise(data: &Observation) -> f64 {
    let candidates = Candidates::new(&crate::effects::shapes(crate::effects::EFFECTS), data);
    screen(data, &candidates).rms
}
