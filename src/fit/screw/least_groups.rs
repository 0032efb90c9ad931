//! The least number of groups with the same limit of the residual, by dynamic programming over where the
//! last group starts (Bellman 1961); among equally many the one with the smallest worst residual.

use super::groups::Group;

/// More targets than this are left to the greedy rule: work grows with their cube.
const MOST: usize = 400;

/// The groups; none for more than 400 targets. A least-squares quadratic that misses the limit with
/// few targets may meet it with more, so that the greedy rule is not always the shortest.
pub fn least(points: &[[f64; 2]], limit_um: f64) -> Option<Vec<Group>> {
    let n = points.len();
    if n > MOST || n == 0 {
        return None;
    }
    // best way to cover the first `end` targets: groups, worst residual, last group
    let mut best: Vec<Option<(usize, f64, Option<Group>)>> = vec![None; n + 1];
    best[0] = Some((0, 0.0, None));
    for end in 1..=n {
        for start in (0..end).rev() {
            let Some((count, worst, _)) = best[start] else {
                continue;
            };
            let exact = end - start < 3 && end != n;
            if exact || best[end].is_some_and(|b| b.0 < count + 1) {
                continue;
            }
            let group = Group::through(&points[start..end]);
            let worst = worst.max(group.max_residual_um);
            let better = best[end].is_none_or(|b| (count + 1, worst) < (b.0, b.1));
            if group.max_residual_um <= limit_um && better {
                best[end] = Some((count + 1, worst, Some(group)));
            }
        }
    }
    let mut groups = Vec::new();
    let mut end = n;
    while end > 0 {
        let group = best[end]?.2?;
        end -= group.points;
        groups.push(group);
    }
    groups.reverse();
    Some(groups)
}

#[cfg(test)]
mod tests {
    use super::super::groups::{Joint, greedy};
    use super::*;

    #[test]
    fn never_more_groups_than_the_greedy_rule_and_every_target_in_one() {
        for seed in 0..6 {
            let points: Vec<[f64; 2]> = (0..60)
                .map(f64::from)
                .map(|x| {
                    [
                        x,
                        6.0 * (0.3 * x + f64::from(seed)).sin()
                            + (x * x * 7.3 + f64::from(seed)).sin(),
                    ]
                })
                .collect();
            let (least, greedy) = (
                least(&points, 1.5).unwrap(),
                greedy(&points, 1.5, Joint::Free),
            );
            assert!(
                least.len() <= greedy.len(),
                "{} {}",
                least.len(),
                greedy.len()
            );
            assert_eq!(least.iter().map(|g| g.points).sum::<usize>(), 60);
            assert!(least.iter().all(|g| g.max_residual_um <= 1.5));
        }
    }
}
