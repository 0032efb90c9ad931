//! The play operator (Krasnosel'skii and Pokrovskii 1989): what follows a drive at a distance.

/// The drive behind a play of this half width, from rest in its middle; in the unit of the drive.
pub fn play(drive: &[f64], half_width: f64) -> Vec<f64> {
    let mut held = 0.0_f64;
    let follow = |u: &f64| {
        held = held.clamp(u - half_width, u + half_width);
        held
    };
    drive.iter().map(follow).collect()
}
