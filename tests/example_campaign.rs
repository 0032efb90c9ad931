//! The example campaign is what its truth file says: made again, it is the same byte for byte.

use ident::laboratory::truth::Truth;
use std::path::Path;

#[test]
fn the_example_campaign_is_made_again_byte_for_byte() {
    let campaign = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210");
    let truth = Truth::read(&campaign.join("truth.toml")).unwrap();
    let made = truth.record().unwrap();
    assert!(made.len() >= 12);
    for (name, text) in made {
        let stored = std::fs::read_to_string(campaign.join(&name)).unwrap();
        let line = stored.lines().zip(text.lines()).position(|(a, b)| a != b);
        assert!(
            stored == text,
            "{} differs, first in line {:?}: run `cargo run --release -- lab measurements/kr210/truth.toml`",
            name.display(),
            line.map(|i| i + 1)
        );
    }
}
