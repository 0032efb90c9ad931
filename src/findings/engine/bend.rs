//! How far what was found is from the straight lines of the statement that it was found in.

use super::statement::{Blamed, Member, Statement};
use crate::ground::stats::difference;

/// By how much what was found does something else, stated about it (the second), than the first statement says of the same amounts: of
/// causes and of what is uncertain. Without these the readings alone are compared.
pub(super) fn bent(
    [first, again]: [&Statement; 2],
    found: Option<(&[Blamed], &[f64])>,
) -> Vec<f64> {
    let left = |statement| found.and_then(|found| left_by(statement, found));
    match [first, again].map(left) {
        [Some(a), Some(b)] => difference(&a, &b),
        // of a strength that it does not know
        _ => difference(&first.reading, &again.reading),
    }
}

/// What a statement says that amounts leave; none where a cause has no member of its amounts there.
pub(super) fn left_by(
    statement: &Statement,
    (causes, uncertain): (&[Blamed], &[f64]),
) -> Option<Vec<f64>> {
    let mut left = statement.reading.clone();
    let mut take = |column: &[f64], amount: f64| {
        let each = left.iter_mut().zip(column);
        each.for_each(|(l, c)| *l -= amount * c);
    };
    for blamed in causes {
        let columns = &member_of(statement, blamed)?.columns;
        let each = columns.iter().zip(&blamed.amounts);
        each.for_each(|(column, amount)| take(column, *amount));
    }
    let known = statement.nuisances.iter().zip(uncertain);
    known.for_each(|(nuisance, amount)| take(&nuisance.column, *amount));
    Some(left)
}

/// The member that a cause is of: of its shape, or, where the last of that is a strength, of that nearest to its own.
fn member_of<'a>(statement: &'a Statement, blamed: &Blamed) -> Option<&'a Member> {
    let mut suspects = statement.suspects.iter();
    let own = suspects.find(|s| s.effect == blamed.effect && s.site == blamed.site)?;
    let mut members = own.members.iter();
    if let Some(same) = members.find(|m| m.shape == blamed.shape) {
        return Some(same);
    }
    let (strength, form) = blamed.shape.split_last()?;
    let far = |m: &Member| {
        m.shape
            .last()
            .map_or(f64::INFINITY, |s| (s - strength).abs())
    };
    let is_own = |m: &&Member| {
        let shape = m.shape.split_last();
        m.within.is_some() && m.allows(&blamed.amounts) && shape.is_some_and(|s| s.1 == form)
    };
    let own = own.members.iter().filter(is_own);
    own.min_by(|a, b| far(a).total_cmp(&far(b)))
}

#[cfg(test)]
mod tests {
    use super::bent;
    use crate::findings::engine::{Aspects, Blamed, Member, Nuisance, Statement, Suspect, White};
    use nalgebra::DMatrix;

    /// A statement with one cause of these members and one uncertain number.
    fn statement(reading: &[f64], members: Vec<Member>) -> Statement {
        Statement {
            reading: reading.to_vec(),
            noise: Box::new(White {
                spread: vec![1.0; reading.len()],
                rows: 60.0,
            }),
            nuisances: vec![Nuisance {
                column: vec![0.0, 0.0, 1.0],
                spread: 1.0,
            }],
            suspects: vec![Suspect {
                effect: "soft",
                site: "A1".into(),
                summary: "",
                mechanism: "",
                share: 0.0,
                members,
                named: true,
                law_error: 0.0,
                can_be: |_, _| true,
            }],
            span: Vec::new(),
            splits: Vec::new(),
            aspects: Aspects::default(),
        }
    }

    fn of_strength(column: [f64; 3], strength: f64) -> Member {
        Member {
            within: Some([0.5 * strength, 1.5 * strength]),
            ..Member::given(column.to_vec(), 1.0).shaped(&[0.0, strength])
        }
    }

    /// What is added is x² everywhere: the chord at 1 and the slope there say the same of 1, and so nothing is bent, though the readings of
    /// the two statements differ by 1; of 1.2 they do not.
    #[test]
    fn a_chord_is_compared_with_what_is_milled() {
        let first = statement(
            &[1.0; 3],
            vec![of_strength([1.0; 3], 1.0), of_strength([3.0; 3], 3.0)],
        );
        // measured 1, less what is milled (1), plus the slope (2) times the amount (1)
        let again = statement(&[2.0; 3], vec![of_strength([2.0; 3], 1.0)]);
        let found = |amount: f64| Blamed {
            effect: "soft",
            site: "A1".into(),
            shape: vec![0.0, 1.0],
            amounts: vec![amount],
            covariance: DMatrix::zeros(1, 1),
            part: Vec::new(),
        };
        let by = |amount: f64| bent([&first, &again], Some((&[found(amount)], &[0.3])));
        assert!(by(1.0).iter().all(|x| x.abs() < 1e-12));
        assert!(
            by(1.2).iter().all(|x| (x - 0.2).abs() < 1e-12),
            "{:?}",
            by(1.2)
        );
        assert_eq!(bent([&first, &again], None), [-1.0; 3]);
    }
}
