//! `ident frf` as typed: account, JSON, universal file, exit status.

use crate::common::{Blow, accelerance, axis, csv, record, robot};
use ident::measurement::uff;
use rustfft::num_complex::Complex64;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn ident(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ident"))
        .args(arguments)
        .output()
        .unwrap()
}

/// Three directions of five hits, one of them double, one overloaded.
fn campaign(folder: &Path) -> PathBuf {
    let mut blows = Vec::new();
    for direction in ["x", "y", "z"] {
        let blow = Blow {
            axis: axis(direction),
            ..Blow::default()
        };
        blows.extend((0..5).map(|i| {
            (
                direction,
                Blow {
                    peak_n: 300.0 + 40.0 * f64::from(i),
                    ..blow
                },
            )
        }));
    }
    blows[3].1.second = Some((0.04, 0.2));
    blows[8].1.clip_force = Some(0.7);
    let path = folder.join("hammer.csv");
    std::fs::write(&path, csv(&record(&robot(), &blows, 8))).unwrap();
    path
}

#[test]
fn json_holds_hits_channels_and_the_true_frf() {
    let folder = tempfile::tempdir().unwrap();
    let file = campaign(folder.path());
    let out = folder.path().join("frf.uff");
    let output = ident(&[
        "frf",
        file.to_str().unwrap(),
        "--json",
        "--modes",
        "--to-Hz",
        "60",
        "--uff",
        out.to_str().unwrap(),
    ]);
    assert_eq!(output.status.code(), Some(1), "two hits were left out");
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(
        (json["schema"].as_str(), json["verb"].as_str()),
        (Some("ident/1"), Some("frf"))
    );
    let bad: Vec<&Value> = json["hits"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|h| h["used"] == false)
        .collect();
    assert_eq!(bad.len(), 2);
    assert!(bad[0]["why"].as_str().unwrap().contains("double hit"));
    assert!(bad[1]["why"].as_str().unwrap().contains("overload"));
    let channels = json["channels"].as_array().unwrap();
    assert_eq!(channels.len(), 9);
    let zy = channels
        .iter()
        .find(|c| c["input"] == "y" && c["output"] == "z")
        .unwrap();
    assert!(zy["h1"][0][0].is_null());
    for k in 12..200 {
        let s = Complex64::new(
            0.0,
            std::f64::consts::TAU * zy["frequency_Hz"][k].as_f64().unwrap(),
        );
        let truth = accelerance(&robot(), 2, 1, s);
        let h = Complex64::new(
            zy["h1"][k][0].as_f64().unwrap(),
            zy["h1"][k][1].as_f64().unwrap(),
        );
        assert!(
            (h - truth).norm() < 0.02 * truth.norm() + 2e-4,
            "{s}: {h} is not {truth}"
        );
    }
    assert_eq!(json["modes"].as_array().unwrap().len(), 6);
    let written = uff::read(&out).unwrap();
    assert_eq!(written.functions.len(), 18);
}

#[test]
fn the_account_names_every_hit_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let file = campaign(folder.path());
    let text = String::from_utf8(ident(&["frf", file.to_str().unwrap()]).stdout).unwrap();
    assert_eq!(
        text.lines()
            .filter(|line| line.contains("left out:"))
            .count(),
        2,
        "{text}"
    );
}

#[test]
fn a_file_without_force_is_refused_with_the_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.csv");
    std::fs::write(&file, "direction,hit,time_s,az_m_s2\nz,1,0,0\n").unwrap();
    let output = ident(&["frf", file.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("add the column `force_N`"));
}
