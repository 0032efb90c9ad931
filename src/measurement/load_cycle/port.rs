//! What was loaded: a joint that turns, or a linear spring.

/// Whether a joint turns or a linear spring is pressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Port {
    /// Load N·m, deflection rad.
    Rotational,
    /// Load N, deflection m.
    Linear,
}

impl Port {
    /// Unit of the load.
    pub fn load_unit(self) -> &'static str {
        match self {
            Self::Rotational => "N·m",
            Self::Linear => "N",
        }
    }
    /// Unit of the deflection.
    pub fn deflection_unit(self) -> &'static str {
        match self {
            Self::Rotational => "rad",
            Self::Linear => "m",
        }
    }
    /// Unit of the stiffness.
    pub fn stiffness_unit(self) -> &'static str {
        match self {
            Self::Rotational => "N·m/rad",
            Self::Linear => "N/m",
        }
    }
    /// What the load is called.
    pub fn load_name(self) -> &'static str {
        match self {
            Self::Rotational => "Moment",
            Self::Linear => "Force",
        }
    }
    /// What the deflection is called.
    pub fn deflection_name(self) -> &'static str {
        match self {
            Self::Rotational => "Angle",
            Self::Linear => "Displacement",
        }
    }
}

/// Which elasticity of the joint was loaded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// About the drive axis.
    Rotation,
    /// Across it: the bearing.
    Tilt,
}
