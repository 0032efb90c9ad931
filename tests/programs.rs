//! Programs of controllers: what is written is read again and gives the same moves.

use ident::ground::spatial::{Pose, V3};
use ident::ground::vector::{add, norm, normals, roll_pitch_yaw, scale, sub, unit};
use ident::measurement::toolpath::{Arc, Orientation, Shape, Toolpath};
use ident::path::programs::{EXPORTERS, Exporter, Program, ProgramFile, ProgramMove};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// Half a nanometre of rounding in each coordinate, and its propagation.
const PLACE: f64 = 5e-9;

fn program(moves: Vec<ProgramMove>) -> Program {
    Program {
        name: "part".into(),
        comments: vec![
            "job part/job.toml sha256 0123".into(),
            "nasty ) ; \n G1 X9".into(),
        ],
        base: Pose {
            point: [1.5, -0.25, 0.8],
            rotation: roll_pitch_yaw(0.1, -0.2, 0.3),
        },
        tool: Pose {
            point: [0.0, 0.0, 0.25],
            rotation: roll_pitch_yaw(0.0, 1.5, 0.0),
        },
        start_joints: Some(vec![0.1, -1.5, 1.6, 0.0, -0.2, 3.0]),
        moves,
    }
}

fn start() -> ProgramMove {
    ProgramMove {
        to: [0.0, 0.0, 0.01],
        rotation: roll_pitch_yaw(0.2, 0.1, -3.0),
        spindle_axis: [0.0, 0.0, 1.0],
        shape: Shape::Line,
        feed: 0.05,
        rapid: false,
        blend: 0.0,
        spindle: Some(1000.0),
    }
}

fn read(files: &[ProgramFile]) -> Toolpath {
    let folder = tempfile::tempdir().unwrap();
    for file in files {
        std::fs::write(folder.path().join(&file.name), &file.text).unwrap();
    }
    Toolpath::read(&folder.path().join(&files[0].name))
        .unwrap_or_else(|p| panic!("{p}\n{}", files[0].text))
}

fn written(language: &str, program: &Program) -> Vec<ProgramFile> {
    Exporter::named(language).unwrap().write(program).unwrap()
}

/// A point of the arc halfway.
fn middle(from: V3, to: V3, arc: &Arc) -> V3 {
    let rise = scale(0.5, scale(dot(sub(to, from), arc.axis), arc.axis));
    add(arc.at(from, 0.5 * arc.angle), rise)
}

fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Random moves: lines, arcs of any size in `planes`, full circles, stops and blends.
fn moves(upright: bool) -> impl Strategy<Value = Vec<ProgramMove>> {
    let angle = -3.0..3.0;
    let place = || prop::array::uniform3(-0.4..0.4f64);
    let turn = (angle.clone(), -1.5..1.5f64, angle);
    let round = (
        prop::bool::ANY,
        0..4usize,
        0.05..1.0f64,
        0.001..0.2f64,
        0..3usize,
        prop::bool::ANY,
    );
    let feeds = (0.0005..0.5f64, 0.0..0.01f64, prop::bool::ANY);
    let one = (place(), turn, round, feeds);
    prop::collection::vec(one, 1..12).prop_map(move |all| {
        let mut moves = vec![start()];
        for (to, (c, b, a), (is_arc, size, share, radius, plane, counter), (feed, blend, stops)) in
            all
        {
            let from = moves.last().unwrap().to;
            let mut next = ProgramMove {
                to,
                rotation: roll_pitch_yaw(c, b, a),
                feed,
                blend: if stops {
                    0.0
                } else {
                    (blend * 1e6).round() * 1e-6
                },
                ..start()
            };
            if is_arc {
                let mut axis = match upright {
                    true => [0.0; 3],
                    false => unit(to).unwrap_or([0.0, 0.0, 1.0]),
                };
                if upright {
                    axis[plane] = if counter { 1.0 } else { -1.0 };
                }
                let angle = if size == 0 { TAU } else { share * TAU };
                let centre = add(from, scale(radius, normals(axis).0));
                let arc = Arc {
                    centre,
                    axis,
                    angle,
                };
                next.shape = Shape::Arc(arc);
                next.to = if size == 0 { from } else { arc.at(from, angle) };
            }
            moves.push(next);
        }
        moves
    })
}

fn same_places(written: &[ProgramMove], read: &Toolpath) {
    assert_eq!(read.moves.len(), written.len());
    for (i, (a, b)) in written.iter().zip(&read.moves).enumerate() {
        let apart = norm(sub(a.to, b.to));
        assert!(apart < PLACE, "move {i}: {apart}");
        if i == 0 {
            continue;
        }
        assert!((a.feed - b.feed.unwrap()).abs() < 1e-9, "move {i}");
        let from = written[i - 1].to;
        match (a.shape, b.shape) {
            (Shape::Arc(one), Shape::Arc(other)) => {
                let apart = norm(sub(
                    middle(from, a.to, &one),
                    middle(read.moves[i - 1].to, b.to, &other),
                ));
                assert!(apart < 20.0 * PLACE, "move {i}: {apart} {one:?} {other:?}");
                assert!(
                    (one.angle - other.angle).abs() * one.radius(from) < 1e-6,
                    "move {i}: {one:?} {other:?}"
                );
                assert!(
                    norm(sub(one.axis, other.axis)) < 1e-3,
                    "move {i}: {one:?} {other:?}"
                );
            }
            (one, other) => assert_eq!(one, other, "move {i}"),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, rng_seed: prop::test_runner::RngSeed::Fixed(7), ..ProptestConfig::default() })]

    #[test]
    fn krl_is_read_again_as_it_was_written(moves in moves(false)) {
        let program = program(moves);
        let path = read(&written("krl", &program));
        same_places(&program.moves, &path);
        for (a, b) in program.moves.iter().zip(&path.moves).skip(1) {
            let Orientation::Full(r) = b.orientation else { panic!() };
            let apart = (0..9).map(|k| (r[k / 3][k % 3] - a.rotation[k / 3][k % 3]).abs()).fold(0.0, f64::max);
            prop_assert!(apart < 1e-9, "{}", apart);
            prop_assert!((a.blend - b.blend.unwrap()).abs() < 1e-9);
        }
        prop_assert!(norm(sub(path.base.unwrap().point, program.base.point)) < PLACE);
        prop_assert!(norm(sub(path.tool.unwrap().point, program.tool.point)) < PLACE);
    }

    #[test]
    fn g_code_is_read_again_as_it_was_written(moves in moves(true)) {
        let program = program(moves);
        let path = read(&written("gcode", &program));
        same_places(&program.moves, &path);
        for (a, b) in program.moves.iter().zip(&path.moves) {
            prop_assert!((a.spindle.unwrap() - b.spindle.unwrap()).abs() < 1e-6);
        }
    }
}

/// Lines along a zigzag.
fn zigzag(count: usize) -> Vec<ProgramMove> {
    let place = |i: usize| [1e-3 * i as f64 / 100.0, 1e-3 * (i % 2) as f64, 0.0];
    let next = |i: usize| ProgramMove {
        to: place(i),
        blend: 1e-4,
        ..start()
    };
    (0..count).map(next).collect()
}

#[test]
fn a_long_path_is_split_into_modules_that_are_read_again() {
    let program = program(zigzag(12_001));
    let files = written("krl", &program);
    let names: Vec<&str> = files.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "part.src",
            "part.dat",
            "part_001.src",
            "part_002.src",
            "part_003.src"
        ]
    );
    assert!(files.iter().all(|f| f.text.len() < 1 << 20));
    same_places(&program.moves, &read(&files));
}

#[test]
fn a_hundred_thousand_points_are_written_in_a_second() {
    let program = program(zigzag(100_000));
    for exporter in EXPORTERS {
        let begin = std::time::Instant::now();
        let files = exporter.write(&program).unwrap();
        let seconds = begin.elapsed().as_secs_f64();
        println!("{}: {seconds:.3} s", exporter.name);
        assert!(
            !files.is_empty() && seconds < 5.0,
            "{}: {seconds} s",
            exporter.name
        );
        assert_eq!(files, exporter.write(&program).unwrap(), "the same again");
    }
}

#[test]
fn a_helix_becomes_chords_where_a_language_has_none() {
    let axis = [0.0, 0.0, 1.0];
    let mut helix = ProgramMove {
        to: [0.0, 0.0, 0.005],
        ..start()
    };
    helix.shape = Shape::Arc(Arc {
        centre: [0.02, 0.0, 0.01],
        axis,
        angle: TAU,
    });
    let program = program(vec![start(), helix]);
    let path = read(&written("krl", &program));
    assert!(path.moves.len() > 100);
    for m in &path.moves {
        let off = (m.to[0] - 0.02).hypot(m.to[1]) - 0.02;
        assert!(off.abs() < PLACE, "{off}");
    }
    for pair in path.moves.windows(2) {
        let between = scale(0.5, add(pair[0].to, pair[1].to));
        assert!(0.02 - (between[0] - 0.02).hypot(between[1]) < 2.1e-6);
    }
    let exact = read(&written("gcode", &program));
    assert_eq!(exact.moves.len(), 2);
}

#[test]
fn rapid_states_frames_targets_zones_and_circles() {
    let mut half = ProgramMove {
        to: [0.02, 0.0, 0.01],
        feed: 0.1,
        blend: 0.002,
        ..start()
    };
    half.shape = Shape::Arc(Arc {
        centre: [0.01, 0.0, 0.01],
        axis: [0.0, 0.0, -1.0],
        angle: PI,
    });
    let files = written("rapid", &program(vec![start(), half]));
    assert_eq!(files[0].name, "part.mod");
    let text = &files[0].text;
    let circles: Vec<&str> = text.lines().filter(|l| l.contains("MoveC")).collect();
    assert_eq!(circles.len(), 2, "{text}");
    let targets: Vec<V3> = circles
        .iter()
        .flat_map(|line| line.split("[[").skip(1))
        .map(first_three)
        .collect();
    for target in &targets {
        let off = ((target[0] - 10.0).hypot(target[1]) - 10.0).abs();
        assert!(off < 1e-5 && (target[2] - 10.0).abs() < 1e-9, "{target:?}");
    }
    assert!(targets[0][1] > 0.0, "clockwise over +y: {targets:?}");
    assert!(
        circles[1].contains("[100,500,5000,1000],[FALSE,2,3,3,0.3,3,0.3],part_t\\WObj:=part_w;")
    );
    assert!(text.contains("[[1500,-250,800],["));
    assert!(text.lines().all(|l| l.is_ascii()) && text.contains("MoveAbsJ [[5.72957795,"));
}

fn first_three(text: &str) -> V3 {
    let inside = text.split(']').next().unwrap();
    let numbers: Vec<f64> = inside.split(',').map(|n| n.parse().unwrap()).collect();
    [numbers[0], numbers[1], numbers[2]]
}

#[test]
fn what_a_language_cannot_say_is_refused() {
    let leaning = ProgramMove {
        spindle_axis: [0.6, 0.0, 0.8],
        ..start()
    };
    let program = program(vec![start(), leaning]);
    let problem = Exporter::named("gcode")
        .unwrap()
        .write(&program)
        .unwrap_err();
    assert!(
        problem.what.contains("leans") && problem.remedy.contains("krl"),
        "{problem}"
    );
    let problem = Exporter::named("kral").err().unwrap();
    assert!(problem.to_string().contains("`krl`"), "{problem}");
    let still = Program {
        moves: vec![
            start(),
            ProgramMove {
                feed: 0.0,
                ..start()
            },
        ],
        ..program
    };
    assert!(EXPORTERS.iter().all(|e| e.write(&still).is_err()));
}
