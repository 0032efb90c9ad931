//! Several starts: from constants that are wrong by up to a factor of ten, most searches end in the
//! same place, whatever the number of threads.

use ident::experiments::hammer_frf::Settings;
use ident::fit::damping::{Account, Request, identify, test};
use ident::fit::frf_robot::Released;
use ident::fit::frf_tuning::Residuals;
use ident::ground::random::Random;
use ident::measurement::hammer::read_hammer;
use ident::robot::load;
use std::path::Path;

/// The example tuned from wrong constants by so many starts, with hits along z alone if asked for.
fn tuned(seed: u64, stiffness: bool, only_z: bool, starts: usize) -> Account {
    let mut random = Random::new(seed);
    let mut robot = load("kr210", None).unwrap().robot;
    for (_, spring) in robot.springs_mut() {
        spring.damping *= random.log_uniform(0.1, 10.0);
        if stiffness {
            spring.stiffness *= random.log_uniform(0.8, 1.25);
            spring.ci95.stiffness = None;
        }
    }
    let request = Request {
        settings: Settings {
            exponential_end: Some(0.01),
            ..Settings::default()
        },
        from_hz: 2.0,
        released: Released {
            stiffness,
            ..Released::default()
        },
        residuals: Residuals::None,
        starts,
    };
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210/hammer.csv");
    let mut test = test(&path, read_hammer(&path).unwrap(), &request.settings).unwrap();
    test.frf.inputs.retain(|i| !only_z || i.input == "z");
    identify(&[test], &robot, &request).unwrap()
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn most_starts_reach_the_same_place() {
    let cases = [
        (false, false, 1.0),
        (false, true, 1.0),
        (true, false, 0.75),
        (true, true, 0.75),
    ];
    for (stiffness, only_z, least) in cases {
        let share = tuned(77, stiffness, only_z, 8).tuned.agreeing_starts;
        println!("stiffness {stiffness}, z alone {only_z}: {share:.2} of the starts agree");
        assert!(share >= least, "{share}");
    }
}

#[test]
fn the_result_does_not_depend_on_the_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        pool.install(|| tuned(80, true, true, 2).tuned.values)
    };
    assert_eq!(on(1), on(2));
}
