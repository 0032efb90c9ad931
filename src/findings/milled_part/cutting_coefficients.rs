//! The material cuts harder or easier than it is stated.

use super::Case;
use crate::findings::engine::{ALLOWED, Blamed, Member};
use crate::findings::table::{Effect, Place};
use crate::process::setup::Setup;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "cutting_coefficients",
    summary: "The material cuts harder or easier than stated.",
    mechanism: "force",
    law_error: 0.0,
    can_be: |shape, amounts| amounts[0].abs() > ALLOWED * shape[2] && amounts[0] > least(shape[1]),
    places: |case| vec![Place::new("material", members(case))],
    parameters: |_, blamed| vec![("relative_change", blamed.amounts[0], "1")],
    would_tell: "record the force of the cut (`ident force`)",
};

/// Ordinary relative error of a coefficient.
const ORDINARY: f64 = 0.3;
/// Which coefficients change together: all cutting, all at all, tangential, radial, the edge.
const FORMS: [&[usize]; 5] = [&[0, 1, 2], &[0, 1, 2, 3, 4, 5], &[0], &[1], &[3, 4, 5]];

fn members(case: &Case) -> Vec<Member> {
    let stds = case.planned.coefficient_stds();
    // the doubt of a common factor is that of its surest member
    let doubt = |own: &[usize]| {
        let stated = own.iter().filter_map(|k| stds.get(*k).copied().flatten());
        stated.fold(f64::INFINITY, f64::min)
    };
    let form = |(i, own): (usize, &&[usize])| {
        let sum = |row: usize| own.iter().map(|k| case.coefficients[*k][row]).sum();
        let column: Vec<f64> = (0..case.rows.len()).map(sum).collect();
        let doubt = Some(doubt(own)).filter(|d| d.is_finite()).unwrap_or(0.0);
        Member::given(column, ORDINARY).shaped(&[-1.0, i as f64, doubt])
    };
    // an exponent is none that changes with the others
    let card = case.setup.material.law.card();
    let is_force = |k: &usize| card.coefficients[*k].unit != "1";
    let forms = FORMS.iter().enumerate();
    let forms = forms.filter(|(_, own)| own.iter().all(is_force));
    forms.map(form).collect()
}

/// Least factor of a coefficient: none pulls.
const LEAST: f64 = 0.05;
/// Form of the edge's coefficients, of which a sharp tool has hardly any, and the least change that is told of them.
const EDGE: f64 = 4.0;
const NO_EDGE: f64 = -1.2;

/// The least change of the coefficients of a form.
fn least(form: f64) -> f64 {
    match form == EDGE {
        true => NO_EDGE,
        false => LEAST - 1.0,
    }
}

/// Puts the cause into the material; false for others.
pub(super) fn alter(blamed: &Blamed, setup: &mut Setup) -> bool {
    let own = blamed.effect == EFFECT.name;
    if own {
        let factor = (1.0 + blamed.amounts[0]).max(LEAST);
        let changed = FORMS[blamed.shape[1] as usize];
        changed
            .iter()
            .for_each(|k| setup.material.coefficients[*k] *= factor);
    }
    own
}

#[cfg(test)]
mod tests {
    use super::{EDGE, EFFECT};

    /// A change that is no larger than what is stated is none of a cause, and no material pulls at the tool.
    #[test]
    fn a_material_that_pulls_is_none() {
        let can_be = |change: f64| (EFFECT.can_be)(&[-1.0, 0.0, 0.1], &[change]);
        assert!(can_be(0.5) && can_be(-0.5));
        assert!(can_be(-0.9) && !can_be(0.1) && !can_be(-1.0));
        // of a sharp edge nothing is left
        assert!((EFFECT.can_be)(&[-1.0, EDGE, 0.1], &[-1.0]));
    }
}
