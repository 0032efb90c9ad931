//! Any bytes as a job: read or refused, never a panic.
#![no_main]

use ident::measurement::job::Job;
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(job) = Job::of_bytes(Path::new("/nowhere/job.toml"), bytes) {
        assert!(job.cycle > 0.0);
    }
});
