//! A survey on the links of a robot beside its simulated modes: movements by a product of exponentials of the
//! test's own, responses as a sum of modes, links by geometry and as stated.

use crate::bench_of_files::Bench;
use crate::survey_bench::{LINES, MILLIMETRES, Point, STEP_HZ, block, node_2411, response, trace};
use ident::ground::random::Random;
use ident::motion::modes::{complex_modes, modal};
use ident::motion::skeleton::skeleton;
use ident::motion::statics::springs;
use ident::motion::{Chain, Work, elastic, linearise};
use ident::robot::Robot;
use ident::robot::load::load;
use rustfft::num_complex::Complex64;
use serde_json::Value;
use std::f64::consts::TAU;

type V3 = [f64; 3];
const JOINTS_DEG: [f64; 6] = [10.0, -80.0, 95.0, 20.0, 40.0, 5.0];

fn cross(a: V3, b: V3) -> V3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// A point turned about a line by Rodrigues' formula.
fn turned(p: V3, axis: V3, through: V3, angle: f64) -> V3 {
    let d: V3 = std::array::from_fn(|k| p[k] - through[k]);
    let (sin, cos) = angle.sin_cos();
    let along: f64 = (0..3).map(|k| axis[k] * d[k]).sum();
    let across = cross(axis, d);
    std::array::from_fn(|k| {
        through[k] + d[k] * cos + across[k] * sin + axis[k] * along * (1.0 - cos)
    })
}

/// Hinges of a chain at zero: axes and points; how many lie before the end of link k.
struct Exponentials {
    axes: Vec<V3>,
    points: Vec<V3>,
    ends: Vec<usize>,
}

impl Exponentials {
    fn of(robot: &Robot, chain: &Chain) -> Self {
        let mut ends: Vec<usize> = (0..robot.joints.len())
            .map(|k| chain.drives[k] - if robot.joints[k].tilt.is_some() { 2 } else { 0 })
            .collect();
        ends.push(chain.len());
        Self {
            axes: chain.hinges.iter().map(|hinge| hinge.axis).collect(),
            points: chain.points_at_zero(),
            ends,
        }
    }

    /// Where a point of link k that is at `p` at angles `q` goes when they become `moved`.
    fn carried(&self, link: usize, p: V3, q: &[f64], moved: &[f64]) -> V3 {
        let back =
            (0..self.ends[link]).fold(p, |p, i| turned(p, self.axes[i], self.points[i], -q[i]));
        (0..self.ends[link]).rev().fold(back, |p, i| {
            turned(p, self.axes[i], self.points[i], moved[i])
        })
    }
}

/// Points beside every link: node, link, place. The last ones are on the wrist, where nearness tells nothing.
fn points(line: &[V3]) -> Vec<(Point, usize)> {
    let mut all = Vec::new();
    for link in 0..line.len() - 1 {
        let (from, to) = (line[link], line[link + 1]);
        for (k, share) in [0.3, 0.5, 0.7].into_iter().enumerate() {
            let aside = [[0.03, 0.02, 0.0], [0.0, 0.03, 0.02], [0.02, 0.0, -0.03]][k];
            let at = std::array::from_fn(|i| from[i] + share * (to[i] - from[i]) + aside[i]);
            let node = 10 * (link as i64 + 1) + k as i64;
            all.push((
                Point {
                    node,
                    storey: 0,
                    at,
                    lever: 1.0,
                },
                link.min(6),
            ));
        }
    }
    all
}

fn laboratory(links: &str) -> (Bench, usize) {
    let robot = load("kr210", None).unwrap().robot;
    let joints = JOINTS_DEG.map(f64::to_radians);
    let chain = elastic(&robot);
    let q = chain.spread(&joints);
    let linear = linearise(&chain, &mut Work::new(&chain), &q).unwrap();
    let mut modes = complex_modes(&linear, &modal(&linear).unwrap());
    modes.retain(|mode| mode.damping_ratio < 0.9 && mode.frequency_hz < 60.0);
    let own = Exponentials::of(&robot, &chain);
    let points = points(&skeleton(&robot, &joints).line);
    let hinges: Vec<usize> = springs(&chain).map(|(i, _)| i).collect();
    let shape = |mode: &ident::motion::modes::Mode, (point, link): &(Point, usize)| -> V3 {
        let h = 1e-6;
        let at = |by: f64| {
            let mut moved = q.clone();
            hinges
                .iter()
                .zip(&mode.shape)
                .for_each(|(i, s)| moved[*i] += by * s);
            own.carried(*link, point.at, &q, &moved)
        };
        let (up, down) = (at(h), at(-h));
        std::array::from_fn(|k| 0.5 * (up[k] - down[k]) / h)
    };
    let shapes: Vec<Vec<V3>> = modes
        .iter()
        .map(|m| points.iter().map(|p| shape(m, p)).collect())
        .collect();
    let mut text = MILLIMETRES.to_string();
    text += &block(
        2411,
        &points.iter().map(|p| node_2411(&p.0)).collect::<String>(),
    );
    text += &trace(1, &points.iter().map(|p| p.0.node).collect::<Vec<_>>());
    let (hit, mut random) = (points.len() - 1, Random::new(4));
    for axis in 0..3 {
        for (p, (point, _)) in points.iter().enumerate() {
            for o in 0..3 {
                let value = |k: usize| {
                    let s = Complex64::new(0.0, TAU * STEP_HZ * k as f64);
                    let part = |(m, shape): (&ident::motion::modes::Mode, &Vec<V3>)| {
                        let w = TAU * m.frequency_hz;
                        shape[p][o] * shape[hit][axis] * s * s
                            / (s * s + 2.0 * m.damping_ratio * w * s + w * w)
                    };
                    modes.iter().zip(&shapes).map(part).sum::<Complex64>()
                };
                let mut values: Vec<Complex64> = (0..LINES).map(value).collect();
                let size =
                    (values.iter().map(Complex64::norm_sqr).sum::<f64>() / LINES as f64).sqrt();
                values.iter_mut().for_each(|v| {
                    *v += 0.01 * size * Complex64::new(random.normal(), random.normal())
                });
                text += &response(
                    [
                        (point.node, o as i64 + 1),
                        (points[hit].0.node, axis as i64 + 1),
                    ],
                    &values,
                );
            }
        }
    }
    let bench = Bench::new();
    bench.put("robot.unv", text.as_bytes());
    let facts = format!(
        "robot = \"kr210\"\nsynthetic = true\njoint_angles_deg = {JOINTS_DEG:?}\n{links}\n"
    );
    bench.put("robot.ident.toml", facts.as_bytes());
    let low = modes.iter().filter(|mode| mode.frequency_hz < 30.0).count();
    (bench, low)
}

#[test]
fn every_measured_mode_finds_its_simulated_one() {
    let (bench, count) = laboratory("survey_origin_mm = [0, 0, 0]\nlinks = { A6 = [70, 71, 72] }");
    let ran = bench.run(&["survey", "robot.unv", "--to-Hz", "30", "--json"]);
    assert!(ran.status < 2, "{}", ran.errors);
    let answer: Value = serde_json::from_str(&ran.out).unwrap();
    let found = answer["modes"].as_array().unwrap().len();
    let pairs = answer["robot"]["pairs"].as_array().unwrap();
    println!(
        "{count} modes, {found} found: {pairs:?}\n{}",
        answer["remarks"]
    );
    // Beyond 30 Hz the modes overlap (4 % damping, 1.4 Hz apart), and not all of them come back with this noise.
    assert_eq!((found, pairs.len()), (count, count));
    for pair in pairs {
        assert!(pair["mac"].as_f64().unwrap() > 0.99, "{pair}");
        let m = &answer["modes"][pair["measured"].as_u64().unwrap() as usize]["frequency_Hz"];
        let s =
            &answer["robot"]["modes"][pair["simulated"].as_u64().unwrap() as usize]["frequency_Hz"];
        assert!((m.as_f64().unwrap() / s.as_f64().unwrap() - 1.0).abs() < 0.01);
    }
    // What geometry decides is right, and what it cannot decide it leaves open.
    for link in answer["robot"]["links"].as_array().unwrap() {
        let node = link["node"].as_u64().unwrap();
        let truth = (node / 10 - 1).min(6);
        if let Some(told) = link["link"].as_u64() {
            assert_eq!(told, truth, "{link}");
        }
        assert_eq!((70..73).contains(&node), link["by"] == "stated", "{link}");
    }
    let page = bench.text("reports/robot-survey.html");
    assert!(page.contains("Beside the simulation") && page.contains("certain"));
    assert!(bench.path("reports/survey-mac-simulated.svg").is_file());
    if let Some(kept) = std::env::var_os("IDENT_KEEP_SURVEY") {
        for name in ["robot-survey.html", "survey-mac-simulated.svg"] {
            std::fs::copy(
                bench.path(&format!("reports/{name}")),
                std::path::Path::new(&kept).join(name),
            )
            .unwrap();
        }
    }
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn what_is_not_certain_is_refused() {
    let says = |links: &str, told: &str| {
        let (bench, _) = laboratory(links);
        let ran = bench.run(&[
            "survey",
            "robot.unv",
            "--to-Hz",
            "60",
            "--robot",
            "kr210",
            "--dry-run",
        ]);
        assert_eq!(ran.status, 2, "{links}: {}", ran.out);
        assert!(
            ran.errors.contains(told) && ran.errors.contains("help:"),
            "{told}: {}",
            ran.errors
        );
    };
    says("", "how the survey lies to the robot is not stated");
    says(
        "survey_origin_mm = [0, 0, 0]\nlinks = { A9 = [10] }",
        "`A9` is no link of the robot",
    );
    says(
        "survey_origin_mm = [0, 0, 0]\nlinks = { A1 = [10], A2 = [10] }",
        "node 10 is on `A1` and on `A2`",
    );
    says(
        "survey_origin_mm = [0, 0, 0]\nlinks = { A1 = [999] }",
        "node 999 is not in the survey",
    );
    says("survey_origin_mm = [9000, 0, 0]", "was certain for 0 of");
    let (bench, _) = laboratory("");
    let ran = bench.run(&["survey", "robot.unv", "--to-Hz", "60", "--dry-run"]);
    assert!(
        ran.status < 2 && ran.errors.contains("not held beside the simulation"),
        "{}",
        ran.errors
    );
}
