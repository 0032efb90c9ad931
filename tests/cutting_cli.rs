//! `ident force` and `ident lobes` as typed: account, JSON, files, exit status, refusals.

use crate::milling_bench::{Cutter, Pass, Recording, csv, record};
use ident::ground::random::Random;
use ident::measurement::job::Material;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn ident(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ident"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap()
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

const TRUTH: [f64; 6] = [1319.41, 788.83, 48.75, 19.65, 26.77, 2.05];

/// Feed (mm/min), depth, width (mm) and side of a cut.
type Cut = (f64, f64, f64, &'static str);

/// A campaign of four cuts; where its file is.
fn campaign(folder: &Path) -> PathBuf {
    let cuts = [
        (1200.0, 1.5, 16.0, "slot"),
        (2400.0, 1.5, 16.0, "slot"),
        (2400.0, 3.0, 5.0, "down"),
        (2400.0, 3.0, 8.0, "up"),
    ];
    campaign_of(folder, 3, &cuts)
}

/// A campaign of some cuts by so many teeth.
fn campaign_of(folder: &Path, teeth: usize, cuts: &[Cut]) -> PathBuf {
    let cutter = Cutter {
        radius: 8e-3,
        teeth,
        helix: 0.5235987755982988,
        runout: 8e-6,
        runout_angle: 0.6,
        chip: 0.0,
    };
    let pass = |&(feed, depth, width, side): &Cut| Pass {
        rpm: 8000.0,
        feed,
        depth,
        width,
        side,
    };
    let passes: Vec<Pass> = cuts.iter().map(pass).collect();
    let recording = Recording {
        rate_hz: 20_000.0,
        turns: 6.0,
        bandwidth_hz: Some(1500.0),
        noise: 4.0,
        colour: 0.0,
        clipped: true,
        ring: None,
    };
    let rows = record(&cutter, &passes, &TRUTH, &recording, &mut Random::new(7));
    let path = folder.join("measurements/al/cuts.csv");
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(&path, csv(&cutter, &passes, &recording, &rows)).unwrap();
    path
}

#[test]
fn force_writes_a_material_that_a_job_loads_and_a_dry_run_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    campaign(folder.path());
    let file = "measurements/al/cuts.csv";
    let dry = ident(folder.path(), &["force", file, "--json", "--dry-run"]);
    assert_eq!(dry.status.code(), Some(0));
    assert!(json(&dry)["material"].is_null() && !folder.path().join("fits").exists());
    let output = ident(folder.path(), &["force", file, "--json"]);
    let document = json(&output);
    assert_eq!(document["schema"], "ident/1");
    for (parameter, truth) in document["parameters"].as_array().unwrap().iter().zip(TRUTH) {
        let stderr = parameter["stderr"].as_f64().unwrap();
        let value = parameter["value"].as_f64().unwrap();
        assert!((value - truth).abs() < 4.0 * stderr, "{parameter}");
    }
    let path = folder.path().join(document["material"].as_str().unwrap());
    let material = Material::of_bytes(&std::fs::read(path).unwrap()).unwrap();
    assert!(
        (material.coefficients[0] / 1319.41e6 - 1.0).abs() < 0.02 && material.ci95[5].is_some()
    );
    assert!(folder.path().join("reports/al/force-cuts.html").exists());
    let again = ident(folder.path(), &["force", file, "--json"]);
    assert_eq!(output.stdout, again.stdout);
}

#[test]
fn files_that_are_wrong_are_refused_with_their_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = campaign(folder.path());
    let text = std::fs::read_to_string(&path).unwrap();
    for (from, to, line) in [
        ("teeth = 3", "teth = 3", 4),
        ("depth_mm = 1.5", "depth_mm = -1.5", 6),
        ("cut = \"slot\"", "cut = \"round\"", 6),
        ("diameter_mm = ", "diameter_mm = 1e30 # ", 3),
        ("depth_mm = 1.5", "depth_mm = 1e6", 6),
    ] {
        std::fs::write(&path, text.replacen(from, to, 1)).unwrap();
        let output = ident(folder.path(), &["force", "measurements/al/cuts.csv"]);
        let said = String::from_utf8_lossy(&output.stderr).to_string();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(
            said.contains(&format!("cuts.csv:{line}:")) && said.contains("help:"),
            "{said}"
        );
    }
    assert!(!folder.path().join("fits").exists());
}

const MODAL: &str = r#"kind = "modal"
[[modes]]
direction = [1, 0, 0]
frequency_Hz = 922.0
damping_ratio = 0.011
stiffness_N_m = 1340049.648
[tool]
diameter_mm = 10.0
teeth = 2
[material]
Ktc_N_mm2 = 600
Krc_N_mm2 = 200
Kac_N_mm2 = 0
Kte_N_mm = 0
Kre_N_mm = 0
Kae_N_mm = 0
[cut]
cut = "slot"
"#;

#[test]
fn lobes_of_a_modal_file_are_those_of_the_benchmark() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("m.toml"), MODAL).unwrap();
    let at = ident(
        folder.path(),
        &["lobes", "m.toml", "--at", "5000,0.5", "--json"],
    );
    let radius = json(&at)["spectral_radius"].as_f64().unwrap();
    assert!((radius - 1.073976).abs() < 1e-4, "{radius}");
    let arguments = [
        "lobes",
        "m.toml",
        "--rpm",
        "6000:9000:3000",
        "--depth-mm",
        "2",
        "--json",
    ];
    let lobes = json(&ident(folder.path(), &arguments));
    let limit = lobes["limit_depth_mm"][0].as_f64().unwrap();
    assert!((limit / 0.35322 - 1.0).abs() < 0.01, "{limit}");
    assert!(lobes["limit_depth_mm"][1].is_null() && lobes["chatter_Hz"][1].is_null());
}

/// Two modes, a slot, four straight teeth: nothing of the cut changes over a turn, and the chatter has one line. Frequencies by a
/// zero-order solution (Altintas, Budak 1995) that somebody else wrote, who simulated two of them in time as well.
#[test]
fn chatter_is_told_at_the_frequency_that_sounds() {
    let folder = tempfile::tempdir().unwrap();
    let text = r#"kind = "modal"
[[modes]]
direction = [1, 0, 0]
frequency_Hz = 600.0
damping_ratio = 0.03
stiffness_N_m = 5.6e6
[[modes]]
direction = [0, 1, 0]
frequency_Hz = 660.0
damping_ratio = 0.035
stiffness_N_m = 5.7e6
[tool]
diameter_mm = 19.05
teeth = 4
helix_deg = 0.0
flute_mm = 40.0
spindle_rpm = 6000.0
[material]
Ktc_N_mm2 = 600.0
Krc_N_mm2 = 42.0
Kac_N_mm2 = 0.0
Kte_N_mm = 0.0
Kre_N_mm = 0.0
Kae_N_mm = 0.0
[cut]
width_mm = 19.05
cut = "slot"
"#;
    std::fs::write(folder.path().join("m.toml"), text).unwrap();
    let arguments = ["lobes", "m.toml", "--rpm", "4000:12000:1000", "--json"];
    let found = json(&ident(folder.path(), &arguments));
    for (speed, hz) in [(0, 645.0), (1, 593.0), (6, 579.5), (7, 590.0), (8, 597.0)] {
        let told = found["chatter_Hz"][speed].as_f64().unwrap();
        assert!((told - hz).abs() < 2.0, "{speed}: {told} Hz");
    }
}

#[test]
fn a_modal_file_that_is_wrong_is_refused_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.toml");
    for (from, to, line) in [
        ("damping_ratio = 0.011", "damping = 0.011", 5),
        ("direction = [1, 0, 0]", "direction = [0, 0, 0]", 3),
        ("cut = \"slot\"", "cut = \"down\"", 17),
        ("diameter_mm = ", "diameter_mm = 1e30 # ", 8),
    ] {
        std::fs::write(&path, MODAL.replacen(from, to, 1)).unwrap();
        let output = ident(folder.path(), &["lobes", "m.toml", "--at", "5000,0.5"]);
        let said = String::from_utf8_lossy(&output.stderr).to_string();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(&format!("m.toml:{line}:")), "{said}");
    }
}

#[test]
fn a_modal_file_states_its_own_cut() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.toml");
    std::fs::write(&path, MODAL).unwrap();
    let along = ident(folder.path(), &["lobes", "m.toml", "--along"]);
    assert!(String::from_utf8_lossy(&along.stderr).contains("leave --along out"));
    for option in [["--cut", "up"], ["--width-mm", "5"]] {
        let all = [&["lobes", "m.toml", "--at", "5000,0.5"], &option[..]].concat();
        let output = ident(folder.path(), &all);
        let said = String::from_utf8_lossy(&output.stderr).to_string();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("states its own cut"), "{said}");
    }
    let undamped = MODAL.replacen("damping_ratio = 0.011", "damping_ratio = 0.0", 1);
    std::fs::write(&path, undamped).unwrap();
    let arguments = [
        "lobes",
        "m.toml",
        "--rpm",
        "6000:6000:1",
        "--json",
        "--dry-run",
    ];
    let found = json(&ident(folder.path(), &arguments));
    assert_eq!(found["limit_depth_mm"][0].as_f64(), Some(0.0), "{found}");
}

/// The record of another cut fits none: its numbers are those of nothing, and no job loads them.
#[test]
fn channels_that_are_exchanged_give_no_coefficients() {
    let folder = tempfile::tempdir().unwrap();
    let path = campaign(folder.path());
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replacen("fy_N,fz_N", "fz_N,fy_N", 1)).unwrap();
    let output = ident(folder.path(), &["force", path.to_str().unwrap(), "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let found = json(&output);
    let parameters = found["parameters"].as_array().unwrap();
    assert!(parameters.iter().all(|p| p["value"].is_null()), "{found}");
    assert!(found["material"].is_null() && !folder.path().join("fits").exists());
    assert!(found["remarks"].to_string().contains("with every turn"));
}

/// The chip of a tooth is the feed over the speed: where the teeth pass at another one than the file states, coefficients would be wrong by as much.
#[test]
fn a_spindle_at_another_speed_gives_no_coefficients() {
    let folder = tempfile::tempdir().unwrap();
    let path = campaign(folder.path());
    let text = std::fs::read_to_string(&path).unwrap();
    let stated = text.replace("spindle_rpm = 8000", "spindle_rpm = 8240");
    assert_ne!(text, stated);
    std::fs::write(&path, stated).unwrap();
    let output = ident(folder.path(), &["force", path.to_str().unwrap(), "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let found = json(&output);
    let parameters = found["parameters"].as_array().unwrap();
    assert!(parameters.iter().all(|p| p["value"].is_null()), "{found}");
    let remarks = found["remarks"].to_string();
    assert!(
        remarks.contains("rpm, and the file states 8240"),
        "{remarks}"
    );
}

/// Four teeth in a deep slot push evenly along the axis, and a shallow slot hardly at all: neither says that the channel is no force.
#[test]
fn an_even_force_beside_a_weak_one_is_not_refused() {
    let folder = tempfile::tempdir().unwrap();
    let cuts = [
        (3200.0, 6.0, 16.0, "slot"),
        (4800.0, 6.0, 16.0, "slot"),
        (3200.0, 0.3, 16.0, "slot"),
    ];
    let path = campaign_of(folder.path(), 4, &cuts);
    let output = ident(folder.path(), &["force", path.to_str().unwrap(), "--json"]);
    assert_ne!(
        output.status.code(),
        Some(2),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}
