//! Units as they are written in column names and front matter, and their factors to SI.

/// Farthest that a coordinate of a path or a place of a robot may lie, m: farther ones are a
/// slip of the unit or the exponent. A choice: ten kilometres.
pub const FARTHEST_M: f64 = 1e4;
/// Farthest that anything lies on a robot, m: robots reach some metres, and some stand on rails. A choice; beyond, millimetres
/// were meant.
pub const ON_A_ROBOT_M: f64 = 20.0;

/// What a unit measures; two units of one dimension convert into each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Dimension {
    /// s
    Time,
    /// N
    Force,
    /// N·m
    Moment,
    /// m
    Length,
    /// rad
    Angle,
    /// m/s
    Speed,
    /// rad/s
    AngularSpeed,
    /// m/s²
    Acceleration,
    /// Hz
    Frequency,
    /// K above 0 °C
    Temperature,
}

impl std::fmt::Display for Dimension {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Time => "time",
            Self::Force => "force",
            Self::Moment => "moment",
            Self::Length => "length",
            Self::Angle => "angle",
            Self::Speed => "speed",
            Self::AngularSpeed => "angular speed",
            Self::Acceleration => "acceleration",
            Self::Frequency => "frequency",
            Self::Temperature => "temperature",
        })
    }
}

/// One unit: its spelling in a name, its dimension, its size in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Spelling as in `force_kN`, without the underscore.
    pub name: &'static str,
    /// What it measures.
    pub dimension: Dimension,
    /// Value in SI = factor · value in this unit.
    pub factor: f64,
}

const fn unit(name: &'static str, dimension: Dimension, factor: f64) -> Unit {
    Unit {
        name,
        dimension,
        factor,
    }
}

/// Degrees to radians.
pub const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Every unit that a column name may end in. A new unit is one line here.
pub const UNITS: &[Unit] = &[
    unit("s", Dimension::Time, 1.0),
    unit("ms", Dimension::Time, 1e-3),
    unit("us", Dimension::Time, 1e-6),
    unit("min", Dimension::Time, 60.0),
    unit("N", Dimension::Force, 1.0),
    unit("kN", Dimension::Force, 1e3),
    unit("Nm", Dimension::Moment, 1.0),
    unit("kNm", Dimension::Moment, 1e3),
    unit("Nmm", Dimension::Moment, 1e-3),
    unit("m", Dimension::Length, 1.0),
    unit("cm", Dimension::Length, 1e-2),
    unit("mm", Dimension::Length, 1e-3),
    unit("um", Dimension::Length, 1e-6),
    unit("in", Dimension::Length, 0.0254),
    unit("rad", Dimension::Angle, 1.0),
    unit("mrad", Dimension::Angle, 1e-3),
    unit("urad", Dimension::Angle, 1e-6),
    unit("deg", Dimension::Angle, DEGREE),
    unit("m_s", Dimension::Speed, 1.0),
    unit("mm_s", Dimension::Speed, 1e-3),
    unit("mm_min", Dimension::Speed, 1e-3 / 60.0),
    unit("rad_s", Dimension::AngularSpeed, 1.0),
    unit("deg_s", Dimension::AngularSpeed, DEGREE),
    unit("m_s2", Dimension::Acceleration, 1.0),
    unit("g", Dimension::Acceleration, 9.806_65),
    unit("Hz", Dimension::Frequency, 1.0),
    unit("degC", Dimension::Temperature, 1.0),
];

/// Splits `force_kN` into (`force`, kN). A trailing joint index is kept with the stem:
/// `motor_angle_deg_2` is (`motor_angle_2`, deg). The longest unit wins (`ax_m_s2` is m/s²).
pub fn split_name(name: &str) -> Option<(String, Unit)> {
    if let Some(found) = split_suffix(name) {
        return Some((found.0.to_string(), found.1));
    }
    let (head, index) = name.rsplit_once('_')?;
    if index.is_empty() || !index.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let (stem, unit) = split_suffix(head)?;
    Some((format!("{stem}_{index}"), unit))
}

fn split_suffix(name: &str) -> Option<(&str, Unit)> {
    UNITS
        .iter()
        .filter_map(|unit| {
            let stem = name.strip_suffix(unit.name)?.strip_suffix('_')?;
            (!stem.is_empty()).then_some((stem, *unit))
        })
        .max_by_key(|(_, unit)| unit.name.len())
}

/// All unit spellings, for messages.
pub fn known_units() -> String {
    UNITS.iter().map(|u| u.name).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn longest_suffix_wins() {
        assert_eq!(split_name("ax_m_s2").unwrap().1.name, "m_s2");
        assert_eq!(split_name("displacement_mm").unwrap().0, "displacement");
        assert_eq!(split_name("motor_angle_deg_2").unwrap().0, "motor_angle_2");
        assert_eq!(split_name("motor_speed_deg_s_1").unwrap().1.name, "deg_s");
        assert!(split_name("force").is_none());
        assert!(split_name("force_lbf").is_none());
    }
}
