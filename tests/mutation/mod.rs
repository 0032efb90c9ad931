//! Shared by the short fuzzers: how a file is spoiled.
#![allow(dead_code)]

pub mod verbs;

use ident::ground::random::Random;

/// Spoils a file in one place: cut, turned bits, a piece that readers stumble over, another digit, the
/// end of another seed.
pub fn mutate(bytes: &mut Vec<u8>, seeds: &[Vec<u8>], pieces: &[&[u8]], random: &mut Random) {
    let at = random.below(bytes.len() + 1);
    let end = (at + 1 + random.below(24)).min(bytes.len());
    match random.below(12) {
        0 => bytes.truncate(at),
        1 => drop(bytes.drain(at..end)),
        2 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
        3 if at < bytes.len() => bytes[at] = random.below(256) as u8,
        4 => drop(bytes.splice(at..end, pieces[random.below(pieces.len())].iter().copied())),
        5 => {
            let again = bytes[at..end].to_vec();
            drop(bytes.splice(at..at, again));
        }
        6..10 => another_digit(bytes, at, random),
        10 => {
            let other = &seeds[random.below(seeds.len())];
            let from = random.below(other.len());
            bytes.truncate(at);
            bytes.extend_from_slice(&other[from..]);
        }
        _ => drop(bytes.splice(at..at, pieces[random.below(pieces.len())].iter().copied())),
    }
}

/// The gentle one: the next digit becomes another.
fn another_digit(bytes: &mut [u8], at: usize, random: &mut Random) {
    let digit = bytes[at..].iter_mut().find(|b| b.is_ascii_digit());
    if let Some(digit) = digit {
        *digit = b'0' + random.below(10) as u8;
    }
}
