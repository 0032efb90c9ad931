//! Rule 3: bounded cost, no panic, clean exits.

use crate::bench_of_files::{Bench, rows, with_rows};
use crate::honest::file::File;
use crate::honest::withheld::short_hammer;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

fn within(limit_s: u64, what: &str, run: impl FnOnce()) {
    let start = Instant::now();
    run();
    let took = start.elapsed();
    assert!(took < Duration::from_secs(limit_s), "{what} took {took:?}");
}

#[test]
fn a_time_base_that_no_hammer_test_has_is_refused() {
    for unit in ["time_ms", "time_us"] {
        let file = short_hammer().title("time_s", unit);
        for verb in ["damping", "diagnose", "frf", "inspect"] {
            let bench = Bench::new();
            bench.put("h.csv", file.text().as_bytes());
            let arguments: &[&str] = match verb {
                "damping" => &["damping", "--dry-run", "--frf", "h.csv"],
                "frf" => &["frf", "--modes", "h.csv"],
                _ => &[verb, "h.csv"],
            };
            let ran = bench.run(arguments);
            assert!(ran.status > 0, "{verb} {unit}: {}", ran.out);
        }
    }
}

#[test]
fn a_dead_channel_is_refused_at_once() {
    let file = short_hammer().map("ay_m_s2", |_, _| 0.0);
    let bench = Bench::new();
    bench.put("h.csv", file.text().as_bytes());
    within(20, "a dead channel", || {
        let ran = bench.run(&["damping", "--dry-run", "--frf", "h.csv"]);
        ran.is_refusal("dead", "h.csv", None, "ay never changes");
    });
}

#[test]
fn endless_and_deep_inputs_are_refused() {
    let bench = Bench::new();
    let header = (0..120_000)
        .map(|i| format!("c{i}_N"))
        .collect::<Vec<_>>()
        .join(",");
    bench.put(
        "wide.csv",
        format!("# kind = \"load-cycle\"\n{header}\n").as_bytes(),
    );
    let deep = format!("<robot name=\"r\">{}", "<a>".repeat(250_000));
    bench.put("deep.urdf", deep.as_bytes());
    within(10, "wide and deep", || {
        let ran = bench.run(&["stiffness", "wide.csv"]);
        ran.is_refusal("wide", "wide.csv", Some(2), "columns");
        let ran = bench.run(&["robot", "check", "deep.urdf"]);
        ran.is_refusal("deep", "deep.urdf", Some(1), "nested");
    });
}

#[cfg(unix)]
#[test]
fn devices_and_pipes_are_refused() {
    let bench = Bench::new();
    bench.put("good.csv", with_rows(&rows(400)).as_bytes());
    let pipe = bench.path("pipe.csv");
    let made = Command::new("mkfifo").arg(&pipe).status();
    let mut inputs = vec!["/dev/zero".to_string()];
    if made.is_ok_and(|status| status.success()) {
        inputs.push("pipe.csv".into());
    }
    for input in &inputs {
        within(10, input, || {
            for arguments in [
                vec!["stiffness", input],
                vec!["inspect", input],
                vec!["robot", "check", input],
                vec!["diagnose", "--model", input, "good.csv"],
            ] {
                let ran = bench.run(&arguments);
                assert_eq!(ran.status, 2, "{arguments:?}");
                assert!(
                    ran.errors.contains("regular"),
                    "{arguments:?}: {}",
                    ran.errors
                );
            }
        });
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_error_changes_no_exit_status() {
    let full = std::fs::OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let status = Command::new(env!("CARGO_BIN_EXE_ident"))
        .args(["stiffness", "no-such-file.csv"])
        .stdout(Stdio::null())
        .stderr(full)
        .status()
        .unwrap();
    assert_eq!(status.code(), Some(2));
}

#[test]
fn what_killed_runs_left_is_swept() {
    let bench = Bench::new();
    bench.put("measurements/c/a.csv", with_rows(&rows(400)).as_bytes());
    bench.put("fits/c/.ident-4294967-abc.tmp", b"half");
    let ran = bench.run(&["stiffness", "measurements/c/a.csv"]);
    assert!(ran.status < 2, "{}", ran.errors);
    let left = bench.files().into_iter().find(|f| f.ends_with(".tmp"));
    assert_eq!(left, None);
}

#[test]
fn nothing_in_a_file_steers_the_terminal() {
    let escape = "\\u001b[2J\\u001b]0;x\\u0007";
    let facts = [
        ("kind", format!("\"{escape}\"")),
        ("axis", format!("\"{escape}\"")),
        ("robot", format!("\"{escape}\"")),
    ];
    for (key, value) in facts {
        let bench = Bench::new();
        bench.put(
            "a.csv",
            File::example("axis6.csv")
                .fact(key, &value)
                .text()
                .as_bytes(),
        );
        for verb in ["stiffness", "inspect", "diagnose"] {
            let arguments: &[&str] = if verb == "inspect" {
                &[verb, "a.csv"]
            } else {
                &[verb, "--dry-run", "a.csv"]
            };
            let ran = bench.run(arguments);
            let steers = |text: &str| {
                text.chars()
                    .any(|c| c.is_control() && c != '\n' && c != '\t')
            };
            assert!(!steers(&ran.out) && !steers(&ran.errors), "{verb}, {key}");
        }
    }
}

#[test]
fn refusals_of_stored_fits_have_a_line() {
    let bench = Bench::new();
    bench.put("good.csv", with_rows(&rows(400)).as_bytes());
    for (text, line) in [
        ("schema = 3\n", 1),
        ("schema = \"ident-fit/1\"\nversion = 7\n", 2),
        ("= =\n", 1),
    ] {
        bench.put("fit.toml", text.as_bytes());
        let ran = bench.run(&["diagnose", "--dry-run", "--model", "fit.toml", "good.csv"]);
        ran.is_refusal(text, "fit.toml", Some(line), "");
    }
}
