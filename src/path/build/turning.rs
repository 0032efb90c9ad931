//! Laying orientations along the path.

use super::{Halt, Path};
use crate::path::corner::Passage;
use crate::path::orientation::{Law, Span, Turning, turns_at};

impl Path {
    pub(super) fn lay_turning(&mut self, turning: Turning) {
        let elements = &self.programme.elements;
        let laws = elements.iter().enumerate();
        let laws: Vec<Law> = laws.map(|(k, e)| Law::of(k, e, turning)).collect();
        let zeros = self.zeros();
        let zones: Vec<[f64; 2]> = (0..self.corners.len())
            .map(|k| self.zone(k, turning))
            .collect();
        let (mut spans, mut at) = (Vec::with_capacity(2 * laws.len()), 0.0);
        for (k, law) in laws.iter().enumerate() {
            let end = zones.get(k).map_or(self.length, |zone| zone[0]);
            if end > at {
                spans.push(Span {
                    begin: at,
                    end,
                    law: (law.clone(), zeros[k]),
                    next: None,
                });
            }
            at = at.max(end);
            let Some([begin, end]) = zones.get(k).copied() else {
                break;
            };
            if end > begin {
                spans.push(Span {
                    begin,
                    end,
                    law: (law.clone(), zeros[k]),
                    next: Some((laws[k + 1].clone(), zeros[k + 1])),
                });
                at = end;
            }
        }
        self.spans = spans;
        self.lay_halts(&laws, &zones);
    }

    /// For every element the arc length of the path at which its own would be zero, m.
    fn zeros(&self) -> Vec<f64> {
        (0..=self.corners.len()).map(|k| self.zero(k)).collect()
    }

    /// The arc length of the path at which that of element `k` would be zero, m.
    pub fn zero(&self, k: usize) -> f64 {
        let corner = k.checked_sub(1).and_then(|k| self.corners.get(k));
        corner.map_or(0.0, |corner| match corner.passage {
            Passage::Blend => corner.end - corner.radius,
            _ => corner.end,
        })
    }

    /// Where the tool turns about the corner after element `k`: arc lengths, m.
    fn zone(&self, k: usize, turning: Turning) -> [f64; 2] {
        let corner = &self.corners[k];
        let Turning::Radius(radius) = turning else {
            return match corner.passage {
                Passage::Stop => [corner.begin; 2],
                Passage::Blend => [corner.begin, corner.end],
                Passage::Through => [corner.begin - corner.radius, corner.end + corner.radius],
            };
        };
        let elements = &self.programme.elements;
        let room = 0.5
            * elements[k]
                .curve
                .length()
                .min(elements[k + 1].curve.length());
        let radius = match self.turns_on_the_spot(k + 1) {
            true => 0.0,
            false => radius.min(room),
        };
        let rounded = match corner.passage {
            Passage::Blend => corner.radius,
            _ => 0.0,
        };
        if radius >= rounded {
            let more = radius - rounded;
            return [corner.begin - more, corner.end + more];
        }
        let (middle, half) = (
            0.5 * (corner.begin + corner.end),
            0.5 * (corner.end - corner.begin),
        );
        let share = radius / rounded * half;
        [middle - share, middle + share]
    }

    fn turns_on_the_spot(&self, index: usize) -> bool {
        let turns = &self.programme.turns;
        turns
            .binary_search_by_key(&index, |turn| turn.before)
            .is_ok()
    }

    fn lay_halts(&mut self, laws: &[Law], zones: &[[f64; 2]]) {
        let elements = &self.programme.elements;
        let last = elements.len();
        let start = |k: usize| laws[k].at(0.0, elements);
        let end = |k: usize| laws[k].at(elements[k].curve.length(), elements);
        let mut halts = vec![Halt {
            at: 0.0,
            turns: turns_at(&self.programme, 0, None, Some(start(0))),
        }];
        for (k, corner) in self.corners.iter().enumerate() {
            let open = zones[k][1] > zones[k][0];
            let (before, after) = (end(k), start(k + 1));
            let turns = match open {
                true => Vec::new(),
                false => turns_at(&self.programme, k + 1, Some(before), Some(after)),
            };
            if corner.passage == Passage::Stop || !turns.is_empty() {
                let at = corner.begin;
                halts.push(Halt { at, turns });
            }
        }
        halts.push(Halt {
            at: self.length,
            turns: turns_at(&self.programme, last, Some(end(last - 1)), None),
        });
        self.halts = halts;
    }
}
