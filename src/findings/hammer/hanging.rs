//! What hangs at the tool and has no name in the library.

use super::point::Point;

/// What nobody may name in a set, in words; none where everything has a name.
pub fn hanging(point: &Point) -> Option<String> {
    let each = point.each().into_iter();
    let (outside, amounts) = each.into_iter().find(|(own, _)| !own.is_named())?;
    let said = outside
        .cause
        .said(&crate::robot::Robot::default(), &outside.site, &amounts);
    let of = |name: &str| said.iter().find(|own| own.0 == name).map(|own| own.1);
    let (mass, frequency) = (of("mass")?, of("frequency")?);
    Some(format!(
        "what a body of {mass:.2} kg would show that hangs at the {} by springs of its own and swings at {frequency:.1} Hz: look for what is \
         mounted there and not in the robot file, and strike it",
        outside.site
    ))
}
