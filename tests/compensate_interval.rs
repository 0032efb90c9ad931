//! What is said about the rest of a corrected part, against plants drawn as uncertain as it is stated: every
//! stiffness, damping and coefficient by a tenth. `IDENT_COVERAGE_PLANTS=200` asks for more plants.

use crate::part_bench::{CORNER, SLOT, job, plant, ready};
use ident::compensation::limits::certainty;
use ident::compensation::method::{METHODS, with};
use ident::compensation::online::Sensor;
use ident::compensation::remaining::{Size, remaining};
use ident::compensation::shifted::shifted;
use ident::compensation::{Task, search};
use ident::ground::spatial::{norm, scale, sub};
use ident::ground::stats::Z95;
use ident::process::Milled;
use ident::process::setup::{Setup, Support};
use ident::process::uncertainty::{Moved, doubts};

/// Relative standard deviation of everything.
const SPREAD: f64 = 0.1;

fn stated(setup: Setup) -> Setup {
    known_to(setup, SPREAD)
}

fn known_to(mut setup: Setup, spread: f64) -> Setup {
    for (_, spring) in setup.robot.springs_mut() {
        let ends = |value: f64| [-1.0, 1.0].map(|z| value * (1.0 + z * Z95 * spread));
        spring.ci95.stiffness = Some(ends(spring.stiffness));
        spring.ci95.damping = Some(ends(spring.damping));
    }
    setup
}

#[test]
fn the_interval_of_what_is_left_holds_the_truth_and_yes_is_never_wrong() {
    let asked = std::env::var("IDENT_COVERAGE_PLANTS").ok();
    let plants: u64 = asked.and_then(|n| n.parse().ok()).unwrap_or(8);
    let first: u64 = std::env::var("IDENT_BLIND_SEED")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(1);
    let support = Support::Static;
    let folder = tempfile::tempdir().unwrap();
    let (planned, setup) = ready(&job(folder.path(), CORNER, 3000.0, ""));
    let setup = stated(setup);
    let task = Task {
        setup: &setup,
        truth: &setup,
        plan: &planned.plan,
        support,
        sensor: Sensor::default(),
        way_of: &|found| shifted(&planned.plan, found),
    };
    let found = search(&METHODS[0], &task).unwrap();
    let corrected = with(&setup, &planned.plan, &found.correction).unwrap();
    let milled = |setup: &Setup| setup.run(support, |_| {}).unwrap().0;
    let rest = |milled: &Milled| remaining(milled, &task.plan.path);
    let left = |setup: &Setup| rest(&milled(setup));
    let all = doubts(&setup.robot, &setup, &planned.coefficient_stds());
    let model = milled(&corrected);
    let moved = Moved::of(&corrected, support, &all).unwrap();
    let said = certainty(&corrected, &planned.plan.path, &moved, &rest(&model)).unwrap();
    let [low, high] = said.ci95.unwrap();
    let mut largest = Vec::new();
    for seed in 0..plants {
        let other = plant(&corrected, 1000 * first + seed, SPREAD, false);
        largest.push(Size::of(&left(&other)).max_m);
    }
    let held = largest.iter().filter(|x| (low..=high).contains(*x)).count();
    let above = largest.iter().filter(|x| **x > high).count();
    println!(
        "intervals: {held} of {plants} hold the largest deviation ({:.4} to {:.4} mm); {above} above",
        1e3 * low,
        1e3 * high
    );
    let next = said.next.as_ref().unwrap().high_after_m;
    assert!(next >= 0.99 * Size::of(&rest(&model)).max_m, "{next}");
    println!(
        "  most limited by {} of {}",
        said.limits[0].doubt.name, said.limits[0].doubt.site
    );
    assert!(held as f64 >= 0.8 * plants as f64);
    // "yes" is said where the upper end is within the tolerance: one in forty plants may lie above it
    assert!(above as f64 <= 0.05 * plants as f64 + 1.0);
    // the 97.5 % point of 4000 draws of other numbers scatters by some percent
    let known = said.limits.iter().all(|l| l.high_without_m <= 1.05 * high);
    assert!(known, "knowing a number cannot widen the interval");
    let next = said.next.unwrap();
    assert!(next.high_after_m < high, "{} of {high}", next.high_after_m);
}

/// Small doubts of springs are carried to first order: so much per share as larger ones that are simulated.
#[test]
fn small_doubts_do_what_simulations_say() {
    let folder = tempfile::tempdir().unwrap();
    let (_, setup) = ready(&job(folder.path(), SLOT, 3000.0, ""));
    let middle = 0.5 * (setup.way.span()[0] + setup.way.span()[1]);
    let of = |spread: f64| {
        let setup = known_to(setup.clone(), spread);
        let mut all = doubts(&setup.robot, &setup, &[]);
        all.retain(|doubt| doubt.name == "stiffness");
        let moved = Moved::of(&setup, Support::Static, &all).unwrap();
        let moved = moved.changes(&setup, &[middle]).unwrap();
        let share = |(moved, doubt): (&Vec<_>, &_)| {
            let doubt: &ident::process::uncertainty::Doubt = doubt;
            scale(1.0 / doubt.rel_std, moved[0])
        };
        moved.iter().zip(&all).map(share).collect::<Vec<_>>()
    };
    let (small, large) = (of(0.019), of(0.021));
    let largest = large.iter().map(|v| norm(*v)).fold(0.0, f64::max);
    assert!(largest > 1e-6, "{largest}");
    for (a, b) in small.iter().zip(&large) {
        assert!(
            norm(sub(*a, *b)) < 0.05 * largest,
            "{a:?} {b:?} of {largest}"
        );
    }
}
