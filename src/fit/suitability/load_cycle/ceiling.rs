//! A deflection that follows the load so far and no farther.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, agreement, said_if};
use crate::ground::stats::{largest, mean, rms};

/// A sensor at the end of its range, an amplifier that saturates, or a stop beside the joint: noise that is added behind it hides the
/// plateau of equal readings that `clipped` knows.
pub const RULE: Rule = Rule {
    name: "ceiling",
    remedy: "measure with a wider range of that sensor, look for a stop beside the joint, or load less",
    look,
};

/// Shares of the largest load beyond which it is looked whether the deflection stands.
const CORNERS: [f64; 6] = [0.5, 0.6, 0.7, 0.75, 0.8, 0.86];
/// Part of the loads below such a corner where the deflection still follows: the corner itself is not known, nor what is near zero.
const FOLLOWS: [f64; 2] = [0.15, 0.8];
/// Share of its slope there that still stands, with two standard errors. No joint in the library of effects is so much stiffer beyond a
/// load: a soft zone of a fifth of the load would have to be four times as soft as the whole joint.
const STANDS: f64 = 0.06;
/// Rows that tell a slope, and its standard errors from zero.
const ROWS: usize = 12;
/// Standard deviation of loads that tell a slope, as a share of the largest: of an even ramp over the last seventh it is 0.04.
const RANGES: f64 = 0.03;
const SURE: f64 = 8.0;

fn look(on: &Course) -> Said {
    let load = &on.file.load;
    let stands = [1.0, -1.0].iter().any(|side| {
        let each = load.iter().zip(&on.deflection);
        let own: Vec<[f64; 2]> = each.map(|(l, d)| [side * l, side * d]).collect();
        stands(&own)
    });
    let what = "beyond a load the deflection stands still while the load goes on: the sensor is at its end, or something stops the joint";
    said_if(stands && !on.imposed, Weight::Fatal, what)
}

/// Whether the second of some pairs stops following the first, above zero.
fn stands(pairs: &[[f64; 2]]) -> bool {
    let top = pairs.iter().fold(0.0_f64, |most, p| most.max(p[0]));
    let within = |from: f64, to: f64| -> Vec<[f64; 2]> {
        let own = pairs.iter().copied();
        own.filter(|p| p[0] > from * top && p[0] <= to * top)
            .collect()
    };
    top > 0.0
        && CORNERS.iter().any(|corner| {
            let below = slope(&within(FOLLOWS[0] * corner, FOLLOWS[1] * corner));
            let beyond = slope(&within(*corner, 1.0));
            match (below, beyond) {
                (Some([follows, error]), Some([stands, doubt])) => {
                    follows > SURE * error && stands.abs() + 2.0 * doubt < STANDS * follows
                }
                _ => false,
            }
        })
}

/// Slope of the second over the first, with its standard error; none of too few.
fn slope(pairs: &[[f64; 2]]) -> Option<[f64; 2]> {
    if pairs.len() < ROWS {
        return None;
    }
    let [x, y] = [0, 1].map(|k| pairs.iter().map(|p| p[k]).collect::<Vec<f64>>());
    let (slope, wide) = agreement::slope((0, x.len() - 1), &x, &y);
    let each = x.iter().zip(&y);
    let left: Vec<f64> = each.map(|(x, y)| y - slope * x).collect();
    let middle = mean(&left);
    let left: Vec<f64> = left.iter().map(|l| l - middle).collect();
    // a level that is held tells no slope, whatever its noise
    let ranges = wide > pairs.len() as f64 * (RANGES * largest(&x)).powi(2);
    ranges.then(|| [slope, rms(&left) / wide.sqrt()])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    fn cycles(of: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        let mut random = Random::new(3);
        let load = |i: usize| (i as f64 * 0.05).sin();
        let one = |i: usize| [load(i), of(load(i)) + 0.004 * random.normal()];
        (0..600).map(one).collect()
    }

    #[test]
    fn what_saturates_is_told_from_what_stiffens() {
        assert!(stands(&cycles(|l| l.min(0.55))));
        assert!(stands(&cycles(|l| l.clamp(-0.8, 0.72))));
        assert!(!stands(&cycles(|l| l)));
        // a soft zone three times as soft as the joint, a gap ten times what the joint gives, and a cubic spring
        assert!(!stands(&cycles(|l| l + 0.6 * (l / 0.3).clamp(-1.0, 1.0))));
        assert!(!stands(&cycles(|l| 0.1 * l + (l / 0.01).clamp(-1.0, 1.0))));
        assert!(!stands(&cycles(|l| (3.0 * l).asinh())));
    }

    #[test]
    fn weights_on_a_scale_that_trembles_are_no_ceiling() {
        let mut random = Random::new(4);
        let level = |i: usize| [0.25, 0.5, 0.75, 1.0, 0.75, 0.5, 0.25, 0.0][i / 400 % 8];
        let row = |i: usize| [level(i) + 0.002 * random.normal(), level(i)];
        let pairs: Vec<[f64; 2]> = (0..9600).map(row).collect();
        assert!(!stands(&pairs));
    }
}
