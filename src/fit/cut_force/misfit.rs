//! What the law leaves turn after turn: no noise does that.

use super::CutFit;
use crate::ground::spatial::add;
use std::f64::consts::TAU;

/// Places of a turn that are told apart: five degrees, as far as most records have several samples. A choice.
const PLACES: usize = 72;

/// What is left at one place of a turn, turn by turn, channel by channel.
#[derive(Clone, Copy, Default)]
struct Place {
    turns: f64,
    sum: [f64; 3],
    squares: f64,
}

impl Place {
    /// The mean of one turn.
    fn add(&mut self, left: &[f64; 3]) {
        self.turns += 1.0;
        for (sum, x) in self.sum.iter_mut().zip(left) {
            *sum += x;
            self.squares += x * x;
        }
    }

    /// Square of the mean over the turns, less what scatters from turn to turn; none of a single turn.
    fn repeating(&self) -> f64 {
        if self.turns < 2.0 {
            return 0.0;
        }
        let means: f64 = self.sum.iter().map(|s| s * s / self.turns).sum();
        (means - (self.squares - means) / (self.turns - 1.0)) / self.turns
    }
}

/// Root mean square of what the law leaves at the same place of every turn, as a share of the force.
pub fn share(cuts: &[CutFit]) -> f64 {
    let forces = cuts.iter().flat_map(|cut| cut.data.force.iter().flatten());
    let force: f64 = forces.map(|f| f * f).sum();
    let left: f64 = cuts.iter().map(repeating).sum();
    (left.max(0.0) / force.max(f64::MIN_POSITIVE)).sqrt()
}

/// Squares of what comes again in a cut, over all its samples, N².
fn repeating(cut: &CutFit) -> f64 {
    let mut places = [Place::default(); PLACES];
    let mut latest: Option<(i64, [f64; 3], f64)> = None;
    let mut pass = |at: i64, sum: [f64; 3], count: f64| {
        places[at.rem_euclid(PLACES as i64) as usize].add(&sum.map(|s| s / count));
    };
    for (angle, left) in cut.data.scene.angles(&cut.p).iter().zip(cut.left()) {
        let at = (angle / TAU * PLACES as f64).floor() as i64;
        latest = Some(match latest {
            Some((before, sum, count)) if before == at => (at, add(sum, left), count + 1.0),
            other => {
                other
                    .into_iter()
                    .for_each(|(at, sum, count)| pass(at, sum, count));
                (at, left, 1.0)
            }
        });
    }
    latest
        .into_iter()
        .for_each(|(at, sum, count)| pass(at, sum, count));
    let mean: f64 = places.iter().map(Place::repeating).sum::<f64>() / PLACES as f64;
    mean * cut.residual.len() as f64
}

#[cfg(test)]
mod tests {
    use super::Place;

    #[test]
    fn scatter_is_nothing_that_comes_again_nor_is_a_single_turn() {
        let mut own = [Place::default(); 3];
        for i in 0..200 {
            let noise = [1.0, -1.0][i % 2];
            own[0].add(&[noise, 0.0, 0.0]);
            own[1].add(&[3.0 + noise, 0.0, 0.0]);
        }
        own[2].add(&[3.0, 0.0, 0.0]);
        assert!(own[0].repeating().abs() < 0.01 && own[2].repeating() == 0.0);
        assert!((own[1].repeating() - 9.0).abs() < 0.1);
    }
}
