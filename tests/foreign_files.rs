//! Files as laboratories export them go in as they are, with the facts that stand beside them.

use ident::measurement::load_cycle::LoadCycle;
use std::path::Path;
use std::process::Output;

/// A load cycle of a spring of 2 N/µm as rows of time s, force N, displacement µm.
fn rows() -> Vec<[f64; 3]> {
    let wave = |i: usize| (i as f64 * 0.05).sin();
    (0..400)
        .map(|i| {
            [
                i as f64 * 0.1,
                1000.0 * wave(i),
                500.0 * wave(i) + 0.2 * ((i * 7919) % 13) as f64,
            ]
        })
        .collect()
}

/// Rows with a delimiter and a decimal sign.
fn text(delimiter: &str, comma: bool) -> String {
    let cell = |x: &f64| {
        let plain = format!("{x:.4}");
        if comma {
            plain.replace('.', ",")
        } else {
            plain
        }
    };
    let line = |row: &[f64; 3]| row.iter().map(cell).collect::<Vec<_>>().join(delimiter);
    rows().iter().map(line).collect::<Vec<_>>().join("\r\n")
}

fn windows_1252(text: &str) -> Vec<u8> {
    text.chars().map(|c| c as u8).collect()
}

fn utf16(text: &str) -> Vec<u8> {
    [0xFEFF]
        .into_iter()
        .chain(text.encode_utf16())
        .flat_map(u16::to_le_bytes)
        .collect()
}

/// Ten exports: name and bytes.
fn exports() -> Vec<(&'static str, Vec<u8>)> {
    let comma = text(";", true);
    let tab = text("\t", false);
    let plain = text(",", false);
    vec![
        ("german.csv", windows_1252(&format!("Messung Achse 2\r\nDatum;3.4.2026\r\n\r\nZeit [s];Kraft [N];Weg [µm]\r\n{comma}"))),
        ("utf16.csv", utf16(&format!("Zeit in s;Kraft in N;Weg in µm\r\n{comma}"))),
        ("unit-row.csv", format!("Zeit;Kraft;Weg\r\n[s];[N];[µm]\r\n{comma}").into_bytes()),
        ("labview.csv", format!("LabVIEW Measurement\t\r\nWriter_Version\t2\r\n***End_of_Header***\t\r\nX_Value\tForce (N)\tDisplacement (um)\r\ns\tN\tum\r\n{tab}").into_bytes()),
        ("english.csv", format!("Time (s),Force (N),Displacement (µm)\r\n{plain}").into_bytes()),
        ("capitals.csv", format!("Time_s,Force_N,Displacement_um\r\n{plain}").into_bytes()),
        ("slash.csv", format!("Zeit / s;Kraft / N;Weg / µm\r\n{comma}").into_bytes()),
        ("quoted.csv", format!("\"Zeit [s]\";\"Kraft [N]\";\"Weg [µm]\"\r\n{comma}").into_bytes()),
        ("bom.csv", format!("\u{feff}Zeit [s];Kraft [N];Weg [µm]\r\n{comma}").into_bytes()),
        ("native.csv", format!("time_s,force_N,displacement_um\n{plain}").into_bytes()),
    ]
}

fn ident(folder: &Path, words: &[&str]) -> Output {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_ident"));
    command.current_dir(folder).args(words).output().unwrap()
}

#[test]
fn ten_exports_give_the_same_numbers() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("campaign.toml"),
        "kind = \"load-cycle\"\nsynthetic = true\n",
    )
    .unwrap();
    for (name, bytes) in exports() {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let file = LoadCycle::read(&path).unwrap_or_else(|p| panic!("{name}: {p}"));
        assert_eq!(file.load.len(), 400, "{name}");
        for (load, row) in file.load.iter().zip(rows()) {
            assert!(
                (load - row[1]).abs() < 1e-3,
                "{name}: {load} for {}",
                row[1]
            );
        }
    }
}

#[test]
fn a_mapping_is_kept_beside_the_file_and_used() {
    let folder = tempfile::tempdir().unwrap();
    let raw = format!("Kanal 1;Kanal 2;Kanal 3\r\n{}", text(";", true));
    std::fs::write(folder.path().join("raw.csv"), &raw).unwrap();
    let words = [
        "import",
        "raw.csv",
        "--kind",
        "load-cycle",
        "--column",
        "time_s=Kanal 1",
        "--column",
        "force_N=2",
        "--column",
        "displacement_um=Kanal 3",
    ];
    let output = ident(folder.path(), &words);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let kept = std::fs::read_to_string(folder.path().join("raw.ident.toml")).unwrap();
    assert!(
        kept.contains("time_s = \"Kanal 1\"") && kept.contains("force_N = 2"),
        "{kept}"
    );
    assert_eq!(
        std::fs::read_to_string(folder.path().join("raw.csv")).unwrap(),
        raw
    );
    assert_eq!(
        LoadCycle::read(&folder.path().join("raw.csv"))
            .unwrap()
            .load
            .len(),
        400
    );
    let answer = ident(
        folder.path(),
        &["stiffness", "raw.csv", "--json", "--dry-run"],
    );
    let json: serde_json::Value = serde_json::from_slice(&answer.stdout).unwrap();
    let stiffness = json["results"][0]["parameters"][0]["value"]
        .as_f64()
        .unwrap();
    assert!((stiffness / 2.0e6 - 1.0).abs() < 0.01, "{stiffness}");
}

#[test]
fn refusals_name_the_line_of_the_raw_file() {
    let folder = tempfile::tempdir().unwrap();
    let mut lines: Vec<String> = vec![
        "Messung".into(),
        String::new(),
        "Zeit [s];Kraft [N];Weg [µm]".into(),
    ];
    lines.extend(text(";", true).lines().map(String::from));
    lines[20] = "1,7;kaputt;2,0".into();
    std::fs::write(folder.path().join("bad.csv"), lines.join("\n")).unwrap();
    std::fs::write(
        folder.path().join("bad.ident.toml"),
        "kind = \"load-cycle\"\n",
    )
    .unwrap();
    let output = ident(folder.path(), &["stiffness", "bad.csv"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("bad.csv:21") && said.contains("kaputt"),
        "{said}"
    );
    std::fs::write(
        folder.path().join("bad.ident.toml"),
        "kind = \"load-cycle\"\n[columns]\nforce_N = \"Last\"\n",
    )
    .unwrap();
    let output = ident(folder.path(), &["stiffness", "bad.csv"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("Kraft [N]"), "{said}");
}

/// The folder of files that other programs wrote (`tests/data/foreign/make.py`).
fn made(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data/foreign")
        .join(name)
}

/// The numbers of `make.py`.
fn made_rows() -> Vec<[f64; 3]> {
    let round = |x: f64| (x * 1e4).round() * 1e-4;
    let row = |k: i32| {
        let wave = (f64::from(k) / 10.0).sin();
        let scatter = 0.2 * f64::from((k * 7919) % 13);
        [
            round(f64::from(k) / 10.0),
            round(1000.0 * wave),
            round(500.0 * wave + scatter),
        ]
    };
    (0..120).map(row).collect()
}

#[test]
fn files_of_other_programs_that_are_no_text_give_the_same_numbers() {
    let mapped = [
        "--column",
        "time_s=1",
        "--column",
        "force_N=2",
        "--column",
        "displacement_um=3",
    ];
    let files: [(&str, &[&str]); 8] = [
        ("cycle.xlsx", &[]),
        ("named.npy", &[]),
        ("plain.npy", &mapped),
        ("fortran.npy", &mapped),
        ("vectors.mat", &[]),
        ("structure.mat", &[]),
        ("wave.tdms", &[]),
        ("time.tdms", &[]),
    ];
    for (name, more) in files {
        let folder = tempfile::tempdir().unwrap();
        std::fs::copy(made(name), folder.path().join(name)).unwrap();
        let words = [&["import", name, "--kind", "load-cycle"][..], more].concat();
        let output = ident(folder.path(), &words);
        let errors = String::from_utf8_lossy(&output.stderr).to_string();
        assert_eq!(output.status.code(), Some(0), "{name}: {errors}");
        let file =
            LoadCycle::read(&folder.path().join(name)).unwrap_or_else(|p| panic!("{name}: {p}"));
        assert_eq!(file.load.len(), 120, "{name}");
        let all = file.load.iter().zip(&file.deflection).zip(&file.time);
        for (((load, way), time), row) in all.zip(made_rows()) {
            assert!(
                (load - row[1]).abs() < 1e-4,
                "{name}: {load} for {}",
                row[1]
            );
            assert!(
                (way - 1e-6 * row[2]).abs() < 1e-10,
                "{name}: {way} for {}",
                row[2]
            );
            assert!(
                (time - row[0]).abs() < 1.1e-6, // stamps of some writers end at the microsecond
                "{name}: {time} for {}",
                row[0]
            );
        }
        let fitted = ident(folder.path(), &["stiffness", name, "--json", "--dry-run"]);
        let json: serde_json::Value = serde_json::from_slice(&fitted.stdout).unwrap();
        let stiffness = json["results"][0]["parameters"][0]["value"]
            .as_f64()
            .unwrap();
        assert!(
            (stiffness / 2.0e6 - 1.0).abs() < 0.01,
            "{name}: {stiffness}"
        );
    }
}

#[test]
fn what_cannot_be_read_says_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [("v73.mat", "-v7"), ("plain.npy", "--column time_s=1")];
    for (name, remedy) in cases {
        std::fs::copy(made(name), folder.path().join(name)).unwrap();
        let output = ident(folder.path(), &["import", name, "--kind", "load-cycle"]);
        let errors = String::from_utf8_lossy(&output.stderr).to_string();
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(errors.contains(remedy), "{name}: {errors}");
        assert!(
            !folder
                .path()
                .join(name)
                .with_extension("ident.toml")
                .exists()
        );
    }
}

#[test]
fn a_file_of_two_tables_asks_which_is_meant() {
    let folder = tempfile::tempdir().unwrap();
    let mut bytes = std::fs::read(made("wave.tdms")).unwrap();
    // the same channels in another group, behind
    let other: Vec<u8> = bytes.clone();
    let (from, to) = ("Achse 2".as_bytes(), "Achse 3".as_bytes());
    let mut other = other;
    for at in 0..other.len() - from.len() {
        if other[at..].starts_with(from) {
            other[at..at + to.len()].copy_from_slice(to);
        }
    }
    bytes.extend(other);
    std::fs::write(folder.path().join("two.tdms"), bytes).unwrap();
    let output = ident(
        folder.path(),
        &["import", "two.tdms", "--kind", "load-cycle"],
    );
    let errors = String::from_utf8_lossy(&output.stderr).to_string();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        errors.contains("`Achse 2`") && errors.contains("--table"),
        "{errors}"
    );
    let words = [
        "import",
        "two.tdms",
        "--kind",
        "load-cycle",
        "--table",
        "Achse 3",
    ];
    assert_eq!(ident(folder.path(), &words).status.code(), Some(0));
    let file = LoadCycle::read(&folder.path().join("two.tdms")).unwrap();
    assert_eq!(file.load.len(), 120);
}

#[test]
fn spoiled_files_are_refused_and_never_end_the_program() {
    use ident::ground::random::Random;
    use ident::measurement::foreign::{Sidecar, translated};
    let folder = tempfile::tempdir().unwrap();
    let names = [
        "cycle.xlsx",
        "named.npy",
        "fortran.npy",
        "vectors.mat",
        "structure.mat",
        "wave.tdms",
        "time.tdms",
    ];
    for name in names {
        let good = std::fs::read(made(name)).unwrap();
        let mut random = Random::new(11);
        for _ in 0..150 {
            let mut bytes = good.clone();
            for _ in 0..1 + random.below(4) {
                let at = random.below(bytes.len().min(900));
                bytes[at] = random.below(256) as u8;
            }
            bytes.truncate(bytes.len() - random.below(3) * random.below(bytes.len()) / 4);
            let path = folder.path().join(name);
            std::fs::write(&path, &bytes).unwrap();
            let read = std::panic::catch_unwind(|| translated(&path, &Sidecar::default()));
            let _ = read.unwrap_or_else(|_| panic!("{name}"));
        }
    }
}

/// The reader of workbooks panics of an extent that ends before it begins: that is a file that cannot be read.
#[test]
fn a_workbook_with_places_that_are_none_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(made("reversed.xlsx"), folder.path().join("reversed.xlsx")).unwrap();
    let words = ["import", "reversed.xlsx", "--kind", "load-cycle"];
    let output = ident(folder.path(), &words);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("reversed.xlsx")
            && said.contains("save it again")
            && !said.contains("panicked"),
        "{said}"
    );
}
