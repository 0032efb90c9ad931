//! What `ident` writes as data set 58, text and binary, `pyuff` reads, and the other way round. Passed
//! over where `python3` (or what `IDENT_PYTHON` names) has no `pyuff`.

use crate::common::{Blow, csv, record, robot};
use ident::measurement::uff::{self, Values};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// Reads the first file, prints its functions, and writes them again beside it, as text and binary.
const SCRIPT: &str = r#"
import json, sys, warnings
warnings.simplefilter("ignore")
import pyuff
source, text, binary = sys.argv[1:4]
sets = pyuff.UFF(source).read_sets()
sets = [s for s in (sets if isinstance(sets, list) else [sets]) if s["type"] == 58]
for target, binary in ((text, 0), (binary, 1)):
    out = pyuff.UFF(target)
    for s in sets:
        out.write_sets(dict(s, binary=binary), "add")
print(json.dumps([{"x": list(s["x"]), "re": [complex(v).real for v in s["data"]],
    "im": [complex(v).imag for v in s["data"]], "direction": int(s["rsp_dir"]),
    "type": int(s["func_type"])} for s in sets]))
"#;

fn python() -> String {
    std::env::var("IDENT_PYTHON").unwrap_or_else(|_| "python3".into())
}

fn has_pyuff() -> bool {
    let output = Command::new(python()).args(["-c", "import pyuff"]).output();
    let found = output.is_ok_and(|output| output.status.success());
    if !found {
        println!("passed over: no pyuff in {}", python());
    }
    found
}

fn parts(values: &Values) -> [Vec<f64>; 2] {
    match values {
        Values::Real(values) => [values.clone(), vec![0.0; values.len()]],
        Values::Complex(values) => [
            values.iter().map(|v| v.re).collect(),
            values.iter().map(|v| v.im).collect(),
        ],
    }
}

fn close(a: &[f64], b: &[f64], tolerance: f64) {
    let size = a.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).abs() <= tolerance * size, "{a} is not {b}");
    }
}

fn round_trip(path: &Path) {
    let folder = path.parent().unwrap();
    let again = ["text.uff", "binary.uff"].map(|name| folder.join(name));
    let output = Command::new(python())
        .args(["-c", SCRIPT])
        .args([path, &again[0], &again[1]])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let read: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
    let written = uff::read(path).unwrap();
    assert_eq!(read.len(), written.functions.len());
    let back = again.map(|path| uff::read(&path).unwrap());
    for (i, (ours, theirs)) in written.functions.iter().zip(&read).enumerate() {
        let column = |key: &str| -> Vec<f64> {
            let all = theirs[key].as_array().unwrap().iter();
            all.map(|v| v.as_f64().unwrap()).collect()
        };
        let [re, im] = parts(&ours.values);
        close(&re, &column("re"), 1e-11);
        close(&im, &column("im"), 1e-11);
        close(&ours.places(), &column("x"), 1e-5);
        assert_eq!(theirs["direction"], ours.response.direction);
        assert_eq!(theirs["type"], ours.kind.code());
        for file in &back {
            let found = &file.functions[i];
            close(&re, &parts(&found.values)[0], 1e-6);
            close(&im, &parts(&found.values)[1], 1e-6);
            close(&ours.places(), &found.places(), 1e-5);
        }
    }
}

#[test]
fn pyuff_and_ident_read_what_the_other_writes() {
    if !has_pyuff() {
        return;
    }
    for text in [false, true] {
        let folder = tempfile::tempdir().unwrap();
        let blow = Blow {
            rate_hz: 1000.0,
            length_s: 1.0,
            ..Blow::default()
        };
        let record = record(&robot(), &[("x", blow), ("x", blow), ("x", blow)], 4);
        let (source, out) = (folder.path().join("a.csv"), folder.path().join("out.uff"));
        std::fs::write(&source, csv(&record)).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_ident"));
        command.arg("frf").arg(&source).arg("--uff").arg(&out);
        if text {
            command.arg("--uff-ascii");
        }
        assert!(command.output().unwrap().status.code().unwrap() < 2);
        let bytes = std::fs::read(&out).unwrap();
        let is_text = !bytes.windows(7).any(|w| w == b"    58b");
        assert_eq!(is_text, text);
        round_trip(&out);
    }
}
