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
