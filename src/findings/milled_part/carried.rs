//! What carries the tool in a simulated part, and why.

/// What carries it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Carried {
    /// Springs: the robot hardly swings.
    BySprings,
    /// Springs: it is simulated to swing, and the part shows none of it.
    AtRest,
    /// Springs: it swings, in a job too long for trials coupled in time.
    Unheard,
    /// Springs: coupled in time robot and cut drive one another until the job cannot go on, and the part was milled.
    Away,
    /// Robot and cut coupled in time.
    InTime,
}

impl Carried {
    /// What the reader should know.
    pub fn remark(self) -> Option<&'static str> {
        match self {
            Self::BySprings | Self::InTime => None,
            Self::AtRest => Some(
                "The robot is simulated to swing by its dampings, and the part shows nothing of it: springs alone carry the tool here. Dampings from hammer tests (`ident damping --frf`) would tell whether it swings.",
            ),
            Self::Unheard => Some(
                "The robot swings, but the job is too long to be milled again and again in time: springs and gaps are told from what they do at rest.",
            ),
            Self::Away => Some(
                "Coupled in time robot and cut drive one another (chatter) until the job cannot go on, and yet the part was milled: springs alone carry the tool here. Dampings from hammer tests (`ident damping --frf`) would tell whether it chatters.",
            ),
        }
    }
}
