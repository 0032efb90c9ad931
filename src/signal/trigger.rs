//! Hits in one long record.

use super::outliers::median;
use super::pulse::spread;
use std::ops::Range;

/// How hits are found in a continuous record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trigger {
    /// Share of the highest force above which a pulse begins.
    pub level: f64,
    /// Time kept before each pulse, s.
    pub pretrigger_s: f64,
    /// Pulses closer than this belong to one hit (and make it a double hit), s.
    pub refractory_s: f64,
}

impl Default for Trigger {
    fn default() -> Self {
        Self {
            level: 0.1,
            pretrigger_s: 0.05,
            refractory_s: 0.25,
        }
    }
}

impl Trigger {
    /// Sample ranges, one per hit, of equal length but for a last one that the record cuts short; none
    /// holds the start of the next hit.
    pub fn segments(&self, force: &[f64], interval_s: f64) -> Vec<Range<usize>> {
        let samples = |seconds: f64| (seconds / interval_s).round() as usize;
        let onsets = self.onsets(force, samples(self.refractory_s));
        let before = samples(self.pretrigger_s);
        let Some(length) = common_length(&onsets, before, force.len()) else {
            return Vec::new();
        };
        let starts = onsets.iter().map(|onset| onset.saturating_sub(before));
        starts
            .map(|start| start..(start + length).min(force.len()))
            .collect()
    }

    fn onsets(&self, force: &[f64], refractory: usize) -> Vec<usize> {
        let middle = median(force);
        let away = |i: usize| (force[i] - middle).abs();
        let highest = (0..force.len()).map(away).fold(0.0, f64::max);
        let level = (self.level * highest).max(10.0 * spread(force, middle));
        let mut onsets: Vec<usize> = Vec::new();
        let mut last = None;
        for i in (0..force.len()).filter(|i| away(*i) > level) {
            if last.is_none_or(|last| i - last > refractory) {
                onsets.push(i);
            }
            last = Some(i);
        }
        onsets
    }
}

/// The longest length that fits between every two onsets, and after the last if that costs the
/// others no more than a fifth.
fn common_length(onsets: &[usize], before: usize, end: usize) -> Option<usize> {
    let last = end + before.min(*onsets.last()?) - onsets.last()?;
    let gaps = onsets.windows(2).map(|pair| pair[1] - pair[0]).min();
    Some(match gaps {
        Some(gap) if last < gap * 4 / 5 => gap,
        Some(gap) => gap.min(last),
        None => last,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cuts_equal_segments_and_keeps_double_hits_together() {
        let mut force = vec![0.0; 10_000];
        for i in [1000, 1080, 4000, 7000] {
            force[i] = 100.0;
        }
        let segments = Trigger::default().segments(&force, 1e-3);
        assert_eq!(segments, [950..3950, 3950..6950, 6950..9950]);
        let cut = Trigger::default().segments(&force[..8000], 1e-3);
        assert_eq!(cut, [950..3950, 3950..6950, 6950..8000]);
        assert!(Trigger::default().segments(&[0.0; 100], 1e-3).is_empty());
    }
}
