//! `ident new robot --from`: tables of Denavit and Hartenberg and URDF become robots that pass the check.

use crate::bench_of_files::{Bench, document};
use ident::ground::random::Random;
use ident::motion::build::rigid;
use ident::motion::kinematics::forward_kinematics;
use ident::motion::work::Work;
use ident::robot::dh::{Convention, DhTable, Row};
use ident::robot::{Robot, load};
use nalgebra::Matrix4;

fn turn_z(a: f64) -> Matrix4<f64> {
    let (s, c) = a.sin_cos();
    Matrix4::new(
        c, -s, 0.0, 0.0, s, c, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    )
}

fn turn_x(a: f64) -> Matrix4<f64> {
    let (s, c) = a.sin_cos();
    Matrix4::new(
        1.0, 0.0, 0.0, 0.0, 0.0, c, -s, 0.0, 0.0, s, c, 0.0, 0.0, 0.0, 0.0, 1.0,
    )
}

fn shift(x: f64, y: f64, z: f64) -> Matrix4<f64> {
    Matrix4::new_translation(&nalgebra::Vector3::new(x, y, z))
}

/// The product of the table as the books write it.
fn product(table: &DhTable, q: &[f64]) -> Matrix4<f64> {
    let one = |(row, q): (&Row, &f64)| {
        let q = if row.reversed { -q } else { *q };
        let theta = row.theta_deg.to_radians() + q;
        let alpha = row.alpha_deg.to_radians();
        match table.convention {
            Convention::Classic => {
                turn_z(theta) * shift(0.0, 0.0, row.d_m) * shift(row.a_m, 0.0, 0.0) * turn_x(alpha)
            }
            Convention::Modified => {
                turn_x(alpha) * shift(row.a_m, 0.0, 0.0) * turn_z(theta) * shift(0.0, 0.0, row.d_m)
            }
        }
    };
    let chain = table
        .rows
        .iter()
        .zip(q)
        .map(one)
        .fold(Matrix4::<f64>::identity(), |m, t| m * t);
    chain * shift(table.tool[0], table.tool[1], table.tool[2])
}

fn row(random: &mut Random) -> Row {
    let right = [-90.0, 0.0, 90.0, 180.0][(random.unit() * 4.0) as usize];
    Row {
        theta_deg: 360.0 * random.unit() - 180.0,
        d_m: random.unit() - 0.3,
        a_m: random.unit() - 0.3,
        alpha_deg: if random.unit() < 0.5 {
            right
        } else {
            360.0 * random.unit()
        },
        reversed: random.unit() < 0.4,
        bearing_m: random.unit(),
        limits_deg: [-180.0, 180.0],
        max_speed_deg_s: None,
        stiffness: None,
        tilt_stiffness: None,
        rel_std: None,
        mass_kg: None,
    }
}

fn agrees(robot: &Robot, table: &DhTable, random: &mut Random) -> f64 {
    let q: Vec<f64> = (0..robot.dof())
        .map(|_| 6.0 * random.unit() - 3.0)
        .collect();
    let chain = rigid(robot);
    let pose = forward_kinematics(&chain, &mut Work::new(&chain), &q);
    let wanted = product(table, &q);
    let mut worst = 0.0_f64;
    for i in 0..3 {
        worst = worst.max((pose.point[i] - wanted[(i, 3)]).abs());
        for j in 0..3 {
            worst = worst.max((pose.rotation[i][j] - wanted[(i, j)]).abs());
        }
    }
    worst
}

#[test]
fn forward_kinematics_is_the_product_of_the_table() {
    let mut random = Random::new(7);
    let mut worst = 0.0_f64;
    for case in 0..200 {
        let convention = if case % 2 == 0 {
            Convention::Classic
        } else {
            Convention::Modified
        };
        let table = DhTable {
            name: "random".into(),
            source: String::new(),
            convention,
            rows: (0..3 + case % 5).map(|_| row(&mut random)).collect(),
            tool: [0.1, -0.2, 0.3],
            mass_kg: None,
        };
        worst = worst.max(agrees(&table.robot(), &table, &mut random));
    }
    println!("worst difference {worst:.1e}");
    assert!(worst < 1e-12, "{worst}");
}

/// A robot of the trade, modified convention, with two stated springs.
const TABLE: &str = "# name = \"bench-arm\"\n# source = \"data sheet\"\n# convention = \"modified\"\n# tool_m = [0.0, 0.0, 0.2]\n\
theta_deg,d_m,a_m,alpha_deg,low_deg,high_deg,stiffness_Nm_rad,stiffness_rel_std,mass_kg\n\
0,0.6,0,0,-170,170,2.5e6,0.2,\n-90,0,0.2,-90,-120,60,,,\n0,0,0.8,0,-60,200,1e6,,\n0,0.75,0.1,-90,-180,180,,,20\n0,0,0,90,-120,120,,,\n0,0.2,0,-90,-350,350,,,\n";

#[test]
fn a_table_becomes_a_robot_that_passes_the_check() {
    let bench = Bench::new();
    bench.put("arm.csv", TABLE.as_bytes());
    let ran = bench.run(&["new", "robot", "arm.toml", "--from", "arm.csv"]);
    assert_eq!(ran.status, 0, "{} {}", ran.out, ran.errors);
    assert!(
        ran.out.contains("guessed: A2: stiffness and damping"),
        "{}",
        ran.out
    );
    assert!(bench.text("arm.svg").contains("A5"));
    assert_eq!(bench.run(&["robot", "check", "arm.toml"]).status, 0);
    let robot = load(bench.path("arm.toml").to_str().unwrap(), None)
        .unwrap()
        .robot;
    let drive = |i: usize| robot.joints[i].drive.clone().unwrap();
    assert_eq!(
        (drive(0).stiffness, drive(0).stiffness_rel_std),
        (2.5e6, Some(0.2))
    );
    assert_eq!(
        (drive(2).stiffness, drive(2).stiffness_rel_std),
        (1e6, Some(0.5))
    );
    assert_eq!(robot.joints[3].link.unwrap().mass, 20.0);
    assert_eq!(drive(1).stiffness_rel_std, Some(0.5));
    let table = ident::robot::dh::read(TABLE, None).unwrap();
    let worst = agrees(&robot, &table, &mut Random::new(2));
    assert!(worst < 1e-12, "as written and read again: {worst}");
    let again = bench.run(&["new", "robot", "arm.toml", "--from", "arm.csv"]);
    again.is_refusal("there", "arm.toml", None, "nothing is overwritten");
    let heavy = document(&bench.run(&[
        "new",
        "robot",
        "--from",
        "arm.csv",
        "--dry-run",
        "--json",
        "--mass-kg",
        "500",
    ]));
    let text = heavy["text"].as_str().unwrap();
    let heavy = ident::robot::file::read(text).unwrap();
    let all: f64 = heavy.joints.iter().map(|j| j.link.unwrap().mass).sum();
    assert!((all - 500.0).abs() < 3.0, "{all} kg");
    bench
        .run(&["new", "robot", "--from", "arm.csv", "--mass-kg", "10"])
        .is_refusal("light", "arm.csv", None, "less than");
}

#[test]
fn a_larger_robot_of_the_same_form_is_softer_in_no_axis() {
    let bench = Bench::new();
    let twice: String = TABLE
        .lines()
        .map(
            |line| match line.starts_with('#') || line.starts_with("theta") {
                true => format!("{line}\n"),
                false => {
                    let mut cells: Vec<String> = line.split(',').map(String::from).collect();
                    for k in [1, 2] {
                        cells[k] = (2.0 * cells[k].parse::<f64>().unwrap()).to_string();
                    }
                    cells[6..].iter_mut().for_each(String::clear);
                    cells.join(",") + "\n"
                }
            },
        )
        .collect();
    let plain: String = twice.replace("1.2,", "0.6,");
    assert_ne!(plain, twice);
    bench.put("twice.csv", twice.as_bytes());
    let json =
        document(&bench.run(&["new", "robot", "--from", "twice.csv", "--dry-run", "--json"]));
    let robot = ident::robot::file::read(json["text"].as_str().unwrap()).unwrap();
    let like = ident::robot::builtin::named("kr210").unwrap().unwrap();
    let by = json["reach_m"].as_f64().unwrap() / ident::robot::guess::reach(&like);
    for (own, other) in robot.joints.iter().zip(&like.joints) {
        let [a, b] = [own, other].map(|j| j.drive.clone().unwrap());
        assert!((a.stiffness / (b.stiffness * by.powi(3)) - 1.0).abs() < 0.01);
        assert!((a.damping / (b.damping * by.powi(4)) - 1.0).abs() < 0.02);
    }
}

const URDF: &str = r#"<robot name="two"><link name="base"/><link name="l1"><inertial><origin xyz="0 0 0.2"/><mass value="12"/>
<inertia ixx="0.3" iyy="0.3" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link><link name="l2"/>
<joint name="j1" type="revolute"><parent link="base"/><child link="l1"/><origin xyz="0 0 0.4"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="2"/></joint>
<joint name="j2" type="revolute"><parent link="l1"/><child link="l2"/><origin xyz="0.1 0 0.5"/><axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="1" velocity="2"/></joint>
<joint name="t" type="fixed"><parent link="l2"/><child link="tool0"/><origin xyz="0.7 0 0"/></joint><link name="tool0"/></robot>"#;

#[test]
fn urdf_keeps_its_bodies_and_gets_springs() {
    let bench = Bench::new();
    bench.put("two.urdf", URDF.as_bytes());
    let ran = bench.run(&["new", "robot", "--from", "two.urdf", "--spread", "1.0"]);
    assert_eq!(ran.status, 0, "{} {}", ran.out, ran.errors);
    assert_eq!(bench.run(&["robot", "check", "robot.toml"]).status, 0);
    let robot = load(bench.path("robot.toml").to_str().unwrap(), None)
        .unwrap()
        .robot;
    assert_eq!(robot.joints[0].link.unwrap().mass, 12.0);
    assert!(robot.joints[1].link.unwrap().mass > 0.0, "guessed");
    assert!(
        robot
            .joints
            .iter()
            .all(|j| j.drive.as_ref().unwrap().stiffness_rel_std == Some(1.0))
    );
}

#[test]
fn a_table_without_convention_is_refused_with_both_words() {
    let bench = Bench::new();
    bench.put(
        "arm.csv",
        TABLE
            .replace("# convention = \"modified\"\n", "#\n")
            .as_bytes(),
    );
    let ran = bench.run(&["new", "robot", "--from", "arm.csv"]);
    ran.is_refusal("convention", "arm.csv", None, "modified");
    assert_eq!(
        bench
            .run(&[
                "new",
                "robot",
                "--from",
                "arm.csv",
                "--convention",
                "modified"
            ])
            .status,
        0
    );
    bench
        .run(&["new", "job", "--from", "arm.csv"])
        .is_refusal("job", "", None, "robots only");
}
