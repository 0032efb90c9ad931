//! What is named, once names that structure beside them makes doubtful are none.

use super::adequacy::Adequacy;
use super::case::Case;
use super::set::Set;
use crate::findings::engine::verdict::Named;

/// What is named.
pub(super) struct Settled {
    /// Of this set.
    pub set: Set,
    /// Its causes and groups.
    pub named: Named,
    /// What its causes of the library leave.
    pub adequacy: Adequacy,
    /// A pattern of no library that stands beside them.
    pub strange: Option<usize>,
}

impl Case<'_> {
    /// A set, without those of its causes that are more likely wrong than right beside what is left, the one that gains least first.
    pub(super) fn settled(&self, mut set: Set) -> Settled {
        loop {
            let is_strange = |seat: &usize| self.seats.seats[*seat].stranger;
            let strange = set.seats.iter().copied().find(is_strange);
            let adequacy = self.adequacy(&self.known(&set));
            let named = self.name(&set);
            let mut kept = named.clone();
            let rest = adequacy.rest(strange.is_some());
            let dropped = match rest.is_left && rest.share > self.judgement.doubted_from {
                true => kept.beside_rest(&self.judgement),
                false => Vec::new(),
            };
            let least = named.least(&dropped);
            let is_least = |seat: &usize| Some(self.seats.seats[*seat].place()) == least;
            let Some(least) = set.seats.iter().copied().find(is_least) else {
                return Settled {
                    set,
                    named: kept,
                    adequacy,
                    strange,
                };
            };
            set = self.without(&set, least);
        }
    }
}
