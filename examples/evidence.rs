//! Takes the evidence: `cargo run --release --example evidence [SEED] [CASES]` runs every blind suite, every judge and
//! every suite of intervals with many cases on seeds of its own, and writes `docs/evidence.md`: command, date,
//! commit, rates and matrices as the suites print them. The suites of `cargo test` hold fixed seeds.

use std::process::Command;

/// What is run: the suite, the variable that asks for more cases, how many for each one asked, and what it shows.
struct Suite {
    test: &'static str,
    cases: &'static str,
    /// 0: as many as the suite has by itself.
    times: u64,
    shows: &'static str,
}

/// Every suite; a new one is one line.
const SUITES: &[Suite] = &[
    Suite {
        test: "blind::",
        cases: "IDENT_BLIND_CASES",
        times: 1,
        shows: "Load cycles that hide a cause, by our own generator",
    },
    Suite {
        test: "judge_load_cycle::",
        cases: "IDENT_JUDGE_CASES",
        times: 5,
        shows: "Load cycles by a judge who had not read the program",
    },
    Suite {
        test: "stranger::",
        cases: "IDENT_STRANGER_CASES",
        times: 5,
        shows: "Load cycles by other laws again",
    },
    Suite {
        test: "blind_workspace::",
        cases: "IDENT_BLIND_ROBOT_CASES",
        times: 1,
        shows: "Force steps at nine points that hide a cause, by our own generator",
    },
    Suite {
        test: "judge_workspace::",
        cases: "IDENT_JUDGE_CASES",
        times: 12,
        shows: "Force steps by a judge with robots, habits and formulas of its own",
    },
    Suite {
        test: "blind_hammer::",
        cases: "IDENT_BLIND_ROBOT_CASES",
        times: 1,
        shows: "Hammer tests that hide a cause, by our own generator",
    },
    Suite {
        test: "judge_hammer::hammers_of",
        cases: "IDENT_JUDGE_CASES",
        times: 4,
        shows: "Hammer tests by a judge of its own",
    },
    Suite {
        test: "diagnose_joint_motion::",
        cases: "IDENT_BLIND_CASES",
        times: 1,
        shows: "Joint motions that hide a cause, by our own generator",
    },
    Suite {
        test: "judge_joint_motion::",
        cases: "IDENT_JUDGE_CASES",
        times: 6,
        shows: "Joint motions by a judge of other motions and laws",
    },
    Suite {
        test: "judge_instruments::",
        cases: "IDENT_JUDGE_CASES",
        times: 3,
        shows: "Screws, force sensors, cutting forces and cubes by a judge of the physics alone",
    },
    Suite {
        test: "blind_milling_force::",
        cases: "IDENT_BLIND_CASES",
        times: 0,
        shows: "Cutting forces that hide a cause, by our own generator",
    },
    Suite {
        test: "judge_part::",
        cases: "IDENT_JUDGE_CASES",
        times: 2,
        shows: "Milled parts by a judge of its own",
    },
    Suite {
        test: "damping_robots::",
        cases: "IDENT_BLIND_ROBOT_CASES",
        times: 1,
        shows: "Dampings of robots by other formulas: intervals and modes",
    },
    Suite {
        test: "damping_coverage::",
        cases: "IDENT_COVERAGE_CAMPAIGNS",
        times: 1,
        shows: "Dampings of the example's robot: intervals",
    },
    Suite {
        test: "stiffness::intervals_cover",
        cases: "IDENT_COVERAGE_SEEDS",
        times: 6,
        shows: "Load cycles: intervals of stiffness",
    },
    Suite {
        test: "force_sensor::",
        cases: "IDENT_COVERAGE_TESTS",
        times: 13,
        shows: "Force sensors: intervals",
    },
    Suite {
        test: "cubes::",
        cases: "IDENT_COVERAGE_TESTS",
        times: 7,
        shows: "Measuring cubes: intervals",
    },
    Suite {
        test: "compensate_interval::",
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
        "# Evidence\n\nWritten by `cargo run --release --example evidence {seed} {cases}` on commit {} of {}. Every block \
         is what the suite printed; rates from our own generators are upper bounds for data by strangers.\n",
        asked(&["rev-parse", "--short", "HEAD"]),
        asked(&["show", "-s", "--format=%cs", "HEAD"]),
    );
    for suite in SUITES {
        eprintln!("{} ...", suite.test);
        page.push_str(&chapter(suite, seed, cases));
        std::fs::write("docs/evidence.md", &page).expect("docs/evidence.md can be written");
    }
}

/// What git answers.
fn asked(words: &[&str]) -> String {
    let out = Command::new("git").args(words).output();
    let text = out.map(|out| String::from_utf8_lossy(&out.stdout).trim().to_string());
    text.unwrap_or_else(|_| "unknown".into())
}

fn chapter(suite: &Suite, seed: u64, cases: u64) -> String {
    let seed = seed.to_string();
    let mut variables = vec![
        ("IDENT_THOROUGH", "1".into()),
        ("IDENT_BLIND_SEED", seed.clone()),
        ("IDENT_STRANGER_SEED", seed),
    ];
    if suite.times > 0 {
        variables.push((suite.cases, (cases * suite.times).to_string()));
    }
    let words = [
        "test",
        "--test",
        "suite",
        suite.test,
        "--",
        "--include-ignored",
        "--nocapture",
    ];
    let typed: Vec<String> = variables.iter().map(|(k, v)| format!("{k}={v}")).collect();
    let typed = format!("{} cargo {}", typed.join(" "), words.join(" "));
    variables.push(("RUST_BACKTRACE", "0".into()));
    let run = Command::new("cargo").args(words).envs(variables).output();
    // some suites write where the harness keeps nothing back
    let said = run.map(|out| {
        [out.stdout, out.stderr]
            .map(|all| String::from_utf8_lossy(&all).into_owned())
            .concat()
    });
    let said = said.unwrap_or_else(|error| format!("could not be run: {error}"));
    format!("\n## {}\n\n`{typed}`\n\n{}", suite.shows, tables(&said))
}

/// How the harness and cargo begin lines of their own, and suites those of single cases.
const PASSED_OVER: [&str; 16] = [
    "running ",
    "test ",
    "failures:",
    "successes:",
    "note:",
    "#",
    "Compiling ",
    "Finished ",
    "Running ",
    "Blocking ",
    "Downloading ",
    "Updating ",
    "Locking ",
    "error: ",
    "warning: ",
    "thread '",
];

/// Rows of matrices as a table, the rates as they stand; single cases and the harness's own lines left out.
fn tables(said: &str) -> String {
    let told = |line: &str| {
        let head = line.split(':').next().unwrap_or("");
        let is_own = |own: &&str| line.trim_start().starts_with(*own);
        // one case with its time: "outside:chirp 10001: 0.41 s, Missed"
        let is_case = line.contains(" s, ") && line.ends_with(char::is_alphabetic);
        let is_name = line.contains("::") && !line.trim().contains(char::is_whitespace);
        !line.trim().is_empty()
            && !is_name
            && !is_case
            && !PASSED_OVER.iter().any(is_own)
            && !head.ends_with(char::is_numeric)
    };
    // what a suite asserts of far more cases than were asked is no evidence
    let mut asserts = false;
    let is_free = |line: &&str| {
        let ends = line.starts_with("note:") || line.starts_with("test ");
        asserts = (asserts || line.starts_with("thread '")) && !ends;
        !asserts
    };
    let (rows, rates): (Vec<&str>, Vec<&str>) = said
        .lines()
        .filter(is_free)
        .filter(|line| told(line))
        .partition(|line| line.starts_with("| "));
    let table = match rows.is_empty() {
        true => String::new(),
        false => format!("| hidden | answers |\n|---|---|\n{}\n\n", rows.join("\n")),
    };
    format!("{table}```\n{}\n```\n", rates.join("\n"))
}
