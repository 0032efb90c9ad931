//! Whether coarse readings deny a prediction: none of the usual ways to bring it to their lattice gives them.

/// Half a step and a tenth, which fits leave, in steps.
const WITHIN: f64 = 0.6;
/// Deviations of the noise that are added to it.
const NOISE: f64 = 2.0;
/// By how much a reading may lie aside of what was read, steps: rounded, cut off, and between the two, where a straight spring followed some
/// of that.
const CUT: [f64; 5] = [0.0, 0.125, 0.25, 0.375, 0.5];
/// Share of the readings that only a real effect brings back.
const SHARE: f64 = 0.05;

/// Coarse readings.
pub(super) struct Coarse<'a> {
    /// Them.
    pub reading: &'a [f64],
    /// Step of their lattice.
    pub step: f64,
    /// Deviation of the noise beside the rounding.
    pub noise: f64,
}

/// Ways of a cut: towards zero, down, up.
const WAYS: [fn(f64) -> f64; 3] = [f64::signum, |_| 1.0, |_| -1.0];

impl Coarse<'_> {
    /// Share of the readings that no way of rounding makes of a prediction.
    fn denied(&self, predicted: &[f64]) -> f64 {
        let ways = CUT.into_iter().flat_map(|cut| WAYS.map(|way| (cut, way)));
        let counts = ways.map(|(cut, way)| {
            let each = self.reading.iter().zip(predicted);
            each.filter(|(y, f)| self.is_off(**y, **f, cut, way))
                .count()
        });
        counts.min().unwrap_or(0) as f64 / self.reading.len().max(1) as f64
    }

    fn is_off(&self, reading: f64, predicted: f64, cut: f64, way: fn(f64) -> f64) -> bool {
        // what is cut to nothing comes from either side
        let own = if reading == 0.0 { predicted } else { reading };
        let aside = way(own) * (predicted - reading) / self.step - cut;
        aside.abs() > WITHIN + NOISE * self.noise / self.step
    }

    /// Whether readings deny what is predicted without a cause, and not what is predicted with it.
    pub(super) fn tell(&self, [without, with]: [&[f64]; 2]) -> bool {
        let (without, with) = (self.denied(without), self.denied(with));
        with < SHARE && without - with > SHARE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(size: f64) -> Vec<f64> {
        (0..400)
            .map(|i| size * (0.1 * f64::from(i)).sin())
            .collect()
    }

    fn coarse(reading: &[f64]) -> Coarse<'_> {
        Coarse {
            reading,
            step: 1.0,
            noise: 0.0,
        }
    }

    #[test]
    fn what_is_rounded_or_cut_off_denies_nothing() {
        for size in [2.0, 3.0, 8.0] {
            let plain = ramp(size);
            // a file holds no negative zero
            let ways: [fn(f64) -> f64; 4] = [f64::round, f64::trunc, f64::floor, f64::ceil];
            for way in ways {
                let reading: Vec<f64> = plain.iter().map(|x| way(*x) + 0.0).collect();
                assert!(coarse(&reading).denied(&plain) < 0.01, "{size}");
                assert!(!coarse(&reading).tell([&plain, &reading]));
            }
        }
    }

    #[test]
    fn a_gap_of_nearly_two_steps_is_told_through_them() {
        let plain = ramp(8.0);
        let open: Vec<f64> = plain.iter().map(|x| x + 0.9 * x.signum()).collect();
        let reading: Vec<f64> = open.iter().map(|x| x.round()).collect();
        let straight: Vec<f64> = plain.iter().map(|x| 1.05 * x).collect();
        assert!(coarse(&reading).tell([&straight, &open]));
        assert!(!coarse(&reading).tell([&straight, &straight]));
    }
}
