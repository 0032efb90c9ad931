//! The example campaign is what its truth file says: made again, it is the same byte for byte.

use ident::laboratory::truth::Truth;
use std::path::Path;

#[test]
fn the_example_campaign_is_made_again_byte_for_byte() {
    assert!(made_again("kr210") >= 12);
}

#[test]
fn the_campaigns_of_instruments_are_made_again_byte_for_byte() {
    assert_eq!(made_again("kr300"), 5);
    assert_eq!(made_again("dispenser"), 2);
}

/// Files of a campaign, each compared with what its truth makes.
fn made_again(name: &str) -> usize {
    let campaign = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("measurements")
        .join(name);
    let truth = Truth::read(&campaign.join("truth.toml")).unwrap();
    let made = truth.record().unwrap();
    let count = made.len();
    for (file, text) in made {
        assert!(text.contains("# synthetic = true"), "{}", file.display());
        let stored = std::fs::read_to_string(campaign.join(&file)).unwrap();
        let line = stored.lines().zip(text.lines()).position(|(a, b)| a != b);
        assert!(
            stored == text,
            "{} differs, first in line {:?}: run `cargo run --release -- lab measurements/{name}/truth.toml`",
            file.display(),
            line.map(|i| i + 1)
        );
    }
    count
}
