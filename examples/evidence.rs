//! Takes the evidence: `cargo run --release --example evidence [SEED] [CASES]` runs every blind suite and
//! every suite of intervals with many cases on seeds of its own, and writes `docs/evidence.md`: command,
//! commit, rates and matrices as the suites print them. The suites of `cargo test` hold fixed seeds.

use std::process::Command;

/// What is run: the suite, the variables that ask for more cases, and what it shows.
struct Suite {
    test: &'static str,
    cases: &'static str,
    times: u64,
    shows: &'static str,
}

/// Every suite; a new one is one line.
const SUITES: &[Suite] = &[
    Suite {
        test: "blind",
        cases: "IDENT_BLIND_CASES",
        times: 2,
        shows: "Load cycles that hide a cause",
    },
    Suite {
        test: "blind_workspace",
        cases: "IDENT_BLIND_ROBOT_CASES",
        times: 1,
        shows: "Force steps at nine points that hide a cause",
    },
    Suite {
        test: "blind_hammer",
        cases: "IDENT_BLIND_ROBOT_CASES",
        times: 1,
        shows: "Hammer tests that hide a cause",
    },
    Suite {
        test: "diagnose_joint_motion",
        cases: "IDENT_BLIND_CASES",
        times: 1,
        shows: "Joint motions that hide a cause",
    },
    Suite {
        test: "damping_robots",
        cases: "IDENT_BLIND_ROBOT_CASES",
        times: 1,
        shows: "Dampings of robots by other formulas: intervals and modes",
    },
    Suite {
        test: "damping_coverage",
        cases: "IDENT_COVERAGE_CAMPAIGNS",
        times: 1,
        shows: "Dampings of the example's robot: intervals",
    },
    Suite {
        test: "force_sensor",
        cases: "IDENT_COVERAGE_TESTS",
        times: 13,
        shows: "Force sensors: intervals",
    },
    Suite {
        test: "cubes",
        cases: "IDENT_COVERAGE_TESTS",
        times: 7,
        shows: "Measuring cubes: intervals",
    },
    Suite {
        test: "judge_instruments",
        cases: "IDENT_JUDGE_CASES",
        times: 3,
        shows: "Screws, force sensors, cutting forces and cubes by a judge of the physics alone",
    },
    Suite {
        test: "milled_part",
        cases: "IDENT_PART_CASES",
        times: 1,
        shows: "Milled parts of plants that are not the model",
    },
    Suite {
        test: "compensate_interval",
        cases: "IDENT_COVERAGE_PLANTS",
        times: 12,
        shows: "Compensated parts: intervals of what is left",
    },
];

fn main() {
    let mut words = std::env::args().skip(1);
    let number =
        |word: Option<String>, default: u64| word.and_then(|w| w.parse().ok()).unwrap_or(default);
    let seed = number(words.next(), 1);
    let cases = number(words.next(), 16);
    let mut page = format!(
        "# Evidence\n\nWritten by `cargo run --release --example evidence {seed} {cases}` at commit {}. Every block is what \
         the suite printed; rates from our own generators are upper bounds for data by strangers.\n",
        commit()
    );
    for suite in SUITES {
        eprintln!("{} ...", suite.test);
        page.push_str(&chapter(suite, seed, cases));
        std::fs::write("docs/evidence.md", &page).expect("docs/evidence.md can be written");
    }
}

fn commit() -> String {
    let asked = Command::new("git")
        .args(["rev-parse", "--short", "HEAD"])
        .output();
    let text = asked.map(|out| String::from_utf8_lossy(&out.stdout).trim().to_string());
    text.unwrap_or_else(|_| "unknown".into())
}

fn chapter(suite: &Suite, seed: u64, cases: u64) -> String {
    let count = (cases * suite.times).to_string();
    let typed = format!(
        "IDENT_BLIND_SEED={seed} {}={count} cargo test --release --test suite {}:: -- --nocapture",
        suite.cases, suite.test
    );
    let run = Command::new("cargo")
        .args(["test", "--release", "--test", "suite"])
        .arg(format!("{}::", suite.test))
        .args(["--", "--nocapture"])
        .env("IDENT_BLIND_SEED", seed.to_string())
        .env(suite.cases, &count)
        .output();
    let said = run.map(|out| {
        format!(
            "{}{}",
            String::from_utf8_lossy(&out.stderr),
            String::from_utf8_lossy(&out.stdout)
        )
    });
    let said = said.unwrap_or_else(|error| format!("could not be run: {error}"));
    format!("\n## {}\n\n`{typed}`\n\n{}", suite.shows, tables(&said))
}

/// Rows of matrices as a table, the rates as they stand; single cases and the harness's own lines left out.
fn tables(said: &str) -> String {
    let rows: Vec<&str> = said.lines().filter(|l| l.starts_with("| ")).collect();
    let rates = [
        "right",
        "clean:",
        "singles",
        "pairs",
        "cases",
        "single,",
        "gain intervals",
        "true cause",
        "intervals",
        "hold",
        "seconds",
    ];
    let told = |line: &&str| {
        !line.starts_with('|')
            && rates.iter().any(|r| line.contains(r))
            && line.split(':').next().is_some_and(|head| {
                head.parse::<u64>().is_err() && !head.ends_with(char::is_numeric)
            })
    };
    let rates: Vec<&str> = said.lines().filter(told).collect();
    let table = match rows.is_empty() {
        true => String::new(),
        false => format!("| hidden | answers |\n|---|---|\n{}\n\n", rows.join("\n")),
    };
    format!("{table}```\n{}\n```\n", rates.join("\n"))
}
