//! The load-cycle experiment: what a joint model says of one settled cycle, and its charts.

use crate::effects::{Composite, Scene};
use crate::ground::stats::{difference, largest};
use crate::measurement::load_cycle::LoadCycle;
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::prefix;

/// What one settled cycle of a model shows at its ends and over its round.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settled {
    /// Load range over deflection range, N·m/rad (N/m).
    pub secant: f64,
    /// Slope of load over deflection at the end of loading, both ends averaged.
    pub tangent: f64,
    /// Slope of load over deflection right after the reversals.
    pub reversal: f64,
    /// ∮ M dφ, J.
    pub loss: f64,
    /// Loss over 2π times the stored energy of the secant spring.
    pub loss_factor: f64,
}

/// Rows of one simulated half cycle.
const HALF: usize = 240;

/// A settled cycle: load and deflection of the last of three triangle cycles between two loads.
pub fn settled_cycle(
    model: &Composite,
    p: &[f64],
    like: &Scene,
    low: f64,
    high: f64,
) -> (Vec<f64>, Vec<f64>) {
    let load = triangle(low, high, 3);
    let dt = like.period / (2 * HALF) as f64;
    let scene = Scene {
        time: (0..load.len()).map(|i| i as f64 * dt).collect(),
        duration: load.len() as f64 * dt,
        load,
        ..like.clone()
    };
    let deflection = model.predict(p, &scene);
    let last = scene.load.len() - 2 * HALF - 1;
    (scene.load[last..].to_vec(), deflection[last..].to_vec())
}

/// Load from zero to `high`, then `cycles` times to `low` and back.
fn triangle(low: f64, high: f64, cycles: usize) -> Vec<f64> {
    let leg =
        |from: f64, to: f64| (1..=HALF).map(move |i| from + (to - from) * i as f64 / HALF as f64);
    let mut load = vec![0.0];
    load.extend(leg(0.0, high));
    for _ in 0..cycles {
        load.extend(leg(high, low));
        load.extend(leg(low, high));
    }
    load
}

/// Reads secant, tangents and loss off a settled cycle.
pub fn settle(load: &[f64], deflection: &[f64]) -> Settled {
    let middle = load.len() / 2;
    let slope = |a: usize, b: usize| (load[b] - load[a]) / (deflection[b] - deflection[a]);
    let end = load.len() - 1;
    let near = HALF / 20;
    let secant = slope(0, middle);
    let mean = |a: f64, b: f64| 2.0 / (1.0 / a + 1.0 / b);
    let loss = enclosed(load, deflection);
    let stored = 0.125 * (load[0] - load[middle]) * (deflection[0] - deflection[middle]);
    Settled {
        secant,
        tangent: mean(slope(middle - near, middle), slope(end - near, end)),
        reversal: mean(slope(0, near), slope(middle, middle + near)),
        loss,
        loss_factor: loss / (std::f64::consts::TAU * stored),
    }
}

/// Work ∮ M dφ of a closed loop by the trapezoidal rule, J.
pub fn enclosed(load: &[f64], deflection: &[f64]) -> f64 {
    let n = load.len();
    (0..n)
        .map(|i| {
            let j = (i + 1) % n;
            0.5 * (load[i] + load[j]) * (deflection[j] - deflection[i])
        })
        .sum()
}

/// Straight-line stiffness as a textbook takes it: least squares of load over deflection with a
/// free intercept.
pub fn straight_line(load: &[f64], deflection: &[f64]) -> f64 {
    let n = load.len() as f64;
    let (ml, md) = (
        load.iter().sum::<f64>() / n,
        deflection.iter().sum::<f64>() / n,
    );
    let dd: f64 = deflection.iter().map(|d| (d - md).powi(2)).sum();
    let ld: f64 = load
        .iter()
        .zip(deflection)
        .map(|(l, d)| (l - ml) * (d - md))
        .sum();
    ld / dd
}

/// Curves of one measurement against a model, for charts.
pub struct Curves<'a> {
    /// The file.
    pub file: &'a LoadCycle,
    /// Time, s; load; reading; model — after reduction.
    pub time: &'a [f64],
    /// Load.
    pub load: &'a [f64],
    /// Reading.
    pub reading: &'a [f64],
    /// Model.
    pub model: &'a [f64],
    /// What the model is called in the legend.
    pub name: &'a str,
    /// A simpler prediction of what `model` predicts, with its name on an axis: what lies beyond it
    /// is drawn enlarged.
    pub reference: (&'a str, &'a [f64]),
    /// Whether the deflection was imposed: `model` is then a load, over the deflection.
    pub imposed: bool,
}

impl Curves<'_> {
    fn scales(&self) -> Scales {
        let residual = self.residual();
        Scales {
            load: prefix(largest(self.load), self.file.port.load_unit()),
            deflection: prefix(largest(self.reading), self.file.port.deflection_unit()),
            residual: prefix(largest(&residual), self.residual_unit()),
        }
    }

    /// What the model predicts, as measured.
    fn measured(&self) -> &[f64] {
        if self.imposed {
            self.load
        } else {
            self.reading
        }
    }

    fn residual(&self) -> Vec<f64> {
        self.measured()
            .iter()
            .zip(self.model)
            .map(|(y, f)| y - f)
            .collect()
    }

    fn residual_unit(&self) -> &'static str {
        if self.imposed {
            self.file.port.load_unit()
        } else {
            self.file.port.deflection_unit()
        }
    }

    /// Moment over angle with the model over it, the same beyond the reference, residual over moment,
    /// residual over time.
    pub fn chart(&self, stem: &str, what: &str) -> Chart {
        Chart::new(
            stem,
            format!("{}: {what}", self.file.site()),
            self.caption(),
        )
        .synthetic(self.file.facts.synthetic)
        .with(self.loops())
        .with(self.beyond_over_load())
        .with(self.residual_over_load())
        .with(self.residual_over_time())
    }

    /// Load over deflection with the model over it.
    pub fn loops(&self) -> Panel {
        let s = self.scales();
        Panel::new(self.deflection_axis(&s), self.load_axis(&s))
            .with(Series::points(
                "measured",
                pairs(self.reading, s.deflection.0, self.load, s.load.0),
            ))
            .with(Series::line(self.name, self.over(self.model, &s)))
    }

    /// A prediction of what the model predicts, in the axes of [`Self::loops`].
    pub fn prediction(&self, values: &[f64]) -> Vec<[f64; 2]> {
        self.over(values, &self.scales())
    }

    fn over(&self, values: &[f64], s: &Scales) -> Vec<[f64; 2]> {
        match self.imposed {
            false => pairs(values, s.deflection.0, self.load, s.load.0),
            true => pairs(self.reading, s.deflection.0, values, s.load.0),
        }
    }

    /// What lies beyond the reference, over the load (over the displacement, if that was imposed).
    pub fn beyond_over_load(&self) -> Panel {
        let s = self.scales();
        match self.imposed {
            false => self.beyond(self.load_axis(&s), self.load, s.load.0),
            true => self.beyond(self.deflection_axis(&s), self.reading, s.deflection.0),
        }
    }

    /// What lies beyond the reference, over time.
    pub fn beyond_over_time(&self) -> Panel {
        self.beyond(Axis::new("Time", "s"), self.time, 1.0)
    }

    fn beyond(&self, axis: Axis, x: &[f64], xs: f64) -> Panel {
        let less = |values: &[f64]| -> Vec<f64> { difference(values, self.reference.1) };
        let (measured, model) = (less(self.measured()), less(self.model));
        let (ys, unit) = prefix(largest(&measured), self.residual_unit());
        Panel::new(axis, Axis::new(self.reference.0, unit))
            .with(Series::points("measured", pairs(x, xs, &measured, ys)))
            .with(Series::line(self.name, pairs(x, xs, &model, ys)))
    }

    /// Measured less model, over the load.
    pub fn residual_over_load(&self) -> Panel {
        let s = self.scales();
        Panel::new(self.load_axis(&s), self.residual_axis(&s)).with(Series::points(
            self.residual_name(),
            pairs(self.load, s.load.0, &self.residual(), s.residual.0),
        ))
    }

    /// Measured less model, over time.
    pub fn residual_over_time(&self) -> Panel {
        let s = self.scales();
        Panel::new(Axis::new("Time", "s"), self.residual_axis(&s)).with(Series::points(
            self.residual_name(),
            pairs(self.time, 1.0, &self.residual(), s.residual.0),
        ))
    }

    fn residual_name(&self) -> String {
        format!("measured − {}", self.name)
    }

    fn load_axis(&self, s: &Scales) -> Axis {
        Axis::new(self.file.port.load_name(), s.load.1.clone())
    }

    fn deflection_axis(&self, s: &Scales) -> Axis {
        Axis::new(self.file.port.deflection_name(), s.deflection.1.clone())
    }

    fn residual_axis(&self, s: &Scales) -> Axis {
        Axis::new("Residual", s.residual.1.clone())
    }

    fn caption(&self) -> String {
        let robot = self.file.facts.robot.as_deref().unwrap_or("unnamed robot");
        format!(
            "Load cycle {} of {robot}, {} rows.",
            self.file.stem(),
            self.file.load.len()
        )
    }
}

struct Scales {
    load: (f64, String),
    deflection: (f64, String),
    residual: (f64, String),
}

fn pairs(x: &[f64], xs: f64, y: &[f64], ys: f64) -> Vec<[f64; 2]> {
    x.iter().zip(y).map(|(a, b)| [a * xs, b * ys]).collect()
}
