use super::*;
use crate::experiments::resonance::Resonance;

fn scene(low_pass: bool) -> (CutScene, [f64; UNKNOWNS]) {
    let cut = Cut {
        spindle_rad_s: 600.0,
        feed_m_s: 0.03,
        depth_m: 2.5e-3,
        width_m: 5e-3,
        side: Side::Down,
    };
    let scene = CutScene {
        tool: Tool::square(8e-3, 3, 0.5),
        cut,
        time: (0..400).map(|i| 5.3e-5 * f64::from(i)).collect(),
        low_pass,
        resonant: None,
        shorter: Vec::new(),
        chipped: Vec::new(),
        chipped_to_m: 0.0,
        slice_rad: crate::cutting::tool::FINE,
    };
    let k = [800e6, 300e6, 100e6, 20e3, 25e3, 3e3];
    let mut p = [0.0; UNKNOWNS];
    p[..6].copy_from_slice(&k);
    p[RUNOUT..].copy_from_slice(&[6e-6, -4e-6, 900.0_f64.ln(), 0.4, 1e-4, 5e-3, 0.5]);
    (scene, p)
}

fn resonant(axes: [bool; 3], instead: bool) -> Resonant {
    Resonant {
        resonance: Resonance {
            at: [700.0, 0.05],
            instead,
        },
        axes,
        share: 0.9,
    }
}

#[test]
fn slopes_are_those_of_differences() {
    let sensors = [
        (true, None),
        (false, None),
        (true, Some(resonant([false, true, false], false))),
        (true, Some(resonant([true; 3], true))),
        (false, Some(resonant([true; 3], false))),
    ];
    for (low_pass, resonant) in sensors {
        let (mut scene, p) = scene(low_pass);
        scene.resonant = resonant;
        let at = scene.predict(&p);
        let steps = [
            // of the runout little: a tip that enters or leaves between two places has no slope there
            1e6, 1e6, 1e6, 1e2, 1e2, 1e2, 1e-9, 1e-9, 1e-4, 1e-5, 1e-7, 1e-7, 1e-2,
        ];
        for j in 0..UNKNOWNS {
            let moved = |s: f64| {
                let mut p = p;
                p[j] += s * steps[j];
                scene.predict(&p).force
            };
            let (up, down) = (moved(1.0), moved(-1.0));
            let size = at.slopes[j].iter().flatten().map(|v| v * v).sum::<f64>();
            let mut off = 0.0;
            for i in 0..at.force.len() {
                for k in 0..3 {
                    let d = (up[i][k] - down[i][k]) / (2.0 * steps[j]);
                    off += (d - at.slopes[j][i][k]).powi(2);
                }
            }
            assert!(
                size == 0.0 && off == 0.0 || off.sqrt() < 0.05 * size.sqrt(),
                "{j} {low_pass} {resonant:?}: {off} {size}"
            );
        }
    }
}

#[test]
fn forces_alone_are_the_same() {
    for low_pass in [true, false] {
        let (mut scene, p) = scene(low_pass);
        scene.resonant = low_pass.then(|| resonant([true, false, false], false));
        let (alone, with) = (scene.force(&p), scene.predict(&p).force);
        let pairs = alone.iter().flatten().zip(with.iter().flatten());
        assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-9));
    }
}

#[test]
fn a_wide_low_pass_changes_nothing_and_keeps_the_mean() {
    let (mut scene, mut p) = scene(true);
    p[BANDWIDTH] = 2e5_f64.ln();
    let wide = scene.predict(&p);
    scene.low_pass = false;
    let ideal = scene.predict(&p);
    let rms = |f: &dyn Fn(usize) -> f64| (0..400).map(|i| f(i).powi(2)).sum::<f64>().sqrt();
    let off = rms(&|i| wide.force[i][1] - ideal.force[i][1]);
    assert!(off < 0.02 * rms(&|i| ideal.force[i][1]), "{off}");
}

#[test]
fn a_revolution_is_sampled_finely_enough() {
    let mut worst: f64 = 0.0;
    for (helix_deg, teeth, width) in [
        (0.0, 2, 1e-3),
        (30.0, 3, 5e-3),
        (45.0, 4, 2e-3),
        (5.0, 1, 8e-3),
    ] {
        for corner in [150.0, 900.0, 3500.0] {
            let (mut scene, mut p) = scene(true);
            scene.tool = Tool::square(8e-3, teeth, f64::to_radians(helix_deg));
            (p[WIDTH], p[BANDWIDTH]) = (width, f64::ln(corner));
            let enough = scene.grid(&p);
            let read = |grid: usize| scene.read_of(&p, grid, |chip| chip);
            let (here, fine) = (read(enough), read(8 * GRID_MOST));
            let size = |of: &dyn Fn(usize, usize) -> f64| {
                let all = (0..here.len()).flat_map(|i| (0..3).map(move |k| (i, k)));
                all.map(|(i, k)| of(i, k).powi(2)).sum::<f64>().sqrt()
            };
            let off = size(&|i, k| here[i][k] - fine[i][k]) / size(&|i, k| fine[i][k]);
            worst = worst.max(off);
        }
    }
    assert!(worst < 1.2e-3, "{worst}");
}

#[test]
fn stamps_that_are_rounded_follow_a_clock() {
    let (mut scene, _) = scene(true);
    let at = |round: f64| (0..400).map(move |i| (f64::from(i) / 6400.0 / round).round() * round);
    scene.time = at(1e-5).collect();
    let step = scene.step_s().unwrap();
    assert!((step * 6400.0 - 1.0).abs() < 1e-3);
    scene.time[200..].iter_mut().for_each(|t| *t += step);
    assert_eq!(scene.step_s(), None);
}

#[test]
fn a_faster_spindle_takes_thinner_chips() {
    let (mut scene, mut p) = scene(false);
    p[3..RUNOUT + 2].fill(0.0);
    let mut mean = |speed: f64| {
        p[SPEED] = speed;
        let step = TAU / 720.0 / (600.0 * (1.0 + speed));
        scene.time = (0..720).map(|i| step * f64::from(i)).collect();
        scene.predict(&p).force.iter().map(|f| f[1]).sum::<f64>() / 720.0
    };
    let (stated, faster) = (mean(0.0), mean(0.02));
    assert!(
        (faster / stated * 1.02 - 1.0).abs() < 2e-3,
        "{faster} {stated}"
    );
}
