//! Twelve exports as other programs write them go from the raw file to a stiffness, a frequency response or
//! cutting forces with at most two commands each. The binary ones were written by openpyxl, numpy, scipy,
//! nptdms and pyuff (`tests/data/foreign/make.py`), the texts by the writers below.

use crate::bench_of_files::Bench;
use crate::milling_bench::{Cutter, Pass, Recording, csv, record};
use ident::ground::random::Random;
use serde_json::Value;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

/// A load cycle of a spring of 2 N/µm: time s, force N, displacement µm.
fn cycle() -> Vec<[f64; 3]> {
    let row = |i: usize| {
        let wave = (i as f64 * 0.05).sin();
        [
            i as f64 * 0.1,
            1000.0 * wave,
            500.0 * wave + 0.2 * ((i * 7919) % 13) as f64,
        ]
    };
    (0..400).map(row).collect()
}

fn lines(delimiter: &str, comma: bool, row: impl Fn(usize, &[f64; 3]) -> Vec<String>) -> String {
    let cells = |(i, r): (usize, &[f64; 3])| row(i, r).join(delimiter) + "\r\n";
    let text: String = cycle().iter().enumerate().map(cells).collect();
    match comma {
        true => text.replace('.', ","),
        false => text,
    }
}

fn plain(_: usize, row: &[f64; 3]) -> Vec<String> {
    row.iter().map(|x| format!("{x:.4}")).collect()
}

/// A spreadsheet of a German computer, Windows-1252.
fn german() -> Vec<u8> {
    let text = format!(
        "Prüfstand 3\r\nDatum;22.11.2026\r\n\r\nZeit [s];Kraft [N];Weg [µm]\r\n{}",
        lines(";", true, plain)
    );
    text.chars().map(|c| c as u8).collect()
}

/// "Unicode text" of the same program: UTF-16 with its mark, tabs.
fn utf16() -> Vec<u8> {
    let text = format!(
        "Zeit in s\tKraft in N\tWeg in µm\r\n{}",
        lines("\t", true, plain)
    );
    let mark = std::iter::once(0xFEFF);
    mark.chain(text.encode_utf16())
        .flat_map(u16::to_le_bytes)
        .collect()
}

/// A measurement file of LabVIEW as text.
fn labview() -> Vec<u8> {
    let head = "LabVIEW Measurement\t\r\nWriter_Version\t2\r\nReader_Version\t2\r\nSeparator\tTab\r\nDecimal_Separator\t.\r\nMulti_Headings\tNo\r\nX_Columns\tOne\r\nDate\t2026/11/22\r\n***End_of_Header***\t\r\n\t\r\nChannels\t2\t\r\nSamples\t400\t400\t\r\n***End_of_Header***\t\t\r\n";
    format!(
        "{head}X_Value\tForce (N)\tDisplacement (um)\r\n{}",
        lines("\t", false, plain)
    )
    .into_bytes()
}

/// A logger that stamps every row with date and time, and writes words at its end.
fn stamped() -> Vec<u8> {
    let row = |_: usize, r: &[f64; 3]| {
        let (minutes, seconds) = ((r[0] / 60.0).floor(), r[0] % 60.0);
        let stamp = format!("2026-11-22 13:{minutes:02.0}:{seconds:06.3}");
        vec![
            stamp,
            format!("{:.4}", r[1]),
            format!("{:.4}", r[2]),
            "ok".into(),
        ]
    };
    format!(
        "Timestamp,Force [N],Displacement [um],Status\r\n{}",
        lines(",", false, row)
    )
    .into_bytes()
}

/// A program that quotes everything and puts units into a row of their own.
fn quoted() -> Vec<u8> {
    let row = |i: usize, r: &[f64; 3]| plain(i, r).iter().map(|c| format!("\"{c}\"")).collect();
    format!(
        "\"Time\";\"Force\";\"Displacement\"\r\n\"s\";\"N\";\"um\"\r\n{}",
        lines(";", true, row)
    )
    .into_bytes()
}

const TRUTH: [f64; 6] = [951.365, 262.597, 323.33, 11.115, 11.314, 1.105];

/// A slot under a dynamometer, as its program exports it.
fn dynamometer() -> Vec<u8> {
    let cutter = Cutter {
        radius: 8e-3,
        teeth: 2,
        helix: 30.0 * PI / 180.0,
        runout: 5e-6,
        runout_angle: 0.7,
        chip: 0.0,
    };
    let pass = Pass {
        rpm: 6000.0,
        feed: 2400.0,
        depth: 1.5,
        width: 16.0,
        side: "slot",
    };
    let recording = Recording {
        rate_hz: 20_000.0,
        turns: 8.0,
        bandwidth_hz: None,
        noise: 1.0,
        colour: 0.0,
        clipped: true,
        ring: None,
    };
    let rows = record(&cutter, &[pass], &TRUTH, &recording, &mut Random::new(12));
    let mut text = "File Type\tDynoWare\r\nDevice\t5073A\r\nSampling Rate [Hz]\t20000\r\nMeasuring Time [s]\t0.08\r\n\r\nTime\tFx\tFy\tFz\r\ns\tN\tN\tN\r\n".to_string();
    for [_, t, x, y, z] in rows {
        let _ = write!(text, "{t:.6}\t{x:.3}\t{y:.3}\t{z:.3}\r\n");
    }
    text.into_bytes()
}

const RATE_HZ: f64 = 2048.0;

/// Three hits on 5 kg with one mode (10 Hz, 2 %), stepped in time, as time records of a universal file.
fn hits() -> Vec<u8> {
    let mut text = String::new();
    for hit in 0..3 {
        let (force, response) = one_hit(80.0 + 15.0 * f64::from(hit));
        text += &time_record(hit + 1, (13, "N"), &force);
        text += &time_record(hit + 1, (12, "m/s^2"), &response);
    }
    text.into_bytes()
}

fn one_hit(newtons: f64) -> (Vec<f64>, Vec<f64>) {
    let (w, zeta, mass) = (TAU * 10.0, 0.02, 5.0);
    let pulse = |t: f64| match (0.05..0.055).contains(&t) {
        true => newtons * (PI * (t - 0.05) / 0.005).sin(),
        false => 0.0,
    };
    let (mut x, mut v, fine) = (0.0, 0.0, 40);
    let h = 1.0 / RATE_HZ / f64::from(fine);
    let (mut force, mut response) = (Vec::new(), Vec::new());
    for k in 0..16384 {
        for i in 0..fine {
            let t = f64::from(k) / RATE_HZ + f64::from(i) * h;
            let a = pulse(t) / mass - 2.0 * zeta * w * v - w * w * x;
            if i == 0 {
                force.push(pulse(t));
                response.push(a);
            }
            v += h * a;
            x += h * v;
        }
    }
    (force, response)
}

fn time_record(case: i32, (code, unit): (i32, &str), values: &[f64]) -> String {
    let mut text =
        "    -1\n    58\nHammer test\nNONE\n22-Nov-26 13:00:00\nNONE\nNONE\n".to_string();
    let _ = writeln!(
        text,
        "{:>5}{:>10}{:>5}{case:>10} {:<10}{:>10}{:>4} {:<10}{:>10}{:>4}",
        1, 1, 0, "NONE", 1, 1, "NONE", 1, 1
    );
    let _ = writeln!(
        text,
        "{:>10}{:>10}{:>10}{:>13.5E}{:>13.5E}{:>13.5E}",
        2,
        values.len(),
        1,
        0.0,
        1.0 / RATE_HZ,
        0.0
    );
    for (code, unit) in [(17, "s"), (code, unit), (0, "NONE"), (0, "NONE")] {
        let _ = writeln!(
            text,
            "{code:>10}{:>5}{:>5}{:>5} {:<20} {unit:<20}",
            0, 0, 0, "NONE"
        );
    }
    for row in values.chunks(6) {
        let cells: Vec<String> = row.iter().map(|v| format!("{v:>13.5E}")).collect();
        text += &format!("{}\n", cells.concat());
    }
    text + "    -1\n"
}

/// What the last command must tell.
#[derive(Clone, Copy)]
enum Tells {
    /// 2 N/µm.
    Stiffness,
    /// 10 Hz, 2 %.
    Mode,
    /// The tangential and radial coefficients of [`TRUTH`].
    Forces,
}

/// Name, bytes, commands, what they tell.
type Export = (&'static str, Vec<u8>, Vec<Vec<&'static str>>, Tells);

fn made(name: &str) -> Vec<u8> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/foreign");
    std::fs::read(folder.join(name)).unwrap()
}

/// A load cycle is named as one, then fitted.
fn spring(name: &'static str, bytes: Vec<u8>) -> Export {
    let commands = vec![
        vec!["import", name, "--kind", "load-cycle"],
        vec!["stiffness", name, "--json", "--dry-run"],
    ];
    (name, bytes, commands, Tells::Stiffness)
}

fn exports() -> Vec<Export> {
    let cut = "cuts=[{ spindle_rpm = 6000.0, feed_mm_min = 2400.0, depth_mm = 1.5, width_mm = 16.0, cut = \"slot\" }]";
    let facts = vec![
        "import",
        "dyno.txt",
        "--kind",
        "milling-force",
        "--fact",
        "diameter_mm=16",
        "--fact",
        "teeth=2",
        "--fact",
        "helix_deg=30",
        "--fact",
        cut,
    ];
    vec![
        spring("german.csv", german()),
        spring("unicode.txt", utf16()),
        spring("labview.lvm", labview()),
        spring("stamped.csv", stamped()),
        spring("quoted.csv", quoted()),
        spring("cycle.xlsx", made("cycle.xlsx")),
        spring("wave.tdms", made("wave.tdms")),
        spring("vectors.mat", made("vectors.mat")),
        spring("named.npy", made("named.npy")),
        (
            "dyno.txt",
            dynamometer(),
            vec![facts, vec!["force", "dyno.txt", "--json", "--dry-run"]],
            Tells::Forces,
        ),
        (
            "frf_type4.uff",
            made("frf_type4.uff"),
            vec![vec!["frf", "frf_type4.uff", "--modes", "--json"]],
            Tells::Mode,
        ),
        (
            "hits.unv",
            hits(),
            vec![vec!["frf", "hits.unv", "--modes", "--json"]],
            Tells::Mode,
        ),
    ]
}

fn near(name: &str, value: &Value, truth: f64, share: f64) {
    let value = value.as_f64().unwrap_or_else(|| panic!("{name}: {value}"));
    println!("{name}: {value} for {truth}");
    assert!(
        (value / truth - 1.0).abs() < share,
        "{name}: {value} for {truth}"
    );
}

#[test]
fn twelve_exports_need_at_most_two_commands_each() {
    let all = exports();
    assert_eq!(all.len(), 12);
    for (name, bytes, commands, tells) in all {
        assert!(commands.len() <= 2);
        let bench = Bench::new();
        bench.put(name, &bytes);
        let mut last = None;
        for words in &commands {
            let ran = bench.run(words);
            assert!(ran.status < 2, "{name}: {}{}", ran.out, ran.errors);
            last = Some(ran);
        }
        assert_eq!(
            bench.bytes(name),
            bytes,
            "{name}: the raw file stays as it is"
        );
        let answer: Value = serde_json::from_str(&last.unwrap().out).unwrap();
        match tells {
            Tells::Stiffness => near(
                name,
                &answer["results"][0]["parameters"][0]["value"],
                2.0e6,
                0.01,
            ),
            Tells::Mode => {
                let modes = answer["modes"].as_array().unwrap();
                let off = |m: &Value| (m["frequency_Hz"].as_f64().unwrap() - 10.0).abs();
                let nearest = modes.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
                let nearest = nearest.unwrap();
                near(name, &nearest["frequency_Hz"], 10.0, 2e-3);
                near(name, &nearest["damping_ratio"], 0.02, 0.05);
            }
            Tells::Forces => {
                let found = answer["parameters"].as_array().unwrap();
                let value = |key: &str| &found.iter().find(|p| p["name"] == key).unwrap()["value"];
                near(name, value("Ktc"), TRUTH[0], 0.1);
                near(name, value("Krc"), TRUTH[1], 0.15);
            }
        }
    }
}

/// The cuts of the guide are what this generator makes of [`TRUTH`] (`IDENT_WRITE_EXAMPLE=1` writes them anew).
#[test]
fn the_cuts_of_the_guide_are_what_their_truth_makes() {
    let cutter = Cutter {
        radius: 8e-3,
        teeth: 2,
        helix: 30.0 * PI / 180.0,
        runout: 5e-6,
        runout_angle: 0.7,
        chip: 0.0,
    };
    let pass = |feed: f64, depth: f64, width: f64, side: &'static str| Pass {
        rpm: 6000.0,
        feed,
        depth,
        width,
        side,
    };
    let passes = [
        pass(1440.0, 1.5, 16.0, "slot"),
        pass(2880.0, 1.5, 16.0, "slot"),
        pass(2400.0, 2.0, 5.0, "down"),
        pass(3600.0, 2.0, 8.0, "up"),
    ];
    let recording = Recording {
        rate_hz: 5000.0,
        turns: 3.0,
        bandwidth_hz: None,
        noise: 2.0,
        colour: 0.0,
        clipped: true,
        ring: None,
    };
    let rows = record(&cutter, &passes, &TRUTH, &recording, &mut Random::new(5));
    let text = csv(&cutter, &passes, &recording, &rows);
    let path =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/dynamometer/cuts.csv");
    if std::env::var_os("IDENT_WRITE_EXAMPLE").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, &text).unwrap();
    }
    assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
}
