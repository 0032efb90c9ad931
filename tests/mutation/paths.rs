//! Mutated tool paths and job files: read or refused with line and remedy, never a panic, never a number
//! that is none. Shared by `tests/toolpath_fuzz.rs` and `examples/fuzz_readers.rs`.

use super::mutation::mutate;
use ident::ground::problem::Problem;
use ident::ground::random::Random;
use ident::ground::vector::{dot, norm, scale, sub};
use ident::measurement::job::Job;
use ident::measurement::toolpath::{Orientation, Shape, Toolpath};
use std::path::{Path, PathBuf};

/// Pieces that readers stumble over.
const PIECES: &[&[u8]] = &[
    b"\n",
    b"\r\n",
    b"\r",
    b",",
    b";",
    b"/",
    b"$",
    b"$$",
    b"$\n",
    b"(",
    b")",
    b"{",
    b"}",
    b"[",
    b":",
    b"=",
    b"\"",
    b"#",
    b"\0",
    b"\xff\xfe",
    b"\xef\xbb\xbf",
    b"\xc3\xa4",
    b"-",
    b"+",
    b".",
    b"e9",
    b"1e999",
    b"1e300",
    b"1e-320",
    b"NaN",
    b"inf",
    b"-0",
    b"99999999999999999999",
    b" ",
    b"X",
    b"G",
    b"G2 ",
    b"G3 ",
    b"G91 ",
    b"G20 ",
    b"I0 J0",
    b"R1",
    b"GOTO/",
    b"CIRCLE/0,0,0,0,0,1,10\n",
    b"RAPID\n",
    b"TLON,GOFWD/(",
    b"INDIRV/0,0,0\n",
    b"LIN {X 0}\n",
    b"CIRC ",
    b"CA 360",
    b"C_DIS",
    b" WITH ",
    b"sub()\n",
    b"part()\n",
    b"DEF a()\n",
    b"END\n",
    b"PTP ",
    b"kind",
    b"[tool]\n",
    b"teeth = 1e9\n",
    b"true",
];

/// A good file.
pub struct Seed {
    pub path: PathBuf,
    pub bytes: Vec<u8>,
}

/// The good files that mutations start from, in the order of their names.
pub fn seeds() -> Vec<Seed> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds-paths");
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let seed = |path: PathBuf| Seed {
        bytes: std::fs::read(&path).unwrap(),
        path,
    };
    paths.into_iter().map(seed).collect()
}

/// Reads what is at `path` in these bytes; nothing lies beside it.
pub fn read(path: &Path, bytes: &[u8]) -> Result<(), Problem> {
    let path = Path::new("/nowhere").join(path.file_name().unwrap());
    if path.extension().is_some_and(|e| e == "toml") {
        return Job::of_bytes(&path, bytes).map(|job| sound_job(&job));
    }
    Toolpath::of_bytes(&path, bytes).map(|toolpath| sound(&toolpath))
}

fn sound_job(job: &Job) {
    let cutter = job.cutter.iter();
    assert!(
        cutter
            .clone()
            .all(|c| c.diameter > 0.0 && c.teeth > 0 && c.corner_radius <= 0.5 * c.diameter)
    );
    assert!(job.cycle > 0.0 && job.feed.is_none_or(|feed| feed > 0.0 && feed.is_finite()));
}

fn sound(path: &Toolpath) {
    for (i, m) in path.moves.iter().enumerate() {
        assert!(m.to.iter().all(|x| x.abs() <= 1e4), "{m:?}");
        assert!(
            m.feed.is_none_or(|feed| feed > 0.0 && feed.is_finite()),
            "{m:?}"
        );
        assert!(
            m.blend
                .is_none_or(|blend| blend >= 0.0 && blend.is_finite()),
            "{m:?}"
        );
        match m.orientation {
            Orientation::Axis(axis) => assert!((norm(axis) - 1.0).abs() < 1e-12, "{m:?}"),
            Orientation::Full(r) => {
                assert!(r.iter().all(|row| (norm(*row) - 1.0).abs() < 1e-9), "{m:?}")
            }
        }
        if let Shape::Arc(arc) = m.shape {
            let from = path.moves[i - 1].to;
            assert!(arc.angle > 0.0 && arc.angle.is_finite(), "{m:?}");
            let out = sub(m.to, arc.centre);
            let flat = norm(sub(out, scale(dot(out, arc.axis), arc.axis)));
            let allowed = 2.1e-6 + 1e-9 * flat;
            assert!((flat - arc.radius(from)).abs() < allowed, "{m:?}");
        }
    }
    if let Some(curve) = &path.curve {
        assert_eq!(curve.knots.len(), curve.points.len() + curve.degree + 1);
        assert!(curve.weights.iter().all(|w| *w > 0.0 && w.is_finite()));
    }
}

/// Case `number` of the mutations of `seeds[which]`; whether it was read.
pub fn case(seeds: &[Seed], which: usize, number: u64) -> bool {
    let random = &mut Random::new(number);
    let seed = &seeds[which];
    let others: Vec<Vec<u8>> = seeds.iter().map(|seed| seed.bytes.clone()).collect();
    let mut bytes = seed.bytes.clone();
    for _ in 0..1 + random.below(4) {
        mutate(&mut bytes, &others, PIECES, random);
    }
    let outcome = std::panic::catch_unwind(|| read(&seed.path, &bytes));
    let shown = || format!("case {number}: {:?}", String::from_utf8_lossy(&bytes));
    match outcome.unwrap_or_else(|_| panic!("{}", shown())) {
        Ok(()) => true,
        Err(problem) => {
            let complete = !problem.what.is_empty() && !problem.remedy.is_empty();
            assert!(complete && problem.line.is_some(), "{}: {problem}", shown());
            false
        }
    }
}
