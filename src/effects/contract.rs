//! What an effect must bring, and what it gets for it.

use super::scene::Scene;
use crate::ground::dual::{Dual, Scalar};

/// Most parameters that one composite may have (the length of its dual numbers).
pub const MOST: usize = 16;

/// The dual number in which composites are differentiated.
pub type Tangent = Dual<MOST>;

/// Two families, kept apart: a simulation loads only the first, a diagnosis may blame either.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Something the robot does.
    Physics,
    /// Something the instruments do.
    Measurement,
}

impl Family {
    /// As it is printed.
    pub fn name(self) -> &'static str {
        match self {
            Self::Physics => "physics",
            Self::Measurement => "measurement",
        }
    }
}

/// The natural scale of a parameter: bounds and grids are given in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Largest load, N·m or N.
    Load,
    /// Elastic deflection at the largest load, rad or m.
    Deflection,
    /// Stiffness, N·m/rad or N/m.
    Stiffness,
    /// Duration of a cycle, s.
    Period,
    /// Duration of the whole record, s; instants count from its start.
    Duration,
    /// A pure number.
    One,
}

impl Scale {
    /// The size of this scale in SI for a scene.
    pub fn of(self, scene: &Scene) -> f64 {
        match self {
            Self::Load => scene.load_scale,
            Self::Deflection => scene.deflection_scale,
            Self::Stiffness => scene.load_scale / scene.deflection_scale,
            Self::Period => scene.period,
            Self::Duration => scene.duration,
            Self::One => 1.0,
        }
    }
}

/// A parameter of an effect. Bounds and grid are in units of its [`Scale`].
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// Its name, as in reports.
    pub name: &'static str,
    /// The sentence the user reads about it.
    pub meaning: &'static str,
    /// Its natural scale, hence its unit.
    pub scale: Scale,
    /// Lower and upper bound.
    pub bounds: (f64, f64),
    /// Values to start from: the search tries all, the round-trip test draws between them.
    pub grid: &'static [f64],
}

/// Everything about an effect that is not its equation.
#[derive(Debug, Clone, Copy)]
pub struct Card {
    /// Its name on the command line and in models.
    pub name: &'static str,
    /// The cause it counts as in a diagnosis (several laws may describe one cause).
    pub cause: &'static str,
    /// Physics or measurement.
    pub family: Family,
    /// What it is, one sentence.
    pub summary: &'static str,
    /// Its equation, as text.
    pub equation: &'static str,
    /// Author, year, equation.
    pub source: &'static str,
    /// How it looks in load cycles.
    pub signature: &'static str,
    /// Its parameters; the first is the amplitude, in which the response vanishes at zero.
    pub parameters: &'static [Parameter],
}

/// How an effect enters a diagnosis of load cycles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Changes the curve: found by its shape.
    Shape,
    /// Only scales the curve: told apart by a second laser and the stated uncertainties.
    Scale,
    /// Seen in the raw values, not in the curve.
    Lattice,
    /// Answers to an imposed displacement with a force: for tests that move instead of press.
    Imposed,
    /// Part of every model.
    Base,
}

/// A dry contact in the load path: as long as it sticks it holds deflection back. It adds
/// −compliance · S(M), S the stop operator that slips at `slip_load`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Load at which it slips, N·m or N.
    pub slip_load: f64,
    /// What it holds back per load, rad/(N·m) or m/N.
    pub compliance: f64,
}

/// A law, written once over a scalar type.
///
/// Physics *adds* its deflection to `out`; measurement *transforms* what it finds there. `p` holds
/// the parameters in SI, `elastic` the deflection of the linear spring alone.
pub trait Law: Sync {
    /// The card.
    const CARD: Card;
    /// How it enters a diagnosis.
    const ROLE: Role = Role::Shape;

    /// The response, in place.
    fn respond<S: Scalar>(p: &[S], scene: &Scene, elastic: &[S], out: &mut [S]);

    /// The law as dry contacts in the load path, which a joint can carry through time. `None`: the law
    /// is no such sum.
    fn contacts(_p: &[f64]) -> Option<Vec<Contact>> {
        None
    }
}

/// The object-safe face of a [`Law`]: what fits, diagnoses and reports use.
pub trait Effect: Sync {
    /// Its card.
    fn card(&self) -> &'static Card;
    /// How it enters a diagnosis.
    fn role(&self) -> Role;
    /// Response in plain numbers.
    fn respond(&self, p: &[f64], scene: &Scene, elastic: &[f64], out: &mut [f64]);
    /// Response with derivatives.
    fn respond_tangent(
        &self,
        p: &[Tangent],
        scene: &Scene,
        elastic: &[Tangent],
        out: &mut [Tangent],
    );
    /// The law as dry contacts, where it is a sum of them: what a joint carries through time.
    fn contacts(&self, p: &[f64]) -> Option<Vec<Contact>>;
}

impl<L: Law> Effect for L {
    fn card(&self) -> &'static Card {
        const { &L::CARD }
    }
    fn role(&self) -> Role {
        L::ROLE
    }
    fn respond(&self, p: &[f64], scene: &Scene, elastic: &[f64], out: &mut [f64]) {
        L::respond(p, scene, elastic, out);
    }
    fn respond_tangent(
        &self,
        p: &[Tangent],
        scene: &Scene,
        elastic: &[Tangent],
        out: &mut [Tangent],
    ) {
        L::respond(p, scene, elastic, out);
    }
    fn contacts(&self, p: &[f64]) -> Option<Vec<Contact>> {
        L::contacts(p)
    }
}
