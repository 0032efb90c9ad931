//! Surveys of many points: modes and shapes known in closed form come back from a universal file with noise,
//! and files that cannot be are refused with line and remedy.

use crate::bench_of_files::Bench;
use crate::survey_bench::{
    Dof, Point, Truth, accelerances, block, everywhere, file, geometry, node_15, points, spoil,
    trace, truth,
};
use serde_json::Value;

const BAND: &str = "100";

fn told(bench: &Bench, more: &[&str]) -> Value {
    let words = [&["survey", "tower.unv", "--json", "--to-Hz", BAND], more].concat();
    let ran = bench.run(&words);
    assert!(ran.status < 2, "{}", ran.errors);
    serde_json::from_str(&ran.out).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Modal assurance of a shape of the answer and one of the truth, by its definition.
fn assurance(mode: &Value, truth: &Truth, points: &[Point]) -> f64 {
    let (mut cross, mut own, mut other) = ((0.0, 0.0), 0.0, 0.0);
    for part in mode["shape"].as_array().unwrap() {
        let node = part["node"].as_i64().unwrap();
        let point = points.iter().find(|p| p.node == node).unwrap();
        let axis = "xyz".find(part["direction"].as_str().unwrap()).unwrap();
        let (re, im) = (number(&part["value"][0]), number(&part["value"][1]));
        let known = truth.at(point, axis);
        cross = (cross.0 + re * known, cross.1 + im * known);
        own += re * re + im * im;
        other += known * known;
    }
    (cross.0 * cross.0 + cross.1 * cross.1) / (own * other)
}

/// Every mode of the truth is found, once, with its shape.
fn check(answer: &Value, points: &[Point], [hz, damping, mac]: [f64; 3]) {
    let found = answer["modes"].as_array().unwrap();
    let known = truth(100.0);
    let list: Vec<f64> = found.iter().map(|m| number(&m["frequency_Hz"])).collect();
    assert_eq!(found.len(), known.len(), "{list:?}");
    for (mode, truth) in found.iter().zip(&known) {
        let off = number(&mode["frequency_Hz"]) / truth.hz - 1.0;
        let ratio = number(&mode["damping_ratio"]) / truth.damping - 1.0;
        let alike = assurance(mode, truth, points);
        println!(
            "{:7.3} Hz off {:+.5} damping off {:+.3} MAC {alike:.5}",
            truth.hz, off, ratio
        );
        assert!(off.abs() < hz && ratio.abs() < damping && alike > mac);
    }
    let auto = answer["auto_mac"].as_array().unwrap();
    for (i, row) in auto.iter().enumerate() {
        for (j, value) in row.as_array().unwrap().iter().enumerate() {
            let value = number(value);
            assert!(
                if i == j {
                    (value - 1.0).abs() < 1e-9
                } else {
                    value < 0.3
                },
                "{i} {j} {value}"
            );
        }
    }
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn shapes_at_109_points_come_back_with_noise() {
    let points = points();
    assert_eq!(points.len(), 109);
    let (forces, responses) = (vec![(3 * 9 + 2, 0)], everywhere(&points));
    for (share, seed, limits) in [
        (0.0, 1, [1e-4, 0.01, 0.9999]),
        (0.1, 2, [1e-3, 0.1, 0.99]),
        (0.1, 3, [1e-3, 0.1, 0.99]),
    ] {
        let mut all = accelerances(&points, &forces, &responses);
        spoil(&mut all, share, seed);
        let bench = Bench::new();
        bench.put(
            "tower.unv",
            file(&points, &forces, &responses, &all).as_bytes(),
        );
        check(&told(&bench, &["--dry-run"]), &points, limits);
    }
}

#[test]
fn a_roving_hammer_tells_the_same() {
    let points = points();
    let forces: Vec<Dof> = everywhere(&points).into_iter().step_by(2).collect();
    let responses = vec![(30, 0), (100, 1)];
    let mut all = accelerances(&points, &forces, &responses);
    spoil(&mut all, 0.05, 5);
    let bench = Bench::new();
    bench.put(
        "tower.unv",
        file(&points, &forces, &responses, &all).as_bytes(),
    );
    let answer = told(&bench, &["--dry-run"]);
    check(&answer, &points, [1e-3, 0.1, 0.99]);
    assert!(
        answer["remarks"][0]
            .as_str()
            .unwrap()
            .contains("reciprocity")
    );
}

/// The geometry of four points and a frequency response of each, with something put in the place of something.
fn small(change: impl Fn(String) -> String) -> Bench {
    let points: Vec<Point> = points().into_iter().step_by(30).collect();
    let (forces, responses) = (vec![(0, 0)], everywhere(&points));
    let all = accelerances(&points, &forces, &responses);
    let nodes: String = points.iter().map(node_15).collect();
    let mut text = crate::survey_bench::MILLIMETRES.to_string() + &block(15, &nodes);
    text += &trace(1, &points.iter().map(|p| p.node).collect::<Vec<_>>());
    for (r, (point, axis)) in responses.iter().enumerate() {
        let ends = [(points[*point].node, *axis as i64 + 1), (points[0].node, 1)];
        text += &crate::survey_bench::response(ends, &all[0][r]);
    }
    let bench = Bench::new();
    bench.put("tower.unv", change(text).as_bytes());
    bench
}

#[test]
fn files_that_cannot_be_are_refused_with_line_and_remedy() {
    let refused = |change: &dyn Fn(String) -> String, told: &str| {
        let ran = small(change).run(&["survey", "tower.unv", "--dry-run"]);
        assert_eq!(ran.status, 2, "{told}: {}", ran.out);
        assert!(ran.errors.contains(told), "{told}: {}", ran.errors);
        assert!(ran.errors.contains("tower.unv"), "{}", ran.errors);
    };
    let first = node_15(&points()[0]);
    let moved = first.replacen("4.00000E2", "5.00000E2", 1);
    assert_ne!(first, moved);
    refused(
        &|text| text.replacen(&first, &(first.clone() + &moved), 1),
        "tower.unv:10: node 100 is at another place than on line 9",
    );
    refused(
        &|text| text.replacen("4.00000E2", "      NaN", 1),
        "tower.unv:9",
    );
    refused(
        &|text| text.replacen("       100       40", "       555       40", 1),
        "",
    );
    refused(
        &|text| {
            text.replace(&block(15, ""), "")
                .replacen("    15\n", "   999\n", 1)
        },
        "no places of nodes",
    );
    refused(
        &|text| {
            text.replacen(
                "         1         4         3\nwires",
                "         1900000000         3\nwires",
                1,
            )
        },
        "a trace line of 900000000 nodes is declared, 4 are there",
    );
    refused(
        &|text| {
            text.replacen(
                "         1         4         3\nwires\n       100",
                "         1         4         3\nwires\n     31337",
                1,
            )
        },
        "trace line 1 runs to node 31337",
    );
    refused(
        &|text| text[..text.len() / 3].to_string(),
        "the file ends inside this data set",
    );
    refused(
        &|text| text.replacen("  1.00000000000000000E+03", "  1.00000000000000000E-03", 1),
        "span",
    );
    refused(
        &|text| text[..text.find("    58\n").unwrap() - 7].to_string(),
        "no frequency response",
    );
}

#[test]
fn the_page_swings_without_network_and_has_a_still_and_a_map_of_assurance() {
    let points = points();
    let (forces, responses) = (vec![(29, 0)], everywhere(&points));
    let mut all = accelerances(&points, &forces, &responses);
    spoil(&mut all, 0.05, 8);
    let bench = Bench::new();
    bench.put(
        "tower.unv",
        file(&points, &forces, &responses, &all).as_bytes(),
    );
    let ran = bench.run(&["survey", "tower.unv"]);
    assert_eq!(ran.status, 0, "{}", ran.errors);
    let page = std::fs::read_to_string(bench.path("reports/tower-survey.html")).unwrap();
    assert_eq!(page.matches("swing:[").count(), truth(100.0).len());
    assert_eq!(
        page.matches("http").count(),
        page.matches("xmlns=\"http").count()
    );
    assert!(bench.path("reports/survey-mode-1.svg").is_file());
    assert!(bench.path("reports/survey-mac.svg").is_file());
    if let Some(kept) = std::env::var_os("IDENT_KEEP_SURVEY") {
        let kept = std::path::PathBuf::from(kept);
        std::fs::create_dir_all(&kept).unwrap();
        for name in [
            "reports/tower-survey.html",
            "reports/survey-mode-1.svg",
            "reports/survey-mode-5.svg",
            "reports/survey-mac.svg",
            "tower.unv",
        ] {
            let from = bench.path(name);
            std::fs::copy(&from, kept.join(from.file_name().unwrap())).unwrap();
        }
    }
    let _ = geometry(&points);
}
