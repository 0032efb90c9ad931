//! The codes that are understood, in tenths: 911 is G91.1.

use super::Motion;
use super::arc::Plane;

/// What a code does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Act {
    Motion(Motion),
    Plane(Plane),
    /// m per unit.
    Unit(f64),
    Relative(bool),
    AbsoluteCentres(bool),
    PerTurn(bool),
    Offset(i32),
    /// The axis words of its block are a place of the machine, not of the path.
    Away,
    /// Spindle: clockwise, counter-clockwise, off.
    Sense(f64),
    End,
    PassedOver,
    Refused,
}

/// Codes that are not here are refused.
pub(super) const G_CODES: &[(i32, Act)] = &[
    (0, Act::Motion(Motion::Rapid)),
    (10, Act::Motion(Motion::Line)),
    (20, Act::Motion(Motion::Clockwise)),
    (30, Act::Motion(Motion::Counter)),
    (40, Act::Away),
    (90, Act::PassedOver),
    (170, Act::Plane(Plane::XY)),
    (180, Act::Plane(Plane::ZX)),
    (190, Act::Plane(Plane::YZ)),
    (200, Act::Unit(0.0254)),
    (210, Act::Unit(1e-3)),
    (700, Act::Unit(0.0254)),
    (710, Act::Unit(1e-3)),
    (280, Act::Away),
    (300, Act::Away),
    (530, Act::Away),
    (400, Act::PassedOver),
    (430, Act::PassedOver),
    (490, Act::PassedOver),
    (500, Act::PassedOver),
    (540, Act::Offset(54)),
    (550, Act::Offset(55)),
    (560, Act::Offset(56)),
    (570, Act::Offset(57)),
    (580, Act::Offset(58)),
    (590, Act::Offset(59)),
    (610, Act::PassedOver),
    (611, Act::PassedOver),
    (640, Act::PassedOver),
    (690, Act::PassedOver),
    (800, Act::PassedOver),
    (900, Act::Relative(false)),
    (910, Act::Relative(true)),
    (901, Act::AbsoluteCentres(true)),
    (911, Act::AbsoluteCentres(false)),
    (921, Act::PassedOver),
    (940, Act::PerTurn(false)),
    (950, Act::PerTurn(true)),
    (970, Act::PassedOver),
    (980, Act::PassedOver),
    (990, Act::PassedOver),
];

/// Codes that are not here have no effect on the path.
pub(super) const M_CODES: &[(i32, Act)] = &[
    (20, Act::End),
    (300, Act::End),
    (30, Act::Sense(1.0)),
    (40, Act::Sense(-1.0)),
    (50, Act::Sense(0.0)),
    (970, Act::Refused),
    (980, Act::Refused),
    (990, Act::Refused),
];
