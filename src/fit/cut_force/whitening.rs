//! The noise of the three channels, from what a fit leaves.

use super::CutData;
use crate::ground::spatial::V3;
use crate::signal::autoregression::Autoregression;

/// Most past samples that the colour of the noise spans.
const MOST_ORDER: usize = 12;

/// The noise of each channel.
#[derive(Debug, Clone)]
pub struct Whitening(pub [Autoregression; 3]);

impl Whitening {
    /// White noise of this standard deviation, N.
    pub fn white(deviation: f64) -> Self {
        Self(std::array::from_fn(|_| Autoregression::white(deviation)))
    }

    /// From the residuals of all cuts.
    pub fn of(cuts: &[CutData], residuals: &[Vec<V3>]) -> Self {
        let most = if cuts.iter().all(|cut| cut.scene.step_s().is_some()) {
            MOST_ORDER
        } else {
            0
        };
        let mut lengths: Vec<usize> = cuts
            .iter()
            .flat_map(|c| runs(&c.counts))
            .map(|r| r.len())
            .collect();
        lengths.sort_unstable();
        // of a run the first rows have no past
        let most = most.min(
            lengths
                .get(lengths.len() / 2)
                .map_or(0, |middle| middle / 4),
        );
        let pieces = |k: usize| -> Vec<Vec<f64>> {
            let of_cut = |(cut, left): (&CutData, &Vec<V3>)| {
                let channel: Vec<f64> = left.iter().map(|v| v[k]).collect();
                let runs = runs(&cut.counts);
                runs.map(|run| channel[run].to_vec()).collect::<Vec<_>>()
            };
            cuts.iter().zip(residuals).flat_map(of_cut).collect()
        };
        Self(std::array::from_fn(|k| {
            Autoregression::fit(&pieces(k), most)
        }))
    }

    /// One channel after the other, whitened and put behind each other; nothing where a sample does not count.
    pub fn apply(&self, wave: &[V3], counts: &[bool]) -> Vec<f64> {
        let of = |(k, noise): (usize, &Autoregression)| {
            let mut whitened = vec![0.0; wave.len()];
            for run in runs(counts) {
                let own = &mut whitened[run.clone()];
                own.iter_mut().zip(&wave[run]).for_each(|(w, v)| *w = v[k]);
                noise.whiten(own);
            }
            whitened
        };
        self.0.iter().enumerate().flat_map(of).collect()
    }
}

/// Samples that count, one run of neighbours after the other.
fn runs(counts: &[bool]) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
    let mut from = 0;
    std::iter::from_fn(move || {
        from += counts[from..].iter().position(|c| *c)?;
        let count = counts[from..].iter().take_while(|c| **c).count();
        from += count;
        Some(from - count..from)
    })
}

#[cfg(test)]
mod tests {
    use super::runs;

    #[test]
    fn runs_are_between_what_does_not_count() {
        let all: Vec<_> = runs(&[false, true, true, false, false, true]).collect();
        assert_eq!(all, [1..3, 5..6]);
        assert_eq!(runs(&[false]).count(), 0);
    }
}
