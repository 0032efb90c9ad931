//! Universal files of other programs are read whole or refused with the reason.

use crate::common::shared;
use ident::measurement::uff::{self, Abscissa, Encoding, Quantity, UniversalFile, Values};

/// File, values of each function (pyuff 2.5.8 agrees but for the cases named), blocks skipped.
const FILES: &[(&str, &[usize], usize)] = &[
    ("Sample_UFF58_ascii.uff", &[79_292], 0),
    ("Sample_UFF58b_bin.uff", &[79_292], 0),
    ("dataset15.unv", &[], 0),
    ("dataset151&164.unv", &[], 0),
    ("dataset151.unv", &[], 0),
    ("dataset151_164_58_55.unv", &[10], 1),
    ("dataset151_bad_format.unv", &[], 0),
    ("dataset164.unv", &[], 0),
    ("dataset18.unv", &[], 1),
    ("dataset1858.unv", &[], 1),
    ("dataset55.unv", &[], 1),
    ("dataset55_bad_format.unv", &[], 1),
    // pyuff returns the padding too: 1602.
    ("dataset58_FRF.unv", &[1600], 0),
    ("dataset58_FRF_UTF.unv", &[1600], 0),
    ("dataset58_case1_ascii.unv", &[1602], 0),
    ("dataset58_case1_binary.unv", &[1602], 0),
    ("dataset58_case2_ascii.unv", &[1602], 0),
    ("dataset58_case2_binary.unv", &[1602], 0),
    ("dataset58_case3_ascii.unv", &[801], 0),
    ("dataset58_case3_binary.unv", &[801], 0),
    ("dataset58_case4_ascii.unv", &[801], 0),
    ("dataset58_case4_binary.unv", &[801], 0),
    ("dataset58_case5_ascii.unv", &[1602], 0),
    ("dataset58_case5_binary.unv", &[1602], 0),
    ("dataset58_case6_ascii.unv", &[1602], 0),
    // pyuff takes the single abscissa for double: 1201 and 667.
    ("dataset58_case6_binary.unv", &[1602], 0),
    ("dataset58_case7_ascii.unv", &[801], 0),
    ("dataset58_case7_binary.unv", &[801], 0),
    ("dataset58_case8_ascii.unv", &[801], 0),
    ("dataset58_case8_binary.unv", &[801], 0),
    ("dataset58_coh.unv", &[1600], 0),
    ("dataset58_nospacing.uff", &[66], 0),
    ("dataset58_spectrum.unv", &[6400], 0),
    ("dataset58_time.unv", &[4096], 0),
    ("dataset58_ufb.ufb", &[801, 801], 0),
    ("non_ascii_header.uff", &[6], 0),
    ("time-history-not-all-columns-filled.uff", &[13], 0),
];

fn read(name: &str) -> Option<UniversalFile> {
    let path = shared(&format!("uff/{name}"))?;
    Some(uff::read(&path).unwrap_or_else(|problem| panic!("{problem}")))
}

#[test]
fn every_file_of_the_folder_reads_as_it_should() {
    let Some(folder) = shared("uff") else { return };
    for (name, values, skipped) in FILES {
        let file = read(name).unwrap();
        let found: Vec<usize> = file.functions.iter().map(|f| f.values.len()).collect();
        assert_eq!(found, *values, "{name}");
        assert_eq!(file.skipped.values().sum::<usize>(), *skipped, "{name}");
    }
    let all = std::fs::read_dir(folder).unwrap().count();
    assert_eq!(all, FILES.len() + 1, "a file has no expectation");
}

#[test]
fn a_signal_shorter_than_declared_is_refused() {
    let Some(path) = shared("uff/dataset_milestone_in_header.uff") else {
        return;
    };
    let problem = uff::read(&path).unwrap_err();
    assert!(
        problem.what.contains("2508876 values are declared, 42"),
        "{problem}"
    );
}

#[test]
fn binary_and_ascii_hold_the_same() {
    for case in 1..=8 {
        let name = |kind| format!("dataset58_case{case}_{kind}.unv");
        let (Some(a), Some(b)) = (read(&name("ascii")), read(&name("binary"))) else {
            return;
        };
        let (a, b) = (&a.functions[0], &b.functions[0]);
        close(&parts(&a.values), &parts(&b.values), 1e-5);
        close(&a.places(), &b.places(), 1e-4);
        assert_eq!(a.axes, b.axes);
        assert_eq!(a.double, b.double);
    }
}

fn parts(values: &Values) -> Vec<f64> {
    match values {
        Values::Real(values) => values.clone(),
        Values::Complex(values) => values.iter().flat_map(|v| [v.re, v.im]).collect(),
    }
}

fn close(a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert!(
            (a - b).abs() <= tolerance * a.abs().max(1e-7),
            "{a} is not {b}"
        );
    }
}

#[test]
fn units_are_converted_to_si() {
    let Some(file) = read("dataset151_164_58_55.unv") else {
        return;
    };
    let units = file.units.clone().unwrap();
    assert_eq!(units.code, 7);
    let (raw, si) = (&file.functions[0], &file.functions_si()[0]);
    assert_eq!(raw.axes[1].quantity, Quantity::Acceleration);
    // in/s² per lbf to m/s² per N.
    let factor = 0.0254 / 4.448_221_6;
    let scaled: Vec<f64> = parts(&raw.values).iter().map(|v| v * factor).collect();
    close(&scaled, &parts(&si.values), 1e-6);
    assert_eq!(
        file.header.unwrap().description,
        "File specific to show unit conversion capability of UFFFiles"
    );
}

#[test]
fn what_is_written_reads_back() {
    for (name, _, _) in FILES {
        let Some(file) = read(name) else { return };
        for encoding in [Encoding::Ascii, Encoding::Binary] {
            let bytes = uff::write(&file, encoding);
            if bytes.is_empty() {
                continue;
            }
            let back = uff::parse(&bytes).unwrap_or_else(|p| panic!("{name}: {p}"));
            assert_eq!(back.nodes.len(), file.nodes.len());
            for (a, b) in file.functions.iter().zip(&back.functions) {
                close(&parts(&a.values), &parts(&b.values), 1e-5);
                close(&a.places(), &b.places(), 1e-5);
                assert_eq!(
                    (a.kind, &a.response, a.double),
                    (b.kind, &b.response, b.double)
                );
            }
        }
    }
}

#[test]
fn a_truncated_file_is_an_error_never_a_shorter_signal() {
    for name in [
        "dataset58_case8_binary.unv",
        "dataset58_case3_ascii.unv",
        "dataset58_ufb.ufb",
    ] {
        let Some(path) = shared(&format!("uff/{name}")) else {
            return;
        };
        let bytes = std::fs::read(path).unwrap();
        let whole = uff::parse(&bytes).unwrap();
        for keep in (1..bytes.len()).step_by(37) {
            if let Ok(file) = uff::parse(&bytes[..keep]) {
                for (a, b) in file.functions.iter().zip(&whole.functions) {
                    assert_eq!(a.values.len(), b.values.len(), "{name} cut at {keep}");
                }
            }
        }
    }
}

#[test]
fn tolerates_wrong_byte_counts_and_line_ends() {
    let Some(mut file) = read("dataset58_case7_ascii.unv") else {
        return;
    };
    let bytes = uff::write(&file, Encoding::Binary);
    let count = (801 * 16).to_string();
    let wrong = replaced(
        &bytes,
        count.as_bytes(),
        format!("{:>5}", 801 * 8).as_bytes(),
    );
    assert_eq!(
        uff::parse(&wrong).unwrap().functions,
        uff::parse(&bytes).unwrap().functions
    );
    let mut simcenter = bytes[..bytes.len() - 7].to_vec();
    simcenter.extend(b"\r\n    -1\r\n");
    assert_eq!(uff::parse(&simcenter).unwrap().functions.len(), 1);
    // A marker inside the bytes is data.
    if let Values::Complex(values) = &mut file.functions[0].values {
        values[3].re = f64::from_le_bytes(*b"\n    -1\n");
    }
    let bytes = uff::write(&file, Encoding::Binary);
    assert_eq!(
        uff::parse(&bytes).unwrap().functions[0].values,
        file.functions[0].values
    );
}

fn replaced(bytes: &[u8], old: &[u8], new: &[u8]) -> Vec<u8> {
    let at = bytes.windows(old.len()).position(|w| w == old).unwrap();
    [&bytes[..at], new, &bytes[at + old.len()..]].concat()
}

#[test]
fn six_digits_of_a_step_are_snapped() {
    let Some(mut file) = read("dataset58_time.unv") else {
        return;
    };
    file.functions[0].abscissa = Abscissa::Even {
        start: 0.0,
        step: 4.88281e-4,
    };
    assert_eq!(file.functions[0].places()[2048], 1.0);
}
