//! No bytes make the reader of universal files panic: seeded mutations of valid files.

use ident::measurement::uff::{
    self, Abscissa, Axis, Dof, Encoding, Function, Kind, Quantity, Units, UniversalFile, Values,
};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use rustfft::num_complex::Complex64;

fn function(complex: bool, even: bool, double: bool) -> Function {
    let dof = |node| Dof {
        entity: "NONE".into(),
        node,
        direction: 3,
    };
    let wave: Vec<f64> = (0..7).map(|i| (i as f64).sin()).collect();
    let abscissa = if even {
        Abscissa::Even {
            start: 0.0,
            step: 0.25,
        }
    } else {
        Abscissa::Uneven((0..7).map(|i| f64::from(i * i)).collect())
    };
    Function {
        id: std::array::from_fn(|i| format!("line {i}")),
        kind: Kind::FrequencyResponse,
        numbers: [0, 1, 0],
        response: dof(1),
        reference: dof(2),
        abscissa,
        values: if complex {
            Values::Complex(wave.iter().map(|v| Complex64::new(*v, -v)).collect())
        } else {
            Values::Real(wave)
        },
        double,
        z: 0.0,
        axes: [
            Axis::new(Quantity::Frequency, "Frequency", "Hz"),
            Axis::new(Quantity::Acceleration, "Acceleration", "m/s2"),
            Axis::new(Quantity::ExcitationForce, "Force", "N"),
            Axis::none(),
        ],
    }
}

fn valid(encoding: Encoding) -> Vec<u8> {
    let all = (0..8).map(|c| function(c & 1 > 0, c & 2 > 0, c & 4 > 0));
    let file = UniversalFile {
        units: Some(Units::default()),
        functions: all.collect(),
        ..UniversalFile::default()
    };
    uff::write(&file, encoding)
}

#[test]
fn all_eight_cases_round_trip_in_both_encodings() {
    for encoding in [Encoding::Ascii, Encoding::Binary] {
        let file = uff::parse(&valid(encoding)).unwrap();
        assert_eq!(file.functions.len(), 8);
        for (case, found) in file.functions.iter().enumerate() {
            let made = function(case & 1 > 0, case & 2 > 0, case & 4 > 0);
            assert_eq!(found.axes, made.axes);
            assert_eq!(found.values.len(), 7);
            if encoding == Encoding::Binary && made.double {
                assert_eq!(found, &made);
            }
        }
    }
}

proptest! {
    #![proptest_config(Config { cases: 2000, rng_seed: RngSeed::Fixed(5), failure_persistence: None, ..Config::default() })]

    #[test]
    fn mutations_do_not_panic(
        binary in any::<bool>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0u8..4), 1..12),
    ) {
        let mut bytes = valid(if binary { Encoding::Binary } else { Encoding::Ascii });
        for (at, value, how) in changes {
            if bytes.is_empty() {
                break;
            }
            let at = at.index(bytes.len());
            match how {
                0 => bytes[at] = value,
                1 => bytes[at] = b"0123456789-+ \nED"[usize::from(value % 16)],
                2 => { bytes.remove(at); }
                _ => bytes.truncate(at.max(1)),
            }
        }
        if let Ok(file) = uff::parse(&bytes) {
            file.functions_si().iter().for_each(|f| { f.places(); });
            uff::write(&file, Encoding::Ascii);
        }
    }

    #[test]
    fn any_bytes_do_not_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = uff::parse(&bytes);
    }
}
