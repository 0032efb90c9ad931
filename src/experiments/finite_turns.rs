//! What a force does beyond proportion because springs turn by finite angles: the arm of the force turns
//! with them, so that the displacement has an even part in the force (millimetres over a metre: per mille).

use crate::ground::spatial::{V3, add, dot, norm, scale, sub};
use crate::motion::kinematics::{column, place, tcp};
use crate::motion::statics::springs;
use crate::motion::{Work, elastic};
use crate::robot::Robot;

/// Displacement of the tool at one point under a force along one direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Curve {
    /// m/N²
    even: V3,
    /// m/N³
    odd: V3,
}

/// Displacements beyond proportion, by point and direction of the force.
#[derive(Debug, Clone)]
pub struct FiniteTurns {
    curves: Vec<[Curve; 3]>,
}

/// Turns are solved for so many times with the arm that the last ones gave.
const ROUNDS: usize = 4;

impl FiniteTurns {
    /// Of a robot at the joint angles of each point, rad; `largest` is an ordinary force, N.
    pub fn of(robot: &Robot, points: &[Vec<f64>], largest: f64) -> Self {
        let chain = elastic(robot);
        let mut work = Work::new(&chain);
        let mut moved = |q: &[f64], force: V3| -> V3 {
            place(&chain, &mut work, q);
            let start = tcp(&chain, &work).point;
            let mut turned = q.to_vec();
            for _ in 0..ROUNDS {
                let at = tcp(&chain, &work).point;
                for (i, spring) in springs(&chain) {
                    turned[i] = q[i] + dot(column(&work, i, at).0, force) / spring.stiffness;
                }
                place(&chain, &mut work, &turned);
            }
            sub(tcp(&chain, &work).point, start)
        };
        let mut curve = |q: &[f64], direction: usize| {
            let along =
                |f: f64| -> V3 { std::array::from_fn(|k| if k == direction { f } else { 0.0 }) };
            // a thousandth of the force shows the slope
            let small = 1e-3 * largest;
            let [plus, minus, more, less] =
                [largest, -largest, small, -small].map(|f| moved(q, along(f)));
            let slope = scale(0.5 / small, sub(more, less));
            let odd = sub(scale(0.5, sub(plus, minus)), scale(largest, slope));
            Curve {
                even: scale(0.5 / largest.powi(2), add(plus, minus)),
                odd: scale(largest.powi(-3), odd),
            }
        };
        let at = |angles: &Vec<f64>| {
            let q = chain.spread(angles);
            [0, 1, 2].map(|direction| match largest > 0.0 {
                true => curve(&q, direction),
                false => Curve::default(),
            })
        };
        Self {
            curves: points.iter().map(at).collect(),
        }
    }

    /// Displacement beyond proportion at a force, m, base frame.
    pub fn beyond(&self, (point, direction): (usize, usize), force: f64) -> V3 {
        let own = &self.curves[point][direction];
        let (even, odd) = (force * force, force.powi(3));
        add(scale(even, own.even), scale(odd, own.odd))
    }

    /// Its size, m.
    pub fn size(&self, place: (usize, usize), force: f64) -> f64 {
        norm(self.beyond(place, force))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::load::load;

    /// Turns of twice the size lie four times as far beyond proportion.
    #[test]
    fn what_lies_beyond_grows_with_the_square_of_the_force() {
        let robot = load("kr210", None).unwrap().robot;
        let points = vec![vec![0.0, -1.2, 1.5, 0.3, 0.8, 0.0]];
        let [half, whole] = [500.0, 1000.0].map(|f| FiniteTurns::of(&robot, &points, f));
        for direction in 0..3 {
            let [a, b] = [&half, &whole].map(|t| t.size((0, direction), 1000.0));
            assert!(
                b > 1e-8 && (a / b - 1.0).abs() < 0.02,
                "{direction}: {a} {b}"
            );
            let four = whole.size((0, direction), 1000.0) / whole.size((0, direction), 500.0);
            assert!((four - 4.0).abs() < 0.1, "{direction}: {four}");
        }
    }
}
