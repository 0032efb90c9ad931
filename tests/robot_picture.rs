//! The robot in space: what gives way adds up, what is drawn is where the robot is.

use crate::bench_of_files::{Bench, document};
use ident::ground::spatial::{norm, sub};
use ident::motion::kinematics::forward_kinematics;
use ident::motion::skeleton::{mean_shares, shares, skeleton, swing};
use ident::motion::statics::displacement;
use ident::motion::{Work, elastic, kinematics};
use ident::robot::Robot;
use ident::robot::builtin;

const Q: [f64; 6] = [0.3, -1.2, 1.5, 0.4, 0.7, -0.2];

fn robots() -> Vec<Robot> {
    ["kr210", "kr300"]
        .map(|name| builtin::named(name).unwrap().unwrap())
        .to_vec()
}

#[test]
fn the_line_ends_where_the_tool_is_and_moves_as_the_tool_does() {
    for robot in robots() {
        let chain = elastic(&robot);
        let mut work = Work::new(&chain);
        let tool = forward_kinematics(&chain, &mut work, &chain.spread(&Q)).point;
        let line = skeleton(&robot, &Q).line;
        assert_eq!(line.len(), robot.dof() + 3);
        assert!(
            norm(sub(*line.last().unwrap(), tool)) < 1e-12,
            "{}",
            robot.name
        );
        let springs: Vec<usize> = ident::motion::statics::springs(&chain)
            .map(|(i, _)| i)
            .collect();
        for (k, hinge) in springs.iter().enumerate() {
            let shape: Vec<f64> = (0..springs.len())
                .map(|i| f64::from(u8::from(i == k)))
                .collect();
            let moved = swing(&robot, &Q, &shape);
            let (v, _) = kinematics::column(&work, *hinge, tool);
            assert!(
                norm(sub(*moved.last().unwrap(), v)) < 1e-7,
                "{} {k}",
                robot.name
            );
            assert!(norm(moved[0]) == 0.0, "the foot stands still");
        }
    }
}

#[test]
fn shares_add_up_and_a_softer_joint_takes_more() {
    for robot in robots() {
        let force = [100.0, -30.0, 50.0];
        let all = shares(&robot, &Q, force);
        assert!((all.iter().map(|s| s.share).sum::<f64>() - 1.0).abs() < 1e-12);
        assert!((mean_shares(&robot, &Q).iter().map(|s| s.share).sum::<f64>() - 1.0).abs() < 1e-12);
        // Without one joint the tool moves less by its share, along the movement.
        for share in all.iter().filter(|s| s.site == "A2") {
            let mut stiff = robot.clone();
            for (site, spring) in stiff.springs_mut() {
                if site == "A2" || site == "A2-tilt" {
                    spring.stiffness *= 1e12;
                }
            }
            let moved = |robot: &Robot| {
                let chain = elastic(robot);
                let mut work = Work::new(&chain);
                kinematics::place(&chain, &mut work, &chain.spread(&Q));
                displacement(&chain, &work, force)
            };
            let (a, b) = (moved(&robot), moved(&stiff));
            let less = 1.0 - ident::ground::spatial::dot(a, b) / norm(a).powi(2);
            assert!((less - share.share).abs() < 1e-9, "{less} {}", share.share);
        }
    }
}

#[test]
fn the_report_draws_the_robot_its_shares_and_its_modes() {
    let bench = Bench::new();
    let words = [
        "robot",
        "report",
        "kr210",
        "--joints-deg",
        "0,-90,90,0,40,0",
        "--json",
    ];
    let json = document(&bench.run(&words));
    let report = json["report"].as_str().unwrap();
    assert_eq!(json["modes"].as_array().unwrap().len(), 6);
    let page = bench.text(report);
    assert_eq!(
        page.matches("<canvas").count(),
        7,
        "the robot and six modes"
    );
    assert_eq!(page.matches("swing:[").count(), 6);
    assert_eq!(page.matches("<svg").count(), 7, "on paper too");
    assert!(page.contains("disc:true") && page.contains("tint:1.000"));
    let first = json["shares"][0]["site"].as_str().unwrap();
    assert!(page.contains(&format!("{first} ")), "{first}");
    let again = [(); 2].map(|()| bench.run(&words).out);
    assert_eq!(again[0], again[1]);
    bench
        .run(&["robot", "report", "kr210", "--joints-deg", "1,2"])
        .is_refusal("angles", "", None, "2 angles for 6");
    bench
        .run(&["robot", "report", "kr210", "--force-N", "0,0,0"])
        .is_refusal("force", "", None, "is no force");
}

#[test]
fn a_robot_without_masses_is_drawn_without_modes() {
    let bench = Bench::new();
    let text = ident::robot::write::write(&{
        let mut robot = robots().remove(0);
        robot.joints.iter_mut().for_each(|joint| joint.link = None);
        robot
    });
    bench.put("light.toml", text.as_bytes());
    let ran = bench.run(&["robot", "report", "light.toml"]);
    assert!(
        ran.out.contains("no modes: ") && ran.status == 0,
        "{}",
        ran.out
    );
}

#[test]
fn the_page_of_the_points_has_the_robot_in_space() {
    let bench = Bench::new();
    let from = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/measurements/kr210/workspace.csv"
    );
    bench.put(
        "measurements/kr210/workspace.csv",
        &std::fs::read(from).unwrap(),
    );
    let ran = bench.run(&["validate"]);
    assert!(ran.status < 2, "{}", ran.errors);
    let page = bench.text("reports/kr210/validate.html");
    assert!(
        page.contains("<canvas") && page.contains("other postures") && page.contains("disc:true")
    );
}

#[test]
fn the_page_of_the_dampings_shows_the_tuned_robot_swing() {
    let bench = Bench::new();
    let from = concat!(env!("CARGO_MANIFEST_DIR"), "/measurements/kr210/hammer.csv");
    bench.put(
        "measurements/kr210/hammer.csv",
        &std::fs::read(from).unwrap(),
    );
    let ran = bench.run(&["damping", "--frf", "--starts", "1"]);
    assert!(ran.status < 2, "{}", ran.errors);
    let page = bench.text("reports/kr210/damping.html");
    assert_eq!(page.matches("swing:[").count(), 4);
    assert!(
        page.contains("Mode 1 at 11.5"),
        "the first mode measured lies at 11.57 Hz"
    );
}

#[test]
fn a_map_of_stiffness_says_what_is_reached_and_how_stiff_it_is_there() {
    let bench = Bench::new();
    let joints = "--joints-deg=0,-90,90,0,40,0";
    let words = [
        "robot",
        "map",
        "kr210",
        joints,
        "--step-mm",
        "200",
        "--json",
    ];
    let ran = bench.run(&words);
    assert_eq!(ran.status, 0, "{}", ran.errors);
    let body = document(&ran);
    let cells = body["cells"].as_array().unwrap();
    assert!(cells.len() > 50 && body["not_reached"].as_u64().unwrap() > 50);
    let robot = builtin::named("kr210").unwrap().unwrap();
    let chain = elastic(&robot);
    let mut work = Work::new(&chain);
    let list = |value: &serde_json::Value| -> Vec<f64> {
        value
            .as_array()
            .unwrap()
            .iter()
            .map(|v| v.as_f64().unwrap())
            .collect()
    };
    for cell in cells.iter().step_by(7) {
        let q = list(&cell["joints_rad"]);
        for (joint, angle) in robot.joints.iter().zip(&q) {
            assert!(joint.limits[0] - 1e-9 <= *angle && *angle <= joint.limits[1] + 1e-9);
        }
        let at = forward_kinematics(&chain, &mut work, &chain.spread(&q)).point;
        let told = list(&cell["at_m"]);
        assert!((0..3).all(|k| (at[k] - told[k]).abs() < 1e-9));
        // The least is what the softest direction gives, by the deflection under a force.
        let soft = list(&cell["softest_direction"]);
        let moved = displacement(&chain, &work, [soft[0], soft[1], soft[2]]);
        let least = cell["least_N_m"].as_f64().unwrap();
        assert!((norm(moved) * least - 1.0).abs() < 1e-9);
        for force in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.6, 0.0, 0.8]] {
            let k = 1.0 / norm(displacement(&chain, &work, force));
            assert!(
                k > least * (1.0 - 1e-9)
                    && k < cell["greatest_N_m"].as_f64().unwrap() * (1.0 + 1e-9)
            );
        }
    }
    assert!(
        bench.path("reports/kr210/map-least.svg").is_file()
            || bench.files().iter().any(|f| f.ends_with("map-least.svg"))
    );
    for (more, told) in [
        ("0", "--step-mm"),
        ("0.001", "--step-mm"),
        ("nan", "--step-mm"),
        ("1", "--step-mm"),
    ] {
        let ran = bench.run(&[
            "robot",
            "map",
            "kr210",
            joints,
            "--step-mm",
            more,
            "--dry-run",
        ]);
        assert!(
            ran.status == 2 && ran.errors.contains(told),
            "{more}: {}",
            ran.errors
        );
    }
    let ran = bench.run(&["robot", "map", "kr210", "--joints-deg=0,0", "--dry-run"]);
    assert!(
        ran.status == 2 && ran.errors.contains("2 angles for 6 joints"),
        "{}",
        ran.errors
    );
}
