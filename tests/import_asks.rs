//! `ident import` at a terminal asks for what is missing, and keeps the answers; elsewhere it lists all of it.

use crate::bench_of_files::{Bench, document};
use std::io::Write;
use std::process::{Command, Stdio};

fn raw() -> String {
    let row = |i: usize| {
        let wave = (i as f64 * 0.05).sin();
        format!(
            "{:.2};{:.3};{:.4}\n",
            0.1 * i as f64,
            0.8 * wave,
            1.0 + 0.4 * wave
        )
    };
    format!("t;F;s\n{}", (0..400).map(row).collect::<String>())
}

/// Runs words with a terminal in place of the input; `None` where no program makes one.
fn at_terminal(bench: &Bench, words: &str, answers: &str) -> Option<String> {
    let command = format!("{} {words}", env!("CARGO_BIN_EXE_ident"));
    let mut child = Command::new("script")
        .args(["-qec", &command, "/dev/null"])
        .current_dir(bench.path(""))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .ok()?;
    child.stdin.take()?.write_all(answers.as_bytes()).ok()?;
    let output = child.wait_with_output().ok()?;
    Some(String::from_utf8_lossy(&output.stdout).to_string())
}

#[test]
fn a_terminal_is_asked_and_the_answers_are_kept() {
    let bench = Bench::new();
    bench.put("raw.csv", raw().as_bytes());
    let answers = "load-cycle\n1\n2 force_kN\n3\n2\nrotation\n0.5\n0.4\n";
    let Some(said) = at_terminal(&bench, "import raw.csv", answers) else {
        println!("passed over: there is no `script`");
        return;
    };
    assert!(said.contains("load_lever_m (lever of the force"), "{said}");
    let kept = bench.text("raw.ident.toml");
    for line in [
        "kind = \"load-cycle\"",
        "force_kN = 2",
        "joint = 2",
        "sensor_lever_m = 0.4",
    ] {
        assert!(kept.contains(line), "{line}: {kept}");
    }
    let json = document(&bench.run(&["inspect", "raw.csv", "--json"]));
    assert_eq!(
        (json["kind"].as_str(), json["rows"].as_u64()),
        (Some("load-cycle"), Some(400))
    );
    let again = at_terminal(&bench, "import raw.csv", "").unwrap();
    assert!(
        !again.contains("empty answer"),
        "nothing is left to ask: {again}"
    );
}

#[test]
fn elsewhere_everything_missing_is_listed_at_once() {
    let bench = Bench::new();
    bench.put(
        "raw.csv",
        raw()
            .replace("t;F;s", "Zeit [s];Kraft [kN];Weg [mm]")
            .as_bytes(),
    );
    let words = [
        "import",
        "raw.csv",
        "--kind",
        "load-cycle",
        "--fact",
        "joint=2",
        "--json",
    ];
    let ran = bench.run(&words);
    assert_eq!(ran.status, 1);
    let json = document(&ran);
    let missing = &json["results"][0]["missing"];
    assert_eq!(
        missing,
        &serde_json::json!(["axis", "load_lever_m", "sensor_lever_m"])
    );
    bench.put("bare.csv", raw().as_bytes());
    assert_eq!(
        bench.run(&["import", "bare.csv"]).status,
        2,
        "titles that tell nothing"
    );
}
