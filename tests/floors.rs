//! The house rule: a module uses only floors below its own.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Every module of the house and its floor.
const FLOORS: &[(&str, usize)] = &[
    ("ground", 0),
    ("measurement", 1),
    ("signal", 1),
    ("sheet", 1),
    ("effects", 2),
    ("cutting", 2),
    ("robot", 3),
    ("motion", 4),
    ("path", 4),
    ("experiments", 5),
    ("planning", 5),
    ("inference", 6),
    ("causes", 7),
    ("fit", 7),
    ("process", 7),
    ("findings", 8),
    ("laboratory", 8),
    ("compensation", 8),
    ("report", 9),
    ("cli", 10),
];

/// Neighbours on one floor that may be used, as (user, used). None so far.
const NEIGHBOURS: &[(&str, &str)] = &[];

fn floor(module: &str) -> Option<usize> {
    FLOORS.iter().find(|f| f.0 == module).map(|f| f.1)
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        match path.is_dir() {
            true => sources(&path, found),
            false if path.extension().is_some_and(|e| e == "rs") => found.push(path),
            false => {}
        }
    }
}

/// The module a source file belongs to; `None` for `lib.rs` and `main.rs`, which see the whole house.
fn module_of(root: &Path, file: &Path) -> Option<String> {
    let inside = file.strip_prefix(root).unwrap();
    let first = inside.components().next().unwrap();
    let name = Path::new(first.as_os_str()).file_stem().unwrap();
    let name = name.to_string_lossy().to_string();
    (name != "lib" && name != "main").then_some(name)
}

/// Names after every `crate::`, with their lines; groups as in `use crate::{a, b::c}` included.
/// Comments do not use anything.
fn uses(text: &str) -> Vec<(usize, String)> {
    let code: Vec<&str> = text
        .lines()
        .map(|l| l.split("//").next().unwrap())
        .collect();
    let code = code.join("\n");
    let mut found = Vec::new();
    for (at, key) in code.match_indices("crate::") {
        let line = code[..at].matches('\n').count() + 1;
        let rest = &code[at + key.len()..];
        found.extend(first_names(rest).into_iter().map(|name| (line, name)));
    }
    found
}

fn first_names(rest: &str) -> Vec<String> {
    match rest.strip_prefix('{') {
        None => vec![word(rest)],
        Some(group) => members(group).iter().map(|m| word(m.trim())).collect(),
    }
}

fn word(text: &str) -> String {
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_');
    text[..end.unwrap_or(text.len())].to_string()
}

/// What stands between the commas of a group, up to its closing brace.
fn members(group: &str) -> Vec<String> {
    let (mut depth, mut all, mut one) = (0, Vec::new(), String::new());
    for c in group.chars() {
        match c {
            '}' if depth == 0 => break,
            ',' if depth == 0 => all.push(std::mem::take(&mut one)),
            _ => {
                depth += i32::from(c == '{') - i32::from(c == '}');
                one.push(c);
            }
        }
    }
    all.push(one);
    all.retain(|m| !m.trim().is_empty());
    all
}

fn may_use(user: &str, used: &str) -> bool {
    let (Some(own), Some(other)) = (floor(user), floor(used)) else {
        return false;
    };
    user == used || other < own || NEIGHBOURS.contains(&(user, used))
}

#[test]
fn a_module_uses_only_floors_below_its_own() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    files.sort();
    let mut wrong = Vec::new();
    let mut seen = BTreeSet::new();
    for file in &files {
        let Some(user) = module_of(&root, file) else {
            continue;
        };
        seen.insert(user.clone());
        for (line, used) in uses(&std::fs::read_to_string(file).unwrap()) {
            if !may_use(&user, &used) {
                let place = file.strip_prefix(&root).unwrap().display();
                wrong.push(format!("src/{place}:{line}: {user} uses {used}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    let homeless: Vec<_> = seen.iter().filter(|m| floor(m).is_none()).collect();
    assert!(homeless.is_empty(), "give a floor to {homeless:?}");
    assert!(seen.contains("ground") && seen.contains("cli"), "{seen:?}");
}

#[test]
fn uses_are_found_in_every_spelling() {
    let text =
        "use crate::{fit::x, ground::{a, b},\n signal};\n// crate::cli\nlet a = crate::sheet::A;";
    let found: Vec<String> = uses(text).into_iter().map(|u| u.1).collect();
    assert_eq!(found, ["fit", "ground", "signal", "sheet"]);
    assert!(!may_use("ground", "fit") && !may_use("signal", "measurement"));
    assert!(may_use("report", "sheet") && !may_use("report", "cli"));
}

/// Lines above which a file holds more than one noun.
const LONGEST: usize = 310;

#[test]
fn no_file_is_longer_than_one_noun() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    let lines = |file: &PathBuf| std::fs::read_to_string(file).unwrap().lines().count();
    files.retain(|file| lines(file) > LONGEST);
    assert!(files.is_empty(), "split {files:#?}");
}
