use super::contract::{Card, Family, Law, Parameter, Role, Scale};
use super::scene::Scene;
use super::shapes::Stop;
use crate::ground::dual::Scalar;

/// A gap in series with a stuck spring and a dry slider, under imposed displacement.
///
/// The ports are swapped here: the scene's load is the displacement, the response is the force.
pub struct ClearanceSlider;

impl Law for ClearanceSlider {
    const CARD: Card = Card {
        name: "clearance_slider",
        cause: "coulomb_friction",
        family: Family::Physics,
        summary: "A dry slider behind a clearance: nothing, then the stuck spring, then slip at constant friction.",
        equation: "F += friction · dz(e, gap/2)/stick, e = S_r(x) stop operator with r = stick + gap/2, dz = dead zone",
        source: "Jenkins 1962 with a gap in series; derived here",
        signature: "a parallelogram of force over imposed displacement with a flat step at zero force after each reversal",
        parameters: &[
            Parameter {
                name: "friction",
                meaning: "force at which the slider slips",
                scale: Scale::Deflection,
                bounds: (0.0, 3.0),
                grid: &[0.3],
            },
            Parameter {
                name: "gap",
                meaning: "total clearance that is crossed without force",
                scale: Scale::Load,
                bounds: (0.0, 1.0),
                grid: &[0.02, 0.1, 0.25],
            },
            Parameter {
                name: "stick",
                meaning: "displacement from contact to slip: friction over the stiffness of the stuck branch",
                scale: Scale::Load,
                bounds: (1e-3, 1.0),
                grid: &[0.02, 0.08, 0.25],
            },
        ],
    };
    const ROLE: Role = Role::Imposed;

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (friction, half, stick) = (p[0], p[1] * 0.5, p[2]);
        let mut stop = Stop::turned(&scene.load, stick + half);
        let mut before = scene.load.first().copied().unwrap_or(0.0);
        for (force, x) in out.iter_mut().zip(&scene.load) {
            let e = stop.advance(x - before, stick + half);
            before = *x;
            let zero = S::constant(0.0);
            let contact = (e - half).max(zero) + (e + half).min(zero);
            *force += friction * contact / stick;
        }
    }
}
