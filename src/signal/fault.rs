//! What can be wrong with a hit, as a sentence.

use std::fmt;

/// One fault of one hit.
#[derive(Debug, Clone, PartialEq)]
pub enum Fault {
    /// Nothing in the force record stands clear of its noise.
    NoPulse,
    /// The record begins inside the pulse.
    CutPulse,
    /// A second pulse.
    DoubleHit {
        /// Time after the main pulse, s.
        after_s: f64,
        /// Height as a share of the main pulse.
        share: f64,
    },
    /// The force is cut off at its highest value.
    ForceOverload {
        /// That value, N.
        at: f64,
    },
    /// A response is cut off.
    ResponseOverload {
        /// Index of the response.
        output: usize,
    },
    /// The pulse is too long to excite the upper end of the band.
    LowEnergy {
        /// Force spectrum there, dB against its low end.
        level_db: f64,
        /// Where, Hz.
        from_hz: f64,
    },
    /// The force does not stand clear of the noise at the upper end of the band.
    BuriedForce {
        /// Where, Hz.
        from_hz: f64,
    },
    /// A sample that no hammer and no accelerometer gives.
    Beyond {
        /// Index of the response; none: the force.
        output: Option<usize>,
        /// The sample, N or m/s².
        value: f64,
    },
    /// Much shorter than the other records of the test.
    ShortRecord {
        /// Its length, s.
        length_s: f64,
        /// Length of the others, s.
        others_s: f64,
    },
    /// The response is that of a force in another direction.
    OffAxis {
        /// Angle between the force and its stated direction, rad.
        angle: f64,
    },
    /// Far harder or softer than the other hits in its direction.
    Level {
        /// Peak over the median peak.
        ratio: f64,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPulse => write!(f, "no force pulse above the noise"),
            Self::CutPulse => write!(f, "the record begins inside the pulse"),
            Self::DoubleHit { after_s, share } => {
                let (ms, percent) = (after_s * 1e3, share * 100.0);
                write!(
                    f,
                    "double hit: second pulse of {percent:.0} % at {ms:+.1} ms"
                )
            }
            Self::ForceOverload { at } => write!(f, "overload: force cut off at {at:.2} N"),
            Self::ResponseOverload { output } => {
                write!(f, "overload: response {} cut off", output + 1)
            }
            Self::LowEnergy { level_db, from_hz } => write!(
                f,
                "too little energy above {from_hz:.0} Hz: {level_db:.0} dB against the low end"
            ),
            Self::BuriedForce { from_hz } => {
                write!(
                    f,
                    "too little energy above {from_hz:.0} Hz: force within its noise"
                )
            }
            Self::Beyond {
                output: None,
                value,
            } => {
                write!(f, "a force sample of {value:.1e} N, which no hammer gives")
            }
            Self::Beyond {
                output: Some(output),
                value,
            } => write!(
                f,
                "a sample of {value:.1e} m/s² in response {}, beyond any accelerometer",
                output + 1
            ),
            Self::ShortRecord { length_s, others_s } => {
                write!(
                    f,
                    "record too short: {length_s:.3} s, the others {others_s:.3} s"
                )
            }
            Self::OffAxis { angle } => {
                write!(
                    f,
                    "off-axis force: {:.0} deg from its direction",
                    angle.to_degrees()
                )
            }
            Self::Level { ratio } => {
                write!(f, "level out of family: {ratio:.2} times the median peak")
            }
        }
    }
}
