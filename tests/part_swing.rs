//! Parts milled by a robot that swings: what a soft spring, a gap and a lagging controller do to the swing is told.
//!
//! The plant is milled in time with the cause in it by the program's own cut, so that this is an upper bound; the gap's and the lag's laws
//! and the probe, which meets the surface where the tool passes the place, are of this file.

use crate::part_bench::{OUTLINE, job, ready};
use ident::findings::kinds;
use ident::findings::{Answer, Verdict};
use ident::ground::random::Random;
use ident::ground::spatial::{V3, add, dot, sub};
use ident::process::Way;
use ident::process::setup::{Setup, Support};
use ident::process::way::Row;
use ident::robot::write::labelled;
use std::fmt::Write as _;
use std::path::Path;

const PROBE_MM: f64 = 0.003;
/// Share of its dampings that the robot has: it swings for a third of a second.
const LIGHT: f64 = 0.3;

/// The job of a robot that is lightly damped.
fn light(folder: &Path) -> Setup {
    let stated = job(folder, OUTLINE, 3000.0, "");
    let mut robot = ready(&stated).1.robot;
    robot
        .springs_mut()
        .for_each(|(_, spring)| spring.damping *= LIGHT);
    std::fs::write(folder.join("light.toml"), labelled(&robot, true)).unwrap();
    let text = std::fs::read_to_string(&stated).unwrap();
    let text = text.replace("robot = \"kr210\"", "robot = \"light.toml\"");
    std::fs::write(&stated, text).unwrap();
    ready(&stated).1
}

/// What a probe finds at every millimetre and a half of the nominal path where the plant cuts.
fn probed(plant: &Setup, nominal: &Setup) -> String {
    let mut random = Random::new(7);
    let (milled, _) = plant.run(Support::Coupled, |_| {}).unwrap();
    let tool: Vec<V3> = milled
        .course
        .iter()
        .map(|c| add(c.tip, c.deviation))
        .collect();
    let mut text = format!(
        "# kind = \"milled-part\"\n# synthetic = true\n# job = \"job.toml\"\n# probe_noise_mm = {PROBE_MM}\n\
         # datum_std_mm = 0.01\ns_mm,dx_mm,dy_mm,dz_mm\n"
    );
    let mut last = 0.0;
    for row in nominal.way.rows() {
        if row.s_m < last + 1.5e-3 {
            continue;
        }
        let Some(feed) = nominal.way.feed(row.time_s) else {
            continue;
        };
        let passes = |i: &usize| {
            let behind = |p: V3| dot(sub(p, row.tip), feed);
            behind(tool[*i]) <= 0.0 && behind(tool[i + 1]) > 0.0
        };
        let far = |i: &usize| (milled.course[*i].time_s - row.time_s).abs();
        let crossing = (0..tool.len() - 1).filter(passes);
        let crossing = crossing.min_by(|a, b| far(a).total_cmp(&far(b)));
        let Some(i) = crossing.filter(|i| far(i) < 0.15 && milled.course[*i].cutting) else {
            continue;
        };
        last = row.s_m;
        let [before, after] = [i, i + 1].map(|i| sub(tool[i], row.tip));
        let share = dot(before, feed) / (dot(before, feed) - dot(after, feed));
        let d: [f64; 3] = std::array::from_fn(|k| {
            1e3 * (before[k] + share * (after[k] - before[k])) + PROBE_MM * random.normal()
        });
        writeln!(
            text,
            "{:.4},{:.5},{:.5},{:.5}",
            1e3 * row.s_m,
            d[0],
            d[1],
            d[2]
        )
        .unwrap();
    }
    text
}

fn diagnosed(folder: &Path, text: &str) -> Answer {
    let path = folder.join("part.csv");
    std::fs::write(&path, text).unwrap();
    let (_, diagnose) = kinds::kind(&path).unwrap();
    diagnose(&path).unwrap().answer().clone()
}

/// The answer about a part that such a plant has milled, beside the lightly damped robot that its job states.
fn told_of(change: impl FnOnce(&mut Setup)) -> Answer {
    let folder = tempfile::tempdir().unwrap();
    let nominal = light(folder.path());
    let mut plant = nominal.clone();
    change(&mut plant);
    diagnosed(folder.path(), &probed(&plant, &nominal))
}

/// The one cause that is named, and the first of its parameters.
fn alone(answer: &Answer) -> (&'static str, String, f64) {
    let said: Vec<_> = answer
        .causes
        .iter()
        .map(|c| (c.effect, &c.site, c.probability))
        .collect();
    assert_eq!(answer.verdict, Verdict::Explained, "{said:?}");
    assert_eq!(said.len(), 1, "{said:?}");
    let cause = &answer.causes[0];
    (cause.effect, cause.site.clone(), cause.parameters[0].1)
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_soft_drive_is_told_from_what_it_does_to_the_swing() {
    let mut right = 0.0;
    let answer = told_of(|plant| {
        let drive = plant.robot.springs_mut().find(|(name, _)| name == "A2");
        let stiffness = &mut drive.unwrap().1.stiffness;
        *stiffness *= 0.5;
        right = *stiffness;
    });
    let (effect, site, value) = alone(&answer);
    assert_eq!((effect, &site[..]), ("drive_stiffness", "A2"));
    assert!((value / right - 1.0).abs() < 0.05, "{value} for {right}");
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_gap_is_told_by_the_part_as_it_is_milled_with_it() {
    let answer = told_of(|plant| {
        plant.robot.joints[0].drive.as_mut().unwrap().backlash = vec![3.2e-4];
    });
    let (effect, site, gap) = alone(&answer);
    assert_eq!((effect, &site[..]), ("backlash", "A1"));
    assert!((gap / 3.2e-4 - 1.0).abs() < 0.1, "{gap}");
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_controller_that_lags_swings_less_and_is_told() {
    let answer = told_of(|plant| plant.way = lagging(&plant.way, 0.017));
    let (effect, _, tau) = alone(&answer);
    assert_eq!(effect, "corner_lag");
    assert!((0.012..0.024).contains(&tau), "{tau}");
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_sound_robot_that_swings_is_left_alone() {
    let answer = told_of(|_| {});
    assert_eq!(answer.verdict, Verdict::Sufficient);
    assert!(answer.causes.is_empty() && answer.groups.is_empty());
}

/// Joints and tip that follow by a lag of the first order: x' = (u − x)/τ, by Euler steps much shorter than it.
fn lagging(way: &Way, tau: f64) -> Way {
    let mut last: Option<Row> = None;
    let follow = |row: &Row| {
        let mut now = row.clone();
        if let Some(last) = &last {
            let steps = 50;
            let share = (row.time_s - last.time_s) / (f64::from(steps) * tau);
            let run = |from: f64, to: f64| (0..steps).fold(from, |x, _| x + share * (to - x));
            now.tip = std::array::from_fn(|k| run(last.tip[k], row.tip[k]));
            now.joints = (0..6).map(|j| run(last.joints[j], row.joints[j])).collect();
        }
        last = Some(now.clone());
        now
    };
    Way::new(way.rows().iter().map(follow).collect()).unwrap()
}
