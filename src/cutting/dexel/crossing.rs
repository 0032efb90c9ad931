//! Where a line enters the material, between an end inside and one outside.
//!
//! Depths are distances to the nearest surface. Where a line meets one surface they change evenly along it, and their zero lies
//! where a straight line through both ends has it. Where a wall stands beside the surface (the corner that an earlier
//! depth left), the end outside knows the wall alone, and that straight line comes out far beyond the surface.

/// How far a depth may be from that of a straight line, as a share of its length: of the force of a cut ten rings deep that is three
/// parts in ten thousand.
const STRAIGHT: f64 = 0.003;
/// Halvings, until both places from which the zero is told lie beyond the wall: to a sixteenth.
const HALVINGS: usize = 4;

/// Depths of both ends as they would be if they changed evenly along the line: their zero is where `depth` (of the share of
/// the line, m) has it. `length`: of the line, m.
pub(super) fn straightened(ends: [f64; 2], length: f64, depth: impl Fn(f64) -> f64) -> [f64; 2] {
    let even = ends[0] / (ends[0] - ends[1]);
    let is_even = |share: f64| {
        let told = ends[0] + share * (ends[1] - ends[0]);
        (depth(share) - told).abs() < STRAIGHT * length
    };
    // a wall that is touched is nearly none from end to end: the zero alone does not tell
    let halfway = if even > 0.5 {
        0.5 * even
    } else {
        0.5 + 0.5 * even
    };
    if is_even(even) && is_even(halfway) {
        return ends;
    }
    match ends[0] > 0.0 {
        true => {
            let zero = border(ends[0], length, depth);
            [ends[0], -ends[0] * (1.0 - zero) / zero]
        }
        false => {
            let zero = border(ends[1], length, |share| depth(1.0 - share));
            [-ends[1] * (1.0 - zero) / zero, ends[1]]
        }
    }
}

/// Share of a line of some `length` that begins `inside` (both m) at which it leaves: halved, then as the depth falls inside.
fn border(inside: f64, length: f64, depth: impl Fn(f64) -> f64) -> f64 {
    let [mut low, mut high] = [(0.0, inside), (1.0, 0.0)];
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low.0 + high.0);
        let here = depth(middle);
        match here > 0.0 {
            true => low = (middle, here),
            false => high = (middle, here),
        }
    }
    // from the last place inside, at the slope of its way
    let (from, fallen) = match low.0 > 0.0 {
        true => (low, inside - low.1),
        false => {
            let half = 0.5 * high.0;
            let here = depth(half);
            // hardly in at all: no surface is nearer than the depth, and one straight across lies there
            if here <= 0.0 {
                return (inside / length).min(half);
            }
            ((half, here), inside - here)
        }
    };
    let slope = fallen / from.0;
    let told = from.0 + from.1 / slope;
    match slope > 0.0 && told.is_finite() {
        true => told.clamp(from.0, high.0),
        false => 0.5 * (from.0 + high.0),
    }
}

#[cfg(test)]
mod tests {
    use super::straightened;

    fn zero([a, b]: [f64; 2]) -> f64 {
        a / (a - b)
    }

    #[test]
    fn an_even_depth_is_as_it_was() {
        let ends = straightened([0.1, -0.3], 0.4, |t| 0.1 - 0.4 * t);
        assert!((ends[1] + 0.3).abs() < 1e-12);
    }

    #[test]
    fn a_wall_beside_the_surface_does_not_move_it() {
        for (surface, wall) in [
            (0.1, 0.05),
            (0.37, 0.01),
            (0.02, 0.001),
            (0.1, 1e-9),
            (0.001, 0.05),
        ] {
            let depth = |t: f64| (surface - 0.4 * t).max(-wall);
            let ends = straightened([depth(0.0), depth(1.0)], 0.4, depth);
            assert!(
                (zero(ends) - surface / 0.4).abs() < 1e-3,
                "{surface} {wall}"
            );
            let turned = |t: f64| depth(1.0 - t);
            let ends = straightened([turned(0.0), turned(1.0)], 0.4, turned);
            assert!((1.0 - zero(ends) - surface / 0.4).abs() < 1e-3);
        }
    }
}
