//! Probed places that stand out alone: a burr, a chip under the probe, the last place before the tool leaves what it cuts.

use super::stations::{Row, Station};
use crate::ground::spatial::dot;
use crate::signal::outliers::{neighbours, robust_std};

/// Distance from its neighbours, robust deviations, from which a place stands out, and the same of what is calm beside it.
const WILD: f64 = 7.0;
/// Share of the places of one direction that may: more are structure.
const MOST: f64 = 0.01;
/// Cosine of the feeds of neighbours from which they lie on one wall: beside a corner a place may well stand out.
const STRAIGHT: f64 = 0.98;
/// Places on either side that are looked at.
const BESIDE: usize = 2;

/// Rows that stand out of what is missed, and by how much, m.
pub(super) fn wild(stations: &[Station], rows: &[Row], missed: &[f64]) -> Vec<(usize, f64)> {
    let of = |wall: bool| {
        let own: Vec<usize> = (0..rows.len()).filter(|i| rows[*i].left == wall).collect();
        let along = |i: usize| &stations[rows[own[i]].station];
        let straight = |i: usize| {
            let near = i.saturating_sub(BESIDE)..(i + BESIDE + 1).min(own.len());
            let mut feeds = near.map(|j| dot(along(j).feed, along(i).feed));
            feeds.all(|cosine| cosine > STRAIGHT)
        };
        let values: Vec<f64> = own.iter().map(|i| missed[*i]).collect();
        let found = standing_out(&values);
        let few = found.len() as f64 <= (MOST * own.len() as f64).max(1.0);
        let kept = found.into_iter().filter(|(i, _)| few && straight(*i));
        kept.map(|(i, off)| (own[i], off)).collect::<Vec<_>>()
    };
    [of(true), of(false)].concat()
}

fn standing_out(values: &[f64]) -> Vec<(usize, f64)> {
    if values.len() < 4 * (2 * BESIDE + 1) {
        return Vec::new();
    }
    let each = (0..values.len()).map(|i| values[i] - neighbours(values, i));
    let off: Vec<f64> = each.collect();
    let spread = robust_std(&off);
    let size = |i: usize| off[i].abs();
    // at the ends a place has few neighbours, and shows half of what stands out beside it
    let most = |i: usize| {
        let near = i.saturating_sub(BESIDE)..(i + BESIDE + 1).min(off.len());
        near.fold(0.0_f64, |most, j| most.max(size(j)))
    };
    let is_inside = |i: usize| i >= BESIDE && i + BESIDE < off.len();
    let far = |i: &usize| size(*i) > WILD * spread && (is_inside(*i) || size(*i) >= most(*i));
    (0..off.len()).filter(far).map(|i| (i, size(i))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    fn told(spoil: impl Fn(usize) -> f64) -> Vec<usize> {
        let mut random = Random::new(8);
        let stations: Vec<Station> = (0..80)
            .map(|i| Station::plain(1e-3 * f64::from(i)))
            .collect();
        let row = |i: usize| Row {
            station: i,
            across: [0.0, 1.0, 0.0],
            left: true,
            measured: 0.0,
        };
        let rows: Vec<Row> = (0..80).map(row).collect();
        let missed: Vec<f64> = (0..80).map(|i| 3e-6 * random.normal() + spoil(i)).collect();
        let found = wild(&stations, &rows, &missed).into_iter();
        found.map(|(i, _)| i).collect()
    }

    #[test]
    fn one_place_stands_out_alone_and_a_step_does_not() {
        assert_eq!(told(|i| if i == 40 { 60e-6 } else { 0.0 }), [40]);
        for end in [1, 78, 79] {
            assert_eq!(told(|i| if i == end { -60e-6 } else { 0.0 }), [end]);
        }
        assert!(told(|i| if i >= 40 { 60e-6 } else { 0.0 }).is_empty());
        assert!(told(|i| if i % 20 == 7 { 60e-6 } else { 0.0 }).is_empty());
        assert!(told(|_| 0.0).is_empty());
    }
}
