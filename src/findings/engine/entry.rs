//! One member's place in the bank.

use super::statement::Suspect;
use crate::ground::products::gram;
use crate::inference::gaussian::Size;
use nalgebra::DMatrix;
use std::ops::Range;

/// One member in the bank.
pub(super) struct Entry {
    /// Its suspect.
    pub suspect: usize,
    /// Which of the suspect's members.
    pub member: usize,
    /// Its columns in the bank.
    pub columns: Range<usize>,
    /// Its size in units of the bank's columns.
    pub size: Size,
    /// Factor from the kind's columns to those of the bank.
    pub scale: f64,
    /// Forms of its suspect.
    pub forms: usize,
    /// Products of its columns with one another.
    pub own: DMatrix<f64>,
    /// How many of its columns are independent: a shift along a wall shows nothing there, and costs nothing.
    pub rank: usize,
}

/// Share of the largest from which a direction of columns counts.
const COUNTS: f64 = 1e-6;

fn rank(own: &DMatrix<f64>) -> usize {
    if own.nrows() < 2 {
        return own.nrows();
    }
    let values = own.symmetric_eigenvalues();
    let largest = values.max();
    values.iter().filter(|v| **v > COUNTS * largest).count()
}

/// The members in a row; columns of free size are scaled to one noise deviation rms each reading (in the
/// mean over the member's columns), so that a size is the effect's own.
pub(super) fn entries(
    suspects: &[Suspect],
    columns: &mut DMatrix<f64>,
    marginal: &mut DMatrix<f64>,
) -> Vec<Entry> {
    let rows = columns.nrows().max(1) as f64;
    let mut entries = Vec::new();
    let mut at = 0;
    for (suspect, own) in suspects.iter().enumerate() {
        let forms = own.forms();
        for (member, m) in own.members.iter().enumerate() {
            let range = at..at + m.columns.len();
            at = range.end;
            let product = |c: &DMatrix<f64>, u: &DMatrix<f64>| {
                let (c, u) = (
                    c.columns(range.start, range.len()),
                    u.columns(range.start, range.len()),
                );
                gram(c) - gram(u)
            };
            let square = product(columns, marginal).trace() / (rows * range.len().max(1) as f64);
            let scale = match m.size {
                Size::Free | Size::Drawn if square > 0.0 => square.sqrt().recip(),
                _ => 1.0,
            };
            columns
                .columns_mut(range.start, range.len())
                .scale_mut(scale);
            marginal
                .columns_mut(range.start, range.len())
                .scale_mut(scale);
            let own = product(columns, marginal);
            entries.push(Entry {
                suspect,
                member,
                size: m.size,
                scale,
                forms,
                rank: rank(&own),
                own,
                columns: range,
            });
        }
    }
    entries
}
