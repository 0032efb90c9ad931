//! Robot files: what reads, what is refused, and that nothing panics.

use ident::ground::random::Random;
use ident::motion::{self, Work};
use ident::robot::{builtin, check, file, load, urdf, write};
use std::path::Path;

const GOOD: &str = r#"
name = "two"
source = "made up"
[[joints]]
name = "A1"
axis = [0.0, 0.0, 1.0]
point_m = [0.0, 0.0, 0.5]
limits_deg = [-90.0, 90.0]
drive = { stiffness_Nm_rad = 1.0e6, damping_Nms_rad = 10.0, backlash_rad = [1e-5, 2e-5] }
link = { mass_kg = 10.0, com_m = [0.1, 0.0, 0.5], inertia_kgm2 = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0] }
[tool]
tcp_m = [1.0, 0.0, 0.5]
[[elastic]]
name = "base-x"
after = 0
axis = [1.0, 0.0, 0.0]
point_m = [0.0, 0.0, 0.0]
stiffness_Nm_rad = 1.0e7
"#;

#[test]
fn a_small_robot_reads() {
    let robot = file::read(GOOD).unwrap();
    assert!((robot.joints[0].drive.as_ref().unwrap().gap() - 3e-5).abs() < 1e-20);
    check::dynamics(&robot).unwrap();
    let chain = motion::elastic(&robot);
    assert_eq!(chain.names, ["base-x", "A1"]);
    assert_eq!(file::read(&write::write(&robot)).unwrap(), robot);
}

#[test]
fn a_joint_may_state_its_accelerations() {
    let limits = "limits_deg = [-90.0, 90.0]";
    let text = GOOD.replace(
        limits,
        &format!("{limits}\nmax_acceleration_deg_s2 = 250.0"),
    );
    let robot = file::read(&text).unwrap();
    let stated = robot.joints[0].max_acceleration.unwrap();
    assert!((stated.to_degrees() - 250.0).abs() < 1e-12);
    assert_eq!(file::read(&write::write(&robot)).unwrap(), robot);
}

#[test]
fn a_stiffness_may_state_its_spread_where_no_interval_is_known() {
    let with = |spread: &str| {
        let text = format!("stiffness_Nm_rad = 1.0e6, stiffness_rel_std = {spread}");
        file::read(&GOOD.replace("stiffness_Nm_rad = 1.0e6", &text))
    };
    let robot = with("0.1").unwrap();
    let drive = robot.joints[0].drive.as_ref().unwrap();
    assert_eq!(drive.relative_std(), Some(0.1));
    for wrong in ["-0.1", "0.0", "nan", "\"some\""] {
        assert!(with(wrong).is_err(), "{wrong}");
    }
}

/// Text replaced, words that the problem must name, line if it has one.
const BAD: &[(&str, &str, &[&str], Option<usize>)] = &[
    (
        "axis = [0.0, 0.0, 1.0]",
        "axis = [0.0, 0.0, 2.0]",
        &["A1", "axis", "length 2"],
        Some(4),
    ),
    (
        "axis = [0.0, 0.0, 1.0]",
        "axis = [0.0, 0.0, 0.0]",
        &["A1", "axis", "direction"],
        Some(4),
    ),
    (
        "axis = [0.0, 0.0, 1.0]",
        "axis = [0.0, 1.0]",
        &["length"],
        Some(6),
    ),
    (
        "limits_deg = [-90.0, 90.0]",
        "limits_deg = [90.0, -90.0]",
        &["A1", "limits_deg"],
        Some(4),
    ),
    (
        "limits_deg = [-90.0, 90.0]",
        "limits_deg = [-90.0, 90.0]\nmax_acceleration_deg_s2 = 0.0",
        &["A1", "max_acceleration_deg_s2", "positive"],
        Some(4),
    ),
    (
        "stiffness_Nm_rad = 1.0e6",
        "stiffness_Nm_rad = -1.0e6",
        &["A1", "stiffness_Nm_rad"],
        Some(4),
    ),
    (
        "stiffness_Nm_rad = 1.0e6",
        "stiffness_Nm_rad = inf",
        &["A1", "stiffness_Nm_rad"],
        Some(4),
    ),
    (
        "stiffness_Nm_rad = 1.0e6",
        "stiffness = 1.0e6",
        &["stiffness"],
        Some(9),
    ),
    (
        "damping_Nms_rad = 10.0",
        "damping_Nms_rad = -1.0",
        &["damping_Nms_rad"],
        Some(4),
    ),
    ("[1e-5, 2e-5]", "[1e-5, -2e-5]", &["backlash_rad"], Some(4)),
    ("after = 0", "after = 7", &["base-x", "after"], Some(13)),
    ("after = 0", "after = -1", &["after"], None),
    ("name = \"base-x\"", "name = \"A1\"", &["A1", "named"], None),
    (
        "tcp_m = [1.0, 0.0, 0.5]",
        "tcp_m = [nan, 0.0, 0.5]",
        &["tcp_m"],
        Some(11),
    ),
    (
        "tcp_m = [1.0, 0.0, 0.5]",
        "tcp_m = [1e300, 0.0, 0.5]",
        &["tcp_m", "kilometres"],
        Some(11),
    ),
    (
        "tcp_m = [1.0, 0.0, 0.5]",
        "tcp_m = [1.0, 0.0, 0.5]\nrotation = [[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]",
        &["rotation"],
        Some(11),
    ),
    ("name = \"two\"", "", &["name"], None),
    ("[[joints]]", "[[joint]]", &["joint"], None),
    ("name = \"two\"", "name = two", &[], Some(2)),
];

#[test]
fn bad_files_are_refused_with_place_and_remedy() {
    for (from, to, words, line) in BAD {
        let text = GOOD.replacen(from, to, 1);
        assert_ne!(text, GOOD, "{from}");
        let problem = file::read(&text).unwrap_err();
        let said = format!("{problem}");
        assert!(words.iter().all(|word| said.contains(word)), "{to}: {said}");
        assert!(
            line.is_none() || problem.line == *line,
            "{to}: {said} at {:?}",
            problem.line
        );
        assert!(!problem.remedy.is_empty());
    }
}

#[test]
fn impossible_bodies_are_refused_with_link_and_axis() {
    let text = GOOD.replace(
        "inertia_kgm2 = [1.0, 1.0, 1.0",
        "inertia_kgm2 = [1.0, 1.0, 3.0",
    );
    let problem = check::dynamics(&file::read(&text).unwrap()).unwrap_err();
    assert!(
        problem.what.contains("link1")
            && problem.what.contains("A1")
            && problem.what.contains("triangle"),
        "{problem}"
    );
    let text = GOOD.replace("link = {", "#link = {");
    let robot = file::read(&text).unwrap();
    assert!(
        check::dynamics(&robot)
            .unwrap_err()
            .what
            .contains("link1 has no mass")
    );
    check::bodies(&robot).unwrap();
}

#[test]
fn torn_files_never_panic() {
    let texts = [GOOD, builtin::text("kr300").unwrap(), URDF];
    let mut random = Random::new(11);
    for text in texts {
        for _ in 0..2000 {
            let mut bytes = text.as_bytes().to_vec();
            let at = random.below(bytes.len());
            bytes[at] = (random.bits() & 0xff) as u8;
            bytes.truncate(bytes.len() - random.below(bytes.len()) * random.below(2));
            if let Ok(robot) = load::read(&bytes) {
                let chain = motion::elastic(&robot);
                motion::forward_kinematics(
                    &chain,
                    &mut Work::new(&chain),
                    &chain.spread(&[0.1; 6]),
                );
                let _ = (
                    check::dynamics(&robot),
                    check::remarks(&robot),
                    write::write(&robot),
                );
            }
        }
    }
}

const URDF: &str = r#"<robot name="r">
<link name="base"/><link name="arm"><inertial><mass value="2"/><origin xyz="0 0 1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
<link name="tool0"/>
<joint name="j" type="revolute"><origin xyz="0 0 1"/><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/><limit lower="-1" upper="1"/></joint>
<joint name="t" type="fixed"><origin xyz="0 0 2"/><parent link="arm"/><child link="tool0"/></joint>
</robot>"#;

#[test]
fn urdf_reads_and_refuses() {
    let robot = urdf::read(URDF).unwrap();
    assert_eq!(
        (
            robot.dof(),
            robot.tool.tcp,
            robot.joints[0].link.unwrap().com
        ),
        (1, [0.0, 0.0, 3.0], [0.0, 0.0, 2.0])
    );
    let says = |text: &str, word: &str| {
        let problem = urdf::read(text).unwrap_err();
        assert!(problem.to_string().contains(word), "{problem}");
        problem
    };
    assert_eq!(says(&URDF.replace("0 1 0", "0 one 0"), "xyz").line, Some(4));
    says(&URDF.replace("0 1 0", "0 0 0"), "axis");
    says(&URDF.replace("revolute", "prismatic"), "prismatic");
    says(&URDF.replace("</robot>", ""), "ends inside <robot>");
    says(
        &URDF
            .replace("type=\"fixed\"", "type=\"revolute\"")
            .replace("parent link=\"arm\"", "parent link=\"base\""),
        "branches",
    );
    says("<html></html>", "no URDF");
}

#[test]
fn a_relative_path_is_looked_up_beside_the_measurement() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("robot.toml"), GOOD).unwrap();
    let measurement = folder.path().join("load.csv");
    assert_eq!(
        load::load("robot.toml", Some(&measurement))
            .unwrap()
            .robot
            .name,
        "two"
    );
    let problem = load::load("robot.toml", Some(Path::new("elsewhere/load.csv"))).unwrap_err();
    assert!(problem.remedy.contains("kr210"), "{problem}");
}
