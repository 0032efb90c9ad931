//! Numbers out of bytes, without leaving them.

use crate::ground::problem::{Outcome, Problem};

/// A place in bytes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bytes<'a> {
    data: &'a [u8],
    at: usize,
    /// Whether the first byte of a number is the highest.
    pub(super) big: bool,
}

/// How a number is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Number {
    Signed(usize),
    Unsigned(usize),
    Float(usize),
}

impl<'a> Bytes<'a> {
    pub(super) fn new(data: &'a [u8], big: bool) -> Self {
        Self { data, at: 0, big }
    }

    /// Bytes that are left.
    pub(super) fn left(&self) -> usize {
        self.data.len() - self.at
    }

    pub(super) fn take(&mut self, count: usize) -> Outcome<&'a [u8]> {
        match self.left() >= count {
            true => {
                self.at += count;
                Ok(&self.data[self.at - count..self.at])
            }
            false => Err(cut()),
        }
    }

    pub(super) fn u32(&mut self) -> Outcome<u32> {
        Ok(self.unsigned(4)? as u32)
    }

    pub(super) fn u64(&mut self) -> Outcome<u64> {
        self.unsigned(8)
    }

    /// A count that must fit into what is left.
    pub(super) fn count(&mut self) -> Outcome<usize> {
        let count = self.u32()? as usize;
        if count > self.left() {
            Err(cut())
        } else {
            Ok(count)
        }
    }

    fn unsigned(&mut self, size: usize) -> Outcome<u64> {
        let big = self.big;
        Ok(whole(self.take(size)?, big))
    }

    pub(super) fn number(&mut self, kind: Number) -> Outcome<f64> {
        let big = self.big;
        Ok(kind.of(self.take(kind.size())?, big))
    }
}

impl Number {
    /// Its size, bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::Signed(size) | Self::Unsigned(size) | Self::Float(size) => size,
        }
    }

    /// The number in so many bytes.
    pub(super) fn of(self, bytes: &[u8], big: bool) -> f64 {
        let bits = whole(bytes, big);
        match self {
            Self::Unsigned(_) => bits as f64,
            Self::Signed(size) => {
                let unused = 64 - 8 * size as u32;
                ((bits << unused) as i64 >> unused) as f64
            }
            Self::Float(4) => f64::from(f32::from_bits(bits as u32)),
            Self::Float(_) => f64::from_bits(bits),
        }
    }
}

fn whole(bytes: &[u8], big: bool) -> u64 {
    let join = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
    match big {
        true => bytes.iter().fold(0, join),
        false => bytes.iter().rev().fold(0, join),
    }
}

/// The file ends where something should stand.
pub(super) fn cut() -> Problem {
    Problem::new("is cut, or not what its head says", "export it again").at_line(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_both_orders_are_read_and_nothing_beyond_the_end() {
        let bytes = 1.5_f64.to_be_bytes();
        assert_eq!(Number::Float(8).of(&bytes, true), 1.5);
        assert_eq!(Number::Float(4).of(&(-2.5_f32).to_le_bytes(), false), -2.5);
        assert_eq!(
            Number::Signed(2).of(&(-300_i16).to_le_bytes(), false),
            -300.0
        );
        assert_eq!(
            Number::Unsigned(2).of(&65_000_u16.to_be_bytes(), true),
            65_000.0
        );
        let mut short = Bytes::new(&[1, 0, 0], false);
        assert!(short.u32().is_err());
    }
}
