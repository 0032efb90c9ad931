//! What the targets can show of an error that repeats with every turn of the screw: nothing where they are
//! whole turns apart, hardly more than a wrong pitch where they are nearly so.

use nalgebra::DMatrix;

/// How well a sine of once per turn stands out of a straight line at the targets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sight {
    /// The pitch is not stated.
    NoPitch,
    /// Not at all: a line and a wave go through so few targets.
    Few,
    /// Not at all: every target lies at the same angle of the screw.
    Blind,
    /// Hardly: sine of the angle between it and the straight lines.
    Dim(f64),
    /// Well enough.
    Clear,
}

/// Targets that a straight line and a wave go through.
const FEW: usize = 4;
/// Sine of the angle below which a sine is nearly a straight line.
const DIM: f64 = 0.3;
/// Below this nothing is left of it but rounding.
const BLIND: f64 = 1e-3;

impl Sight {
    /// At targets (m) of a screw with this pitch (m).
    pub fn of(at: &[f64], pitch: Option<f64>) -> Self {
        let Some(pitch) = pitch else {
            return Self::NoPitch;
        };
        match sine(at, pitch) {
            _ if at.len() <= FEW => Self::Few,
            s if s < BLIND => Self::Blind,
            s if s < DIM => Self::Dim(s),
            _ => Self::Clear,
        }
    }

    /// The sentence for the reader, where there is something to say.
    pub fn sentence(&self) -> Option<String> {
        match self {
            Self::Clear => None,
            Self::NoPitch => Some("without `pitch_mm` nothing is said about an error once per turn of the screw".into()),
            Self::Few => Some("so few targets cannot show an error once per turn of the screw: five are the least (ISO 230-2)".into()),
            Self::Blind => Some("the targets are whole turns of the screw apart: they cannot show an error once per turn; choose targets off the pitch (ISO 230-2), say at 0.38 of a turn more each".into()),
            Self::Dim(s) => Some(format!("the targets are nearly whole turns of the screw apart: an error once per turn looks like a wrong pitch (sine of the angle {s:.3}); choose targets off the pitch (ISO 230-2)")),
        }
    }
}

/// The smaller sine of the angles between cos and sin of the turn and the straight lines over the targets:
/// size of what is left of the worst phase when a line is taken out, over the size it has at targets spread
/// over all angles.
fn sine(at: &[f64], pitch: f64) -> f64 {
    let n = at.len();
    let middle = at.iter().sum::<f64>() / n as f64;
    let span = at
        .iter()
        .map(|x| (x - middle).abs())
        .fold(f64::MIN_POSITIVE, f64::max);
    let line = DMatrix::from_fn(
        n,
        2,
        |i, j| if j == 0 { 1.0 } else { (at[i] - middle) / span },
    );
    let turn = |i: usize| std::f64::consts::TAU * (at[i] - at[0]) / pitch;
    let wave = DMatrix::from_fn(
        n,
        2,
        |i, j| if j == 0 { turn(i).cos() } else { turn(i).sin() },
    );
    let q = line.qr().q();
    let rest = &wave - &q * (q.transpose() * &wave);
    let smallest = rest.singular_values().min();
    smallest / (0.5 * n as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(step_mm: f64) -> Vec<f64> {
        (0..73)
            .map(|i| 1e-3 * (-41.0 + step_mm * f64::from(i)))
            .collect()
    }

    #[test]
    fn whole_turns_are_blind_and_nearly_whole_ones_dim() {
        let pitch = Some(5.08e-3);
        assert_eq!(Sight::of(&at(5.08), pitch), Sight::Blind);
        assert_eq!(Sight::of(&at(10.16), pitch), Sight::Blind);
        assert!(matches!(Sight::of(&at(367.0 / 72.0), pitch), Sight::Dim(_)));
        assert_eq!(Sight::of(&at(7.0), pitch), Sight::Clear);
        assert_eq!(Sight::of(&at(5.08), None), Sight::NoPitch);
    }
}
