//! Job files: every key of the contract, the defaults, and refusals that name line and remedy.

use ident::measurement::job::{Job, Spin, Stock, Turning};
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// The job of the contract, word by word.
const JOB: &str = r#"kind = "job"
robot = "kr210"
path = "part.cls"
feed_mm_min = 3000.0
blend_radius_mm = 2.0
orientation = "blend"
spin = "smooth"
cycle_ms = 12.0
start_joints_deg = [0, -90, 90, 0, 0, 0]

[workpiece]
origin_m = [1.5, 0.0, 0.8]
abc_deg = [0.0, 0.0, 0.0]
stock_min_mm = [0.0, 0.0, -30.0]
stock_max_mm = [200.0, 120.0, 0.0]

[tool]
diameter_mm = 16.0
teeth = 2
helix_deg = 30.0
corner_radius_mm = 0.0
flute_mm = 32.0
spindle_rpm = 10000.0
runout_um = 0.0
runout_angle_deg = 0.0

[material]
name = "Al7075"
Ktc_N_mm2 = 1319.41
Krc_N_mm2 = 788.83
Kac_N_mm2 = 48.75
Kte_N_mm = 19.65
Kre_N_mm = 26.77
Kae_N_mm = 2.05
rel_std = 0.1

[limits]
path_acceleration_m_s2 = 1.0
path_jerk_m_s3 = 20.0
tolerance_mm = 0.2
"#;

fn read(text: &str) -> Result<Job, ident::ground::problem::Problem> {
    Job::of_bytes(Path::new("/nowhere/job.toml"), text.as_bytes())
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs().max(1e-3)
}

#[test]
fn every_key_of_the_contract_is_read_into_si() {
    let job = read(JOB).unwrap();
    assert_eq!((job.robot.as_str(), job.sha256.len()), ("kr210", 64));
    assert_eq!(job.toolpath, Path::new("/nowhere/part.cls"));
    assert!(near(job.feed.unwrap(), 0.05) && !job.adapt && job.rapid.is_none());
    assert!(near(job.blend_radius.unwrap(), 2e-3) && near(job.cycle, 0.012));
    assert_eq!((job.orientation, job.spin), (Turning::Blend, Spin::Smooth));
    assert!(near(job.start_joints.as_ref().unwrap()[2], 0.5 * PI));
    assert_eq!(job.workpiece.frame.point, [1.5, 0.0, 0.8]);
    let Some(Stock::Box { min, max }) = job.workpiece.stock else {
        panic!("{:?}", job.workpiece.stock)
    };
    assert!(near(min[2], -0.03) && near(max[0], 0.2) && near(max[1], 0.12));
    let cutter = job.cutter().unwrap();
    assert!(near(cutter.diameter, 0.016) && cutter.teeth == 2 && near(cutter.helix, PI / 6.0));
    assert!(near(cutter.flute.unwrap(), 0.032));
    assert!(near(cutter.spindle.unwrap(), 10_000.0 / 60.0 * TAU));
    let material = job.material().unwrap();
    assert!(near(material.coefficients[0], 1319.41e6) && near(material.coefficients[5], 2050.0));
    assert_eq!(material.rel_std, Some(0.1));
    assert!(near(job.limits.path_jerk, 20.0) && near(job.limits.tolerance.unwrap(), 2e-4));
}

#[test]
fn a_short_job_takes_the_defaults() {
    let text =
        "kind = \"job\"\nrobot = \"kr210\"\npath = \"a.csv\"\n[workpiece]\norigin_m = [1, 0, 1]\n";
    let job = read(text).unwrap();
    assert!(job.feed.is_none() && job.blend_radius.is_none() && job.start_joints.is_none());
    assert_eq!((job.orientation, job.spin), (Turning::Blend, Spin::Smooth));
    assert!(near(job.cycle, 0.012) && near(job.limits.path_acceleration, 1.0));
    assert!(job.workpiece.stock.is_none() && job.spindle.is_none());
    let problem = job.cutter().unwrap_err();
    assert_eq!(problem.column.as_deref(), Some("tool"));
    assert!(job.material().is_err());
}

#[test]
fn angles_turn_as_kuka_turns_them() {
    let job =
        read(&JOB.replace("abc_deg = [0.0, 0.0, 0.0]", "abc_deg = [90.0, 0.0, 90.0]")).unwrap();
    let r = job.workpiece.frame.rotation;
    let columns = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
    for (j, column) in columns.iter().enumerate() {
        assert!((0..3).all(|i| (r[i][j] - column[i]).abs() < 1e-15), "{r:?}");
    }
}

/// What replaces what, the line of the refusal, its key, and a word of its remedy.
const REFUSALS: &[(&str, &str, usize, &str, &str)] = &[
    ("kind = \"job\"", "", 1, "kind", "kind = \"job\""),
    ("kind = \"job\"", "kind = \"path\"", 1, "kind", "job"),
    ("robot = \"kr210\"", "", 1, "robot", "robot = "),
    ("robot = \"kr210\"", "robot = 210", 2, "robot", "robot = \""),
    ("path = \"part.cls\"", "path = \"\"", 3, "path", "quotes"),
    (
        "feed_mm_min = 3000.0",
        "fed_mm_min = 3000.0",
        4,
        "fed_mm_min",
        "`feed_mm_min`",
    ),
    (
        "feed_mm_min = 3000.0",
        "feed_mm_min = 0",
        4,
        "feed_mm_min",
        "above zero",
    ),
    (
        "feed_mm_min = 3000.0",
        "feed_mm_min = nan",
        4,
        "feed_mm_min",
        "finite",
    ),
    (
        "feed_mm_min = 3000.0",
        "feed = \"fast\"",
        4,
        "feed",
        "\"adapt\"",
    ),
    (
        "blend_radius_mm = 2.0",
        "blend_radius_mm = -2.0",
        5,
        "blend_radius_mm",
        "zero or more",
    ),
    (
        "orientation = \"blend\"",
        "orientation = \"line\"",
        6,
        "orientation",
        "\"whole\"",
    ),
    (
        "orientation = \"blend\"",
        "orientation = \"radius\"",
        1,
        "orientation_radius_mm",
        "= 5.0",
    ),
    (
        "spin = \"smooth\"",
        "spin = \"stiff\"",
        7,
        "spin",
        "\"stiffest\"",
    ),
    (
        "cycle_ms = 12.0",
        "cycle_ms = 0",
        8,
        "cycle_ms",
        "above zero",
    ),
    (
        "[0, -90, 90, 0, 0, 0]",
        "[]",
        9,
        "start_joints_deg",
        "per joint",
    ),
    (
        "[0, -90, 90, 0, 0, 0]",
        "[0, \"x\"]",
        9,
        "start_joints_deg",
        "[0.0, 1.5]",
    ),
    ("[workpiece]", "[werkstück]", 11, "", "TOML"),
    (
        "origin_m = [1.5, 0.0, 0.8]",
        "",
        11,
        "workpiece.origin_m",
        "origin_m =",
    ),
    (
        "origin_m = [1.5, 0.0, 0.8]",
        "origin_m = [1.5, 0.8]",
        12,
        "workpiece.origin_m",
        "3 numbers",
    ),
    (
        "stock_max_mm = [200.0, 120.0, 0.0]",
        "",
        11,
        "workpiece.stock_max_mm",
        "stock_max_mm =",
    ),
    (
        "[200.0, 120.0, 0.0]",
        "[200.0, -1.0, 0.0]",
        15,
        "workpiece.stock_max_mm",
        "highest",
    ),
    (
        "abc_deg = [0.0, 0.0, 0.0]",
        "stock = \"a.stl\"",
        13,
        "workpiece.stock",
        "leave out",
    ),
    (
        "diameter_mm = 16.0",
        "",
        17,
        "tool.diameter_mm",
        "diameter_mm =",
    ),
    (
        "diameter_mm = 16.0",
        "diameter = 16.0",
        18,
        "tool.diameter",
        "`diameter_mm`",
    ),
    ("teeth = 2", "teeth = 0", 19, "tool.teeth", "whole number"),
    ("teeth = 2", "teeth = 2.5", 19, "tool.teeth", "whole number"),
    (
        "helix_deg = 30.0",
        "helix_deg = 90.0",
        20,
        "tool.helix_deg",
        "30.0",
    ),
    (
        "corner_radius_mm = 0.0",
        "corner_radius_mm = 9.0",
        21,
        "tool.corner_radius_mm",
        "ball",
    ),
    (
        "spindle_rpm = 10000.0",
        "spindle_rpm = 0",
        23,
        "tool.spindle_rpm",
        "M3",
    ),
    (
        "cycle_ms = 12.0",
        "cycle_ms = 12000",
        8,
        "cycle_ms",
        "milliseconds",
    ),
    (
        "runout_um = 0.0",
        "runout_um = 9000",
        24,
        "tool.runout_um",
        "micrometres",
    ),
    (
        "Ktc_N_mm2 = 1319.41",
        "Ktc_N_mm2 = -1319.41",
        29,
        "material.Ktc_N_mm2",
        "N/mm²",
    ),
    (
        "Krc_N_mm2 = 788.83",
        "Krc_N_mm2 = 788.83\nKrc_ci95_N_mm2 = [800, 770]",
        31,
        "material.Krc_ci95_N_mm2",
        "lower end first",
    ),
    (
        "Krc_N_mm2 = 788.83",
        "Krc_N_mm2 = 788.83\nKrc_ci95_N_mm2 = [-5, -1]",
        31,
        "material.Krc_ci95_N_mm2",
        "about the value",
    ),
    (
        "Kac_N_mm2 = 48.75",
        "",
        27,
        "material.Kac_N_mm2",
        "0.0 where",
    ),
    (
        "rel_std = 0.1",
        "rel_std = 10",
        35,
        "material.rel_std",
        "fraction",
    ),
    (
        "tolerance_mm = 0.2",
        "tolerance_mm = 0",
        40,
        "limits.tolerance_mm",
        "above zero",
    ),
    (
        "[limits]",
        "[spindle]\naxis = [0, 0, 2]\n[limits]",
        38,
        "spindle.axis",
        "unit vector",
    ),
    (
        "[limits]",
        "limits = 3",
        37,
        "material.limits",
        "known keys",
    ),
];

#[test]
fn every_refusal_names_its_line_and_the_remedy() {
    for (old, new, line, key, word) in REFUSALS {
        assert!(JOB.contains(old), "{old}");
        let problem = read(&JOB.replacen(old, new, 1)).unwrap_err();
        let place = (problem.line, problem.column.clone().unwrap_or_default());
        if *word != "TOML" {
            assert_eq!(place, (Some(*line), key.to_string()), "{new}: {problem}");
            assert!(problem.remedy.contains(word), "{new}: {problem}");
        } else {
            assert_eq!(problem.line, Some(*line), "{problem}");
        }
    }
}

#[test]
fn material_and_stock_are_looked_up_beside_the_job_and_hashed() {
    let folder = tempfile::tempdir().unwrap();
    let (head, tail) = JOB.split_once("[material]").unwrap();
    let (material, limits) = tail.split_once("[limits]").unwrap();
    let head = head.replace("[workpiece]", "material = \"al.toml\"\n[workpiece]");
    let text = format!("{head}[limits]{limits}");
    std::fs::write(folder.path().join("job.toml"), &text).unwrap();
    let path = folder.path().join("job.toml");
    let problem = Job::read(&path).unwrap_err();
    assert!(problem.to_string().contains("al.toml"), "{problem}");
    std::fs::write(folder.path().join("al.toml"), material).unwrap();
    let job = Job::read(&path).unwrap();
    assert_eq!(
        job.material().unwrap(),
        read(JOB).unwrap().material().unwrap()
    );
    assert_eq!(job.inputs[0].0, folder.path().join("al.toml"));
    let broken = material.replace("Ktc_N_mm2 = 1319.41", "Ktc_N_mm2 = inf");
    std::fs::write(folder.path().join("al.toml"), broken).unwrap();
    let problem = Job::read(&path).unwrap_err();
    assert_eq!(
        (problem.file, problem.line),
        (Some(folder.path().join("al.toml")), Some(3))
    );
}

#[test]
fn a_job_inside_a_workspace_finds_what_was_identified_there() {
    let folder = tempfile::tempdir().unwrap();
    let part = folder.path().join("measurements/kr210/part");
    std::fs::create_dir_all(&part).unwrap();
    std::fs::create_dir_all(folder.path().join("fits/kr210")).unwrap();
    let robot = folder.path().join("fits/kr210/robot.toml");
    std::fs::write(&robot, "").unwrap();
    let job = part.join("job.toml");
    assert_eq!(
        ident::measurement::job::beside(&job, "fits/kr210/robot.toml"),
        robot
    );
}

/// A law that the cut knows can be stated, with the keys and units of its card.
#[test]
fn a_material_takes_every_force_law() {
    for law in ident::cutting::LAWS {
        let card = law.card();
        let lines = card
            .coefficients
            .iter()
            .map(|c| format!("{} = 0.5\n", c.key));
        let text = format!("law = \"{}\"\n{}", card.name, lines.collect::<String>());
        let material = ident::measurement::job::Material::of_bytes(text.as_bytes()).unwrap();
        assert_eq!(material.law, card.name);
        for (value, c) in material.coefficients.iter().zip(card.coefficients) {
            assert_eq!(*value, 0.5 * c.factor, "{}", c.key);
        }
        let read = ident::cutting::Material::of(material.law, &material.coefficients);
        assert_eq!(read.law.card().name, card.name);
    }
}
