//! Declarations and assignments: variables, and the system variables that change the path.

use super::program::Statement;
use super::scan::{cut, head_of};
use super::value::Value;
use super::{State, shown};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{Pose, roll_pitch_yaw};
use crate::ground::units::DEGREE;

/// Types that may stand before a name without DECL.
const TYPES: &[&str] = &[
    "E6POS",
    "POS",
    "FRAME",
    "E6AXIS",
    "AXIS",
    "INT",
    "REAL",
    "BOOL",
    "CHAR",
    "FDAT",
    "LDAT",
    "PDAT",
    "BASIS_SUGG_T",
    "MODULEPARAM_T",
    "LOAD",
    "STATE_T",
];

impl State {
    /// Takes a line of a data list.
    pub(super) fn declare(&mut self, statement: &Statement) -> Outcome<()> {
        let text = statement.upper.as_str();
        if !self.declaration(text)? && text.contains('=') {
            self.variable(text);
        }
        Ok(())
    }

    /// Takes a declaration, with or without a value; false if it is none.
    pub(super) fn declaration(&mut self, text: &str) -> Outcome<bool> {
        let mut rest = text;
        let mut declared = false;
        while let Some(next) = ["DECL ", "GLOBAL ", "CONST "]
            .iter()
            .find_map(|w| rest.strip_prefix(w))
        {
            rest = next.trim_start();
            declared = true;
        }
        let (kind, names) = head_of(rest);
        if rest.starts_with("INTERRUPT") || !(declared || TYPES.contains(&kind)) {
            return Ok(false);
        }
        match names.contains('=') {
            true if names.starts_with([' ', '\t']) => self.variable(names),
            _ => {}
        }
        Ok(true)
    }

    /// `NAME = value`: what has no value that is understood is forgotten.
    fn variable(&mut self, text: &str) {
        let Some((name, value)) = text.split_once('=') else {
            return;
        };
        let name: String = name.split_whitespace().collect();
        let value = Value::of(value, &self.variables);
        match (name.split_once('.'), value) {
            (None, Some(value)) => drop(self.variables.insert(name, value)),
            (None, None) => drop(self.variables.remove(&name)),
            (Some((whole, field)), value) => self.set_field(whole, field, value),
        }
    }

    fn set_field(&mut self, whole: &str, field: &str, value: Option<Value>) {
        let Some(Value::Fields(fields)) = self.variables.get_mut(whole) else {
            return;
        };
        let place = fields.iter().position(|known| known.0 == field);
        match (place, value) {
            (Some(i), Some(value)) => fields[i].1 = value,
            (None, Some(value)) => fields.push((field.to_string(), value)),
            (_, None) => drop(self.variables.remove(whole)),
        }
    }

    /// `LEFT = RIGHT` in a program.
    pub(super) fn assignment(&mut self, text: &str, line: usize) -> Outcome<()> {
        let Some((left, right)) = text.split_once('=') else {
            let remedy = "write `NAME = value`";
            return Err(Problem::new(
                format!("`{}` is not understood", shown(text)),
                remedy,
            ));
        };
        let left: String = left.split_whitespace().collect();
        let right = right.trim();
        match left.as_str() {
            "$VEL.CP" => self.feed = Some(self.positive(right, "$VEL.CP")?),
            "$APO.CDIS" => self.blend = Some(self.distance(right)?),
            "$VEL" => self.in_aggregate(right, "CP", |state, x| state.feed = Some(x))?,
            "$APO" => self.in_aggregate(right, "CDIS", |state, x| state.blend = Some(x * 1e-3))?,
            "$BASE" => self.base(right)?,
            "$TOOL" => self.tool(right)?,
            "$ORI_TYPE" => self.orientation_type(right)?,
            "$IPO_MODE" if right != "#BASE" => {
                let remedy = "let the robot hold the tool: $IPO_MODE = #BASE";
                return Err(Problem::new("a fixed tool moves the workpiece", remedy));
            }
            _ if left.starts_with('$') => self.draft.pass_over(&left, line),
            _ => self.variable(text),
        }
        Ok(())
    }

    fn number(&self, text: &str, what: &str) -> Outcome<f64> {
        match Value::of(text, &self.variables) {
            Some(Value::Number(x)) => Ok(x),
            _ => Err(Problem::new(
                format!("`{}` gives {what} no number", shown(text)),
                "write a number, or a variable with one; expressions are not computed",
            )),
        }
    }

    fn positive(&self, text: &str, what: &str) -> Outcome<f64> {
        let number = self.number(text, what)?;
        match number > 0.0 {
            true => Ok(number),
            false => Err(Problem::new(
                format!("{what} is {number}"),
                "write a value above zero, in m/s",
            )),
        }
    }

    fn distance(&self, text: &str) -> Outcome<f64> {
        let distance = self.number(text, "$APO.CDIS")?;
        match distance >= 0.0 {
            true => Ok(distance * 1e-3),
            false => Err(Problem::new(
                format!("$APO.CDIS is {distance}"),
                "write zero or more, in mm",
            )),
        }
    }

    fn in_aggregate(&mut self, text: &str, field: &str, set: fn(&mut Self, f64)) -> Outcome<()> {
        let value = Value::of(text, &self.variables);
        if let Some(x) = value.as_ref().and_then(|value| value.number(field)) {
            if x < 0.0 || (x == 0.0 && field == "CP") {
                return Err(Problem::new(
                    format!("{field} is {x}"),
                    "write a value above zero",
                ));
            }
            set(self, x);
            return Ok(());
        }
        let remedy = format!("write {{{field} value}}");
        Err(Problem::new(
            format!("`{}` gives no {field}", shown(text)),
            remedy,
        ))
    }

    fn orientation_type(&mut self, right: &str) -> Outcome<()> {
        match right {
            "#VAR" => self.held = false,
            "#CONST" | "#CONSTANT" => self.held = true,
            other => {
                let what = format!(
                    "orientation that turns as `{}` is not understood",
                    shown(other)
                );
                return Err(Problem::new(what, "write $ORI_TYPE = #VAR or #CONSTANT"));
            }
        }
        Ok(())
    }

    fn base(&mut self, right: &str) -> Outcome<()> {
        let frame = self.frame(right);
        let known = self.one(self.base.clone(), right, "$BASE")?;
        self.base = Some(known);
        if self.draft.moves.is_empty() {
            self.draft.base = frame;
        }
        Ok(())
    }

    fn tool(&mut self, right: &str) -> Outcome<()> {
        let frame = self.frame(right);
        let known = self.one(self.tool.clone(), right, "$TOOL")?;
        self.tool = Some(known);
        if self.draft.moves.is_empty() {
            self.draft.tool = frame;
        }
        Ok(())
    }

    /// The name of a frame, unless another one holds and the path has begun.
    fn one(&self, before: Option<String>, right: &str, what: &str) -> Outcome<String> {
        let text = match Value::of(right, &self.variables) {
            Some(value) => format!("{value:?}"),
            None => right.split_whitespace().collect(),
        };
        if !self.draft.moves.is_empty() && before.as_ref() != Some(&text) {
            let remedy = "write each frame into a program and a job of its own";
            return Err(Problem::new(
                format!("{what} changes within the path"),
                remedy,
            ));
        }
        Ok(text)
    }

    /// The frame of a text, if it says one.
    fn frame(&self, text: &str) -> Option<Pose> {
        if matches!(text, "$NULLFRAME" | "$WORLD") {
            return Some(Pose::IDENTITY);
        }
        let value = Value::of(text, &self.variables).filter(Value::is_position)?;
        let [a, b, c] = ["A", "B", "C"].map(|name| value.number(name).unwrap_or(0.0) * DEGREE);
        Some(Pose {
            point: ["X", "Y", "Z"].map(|name| value.number(name).unwrap_or(0.0) * 1e-3),
            rotation: roll_pitch_yaw(c, b, a),
        })
    }

    /// `BAS(#WHAT, value)`: the velocities and frames of the inline forms.
    pub(super) fn bas(&mut self, arguments: &[String], line: usize) -> Outcome<()> {
        let what = arguments.first().map_or("", String::as_str);
        let value = arguments.get(1).map_or("", String::as_str);
        match what {
            "#VEL_CP" => self.feed = Some(self.positive(value, what)?),
            "#CP_PARAMS" => self.inline_form(value)?,
            "#BASE" => self.base(&format!("BASE_DATA[{value}]"))?,
            "#TOOL" => self.tool(&format!("TOOL_DATA[{value}]"))?,
            _ => self.draft.pass_over("BAS", line),
        }
        Ok(())
    }

    /// Velocity, approximation distance and frames of the next motion.
    fn inline_form(&mut self, velocity: &str) -> Outcome<()> {
        self.feed = Some(self.positive(velocity, "#CP_PARAMS")?);
        let variables = &self.variables;
        let distance = variables.get("LDAT_ACT").and_then(|l| l.number("APO_DIST"));
        if let Some(distance) = distance.filter(|d| *d >= 0.0) {
            self.blend = Some(distance * 1e-3);
        }
        let frames = variables.get("FDAT_ACT");
        let numbers = ["BASE_NO", "TOOL_NO"].map(|name| frames.and_then(|f| f.number(name)));
        if let Some(base) = numbers[0] {
            self.base(&format!("BASE_DATA[{base}]"))?;
        }
        if let Some(tool) = numbers[1] {
            self.tool(&format!("TOOL_DATA[{tool}]"))?;
        }
        Ok(())
    }

    /// `$VEL.CP = 0.1, $APO.CDIS = 2`: what holds for one motion alone.
    pub(super) fn with(&mut self, text: &str, line: usize) -> Outcome<()> {
        cut(text)
            .iter()
            .try_for_each(|part| self.assignment(part.trim(), line))
    }
}
