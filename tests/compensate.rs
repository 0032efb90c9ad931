//! A path corrected before or during the cut: how much of the deviation goes, what is said about the rest.

use crate::part_bench::{CORNER, DEEP, SLOT, job, plant, ready};
use ident::compensation::drawn::Drawn;
use ident::compensation::executed::executed;
use ident::compensation::method::METHODS;
use ident::compensation::online::Sensor;
use ident::compensation::remaining::{Size, remaining};
use ident::compensation::shifted::shifted;
use ident::compensation::text::text;
use ident::compensation::{Correction, Search, Task, search};
use ident::ground::spatial::{dot, norm, sub};
use ident::process::Planned;
use ident::process::setup::{Setup, Support};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

/// The correction of a method, and the largest deviation before and after on `truth`, m.
fn judged(
    method: &str,
    planned: &Planned,
    setup: &Setup,
    truth: &Setup,
    support: Support,
) -> (Search, f64, f64) {
    let method = METHODS.iter().find(|m| m.name == method).unwrap();
    let task = Task {
        setup,
        truth,
        plan: &planned.plan,
        support,
        sensor: Sensor::default(),
        way_of: &|found| shifted(&planned.plan, found),
    };
    let found = search(method, &task).unwrap();
    let (before, after) = sizes(planned, truth, &found.correction, support);
    (found, before, after)
}

fn sizes(
    planned: &Planned,
    truth: &Setup,
    correction: &Correction,
    support: Support,
) -> (f64, f64) {
    let none = Correction::none(planned.plan.path.length);
    let size = |correction: &Correction| {
        let job = ident::compensation::method::with(truth, &planned.plan, correction).unwrap();
        let (milled, _) = job.run(support, |_| {}).unwrap();
        Size::of(&remaining(&milled, &planned.plan.path)).max_m
    };
    (size(&none), size(correction))
}

#[test]
fn the_mirror_takes_four_fifths_of_a_coupled_cut_away_and_most_of_it_on_plants_ten_percent_off() {
    let folder = tempfile::tempdir().unwrap();
    let (planned, setup) = ready(&job(folder.path(), CORNER, 1500.0, ""));
    let (found, before, after) = judged("mirror", &planned, &setup, &setup, Support::Coupled);
    println!(
        "right model: {before:.2e} -> {after:.2e} in {}",
        found.iterations
    );
    assert!(found.converged && after < 0.2 * before);
    for seed in 0..3 {
        let truth = plant(&setup, seed, 0.1, true);
        let (before, after) = sizes(&planned, &truth, &found.correction, Support::Coupled);
        println!("plant {seed}: {before:.2e} -> {after:.2e}");
        assert!(after < 0.3 * before);
    }
}

#[test]
fn corrections_are_normal_to_the_feed_and_smooth() {
    let folder = tempfile::tempdir().unwrap();
    let (planned, setup) = ready(&job(folder.path(), CORNER, 1500.0, ""));
    let (found, ..) = judged("mirror", &planned, &setup, &setup, Support::Static);
    let correction = found.correction;
    for row in planned.plan.rows.iter().filter(|r| r.feed > 0.02) {
        let Some(feed) = setup.way.feed(row.t) else {
            continue;
        };
        let along = dot(feed, correction.at(row.s)).abs();
        assert!(
            along < 0.15 * correction.largest().0,
            "{along} at {}",
            row.s
        );
    }
    // no jump of the second derivative: two differences that share a point agree
    let h = 2e-7;
    let second = |s: f64| {
        let [a, b, c] = [s - h, s, s + h].map(|s| correction.at(s));
        norm(sub(sub(c, b), sub(b, a))) / (h * h)
    };
    let size = correction.largest().0;
    for i in 1..900 {
        let s = 1e-4 * f64::from(i);
        let jump = (second(s + 2.0 * h) - second(s - 2.0 * h)).abs();
        assert!(jump < 0.2 * size / 1e-6, "{jump} at {s}");
    }
}

#[test]
fn measuring_while_cutting_leaves_about_half_at_the_exit_and_the_pilot_force_takes_it_away() {
    let folder = tempfile::tempdir().unwrap();
    let (planned, setup) = ready(&job(folder.path(), DEEP, 1500.0, ""));
    let truth = plant(&setup, 5, 0.05, true);
    let run = |method: &str| judged(method, &planned, &setup, &truth, Support::Coupled);
    let (online, before, left_online) = run("online");
    let (hybrid, _, left_hybrid) = run("hybrid");
    println!("before {before:.2e}, online {left_online:.2e}, hybrid {left_hybrid:.2e}");
    assert!(online.converged && hybrid.converged);
    let [online, hybrid] = [left_online, left_hybrid].map(|left| left / before);
    assert!((0.35..0.75).contains(&online), "{online}");
    assert!(hybrid <= 0.3, "{hybrid}");
}

#[test]
fn the_written_path_planned_again_is_the_corrected_one() {
    the_written_path_runs_as_corrected("2.0");
}

#[test]
fn a_path_that_stops_at_its_corners_stops_nowhere_else_when_corrected() {
    the_written_path_runs_as_corrected("0.0");
}

fn the_written_path_runs_as_corrected(blend_radius_mm: &str) {
    let folder = tempfile::tempdir().unwrap();
    let path = job(folder.path(), CORNER, 1500.0, "");
    let stated = std::fs::read_to_string(&path).unwrap();
    let asked = format!("blend_radius_mm = {blend_radius_mm}");
    std::fs::write(&path, stated.replace("blend_radius_mm = 2.0", &asked)).unwrap();
    let (planned, setup) = ready(&path);
    let (found, ..) = judged("ideal-force", &planned, &setup, &setup, Support::Static);
    let text = text(
        &planned.plan,
        &found.correction,
        "ideal-force",
        &planned.inputs,
        true,
    );
    let again = executed(&planned, Path::new("compensated.csv"), &text).unwrap();
    let shifted = ident::compensation::shifted::shifted(&planned.plan, &found.correction).unwrap();
    for row in again.way.rows() {
        let nearest = shifted.rows().iter().map(|r| norm(sub(r.tip, row.tip)));
        // rows are a cycle apart: 0.3 mm
        assert!(
            nearest.fold(f64::INFINITY, f64::min) < 0.16e-3,
            "{}",
            row.s_m
        );
        let told = shifted
            .rows()
            .iter()
            .filter(|r| (r.s_m - row.s_m).abs() < 0.2e-3);
        let apart = told
            .map(|r| norm(sub(r.tip, row.tip)))
            .fold(f64::INFINITY, f64::min);
        assert!(apart < 0.25e-3, "{apart} at {}", row.s_m);
    }
    let stays = again.way.span()[1] / setup.way.span()[1];
    assert!((0.98..1.02).contains(&stays), "{stays}");
}

/// Before a corner at which it stops, a tool that is ahead and beside is off by what it is beside the line that it came along.
#[test]
fn before_a_stop_what_is_ahead_is_not_off() {
    let folder = tempfile::tempdir().unwrap();
    let path = job(folder.path(), CORNER, 1500.0, "");
    let stated = std::fs::read_to_string(&path).unwrap();
    let sharp = stated.replace("blend_radius_mm = 2.0", "blend_radius_mm = 0.0");
    std::fs::write(&path, sharp).unwrap();
    let path = ready(&path).0.plan.path;
    let stop = path.halts[1].at;
    assert!(0.0 < stop && stop < path.length);
    let ahead = path.direction(stop - 1e-6);
    assert!(dot(ahead, path.direction(stop + 1e-6)).abs() < 1e-9);
    let beside = [-ahead[1], ahead[0], 0.0];
    let at = [0, 1, 2].map(|k| path.point(stop)[k] + 1e-4 * ahead[k] + 2e-4 * beside[k]);
    let left = Drawn::of(&path).left(stop - 5e-5, at);
    let wanted = beside.map(|x| 2e-4 * x);
    assert!(norm(sub(left, wanted)) < 1e-9, "{left:?}");
}

/// Fast and soft: the controller comes by twice in a blend, and the tool is late by a third of a millimetre.
#[test]
fn in_a_rounded_corner_what_is_left_is_how_far_the_milled_path_is_from_the_drawn_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = job(folder.path(), CORNER, 6000.0, "");
    let (planned, setup) = ready(&path);
    let (_, json) = ident(
        folder.path(),
        &["compensate", "job.toml", "--static", "--json"],
    );
    let written = folder.path().join(json["path"].as_str().unwrap());
    let text = std::fs::read_to_string(&written).unwrap();
    let way = executed(&planned, &written, &text).unwrap().way;
    let (milled, _) = Setup { way, ..setup }.run(Support::Static, |_| {}).unwrap();
    let drawn = &planned.plan.path;
    let count = (drawn.length / 2e-5) as usize;
    let drawn: Vec<_> = (0..=count)
        .map(|i| drawn.point(drawn.length * i as f64 / count as f64))
        .collect();
    let off = milled.course.iter().filter(|cut| cut.cutting).map(|cut| {
        let tip = ident::ground::spatial::add(cut.tip, cut.deviation);
        let away = drawn.iter().map(|p| norm(sub(tip, *p)));
        away.fold(f64::INFINITY, f64::min)
    });
    let off = 1e3 * off.fold(0.0, f64::max);
    let [before, after] = ["before", "after"].map(|k| json[k]["max_mm"].as_f64().unwrap());
    println!("{before:.3} -> {after:.4} mm, milled {off:.4} mm");
    assert!((after - off).abs() < 2e-3 + 0.02 * off);
    assert!(after < 0.3 * before);
}

fn run(folder: &Path, words: &[&str]) -> Output {
    let mut ident = Command::new(env!("CARGO_BIN_EXE_ident"));
    ident.current_dir(folder).args(words).output().unwrap()
}

fn ident(folder: &Path, words: &[&str]) -> (i32, Value) {
    let out = run(folder, words);
    let said = String::from_utf8_lossy(&out.stderr).to_string();
    let json = serde_json::from_slice(&out.stdout).unwrap_or_else(|_| panic!("{said}"));
    (out.status.code().unwrap(), json)
}

#[test]
fn the_verb_writes_path_and_program_and_says_what_was_checked() {
    let folder = tempfile::tempdir().unwrap();
    job(folder.path(), SLOT, 1500.0, "");
    let words = ["compensate", "job.toml", "--static", "--json"];
    let (status, json) = ident(folder.path(), &words);
    assert_eq!(json["method"], "mirror");
    assert!(json["reduction_percent"].as_f64().unwrap() > 80.0);
    let [low, high] = [0, 1].map(|i| json["after_ci95_max_mm"][i].as_f64().unwrap());
    assert!(low <= high);
    let good = json["tolerance_met"] == "yes"
        && json["checked"]
            .as_array()
            .unwrap()
            .iter()
            .all(|c| c["ok"] == true);
    assert_eq!(status, i32::from(!good));
    assert_eq!(json["limited_by"].as_array().unwrap().len(), 6);
    assert!(
        json["next"]["measure"]
            .as_str()
            .unwrap()
            .contains("ident force")
    );
    let program = folder.path().join(json["program"].as_str().unwrap());
    let program = std::fs::read_to_string(program).unwrap();
    assert!(program.contains("LIN") && program.contains("sha256"));
    // the corrected path is a path: it can be planned, with the job's robot
    let corrected = folder.path().join(json["path"].as_str().unwrap());
    let text = std::fs::read_to_string(&corrected).unwrap();
    std::fs::write(folder.path().join("path.csv"), &text).unwrap();
    assert_eq!(
        ident(folder.path(), &["plan", "job.toml", "--json"]).1["exceeded"],
        Value::Array(vec![])
    );
}

/// What is left of a corrected path would be measured from its commands.
#[test]
fn a_corrected_path_is_not_corrected_again() {
    let folder = tempfile::tempdir().unwrap();
    job(folder.path(), SLOT, 1500.0, "");
    let (_, json) = ident(
        folder.path(),
        &["compensate", "job.toml", "--static", "--json"],
    );
    let corrected = folder.path().join(json["path"].as_str().unwrap());
    std::fs::copy(corrected, folder.path().join("path.csv")).unwrap();
    let (status, said) = said(folder.path(), &["compensate", "job.toml", "--static"]);
    assert_eq!(status, Some(2));
    assert!(said.contains("path.csv: is a corrected path"), "{said}");
    assert!(said.contains("as it was drawn"), "{said}");
}

#[test]
fn of_a_plant_that_mills_something_else_only_robot_and_material_are_taken_and_that_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let other = folder.path().join("other");
    std::fs::create_dir(&other).unwrap();
    job(folder.path(), SLOT, 1500.0, "");
    job(&other, DEEP, 1500.0, "");
    let words = ["compensate", "job.toml", "--static", "--dry-run", "--plant"];
    let of = |plant: &str| said(folder.path(), &[&words[..], &[plant]].concat()).1;
    let remark = "only its robot and its material are taken";
    assert!(of("other/job.toml").contains(remark));
    // the same points, a line further down
    job(&other, SLOT, 1500.0, "");
    let path = std::fs::read_to_string(other.join("path.csv")).unwrap();
    std::fs::write(
        other.join("path.csv"),
        format!("# source = \"again\"\n{path}"),
    )
    .unwrap();
    assert!(!of("other/job.toml").contains(remark));
}

/// Exit status and standard error.
fn said(folder: &Path, words: &[&str]) -> (Option<i32>, String) {
    let out = run(folder, words);
    let said = String::from_utf8_lossy(&out.stderr).to_string();
    (out.status.code(), said)
}

#[test]
fn a_dry_run_writes_nothing_and_an_unknown_method_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    job(folder.path(), SLOT, 1500.0, "");
    let words = ["compensate", "job.toml", "--static", "--json", "--dry-run"];
    let (_, json) = ident(folder.path(), &words);
    assert!(json["path"].is_null() && json["program"].is_null());
    assert!(!folder.path().join("reports").exists());
    let out = Command::new(env!("CARGO_BIN_EXE_ident"))
        .current_dir(folder.path())
        .args(["compensate", "job.toml", "--method", "mirrors"])
        .output()
        .unwrap();
    assert_eq!(out.status.code(), Some(2));
}

/// Every file under `reports/`, without what an interrupted write left beside them.
fn results(folder: &Path) -> std::collections::BTreeMap<String, Vec<u8>> {
    let mut found = std::collections::BTreeMap::new();
    for entry in std::fs::read_dir(folder.join("reports/job"))
        .into_iter()
        .flatten()
    {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().to_string();
        if !name.starts_with('.') && !name.contains(".tmp") {
            found.insert(name, std::fs::read(path).unwrap());
        }
    }
    found
}

#[test]
fn results_are_the_same_bytes_every_time_and_whole_after_a_kill() {
    let folder = tempfile::tempdir().unwrap();
    let start = || {
        Command::new(env!("CARGO_BIN_EXE_ident"))
            .current_dir(folder.path())
            .args([
                "compensate",
                "job.toml",
                "--static",
                "--method",
                "ideal-force",
            ])
            .stdout(std::process::Stdio::null())
            .stderr(std::process::Stdio::null())
            .spawn()
            .unwrap()
    };
    let finished = |feed: f64| {
        job(folder.path(), "-16,20,-2\n20,20,-2\n", feed, "");
        assert!(start().wait().unwrap().code().is_some_and(|code| code < 2));
        results(folder.path())
    };
    let new = finished(3000.0);
    let begin = std::time::Instant::now();
    let old = finished(3600.0);
    let whole = begin.elapsed();
    assert_ne!(old, new);
    for kill in 1..=5 {
        job(folder.path(), "-16,20,-2\n20,20,-2\n", 3000.0, "");
        let mut running = start();
        std::thread::sleep(whole * kill / 5);
        let _ = running.kill();
        running.wait().unwrap();
        for (name, bytes) in results(folder.path()) {
            assert!(bytes == old[&name] || bytes == new[&name], "{name} is torn");
        }
    }
    assert_eq!(finished(3000.0), new);
}

/// A campaign with a part: the robot that its axis test found corrects it, and the last chapter says so.
#[test]
fn a_campaign_ends_with_its_part_corrected() {
    let folder = tempfile::tempdir().unwrap();
    let part = folder.path().join("measurements/c/part");
    std::fs::create_dir_all(&part).unwrap();
    job(&part, "-16,20,-2\n20,20,-2\n", 3000.0, "");
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210/axis6.csv");
    std::fs::copy(example, part.with_file_name("axis6.csv")).unwrap();
    let (status, run) = ident(folder.path(), &["run", "measurements/c", "--json"]);
    assert_eq!(status, 0);
    let steps = run["steps"].as_array().unwrap();
    let last = steps.last().unwrap();
    assert_eq!(last["verb"], "compensate");
    let said = last["sentences"][0].as_str().unwrap();
    assert!(said.contains("from the drawn path falls from"), "{said}");
    let results = folder.path().join("reports/c");
    let corrected = std::fs::read_to_string(results.join("part/compensated.csv")).unwrap();
    assert!(corrected.contains("fits/c/robot.toml"), "{corrected}");
    assert!(results.join("part/compensated.src").is_file());
    let page = std::fs::read_to_string(results.join("index.html")).unwrap();
    assert!(
        page.contains("The part, corrected for fits/c/robot.toml")
            && page.contains("compensate-map")
    );
}

/// A part that cannot be cut as its job says ends no campaign: what was measured is told, and why not the part.
#[test]
fn a_part_that_cannot_be_cut_leaves_the_campaign_its_report() {
    let folder = tempfile::tempdir().unwrap();
    let part = folder.path().join("measurements/c/part");
    std::fs::create_dir_all(&part).unwrap();
    let path = job(&part, "-16,20,-8\n20,20,-8\n", 3000.0, "");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replace("flute_mm = 20.0", "flute_mm = 2.0")).unwrap();
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210/axis6.csv");
    std::fs::copy(example, part.with_file_name("axis6.csv")).unwrap();
    let (status, run) = ident(folder.path(), &["run", "measurements/c", "--json"]);
    assert_eq!(status, 0);
    let last = run["steps"].as_array().unwrap().last().unwrap();
    assert_eq!(
        (&last["verb"], &last["needs_attention"]),
        (&"compensate".into(), &true.into())
    );
    let said = last["sentences"][0].as_str().unwrap();
    assert!(said.contains("flute"), "{said}");
    assert!(folder.path().join("reports/c/index.html").is_file());
    assert!(
        !folder
            .path()
            .join("reports/c/part/compensated.csv")
            .exists()
    );
}
