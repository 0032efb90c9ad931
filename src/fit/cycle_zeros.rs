//! Zeros of the cycles of force steps. A cycle may have a zero of its own; what comes again in set-up after set-up is no zero, nor is a
//! jump where all others agree.

use super::force_shapes::Shapes;
use crate::ground::stats::{MEDIAN_OF_SQUARES, mean, median};

/// Zeros that usually lie further from the mean of their set-up, in standard deviations of a reading, are set anew for every cycle: what is
/// zeroed on one noisy reading lies within about one. At three, which was the first choice, zeros of two deviations that fell as they fell
/// were structure in five of 22 sound files by a stranger.
const SET_ANEW: f64 = 1.0;
/// Standard errors from which on zeros that are set anew move in one way in all set-ups, and not as they fell. A choice; no other number was
/// tried.
const ALIKE: f64 = 5.0;
/// Set-ups below which nobody can say what comes again: the standard error above means little then. A choice.
const FEW: usize = 4;

/// The zeros of one component in one set-up.
struct Zeros {
    /// Cycle and zero, m.
    each: Vec<(f64, f64)>,
    /// Slope of the line, m/N.
    slope: f64,
}

impl Zeros {
    /// Square of every zero about their mean, m², one for each that is free.
    fn squares(&self) -> Vec<f64> {
        let zeros: Vec<f64> = self.each.iter().map(|z| z.1).collect();
        let (mean, count) = (mean(&zeros), zeros.len() as f64);
        let free = (count / (count - 1.0)).sqrt();
        let square = |zero: &f64| ((zero - mean) * free).powi(2);
        zeros.iter().map(square).collect()
    }

    /// How far it moves from one cycle to the next, m.
    fn trend(&self) -> f64 {
        let middle = mean(&self.each.iter().map(|z| z.0).collect::<Vec<_>>());
        let sums = self.each.iter().fold([0.0; 2], |[over, squares], z| {
            [
                over + (z.0 - middle) * z.1,
                squares + (z.0 - middle).powi(2),
            ]
        });
        sums[0] / sums[1]
    }
}

impl Shapes {
    /// How far the zero of each component wanders from cycle to cycle, in standard deviations of a reading.
    pub(super) fn wandering(&self) -> [f64; 3] {
        [0, 1, 2].map(|component| {
            let all = self.zeros(component);
            let squares: Vec<f64> = all.iter().flat_map(Zeros::squares).collect();
            let noise = self.noise[component];
            if squares.is_empty() || noise <= 0.0 {
                return 0.0;
            }
            let usual = (median(&squares) / MEDIAN_OF_SQUARES).sqrt() / noise;
            match usual > SET_ANEW && all.len() >= FEW && !move_alike(&all) {
                true => 0.0,
                false => mean(&squares).sqrt() / noise,
            }
        })
    }

    fn zeros(&self, component: usize) -> Vec<Zeros> {
        let own = self.rests.iter().filter(|rest| rest.component == component);
        let zeros = own.filter_map(|rest| {
            let slope = rest.line()?.0.slope;
            let each = rest.zeros(slope);
            (each.len() > 1).then_some(Zeros { each, slope })
        });
        zeros.collect()
    }
}

/// Whether zeros move from cycle to cycle in one way in all set-ups: as what drifts does, or as what does not come back from its load.
fn move_alike(all: &[Zeros]) -> bool {
    let trends: Vec<f64> = all.iter().map(Zeros::trend).collect();
    let slopes: Vec<f64> = all.iter().map(|zeros| zeros.slope).collect();
    let ones = vec![1.0; all.len()];
    [&ones, &slopes]
        .iter()
        .any(|way| errors_from_nothing(&trends, way) > ALIKE)
}

/// How many standard errors lies the factor from nothing by which a column makes values (a line through the origin).
fn errors_from_nothing(values: &[f64], column: &[f64]) -> f64 {
    let both = || values.iter().zip(column);
    let square: f64 = column.iter().map(|c| c * c).sum();
    let factor = both().map(|(v, c)| v * c).sum::<f64>() / square.max(f64::MIN_POSITIVE);
    let left: f64 = both().map(|(v, c)| (v - factor * c).powi(2)).sum();
    let error = (left / (values.len() as f64 - 1.0) / square.max(f64::MIN_POSITIVE)).sqrt();
    match values.len() > 1 && square > 0.0 {
        true => factor.abs() / error.max(f64::MIN_POSITIVE),
        false => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    fn all(zero: impl Fn(usize, f64) -> f64) -> Vec<Zeros> {
        let own = |i: usize| {
            let slope = [1e-6, -4e-7][i % 2];
            let each = (0..3).map(|cycle| (f64::from(cycle), zero(3 * i + cycle as usize, slope)));
            Zeros {
                each: each.collect(),
                slope,
            }
        };
        (0..20).map(own).collect()
    }

    #[test]
    fn zeros_that_fell_as_they_fell_are_zeros_and_what_comes_again_is_none() {
        let mut random = Random::new(3);
        let fell: Vec<f64> = (0..60).map(|_| 2e-5 * random.normal()).collect();
        assert!(!move_alike(&all(|i, _| fell[i])));
        let drifts = |i: usize, _: f64| fell[i] + 4e-5 * (i % 3) as f64;
        assert!(move_alike(&all(drifts)));
        let stays = |i: usize, slope: f64| fell[i] + 60.0 * slope * (i % 3) as f64;
        assert!(move_alike(&all(stays)));
    }
}
