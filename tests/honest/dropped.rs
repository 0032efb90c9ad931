//! Rule 2: nothing is dropped or ignored in silence.

use crate::bench_of_files::{Bench, Ran, document};
use crate::honest::file::File;

/// A campaign with one axis test and the points, for a robot whose joints are called `joint_1..6`.
fn campaign(bench: &Bench, axis: &File) {
    let robot = bench.run(&["robot", "convert", "kr210"]);
    let mut text = robot.out;
    for n in 1..=6 {
        text = text.replace(
            &format!("name = \"A{n}\""),
            &format!("name = \"joint_{n}\""),
        );
    }
    assert!(text.contains("joint_6"), "{text}");
    bench.put("measurements/c/robot.toml", text.as_bytes());
    let local = |file: File| file.fact("robot", "\"robot.toml\"");
    bench.put(
        "measurements/c/axis6.csv",
        local(axis.clone()).text().as_bytes(),
    );
    bench.put(
        "measurements/c/points.csv",
        local(File::example("workspace.csv")).text().as_bytes(),
    );
}

fn softer() -> File {
    File::example("axis6.csv")
        .map("displacement_mm", |_, d| 1.3 * d)
        .map("displacement2_mm", |_, d| 1.3 * d)
}

fn stiffness_of(text: &str, joint: &str) -> f64 {
    let from = text.find(&format!("\"{joint}\"")).unwrap();
    let at = from + text[from..].find("stiffness_Nm_rad = ").unwrap() + "stiffness_Nm_rad = ".len();
    let end = text[at..].find([',', ' ', '\n']).unwrap();
    text[at..at + end].parse().unwrap()
}

#[test]
fn axis_tests_reach_joints_of_any_name() {
    let bench = Bench::new();
    campaign(&bench, &softer());
    let ran = bench.run(&["stiffness", "measurements/c/axis6.csv"]);
    assert!(ran.status < 2, "{}", ran.errors);
    let found = stiffness_of(&bench.text("fits/c/robot.toml"), "joint_6");
    assert!((found / (314_030.0 / 1.3) - 1.0).abs() < 0.05, "{found}");
}

#[test]
fn fits_of_gone_and_changed_files_are_not_used() {
    let bench = Bench::new();
    campaign(&bench, &softer());
    assert!(bench.run(&["stiffness", "measurements/c/axis6.csv"]).status < 2);
    std::fs::remove_file(bench.path("measurements/c/axis6.csv")).unwrap();
    let ran = bench.run(&["validate", "measurements/c/points.csv"]);
    assert!(
        ran.errors.contains("is not used: its measurement"),
        "{}",
        ran.errors
    );
    let found = stiffness_of(&bench.text("fits/c/robot.toml"), "joint_6");
    assert!((found / (314_030.0 / 1.3) - 1.0).abs() > 0.1, "{found}");
}

#[test]
fn repeats_that_contradict_each_other_are_pooled_and_named() {
    let bench = Bench::new();
    campaign(&bench, &softer());
    let again = File::example("axis6.csv").fact("robot", "\"robot.toml\"");
    bench.put("measurements/c/again.csv", again.text().as_bytes());
    bench.run(&[
        "stiffness",
        "measurements/c/axis6.csv",
        "measurements/c/again.csv",
    ]);
    let ran = bench.run(&[
        "validate",
        "--dry-run",
        "--json",
        "measurements/c/points.csv",
    ]);
    assert!(
        ran.errors.contains("contradict each other"),
        "{}",
        ran.errors
    );
    let found = stiffness_of(&bench.text("fits/c/robot.toml"), "joint_6");
    let (low, high) = (314_030.0 / 1.3, 314_030.0);
    assert!(found > 1.03 * low && found < 0.97 * high, "{found}");
}

#[test]
fn run_mentions_what_no_step_takes() {
    let bench = Bench::new();
    campaign(&bench, &softer());
    std::fs::remove_file(bench.path("measurements/c/points.csv")).unwrap();
    bench.put("measurements/c/other.csv", b"a,b\n1,2\n");
    bench.put(
        "measurements/c/typo.csv",
        b"# kind = \"load-cycel\"\ntime_s,force_N\n1,2\n",
    );
    let ran = bench.run(&["run", "measurements/c"]);
    assert_eq!(ran.status, 1, "{}", ran.errors);
    assert!(
        ran.out.contains("other.csv does not say its kind"),
        "{}",
        ran.out
    );
    assert!(ran.out.contains("`load-cycle` is meant"), "{}", ran.out);
}

fn refused(text: &str, says: &str) -> Ran {
    let bench = Bench::new();
    bench.put("a.csv", text.as_bytes());
    let ran = bench.run(&["stiffness", "a.csv"]);
    assert_eq!(ran.status, 2, "{says}: {}", ran.out);
    assert!(ran.errors.contains(says), "{says}: {}", ran.errors);
    assert!(ran.errors.contains("a.csv:"), "{}", ran.errors);
    ran
}

#[test]
fn unknown_facts_are_refused_with_the_nearest_known_one() {
    let with = |key: &str| File::example("axis6.csv").fact(key, "1.0").text();
    refused(&with("sensor_delay"), "`sensor_delay_s`");
    refused(&with("rest_S"), "`rest_s`");
    refused(&with("operator"), "notes");
    let noted = File::example("axis6.csv").fact("notes", "{ operator = \"N.N.\" }");
    let bench = Bench::new();
    bench.put("a.csv", noted.text().as_bytes());
    assert_eq!(bench.run(&["stiffness", "--dry-run", "a.csv"]).status, 0);
}

#[test]
fn results_never_take_the_name_of_others() {
    for name in ["robot.csv", "a-extended.csv"] {
        let bench = Bench::new();
        let path = format!("measurements/c/{name}");
        bench.put(&path, File::example("axis6.csv").text().as_bytes());
        let ran = bench.run(&["stiffness", &path]);
        assert_eq!(ran.status, 2);
        assert!(ran.errors.contains("would overwrite"), "{}", ran.errors);
    }
}

const URDF: &str = "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>
<joint name=\"one\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 1\"/></joint>
<joint name=\"two\" type=\"revolute\"><parent link=\"b\"/><child link=\"c\"/><origin xyz=\"0 0 0.3\"/><axis xyz=\"0 1 0\"/></joint>
</robot>";

#[test]
fn malformed_attributes_and_doubled_joints_of_a_urdf_are_refused() {
    let check = |text: &str, says: &str| {
        let bench = Bench::new();
        bench.put("r.urdf", text.as_bytes());
        let ran = bench.run(&[
            "simulate",
            "pose",
            "--robot",
            "r.urdf",
            "--joints-deg",
            "0,0",
        ]);
        assert_eq!(ran.status, 2, "{says}: {}", ran.out);
        assert!(ran.errors.contains(says), "{}", ran.errors);
    };
    check(
        &URDF.replace(
            "<origin xyz=\"0 0 0.3\"/>",
            "<origin rpy=0 xyz=\"0 0 0.3\"/>",
        ),
        "origin",
    );
    check(
        &URDF.replace("name=\"two\"", "name=\"one\""),
        "occurs twice",
    );
}

#[test]
fn a_truncated_file_of_force_steps_is_noticed() {
    let whole = File::example("workspace.csv");
    let cut = whole.clone().rows(|i| i < 1000);
    let bench = Bench::new();
    bench.put("a.csv", cut.text().as_bytes());
    for verb in ["validate", "diagnose"] {
        let ran = bench.run(&[verb, "--json", "--dry-run", "a.csv"]);
        assert_eq!(ran.status, 1, "{verb}");
        assert!(
            document(&ran)["doubts"].to_string().contains("\"few\""),
            "{verb}"
        );
    }
}

#[test]
fn facts_beside_a_file_that_no_kind_knows_are_refused_where_they_stand() {
    for (name, line) in [("campaign.toml", 2), ("a.ident.toml", 2)] {
        let bench = Bench::new();
        bench.put("a.csv", File::example("axis6.csv").text().as_bytes());
        bench.put(name, b"synthetic = true\nlever_rel_stdd = 0.5\n");
        let ran = bench.run(&["stiffness", "--dry-run", "a.csv"]);
        ran.is_refusal(name, name, Some(line), "lever_rel_stdd");
        assert!(ran.errors.contains("`lever_rel_std`"), "{}", ran.errors);
        bench.put(name, b"synthetic = \xff\n");
        let ran = bench.run(&["stiffness", "--dry-run", "a.csv"]);
        ran.is_refusal(name, name, Some(1), "UTF-8");
    }
}
