//! Hammer tests: the force outside its pulse.

use super::hammer_screen::ScreenedHit;
use crate::signal::pulse::{self, Pulse};
use crate::signal::window::Force;

/// Which hits get a force window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ForceWindow {
    /// None.
    #[default]
    Never,
    /// Hits whose force shows nothing but noise outside its pulse: that would bias H1 and scatter at
    /// the resonances.
    Quiet,
    /// All.
    Always,
}

impl ForceWindow {
    /// Whether the hit with this `force` gets one.
    pub(super) fn suits(self, force: &[f64], pulse: &Pulse) -> bool {
        match self {
            Self::Never => false,
            Self::Quiet => {
                let kept = Force::around(pulse);
                pulse.quiet_outside(force, kept.start..kept.end)
            }
            Self::Always => true,
        }
    }
}

/// White noise of the force within its window: few samples, so that neighbouring lines share it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceNoise {
    /// Standard deviation of a sample, N.
    pub std: f64,
    /// Standard deviation of the baseline that was taken off, N.
    pub offset_std: f64,
    /// First sample in the window, from the impulse.
    pub from: isize,
    /// First sample after it.
    pub to: isize,
}

/// What the noise of the force does in the windows of `hits`; none unless all have one.
pub(super) fn force_noise(hits: &[&ScreenedHit], window: ForceWindow) -> Option<ForceNoise> {
    if window == ForceWindow::Never {
        return None;
    }
    let one = |hit: &&ScreenedHit| {
        let pulse = Pulse::find(&hit.force)?;
        let kept = Force::around(&pulse);
        let impulse = pulse.centroid(&hit.force).round() as isize;
        let half = kept.flank as isize / 2;
        window.suits(&hit.force, &pulse).then(|| ForceNoise {
            std: pulse.noise,
            offset_std: pulse.noise / (pulse::quiet(pulse.start).max(1) as f64).sqrt(),
            from: (kept.start as isize - half).max(0) - impulse,
            to: (kept.end as isize + half).min(hit.force.len() as isize) - impulse,
        })
    };
    let all: Vec<ForceNoise> = hits.iter().map(one).collect::<Option<_>>()?;
    let rms = |of: fn(&ForceNoise) -> f64| {
        (all.iter().map(|n| of(n).powi(2)).sum::<f64>() / all.len() as f64).sqrt()
    };
    Some(ForceNoise {
        std: rms(|n| n.std),
        offset_std: rms(|n| n.offset_std),
        from: all.iter().map(|n| n.from).min()?,
        to: all.iter().map(|n| n.to).max()?,
    })
}
