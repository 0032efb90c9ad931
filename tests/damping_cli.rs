//! `ident damping` as typed, on the example campaign: the FRF is met, the truth lies in the
//! intervals, the contract is kept, bad inputs are refused with their place and remedy.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

const SITES: [&str; 12] = [
    "A1-tilt", "A1", "A2-tilt", "A2", "A3-tilt", "A3", "A4-tilt", "A4", "A5-tilt", "A5", "A6-tilt",
    "A6",
];

fn example(name: &str) -> String {
    format!("{}/measurements/kr210/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn ident(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ident"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap()
}

/// A workspace with both hammer tests of the example.
fn workspace() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let campaign = folder.path().join("measurements/kr210");
    std::fs::create_dir_all(&campaign).unwrap();
    for name in ["hammer.csv", "hammer-backlash.csv", "axis6.csv"] {
        std::fs::copy(example(name), campaign.join(name)).unwrap();
    }
    folder
}

fn json(folder: &Path, arguments: &[&str], status: i32) -> Value {
    let output = ident(folder, arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{said}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn truth() -> toml::Table {
    let text = std::fs::read_to_string(example("truth.toml")).unwrap();
    let truth: toml::Table = text.parse().unwrap();
    truth["hammer"]["damping_Nms_rad"]
        .as_table()
        .unwrap()
        .clone()
}

fn damping(site: &str) -> f64 {
    truth()[site].as_float().unwrap()
}

#[test]
fn the_example_is_met_and_the_truth_lies_in_the_intervals() {
    let folder = workspace();
    let found = json(folder.path(), &["damping", "--frf", "--json"], 1);
    for (pair, after) in found["match"].as_object().unwrap() {
        let (frac, db) = (&after["frac"], &after["log_error_dB"]);
        let (frac, db) = (frac.as_f64().unwrap(), db.as_f64().unwrap());
        assert!(frac > 0.99 && db < 0.5, "{pair}: FRAC {frac}, {db} dB");
        assert!(found["match_before"][pair]["frac"].as_f64().unwrap() < frac);
    }
    assert_eq!(found["match"].as_object().unwrap().len(), 9);
    let mut inside = 0;
    for parameter in found["parameters"].as_array().unwrap() {
        let site = parameter["site"].as_str().unwrap();
        let ends = [0, 1].map(|i| parameter["ci95"][i].as_f64().unwrap());
        inside += usize::from((ends[0]..=ends[1]).contains(&damping(site)));
    }
    println!("{inside} of 12 dampings inside their 95 % intervals");
    assert!(inside >= 11);
}

#[test]
fn the_document_keeps_the_contract() {
    let folder = workspace();
    let found = json(
        folder.path(),
        &["damping", "--frf", "--json", "--dry-run"],
        1,
    );
    assert_eq!(
        (&found["schema"], &found["verb"]),
        (&"ident/1".into(), &"damping".into())
    );
    let inputs = found["inputs"].as_array().unwrap();
    assert_eq!(inputs.len(), 2, "the comparison test is not taken unasked");
    assert!(
        inputs
            .iter()
            .all(|i| i["sha256"].as_str().unwrap().len() == 64)
    );
    let frf = &found["frf"];
    assert_eq!(frf["estimator"], "H1");
    assert!((frf["resolution_Hz"].as_f64().unwrap() - 1.0 / 3.0).abs() < 1e-9);
    assert_eq!(frf["hits_used"], 13);
    let rejected = frf["hits_rejected"].as_array().unwrap();
    let named = |i: usize| (rejected[i]["direction"].clone(), rejected[i]["hit"].clone());
    assert_eq!(
        [named(0), named(1)],
        [("x".into(), 4.into()), ("y".into(), 2.into())]
    );
    assert!(rejected[0]["why"].as_str().unwrap().contains("double hit"));
    assert!(rejected[1]["why"].as_str().unwrap().contains("overload"));
    for mode in found["modes"].as_array().unwrap() {
        assert!(mode["frequency_Hz"].as_f64().unwrap() < 55.0);
        assert!(mode["damping_ratio"].as_f64().unwrap() > 0.0);
    }
    let sites: Vec<&str> = found["parameters"]
        .as_array()
        .unwrap()
        .iter()
        .map(|p| p["site"].as_str().unwrap())
        .collect();
    assert_eq!(sites, SITES);
    for parameter in found["parameters"].as_array().unwrap() {
        assert_eq!(
            (&parameter["name"], &parameter["unit"]),
            (&"damping".into(), &"N·m·s/rad".into())
        );
        let known = parameter["status"] == "identified";
        assert_eq!(parameter["value"].is_number(), known);
        assert_eq!(parameter["ci95"].is_array(), known);
    }
    assert!(
        !folder.path().join("fits").exists(),
        "a dry run writes nothing"
    );
}

#[test]
fn what_the_data_do_not_fix_has_no_value_but_its_combinations() {
    let folder = workspace();
    let only_z = folder.path().join("z.csv");
    let text = std::fs::read_to_string(example("hammer.csv")).unwrap();
    let wanted = |l: &&str| !(l.starts_with("x,") || l.starts_with("y,"));
    let text: Vec<&str> = text.lines().filter(wanted).collect();
    std::fs::write(&only_z, text.join("\n") + "\n").unwrap();
    let found = json(
        folder.path(),
        &[
            "damping",
            "--frf",
            "z.csv",
            "--json",
            "--dry-run",
            "--release-stiffness",
        ],
        0,
    );
    let parameters = found["parameters"].as_array().unwrap();
    let open: Vec<&Value> = parameters
        .iter()
        .filter(|p| p["status"] != "identified")
        .collect();
    assert!(!open.is_empty(), "one direction cannot fix 24 constants");
    assert!(
        open.iter()
            .all(|p| p["value"].is_null() && p["ci95"].is_null())
    );
    let fixed = found["fixed_combinations"].as_array().unwrap();
    assert!(!fixed.is_empty() && fixed.len() < parameters.len());
    assert_eq!(
        found["priors"].as_array().unwrap().len(),
        12,
        "the released stiffnesses"
    );
}

#[test]
fn fits_report_and_robot_are_written_and_repeat_byte_for_byte() {
    let made = || {
        let folder = workspace();
        let output = ident(folder.path(), &["damping", "--frf"]);
        assert_eq!(output.status.code(), Some(1));
        let read = |path: &str| std::fs::read(folder.path().join(path)).unwrap();
        let files = [
            "fits/kr210/damping.toml",
            "fits/kr210/robot.toml",
            "reports/kr210/damping.html",
            "reports/kr210/damping-xx.svg",
            "reports/kr210/damping-zy.svg",
            "reports/kr210/damping-hits-yy.svg",
            "reports/kr210/damping-stabilisation.svg",
        ];
        (output.stdout, files.map(read))
    };
    let (text, files) = made();
    assert_eq!((text.clone(), files.clone()), made());
    let text = String::from_utf8(text).unwrap();
    assert!(
        text.contains("synthetic") && text.contains("hit x 4 left out"),
        "{text}"
    );
    let robot = ident::robot::load::read(&files[1]).unwrap();
    for (site, spring) in robot.springs() {
        assert!(
            (spring.damping / damping(&site) - 1.0).abs() < 0.2,
            "{site}"
        );
        assert!(
            spring
                .source
                .as_deref()
                .unwrap()
                .contains("identified from hammer.csv")
        );
        assert!(spring.ci95.damping.is_some());
    }
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn play_is_seen_as_an_frf_that_damping_alone_does_not_meet() {
    let folder = workspace();
    let file = "measurements/kr210/hammer-backlash.csv";
    let found = json(
        folder.path(),
        &["damping", "--frf", file, "--json", "--dry-run"],
        1,
    );
    assert!(found["fit"]["reduced_chi_square"].as_f64().unwrap() > 10.0);
    let remarks = found["remarks"].to_string();
    assert!(remarks.contains("play"), "{remarks}");
}

/// The error of a run on the first rows of the example with its facts changed.
fn refused(arguments: &[&str], change: impl Fn(String) -> String) -> String {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(example("hammer.csv")).unwrap();
    std::fs::write(folder.path().join("a.csv"), change(text)).unwrap();
    let output = ident(folder.path(), &[&["damping", "--frf"], arguments].concat());
    let said = String::from_utf8_lossy(&output.stderr).to_string();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(output.stdout.is_empty());
    said
}

#[test]
fn bad_inputs_are_refused_with_place_and_remedy() {
    let same = |text: String| text;
    let without = |key: &'static str| {
        move |text: String| {
            let lines: Vec<&str> = text.lines().filter(|l| !l.contains(key)).collect();
            lines.join("\n") + "\n"
        }
    };
    let cases = [
        (
            refused(&["a.csv"], without("joint_angles_deg")),
            ["a.csv", "write `# joint_angles_deg"],
        ),
        (
            refused(&["a.csv"], without("robot =")),
            ["a.csv", "--robot"],
        ),
        (
            refused(&["a.csv"], |t| {
                t.replace("joint_angles_deg = [20.0, ", "joint_angles_deg = [")
            }),
            ["5 joint angles", "one angle per joint"],
        ),
        (
            refused(&["a.csv"], |t| {
                t.replace("joint_angles_deg = [20.0", "joint_angles_deg = [\"a\"")
            }),
            ["a.csv:5:", "write `# joint_angles_deg"],
        ),
        (
            refused(&["a.csv"], |t| t.replace("\"kr210\"", "\"none.toml\"")),
            ["none.toml", "kr210"],
        ),
        (
            refused(&["a.csv"], |t| t.replace("\"hammer\"", "\"screw\"")),
            ["a.csv:1:", "kind `hammer`"],
        ),
        (
            refused(&["a.csv"], |t| t.replace("force_N", "force_mm")),
            ["force_mm", "unit of `force_N`"],
        ),
        (
            refused(&["a.csv"], |t| {
                t.replacen("x,1,0.0100,", "x,1,0.0100,oops", 1)
            }),
            ["a.csv:", "number"],
        ),
        (
            refused(&["a.csv"], |t| {
                t.replace("# synthetic", "# role = \"spare\"\n# synthetic")
            }),
            ["`spare`", "role = \"comparison\""],
        ),
        (refused(&["b.csv"], same), ["b.csv", "check the path"]),
        (
            refused(&[], same),
            ["measurements/<campaign>", "name a measurement file"],
        ),
        (
            refused(&["a.csv", "--to-Hz", "1"], same),
            ["--to-Hz", "the band is empty"],
        ),
        (
            refused(&["a.csv", "--prior", "0.5"], same),
            ["--prior", "3"],
        ),
        (
            refused(&["a.csv", "--exponential-end", "0"], same),
            ["--exponential-end", "0.01"],
        ),
    ];
    for (said, wanted) in cases {
        assert!(
            wanted.iter().all(|part| said.contains(part)),
            "{said}\nlacks {wanted:?}"
        );
        assert!(said.contains("help:"), "{said}");
    }
}

#[test]
fn several_campaigns_need_a_choice() {
    let folder = workspace();
    std::fs::create_dir_all(folder.path().join("measurements/other")).unwrap();
    let output = ident(folder.path(), &["damping", "--frf"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("--campaign: kr210, other"));
    let arguments = [
        "damping",
        "--frf",
        "--campaign",
        "kr210",
        "--dry-run",
        "--json",
    ];
    assert_eq!(json(folder.path(), &arguments, 1)["frf"]["hits_used"], 13);
}
