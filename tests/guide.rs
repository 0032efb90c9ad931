//! The guide (`docs/guide`) is true: its commands run in a copy of the example campaigns with the status and the
//! lines that it prints, every key of JSON and every file that it names is there, and so is every drawing.
//!
//! A fenced block `console` holds commands (`$ ident ...`, with `# status 1` where that is the end) and lines of
//! their output in order (`...`: others between). A block with `file=NAME` is a file to be written. A table that
//! begins with `key` speaks of the last command with `--json`.

use crate::bench_of_files::Bench;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/guide/src")
}

fn chapters() -> Vec<(String, String)> {
    let summary = std::fs::read_to_string(folder().join("SUMMARY.md")).unwrap();
    let named = summary
        .split("](")
        .skip(1)
        .filter_map(|rest| rest.split_once(')'));
    let read = |(name, _): (&str, &str)| {
        let text = std::fs::read_to_string(folder().join(name));
        (
            name.to_string(),
            text.unwrap_or_else(|e| panic!("{name}: {e}")),
        )
    };
    named.map(read).collect()
}

/// A copy of the example campaigns.
fn bench() -> Bench {
    fn copy(bench: &Bench, root: &Path, folder: &Path) {
        for entry in std::fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            match path.is_dir() {
                true => copy(bench, root, &path),
                false => {
                    let name = path.strip_prefix(root).unwrap().display().to_string();
                    bench.put(&name, &std::fs::read(&path).unwrap());
                }
            }
        }
    }
    let bench = Bench::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    copy(&bench, root, &root.join("measurements"));
    bench
}

/// What is done on the way through a chapter, with its line.
enum Step {
    Run {
        words: Vec<String>,
        status: i32,
        shows: Vec<String>,
    },
    File {
        name: String,
        text: String,
    },
    Key(String),
}

fn words(command: &str) -> Vec<String> {
    let (mut all, mut word, mut quote, mut open) = (Vec::new(), String::new(), None, false);
    for c in command.chars() {
        match (quote, c) {
            (Some(q), c) if c == q => quote = None,
            (None, '\'' | '"') => (quote, open) = (Some(c), true),
            (None, ' ') => {
                if !word.is_empty() || open {
                    all.push(std::mem::take(&mut word));
                }
                open = false;
            }
            _ => word.push(c),
        }
    }
    if !word.is_empty() {
        all.push(word);
    }
    all
}

fn commands(body: &[(usize, &str)]) -> Vec<(usize, Step)> {
    let mut steps: Vec<(usize, Step)> = Vec::new();
    for (line, text) in body {
        if let Some(command) = text.strip_prefix("$ ident ") {
            let (command, status) = command.split_once("# status ").unwrap_or((command, "0"));
            let step = Step::Run {
                words: words(command.trim()),
                status: status.trim().parse().unwrap(),
                shows: Vec::new(),
            };
            steps.push((*line, step));
        } else if let Some((_, Step::Run { shows, .. })) = steps.last_mut() {
            shows.push(text.trim_end().to_string());
        } else {
            panic!("line {line}: output before a command");
        }
    }
    steps
}

/// Every back-quoted word of a line.
fn quoted(line: &str) -> Vec<&str> {
    line.split('`').skip(1).step_by(2).collect()
}

fn steps(text: &str) -> Vec<(usize, Step)> {
    let mut steps = Vec::new();
    let mut fence: Option<(String, Vec<(usize, &str)>)> = None;
    let mut keys = false;
    for (i, line) in text.lines().enumerate() {
        let number = i + 1;
        match (&mut fence, line.strip_prefix("```")) {
            (None, Some(info)) => fence = Some((info.to_string(), Vec::new())),
            (Some(_), Some(_)) => {
                let (info, body) = fence.take().unwrap();
                if info == "console" {
                    steps.extend(commands(&body));
                } else if let Some((_, name)) = info.split_once("file=") {
                    let text = body.iter().map(|(_, line)| format!("{line}\n")).collect();
                    steps.push((
                        number,
                        Step::File {
                            name: name.into(),
                            text,
                        },
                    ));
                }
            }
            (Some((_, body)), None) => body.push((number, line)),
            (None, None) => {
                let cell = line
                    .strip_prefix('|')
                    .and_then(|rest| rest.split('|').next());
                keys = cell.is_some_and(|cell| keys || cell.trim() == "key");
                let own = cell.filter(|_| keys).map_or(Vec::new(), quoted);
                steps.extend(
                    own.into_iter()
                        .map(|key| (number, Step::Key(key.to_string()))),
                );
            }
        }
    }
    assert!(fence.is_none(), "a block does not end");
    steps
}

/// Whether a document holds a key such as `results[].parameters[].value`.
fn holds(value: &Value, path: &str) -> bool {
    let (head, rest) = path.split_once('.').unwrap_or((path, ""));
    let (name, list) = head
        .strip_suffix("[]")
        .map_or((head, false), |name| (name, true));
    let Some(found) = value.get(name) else {
        return false;
    };
    let below = |one: &Value| rest.is_empty() || holds(one, rest);
    match list {
        true => found.as_array().is_some_and(|all| all.iter().any(below)),
        false => below(found),
    }
}

/// The first line that is not shown in its place.
fn lacks<'a>(shows: &'a [String], shown: &str) -> Option<&'a String> {
    let mut lines = shown.lines().map(str::trim_end);
    shows
        .iter()
        .filter(|line| !line.is_empty() && *line != "...")
        .find(|line| !lines.any(|shown| shown == line.as_str()))
}

fn walk(name: &str, text: &str) -> usize {
    let bench = bench();
    let (mut last, mut run) = (Value::Null, 0);
    for (line, step) in steps(text) {
        let at = format!("{name}:{line}");
        match step {
            Step::File { name, text } => bench.put(&name, text.as_bytes()),
            Step::Key(key) => assert!(holds(&last, &key), "{at}: no key `{key}`"),
            Step::Run {
                words,
                status,
                shows,
            } => {
                let ran = bench.run(&words.iter().map(String::as_str).collect::<Vec<_>>());
                let said = format!("{at}: ident {}\n{}{}", words.join(" "), ran.out, ran.errors);
                assert_eq!(ran.status, status, "{said}");
                let shown = format!("{}{}", ran.errors, ran.out);
                assert_eq!(lacks(&shows, &shown), None, "{said}");
                if words.iter().any(|word| word == "--json") {
                    last = serde_json::from_str(&ran.out).unwrap_or_else(|e| panic!("{at}: {e}"));
                }
                run += 1;
            }
        }
    }
    let results = text
        .lines()
        .flat_map(quoted)
        .filter(|word| word.starts_with("reports/") || word.starts_with("fits/"));
    for file in results.filter(|word| !word.contains(['<', '*'])) {
        assert!(
            bench.path(file).exists(),
            "{name}: `{file}` is not there after the chapter"
        );
    }
    run
}

macro_rules! chapters {
    ($($test:ident: $file:literal),* $(,)?) => {
        $(#[test]
        fn $test() {
            let all = chapters();
            let (name, text) = all.iter().find(|(name, _)| name == $file).expect("a chapter of the summary");
            println!("{name}: {} commands", walk(name, text));
        })*

        #[test]
        fn every_chapter_is_walked_through() {
            let named: BTreeSet<String> = chapters().into_iter().map(|(name, _)| name).collect();
            let walked: BTreeSet<String> = [$($file.to_string()),*].into();
            assert_eq!(named, walked);
            let there = std::fs::read_dir(folder()).unwrap().flatten().map(|e| e.file_name().into_string().unwrap());
            let there: BTreeSet<String> = there.filter(|name| name.ends_with(".md") && name != "SUMMARY.md").collect();
            assert_eq!(there, walked, "every file of the folder stands in the summary");
        }
    };
}

chapters! {
    the_introduction: "introduction.md",
    a_first_afternoon: "afternoon.md",
    the_set_ups: "setups.md",
    own_files: "own-files.md",
    the_robot: "robot.md",
    the_methods: "methods.md",
    the_numbers: "numbers.md",
    milling: "milling.md",
    what_is_odd: "odd.md",
}

#[test]
fn every_drawing_is_there_and_drawn_from_every_set_up() {
    let all: String = chapters().into_iter().map(|(_, text)| text).collect();
    let shown = all
        .split("![")
        .skip(1)
        .filter_map(|rest| rest.split_once("](")?.1.split_once(')'));
    let shown: BTreeSet<&str> = shown.map(|(name, _)| name).collect();
    for name in &shown {
        let text =
            std::fs::read_to_string(folder().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(
            text.starts_with("<svg")
                && text.contains("<title>")
                && text.trim_end().ends_with("</svg>"),
            "{name}"
        );
    }
    let there = std::fs::read_dir(folder().join("figures"))
        .unwrap()
        .flatten();
    for file in there {
        let name = format!("figures/{}", file.file_name().to_string_lossy());
        assert!(shown.contains(name.as_str()), "{name} is shown nowhere");
    }
}

#[test]
fn every_verb_and_kind_that_is_named_exists_and_none_is_left_out() {
    let bench = Bench::new();
    let all: String = chapters().into_iter().map(|(_, text)| text).collect();
    let verbs = all
        .split("`ident ")
        .skip(1)
        .filter_map(|rest| rest.split(['`', ' ', '\n']).next());
    let verbs: BTreeSet<&str> = verbs
        .filter(|verb| verb.chars().all(|c| c.is_ascii_lowercase()) && !verb.is_empty())
        .collect();
    for verb in &verbs {
        assert_eq!(bench.run(&[verb, "--help"]).status, 0, "`ident {verb}`");
    }
    for kind in ident::findings::kinds::kinds() {
        assert!(
            all.contains(&format!("`{kind}`")),
            "the kind `{kind}` is told nowhere"
        );
    }
}

#[test]
fn the_reader_of_chapters_sees_what_is_wrong() {
    let text = "```console\n$ ident a 'b c' # status 1\none\n...\ntwo\n```\n| key | m |\n|---|---|\n| `a[].b` | x |\n";
    let steps = steps(text);
    let Step::Run {
        words,
        status,
        shows,
    } = &steps[0].1
    else {
        panic!()
    };
    assert_eq!(
        (words.join("|"), *status, shows.len()),
        ("a|b c".into(), 1, 3)
    );
    assert_eq!(lacks(shows, "zero\none\nx\ntwo\n"), None);
    assert_eq!(lacks(shows, "two\none\n"), Some(&"two".to_string()));
    let Step::Key(key) = &steps[1].1 else {
        panic!()
    };
    assert!(holds(&serde_json::json!({"a": [{"c": 1}, {"b": 2}]}), key));
    assert!(!holds(&serde_json::json!({"a": [{"c": 1}]}), key));
}
