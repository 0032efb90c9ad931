//! Frequency responses that other programs exported: read in any unit, with an honest scatter, as far as
//! the dampings of a robot.

use crate::bench_of_files::{Bench, document};
use crate::common::{accelerance, robot};
use ident::experiments::hammer_frf::{Settings, estimate};
use ident::experiments::hammer_given::ScatterFrom;
use ident::experiments::hammer_modes::modes;
use ident::experiments::hammer_variance::variance;
use ident::ground::random::Random;
use ident::measurement::hammer_uff;
use ident::measurement::uff::{
    self, Abscissa, Axis, Dof, Encoding, Function, Kind, Quantity, Units, UniversalFile, Values,
};
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

const STEP_HZ: f64 = 0.25;
const LINES: usize = 480;

fn s(k: usize) -> Complex64 {
    Complex64::new(0.0, TAU * STEP_HZ * k as f64)
}

/// How a file is written.
#[derive(Clone)]
struct Written {
    units: Option<Units>,
    ordinate: Axis,
    force: Axis,
    /// 0 displacement, 1 velocity, 2 acceleration.
    order: i32,
    /// What one SI unit of the ratio is in the file.
    factor: f64,
}

fn si() -> Written {
    Written {
        units: Some(Units::default()),
        ordinate: Axis::new(Quantity::Acceleration, "", "m/s^2"),
        force: Axis::new(Quantity::ExcitationForce, "", "N"),
        order: 2,
        factor: 1.0,
    }
}

fn dof(direction: i64) -> Dof {
    Dof {
        entity: "NONE".into(),
        node: 7,
        direction,
    }
}

fn function(kind: Kind, [o, i]: [i64; 2], axes: [Axis; 2], values: Values) -> Function {
    let [ordinate, force] = axes;
    Function {
        id: std::array::from_fn(|_| "NONE".into()),
        kind,
        numbers: [0, 1, 0],
        response: dof(o),
        reference: dof(i),
        abscissa: Abscissa::Even {
            start: 0.0,
            step: STEP_HZ,
        },
        values,
        double: true,
        z: 0.0,
        axes: [
            Axis::new(Quantity::Frequency, "", "Hz"),
            ordinate,
            force,
            Axis::none(),
        ],
    }
}

/// The nine accelerances of the soft robot with noise of this standard deviation per part.
fn noisy(std: f64, seed: u64) -> Vec<([usize; 2], Vec<Complex64>)> {
    let mut random = Random::new(seed);
    let pairs = (0..3).flat_map(|i| (0..3).map(move |o| [o, i]));
    let mut one = |[o, i]: [usize; 2]| {
        let mut line = |k| {
            let noise = Complex64::new(random.normal(), random.normal());
            accelerance(&robot(), o, i, s(k)) + noise * std
        };
        (0..LINES).map(&mut line).collect()
    };
    pairs.map(|pair| (pair, one(pair))).collect()
}

fn file(all: &[([usize; 2], Vec<Complex64>)], how: &Written) -> UniversalFile {
    let one = |([o, i], h): &([usize; 2], Vec<Complex64>)| {
        let value = |(k, h): (usize, &Complex64)| match k {
            0 => Complex64::from(0.0),
            k => h * s(k).powi(how.order - 2) * how.factor,
        };
        // Sensor and hammer along y are turned round; the ratio along both is what it was.
        let turned = |a: usize| if a == 1 { -2 } else { a as i64 + 1 };
        let sign = if (*o == 1) == (*i == 1) { 1.0 } else { -1.0 };
        let values = h.iter().enumerate().map(value).map(|v| v * sign).collect();
        let axes = [how.ordinate.clone(), how.force.clone()];
        function(
            Kind::FrequencyResponse,
            [turned(*o), turned(*i)],
            axes,
            Values::Complex(values),
        )
    };
    UniversalFile {
        units: how.units.clone(),
        functions: all.iter().map(one).collect(),
        ..UniversalFile::default()
    }
}

fn put(bench: &Bench, name: &str, file: &UniversalFile, encoding: Encoding) {
    bench.put(name, &uff::write(file, encoding));
}

fn given(bench: &Bench, name: &str) -> Vec<Complex64> {
    let record = hammer_uff::read_hammer(&bench.path(name)).unwrap_or_else(|p| panic!("{p}"));
    let given = record.given.expect("frequency responses");
    given
        .pairs
        .iter()
        .flatten()
        .flat_map(|p| p.accelerance[1..].to_vec())
        .collect()
}

/// Files of one truth in the units of the trade.
fn units_of_the_trade() -> Vec<(&'static str, Written)> {
    let inch = Units {
        code: 7,
        description: "Inch (pound f)".into(),
        factors: [39.370_078_740_157_48, 0.224_808_943_099_710_5, 1.8],
        temperature_offset: 459.67,
    };
    let axis = Axis::new;
    let n = || axis(Quantity::ExcitationForce, "", "N");
    let labelled = |unit: &str, order, factor| Written {
        units: None,
        ordinate: axis(Quantity::Other(0), "", unit),
        force: Axis::none(),
        order,
        factor,
    };
    vec![
        ("codes", si()),
        (
            "inch",
            Written {
                ordinate: axis(Quantity::Velocity, "", "NONE"),
                force: axis(Quantity::ExcitationForce, "", "NONE"),
                order: 1,
                factor: inch.factors[0] / inch.factors[1],
                units: Some(inch),
            },
        ),
        (
            "g",
            Written {
                units: None,
                ordinate: axis(Quantity::Acceleration, "", "g"),
                force: n(),
                order: 2,
                factor: 1.0 / 9.806_65,
            },
        ),
        ("um", labelled("um/N", 0, 1e6)),
        ("mobility", labelled("(mm/s)/kN", 1, 1e6)),
    ]
}

#[test]
fn one_structure_reads_alike_in_every_unit_and_encoding() {
    let bench = Bench::new();
    let truth = noisy(0.0, 1);
    let wanted: Vec<Complex64> = truth.iter().flat_map(|(_, h)| h[1..].to_vec()).collect();
    for (name, how) in units_of_the_trade() {
        for (ending, encoding, digits) in [
            ("a.uff", Encoding::Ascii, 1e-9),
            ("b.unv", Encoding::Binary, 1e-12),
        ] {
            let name = format!("{name}-{ending}");
            put(&bench, &name, &file(&truth, &how), encoding);
            for (a, b) in given(&bench, &name).iter().zip(&wanted) {
                assert!(
                    (a - b).norm() <= digits * b.norm(),
                    "{name}: {a} is not {b}"
                );
            }
        }
    }
}

#[test]
fn what_is_not_understood_is_refused_with_line_and_remedy() {
    let bench = Bench::new();
    let truth = noisy(0.0, 1);
    let good = file(&truth, &si());
    let last = good.functions.len() - 1;
    let changed = |change: &dyn Fn(&mut Function)| {
        let mut other = good.clone();
        change(&mut other.functions[last]);
        other
    };
    let uneven = Abscissa::Uneven((0..LINES).map(|k| (k as f64).powf(1.1)).collect());
    let cases: Vec<(&str, UniversalFile)> = vec![
        (
            "ordinate (specific data type 2,",
            changed(&|f| f.axes[1] = Axis::new(Quantity::Stress, "", "Pa")),
        ),
        (
            "denominator (specific data type 0",
            changed(&|f| f.axes[2] = Axis::none()),
        ),
        ("contradict", changed(&|f| f.axes[1].unit = "mm/s2".into())),
        (
            "contradict",
            changed(&|f| f.axes[1].label = "Receptance".into()),
        ),
        (
            "no phase",
            changed(&|f| f.values = Values::Real(vec![1.0; LINES])),
        ),
        ("evenly", changed(&|f| f.abscissa = uneven.clone())),
        (
            "on the same lines",
            changed(&|f| {
                f.abscissa = Abscissa::Even {
                    start: 0.0,
                    step: 0.5,
                }
            }),
        ),
        (
            "direction of the response",
            changed(&|f| f.response.direction = 0),
        ),
        ("same response and force", changed(&|f| f.response = dof(1))),
        (
            "no frequency",
            changed(&|f| f.axes[0].quantity = Quantity::Time),
        ),
        (
            "no frequency response",
            changed(&|f| f.values = Values::Complex(vec![Complex64::from(1.0); 9])),
        ),
    ];
    for (says, file) in &cases {
        put(&bench, "bad.uff", file, Encoding::Ascii);
        let text = bench.text("bad.uff");
        let heads = text
            .lines()
            .enumerate()
            .filter(|(_, line)| *line == "    58");
        let line = heads.last().unwrap().0 + 2;
        let ran = bench.run(&["frf", "bad.uff", "--json"]);
        ran.is_refusal(says, "bad.uff", Some(line), says);
    }
    put(&bench, "bad.uff", &cases[2].1, Encoding::Ascii);
    bench.put(
        "bad.ident.toml",
        b"response_unit = \"m/s2\"\nforce_unit = \"N\"\n",
    );
    assert_eq!(
        bench.run(&["frf", "bad.uff"]).status,
        0,
        "what stands beside it goes first"
    );
}

/// The same files with coherences of so many averages.
fn with_coherence(averages: usize, std: f64, seed: u64) -> UniversalFile {
    let mut random = Random::new(seed);
    let mut functions = Vec::new();
    for (o, i) in (0..3).flat_map(|i| (0..3).map(move |o| (o, i))) {
        let (mut values, mut coherence) = (Vec::new(), Vec::new());
        for k in 0..LINES {
            let h = accelerance(&robot(), o, i, s(k));
            let mut x = || h + Complex64::new(random.normal(), random.normal()) * std;
            let hits: Vec<Complex64> = (0..averages).map(|_| x()).collect();
            let mean = hits.iter().sum::<Complex64>() / averages as f64;
            let power = hits.iter().map(Complex64::norm_sqr).sum::<f64>() / averages as f64;
            values.push(mean);
            coherence.push(if k == 0 { 0.0 } else { mean.norm_sqr() / power });
        }
        let ends = [o as i64 + 1, i as i64 + 1];
        let axes = [si().ordinate, si().force];
        functions.push(function(
            Kind::FrequencyResponse,
            ends,
            axes,
            Values::Complex(values),
        ));
        let axes = [Axis::new(Quantity::Other(0), "Coherence", ""), Axis::none()];
        functions.push(function(
            Kind::Coherence,
            ends,
            axes,
            Values::Real(coherence),
        ));
    }
    UniversalFile {
        units: Some(Units::default()),
        functions,
        ..UniversalFile::default()
    }
}

#[test]
fn the_scatter_is_what_it_is_with_and_without_coherence() {
    let bench = Bench::new();
    let (averages, std) = (5, 0.01);
    let both = with_coherence(averages, std, 11);
    let mut alone = both.clone();
    alone
        .functions
        .retain(|f| f.kind == Kind::FrequencyResponse);
    put(&bench, "both.uff", &both, Encoding::Binary);
    put(&bench, "stated.uff", &both, Encoding::Binary);
    bench.put("stated.ident.toml", b"averages = 5\n");
    put(&bench, "alone.uff", &alone, Encoding::Binary);
    let cases = [
        ("stated.uff", ScatterFrom::Coherence),
        ("both.uff", ScatterFrom::Level),
        ("alone.uff", ScatterFrom::Local),
    ];
    let truth = 2.0 * std * std / averages as f64;
    for (name, from) in cases {
        let record = hammer_uff::read_hammer(&bench.path(name)).unwrap();
        let frf = estimate(&record, &Settings::default()).unwrap();
        assert_eq!(frf.scatter_from, from);
        let lines: Vec<usize> = (8..200).collect();
        let mut ratios: Vec<f64> = Vec::new();
        for input in &frf.inputs {
            for o in 0..3 {
                ratios.extend(variance(input, o, &lines).iter().map(|v| v / truth));
            }
        }
        ratios.sort_by(f64::total_cmp);
        let at = |share: f64| ratios[(share * ratios.len() as f64) as usize];
        println!(
            "{name}: variance over the true one, 5 % {:.2}, median {:.2}, 95 % {:.2}",
            at(0.05),
            at(0.5),
            at(0.95)
        );
        assert!((0.8..1.3).contains(&at(0.5)), "{name}: {}", at(0.5));
        assert!(
            at(0.05) > 0.4 && at(0.95) < 4.0,
            "{name}: {} {}",
            at(0.05),
            at(0.95)
        );
    }
}

#[test]
fn modes_hold_the_truth_as_often_as_they_say() {
    let bench = Bench::new();
    let (mut held, mut all) = (0, 0);
    for seed in 0..12 {
        put(
            &bench,
            "a.uff",
            &file(&noisy(0.003, 40 + seed), &si()),
            Encoding::Binary,
        );
        let record = hammer_uff::read_hammer(&bench.path("a.uff")).unwrap();
        let frf = estimate(&record, &Settings::default()).unwrap();
        let found = modes(&frf, 50.0);
        let truth: Vec<_> = robot().into_iter().filter(|m| m.hz < 50.0).collect();
        assert_eq!(found.len(), truth.len(), "seed {seed}");
        for (mode, truth) in found.iter().zip(&truth) {
            let [f, d] = mode.half_width;
            assert!(f < 0.02 * truth.hz, "{f} at {} Hz", truth.hz);
            held += usize::from((mode.frequency_hz - truth.hz).abs() < f);
            held += usize::from((mode.damping_ratio - truth.damping).abs() < d);
            all += 2;
        }
    }
    println!("{held} of {all} intervals hold the truth");
    assert!(held * 100 >= all * 88, "{held} of {all}");
}

#[test]
fn the_verb_tells_modes_and_where_the_scatter_comes_from() {
    let bench = Bench::new();
    put(
        &bench,
        "a.uff",
        &file(&noisy(0.003, 3), &si()),
        Encoding::Ascii,
    );
    let json = document(&bench.run(&["frf", "a.uff", "--modes", "--json"]));
    assert_eq!(json["modes"].as_array().unwrap().len(), 6);
    assert!(json["modes"][0]["frequency_ci95_Hz"][0].is_number());
    assert!(
        json["scatter"]
            .as_str()
            .unwrap()
            .contains("local smooth model")
    );
    assert!(json["channels"][0]["given"][5][0].is_number());
    assert!(
        json["channels"][0]["h1"].is_null(),
        "nobody knows the estimator"
    );
    let text = bench.run(&["frf", "a.uff", "--modes"]);
    assert!(text.out.contains("by what the fit leaves"), "{}", text.out);
    assert_eq!(bench.run(&["inspect", "a.uff"]).status, 0);
    bench
        .run(&["diagnose", "a.uff"])
        .is_refusal("no hits", "a.uff", None, "without the hits");
}

#[test]
fn dampings_from_responses_are_those_from_the_hits() {
    let bench = Bench::new();
    let hits = concat!(env!("CARGO_MANIFEST_DIR"), "/measurements/kr210/hammer.csv");
    let text = std::fs::read_to_string(hits).unwrap();
    bench.put("hits.csv", text.as_bytes());
    let facts = [
        "robot",
        "joint_angles_deg",
        "synthetic",
        "mass_rel_std",
        "com_std_m",
        "inertia_rel_std",
        "gain_rel_std",
    ];
    let said = text.lines().take_while(|l| l.starts_with('#'));
    let said = said.map(|l| l.trim_start_matches(['#', ' ']));
    let said: Vec<&str> = said
        .filter(|l| facts.iter().any(|fact| l.starts_with(fact)))
        .collect();
    bench.put("frfs.ident.toml", (said.join("\n") + "\n").as_bytes());
    bench.run(&[
        "frf",
        "hits.csv",
        "--exponential-end",
        "0.01",
        "--uff",
        "frfs.uff",
    ]);
    let damping = |file: &str| {
        document(&bench.run(&[
            "damping",
            "--frf",
            file,
            "--dry-run",
            "--json",
            "--starts",
            "2",
        ]))
    };
    let [hits, frfs] = ["hits.csv", "frfs.uff"].map(damping);
    assert_eq!(frfs["frf"]["estimator"], "as given");
    let pairs = hits["parameters"]
        .as_array()
        .unwrap()
        .iter()
        .zip(frfs["parameters"].as_array().unwrap());
    let mut compared = 0;
    for (a, b) in pairs {
        let number = |v: &serde_json::Value| v["value"].as_f64();
        let (Some(x), Some(y)) = (number(a), number(b)) else {
            continue;
        };
        let ci = |v: &serde_json::Value| [0, 1].map(|k| v["ci95"][k].as_f64().unwrap());
        let ([low, high], [from, to]) = (ci(a), ci(b));
        println!(
            "{}: {x:.4e} [{low:.4e}, {high:.4e}] beside {y:.4e} [{from:.4e}, {to:.4e}]",
            a["site"]
        );
        assert!(low <= to && from <= high, "{}: {x} is not {y}", a["site"]);
        compared += 1;
    }
    assert!(compared >= 3, "{compared} dampings");
    let there = "measurements/mine/frfs";
    bench.put(&format!("{there}.uff"), &bench.bytes("frfs.uff"));
    let facts = "kind = \"hammer\"\n".to_string() + &bench.text("frfs.ident.toml");
    bench.put(&format!("{there}.ident.toml"), facts.as_bytes());
    let found = bench.run(&["damping", "--frf", "--starts", "1", "--dry-run"]);
    assert!(
        found.out.contains("frfs.uff: FRFs as given"),
        "{} {}",
        found.out,
        found.errors
    );
    bench.run(&["diagnose", "measurements/mine"]).is_refusal(
        "no hits",
        "mine",
        None,
        "no measurement",
    );
    let axis = concat!(env!("CARGO_MANIFEST_DIR"), "/measurements/kr210/axis6.csv");
    bench.put("measurements/mine/axis6.csv", &std::fs::read(axis).unwrap());
    let whole = document(&bench.run(&["diagnose", "measurements/mine", "--json"]));
    let remarks = whole["remarks"].to_string();
    assert!(remarks.contains("frfs.uff"), "{remarks}");
    std::fs::remove_dir_all(bench.path("measurements")).unwrap();
    std::fs::remove_file(bench.path("frfs.ident.toml")).unwrap();
    bench
        .run(&["damping", "--frf", "frfs.uff", "--dry-run"])
        .is_refusal("no robot", "frfs.uff", None, "names no robot");
}

#[test]
fn what_was_read_is_written_and_read_again() {
    let bench = Bench::new();
    put(
        &bench,
        "both.uff",
        &with_coherence(5, 0.003, 4),
        Encoding::Binary,
    );
    for (facts, averages) in [("averages = 5\n", Some(5)), ("", None)] {
        bench.put("both.ident.toml", facts.as_bytes());
        assert_eq!(
            bench.run(&["frf", "both.uff", "--uff", "again.uff"]).status,
            0
        );
        let [first, again] = ["both.uff", "again.uff"].map(|name| {
            let record = hammer_uff::read_hammer(&bench.path(name)).unwrap();
            record.given.unwrap()
        });
        assert_eq!(again.averages, averages);
        for (a, b) in first
            .pairs
            .iter()
            .flatten()
            .zip(again.pairs.iter().flatten())
        {
            let (x, y) = (a.coherence.as_ref().unwrap(), b.coherence.as_ref().unwrap());
            assert!(
                x[1..]
                    .iter()
                    .zip(&y[1..])
                    .all(|(x, y)| (x - y).abs() < 1e-12)
            );
            let close = |(a, b): (&Complex64, &Complex64)| (a - b).norm() <= 1e-12 * a.norm();
            assert!(
                a.accelerance[1..]
                    .iter()
                    .zip(&b.accelerance[1..])
                    .all(close)
            );
        }
    }
}

#[test]
fn import_says_what_a_universal_file_lacks_and_keeps_it() {
    let bench = Bench::new();
    put(
        &bench,
        "a.uff",
        &file(&noisy(0.003, 3), &si()),
        Encoding::Binary,
    );
    let ran = bench.run(&["import", "a.uff", "--json"]);
    assert_eq!(ran.status, 1);
    let missing = &document(&ran)["results"][0]["missing"];
    assert_eq!(missing, &serde_json::json!(["robot", "joint_angles_deg"]));
    let pose = "joint_angles_deg=[20, -75, 100, 30, 45, 15]";
    let ran = bench.run(&[
        "import",
        "a.uff",
        "--fact",
        "robot=kr210",
        "--fact",
        pose,
        "--fact",
        "averages=5",
    ]);
    assert_eq!(ran.status, 0, "{} {}", ran.out, ran.errors);
    let record = hammer_uff::read_hammer(&bench.path("a.uff")).unwrap();
    assert_eq!(
        (record.robot.as_deref(), record.given.unwrap().averages),
        (Some("kr210"), Some(5))
    );
    assert_eq!(record.joint_angles.unwrap().len(), 6);
}

#[test]
fn spoiled_files_are_read_or_refused() {
    let mut short = with_coherence(3, 0.01, 5);
    short.functions.truncate(6);
    for function in &mut short.functions {
        match &mut function.values {
            Values::Complex(values) => values.truncate(48),
            Values::Real(values) => values.truncate(48),
        }
    }
    let mut random = Random::new(17);
    let (mut read, mut refused) = (0, 0);
    for encoding in [Encoding::Ascii, Encoding::Binary] {
        let good = uff::write(&short, encoding);
        for _ in 0..150 {
            let mut bytes = good.clone();
            for _ in 0..1 + random.below(4) {
                let at = random.below(bytes.len().min(6000));
                bytes[at] = b"0123456789 -+.EXN\n"[random.below(18)];
            }
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("a.uff");
            std::fs::write(&path, &bytes).unwrap();
            match hammer_uff::read_hammer(&path) {
                Ok(record) => {
                    read += 1;
                    if let Ok(frf) = estimate(&record, &Settings::default()) {
                        modes(&frf, 12.0);
                    }
                }
                Err(problem) => {
                    refused += 1;
                    assert!(!problem.remedy.is_empty(), "{problem}");
                }
            }
        }
    }
    println!("{read} read, {refused} refused");
    assert!(read > 20 && refused > 20, "{read} read, {refused} refused");
}
