//! Planned paths, judged by formulas of their own: straight lines, circles, the double-S durations,
//! forward kinematics, differences of rows.

use ident::ground::spatial::{M3, Pose, V3, cross, dot, norm, rotate, rotation_vector, sub, unit};
use ident::measurement::job::Job;
use ident::measurement::toolpath::{Arc, Move, Nurbs, Orientation, Shape, Toolpath};
use ident::motion::{Work, build, forward_kinematics};
use ident::planning::{Plan, Unreached, plan};
use ident::robot::load::load;
use std::f64::consts::{PI, TAU};
use std::path::Path;

const UP: Orientation = Orientation::Axis([0.0, 0.0, 1.0]);
const DEGREE: f64 = PI / 180.0;

fn to(x: f64, y: f64, z: f64) -> Move {
    Move {
        to: [x * 1e-3, y * 1e-3, z * 1e-3],
        orientation: UP,
        feed: None,
        rapid: false,
        shape: Shape::Line,
        blend: None,
        own_blend: None,
        spindle: None,
        station: None,
        line: 0,
    }
}

fn toolpath(moves: Vec<Move>) -> Toolpath {
    let numbered = moves.into_iter().enumerate();
    Toolpath {
        path: "part.csv".into(),
        format: "points",
        moves: numbered.map(|(i, m)| Move { line: i + 1, ..m }).collect(),
        ..Toolpath::default()
    }
}

/// A job with these further lines before its tables.
fn job(lines: &str) -> Job {
    let text = format!(
        "kind = \"job\"\nrobot = \"kr210\"\npath = \"part.csv\"\n\
         start_joints_deg = [0, -90, 90, 0, 0, 0]\n{lines}\n\
         [workpiece]\norigin_m = [1.5, 0.1, 0.8]\nabc_deg = [10.0, 0.0, 0.0]\n\
         [limits]\npath_acceleration_m_s2 = 1.0\npath_jerk_m_s3 = 20.0\n"
    );
    Job::of_bytes(Path::new("job.toml"), text.as_bytes()).unwrap()
}

fn planned(job: &Job, path: &Toolpath) -> Result<Plan, Unreached> {
    plan(job, path, &load("kr210", None).unwrap().robot).unwrap()
}

fn kept(job: &Job, path: &Toolpath) -> Plan {
    planned(job, path).unwrap()
}

/// Largest distance (m) and angle (rad) between forward kinematics and the pose of a row.
fn missed(plan: &Plan) -> [f64; 2] {
    let chain = build::rigid(&plan.cell.robot);
    let mut work = Work::new(&chain);
    let mut worst = [0.0_f64; 2];
    for row in &plan.rows {
        let at: Pose = forward_kinematics(&chain, &mut work, &row.q);
        let seen = plan.cell.in_workpiece(&at);
        let turned = ident::ground::spatial::product(
            &ident::ground::spatial::transpose(&seen.rotation),
            &row.orientation.matrix(),
        );
        worst[0] = worst[0].max(norm(sub(seen.point, row.point)));
        worst[1] = worst[1].max(norm(rotation_vector(&turned)));
    }
    worst
}

fn off_line(p: V3, a: V3, b: V3) -> f64 {
    let along = unit(sub(b, a)).unwrap();
    norm(cross(sub(p, a), along))
}

#[test]
fn a_line_takes_the_time_of_the_closed_form() {
    for (feed, length, seconds) in [
        (6000.0, 400.0, 4.15),
        (600.0, 100.0, 10.0 + 2.0 * (0.01_f64 / 20.0).sqrt()),
    ] {
        let job = job(&format!("feed_mm_min = {feed:?}\ncycle_ms = 12.0"));
        let plan = kept(
            &job,
            &toolpath(vec![to(0.0, 0.0, 0.0), to(length, 0.0, 0.0)]),
        );
        assert!(
            (plan.timeline.duration - seconds).abs() < 1e-12,
            "{}",
            plan.timeline.duration
        );
        let rows = (seconds / 0.012 - 1e-9).ceil() as usize + 1;
        assert_eq!(plan.rows.len(), rows);
        let last = plan.rows.last().unwrap();
        assert!(norm(sub(last.point, [length * 1e-3, 0.0, 0.0])) < 1e-12 && last.feed == 0.0);
        assert!(last.t >= seconds && last.t - seconds < 0.012);
    }
}

#[test]
fn a_square_keeps_its_lines_its_feed_and_its_corners() {
    let corners = [
        [0.0, 0.0],
        [100.0, 0.0],
        [100.0, 80.0],
        [0.0, 80.0],
        [0.0, 1.0],
    ];
    let path = toolpath(corners.iter().map(|[x, y]| to(*x, *y, 0.0)).collect());
    let job = job("feed_mm_min = 3000.0\nblend_radius_mm = 2.0\ncycle_ms = 4.0");
    let plan = kept(&job, &path);
    let [far, turned] = missed(&plan);
    assert!(far < 1e-11 && turned < 1e-11, "{far} {turned}");
    let at = |k: usize| [corners[k][0] * 1e-3, corners[k][1] * 1e-3, 0.0];
    let mut on_lines = 0;
    for row in &plan.rows {
        let near = (1..4).any(|k| norm(sub(row.point, at(k))) < 2.0e-3);
        let off = (0..4)
            .map(|k| off_line(row.point, at(k), at(k + 1)))
            .fold(1.0, f64::min);
        if !near {
            assert!(off < 1e-12, "{off}");
            on_lines += 1;
        }
    }
    assert!(on_lines > plan.rows.len() / 2);
    let speed = 0.05;
    let steady = |t: f64| t > 0.2 && t < plan.timeline.duration - 0.2;
    for pair in plan.rows.windows(2) {
        if steady(pair[0].t) && steady(pair[1].t) {
            let gone = (pair[1].s - pair[0].s) / 0.004;
            assert!((gone / speed - 1.0).abs() < 1e-9);
            assert_eq!(pair[0].feed, speed);
            assert!(norm(sub(pair[1].point, pair[0].point)) <= 0.004 * speed * (1.0 + 1e-9));
        }
    }
    // 158 α² + 840 α − 1800 = 0 for radius one; the middle of the curve lies on the diagonal.
    let alpha = (-840.0 + (840.0_f64 * 840.0 + 4.0 * 158.0 * 1800.0).sqrt()) / 316.0;
    let along = (1.0 + 5.0 * (1.0 - alpha / 5.0) + 10.0 * (1.0 - 0.4 * alpha)) / 32.0;
    let deviation = 2.0e-3 * along * 2.0_f64.sqrt();
    assert!((plan.path.max_deviation() - deviation).abs() < 1e-12);
    assert_eq!((plan.path.blends(), plan.path.lines()), (3, 4));
    assert!(plan.feed.min == speed && plan.feed.held_share > 0.97);
}

/// Largest change of the second differences of the tip between neighbouring rows, m/s².
fn jump(plan: &Plan) -> f64 {
    let t2 = plan.cycle * plan.cycle;
    let second = |w: &[ident::planning::plan::Row]| -> V3 {
        std::array::from_fn(|i| (w[2].point[i] - 2.0 * w[1].point[i] + w[0].point[i]) / t2)
    };
    let rows = &plan.rows[..plan.rows.len() - 1];
    let all: Vec<V3> = rows.windows(3).map(second).collect();
    let gaps = all.windows(2).map(|pair| norm(sub(pair[1], pair[0])));
    gaps.fold(0.0, f64::max)
}

#[test]
fn accelerations_are_continuous_over_every_joint() {
    let path = toolpath(vec![
        to(0.0, 0.0, 0.0),
        to(30.0, 0.0, 0.0),
        to(30.0, 20.0, 5.0),
        to(29.0, 20.0, 5.0),
        to(10.0, 25.0, 5.0),
        to(-10.0, 10.0, 0.0),
    ]);
    let jumps = [1.0, 0.5, 0.25].map(|cycle| {
        let text = format!("feed_mm_min = 3000.0\nblend_radius_mm = 3.0\ncycle_ms = {cycle:?}");
        jump(&kept(&job(&text), &path))
    });
    // A jump of the acceleration would stay; a continuous one falls with the cycle.
    assert!(
        jumps[1] < 0.62 * jumps[0] && jumps[2] < 0.62 * jumps[1],
        "{jumps:?}"
    );
}

#[test]
fn short_elements_shrink_their_blends_to_half() {
    let path = toolpath(vec![
        to(0.0, 0.0, 0.0),
        to(1.0, 0.0, 0.0),
        to(1.0, 50.0, 0.0),
    ]);
    let plan = kept(&job("feed_mm_min = 1200.0\nblend_radius_mm = 2.0"), &path);
    let corner = &plan.path.corners[0];
    assert!((corner.radius - 0.5e-3).abs() < 1e-15 && corner.is_shrunk());
}

#[test]
fn circles_and_splines_are_true() {
    let r = 0.02;
    let mut start = to(20.0, 0.0, 0.0);
    start.line = 1;
    let mut circle = to(20.0, 0.0, 0.0);
    circle.shape = Shape::Arc(Arc {
        centre: [0.0; 3],
        axis: [0.0, 0.0, 1.0],
        angle: TAU,
    });
    let text = "feed_mm_min = 3000.0\ncycle_ms = 4.0";
    let round = kept(&job(text), &toolpath(vec![start, circle]));
    let w = 0.5_f64.sqrt();
    let at = |x: f64, y: f64| [r * x, r * y, 0.0];
    let nurbs = Toolpath {
        path: "part.csv".into(),
        curve: Some(Nurbs {
            degree: 2,
            knots: vec![
                0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0,
            ],
            points: vec![
                at(1.0, 0.0),
                at(1.0, 1.0),
                at(0.0, 1.0),
                at(-1.0, 1.0),
                at(-1.0, 0.0),
                at(-1.0, -1.0),
                at(0.0, -1.0),
                at(1.0, -1.0),
                at(1.0, 0.0),
            ],
            weights: vec![1.0, w, 1.0, w, 1.0, w, 1.0, w, 1.0],
            orientations: vec![UP; 9],
            feed: None,
            lines: (1..=9).collect(),
        }),
        ..Toolpath::default()
    };
    let spline = kept(&job(text), &nurbs);
    for plan in [&round, &spline] {
        assert!((plan.path.length / (TAU * r) - 1.0).abs() < 1e-12);
        assert_eq!(plan.path.halts.len(), 2);
        for row in &plan.rows {
            let angle = row.s / r;
            let exact = [r * angle.cos(), r * angle.sin(), 0.0];
            assert!(
                norm(sub(row.point, exact)) < 1e-13,
                "{}",
                norm(sub(row.point, exact))
            );
        }
    }
    assert_eq!(round.rows.len(), spline.rows.len());
}

/// Angle between two directions of the spindle, rad.
fn spindle(plan: &Plan, k: usize) -> V3 {
    rotate(&plan.rows[k].orientation.matrix(), plan.cell.spindle)
}

#[test]
fn orientations_turn_where_the_job_says() {
    let tilted = |degrees: f64| {
        let (sin, cos) = (degrees * DEGREE).sin_cos();
        Orientation::Axis([sin, 0.0, cos])
    };
    let with = |m: Move, degrees: f64| Move {
        orientation: tilted(degrees),
        ..m
    };
    let path = toolpath(vec![
        with(to(0.0, 0.0, 0.0), 20.0),
        with(to(40.0, 0.0, 0.0), 0.0),
        with(to(40.0, 40.0, 0.0), 10.0),
    ]);
    let angle = |plan: &Plan, k: usize| {
        let axis = spindle(plan, k);
        axis[0].atan2(axis[2]) / DEGREE
    };
    let base = "feed_mm_min = 1200.0\nspin = \"fixed\"\nblend_radius_mm = 4.0\n";
    let blend = kept(&job(&format!("{base}orientation = \"blend\"")), &path);
    let radius = kept(
        &job(&format!(
            "{base}orientation = \"radius\"\norientation_radius_mm = 9.0"
        )),
        &path,
    );
    let whole = kept(&job(&format!("{base}orientation = \"whole\"")), &path);
    let corner = [0.04, 0.0, 0.0];
    for (k, row) in blend.rows.iter().enumerate() {
        let far = norm(sub(row.point, corner));
        let after = row.point[1] > 0.0;
        let (held, steady) = (angle(&blend, k), far > 4.0e-3 + 1e-9);
        if steady {
            let wanted = if after { 10.0 } else { 0.0 };
            assert!((held - wanted).abs() < 1e-9, "{held} {row:?}");
        }
    }
    for (k, row) in radius.rows.iter().enumerate() {
        let far = norm(sub(row.point, corner));
        if far > 9.0e-3 + 1e-9 {
            let wanted = if row.point[1] > 0.0 { 10.0 } else { 0.0 };
            assert!((angle(&radius, k) - wanted).abs() < 1e-9);
        } else if far < 8.9e-3 && far > 4.0e-3 {
            assert!(angle(&radius, k) > 1e-9 && angle(&radius, k) < 10.0 - 1e-9);
        }
    }
    for (k, row) in whole.rows.iter().enumerate() {
        let far = norm(sub(row.point, corner));
        if far > 4.0e-3 + 1e-9 {
            let wanted = match row.point[1] > 0.0 {
                true => 10.0 * row.point[1] / 0.04,
                false => 20.0 * (1.0 - row.point[0] / 0.04),
            };
            assert!((angle(&whole, k) - wanted).abs() < 1e-9);
        }
    }
    for plan in [&blend, &radius, &whole] {
        let [far, turned] = missed(plan);
        assert!(far < 1e-10 && turned < 1e-10);
        untwisted(plan);
    }
}

/// No rotation about the spindle from row to row.
fn untwisted(plan: &Plan) {
    for k in 1..plan.rows.len() {
        let way = plan.rows[k - 1]
            .orientation
            .way_to(plan.rows[k].orientation);
        let twist = dot(way, plan.cell.spindle);
        assert!(
            twist.abs() < 2e-5 * norm(way) + 1e-12,
            "{k} {twist} {}",
            norm(way)
        );
    }
}

#[test]
fn the_same_place_in_another_orientation_is_a_stop_with_a_turn() {
    let turned = |m: Move, degrees: f64| Move {
        orientation: Orientation::Full(ident::ground::spatial::roll_pitch_yaw(
            0.0,
            90.0 * DEGREE,
            degrees * DEGREE,
        )),
        ..m
    };
    let path = toolpath(vec![
        turned(to(0.0, 0.0, 0.0), 0.0),
        turned(to(30.0, 0.0, 0.0), 0.0),
        turned(to(30.0, 0.0, 0.0), 30.0),
        turned(to(60.0, 0.0, 0.0), 30.0),
    ]);
    let plan = kept(&job("feed_mm_min = 1200.0\nblend_radius_mm = 2.0"), &path);
    assert_eq!(plan.path.halts.len(), 3);
    let corner = [0.03, 0.0, 0.0];
    let turning: Vec<&ident::planning::plan::Row> = plan
        .rows
        .iter()
        .filter(|row| norm(sub(row.point, corner)) < 1e-12)
        .collect();
    // 30 degrees on a lever of 0.1 m at 0.02 m/s: 2.6 s.
    assert!(turning.len() > 200);
    let whole: f64 = norm(
        turning[0]
            .orientation
            .way_to(turning[turning.len() - 1].orientation),
    );
    assert!((whole - 30.0 * DEGREE).abs() < 1e-3);
    assert!(missed(&plan)[1] < 1e-10);
}

#[test]
fn a_reversal_stops_and_a_repeated_point_is_dropped() {
    let path = toolpath(vec![
        to(0.0, 0.0, 0.0),
        to(20.0, 0.0, 0.0),
        to(20.0, 0.0, 0.0),
        to(40.0, 0.0, 0.0),
        to(5.0, 0.0, 0.0),
    ]);
    let plan = kept(&job("feed_mm_min = 1200.0\nblend_radius_mm = 2.0"), &path);
    assert_eq!(plan.path.halts.len(), 3);
    assert!((plan.path.halts[1].at - 0.04).abs() < 1e-15);
    assert_eq!(plan.path.programme.duplicates, 1);
    assert_eq!(plan.path.blends(), 0);
}

#[test]
fn a_rapid_motion_stops_before_a_cut_and_keeps_the_joints_within_their_speeds() {
    let rapid = |m: Move| Move { rapid: true, ..m };
    let path = toolpath(vec![
        to(0.0, 0.0, 50.0),
        rapid(to(300.0, 0.0, 50.0)),
        to(300.0, 0.0, 0.0),
        to(300.0, 50.0, 0.0),
        rapid(to(300.0, 50.0, 50.0)),
    ]);
    let plan = kept(
        &job("feed_mm_min = 3000.0\nrapid_mm_min = 300000.0\nblend_radius_mm = 5.0\n"),
        &path,
    );
    assert_eq!(plan.path.blends(), 2);
    assert!((plan.path.halts[1].at - 0.3).abs() < 1e-12);
    assert!(plan.exceeded.is_empty(), "{:?}", plan.exceeded);
    assert!(plan.rows.iter().any(|row| row.feed > 0.3));
}

fn motion(plan: &Plan) -> f64 {
    let pairs = plan.rows.windows(2);
    let square = |pair: &[ident::planning::plan::Row]| -> f64 {
        (0..6).map(|i| (pair[1].q[i] - pair[0].q[i]).powi(2)).sum()
    };
    pairs.map(square).sum()
}

#[test]
fn a_smooth_spin_moves_the_joints_less_than_a_fixed_one_or_any_steady_one() {
    let ring = (0..=36).map(|k| {
        let (sin, cos) = (f64::from(k) * 10.0 * DEGREE).sin_cos();
        to(150.0 * cos, 150.0 * sin, 0.0)
    });
    let path = toolpath(ring.collect());
    let with = |spin: &str| {
        let text = format!("feed_mm_min = 12000.0\nblend_radius_mm = 10.0\nspin = \"{spin}\"");
        kept(&job(&text), &path)
    };
    let (fixed, smooth) = (with("fixed"), with("smooth"));
    untwisted(&fixed);
    let (a, b) = (motion(&fixed), motion(&smooth));
    assert!(b < 0.9 * a, "{a} {b}");
    assert!(missed(&smooth)[0] < 1e-10);
    let largest = |plan: &Plan| {
        let pairs = plan.rows.windows(2);
        let step = |w: &[ident::planning::plan::Row]| {
            (0..6)
                .map(|i| (w[1].q[i] - w[0].q[i]).abs())
                .fold(0.0, f64::max)
        };
        pairs.map(step).fold(0.0, f64::max)
    };
    assert!(largest(&smooth) < 0.1);
}

#[test]
fn a_point_out_of_reach_is_named() {
    let path = toolpath(vec![
        to(0.0, 0.0, 0.0),
        to(100.0, 0.0, 0.0),
        to(3000.0, 0.0, 0.0),
    ]);
    let unreached = planned(&job("feed_mm_min = 30000.0"), &path).unwrap_err();
    assert_eq!(unreached.line, 3);
    let text = unreached.problem().to_string();
    assert!(text.contains("line 3") && text.contains("help:"), "{text}");
    assert!(unreached.exceeded().value > unreached.exceeded().limit);
}

/// The wrist of the kr210 straight in the middle: the tool axis A6 runs along A4 there.
#[test]
fn a_straight_passage_changes_the_sign_of_a5_and_adapt_slows_a_near_one() {
    let robot = load("kr210", None).unwrap().robot;
    let chain = build::rigid(&robot);
    let mut work = Work::new(&chain);
    let q = [0.0, -90.0, 90.0, 0.0, 0.0, 0.0].map(|q: f64| q * DEGREE);
    let middle = forward_kinematics(&chain, &mut work, &q);
    let start = [0.0, -90.0, 90.0, 0.0, 10.0, 0.0].map(|q: f64| q * DEGREE);
    let first = forward_kinematics(&chain, &mut work, &start);
    let pose = |orientation: &M3, y: f64, z: f64| {
        let mut step = to(0.0, y, z);
        step.to = [middle.point[0], y * 1e-3, middle.point[2] + z * 1e-3];
        step.orientation = Orientation::Full(*orientation);
        step
    };
    let text = |lines: &str| {
        format!(
            "kind = \"job\"\nrobot = \"kr210\"\npath = \"p.csv\"\nfeed_mm_min = 6000.0\n\
             start_joints_deg = [0, -90, 90, 0, 10, 0]\n{lines}\n[workpiece]\norigin_m = [0.0, 0.0, 0.0]\n"
        )
    };
    let of = |lines: &str| Job::of_bytes(Path::new("job.toml"), text(lines).as_bytes()).unwrap();
    let _ = first;
    let level = &middle.rotation;
    let straight = toolpath(vec![pose(level, 0.0, -80.0), pose(level, 0.0, 80.0)]);
    let plan = planned(&of(""), &straight).unwrap();
    let (begin, end) = (&plan.rows[0].q, &plan.rows[plan.rows.len() - 1].q);
    assert!(begin[4] * end[4] < 0.0, "{begin:?} {end:?}");
    assert!((end[3] - begin[3]).abs() < 1e-6);
    assert!(plan.exceeded.is_empty(), "{:?}", plan.exceeded);
    assert_eq!(plan.passages.len(), 1);
    let beside = toolpath(vec![pose(level, 0.5, -80.0), pose(level, 0.5, 80.0)]);
    let fast = planned(&of(""), &beside).unwrap();
    let named: Vec<_> = fast.exceeded.iter().map(|e| e.what).collect();
    assert!(
        named.contains(&"joint-speed") && named.contains(&"singularity"),
        "{named:?}"
    );
    let slow = planned(&of("feed = \"adapt\""), &beside).unwrap();
    assert!(slow.exceeded.is_empty(), "{:?}", slow.exceeded);
    assert!(slow.timeline.duration > fast.timeline.duration);
    assert!(slow.feed.held_share < 1.0 && slow.feed.min < 0.1);
    assert!(missed(&slow)[0] < 1e-9);
}

#[test]
fn the_stiffest_turn_of_an_angled_spindle_is_stiffer_and_turns_slowly() {
    let ring = (0..=24).map(|k| {
        let (sin, cos) = (f64::from(k) * 15.0 * DEGREE).sin_cos();
        to(100.0 * cos, 100.0 * sin, 0.0)
    });
    let path = toolpath(ring.collect());
    let with = |spin: &str| {
        let text = format!(
            "kind = \"job\"\nrobot = \"kr210\"\npath = \"part.csv\"\nfeed_mm_min = 3000.0\n\
             start_joints_deg = [0, -90, 90, 0, 30, 0]\nblend_radius_mm = 10.0\nspin = \"{spin}\"\n\
             [workpiece]\norigin_m = [1.6, 0.0, 0.9]\n[spindle]\ntcp_m = [3.13, 0.0, 0.495]\n"
        );
        let job = Job::of_bytes(Path::new("job.toml"), text.as_bytes()).unwrap();
        kept(&job, &path)
    };
    let [fixed, smooth, stiffest] = ["fixed", "smooth", "stiffest"].map(with);
    let compliance = |plan: &Plan| plan.compliance.unwrap()[1];
    assert_eq!(fixed.compliance.unwrap()[0], fixed.compliance.unwrap()[1]);
    assert!(compliance(&stiffest) < 0.99 * compliance(&fixed));
    assert!(compliance(&stiffest) < compliance(&smooth));
    assert!(motion(&smooth) < motion(&fixed));
    for pair in stiffest.rows.windows(2) {
        let turned = stiffest.spin.turn(pair[1].s) - stiffest.spin.turn(pair[0].s);
        assert!(turned.abs() <= 1.2 * (0.5 * PI / 0.1) * (pair[1].s - pair[0].s) + 1e-9);
    }
    assert!(missed(&stiffest)[0] < 1e-9);
}

/// Largest second difference of every joint over the square of the cycle, rad/s².
fn hardest(plan: &Plan) -> [f64; 6] {
    let second = |i: usize, r: &[ident::planning::plan::Row]| {
        (r[0].q[i] - 2.0 * r[1].q[i] + r[2].q[i]).abs() / plan.cycle.powi(2)
    };
    let largest = |i| {
        plan.rows
            .windows(3)
            .map(|r| second(i, r))
            .fold(0.0, f64::max)
    };
    std::array::from_fn(largest)
}

/// A zigzag whose corners are blended, `feed` in mm/min.
fn zigzag(feed: f64) -> (String, Toolpath) {
    let corners = (0..8).map(|k| to(20.0 * f64::from(k), 30.0 * f64::from(k % 2), 0.0));
    let lines = format!("feed_mm_min = {feed:.1}\nblend_radius_mm = 4.0");
    (lines, toolpath(corners.collect()))
}

#[test]
fn joints_that_would_accelerate_too_hard_are_named_and_adapt_keeps_them() {
    // fast: the bends of the corners count; slow: starts and stops
    for (feed, share) in [(9000.0, 0.4), (600.0, 0.25)] {
        let (lines, path) = zigzag(feed);
        let mut robot = load("kr210", None).unwrap().robot;
        let free = plan(&job(&lines), &path, &robot).unwrap().unwrap();
        // a joint that stays where it is must not be judged by its rounding
        let most = hardest(&free).map(|most| most.max(1e-3));
        for (joint, most) in robot.joints.iter_mut().zip(most) {
            joint.max_acceleration = Some(share * most);
        }
        let bound = plan(&job(&lines), &path, &robot).unwrap().unwrap();
        assert_eq!(
            bound.rows, free.rows,
            "without leave the feed is not lowered"
        );
        let moving = robot
            .joints
            .iter()
            .zip(most)
            .filter(|(_, most)| *most > 1e-3);
        let moving: Vec<_> = moving.collect();
        assert_eq!(bound.exceeded.len(), moving.len());
        assert!(moving.len() > 3);
        for (one, (joint, most)) in bound.exceeded.iter().zip(moving) {
            assert_eq!((one.what, &one.site), ("joint-acceleration", &joint.name));
            assert!((one.value * DEGREE / most - 1.0).abs() < 1e-9);
            assert!((one.limit * DEGREE / (share * most) - 1.0).abs() < 1e-12);
        }
        let adapted = job(&format!("{lines}\nfeed = \"adapt\""));
        let kept = plan(&adapted, &path, &robot).unwrap().unwrap();
        assert!(kept.exceeded.is_empty(), "{:?}", kept.exceeded);
        for ((own, most), joint) in hardest(&kept).iter().zip(most).zip(&kept.joints) {
            assert!(*own <= share * most * (1.0 + 1e-6));
            assert!((joint.max_acceleration - own).abs() < 1e-12);
        }
        let longer = kept.timeline.duration / free.timeline.duration;
        println!(
            "feed {feed}: {longer:.3} times as long, eased to {:.3}",
            kept.feed.eased
        );
        assert!(longer > 1.0 && longer < 4.0, "{longer}");
        assert!(missed(&kept)[0] < 1e-9);
    }
}

#[test]
fn a_turn_on_the_spot_keeps_accelerations_too() {
    let turned = |x: f64, angle: f64| {
        let axis = [angle.sin(), 0.0, angle.cos()];
        Move {
            orientation: Orientation::Axis(axis),
            ..to(x, 0.0, 0.0)
        }
    };
    let path = toolpath(vec![
        turned(0.0, 0.0),
        turned(50.0, 0.0),
        turned(50.0, 0.3),
        turned(100.0, 0.3),
    ]);
    let lines = "feed_mm_min = 3000.0\nfeed = \"adapt\"\nblend_radius_mm = 0.0";
    let mut robot = load("kr210", None).unwrap().robot;
    let free = plan(&job(lines), &path, &robot).unwrap().unwrap();
    assert!(free.path.halts.iter().any(|halt| !halt.turns.is_empty()));
    for (joint, most) in robot.joints.iter_mut().zip(hardest(&free)) {
        joint.max_acceleration = Some(0.3 * most.max(1e-3));
    }
    let kept = plan(&job(lines), &path, &robot).unwrap().unwrap();
    assert!(kept.exceeded.is_empty(), "{:?}", kept.exceeded);
    let longer = kept.timeline.duration / free.timeline.duration;
    assert!(longer > 1.0 && longer < 3.0, "{longer}");
}
