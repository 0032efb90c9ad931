//! What a load cycle is simulated with at present, where its file does not say: an earlier fit, or the
//! robot that the file names.

use crate::effects::contract::Role;
use crate::effects::{Composite, Effect};
use crate::findings::load_cycle::Present;
use crate::fit::imposed::is_imposed;
use crate::fit::parameter::{Status, Z95};
use crate::fit::store::StoredFit;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::stats::largest;
use crate::measurement::load_cycle::{Axis, LEVER_REL_STD, LoadCycle, Port};
use crate::robot::load::{Loaded, load};
use crate::robot::spring::Spring;
use serde_json::{Value, json};
use std::path::Path;

/// A present simulation and where it came from.
pub struct Base {
    /// What it is beyond a straight spring.
    pub present: Option<Present>,
    /// Where it came from.
    pub origin: Origin,
}

/// Where a present simulation came from.
pub struct Origin {
    from: String,
    stiffness: (f64, &'static str),
    causes: Vec<&'static str>,
}

impl Origin {
    fn new(from: String, file: &LoadCycle, stiffness: f64, present: Option<&Present>) -> Self {
        Self {
            from,
            stiffness: (stiffness, file.port.stiffness_unit()),
            causes: present.map(Present::causes).unwrap_or_default(),
        }
    }

    /// One sentence.
    pub fn sentence(&self) -> String {
        let (value, unit) = self.stiffness;
        let stiffness = crate::sheet::number::engineering(value, 4, unit);
        let causes: Vec<String> = self.causes.iter().map(|c| c.replace('_', " ")).collect();
        let has = match causes.is_empty() {
            true => String::new(),
            false => format!(
                " with {}; of these only what these data contradict is named",
                causes.join(", ")
            ),
        };
        format!(
            "The present simulation is from {}: a stiffness of {stiffness}{has}.",
            self.from
        )
    }

    /// The same as JSON.
    pub fn json(&self) -> Value {
        json!({
            "from": self.from,
            "stiffness": self.stiffness.0,
            "unit": self.stiffness.1,
            "effects": self.causes,
        })
    }
}

/// The model of an earlier fit; its stiffness becomes the nominal one.
///
/// # Errors
/// No fit, or one of another joint or another kind of test.
pub fn of_fit(file: &mut LoadCycle, path: &Path) -> Outcome<Base> {
    let fit = StoredFit::read(path)?;
    let (model, p) = fit.model().map_err(|problem| problem.in_text(path))?;
    let moved = |e: &&'static dyn Effect| e.role() == Role::Imposed;
    if is_imposed(file) || model.effects().iter().any(moved) {
        let remedy = "leave out --model: such tests are compared with a straight spring";
        return Err(Problem::new("is of a test that moved the joint", remedy).in_text(path));
    }
    if fit.site != file.site() {
        let what = format!(
            "was fitted at {}, but {} was measured at {}",
            fit.site,
            file.path.display(),
            file.site()
        );
        return Err(Problem::new(what, "give a fit of the same joint and axis").in_text(path));
    }
    let stated = fit.parameters.iter().find(|q| q.name == "stiffness");
    if stated.is_some_and(|q| q.status == Status::NotIdentifiable) {
        let what = "holds no stiffness: its measurement could not carry one";
        let remedy = "fit another measurement of the joint, or leave out --model";
        return Err(Problem::new(what, remedy).at_line(1).in_file(path));
    }
    let own = stated
        .and_then(|q| Some(q.stderr? / q.value?))
        .unwrap_or(0.0);
    let lever = file.facts.lever_rel_std.unwrap_or(LEVER_REL_STD);
    file.facts.nominal_stiffness = Some(p[0]);
    file.facts.nominal_rel_std = Some(own.hypot(lever * std::f64::consts::SQRT_2));
    let present = Present {
        scale: Some((fit.scale.load, fit.scale.deflection)),
        shapes: true,
        model,
        p,
    };
    let from = path.display().to_string();
    let origin = Origin::new(from, file, present.p[0], Some(&present));
    Ok(Base {
        present: Some(present),
        origin,
    })
}

/// Stiffness and gap of the joint in the robot that the file names, if the file states no stiffness.
/// # Errors
/// That robot cannot be read: the file is diagnosed without it, and the reader is told.
pub fn of_robot(file: &mut LoadCycle) -> Outcome<Option<Base>> {
    if file.facts.nominal_stiffness.is_some() || file.port != Port::Rotational {
        return Ok(None);
    }
    let Some(name) = file.facts.robot.clone() else {
        return Ok(None);
    };
    let loaded = load(&name, Some(&file.path))?;
    Ok(of_joint(file, &loaded))
}

fn of_joint(file: &mut LoadCycle, loaded: &Loaded) -> Option<Base> {
    let joint = loaded.robot.joints.get(file.facts.joint?.checked_sub(1)?)?;
    let spring = match file.facts.axis? {
        Axis::Rotation => joint.drive.as_ref()?,
        Axis::Tilt => joint.tilt.as_ref()?,
    };
    file.facts.nominal_stiffness = Some(spring.stiffness);
    let interval = spring.ci95.stiffness;
    let spread = interval.map(|[low, high]| (high - low) / (2.0 * Z95 * spring.stiffness));
    file.facts.nominal_rel_std = file.facts.nominal_rel_std.or(spread);
    let present = gapped(spring, file);
    let origin = Origin::new(
        loaded.path.clone(),
        file,
        spring.stiffness,
        present.as_ref(),
    );
    Some(Base { present, origin })
}

/// Share of the largest load at which the flanks of a stated gap are taken to meet.
const CONTACT: f64 = 0.02;

/// Spring and gap of a joint that has one.
fn gapped(spring: &Spring, file: &LoadCycle) -> Option<Present> {
    let gap: f64 = spring.backlash.iter().sum();
    let model = Composite::named(&["backlash"]).ok().filter(|_| gap > 0.0)?;
    Some(Present {
        model,
        p: vec![spring.stiffness, gap, CONTACT * largest(&file.load)],
        scale: None,
        shapes: false,
    })
}
