//! Effects with a memory that a joint carries through time: hysteresis, friction.
//!
//! Any law of [`crate::effects`] that is a sum of dry contacts will do; in robot files it goes by its name
//! and the parameters of its card, each with its unit:
//! `effects = [{ name = "hysteresis", width_rad = 9.7e-5, slip_load_Nm = 348.0, spread = 1.1, tilt = -0.4 }]`.

use crate::effects::contract::{Contact, Effect};
use crate::effects::{EFFECTS, Parameter, Scale, named};
use crate::ground::problem::{Outcome, Problem};

/// An effect with its parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct JointEffect {
    /// Its name in [`EFFECTS`].
    pub name: String,
    /// Its parameters in the order of its card, SI.
    pub values: Vec<f64>,
}

impl JointEffect {
    /// An effect of a joint.
    ///
    /// # Errors
    /// A name that no effect has, or one that joints cannot carry; parameters that cannot be.
    pub fn new(name: &str, values: Vec<f64>) -> Outcome<Self> {
        let effect = carried(name)?;
        let parameters = effect.card().parameters;
        let wrong = parameters
            .iter()
            .zip(&values)
            .find(|(p, x)| !possible(p, **x));
        if let Some((parameter, value)) = wrong {
            return Err(Problem::new(
                format!("{name}: `{}` is {value}", key(parameter)),
                format!("it is the {}, a positive number", parameter.meaning),
            ));
        }
        if parameters.len() != values.len() {
            return Err(Problem::new(
                format!(
                    "{name} has {} parameters, {} are given",
                    parameters.len(),
                    values.len()
                ),
                format!("give {}", keys(effect).join(", ")),
            ));
        }
        Ok(Self {
            name: name.to_string(),
            values,
        })
    }

    /// Names of its parameters in robot files.
    pub fn keys(&self) -> Vec<String> {
        named(&self.name).map(keys).unwrap_or_default()
    }

    /// As in reports: `hysteresis, width_rad 9.7e-5, ..`.
    pub fn text(&self) -> String {
        let values = self.keys().into_iter().zip(&self.values);
        let values: String = values
            .map(|(key, value)| format!(", {key} {value:e}"))
            .collect();
        format!("{}{values}", self.name)
    }

    /// Its dry contacts.
    pub fn contacts(&self) -> Vec<Contact> {
        let contacts = named(&self.name).and_then(|effect| effect.contacts(&self.values));
        contacts.unwrap_or_default()
    }
}

/// The effects of the spring `site` as its file gives them.
///
/// # Errors
/// An unknown effect or key, a missing parameter, contacts that hold back more than the spring gives.
pub fn read(site: &str, tables: Vec<toml::Table>, stiffness: f64) -> Outcome<Vec<JointEffect>> {
    let effects = tables
        .into_iter()
        .map(of_table)
        .collect::<Outcome<Vec<_>>>();
    let effects = effects.map_err(|problem| problem.in_column(site))?;
    let held = held_back(&effects);
    if held * stiffness >= 1.0 {
        return Err(Problem::new(
            format!("the contacts of {site} hold back {held:.3e} rad/(N·m), more than its spring gives ({:.3e})", 1.0 / stiffness),
            "a joint whose contacts stick is still elastic: reduce the width, or raise the load at which they slip",
        )
        .in_column(site));
    }
    Ok(effects)
}

/// What the contacts hold back while they stick, rad/(N·m); a spring that gives less cannot carry them.
pub fn held_back(effects: &[JointEffect]) -> f64 {
    let contacts = effects.iter().flat_map(JointEffect::contacts);
    contacts.map(|contact| contact.compliance).sum()
}

fn of_table(mut table: toml::Table) -> Outcome<JointEffect> {
    let Some(toml::Value::String(name)) = table.remove("name") else {
        return Err(Problem::new(
            "an effect has no name",
            format!("write `name = \"..\"`: {}", carriable().join(", ")),
        ));
    };
    let wanted = keys(carried(&name)?);
    let values = wanted.iter().map(|key| number(&name, &mut table, key));
    let values = values.collect::<Outcome<Vec<f64>>>()?;
    if let Some(key) = table.keys().next() {
        return Err(Problem::new(
            format!("{name} has no parameter `{key}`"),
            format!("its parameters are {}", wanted.join(", ")),
        ));
    }
    JointEffect::new(&name, values)
}

fn number(name: &str, table: &mut toml::Table, key: &str) -> Outcome<f64> {
    match table.remove(key) {
        Some(toml::Value::Float(x)) => Ok(x),
        Some(toml::Value::Integer(i)) => Ok(i as f64),
        _ => Err(Problem::new(
            format!("{name}: `{key}` is missing or no number"),
            format!("`ident effects {name}` says what it means; the unit stands in the name"),
        )),
    }
}

fn carriable() -> Vec<&'static str> {
    let can = |effect: &&&dyn Effect| {
        let values: Vec<f64> = effect
            .card()
            .parameters
            .iter()
            .map(|p| p.bounds.1)
            .collect();
        effect.contacts(&values).is_some()
    };
    let found = EFFECTS.iter().filter(can);
    found.map(|effect| effect.card().name).collect()
}

fn carried(name: &str) -> Outcome<&'static dyn Effect> {
    let known = carriable();
    let found = named(name).filter(|_| known.contains(&name));
    found.ok_or_else(|| {
        Problem::new(
            format!("a joint cannot carry the effect `{name}`"),
            format!(
                "joints carry {} (backlash has a key of its own)",
                known.join(", ")
            ),
        )
    })
}

fn keys(effect: &dyn Effect) -> Vec<String> {
    effect.card().parameters.iter().map(key).collect()
}

/// The parameter's name with its unit.
fn key(parameter: &Parameter) -> String {
    let unit = match parameter.scale {
        Scale::Load => "_Nm",
        Scale::Deflection => "_rad",
        Scale::Stiffness => "_Nm_rad",
        Scale::Period | Scale::Duration => "_s",
        Scale::One => "",
    };
    format!("{}{unit}", parameter.name)
}

/// Sizes are positive or zero (a load that divides is positive); pure numbers stay within their bounds.
fn possible(parameter: &Parameter, value: f64) -> bool {
    match parameter.scale {
        Scale::One => (parameter.bounds.0..=parameter.bounds.1).contains(&value),
        Scale::Deflection => value >= 0.0 && value.is_finite(),
        _ => value > 0.0 && value.is_finite(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{builtin, file, write};

    fn with(effect: &str) -> Outcome<crate::robot::Robot> {
        let robot = builtin::named("kr210").unwrap().unwrap();
        let text = write::write(&robot);
        let drive = "drive = { stiffness_Nm_rad = 5600000.0";
        assert!(text.contains(drive));
        file::read(&text.replace(drive, &format!("{drive}, effects = [{effect}]")))
    }

    const GOOD: &str = r#"{ name = "hysteresis", width_rad = 1e-5, slip_load_Nm = 900, spread = 1.0, tilt = 0.0 }"#;

    #[test]
    fn effects_are_read_and_written() {
        let robot = with(GOOD).unwrap();
        let drive = robot.joints[0].drive.as_ref().unwrap();
        assert_eq!(drive.effects[0].values, [1e-5, 900.0, 1.0, 0.0]);
        assert_eq!(drive.contacts().len(), 12);
        assert_eq!(file::read(&write::write(&robot)).unwrap(), robot);
    }

    #[test]
    fn refuses_with_a_remedy() {
        for (from, to, said) in [
            ("hysteresis", "creep", "cannot carry the effect `creep`"),
            ("width_rad", "width_mm", "`width_rad` is missing"),
            ("1e-5", "-1e-5", "`width_rad` is -0.00001"),
            ("1e-5", "1e-2", "hold back"),
            ("spread = 1.0", "spread = 9.0", "`spread` is 9"),
            ("tilt", "x = 1.0, tilt", "no parameter `x`"),
            ("name", "nam", "has no name"),
        ] {
            let problem = with(&GOOD.replace(from, to)).unwrap_err();
            assert!(problem.what.contains(said), "{problem}");
            assert!(problem.line.is_some(), "{problem}");
        }
    }
}
