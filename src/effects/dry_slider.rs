use super::contract::{Card, Family, Law, Parameter, Role, Scale};
use super::scene::Scene;
use super::shapes::Stop;
use crate::ground::dual::Scalar;

/// A stuck spring and a dry slider without clearance, under imposed displacement.
pub struct DrySlider;

impl Law for DrySlider {
    const CARD: Card = Card {
        name: "dry_slider",
        cause: "coulomb_friction",
        family: Family::Physics,
        summary: "A dry slider: the stuck spring, then slip at constant friction.",
        equation: "F += friction · S_r(x)/r, S_r = stop operator, r = stick; x = imposed displacement",
        source: "Jenkins 1962",
        signature: "a parallelogram of force over imposed displacement",
        parameters: &[
            Parameter {
                name: "friction",
                meaning: "force at which the slider slips",
                scale: Scale::Deflection,
                bounds: (0.0, 3.0),
                grid: &[0.3],
            },
            Parameter {
                name: "stick",
                meaning: "displacement from reversal to slip, halved: friction over the stiffness of the stuck branch",
                scale: Scale::Load,
                bounds: (1e-3, 1.0),
                grid: &[0.02, 0.08, 0.25],
            },
        ],
    };
    const ROLE: Role = Role::Imposed;

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (friction, stick) = (p[0], p[1]);
        let mut stop = Stop::turned(&scene.load, stick);
        let mut before = scene.load.first().copied().unwrap_or(0.0);
        for (force, x) in out.iter_mut().zip(&scene.load) {
            *force += friction * stop.advance(x - before, stick) / stick;
            before = *x;
        }
    }
}
