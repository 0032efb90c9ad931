//! Every reader and every verb, run as a user runs it on a spoiled file: within ten seconds and a
//! gigabyte, without a panic, with an exit status of 0, 1 or 2.
#![allow(dead_code)]

use super::mutate;
use ident::ground::random::Random;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// One way into the program.
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// The words of the command; the spoiled file is the first of `files`.
    pub words: &'static [&'static str],
    /// Files of `fuzz/seeds-verbs` that lie in the folder it runs in; the first is spoiled.
    pub files: &'static [&'static str],
}

macro_rules! entries {
    ($($name:literal: [$($word:literal),*] [$($file:literal),*];)*) => {
        /// Every way in; a new reader or verb is one line.
        pub const ENTRIES: &[Entry] = &[$(Entry { name: $name, words: &[$($word),*], files: &[$($file),*] }),*];
    };
}

entries! {
    "load cycle, inspect": ["inspect", "load.csv"] ["load.csv"];
    "load cycle, stiffness": ["stiffness", "--dry-run", "load.csv"] ["load.csv"];
    "load cycle, diagnose": ["diagnose", "--dry-run", "load.csv"] ["load.csv"];
    "stored fit, diagnose": ["diagnose", "--dry-run", "--model", "load.toml", "load.csv"] ["load.toml", "load.csv"];
    "force steps, inspect": ["inspect", "steps.csv"] ["steps.csv"];
    "force steps, validate": ["validate", "--dry-run", "steps.csv"] ["steps.csv"];
    "force steps, diagnose": ["diagnose", "--dry-run", "steps.csv"] ["steps.csv"];
    "hammer, inspect": ["inspect", "hammer.csv"] ["hammer.csv"];
    "hammer, frf": ["frf", "--modes", "hammer.csv"] ["hammer.csv"];
    "hammer, damping": ["damping", "--dry-run", "--frf", "hammer.csv"] ["hammer.csv"];
    "hammer, diagnose": ["diagnose", "--dry-run", "hammer.csv"] ["hammer.csv"];
    "universal file, inspect": ["inspect", "records.uff"] ["records.uff"];
    "universal file, frf": ["frf", "records.uff"] ["records.uff"];
    "survey, survey": ["survey", "--dry-run", "--to-Hz", "40", "survey.unv"] ["survey.unv"];
    "joint motion, inspect": ["inspect", "motion.csv"] ["motion.csv"];
    "joint motion, diagnose": ["diagnose", "--dry-run", "motion.csv"] ["motion.csv"];
    "cubes, inspect": ["inspect", "cubes.csv"] ["cubes.csv"];
    "cubes, stiffness": ["stiffness", "--dry-run", "cubes.csv"] ["cubes.csv"];
    "cubes, diagnose": ["diagnose", "--dry-run", "cubes.csv"] ["cubes.csv"];
    "force sensor, sensor": ["sensor", "--dry-run", "sensor.csv"] ["sensor.csv"];
    "force sensor, diagnose": ["diagnose", "--dry-run", "sensor.csv"] ["sensor.csv"];
    "sensor model, apply": ["sensor", "--dry-run", "sensor.toml", "--apply", "sensor.csv"] ["sensor.toml", "sensor.csv"];
    "screw, screw": ["screw", "--dry-run", "screw.csv"] ["screw.csv"];
    "screw, diagnose": ["diagnose", "--dry-run", "screw.csv"] ["screw.csv"];
    "cutting force, force": ["force", "--dry-run", "cuts.csv"] ["cuts.csv"];
    "cutting force, diagnose": ["diagnose", "--dry-run", "cuts.csv"] ["cuts.csv"];
    "modal, lobes": ["lobes", "--dry-run", "--rpm", "4000:6000:500", "modal.toml"] ["modal.toml"];
    "robot, check": ["robot", "check", "robot.toml"] ["robot.toml"];
    "robot, pose": ["simulate", "pose", "--robot", "robot.toml", "--joints-deg", "0,-90,90,0,0,0"] ["robot.toml"];
    "robot, deflection": ["simulate", "deflection", "--robot", "robot.toml", "--joints-deg", "0,-90,90,0,0,0", "--force-N", "100,0,0"] ["robot.toml"];
    "robot, frf": ["simulate", "frf", "--robot", "robot.toml", "--joints-deg", "0,-90,90,0,0,0"] ["robot.toml"];
    "robot, map": ["robot", "map", "--dry-run", "--step-mm", "400", "--joints-deg", "0,-90,90,0,0,0", "robot.toml"] ["robot.toml"];
    "urdf, check": ["robot", "check", "robot.urdf"] ["robot.urdf"];
    "urdf, convert": ["robot", "convert", "robot.urdf"] ["robot.urdf"];
    "job, plan": ["plan", "--dry-run", "job.toml"] ["job.toml", "part.csv"];
    "job, mill": ["mill", "--dry-run", "--static", "--no-interval", "job.toml"] ["job.toml", "part.csv"];
    "job, compensate": ["compensate", "--dry-run", "--static", "job.toml"] ["job.toml", "part.csv"];
    "job, lobes": ["lobes", "--dry-run", "--rpm", "9000:11000:1000", "job.toml"] ["job.toml", "part.csv"];
    "points, plan": ["plan", "--dry-run", "job.toml"] ["part.csv", "job.toml"];
    "points, mill": ["mill", "--dry-run", "--static", "--no-interval", "job.toml"] ["part.csv", "job.toml"];
    "points, inspect": ["inspect", "part.csv"] ["part.csv"];
    "apt, inspect": ["inspect", "part.cls"] ["part.cls"];
    "gcode, inspect": ["inspect", "part.nc"] ["part.nc"];
    "krl, inspect": ["inspect", "part.src"] ["part.src"];
    "nurbs, inspect": ["inspect", "curve.csv"] ["curve.csv"];
    "foreign file, import": ["import", "--dry-run", "--kind", "load-cycle", "foreign.csv"] ["foreign.csv"];
    "sidecar, stiffness": ["stiffness", "--dry-run", "foreign.csv"] ["foreign.ident.toml", "foreign.csv"];
    "campaign facts, stiffness": ["stiffness", "--dry-run", "measurements/c/load.csv"] ["measurements/c/campaign.toml", "measurements/c/load.csv"];
    "campaign facts, run": ["run", "measurements/c"] ["measurements/c/campaign.toml", "measurements/c/load.csv"];
    "campaign, run": ["run", "measurements/c"] ["measurements/c/load.csv", "measurements/c/campaign.toml"];
    "campaign, diagnose": ["diagnose", "--dry-run", "measurements/c"] ["measurements/c/load.csv", "measurements/c/campaign.toml"];
    "simulated record, motion": ["simulate", "motion", "--robot", "kr210", "--joints-deg", "0,-90,90,0,0,0", "--path", "path.csv"] ["path.csv"];
}

/// Time of the processor that a run may take, s.
pub const SECONDS: u64 = 10;
/// Times that on the wall, where the machine is shared.
const SHARED: u64 = 12;
/// Address space that it may take, kB: a gigabyte beside the program and its threads.
const KILOBYTES: u64 = 1_400_000;

/// How a run ended.
#[derive(Debug)]
pub struct Ended {
    /// Its exit status, 0 to 2.
    pub status: i32,
    /// What it refused without naming a line.
    pub lineless: Option<String>,
}

/// How a run ended, where it should not have ended so.
#[derive(Debug)]
pub enum Fault {
    Panicked(String),
    Late,
    Ended(String),
    /// Refused without file or remedy.
    Bare(String),
}

/// Pieces that readers stumble over.
const PIECES: &[&[u8]] = &[
    b"\n",
    b"\r\n",
    b",",
    b";",
    b"\t",
    b"\"",
    b"#",
    b"# ",
    b"=",
    b"\0",
    b"\xff\xfe",
    b"\xef\xbb\xbf",
    b"-",
    b"+",
    b".",
    b"e9",
    b"1e999",
    b"1e300",
    b"1e40",
    b"1e-320",
    b"0",
    b"-0",
    b"NaN",
    b"inf",
    b",,,",
    b"99999999999999999999",
    b"\xc3\xa4",
    b"[",
    b"]",
    b"{",
    b"}",
    b"_mm",
    b"_kN",
    b"true",
    b"nan",
    b"[[",
    b"]]",
    b"<a>",
    b"/>",
    b"1e9",
    b"1e-9",
    b"6.02e23",
    b"\x1b[2J",
];

/// Where the seeds lie.
fn seeds() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds-verbs")
}

/// The content of a seed; files of a campaign are those of the same name.
pub fn seed(name: &str) -> Vec<u8> {
    let file = Path::new(name).file_name().unwrap();
    std::fs::read(seeds().join(file)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

impl Entry {
    /// The first file, spoiled.
    pub fn spoiled(&self, number: u64) -> Vec<u8> {
        let own = seed(self.files[0]);
        let mut bytes = own.clone();
        let random = &mut Random::new(number);
        for _ in 0..1 + random.below(4) {
            mutate(&mut bytes, std::slice::from_ref(&own), PIECES, random);
        }
        bytes
    }

    /// Runs on these bytes in place of the first file.
    ///
    /// # Errors
    /// It ended as no run should.
    pub fn run(&self, program: &Path, bytes: &[u8]) -> Result<Ended, Fault> {
        let folder = tempfile::tempdir().unwrap();
        let put = |name: &str, content: &[u8]| {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, content).unwrap();
        };
        put(self.files[0], bytes);
        self.files[1..]
            .iter()
            .for_each(|name| put(name, &seed(name)));
        limited(program, self.words, folder.path())
    }
}

/// Runs a command within the limits.
fn limited(program: &Path, words: &[&str], folder: &Path) -> Result<Ended, Fault> {
    let errors = folder.join(".errors");
    let limit = format!("ulimit -v {KILOBYTES}; ulimit -t {SECONDS}; exec \"$0\" \"$@\"");
    let mut child = Command::new("sh")
        .args(["-c", &limit])
        .arg(program)
        .args(words)
        .current_dir(folder)
        .env("RAYON_NUM_THREADS", "1")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(std::fs::File::create(&errors).unwrap())
        .spawn()
        .unwrap();
    let start = Instant::now();
    let mut pause = Duration::from_millis(2);
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if start.elapsed() > Duration::from_secs(SHARED * SECONDS) {
            child.kill().unwrap();
            child.wait().unwrap();
            return Err(Fault::Late);
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(50));
    };
    let said = String::from_utf8_lossy(&std::fs::read(&errors).unwrap()).to_string();
    match status.code() {
        _ if said.contains("panicked") => Err(Fault::Panicked(said)),
        Some(status @ 0..=1) => Ok(Ended {
            status,
            lineless: None,
        }),
        Some(2) if said.contains("help: ") || said.contains("Usage") => Ok(Ended {
            status: 2,
            lineless: lineless(&said),
        }),
        Some(2) => Err(Fault::Bare(said)),
        _ => Err(Fault::Ended(format!("{status}: {said}"))),
    }
}

/// The message of a refusal that names no line, its numbers taken out.
fn lineless(said: &str) -> Option<String> {
    let message = said.lines().find(|line| line.contains("error"))?;
    let placed = message.split(": ").any(|part| {
        let number = part.rsplit(':').next().unwrap_or_default();
        part.contains(':') && !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit())
    });
    let plain = |c: char| if c.is_ascii_digit() { '#' } else { c };
    (!placed).then(|| message.chars().map(plain).collect())
}
