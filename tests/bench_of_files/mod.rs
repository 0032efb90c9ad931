//! A folder to run `ident` in, and measurement files to put there.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// Front matter of a good file.
pub const FRONT: &str = "# kind = \"load-cycle\"
# joint = 6
# axis = \"rotation\"
# load_lever_m = 0.5
# sensor_lever_m = 0.4
# lever_rel_std = 0.002
";

/// Header of a good file.
pub const HEADER: &str = "time_s,force_N,displacement_mm";

/// Front matter, header and this body.
pub fn with_body(body: &str) -> String {
    format!("{FRONT}{HEADER}\n{body}")
}

/// Front matter, header and these rows.
pub fn with_rows(rows: &[Vec<String>]) -> String {
    let body: String = rows.iter().map(|r| r.join(",") + "\n").collect();
    with_body(&body)
}

/// Good rows: triangle cycles of 1000 N on a joint with a gap and friction, with a little noise.
pub fn rows(n: usize) -> Vec<Vec<String>> {
    let mut held = 0.0_f64;
    let mut before = 0.0;
    let row = |i: usize| {
        let x = (i as f64 / 120.0).fract();
        let triangle = 4.0 * (x - (x + 0.5).floor()).abs() - 1.0;
        let force = 1000.0 * if i < 30 { 0.0 } else { triangle };
        held = (held + force - before).clamp(-120.0, 120.0);
        before = force;
        let noise = (i * 7919 % 1013) as f64 / 506.0 - 1.0;
        let gap = 0.01 * (force / 15.0).tanh();
        let deflection = 6.5e-4 * force - 1e-4 * held + gap + 8e-4 * noise;
        vec![
            format!("{:.4}", i as f64 * 0.05),
            format!("{force:.3}"),
            format!("{deflection:.6}"),
        ]
    };
    (0..n).map(row).collect()
}

/// What a run left.
pub struct Ran {
    pub status: i32,
    pub out: String,
    pub errors: String,
}

/// An empty folder to run in.
pub struct Bench {
    folder: TempDir,
}

impl Bench {
    pub fn new() -> Self {
        Self {
            folder: tempfile::tempdir().unwrap(),
        }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn put(&self, name: &str, content: &[u8]) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, content).unwrap();
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.bytes(name)).unwrap()
    }

    pub fn run(&self, arguments: &[&str]) -> Ran {
        self.run_with(arguments, &[])
    }

    pub fn run_with(&self, arguments: &[&str], environment: &[(&str, &str)]) -> Ran {
        let output = self
            .command(arguments)
            .envs(environment.iter().copied())
            .output()
            .unwrap();
        let text = |bytes| String::from_utf8(bytes).expect("output is UTF-8");
        let ran = Ran {
            status: output.status.code().expect("not ended by a signal"),
            out: text(output.stdout),
            errors: text(output.stderr),
        };
        assert!(!ran.errors.contains("panicked"), "{}", ran.errors);
        ran
    }

    /// Status and standard error of a run whose standard output nobody reads.
    pub fn run_into_closed_pipe(&self, arguments: &[&str]) -> (i32, String) {
        let mut child = self
            .command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let errors = String::from_utf8_lossy(&output.stderr).to_string();
        (output.status.code().expect("not ended by a signal"), errors)
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ident"));
        command
            .args(arguments)
            .current_dir(self.folder.path())
            .stdin(Stdio::null());
        command
    }

    /// Every file in the folder, sorted, relative to it.
    pub fn files(&self) -> Vec<String> {
        let mut found = Vec::new();
        collect(self.folder.path(), self.folder.path(), &mut found);
        found.sort();
        found
    }

    /// Neither results nor anything temporary lies in the folder.
    pub fn nothing_written(&self, case: &str) {
        for folder in ["fits", "reports"] {
            assert!(!self.path(folder).exists(), "{case}: {folder}/ was written");
        }
        let left = self.files().into_iter().find(|f| f.ends_with(".tmp"));
        assert_eq!(left, None, "{case}");
    }
}

fn collect(root: &Path, folder: &Path, found: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        match path.is_dir() {
            true => collect(root, &path, found),
            false => found.push(path.strip_prefix(root).unwrap().display().to_string()),
        }
    }
}

impl Ran {
    /// Exit 2, nothing on standard output, a message with file, line and remedy.
    pub fn is_refusal(&self, case: &str, file: &str, line: Option<usize>, says: &str) {
        let seen = format!("{case}: {} {:?} {}", self.status, self.out, self.errors);
        assert_eq!(self.status, 2, "{seen}");
        assert_eq!(self.out, "", "{seen}");
        let place = match line {
            Some(line) => format!("{file}:{line}: "),
            None => file.to_string(),
        };
        assert!(self.errors.contains(&place), "wanted {place} in {seen}");
        assert!(self.errors.contains(says), "wanted {says:?} in {seen}");
        let help = self.errors.lines().find(|l| l.trim().starts_with("help: "));
        assert!(help.is_some_and(|l| l.trim().len() > 10), "{seen}");
    }
}

/// The one JSON document on standard output: common head, numbers finite or null.
pub fn document(ran: &Ran) -> Value {
    let document: Value = serde_json::from_str(&ran.out)
        .unwrap_or_else(|e| panic!("not one JSON document ({e}): {}{}", ran.out, ran.errors));
    assert_eq!(document["schema"], "ident/1");
    assert!(document["verb"].is_string());
    let input = &document["inputs"][0];
    assert!(input["path"].is_string());
    assert_eq!(input["sha256"].as_str().map(str::len), Some(64));
    for word in ["NaN", "Infinity", "inf,"] {
        assert!(!ran.out.contains(word), "{word} in {}", ran.out);
    }
    document
}
