//! `cargo fuzz run uff`: no bytes make the reader of universal files panic.
#![no_main]

use ident::measurement::uff;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(file) = uff::parse(bytes) {
        for function in file.functions_si() {
            function.places();
        }
        uff::write(&file, uff::Encoding::Ascii);
    }
});
