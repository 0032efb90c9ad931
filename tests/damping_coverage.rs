//! Intervals of dampings on simulated campaigns: time integration of the robot, which shares no code
//! with spectra, linearised model or tuning, at random poses with random dampings and real noise.

use ident::experiments::hammer_force::ForceWindow;
use ident::experiments::hammer_frf::Settings;
use ident::fit::damping::{Request, identify, test};
use ident::fit::frf_robot::Released;
use ident::fit::frf_tuning::Residuals;
use ident::fit::parameter::Status;
use ident::ground::random::Random;
use ident::laboratory::truth::Truth;
use ident::measurement::hammer::read_hammer;
use ident::robot::load;
use std::collections::BTreeMap;
use std::path::Path;

/// How many campaigns: 4, or as many as `IDENT_COVERAGE_CAMPAIGNS` says.
fn campaigns() -> u64 {
    let asked = std::env::var("IDENT_COVERAGE_CAMPAIGNS").ok();
    asked.and_then(|n| n.parse().ok()).unwrap_or(4)
}

/// The hammer test of the example with other dampings, pose and noise.
fn truth(seed: u64) -> Truth {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210/truth.toml");
    let mut truth = Truth::read(&path).unwrap();
    let mut random = Random::new(seed);
    truth.seed = seed;
    truth.load_cycle.clear();
    let hammer = truth.hammer.as_mut().unwrap();
    hammer.file.truncate(1);
    hammer.instrument.steps = 8;
    hammer.instrument.accelerometer_noise = random.log_uniform(0.003, 0.1);
    hammer.instrument.force_noise = random.log_uniform(0.03, 1.0);
    let spread = |angle: &mut f64| *angle += random.uniform(-15.0, 15.0);
    hammer.joint_angles_deg.iter_mut().for_each(spread);
    hammer
        .damping
        .values_mut()
        .for_each(|d| *d *= random.log_uniform(0.6, 1.6));
    truth
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn intervals_of_dampings_cover_the_truth() {
    let folder = tempfile::tempdir().unwrap();
    let request = Request {
        settings: Settings {
            exponential_end: Some(0.01),
            force_window: ForceWindow::Quiet,
            ..Settings::default()
        },
        from_hz: 2.0,
        released: Released::default(),
        residuals: Residuals::None,
        starts: 8,
    };
    let robot = load("kr210", None).unwrap().robot;
    let (mut inside, mut all, mut open) = (0, 0, 0);
    let mut chi_squares = Vec::new();
    for seed in 1..=campaigns() {
        let truth = truth(seed);
        let path = folder.path().join("hammer.csv");
        let files = truth.record().unwrap();
        let hammer = files
            .iter()
            .find(|f| f.0.as_os_str() == "hammer.csv")
            .unwrap();
        std::fs::write(&path, &hammer.1).unwrap();
        let tests = [test(&path, read_hammer(&path).unwrap(), &request.settings).unwrap()];
        let account = identify(&tests, &robot, &request).unwrap();
        let known: &BTreeMap<String, f64> = &truth.hammer.as_ref().unwrap().damping;
        println!(
            "campaign {seed}: chi² {:.2}",
            account.tuned.reduced_chi_square
        );
        chi_squares.push(account.tuned.reduced_chi_square);
        for parameter in &account.parameters {
            if parameter.status != Status::Identified {
                open += 1;
                continue;
            }
            let ([low, high], truth) = (parameter.ci95.unwrap(), known[&parameter.site]);
            let hit = (low..=high).contains(&truth);
            (all, inside) = (all + 1, inside + usize::from(hit));
            if !hit {
                let value = parameter.value.unwrap();
                println!(
                    "  {}: {:+.2} %, interval ± {:.2} %",
                    parameter.site,
                    100.0 * (value / truth - 1.0),
                    50.0 * (high - low) / truth
                );
            }
        }
    }
    println!("{inside} of {all} intervals hold the truth; {open} constants not fixed");
    let mean = chi_squares.iter().sum::<f64>() / chi_squares.len() as f64;
    println!("mean chi² {mean:.3}");
    assert!(inside as f64 >= 0.9 * all as f64);
    // 1 is noise alone; a little less, as the variance has a floor that exact data do not reach.
    assert!((0.75..1.15).contains(&mean), "{chi_squares:?}");
    assert!(chi_squares.iter().all(|chi| (0.45..1.5).contains(chi)));
}
