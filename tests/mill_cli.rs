//! `ident mill` and `ident lobes` on a job, as typed: recorded joint angles, limits along the path.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

const JOB: &str = r#"kind = "job"
synthetic = true
robot = "kr210"
path = "slot.csv"
feed_mm_min = 3000.0
blend_radius_mm = 2.0
cycle_ms = 4.0
start_joints_deg = [0, -90, 90, 0, 0, 0]
[workpiece]
origin_m = [1.5, -0.12, 0.8]
stock_min_mm = [0.0, -30.0, -10.0]
stock_max_mm = [30.0, 30.0, 0.0]
[tool]
diameter_mm = 16.0
teeth = 2
helix_deg = 30.0
flute_mm = 32.0
spindle_rpm = 10000.0
[material]
Ktc_N_mm2 = 1319.41
Krc_N_mm2 = 788.83
Kac_N_mm2 = 48.75
Kte_N_mm = 19.65
Kre_N_mm = 26.77
Kae_N_mm = 2.05
[limits]
path_acceleration_m_s2 = 1.0
path_jerk_m_s3 = 20.0
"#;

/// A slot with a corner, two millimetres deep.
const PATH: &str = "# kind = \"path\"\nx_mm,y_mm,z_mm,i,j,k,rapid\n\
    -12,0,-2,0,0,1,0\n20,0,-2,0,0,1,0\n20,20,-2,0,0,1,0\n20,39,-2,0,0,1,0\n20,45,-2,0,0,1,1\n";

fn ident(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ident"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap()
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let output = ident(folder, &[arguments, &["--json"]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{said}"))
}

/// What `mill` says of the slot so deep (mm), at a speed of the spindle, with flutes so long (mm), and its status.
fn milled(depth: &str, speed: &str, flute: &str) -> (Option<i32>, String) {
    let folder = job();
    let job = JOB
        .replace("= 10000.0", &format!("= {speed}"))
        .replace("= 32.0", &format!("= {flute}"));
    let path = PATH.replace(",-2,", &format!(",-{depth},"));
    std::fs::write(folder.path().join("job.toml"), job).unwrap();
    std::fs::write(folder.path().join("slot.csv"), path).unwrap();
    let out = ident(folder.path(), &["mill", "job.toml", "--dry-run"]);
    let said = String::from_utf8_lossy(&out.stderr).to_string();
    (out.status.code(), said)
}

/// At 10 000 and at 800 revolutions per minute, where robot and cut drive one another, until a tool with short flutes dives beyond them.
#[test]
fn chatter_is_said() {
    for flute in ["32.0", "4.0"] {
        let (status, said) = milled("2", "10000.0", flute);
        assert!(status == Some(0) && !said.contains("chatter"), "{said}");
    }
    let (status, said) = milled("2", "800.0", "32.0");
    assert!(status == Some(1) && said.contains("(chatter)"), "{said}");
    let (status, said) = milled("2", "800.0", "4.0");
    assert!(status == Some(2) && said.contains("(chatter)"), "{said}");
    assert!(said.contains("deeper than its flutes"), "{said}");
    assert!(said.contains("longer `flute_mm`"), "{said}");
}

/// The part was milled, so that a simulation that runs away is wrong, and springs alone carry the tool.
#[test]
fn a_part_is_diagnosed_although_its_simulation_runs_away() {
    let folder = job();
    let job = JOB
        .replace("= 10000.0", "= 800.0")
        .replace("= 32.0", "= 4.0");
    std::fs::write(folder.path().join("job.toml"), job).unwrap();
    let part = "# kind = \"milled-part\"\n# synthetic = true\n# job = \"job.toml\"\ns_mm,dx_mm,dy_mm,dz_mm\n\
         20,,0.01,\n22,,0.01,\n24,,0.01,\n26,,0.01,\n28,,0.01,\n";
    std::fs::write(folder.path().join("part.csv"), part).unwrap();
    let out = ident(folder.path(), &["diagnose", "part.csv", "--dry-run"]);
    let said = [out.stdout, out.stderr].concat();
    let said = String::from_utf8_lossy(&said).replace('\n', " ");
    assert!(out.status.code().is_some_and(|code| code < 2), "{said}");
    assert!(said.contains("(chatter)"), "{said}");
    assert!(said.contains("springs alone carry"), "{said}");
}

/// A robot that bends and swings by more than the tool should cut.
#[test]
fn what_bends_or_swings_into_the_part_is_no_chatter() {
    let (status, said) = milled("0.9", "10000.0", "1.0");
    assert!(status == Some(2) && said.contains("flutes"), "{said}");
    assert!(!said.contains("chatter"), "{said}");
    for depth in ["0.005", "0.2"] {
        let (status, said) = milled(depth, "10000.0", "32.0");
        assert!(status == Some(0) && !said.contains("chatter"), "{said}");
    }
}

fn job() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("job.toml"), JOB).unwrap();
    std::fs::write(folder.path().join("slot.csv"), PATH).unwrap();
    folder
}

/// Commands that were corrected deviate from themselves, not from the part; what cuts nothing says nothing of a part.
#[test]
fn only_a_drawn_path_that_cuts_judges_the_part() {
    let folder = job();
    let judged = |path: &str| {
        let job = JOB.replace(
            "path_jerk_m_s3 = 20.0",
            "path_jerk_m_s3 = 20.0\ntolerance_mm = 0.01",
        );
        std::fs::write(folder.path().join("job.toml"), job).unwrap();
        std::fs::write(folder.path().join("slot.csv"), path).unwrap();
        let output = ident(
            folder.path(),
            &["mill", "--static", "--no-interval", "job.toml"],
        );
        let said = [output.stdout, output.stderr].concat();
        (
            output.status.code(),
            String::from_utf8_lossy(&said).to_string(),
        )
    };
    let (status, said) = judged(PATH);
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("beyond the 0.0100 mm"), "{said}");
    let corrected = PATH.replace("\nx_mm", "\n# method = \"mirror\"\nx_mm");
    let above = PATH.replace(",-2,", ",12,");
    for (path, word, is_fine) in [
        (&corrected, "corrected", true),
        (&above, "cuts nothing", false),
    ] {
        let (status, said) = judged(path);
        assert_eq!(status, Some(i32::from(!is_fine)), "{said}");
        assert!(
            said.contains(word) && !said.contains("that the part allows"),
            "{said}"
        );
    }
    let body = json(
        folder.path(),
        &["mill", "--static", "--no-interval", "job.toml"],
    );
    assert!(body["mean_force_N"].is_null(), "{body}");
    let remarks = body["remarks"].to_string();
    assert!(remarks.contains("cuts nothing"), "{remarks}");
    let output = ident(folder.path(), &["compensate", "--static", "job.toml"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("job.toml") && said.contains("cuts nothing"),
        "{said}"
    );
    assert!(output.stdout.is_empty());
}

/// The verdict holds for all of the interval, as that of `compensate`.
#[test]
fn a_deviation_whose_interval_crosses_what_the_part_allows_is_not_certain() {
    let folder = job();
    let here = folder.path();
    let allowing = |mm: f64| {
        let job = JOB
            .replace("Kae_N_mm = 2.05", "Kae_N_mm = 2.05\nrel_std = 0.1")
            .replace("[limits]", &format!("[limits]\ntolerance_mm = {mm}"));
        std::fs::write(here.join("job.toml"), job).unwrap();
        let output = ident(here, &["mill", "--static", "--dry-run", "job.toml"]);
        let said = String::from_utf8_lossy(&output.stdout).to_string();
        (output.status.code(), said)
    };
    let body = json(here, &["mill", "--static", "--dry-run", "job.toml"]);
    let max = body["deviation_mm"]["max"].as_f64().unwrap();
    for (share, status, word) in [
        (2.0, 0, "That is within"),
        (1.02, 1, "not certain"),
        (0.98, 1, "That is beyond"),
        (0.4, 1, "That is beyond"),
    ] {
        let (code, said) = allowing(share * max);
        assert_eq!(code, Some(status), "{share}: {said}");
        assert!(said.contains(word), "{share}: {said}");
    }
}

/// Found by fuzzing: runs of minutes, each a unit gone wrong.
#[test]
fn what_no_cutter_is_or_does_is_refused() {
    let folder = job();
    let whats = [
        ("teeth = 2", "teeth = 72", "job.toml:15", "16 mm"),
        (
            "Krc_N_mm2 = 788.83",
            "Krc_N_mm2 = 2e22",
            "job.toml:21",
            "N/mm²",
        ),
        (
            "feed_mm_min = 3000.0",
            "feed_mm_min = 1.0",
            "job.toml:5",
            "µm per tooth",
        ),
        (
            "spindle_rpm = 10000.0",
            "spindle_rpm = 10.0",
            "job.toml:5",
            "mm per tooth",
        ),
        (
            "start_joints_deg = [0, -90, 90, 0, 0, 0]",
            "start_joints_deg = [0, 90, 90, 0, 0, 0]",
            "job.toml:8",
            "joint 2",
        ),
    ];
    for (right, wrong, place, word) in whats {
        std::fs::write(folder.path().join("job.toml"), JOB.replace(right, wrong)).unwrap();
        let output = ident(folder.path(), &["mill", "--static", "job.toml"]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(place) && said.contains(word), "{said}");
    }
    let slow = "# kind = \"path\"\nx_mm,y_mm,z_mm,rapid,feed_mm_min\n-12,0,-2,0,600\n20,0,-2,0,1\n";
    std::fs::write(folder.path().join("slot.csv"), slow).unwrap();
    let job = JOB.replace("feed_mm_min = 3000.0\n", "");
    std::fs::write(folder.path().join("job.toml"), job).unwrap();
    let output = ident(folder.path(), &["mill", "--static", "job.toml"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("slot.csv:4") && said.contains("per tooth"),
        "{said}"
    );
}

/// The Beta function's ∫₀^π sinᵖ φ dφ, by the midpoint rule.
fn sines(power: f64) -> f64 {
    let steps = 200_000;
    let width = std::f64::consts::PI / f64::from(steps);
    let at = |i: i32| ((f64::from(i) + 0.5) * width).sin().powf(power);
    (0..steps).map(at).sum::<f64>() * width
}

/// A full slot with straight teeth: the mean force of a power law has a closed form, c sin φ for the chip.
#[test]
fn a_material_of_the_handbook_is_milled_by_its_power_law() {
    let folder = job();
    let here = folder.path();
    let (head, rest) = JOB.split_once("[material]").unwrap();
    let (_, limits) = rest.split_once("[limits]").unwrap();
    let kienzle = "[material]\nlaw = \"kienzle\"\nkt11_N_mm2 = 700\nkr11_N_mm2 = 300\nka11_N_mm2 = 90\n\
                   mt = 0.25\nmr = 0.4\nma = 0.3\n";
    let job =
        format!("{head}{kienzle}[limits]{limits}").replace("helix_deg = 30.0", "helix_deg = 0.0");
    std::fs::write(here.join("job.toml"), &job).unwrap();
    let straight =
        "# kind = \"path\"\nx_mm,y_mm,z_mm,i,j,k,rapid\n9,0,-2,0,0,1,0\n21,0,-2,0,0,1,0\n";
    std::fs::write(here.join("slot.csv"), straight).unwrap();
    let course = json(here, &["mill", "job.toml", "--rigid"]);
    let course = std::fs::read_to_string(here.join(course["course"].as_str().unwrap())).unwrap();
    let rows = course
        .lines()
        .filter(|l| !l.starts_with('#') && !l.starts_with("time"));
    let cells = rows.map(|l| {
        l.split(',')
            .map(|c| c.parse::<f64>().unwrap())
            .collect::<Vec<_>>()
    });
    // at full feed, the tool wholly in the slot that it mills
    let steady: Vec<Vec<f64>> = cells.filter(|c| (14.0..17.0).contains(&c[2])).collect();
    let mean = |k: usize| steady.iter().map(|c| c[k]).sum::<f64>() / steady.len() as f64;
    let chip = 3000.0 / 10000.0 / 2.0;
    let force = |k: f64, m: f64| {
        let [teeth, depth] = [2.0, 2.0];
        teeth * depth / std::f64::consts::TAU * k * f64::powf(chip, 1.0 - m) * sines(2.0 - m)
    };
    let [along, left] = [-force(300.0, 0.4), force(700.0, 0.25)];
    assert!((mean(5) / along - 1.0).abs() < 0.01, "{} {along}", mean(5));
    assert!((mean(6) / left - 1.0).abs() < 0.01, "{} {left}", mean(6));
    let lobes = |job: &str| {
        std::fs::write(here.join("job.toml"), job).unwrap();
        json(here, &["lobes", "job.toml", "--rpm", "9000:10000:1000"])["remarks"].to_string()
    };
    assert!(lobes(&job).contains("chip of 0.05 mm") && !lobes(JOB).contains("chip of"));
    for (right, wrong, word) in [
        ("\"kienzle\"", "\"taylor\"", "linear_edge"),
        ("mt = 0.25", "mt = 25", "below 1"),
        ("law = \"kienzle\"\n", "", "law"),
    ] {
        std::fs::write(here.join("job.toml"), job.replace(right, wrong)).unwrap();
        let output = ident(here, &["mill", "--rigid", "job.toml"]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("job.toml:") && said.contains(word), "{said}");
    }
}

fn near(a: &Value, b: &Value, share: f64) {
    let [a, b] = [a, b].map(|x| x.as_f64().unwrap());
    assert!((a - b).abs() <= share * b.abs(), "{a} {b}");
}

#[test]
fn the_plans_own_joint_angles_mill_the_plans_part() {
    let folder = job();
    let here = folder.path();
    let plan = json(here, &["plan", "job.toml"]);
    let trajectory = plan["trajectory"].as_str().unwrap();
    let mill = ["mill", "job.toml", "--static", "--dry-run"];
    let planned = json(here, &mill);
    let driven = json(here, &[&mill[..], &["--joints", trajectory]].concat());
    assert!(planned["joints"].is_null());
    assert!(driven["joints"]["off_path_mm"]["max"].as_f64().unwrap() < 1e-4);
    for key in ["removed_mm3", "peak_force_N", "duration_s"] {
        near(&driven[key], &planned[key], 1e-3);
    }
    for key in ["max", "rms", "max_normal"] {
        near(
            &driven["deviation_mm"][key],
            &planned["deviation_mm"][key],
            3e-3,
        );
    }
}

/// A recording may end where nothing is cut any more.
#[test]
fn a_recording_that_lacks_the_way_out_of_the_part_is_whole() {
    let folder = job();
    let here = folder.path();
    let out = "# kind = \"path\"\nx_mm,y_mm,z_mm,i,j,k\n\
        -12,0,-2,0,0,1\n18,0,-2,0,0,1\n18,0,30,0,0,1\n";
    std::fs::write(here.join("slot.csv"), out).unwrap();
    let plan = json(here, &["plan", "job.toml"]);
    let text = std::fs::read_to_string(here.join(plan["trajectory"].as_str().unwrap())).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    let first = rows.iter().position(|r| r.starts_with("time_s")).unwrap() + 1;
    let cell = |row: &str, k: usize| row.split(',').nth(k).unwrap().parse::<f64>().unwrap();
    let until = |end: &dyn Fn(&str) -> bool| {
        let last = rows[first..].iter().position(|r| end(r)).unwrap();
        let text = rows[..first + last].join("\n") + "\n";
        std::fs::write(here.join("part.csv"), text).unwrap();
        let mill = [
            "mill",
            "--rigid",
            "--dry-run",
            "job.toml",
            "--joints",
            "part.csv",
        ];
        let body = json(here, &mill);
        body["remarks"].to_string().contains("not milled")
    };
    assert!(!until(&|row| cell(row, 3) > 1.0), "the retract is missing");
    assert!(
        until(&|row| cell(row, 1) > 10.0),
        "a third of the slot is missing"
    );
}

/// Half a millimetre beside the path everywhere but at the foot: A1 is 0.02 degrees off.
#[test]
fn a_controller_that_leads_beside_the_path_is_in_the_deviation() {
    let folder = job();
    let here = folder.path();
    let plan = json(here, &["plan", "job.toml"]);
    let trajectory = here.join(plan["trajectory"].as_str().unwrap());
    let text = std::fs::read_to_string(&trajectory).unwrap();
    let turned = |by: f64| -> String {
        let mut rows = text.lines().filter(|line| !line.starts_with('#'));
        let mut out = "time_s,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n".to_string();
        assert!(rows.next().unwrap().starts_with("time_s,x_mm"));
        for row in rows {
            let cells: Vec<&str> = row.split(',').collect();
            let first = cells[7].parse::<f64>().unwrap() + by;
            out += &format!("{},{first},{}\n", cells[0], cells[8..13].join(","));
        }
        out
    };
    std::fs::write(here.join("turned.csv"), turned(0.02)).unwrap();
    let mill = ["mill", "job.toml", "--rigid", "--dry-run", "--joints"];
    let driven = json(here, &[&mill[..], &["turned.csv"]].concat());
    assert_eq!(driven["remarks"].as_array().unwrap().len(), 0, "{driven}");
    // the way of the tool from A1: 1.5 m, of which the part across the feed counts
    let off = driven["joints"]["off_path_mm"]["max"].as_f64().unwrap();
    assert!((0.5..0.56).contains(&off), "{off}");
    let deviation = driven["deviation_mm"]["max"].as_f64().unwrap();
    assert!((0.5..0.56).contains(&deviation), "{deviation}");
    let all = turned(0.02);
    let half: Vec<&str> = all.lines().take(all.lines().count() / 2).collect();
    std::fs::write(here.join("half.csv"), half.join("\n") + "\n").unwrap();
    let output = ident(here, &[&mill[..], &["half.csv"]].concat());
    let said = String::from_utf8_lossy(&output.stderr).to_string();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("not milled, and not judged"), "{said}");
    std::fs::write(here.join("other.csv"), turned(3.0)).unwrap();
    let output = ident(here, &[&mill[..], &["other.csv"]].concat());
    let said = String::from_utf8_lossy(&output.stderr).to_string();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("other.csv") && said.contains("help:"),
        "{said}"
    );
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn limits_along_the_path_are_those_of_its_stations() {
    let folder = job();
    let here = folder.path();
    let along = json(here, &["lobes", "job.toml", "--along", "--dry-run"]);
    let stations = along["stations"].as_array().unwrap();
    assert!(stations.len() > 50, "{}", stations.len());
    let last = stations.last().unwrap()["s_mm"].as_f64().unwrap();
    // the way of 25 mm at the end is a rapid motion
    assert!((50.0..53.0).contains(&last), "{last}");
    let depth = |s: &Value| s["limit_depth_mm"].as_f64().unwrap_or(f64::INFINITY);
    let least = stations.iter().map(depth).fold(f64::INFINITY, f64::min);
    assert_eq!(depth(&along["least"]), least);
    let third = &stations[stations.len() / 3];
    let place = third["s_mm"].as_f64().unwrap().to_string();
    let at = ["lobes", "job.toml", "--dry-run", "--rpm", "10000:10000:1"];
    let one = json(here, &[&at[..], &["--station", &place]].concat());
    assert_eq!(one["limit_depth_mm"][0], third["limit_depth_mm"]);
    for wrong in ["-1", "500"] {
        let output = ident(here, &[&at[..], &[&format!("--station={wrong}")]].concat());
        assert_eq!(output.status.code(), Some(2));
    }
}

const MODAL: &str = r#"kind = "modal"
[[modes]]
direction = [0, 1, 0]
frequency_Hz = 300.0
damping_ratio = 0.03
stiffness_N_m = 8e6
MODE
[tool]
diameter_mm = 10.0
teeth = 2
[material]
Ktc_N_mm2 = 600
Krc_N_mm2 = 200
Kac_N_mm2 = 0
Kte_N_mm = 0
Kre_N_mm = 0
Kae_N_mm = 0
[cut]
cut = "slot"
"#;
const MODE: &str = "[[modes]]\ndirection = [1, 0, 0]\nfrequency_Hz = 922.0\ndamping_ratio = 0.011\nstiffness_N_m = 1.34e6";

/// Three hits on a mass on a spring (922 Hz, 1.1 %, 1.34 N/µm), a soft and a hard tip: the force a half sine,
/// the motion by midpoint steps of a hundredth of a sample, the acceleration by the equation of motion.
fn hits(pulse_s: f64) -> String {
    let (omega, ratio, stiffness) = (922.0 * std::f64::consts::TAU, 0.011, 1.34e6);
    let mass = stiffness / (omega * omega);
    let (rate, fine) = (25_600.0, 100);
    let step = 1.0 / (rate * fine as f64);
    let begin = 0.02;
    let mut text =
        "# kind = \"hammer\"\n# robot = \"kr210\"\n# joint_angles_deg = [0, -90, 90, 0, 0, 0]\n\
        direction,hit,time_s,force_N,ax_m_s2\n"
            .to_string();
    for hit in 1..=3 {
        let force = |t: f64| match (t - begin) / pulse_s {
            u if (0.0..1.0).contains(&u) => 100.0 * hit as f64 * (std::f64::consts::PI * u).sin(),
            _ => 0.0,
        };
        let (mut x, mut v) = (0.0, 0.0);
        for i in 0..12_800 {
            let t = f64::from(i) / rate;
            let a = |t: f64, x: f64, v: f64| {
                (force(t) - stiffness * x) / mass - 2.0 * ratio * omega * v
            };
            text += &format!("x,{hit},{t:.8},{:.6},{:.8}\n", force(t), a(t, x, v));
            for k in 0..fine {
                let t = t + f64::from(k) * step;
                let (k1, l1) = (v, a(t, x, v));
                let (k2, l2) = (
                    v + 0.5 * step * l1,
                    a(t + 0.5 * step, x + 0.5 * step * k1, v + 0.5 * step * l1),
                );
                (x, v) = (x + step * k2, v + step * l2);
            }
        }
    }
    text
}

/// A tool hit with a hammer limits the depth as the same mode by numbers does, whether the tip excites the whole
/// band or not.
#[test]
fn a_measured_tool_limits_the_cut_as_its_mode_does() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let write = |name: &str, text: &str| std::fs::write(here.join(name), text).unwrap();
    write("both.toml", &MODAL.replace("MODE", MODE));
    write("one.toml", &MODAL.replace("MODE", ""));
    write("hard.csv", &hits(0.4e-3));
    write("soft.csv", &hits(0.9e-3));
    let lobes = |arguments: &[&str]| -> Vec<f64> {
        let all = ["--dry-run", "--rpm", "5000:8000:1000"];
        let found = json(here, &[&["lobes"], arguments, &all].concat());
        let limits = found["limit_depth_mm"].as_array().unwrap();
        limits
            .iter()
            .map(|d| d.as_f64().unwrap_or(f64::INFINITY))
            .collect()
    };
    let (truth, without) = (lobes(&["both.toml"]), lobes(&["one.toml"]));
    for file in ["hard.csv", "soft.csv"] {
        let found = lobes(&["one.toml", "--tool-frf", file]);
        println!("{file}: {found:?} for {truth:?}, without {without:?}");
        for ((found, truth), without) in found.iter().zip(&truth).zip(&without) {
            assert!(
                (found / truth - 1.0).abs() < 0.02 && *without > 1.3 * truth,
                "{file}"
            );
        }
    }
}

/// Both sides have a width, a slot has none, and nothing cuts above the flutes.
#[test]
fn lobes_are_asked_for_either_side_and_within_the_flutes() {
    let folder = job();
    let at = |cut: &str, rest: &[&str]| {
        let all = [&["lobes", "job.toml", "--cut", cut, "--dry-run"], rest].concat();
        ident(folder.path(), &all)
    };
    let narrow = ["--width-mm", "5", "--at", "10000,3"];
    let radius = |cut: &str| {
        let found = at(cut, &[&narrow[..], &["--json"]].concat());
        let said = String::from_utf8_lossy(&found.stderr).to_string();
        let found: Value = serde_json::from_slice(&found.stdout).expect(&said);
        found["spectral_radius"].as_f64().unwrap()
    };
    assert!((radius("up") / radius("down") - 1.0).abs() > 1e-3);
    for (cut, rest, word) in [
        ("slot", &narrow[..], "as wide as the tool"),
        ("up", &["--at", "10000,33"][..], "flutes end at 32.000 mm"),
        ("up", &["--depth-mm", "33"][..], "flutes end at 32.000 mm"),
    ] {
        let refused = at(cut, rest);
        let said = String::from_utf8_lossy(&refused.stderr).to_string();
        assert_eq!(refused.status.code(), Some(2), "{said}");
        assert!(said.contains(word), "{said}");
    }
}

/// What a tool takes with its end, and where it begins, is no cut, and that is said.
#[test]
fn material_that_no_tooth_meets_is_told() {
    let folder = job();
    let remarks = |path: &str| {
        let head = "# kind = \"path\"\nx_mm,y_mm,z_mm,i,j,k,rapid\n";
        std::fs::write(folder.path().join("slot.csv"), format!("{head}{path}")).unwrap();
        let found = json(folder.path(), &["mill", "job.toml", "--rigid", "--dry-run"]);
        found["remarks"].to_string()
    };
    let plunge = remarks("15,0,5,0,0,1,0\n15,0,-2,0,0,1,0\n15,0,5,0,0,1,1\n");
    assert!(
        plunge.contains("plunges") && !plunge.contains("begins"),
        "{plunge}"
    );
    assert!(!plunge.contains("rapid"), "{plunge}");
    let dropped = remarks("15,0,5,0,0,1,0\n15,0,-2,0,0,1,1\n15,0,5,0,0,1,0\n");
    assert!(
        dropped.contains("line 4") && dropped.contains("a rapid motion cuts"),
        "{dropped}"
    );
    let inside = remarks("15,0,-2,0,0,1,0\n45,0,-2,0,0,1,0\n");
    assert!(inside.contains("begins"), "{inside}");
    let beside = remarks("-12,0,-2,0,0,1,0\n45,0,-2,0,0,1,0\n");
    assert!(
        !beside.contains("plunges") && !beside.contains("begins"),
        "{beside}"
    );
    assert!(!beside.contains("rapid"), "{beside}");
    let rapid = remarks("-12,0,-2,0,0,1,0\n45,0,-2,0,0,1,0\n60,9,-2,0,0,1,0\n-32,9,-2,0,0,1,1\n");
    assert!(
        rapid.contains("line 6") && rapid.contains("a rapid motion cuts"),
        "{rapid}"
    );
}
