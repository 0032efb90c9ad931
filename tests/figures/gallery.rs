//! Figures as the verbs draw them, from made-up data.

use ident::sheet::chart::{Axis, Chart, Mark, Panel, Series};
use std::f64::consts::PI;

/// Reproducible noise without any distribution to speak of.
pub fn noise(i: usize) -> f64 {
    let x = (i as f64 * 12.9898).sin() * 43_758.547;
    2.0 * (x - x.floor()) - 1.0
}

/// A hysteresis loop: angle in mrad, moment in N·m.
fn cycle(count: usize) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
    let at = |i: usize| 6.0 * PI * i as f64 / count as f64;
    let moment = |i: usize| 1500.0 * at(i).sin();
    let angle =
        |i: usize| moment(i) / 3140.0 - 0.045 * at(i).cos() + 0.02 * (moment(i) / 90.0).tanh();
    let measured = (0..count).map(|i| [angle(i) + 0.008 * noise(i), moment(i)]);
    (
        measured.collect(),
        (0..count).map(|i| [angle(i), moment(i)]).collect(),
    )
}

fn hysteresis() -> Chart {
    let (measured, model) = cycle(2000);
    let panel = Panel::new(Axis::new("Angle", "mrad"), Axis::new("Moment", "N·m"))
        .with(Series::points("measured", measured))
        .with(Series::line("model: spring, backlash, hysteresis", model))
        .with(Series::dashed(
            "straight line of a textbook",
            vec![[-0.5, -1500.0], [0.5, 1500.0]],
        ));
    let caption = "Three load cycles of the drive of A6 and the fitted model. The loop is open by \
                   hysteresis; the step near zero load is the backlash of the gear.";
    Chart::new("a6-loop", "Moment over angle, drive of A6", caption)
        .with(panel)
        .synthetic(true)
}

fn residuals() -> Chart {
    let (measured, model) = cycle(2000);
    let rest = |i: usize| measured[i][0] - model[i][0];
    let indices = || 0..measured.len();
    let y = || Axis::new("Residual", "µrad");
    let over =
        |x: &dyn Fn(usize) -> f64| indices().map(|i| [x(i), 1e3 * rest(i)]).collect::<Vec<_>>();
    let bins = (-8..8).map(|k| {
        [
            f64::from(k),
            (80.0 * (-0.1 * f64::from(k * k)).exp()).round(),
        ]
    });
    let chart = Chart::new(
        "a6-residual",
        "What the model leaves",
        "No structure remains.",
    )
    .with(
        Panel::new(Axis::new("Moment", "N·m"), y())
            .with(Series::points("residual", over(&|i| model[i][1])))
            .noted("over load"),
    )
    .with(
        Panel::new(Axis::new("Time", "s"), y())
            .with(Series::line("residual in time", over(&|i| i as f64 * 0.03))),
    );
    let count = Axis::new("Count", "");
    chart.with(Panel::new(y(), count).with(Series::new("histogram", Mark::Bars, bins.collect())))
}

fn response(frequency: f64, stiffer: f64) -> [f64; 2] {
    let modes = [
        (12.0, 0.03, 1.0),
        (22.0 * stiffer, 0.02, 0.6),
        (38.0, 0.015, 0.3),
    ];
    let mut sum = [0.0, 0.0];
    for (at, damping, size) in modes {
        let r: f64 = frequency / at;
        let (re, im) = (1.0 - r * r, 2.0 * damping * r);
        let scale = size * r * r / (re * re + im * im);
        sum = [sum[0] - scale * re, sum[1] + scale * im];
    }
    sum
}

fn frf() -> Chart {
    let lines: Vec<f64> = (1..=500).map(|i| 0.1 * f64::from(i)).collect();
    let over =
        |value: &dyn Fn(f64) -> f64| lines.iter().map(|&f| [f, value(f)]).collect::<Vec<_>>();
    let size = |stiffer: f64| {
        move |f: f64| {
            response(f, stiffer)
                .map(|v| v * v)
                .iter()
                .sum::<f64>()
                .sqrt()
        }
    };
    let phase = |stiffer: f64| {
        move |f: f64| {
            let [re, im] = response(f, stiffer);
            im.atan2(re).to_degrees()
        }
    };
    let wide = |f: f64| 0.06 + 0.3 / f;
    let x = || Axis::new("Frequency", "Hz");
    let band = lines
        .iter()
        .map(|&f| size(1.0)(f))
        .zip(&lines)
        .map(|(m, &f)| [m * (1.0 - wide(f)).max(0.05), m * (1.0 + wide(f))]);
    let magnitude = Panel::new(x(), Axis::new("|H|", "m/(s²·N)").log())
        .with(Series::line("measured, 95 % band", over(&size(1.0))).between(band.collect()))
        .with(Series::dashed("simulated before", over(&size(0.9))))
        .with(Series::line("simulated after", over(&size(1.003))).emphasised());
    let phases = Panel::new(x(), Axis::new("Phase", "°"))
        .with(Series::line("measured, 95 % band", over(&phase(1.0))))
        .with(Series::dashed("simulated before", over(&phase(0.9))))
        .with(Series::line("simulated after", over(&phase(1.003))).emphasised());
    let coherence = Panel::new(x(), Axis::new("Coherence", "")).with(Series::line(
        "measured, 95 % band",
        over(&|f| 1.0 - 0.4 / (1.0 + f) - 0.02 * (noise((f * 10.0) as usize)).abs()),
    ));
    Chart::new(
        "frf-xx",
        "Accelerance H_xx at the tool",
        "Measured with five hits; simulated before and after tuning.",
    )
    .with(magnitude)
    .with(phases)
    .with(coherence)
}

fn points() -> Chart {
    let value = |k: usize, p: usize| 0.4 + 0.1 * ((p * 7 + k * 3) % 9) as f64;
    let bars = |name: &str, k: usize| {
        let values: Vec<f64> = (0..9).map(|p| value(k, p)).collect();
        Series::bars(name, &values).between(values.iter().map(|v| [v - 0.04, v + 0.04]).collect())
    };
    let panel = Panel::new(
        Axis::new("Point of the workspace", ""),
        Axis::new("Stiffness in y", "N/µm"),
    )
    .over((1..=9).map(|p| format!("P{p}")))
    .with(bars("measured", 0))
    .with(bars("simulated", 1))
    .with(bars("simulated without tilt", 2));
    Chart::new(
        "nine-points",
        "Stiffness at nine points",
        "Without tilt the simulation is too stiff.",
    )
    .with(panel)
}

fn few() -> Chart {
    let at = |k: f64| {
        (0..12)
            .map(|i| [f64::from(i), k * f64::from(i) + noise(i as usize)])
            .collect::<Vec<_>>()
    };
    let ends = |k: f64| at(k).iter().map(|p| [p[1] - 0.8, p[1] + 0.8]).collect();
    let panel = Panel::new(Axis::new("Target", "mm"), Axis::new("Error", "m"))
        .with(Series::points(
            "forward",
            at(1e-6).iter().map(|p| [p[0], p[1] * 1e-6]).collect(),
        ))
        .with(Series::points(
            "backward",
            at(3.0).iter().map(|p| [p[0], p[1] * 1e-6]).collect(),
        ))
        .with(Series::points(
            "third",
            at(1.0).iter().map(|p| [p[0], p[1] * 1e-6]).collect(),
        ))
        .with(Series::points(
            "fourth",
            at(2.0).iter().map(|p| [p[0], p[1] * 1e-6]).collect(),
        ))
        .with(Series::points(
            "fifth",
            at(4.0).iter().map(|p| [p[0], p[1] * 1e-6]).collect(),
        ))
        .with(Series::dotted("dotted", vec![[0.0, 0.0], [12.0, 4e-5]]));
    let with_ends = Panel::new(Axis::new("Target", "mm"), Axis::new("Error", "µm"))
        .with(Series::points("with whiskers", at(1.0)).between(ends(1.0)))
        .with(Series::band(
            "region",
            &[[0.0, -1.0, 2.0], [11.0, 9.0, 14.0]],
        ));
    Chart::new("few", "Few <points> & marks", "")
        .with(panel)
        .with(with_ends)
}

fn causes() -> Chart {
    let names = [
        "unexplained remainder",
        "hysteresis A6",
        "sensor offset",
        "thermal drift",
        "lever arm",
        "cosine error",
        "cubic stiffness A6",
        "creep",
        "last",
    ];
    let panel = Panel::new(Axis::new("", ""), Axis::new("Gain on held-out cycles", "%"))
        .over(names)
        .with(Series::bars(
            "",
            &[94.0, 3.0, 0.5, -0.4, 0.1, 0.0, -1.0, f64::NAN, 2.0],
        ));
    Chart::new("causes", "What each cause explains", "").with(panel)
}

/// Every figure of the gallery.
pub fn all() -> Vec<Chart> {
    vec![causes(), hysteresis(), residuals(), frf(), points(), few()]
}
