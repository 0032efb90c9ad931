//! Each example file corrupted in thirty ways, and what every verb makes of it: refused, the right
//! number, or a warning that names a fault. A silent wrong number is none of these.

use crate::bench_of_files::{Bench, Ran};
use crate::common::{few_or_all, is_thorough};
use crate::honest::file::{File, noise};
use crate::honest::withheld::short_hammer;
use rayon::prelude::*;
use serde_json::Value;

/// A way to spoil a file.
pub type Corruption = (&'static str, fn(File) -> File);

/// A verb with its arguments, and whether its answer is that of the clean file.
pub type Verb = (&'static [&'static str], fn(&Value, &Value) -> bool);

fn walk(file: File, title: &str) -> File {
    let mut at = 0.0;
    let steps: Vec<f64> = (0..file.rows.len())
        .map(|i| {
            at += 0.02 * noise(i, 9);
            at
        })
        .collect();
    file.map(title, |i, _| steps[i])
}

const LOAD_CYCLE: &[Corruption] = &[
    ("force in kN", |f| f.title("force_N", "force_kN")),
    ("displacement in µm", |f| {
        f.title("displacement_mm", "displacement_um")
    }),
    ("displacement in m", |f| {
        f.title("displacement_mm", "displacement_m")
    }),
    ("load lever × 10", |f| f.fact("load_lever_m", "5.0")),
    ("load lever in mm", |f| f.fact("load_lever_m", "500.0")),
    ("sensor lever × 10", |f| f.fact("sensor_lever_m", "4.0")),
    ("sensor lever / 10", |f| f.fact("sensor_lever_m", "0.04")),
    ("levers swapped", |f| {
        f.fact("sensor_lever_m", "0.24")
            .fact("sensor2_lever_m", "0.4")
    }),
    ("sign of the force", |f| f.map("force_N", |_, v| -v)),
    ("sign of the displacement", |f| {
        f.map("displacement_mm", |_, v| -v)
    }),
    ("both signs", |f| {
        f.map("displacement_mm", |_, v| -v)
            .map("displacement2_mm", |_, v| -v)
            .map("force_N", |_, v| -v)
    }),
    ("second sensor upside down", |f| {
        f.map("displacement2_mm", |_, v| -v)
    }),
    ("force and displacement swapped", |f| {
        f.swap("force_N", "displacement_mm")
    }),
    ("sensors swapped", |f| {
        f.swap("displacement_mm", "displacement2_mm")
    }),
    ("first quarter of a cycle only", |f| f.rows(|i| i < 130)),
    ("half of the file", |f| {
        let n = f.rows.len() / 2;
        f.rows(move |i| i < n)
    }),
    ("cut within a row", |mut f| {
        f.rows.last_mut().unwrap().truncate(2);
        f
    }),
    ("repeated as a whole", |mut f| {
        let all = f.rows.clone();
        f.rows.extend(all);
        f
    }),
    ("every row twice", |mut f| {
        f.rows = f.rows.iter().flat_map(|r| [r.clone(), r.clone()]).collect();
        f
    }),
    ("displacement clipped above", |f| {
        f.clip("displacement_mm", 0.6, 1.0)
    }),
    ("displacement clipped", |f| {
        f.clip("displacement_mm", 0.8, 0.8)
    }),
    ("force clipped", |f| f.clip("force_N", 0.7, 0.7)),
    ("dead displacement", |f| {
        f.map("displacement_mm", |_, _| 0.01)
    }),
    ("dead force", |f| f.map("force_N", |_, _| 0.0)),
    ("dead second sensor", |f| {
        f.map("displacement2_mm", |_, _| 0.0)
    }),
    ("noise for the displacement", |f| {
        f.map("displacement_mm", |i, _| noise(i, 1))
    }),
    ("a walk for the displacement", |f| {
        walk(f, "displacement_mm")
    }),
    ("noise for the force", |f| {
        f.map("force_N", |i, _| 300.0 * noise(i, 2))
    }),
    ("noise for the second sensor", |f| {
        f.map("displacement2_mm", |i, _| 0.1 * noise(i, 3))
    }),
    ("one force of 1e40", |f| {
        f.map("force_N", |i, v| if i == 300 { 1e40 } else { v })
    }),
    ("one displacement of 1e40", |f| {
        f.map("displacement_mm", |i, v| if i == 300 { 1e40 } else { v })
    }),
    ("all times equal", |f| f.map("time_s", |_, _| 1.0)),
    ("a third of the cells empty", |mut f| {
        f.rows.iter_mut().step_by(3).for_each(|r| r[1].clear());
        f
    }),
    ("five rows", |f| f.rows(|i| i % 250 == 0)),
    ("misspelt fact", |f| {
        f.without("load_lever_m").fact("load_leverm", "0.5")
    }),
];

const WORKSPACE: &[Corruption] = &[
    ("force in kN", |f| f.title("force_N", "force_kN")),
    ("dx in µm", |f| f.title("dx_mm", "dx_um")),
    ("dz in m", |f| f.title("dz_mm", "dz_m")),
    ("all displacements in m", |f| {
        f.title("dx_mm", "dx_m")
            .title("dy_mm", "dy_m")
            .title("dz_mm", "dz_m")
    }),
    ("sign of the force", |f| f.map("force_N", |_, v| -v)),
    ("sign of dx", |f| f.map("dx_mm", |_, v| -v)),
    ("sign of dz", |f| f.map("dz_mm", |_, v| -v)),
    ("dx and dy swapped", |f| f.swap("dx_mm", "dy_mm")),
    ("dx and dz swapped", |f| f.swap("dx_mm", "dz_mm")),
    ("force and dx swapped", |f| f.swap("force_N", "dx_mm")),
    ("cut after five points", |f| f.rows(|i| i < 1000)),
    ("cut within a set-up", |f| {
        let n = f.rows.len() - 40;
        f.rows(move |i| i < n)
    }),
    ("cut within a row", |mut f| {
        f.rows.last_mut().unwrap().truncate(4);
        f
    }),
    ("repeated as a whole", |mut f| {
        let all = f.rows.clone();
        f.rows.extend(all);
        f
    }),
    ("dx clipped", |f| f.clip("dx_mm", 0.5, 0.5)),
    ("dz clipped", |f| f.clip("dz_mm", 0.5, 0.5)),
    ("force clipped", |f| f.clip("force_N", 0.5, 0.5)),
    ("dead dx", |f| f.map("dx_mm", |_, _| 0.0)),
    ("dead dz", |f| f.map("dz_mm", |_, _| 0.02)),
    ("dead force", |f| f.map("force_N", |_, _| 100.0)),
    ("no force", |f| f.map("force_N", |_, _| 0.0)),
    ("noise for dx", |f| f.map("dx_mm", |i, _| 0.3 * noise(i, 1))),
    ("noise for dy", |f| f.map("dy_mm", |i, _| 0.3 * noise(i, 2))),
    ("noise for dz", |f| f.map("dz_mm", |i, _| 0.3 * noise(i, 3))),
    ("noise for all displacements", |f| {
        f.map("dx_mm", |i, _| 0.3 * noise(i, 4))
            .map("dy_mm", |i, _| 0.3 * noise(i, 5))
            .map("dz_mm", |i, _| 0.3 * noise(i, 6))
    }),
    ("noise for the force", |f| {
        f.map("force_N", |i, _| 400.0 * noise(i, 7))
    }),
    ("one force of 1e40", |f| {
        f.map("force_N", |i, v| if i == 30 { 1e40 } else { v })
    }),
    ("one dx of 1e40", |f| {
        f.map("dx_mm", |i, v| if i == 30 { 1e40 } else { v })
    }),
    ("empty displacements", |mut f| {
        f.rows
            .iter_mut()
            .for_each(|r| (4..7).for_each(|k| r[k].clear()));
        f
    }),
    ("another robot", |f| f.fact("robot", "\"kr2100\"")),
    ("misspelt fact", |f| {
        f.without("setup_repeatability")
            .fact("setup_repeatabilty", "0.015")
    }),
];

const HAMMER: &[Corruption] = &[
    ("time in ms", |f| f.title("time_s", "time_ms")),
    ("time in µs", |f| f.title("time_s", "time_us")),
    ("all times equal", |f| f.map("time_s", |_, _| 0.0)),
    ("dead ax", |f| f.map("ax_m_s2", |_, _| 0.0)),
    ("dead az", |f| f.map("az_m_s2", |_, _| 0.1)),
    ("dead force", |f| f.map("force_N", |_, _| 0.0)),
    ("noise for ax", |f| f.map("ax_m_s2", |i, _| noise(i, 1))),
    ("noise for az", |f| f.map("az_m_s2", |i, _| noise(i, 2))),
    ("noise for all accelerations", |f| {
        f.map("ax_m_s2", |i, _| noise(i, 3))
            .map("ay_m_s2", |i, _| noise(i, 4))
            .map("az_m_s2", |i, _| noise(i, 5))
    }),
    ("force in kN", |f| f.title("force_N", "force_kN")),
    ("accelerations a thousand times", |f| {
        f.map("ax_m_s2", |_, v| 1e3 * v)
            .map("ay_m_s2", |_, v| 1e3 * v)
            .map("az_m_s2", |_, v| 1e3 * v)
    }),
    ("hits copied", |mut f| {
        let copy: Vec<Vec<String>> = f
            .rows
            .iter()
            .filter(|r| r[1] == "1")
            .map(|r| {
                let mut r = r.clone();
                r[1] = "9".into();
                r
            })
            .collect();
        f.rows.extend(copy);
        f
    }),
    ("cut within a row", |mut f| {
        f.rows.last_mut().unwrap().truncate(4);
        f
    }),
    ("misspelt fact", |f| {
        f.fact("acelerometer_noise_m_s2", "0.003")
    }),
];

fn first_value(document: &Value) -> Option<f64> {
    document["results"][0]["parameters"][0]["value"].as_f64()
}

fn same_stiffness(found: &Value, clean: &Value) -> bool {
    match (first_value(found), first_value(clean)) {
        (Some(a), Some(b)) => (a / b - 1.0).abs() < 0.02,
        _ => false,
    }
}

fn effects(document: &Value) -> Vec<String> {
    let causes = document["causes"].as_array().cloned().unwrap_or_default();
    let mut all: Vec<String> = causes.iter().map(|c| c["effect"].to_string()).collect();
    all.sort();
    all
}

/// The same causes, or none claimed.
pub fn same_causes(found: &Value, clean: &Value) -> bool {
    let claims = matches!(
        found["verdict"].as_str(),
        Some("explained" | "sufficient" | "partly-explained")
    );
    !claims || effects(found) == effects(clean) && found["verdict"] == clean["verdict"]
}

fn same_errors(found: &Value, clean: &Value) -> bool {
    let mean = |d: &Value| d["mean_abs_error_percent"].as_f64();
    match (mean(found), mean(clean)) {
        (Some(a), Some(b)) => (a - b).abs() < 2.0,
        _ => false,
    }
}

pub fn nothing_to_get_wrong(_: &Value, _: &Value) -> bool {
    true
}

fn never_right(_: &Value, _: &Value) -> bool {
    false
}

pub fn run(arguments: &[&str], file: &File) -> Ran {
    let bench = Bench::new();
    bench.put("a.csv", file.text().as_bytes());
    let mut all = arguments.to_vec();
    all.push("a.csv");
    bench.run(&all)
}

/// What became of a corrupted file, in one word.
fn judged(ran: &Ran, clean: &Value, right: fn(&Value, &Value) -> bool) -> &'static str {
    if ran.status == 2 {
        return "refused";
    }
    let found: Value = serde_json::from_str(&ran.out).unwrap();
    let of = |document: &Value| document["doubts"].as_array().cloned().unwrap_or_default();
    let doubts = [of(&found), of(&found["results"][0])].concat();
    let grave = doubts.iter().any(|d| d["weight"] != "note");
    let odd = found["odd"].as_array().is_some_and(|all| !all.is_empty());
    let said = ran.status == 1 && (grave || odd);
    match (said, right(&found, clean)) {
        (true, _) => "warned",
        (false, true) => "right",
        (false, false)
            if ran.status == 1 && found["doubts"].is_null() && !ran.errors.is_empty() =>
        {
            "warned"
        }
        (false, false) => "SILENT",
    }
}

/// One corruption of so many is asked in a quick run.
const APART: usize = 7;

/// One corruption of [`APART`] before one of the verbs that can be wrong, turn by turn (the first of several looks only); in a thorough
/// run every corruption before every verb.
fn asked(corruption: usize, verb: usize, verbs: usize) -> bool {
    let first = usize::from(verbs > 1);
    let turn = first + corruption / APART % (verbs - first);
    is_thorough() || (corruption.is_multiple_of(APART) && verb == turn)
}

/// Puts every corruption before the verbs; how many answers are wrong without a word.
pub fn table(name: &str, file: &File, corruptions: &[Corruption], verbs: &[Verb]) -> usize {
    let clean: Vec<Value> = verbs
        .iter()
        .map(|verb| serde_json::from_str(&run(verb.0, file).out).unwrap())
        .collect();
    let rows: Vec<(&str, Vec<&str>)> = corruptions
        .par_iter()
        .enumerate()
        .map(|(i, (what, spoil))| {
            let spoiled = spoil(file.clone());
            let cells = verbs.iter().zip(&clean).enumerate();
            let told = |(j, (verb, clean)): (usize, (&Verb, &Value))| match asked(i, j, verbs.len())
            {
                true => judged(&run(verb.0, &spoiled), clean, verb.1),
                false => "-",
            };
            (*what, cells.map(told).collect())
        })
        .collect();
    let heads: Vec<&str> = verbs.iter().map(|v| v.0[0]).collect();
    println!("\n{name:34} {}", heads.join("  "));
    for (what, cells) in &rows {
        println!("{what:34} {}", cells.join("  "));
    }
    let silent = |(_, cells): &(&str, Vec<&str>)| cells.iter().filter(|c| **c == "SILENT").count();
    rows.iter().map(silent).sum()
}

#[test]
fn no_corrupted_load_cycle_gives_a_silent_wrong_number() {
    let verbs: &[Verb] = &[
        (&["inspect", "--json"], nothing_to_get_wrong),
        (&["stiffness", "--json", "--dry-run"], same_stiffness),
        (&["diagnose", "--json", "--dry-run"], same_causes),
    ];
    let files = ["axis6.csv", "axis2-tilt.csv"];
    for name in &files[..few_or_all(1, 2) as usize] {
        assert_eq!(table(name, &File::example(name), LOAD_CYCLE, verbs), 0);
    }
}

#[test]
fn no_corrupted_force_steps_give_a_silent_wrong_number() {
    let verbs: &[Verb] = &[
        (&["inspect", "--json"], nothing_to_get_wrong),
        (&["validate", "--json", "--dry-run"], same_errors),
        (&["diagnose", "--json", "--dry-run"], same_causes),
    ];
    assert_eq!(
        table(
            "workspace.csv",
            &File::example("workspace.csv"),
            WORKSPACE,
            verbs
        ),
        0
    );
}

#[test]
fn no_corrupted_hammer_test_gives_a_silent_wrong_number() {
    let verbs: &[Verb] = &[
        (&["inspect", "--json"], nothing_to_get_wrong),
        (&["damping", "--json", "--dry-run", "--frf"], never_right),
    ];
    assert_eq!(table("hammer.csv", &short_hammer(), HAMMER, verbs), 0);
}
