//! Any bytes as a load-cycle file: read or refused, never a panic.
#![no_main]

use ident::fit::observation::Observation;
use ident::measurement::load_cycle::LoadCycle;
use ident::measurement::table::Table;
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    let table = Table::from_reader(Path::new("fuzz.csv"), bytes, bytes.len() as u64);
    if let Ok(file) = table.and_then(LoadCycle::from_table) {
        assert!(
            file.load
                .iter()
                .chain(&file.deflection)
                .all(|v| v.is_finite())
        );
        let data = Observation::of(&file, 600);
        assert_eq!(data.rows(), data.cycles.of_row.len());
        assert!(data.cycles.starts.iter().all(|s| *s < data.rows()));
    }
});
