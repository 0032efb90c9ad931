//! One line of G-code: letters and numbers.

use super::super::source::number;
use crate::ground::problem::{Outcome, Problem};

/// The words of a line.
#[derive(Debug, Default)]
pub(super) struct Block {
    words: Vec<(char, f64)>,
}

/// Letters that are understood.
const LETTERS: &str = "DFGHIJKLMNOPQRSTXYZ";
/// Letters of which a line may have several.
const SEVERAL: &str = "GM";
/// Most words of a line.
const MOST: usize = 64;

impl Block {
    /// Of a line, without its comments.
    ///
    /// # Errors
    /// A letter that is not understood, a word without a number, the same letter twice, a comment without its end.
    pub(super) fn of(line: &str) -> Outcome<Self> {
        let code = without_comments(line)?;
        let code = code.trim();
        if code.starts_with('/') {
            let remedy = "remove the `/` of the line, or the line";
            return Err(Problem::new(
                "whether a line with `/` runs is up to the operator",
                remedy,
            ));
        }
        if code.is_empty() || code.starts_with('%') || code.starts_with(':') {
            return Ok(Self::default());
        }
        let mut block = Self::default();
        let mut rest = code;
        while let Some(letter) = rest.chars().next() {
            rest = block.word(letter.to_ascii_uppercase(), &rest[letter.len_utf8()..])?;
        }
        block.sound()
    }

    /// Takes one word; returns what is behind it.
    fn word<'a>(&mut self, letter: char, rest: &'a str) -> Outcome<&'a str> {
        if !LETTERS.contains(letter) {
            return Err(strange(letter));
        }
        let rest = rest.trim_start();
        let end = rest.find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c)));
        let (digits, behind) = rest.split_at(end.unwrap_or(rest.len()));
        let value = number(digits).ok_or_else(|| {
            let shown: String = rest.chars().filter(|c| !c.is_control()).take(16).collect();
            let remedy =
                "write a number behind the letter; parameters and expressions are not computed";
            Problem::new(format!("`{letter}{shown}` has no number"), remedy)
        })?;
        if self.words.len() >= MOST {
            return Err(Problem::new(
                "has too many words",
                "write one motion per line",
            ));
        }
        self.words.push((letter, value));
        Ok(behind.trim_start())
    }

    fn sound(self) -> Outcome<Self> {
        for (i, (letter, _)) in self.words.iter().enumerate() {
            let before = self.words[..i].iter().any(|word| word.0 == *letter);
            if before && !SEVERAL.contains(*letter) {
                let what = format!("{letter} stands twice");
                return Err(Problem::new(what, "write one motion per line"));
            }
        }
        let motions = self
            .codes('G')
            .filter(|code| (0..=30).contains(code))
            .count();
        if motions > 1 {
            return Err(Problem::new(
                "has two motions",
                "write one of G0 to G3 per line",
            ));
        }
        let alone = self.words.len() == 1;
        match self.value('O') {
            Some(_) if !alone => Err(strange('O')),
            _ => Ok(self),
        }
    }

    /// The value of a letter.
    pub(super) fn value(&self, letter: char) -> Option<f64> {
        let found = self.words.iter().find(|word| word.0 == letter);
        found.map(|word| word.1)
    }

    /// The codes of G or M, in tenths; one that is no code is a large number, which is refused.
    pub(super) fn codes(&self, letter: char) -> impl Iterator<Item = i32> + '_ {
        let of_letter = self.words.iter().filter(move |word| word.0 == letter);
        of_letter.map(|word| {
            let tenths = word.1 * 10.0;
            let whole = (tenths - tenths.round()).abs() < 1e-6 && (0.0..10_000.0).contains(&tenths);
            if whole {
                tenths.round() as i32
            } else {
                i32::MAX
            }
        })
    }

    /// Whether there is a point or a centre.
    pub(super) fn moves(&self) -> bool {
        self.words.iter().any(|word| "XYZIJKR".contains(word.0))
    }

    pub(super) fn has_centre(&self) -> bool {
        self.words.iter().any(|word| "IJKR".contains(word.0))
    }

    /// Letters that have no effect on the path. P counts the turns of an arc.
    pub(super) fn idle_letters(&self) -> impl Iterator<Item = char> + '_ {
        let arc = self.has_centre();
        let letters = self.words.iter().map(|word| word.0);
        letters.filter(move |letter| "DHLQOT".contains(*letter) || (*letter == 'P' && !arc))
    }
}

fn strange(letter: char) -> Problem {
    let remedy = match letter {
        '#' | '[' | '=' => "parameters and expressions are not computed: post numbers",
        'A' | 'B' | 'C' | 'U' | 'V' | 'W' => {
            "only three linear axes are known: post the part as APT with i, j, k"
        }
        'O' => "subprograms are not called: post one program",
        _ => "write letters and numbers of G-code; comments stand in ( ) or behind ;",
    };
    let shown = if letter.is_control() { '?' } else { letter };
    Problem::new(
        format!("`{shown}` may change the path and is not understood"),
        remedy,
    )
}

/// A line without its comments.
///
/// # Errors
/// A comment that is not closed: what stands in it may have been meant to move the tool.
fn without_comments(line: &str) -> Outcome<String> {
    let mut depth = 0_usize;
    let mut kept = String::with_capacity(line.len());
    for c in line.chars() {
        match c {
            ';' if depth == 0 => break,
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ if depth == 0 => kept.push(c),
            _ => {}
        }
    }
    match depth {
        0 => Ok(kept),
        _ => Err(Problem::new(
            "holds a comment that is not closed",
            "end it with `)` in the same line",
        )),
    }
}
