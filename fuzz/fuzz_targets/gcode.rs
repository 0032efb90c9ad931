//! Any bytes as a G-code file: read or refused, never a panic.
#![no_main]

use ident::measurement::toolpath::Toolpath;
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(path) = Toolpath::of_bytes(Path::new("/nowhere/fuzz.nc"), bytes) {
        assert!(
            path.moves
                .iter()
                .all(|step| step.to.iter().all(|x| x.is_finite()))
        );
    }
});
