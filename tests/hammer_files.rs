//! Hammer tests as files: universal files give what the CSV gives, and no text makes `ident` panic.

use crate::common::{Blow, csv, record, robot};
use ident::experiments::hammer_force::ForceWindow;
use ident::experiments::hammer_frf::{Settings, estimate};
use ident::experiments::hammer_modes::modes;
use ident::measurement::hammer::{HammerRecord, read_hammer};
use ident::measurement::hammer_uff;
use ident::measurement::uff::{
    self, Abscissa, Axis, Dof, Encoding, Function, Kind, Quantity, UniversalFile, Values,
};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

fn short() -> HammerRecord {
    let blow = Blow {
        rate_hz: 1000.0,
        length_s: 0.5,
        ..Blow::default()
    };
    record(&robot(), &[("x", blow), ("x", blow), ("y", blow)], 2)
}

fn time_record(quantity: Quantity, direction: i64, step: f64, values: &[f64]) -> Function {
    let dof = |direction| Dof {
        entity: "NONE".into(),
        node: 1,
        direction,
    };
    Function {
        id: std::array::from_fn(|_| "NONE".into()),
        kind: Kind::Time,
        numbers: [0, 1, 0],
        response: dof(direction),
        reference: dof(0),
        abscissa: Abscissa::Even { start: 0.0, step },
        values: Values::Real(values.to_vec()),
        double: true,
        z: 0.0,
        axes: [
            Axis::new(Quantity::Time, "Time", "s"),
            Axis::new(quantity, "NONE", "NONE"),
            Axis::none(),
            Axis::none(),
        ],
    }
}

#[test]
fn a_universal_file_gives_the_same_record() {
    let made = short();
    let mut functions = Vec::new();
    for run in &made.runs {
        let direction = if run.direction == "x" { 1 } else { 2 };
        functions.push(time_record(
            Quantity::ExcitationForce,
            direction,
            made.interval_s,
            &run.force,
        ));
        for (o, response) in run.responses.iter().enumerate() {
            // A sensor turned round: its record and its direction change sign together.
            let turned: Vec<f64> = response.iter().map(|v| -v).collect();
            let direction = -(o as i64 + 1);
            functions.push(time_record(
                Quantity::Acceleration,
                direction,
                made.interval_s,
                &turned,
            ));
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("hits.unv");
    let file = UniversalFile {
        functions,
        ..UniversalFile::default()
    };
    std::fs::write(&path, uff::write(&file, Encoding::Binary)).unwrap();
    let read = hammer_uff::read_hammer(&path).unwrap();
    assert_eq!(
        (&read.outputs, read.interval_s),
        (&made.outputs, made.interval_s)
    );
    for (a, b) in read.runs.iter().zip(&made.runs) {
        assert_eq!(
            (&a.direction, &a.force, &a.responses),
            (&b.direction, &b.force, &b.responses)
        );
    }
}

#[test]
fn records_that_end_too_early_are_named_with_the_remedy() {
    let blow = Blow {
        length_s: 0.4,
        ..Blow::default()
    };
    let record = record(&robot(), &[("x", blow); 3], 3);
    let remarks = estimate(&record, &Settings::default()).unwrap().remarks;
    assert!(
        remarks.iter().any(|r| r.contains("--exponential-end")),
        "{remarks:?}"
    );
    let windowed = Settings {
        exponential_end: Some(0.01),
        ..Settings::default()
    };
    let remarks = estimate(&record, &windowed).unwrap().remarks;
    assert!(
        !remarks.iter().any(|r| r.contains("--exponential-end")),
        "{remarks:?}"
    );
}

/// Reads, screens, estimates and looks for modes; whether it is refused does not matter here.
fn whole_way(text: &str) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    std::fs::write(&path, text).unwrap();
    if let Ok(record) = read_hammer(&path) {
        for settings in [
            Settings::default(),
            Settings {
                exponential_end: Some(0.1),
                force_window: ForceWindow::Always,
                ..Settings::default()
            },
        ] {
            if let Ok(frf) = estimate(&record, &settings) {
                modes(&frf, 50.0);
            }
        }
    }
}

proptest! {
    #![proptest_config(Config { cases: 60, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Config::default() })]

    #[test]
    fn mutated_files_do_not_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0usize..16, 0u8..4), 1..6),
    ) {
        let mut bytes = csv(&short()).into_bytes();
        for (at, value, how) in changes {
            let at = at.index(bytes.len());
            let value = b"0123456789-,\neNx"[value];
            match how {
                0 => bytes[at] = value,
                1 => bytes.insert(at, value),
                2 => { bytes.remove(at); }
                _ => bytes.truncate(at.max(1)),
            }
        }
        whole_way(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn strange_signals_do_not_panic(samples in 1usize..60, force in prop::collection::vec(-2i8..3, 60), seed in any::<u64>()) {
        let mut text = String::from("direction,hit,time_s,force_N,ax_m_s2,ay_m_s2\n");
        for (i, f) in force.iter().take(samples).enumerate() {
            let hit = 1 + (seed >> (i % 60)) % 2 * u64::from(i > 30);
            text += &format!("x,{hit},{},{f},{},{}\n", i as f64 * 1e-3, i64::from(*f) * 3, seed % 7);
        }
        whole_way(&text);
    }
}

#[test]
fn degenerate_files_do_not_panic() {
    for text in [
        "",
        "#",
        "# a = \n",
        "direction,hit,time_s,force_N,az_m_s2\n",
        "time_s,force_N,az_m_s2\n0,0,0\n",
    ] {
        whole_way(text);
    }
    let constant: String = (0..64)
        .map(|i| format!("{},1,1\n", f64::from(i) * 0.01))
        .collect();
    whole_way(&format!("time_s,force_N,az_m_s2\n{constant}"));
}
