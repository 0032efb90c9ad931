//! What is uncertain about a robot under a hammer, and what it does to the accelerance of its tool: bodies,
//! springs and dampers, gains, mounting, angle of the hits. Each uncertain number is counted in its own
//! standard deviations; slopes are exact, but that those of bodies and springs leave out what hits beside their aim
//! turn, a percent of them.

pub mod bodies;
pub mod instrument;
pub mod slopes;

use crate::measurement::hammer_known;

/// How well bodies and instruments of a test are known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known {
    /// The bodies of the robot.
    pub bodies: bodies::Spread,
    /// Hammer and sensor.
    pub instrument: instrument::Spread,
}

impl Known {
    /// As a test states it.
    pub fn stated(by: hammer_known::Known) -> Self {
        Self {
            bodies: bodies::Spread {
                mass: by.mass_rel_std,
                centre_m: by.com_std_m,
                inertia: by.inertia_rel_std,
            },
            instrument: instrument::Spread::calibrated(by.gain_rel_std),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::spatial::{add, cross};
    use crate::motion::frf::{C64, Response};
    use crate::motion::receptance::{accelerance, coordinates, under_moments};
    use crate::motion::{Linear, Work, elastic, linearise};
    use instrument::Reading;
    use slopes::{of_entries, of_masses, whole};

    fn laboratory() -> Known {
        Known::stated(hammer_known::Known::default())
    }

    fn robot() -> (crate::robot::Robot, Vec<f64>) {
        let name = crate::robot::builtin::BUILTINS[0].0;
        let robot = crate::robot::load::load(name, None).unwrap().robot;
        let angles = elastic(&robot).spread(&[0.3, -1.2, 1.7, 0.5, 0.8, 0.2]);
        (robot, angles)
    }

    fn response(linear: &Linear, s: C64) -> (Vec<[C64; 3]>, Response) {
        let answers = coordinates(linear, &[s]);
        let a = accelerance(linear, &answers, s);
        (answers, a)
    }

    /// The robot under the hammer at one line: the accelerance, and the acceleration under moments.
    fn struck() -> (Linear, C64, Response, Response) {
        let (robot, angles) = robot();
        let chain = elastic(&robot);
        let linear = linearise(&chain, &mut Work::new(&chain), &angles).unwrap();
        let s = C64::new(1.2, 70.0);
        let (answers, a) = response(&linear, s);
        let b = under_moments(&linear, &answers, s);
        (linear, s, a, b)
    }

    fn near(found: &Response, a: &Response, b: &Response, step: f64, size: f64) {
        for (i, j) in slopes::UPPER {
            let wanted = (a[i][j] - b[i][j]) / step;
            let off = (found[i][j] - wanted).norm();
            assert!(off < 1e-5 * size, "{i}{j} {off} {size}");
        }
    }

    #[test]
    fn slopes_in_bodies_springs_and_dampers_equal_differences() {
        let (robot, angles) = robot();
        let chain = elastic(&robot);
        let linear = linearise(&chain, &mut Work::new(&chain), &angles).unwrap();
        let s = C64::new(1.2, 70.0);
        let (answers, _) = response(&linear, s);
        let bodies = bodies::directions(&robot, &angles, &laboratory().bodies).unwrap();
        assert_eq!(bodies.nrows(), 7 * bodies::NUMBERS);
        let all = of_masses(&bodies, (&answers, linear.n), &[s]);
        for number in (0..bodies.nrows()).step_by(3) {
            let moved = |by: f64| {
                let mut moved = linear.clone();
                let amounts = (0..bodies.nrows()).map(|i| f64::from(u8::from(i == number)) * by);
                bodies::add(&mut moved.mass, &bodies, amounts);
                response(&moved, s).1
            };
            let slope = whole(&all[number][0]);
            let size = slope.iter().flatten().map(|x| x.norm()).fold(0.0, f64::max);
            near(&slope, &moved(1e-3), &moved(-1e-3), 2e-3, size.max(1e-9));
        }
        for (factor, power) in [(C64::new(1.0, 0.0), 0), (s, 1)] {
            let of = of_entries(&[(4, 4, 1.0)], |_| factor, (&answers, linear.n), &[s]);
            let moved = |by: f64| {
                let mut moved = linear.clone();
                let at = 4 * linear.n + 4;
                match power {
                    0 => moved.stiffness[at] += by,
                    _ => moved.damping[at] += by,
                }
                response(&moved, s).1
            };
            let slope = whole(&of[0]);
            let size = slope.iter().flatten().map(|x| x.norm()).fold(0.0, f64::max);
            near(&slope, &moved(10.0), &moved(-10.0), 20.0, size);
        }
    }

    #[test]
    fn slopes_in_the_instrument_equal_differences() {
        let (_, s, a, b) = struck();
        let (spread, size) = (laboratory().instrument, a[0][0].norm());
        let at = |number: usize, by: f64| {
            let amounts = (0..instrument::NUMBERS).map(move |i| {
                let own = 0.3 * (i as f64 - 6.0);
                own + f64::from(u8::from(i == number)) * by
            });
            Reading::of(amounts, &spread)
        };
        for number in 0..instrument::NUMBERS {
            let both = [&a, &b];
            let slope = at(number, 0.0).slope(number, &spread, s, both);
            let read = |by: f64| at(number, by).read_all(s, both);
            let (up, down) = (read(1e-3), read(-1e-3));
            near(&slope, &up, &down, 2e-3, size);
        }
    }

    /// Hit and read at two points, each with its own Jacobian: J′ = J + ω × r.
    #[test]
    fn a_hit_beside_its_aim_is_a_hit_at_that_place() {
        let (linear, s, a, b) = struck();
        let spread = laboratory().instrument;
        for (number, input, other) in [
            (14, 0, 1),
            (15, 0, 2),
            (16, 1, 2),
            (17, 1, 0),
            (18, 2, 0),
            (19, 2, 1),
        ] {
            let amounts = (0..instrument::NUMBERS).map(|i| f64::from(u8::from(i == number)));
            let read = Reading::of(amounts, &spread).read_all(s, [&a, &b]);
            let mut place = [0.0; 3];
            place[other] = spread.place_m;
            let mut beside = linear.clone();
            for (lever, turn) in beside.tool.iter_mut().zip(&linear.turn) {
                *lever = add(*lever, cross(*turn, place));
            }
            let struck = accelerance(&linear, &coordinates(&beside, &[s]), s);
            for (found, wanted) in read.iter().zip(&struck) {
                assert!((found[input] - wanted[input]).norm() < 1e-9 * a[0][0].norm());
            }
        }
    }

    #[test]
    fn a_heavier_link_adds_what_its_direction_says() {
        let (mut robot, angles) = robot();
        let spread = bodies::Spread {
            mass: 0.02,
            centre_m: 0.005,
            inertia: 0.05,
        };
        let directions = bodies::directions(&robot, &angles, &spread).unwrap();
        let of = |robot: &crate::robot::Robot| {
            let chain = elastic(robot);
            linearise(&chain, &mut Work::new(&chain), &angles)
                .unwrap()
                .mass
        };
        let mut wanted = of(&robot);
        let amounts = (0..directions.nrows()).map(|i| if i == 10 { 3.0 } else { 0.0 });
        bodies::add(&mut wanted, &directions, amounts);
        let body = robot.joints[1].link.as_mut().unwrap();
        body.mass *= 1.06;
        body.inertia.iter_mut().for_each(|i| *i *= 1.06);
        for (a, b) in of(&robot).iter().zip(&wanted) {
            assert!((a - b).abs() < 1e-9 * wanted[0].abs(), "{a} {b}");
        }
    }
}
