//! What `ident plan` writes, recomputed from the files alone: forward kinematics by the closed formulas of
//! Brandstötter, Angerer and Hofbaur (2014) with the published lengths of the KR 210-2, angles by hand,
//! the double-S by its closed form, feeds by differences of rows. Nothing of the planner is used.

use crate::bench_of_files::Bench;
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, PI};

type V3 = [f64; 3];
type M3 = [V3; 3];

/// a1, a2, c1, c2, c3 of the KR 210-2, and c4 with the tool of 0.25 m along A6, m.
const LENGTHS: [f64; 6] = [0.35, 0.055, 0.75, 1.25, 1.1, 0.23 + 0.25];
/// The workpiece frame of [`job`]: origin, m, and turn about the base's z, rad.
const ORIGIN: V3 = [1.5, -0.1, 0.8];
const TURN: f64 = 10.0 / 180.0 * PI;
const ACCELERATION: f64 = 1.0;
const JERK: f64 = 20.0;

/// One row of `trajectory.csv`: time s, tip mm, a b c deg, joints deg, feed m/s.
struct Row([f64; 14]);

impl Row {
    fn tip(&self) -> V3 {
        [1, 2, 3].map(|i| self.0[i] * 1e-3)
    }

    fn rotation(&self) -> M3 {
        let [a, b, c] = [4, 5, 6].map(|i| self.0[i].to_radians());
        times(&about_z(a), &times(&about_y(b), &about_x(c)))
    }

    fn joints(&self) -> [f64; 6] {
        std::array::from_fn(|i| self.0[7 + i].to_radians())
    }

    fn feed(&self) -> f64 {
        self.0[13]
    }
}

fn about_z(t: f64) -> M3 {
    let (s, c) = t.sin_cos();
    [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]
}

fn about_y(t: f64) -> M3 {
    let (s, c) = t.sin_cos();
    [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]
}

fn about_x(t: f64) -> M3 {
    let (s, c) = t.sin_cos();
    [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]
}

fn times(a: &M3, b: &M3) -> M3 {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

fn length(v: V3) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn minus(a: V3, b: V3) -> V3 {
    std::array::from_fn(|i| a[i] - b[i])
}

/// Tip and tool frame in the base frame from joint angles as KUKA counts them.
fn forward(q: &[f64; 6]) -> (V3, M3) {
    let [a1, a2, c1, c2, c3, c4] = LENGTHS;
    let t = [-q[0], q[1] + FRAC_PI_2, q[2], -q[3], q[4], -q[5]];
    let (psi, k) = (a2.atan2(c3), a2.hypot(c3));
    let arm = t[1] + t[2];
    let out = c2 * t[1].sin() + k * (arm + psi).sin() + a1;
    let up = c2 * t[1].cos() + k * (arm + psi).cos() + c1;
    let wrist = [out * t[0].cos(), out * t[0].sin(), up];
    let first = times(&about_z(t[0]), &about_y(arm));
    let hand = times(&about_z(t[3]), &times(&about_y(t[4]), &about_z(t[5])));
    let tool = times(&first, &hand);
    (std::array::from_fn(|i| wrist[i] + c4 * tool[i][2]), tool)
}

/// Seconds from rest to rest over `l` metres at `v` m/s at most: the double-S.
fn double_s(l: f64, v: f64) -> f64 {
    let (a, j) = (ACCELERATION, JERK);
    let change = |v: f64| {
        if v * j >= a * a {
            v / a + a / j
        } else {
            2.0 * (v / j).sqrt()
        }
    };
    if v * change(v) <= l {
        return l / v + change(v);
    }
    let flat = 0.5 * ((a * a / j).powi(2) + 4.0 * a * l).sqrt() - 0.5 * a * a / j;
    let pointed = (0.5 * l * j.sqrt()).powf(2.0 / 3.0);
    2.0 * change(if flat * j >= a * a { flat } else { pointed })
}

fn job(path: &str, lines: &str) -> String {
    format!(
        "kind = \"job\"\nrobot = \"kr210\"\npath = \"{path}\"\ncycle_ms = 4.0\n\
         start_joints_deg = [0, -90, 90, 0, 0, 0]\n{lines}\n[workpiece]\norigin_m = [1.5, -0.1, 0.8]\n\
         abc_deg = [10.0, 0.0, 0.0]\n[limits]\npath_acceleration_m_s2 = 1.0\npath_jerk_m_s3 = 20.0\n"
    )
}

struct Planned {
    body: Value,
    rows: Vec<Row>,
}

impl Planned {
    fn number(&self, table: &str, key: &str) -> f64 {
        self.body[table][key].as_f64().unwrap()
    }
}

fn planned(bench: &Bench, job: &str, more: &[&str]) -> Planned {
    bench.put("job.toml", job.as_bytes());
    let ran = bench.run(&[&["plan", "job.toml", "--json"][..], more].concat());
    assert_eq!(ran.status, 0, "{}\n{}", ran.errors, ran.out);
    let body: Value = serde_json::from_str(&ran.out).unwrap();
    let text = bench.text(body["trajectory"].as_str().unwrap());
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let row = |line: &str| {
        let numbers: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        Row(numbers.try_into().unwrap())
    };
    Planned {
        rows: lines.map(row).collect(),
        body,
    }
}

/// Forward kinematics returns every pose; joints run without jumps; nothing is faster than its limits.
fn sound(plan: &Planned) {
    for (k, row) in plan.rows.iter().enumerate() {
        assert!((row.0[0] - 0.004 * k as f64).abs() < 1e-9);
        let (tip, tool) = forward(&row.joints());
        let turned = times(&about_z(-TURN), &tool);
        let from = minus(tip, ORIGIN);
        let seen: V3 =
            std::array::from_fn(|i| (0..3).map(|j| about_z(-TURN)[i][j] * from[j]).sum());
        assert!(length(minus(seen, row.tip())) < 1e-9, "row {k}");
        let asked = row.rotation();
        let apart = (0..9).map(|i| (asked[i / 3][i % 3] - turned[i / 3][i % 3]).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-6, "row {k}");
    }
    let mut fastest = [0.0_f64; 6];
    for pair in plan.rows.windows(2) {
        for (i, fastest) in fastest.iter_mut().enumerate() {
            let step = pair[1].0[7 + i] - pair[0].0[7 + i];
            assert!(step.abs() < 2.0, "a jump of A{}", i + 1);
            *fastest = fastest.max(step.abs() / 0.004);
        }
        let rise = (pair[1].feed() - pair[0].feed()) / 0.004;
        assert!(rise.abs() <= ACCELERATION * (1.0 + 1e-6), "{rise}");
    }
    for three in plan.rows.windows(3) {
        let [a, b, c] = [0, 1, 2].map(|i| three[i].feed());
        assert!((a - 2.0 * b + c).abs() <= JERK * 0.004 * 0.004 * (1.0 + 1e-6));
    }
    for (joint, fastest) in plan.body["joints"].as_array().unwrap().iter().zip(fastest) {
        let stated = joint["max_speed_deg_s"].as_f64().unwrap();
        assert!(
            (stated - fastest).abs() < 1e-5 * fastest.max(1.0),
            "{joint}"
        );
    }
    assert_eq!(plan.number("path", "samples"), plan.rows.len() as f64);
}

/// The stretch of a line on which the point lies (m from its begin), if it is on it.
fn along(p: V3, from: V3, to: V3) -> Option<f64> {
    let whole = length(minus(to, from));
    let direction = minus(to, from).map(|x| x / whole);
    let s: f64 = (0..3).map(|i| (p[i] - from[i]) * direction[i]).sum();
    let off = length(std::array::from_fn(|i| p[i] - from[i] - s * direction[i]));
    (off < 1e-9 && s > 0.0 && s < whole).then_some(s)
}

#[test]
fn blended_lines_are_followed_at_their_feeds_with_a_tilted_tool() {
    let points = [
        [0.0, 0.0, 0.0, 3000.0],
        [80.0, 0.0, 0.0, 3000.0],
        [80.0, 60.0, 10.0, 3000.0],
        [20.0, 90.0, 10.0, 3000.0],
        [0.0, 40.0, 0.0, 1800.0],
    ];
    let tilts = [
        [0.0, 180.0, 0.0],
        [2.0, 179.0, 0.0],
        [2.0, 178.0, 2.0],
        [-1.0, 179.0, 0.0],
        [0.0, 180.0, 0.0],
    ];
    let mut text =
        String::from("# kind = \"path\"\nx_mm,y_mm,z_mm,a_deg,b_deg,c_deg,feed_mm_min\n");
    for ([x, y, z, feed], [a, b, c]) in points.iter().zip(tilts) {
        text += &format!("{x},{y},{z},{a},{b},{c},{feed}\n");
    }
    let bench = Bench::new();
    bench.put("part.csv", text.as_bytes());
    let plan = planned(&bench, &job("part.csv", "blend_radius_mm = 3.0"), &[]);
    sound(&plan);
    let corner = |k: usize| -> V3 { std::array::from_fn(|i| points[k][i] * 1e-3) };
    let mut steady = 0;
    for pair in plan.rows.windows(2) {
        let (p, q) = (pair[0].tip(), pair[1].tip());
        let far = |p: V3| (1..4).all(|k| length(minus(p, corner(k))) > 3.0e-3 + 1e-9);
        let on = |p: V3| (0..4).find_map(|k| Some((k, along(p, corner(k), corner(k + 1))?)));
        if far(p) && length(minus(p, corner(0))) > 1e-6 && length(minus(p, corner(4))) > 1e-6 {
            assert!(on(p).is_some(), "{p:?} lies on no line");
        }
        let same = on(p).zip(on(q)).filter(|(a, b)| a.0 == b.0);
        let Some(((k, s), (_, t))) = same else {
            continue;
        };
        let (feed, whole) = (
            points[k + 1][3] / 6e4,
            length(minus(corner(k + 1), corner(k))),
        );
        let quiet = match k {
            0 => s > 0.012,
            2 => t < whole - 0.012,
            3 => s > 0.012 && t < whole - 0.012,
            _ => true,
        };
        if quiet && far(p) && far(q) {
            assert!(
                ((t - s) / 0.004 / feed - 1.0).abs() < 1e-6,
                "line {k} at {s}"
            );
            steady += 1;
        }
    }
    assert!(steady > plan.rows.len() / 2);
    // Within a blend the tip moves at the feed too: never faster, and the chord of a cycle shorter by
    // (κ v T)²/24 only.
    let asked = plan.number("feed", "asked_m_s");
    assert!((asked - 0.05).abs() < 1e-12);
    for pair in plan.rows[60..plan.rows.len() - 200].windows(2) {
        let speed = length(minus(pair[1].tip(), pair[0].tip())) / 0.004;
        assert!(speed < asked * (1.0 + 1e-6) && speed > 0.03 * (1.0 - 2e-3));
    }
}

#[test]
fn stops_take_the_closed_form_and_leave_the_feed_on_the_rest() {
    let bench = Bench::new();
    let text = "# kind = \"path\"\nx_mm,y_mm,z_mm,i,j,k\n0,0,0,0,0,1\n100,0,0,0,0,1\n100,3,0,0,0,1\n60,43,0,0,0,1\n";
    bench.put("part.csv", text.as_bytes());
    let lines = "feed_mm_min = 3600.0\nblend_radius_mm = 0.0\nspin = \"fixed\"";
    let plan = planned(&bench, &job("part.csv", lines), &[]);
    sound(&plan);
    let (v, lengths) = (0.06, [0.1, 0.003, 0.04 * 2.0_f64.sqrt()]);
    let seconds: f64 = lengths.iter().map(|l| double_s(*l, v)).sum();
    assert!((plan.number("path", "duration_s") - seconds).abs() < 1e-9);
    let whole: f64 = lengths.iter().sum();
    assert!((plan.number("path", "length_m") - whole).abs() < 1e-12);
    // Up and down take v (v/a + a/j) together, where the feed is reached.
    let ramps = v * (v / ACCELERATION + ACCELERATION / JERK);
    let held = (lengths[0] - ramps + lengths[2] - ramps) / whole;
    assert!((plan.number("feed", "held_share") - held).abs() < 1e-9);
}

#[test]
fn a_circle_of_a_cls_file_is_round() {
    let bench = Bench::new();
    let cls = "UNITS/MM\nFROM/35,0,0,0,0,1\nFEDRAT/2400.0,MMPM\nGOTO/30,0,0\n\
               CIRCLE/0,0,0,0.0000000,0.0000000,1.0000000,30.0000\nGOTO/30,0,0\n";
    bench.put("part.cls", cls.as_bytes());
    let plan = planned(&bench, &job("part.cls", "spin = \"fixed\""), &[]);
    sound(&plan);
    let round = plan.rows.iter().filter(|row| row.tip()[0] < 0.029);
    let off = round.map(|row| (row.tip()[0].hypot(row.tip()[1]) - 0.03).abs());
    assert!(off.fold(0.0, f64::max) < 1e-12);
    assert!((plan.number("path", "length_m") - (0.005 + 0.06 * PI)).abs() < 1e-12);
}

/// A ring of lines with a rapid way to it, spindle upright, the turn about it free.
fn ring() -> String {
    let mut cls = String::from(
        "UNITS/MM\nFROM/0,0,20,0,0,1\nRAPID\nGOTO/120,0,5\nFEDRAT/3000.0,MMPM\nGOTO/120,0,0\n",
    );
    for k in 1..=12 {
        let (sin, cos) = (f64::from(k) * PI / 6.0).sin_cos();
        cls += &format!("GOTO/{:.4},{:.4},0\n", 120.0 * cos, 120.0 * sin);
    }
    cls + "RAPID\nGOTO/120,0,20\n"
}

/// The tool tilts within the blends, at a corner and on a straight way; the turn about it keeps A6 where it is, in the program too.
#[test]
fn a_krl_program_of_a_tilting_tool_turns_where_the_plan_does() {
    let bench = Bench::new();
    let tilted = "# kind = \"path\"\nx_mm,y_mm,z_mm,i,j,k\n0,0,0,0,0,1\n50,0,0,0,0.1,0.995\n\
                  100,0,0,0,-0.1,0.995\n150,20,0,0.1,0,0.995\n";
    bench.put("part.csv", tilted.as_bytes());
    let lines = "blend_radius_mm = 5.0\nspin = \"smooth\"\nfeed_mm_min = 1000.0";
    let first = planned(&bench, &job("part.csv", lines), &["--program", "krl"]);
    sound(&first);
    let program = first.body["program"].as_str().unwrap().to_string();
    let name = std::path::Path::new(&program).file_name().unwrap();
    let name = name.to_str().unwrap().to_string();
    bench.put(&name, &bench.bytes(&program));
    bench.put(
        &name.replace(".src", ".dat"),
        &bench.bytes(&program.replace(".src", ".dat")),
    );
    let again = planned(&bench, &job(&name, lines), &[]);
    sound(&again);
    assert_eq!(first.rows.len(), again.rows.len());
    for (a, b) in first.rows.iter().zip(&again.rows) {
        assert!(length(minus(a.tip(), b.tip())) < 1e-6);
        for i in 0..6 {
            let off = a.0[7 + i] - b.0[7 + i];
            assert!(off.abs() < 1.0, "A{} at {}: {off}", i + 1, a.0[0]);
        }
    }
}

#[test]
fn a_krl_program_of_a_smooth_turn_plans_to_the_same_motion_again() {
    let bench = Bench::new();
    bench.put("part.cls", ring().as_bytes());
    let lines =
        "blend_radius_mm = 2.0\nspin = \"smooth\"\nrapid_mm_min = 9000.0\nfeed_mm_min = 3000.0";
    let first = planned(&bench, &job("part.cls", lines), &["--program", "krl"]);
    sound(&first);
    let fastest = |plan: &Planned| -> Vec<f64> {
        let joints = plan.body["joints"].as_array().unwrap();
        joints
            .iter()
            .map(|joint| joint["max_speed_deg_s"].as_f64().unwrap())
            .collect()
    };
    let speeds = fastest(&first);
    let program = first.body["program"].as_str().unwrap().to_string();
    let name = std::path::Path::new(&program)
        .file_name()
        .unwrap()
        .to_str()
        .unwrap()
        .to_string();
    bench.put(&name, &bench.bytes(&program));
    bench.put("part.dat", &bench.bytes(&program.replace(".src", ".dat")));
    for turning in ["blend", "whole"] {
        let lines = format!("{lines}\norientation = \"{turning}\"");
        let again = planned(&bench, &job(&name, &lines), &[]);
        sound(&again);
        let seconds = [&first, &again].map(|plan| plan.number("path", "duration_s"));
        assert!(
            (seconds[0] - seconds[1]).abs() < 1e-5,
            "{turning}: {seconds:?}"
        );
        assert_eq!(first.rows.len(), again.rows.len());
        for (a, b) in first.rows.iter().zip(&again.rows) {
            assert!(length(minus(a.tip(), b.tip())) < 2e-7);
            for i in 0..6 {
                assert!(
                    (a.0[7 + i] - b.0[7 + i]).abs() < 0.6,
                    "{turning}: A{} at {}",
                    i + 1,
                    a.0[0]
                );
            }
        }
        for (slow, fast) in speeds.iter().zip(fastest(&again)) {
            // told at the ends of the lines alone the turn would take A6 to some 60 deg/s
            assert!(fast < slow + 4.0, "{turning}: {slow} {fast}");
        }
    }
}
