//! What every effect of the contract can look like in a programme: the judge's coarse dictionary, by which it knows what no
//! data of this programme tell apart.

use super::course::skew;
use super::memory::{lag, play};
use super::programme::Programme;

/// A name and one set of columns that it may take, whatever their sizes.
pub type Rival = (&'static str, Vec<Vec<f64>>);

/// All of them, at the rows.
pub fn rivals(p: &Programme) -> Vec<Rival> {
    let mut all = single_valued(p);
    all.extend(remembering(p));
    all.extend(by_and_by(p));
    all.into_iter()
        .map(|(name, fine)| (name, fine.iter().map(|c| p.read(c)).collect()))
        .collect()
}

fn single_valued(p: &Programme) -> Vec<Rival> {
    let clip = |m: f64| p.of_load(|u| (u / m).clamp(-1.0, 1.0));
    let mut all = Vec::new();
    for m in [0.002, 0.008, 0.02, 0.04] {
        all.push(("backlash", vec![clip(m)]));
    }
    for m in [0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7] {
        all.push(("soft_zone", vec![clip(m)]));
        all.push(("soft_zone", vec![p.of_load(|u| (u / m).tanh())]));
    }
    for e in [0.5, 0.67, 0.8, 1.5, 2.0, 2.5, 3.0, 4.0] {
        all.push((
            "cubic_stiffness",
            vec![p.of_load(|u| u.signum() * u.abs().powf(e))],
        ));
    }
    if p.two_sided {
        all.push(("asymmetry", vec![p.of_load(f64::abs)]));
        all.push(("asymmetry", vec![p.of_load(|u| u * u)]));
        for at in [-0.3, -0.15, 0.15, 0.3] {
            all.push(("asymmetry", vec![p.of_load(|u| (u - at).max(0.0))]));
        }
    }
    all
}

fn remembering(p: &Programme) -> Vec<Rival> {
    let plays: Vec<Vec<f64>> = [0.04, 0.08, 0.14, 0.22, 0.32, 0.45, 0.65]
        .iter()
        .map(|r| play(&p.u, |_| *r))
        .collect();
    let mut all = Vec::new();
    for (i, own) in plays.iter().enumerate() {
        all.push(("coulomb_friction", vec![own.clone()]));
        for other in &plays[i + 1..] {
            all.push(("hysteresis", vec![own.clone(), other.clone()]));
        }
    }
    let taus = [0.0005, 0.0015, 0.004, 0.01, 0.03, 0.08, 0.2, 0.5];
    let lags: Vec<Vec<f64>> = taus.iter().map(|t| lag(p, t * p.last())).collect();
    for pair in lags.windows(2) {
        all.push(("creep", pair.to_vec()));
    }
    for size in [0.01, 0.03, 0.1, 0.3] {
        all.push(("time_skew", vec![skew(p, 0, false, size)]));
        all.push(("time_skew", vec![skew(p, 1, false, size)]));
    }
    all
}

fn by_and_by(p: &Programme) -> Vec<Rival> {
    let work = p.work();
    let loaded =
        |grown: &[f64]| -> Vec<f64> { grown.iter().zip(&p.u).map(|(g, u)| g * u).collect() };
    let mut all = vec![
        ("sensor_offset", vec![vec![1.0; p.u.len()]]),
        (
            "thermal_drift",
            vec![
                p.of_time(|t| t),
                p.of_time(|t| t * t),
                p.of_time(|t| t.powi(3)),
            ],
        ),
        (
            "thermal_drift",
            vec![p.of_time(|t| 1.0 - (-t / 0.1).exp()), p.of_time(|t| t)],
        ),
        ("loosening", vec![loaded(&work)]),
        ("loosening", vec![loaded(&p.of_time(|t| t))]),
        (
            "loosening",
            vec![loaded(
                &work
                    .iter()
                    .map(|w| 1.0 - (-w / 0.2).exp())
                    .collect::<Vec<_>>(),
            )],
        ),
    ];
    for i in 1..30 {
        let at = f64::from(i) / 30.0;
        all.push(("slip", vec![p.of_time(|t| f64::from(u8::from(t > at)))]));
        if i % 3 == 0 {
            let stepped: Vec<f64> = work.iter().map(|w| f64::from(u8::from(*w > at))).collect();
            all.push(("loosening", vec![loaded(&stepped)]));
        }
    }
    all
}
