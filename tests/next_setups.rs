//! `ident diagnose --next`: what is exactly confounded is seen to be, the sensor goes where it tells,
//! and the set-ups that are proposed do separate when they are measured.

use ident::findings::next_setups::{
    Belief, Desk, FOOT_LEVER, Reach, Seat, Setting, Sights, candidates,
};
use ident::ground::random::Random;
use ident::ground::spatial::{V3, cross, sub};
use ident::measurement::rig::Rig;
use ident::measurement::workspace_test::WorkspaceTest;
use ident::motion::kinematics::{forward_kinematics, place, tcp};
use ident::motion::statics::displacement;
use ident::motion::{Work, elastic, rigid};
use ident::robot::model::ElasticAxis;
use ident::robot::{Robot, Spring, builtin};
use nalgebra::DVector;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn kr210() -> Robot {
    builtin::named("kr210").unwrap().unwrap()
}

fn measurements() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210")
}

fn nine_points() -> WorkspaceTest {
    WorkspaceTest::read(&measurements().join("workspace.csv")).unwrap()
}

fn pair(belief: &Belief, a: &str, b: &str) -> (usize, usize) {
    (belief.index(a).unwrap(), belief.index(b).unwrap())
}

fn correlation(belief: &Belief, a: &str, b: &str) -> f64 {
    let (a, b) = pair(belief, a, b);
    belief.correlation(a, b).abs()
}

fn open(a: &str, b: &str) -> Vec<(String, String)> {
    vec![(a.to_string(), b.to_string())]
}

#[test]
fn base_about_z_and_a1_are_one_for_every_sensor_but_the_foot() {
    let desk = Desk::new(&kr210(), &[], None);
    let sights = Sights::of(&desk.unknowns);
    let (a1, base) = pair(&desk.belief, "A1", "base-z");
    let scale = desk.unknowns.sites[base].compliance / desk.unknowns.sites[a1].compliance;
    let (mut looked, mut told) = (0, 0);
    for setting in candidates(&desk.unknowns.robot, &[], &Rig::default()) {
        let rows = sights.rows(&setting);
        let apart = (rows.column(base) - scale * rows.column(a1)).norm();
        let size = rows.column(a1).norm().max(rows.column(base).norm());
        match setting.seat {
            Seat::Foot => told += usize::from(apart > 0.5 * size && size > 0.0),
            _ => assert!(apart <= 1e-9 * size, "{setting:?}"),
        }
        looked += 1;
    }
    assert!(looked > 5000 && told > 100, "{looked} {told}");
}

#[test]
fn a_foot_sensor_is_proposed_and_separates() {
    let desk = Desk::new(&kr210(), &[], Some(&nine_points()));
    let plan = desk.plan(5, &open("A1", "base"));
    let foot = |seat: Seat| seat == Seat::Foot;
    assert!(plan.chosen.iter().any(|one| foot(one.setting.seat)));
    let base = plan.before.index("base-z").unwrap();
    assert!(plan.after.std(base) < 0.2 * plan.before.std(base));
    assert!(correlation(&plan.before, "base-z", "link1-z") > 0.9);
    assert!(correlation(&plan.after, "base-z", "link1-z") < 0.3);
    let gains: f64 = plan.chosen.iter().map(|one| one.gain).sum();
    assert!(plan.chosen.iter().all(|one| one.gain > 0.0) && gains > 5.0);
}

/// One direction of the bearing of A5 lies along the drive axis of A6 while A5 stands at zero.
#[test]
fn a6_drive_and_a5_tilt_about_the_same_line_are_one_until_the_wrist_bends() {
    let mut robot = kr210();
    let last = robot.joints[5].clone();
    robot.elastic.push(ElasticAxis {
        name: "A5-line".into(),
        after: 4,
        axis: last.axis,
        point: last.point,
        spring: last.drive.clone().unwrap(),
        body: None,
    });
    let mut desk = Desk::new(&robot, &[], None);
    let (a6, line) = pair(&desk.belief, "A6", "A5-line");
    let settings: Vec<Setting> = (0..9)
        .map(|i| Setting {
            angles: [0.0, -90.0, 90.0, 0.0, 0.0, 0.0]
                .map(f64::to_radians)
                .to_vec(),
            reach: Reach::ALL[i / 3],
            direction: i % 3,
            seat: Seat::Tool,
        })
        .collect();
    let rows = Sights::of(&desk.unknowns).all(&settings, &desk.noise, &desk.belief.mean);
    for rows in &rows {
        let size = rows.column(a6).norm();
        assert!((rows.column(a6) - rows.column(line)).norm() <= 1e-9 * size);
        desk.belief.expect(rows);
    }
    // Link 5 about x and the tool about its own z share the line of the drive for good, link 4 that of the tilt: the
    // two sums are what bending the wrist can tell apart.
    let mut direction = DVector::zeros(desk.belief.sites.len());
    let signs = [
        ("A6", 1.0),
        ("link5-x", 1.0),
        ("tool-z", 1.0),
        ("A5-line", -1.0),
        ("link4-x", -1.0),
    ];
    for (site, sign) in signs {
        let i = desk.belief.index(site).unwrap();
        direction[i] = sign * desk.unknowns.sites[i].compliance;
    }
    let apart = |belief: &Belief| (&belief.covariance * &direction).dot(&direction).sqrt();
    let plan = desk.plan(5, &open("A6", "A5-line"));
    let left = apart(&plan.after) / apart(&desk.belief);
    assert!(left < 0.6, "{left}");
}

/// What a sensor reads per newton on a robot with a foundation that turns, by statics alone.
fn reading(truth: &Robot, setting: &Setting) -> V3 {
    let mut robot = truth.clone();
    robot.tool.tcp = setting.reach.tip(truth);
    let mut force = [0.0; 3];
    force[setting.direction] = 1.0;
    match setting.seat {
        Seat::Tool => {
            let chain = elastic(&robot);
            let mut work = Work::new(&chain);
            place(&chain, &mut work, &chain.spread(&setting.angles));
            displacement(&chain, &work, force)
        }
        Seat::Foot => {
            let chain = rigid(&robot);
            let at = forward_kinematics(&chain, &mut Work::new(&chain), &setting.angles).point;
            let moment = cross(at, force);
            let base = robot
                .elastic
                .iter()
                .find(|axis| axis.name == "base-z")
                .unwrap();
            [0.0, 0.0, FOOT_LEVER * moment[2] / base.spring.stiffness]
        }
        Seat::Link(i) => {
            let (end, tip) = (robot.joints[i].point, robot.tool.tcp);
            // The difference between the movement of two points of a robot cut off behind the link.
            let mut cut = robot.clone();
            cut.joints.truncate(i);
            cut.elastic.retain(|axis| axis.after <= i);
            cut.tool.body = None;
            let mut chain = elastic(&cut);
            let whole = rigid(&robot);
            let at = forward_kinematics(&whole, &mut Work::new(&whole), &setting.angles).point;
            chain.end_at(end, cut.tool.rotation);
            let mut work = Work::new(&chain);
            place(&chain, &mut work, &chain.spread(&setting.angles[..i]));
            let here = tcp(&chain, &work).point;
            let moment = cross(sub(at, here), force);
            let c = ident::motion::statics::compliance6(&chain, &work);
            let load = [force, moment].concat();
            assert!(tip.len() == 3);
            [0, 1, 2].map(|k| (0..6).map(|m| c[k][m] * load[m]).sum())
        }
    }
}

#[test]
fn what_is_proposed_separates_when_it_is_measured() {
    let mut truth = kr210();
    let stiffness = truth.joints[0].drive.as_ref().unwrap().stiffness;
    truth.elastic.push(ElasticAxis {
        name: "base-z".into(),
        after: 0,
        axis: [0.0, 0.0, 1.0],
        point: [0.0; 3],
        spring: Spring::new(2.0 * stiffness, 0.0),
        body: None,
    });
    let desk = Desk::new(&kr210(), &[], Some(&nine_points()));
    let plan = desk.plan(8, &open("A1", "base"));
    let sights = Sights::of(&desk.unknowns);
    let mut belief = desk.belief.clone();
    // The nine points were measured on a robot without: begin before them.
    belief.mean = desk.unknowns.belief().mean;
    belief.covariance = desk.unknowns.belief().covariance;
    let random = &mut Random::new(3);
    for one in &plan.chosen {
        let read = reading(&truth, &one.setting);
        let rows = sights.rows(&one.setting);
        let whole = DVector::from_iterator(3, read);
        // Set-up and sensor scatter together, small beside what is sought.
        let std = desk.noise.slope + desk.noise.repeatability * whole.norm();
        let read = whole.map(|v| (v + std * random.normal()) / std);
        belief.learn(&(rows / std), &read);
    }
    let (a1, base) = pair(&belief, "A1", "base-z");
    let found = belief.mean[base];
    assert!((found - 0.5).abs() < 3.0 * belief.std(base), "{found}");
    assert!(belief.std(base) < 0.1, "{}", belief.std(base));
    assert!((belief.mean[a1] - 1.0).abs() < 3.0 * belief.std(a1));
    assert!(belief.correlation(a1, base).abs() < 0.6);
}

#[test]
fn rows_are_what_statics_say() {
    let robot = kr210();
    let desk = Desk::new(&robot, &[], None);
    let sights = Sights::of(&desk.unknowns);
    let angles = [30.0, -60.0, 75.0, 45.0, -30.0, 90.0]
        .map(f64::to_radians)
        .to_vec();
    for reach in Reach::ALL {
        for seat in [Seat::Tool, Seat::Link(2), Seat::Link(3)] {
            let setting = Setting {
                angles: angles.clone(),
                reach,
                direction: 1,
                seat,
            };
            // The mean holds what the model has and nothing that could be added.
            let predicted = sights.rows(&setting) * &desk.belief.mean;
            let read = reading(&robot, &setting);
            let size = read.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            (0..3).for_each(|k| assert!((predicted[k] - read[k]).abs() < 1e-9 * size, "{seat:?}"));
        }
    }
}

fn bench(files: &[&str]) -> tempfile::TempDir {
    let bench = tempfile::tempdir().unwrap();
    let folder = bench.path().join("measurements/kr210");
    std::fs::create_dir_all(&folder).unwrap();
    for name in files {
        std::fs::copy(measurements().join(name), folder.join(name)).unwrap();
    }
    bench
}

fn ident(bench: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ident"));
    command.current_dir(bench).args(arguments).output().unwrap()
}

#[test]
fn file_folder_and_nothing_give_the_same_plan() {
    let bench = bench(&["workspace.csv", "axis6.csv"]);
    let file = "measurements/kr210/workspace.csv";
    let first = ident(bench.path(), &["diagnose", "--next", "5", file, "--json"]);
    assert_eq!(
        first.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&first.stderr)
    );
    for rest in [&["measurements/kr210"][..], &[]] {
        let words = [&["diagnose", "--next", "5", "--json"], rest].concat();
        assert_eq!(ident(bench.path(), &words).stdout, first.stdout);
    }
    let said: Value = serde_json::from_slice(&first.stdout).unwrap();
    assert_eq!(
        (&said["schema"], &said["verb"]),
        (&"ident/1".into(), &"diagnose".into())
    );
    let next = said["next"].as_array().unwrap();
    assert_eq!(next.len(), 5);
    assert!(
        next.iter()
            .all(|one| one["gain_nats"].as_f64().unwrap() > 0.0)
    );
    assert!(next.iter().any(|one| one["sensor"] == "foot"), "{next:#?}");
    let page = std::fs::read_to_string(bench.path().join("reports/kr210/next.html")).unwrap();
    assert!(page.contains("Seen from above"));
    assert!(bench.path().join("reports/kr210/next-setups.svg").is_file());
}

#[test]
fn without_points_the_robot_of_another_file_is_planned_for() {
    let bench = bench(&["axis6.csv"]);
    let out = ident(bench.path(), &["diagnose", "--next", "2", "--dry-run"]);
    let said = String::from_utf8_lossy(&out.stdout).to_string();
    assert_eq!(
        out.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    assert!(
        said.contains("assumed scatter") && said.contains("mainly tells"),
        "{said}"
    );
    assert!(!bench.path().join("reports").exists());
}

#[test]
fn wrong_use_is_refused_with_a_remedy() {
    let bench = bench(&["axis6.csv"]);
    let axis6 = "measurements/kr210/axis6.csv";
    let cases: [&[&str]; 4] = [
        &["diagnose", "--next", "3", axis6],
        &["diagnose", "--next", "3", axis6, axis6],
        &["diagnose", "--next", "0"],
        &["diagnose", "--next", "3", "gone"],
    ];
    for words in cases {
        let out = ident(bench.path(), words);
        assert_eq!(out.status.code(), Some(2), "{words:?}");
        assert!(!out.stderr.is_empty() && out.stdout.is_empty());
    }
}

#[test]
fn only_set_ups_that_the_laboratory_can_build_are_proposed() {
    let rig = Rig {
        tool: Some([[1.0, -0.6, 0.4], [2.2, 0.6, 1.8]]),
        keep_out: vec![[[1.4, -0.2, 0.0], [1.8, 0.2, 1.0]]],
        directions: Some(vec![0, 2]),
        sensors: Some(vec!["tool".into(), "foot".into()]),
        bars: Some(false),
    };
    let desk = Desk::new(&kr210(), &[], None).within(rig.clone());
    let plan = desk.plan(4, &[]);
    assert!(
        plan.chosen.len() == 4 && plan.compared > 200,
        "{}",
        plan.compared
    );
    let chain = rigid(&kr210());
    let mut work = Work::new(&chain);
    for one in &plan.chosen {
        let tip = forward_kinematics(&chain, &mut work, &one.setting.angles).point;
        let [low, high] = rig.tool.unwrap();
        assert!(
            (0..3).all(|i| tip[i] >= low[i] && tip[i] <= high[i]),
            "{tip:?}"
        );
        let [low, high] = rig.keep_out[0];
        assert!(
            (0..3).any(|i| tip[i] < low[i] || tip[i] > high[i]),
            "{tip:?}"
        );
        assert!(one.setting.direction != 1 && one.setting.reach == Reach::Mounted);
        assert!(matches!(one.setting.seat, Seat::Tool | Seat::Foot));
    }
}
