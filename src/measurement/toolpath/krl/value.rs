//! Values of KRL: numbers, words, and aggregates such as frames.

use super::super::source::number;
use super::scan::cut;
use std::collections::BTreeMap;

/// A value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Number(f64),
    /// `#BASE`, `TRUE`, a text.
    Word(String),
    /// `{X 1, Y 2}`: fields in their order.
    Fields(Vec<(String, Value)>),
}

/// How deep braces may stand in braces.
const DEEPEST: usize = 6;
/// Most fields of an aggregate.
const MOST: usize = 64;

impl Value {
    /// The value of an expression, in upper case: a literal or a variable; `None` if it is neither.
    pub(super) fn of(text: &str, variables: &BTreeMap<String, Self>) -> Option<Self> {
        Self::parse(text, variables, 0)
    }

    fn parse(text: &str, variables: &BTreeMap<String, Self>, depth: usize) -> Option<Self> {
        let text = text.trim();
        if let Some(inside) = text.strip_prefix('{') {
            return Self::fields(inside.strip_suffix('}')?, variables, depth);
        }
        if let Some(found) = number(text) {
            return Some(Self::Number(found));
        }
        if text.starts_with(['#', '"']) || text == "TRUE" || text == "FALSE" {
            return Some(Self::Word(text.to_string()));
        }
        if let Some(Self::Number(x)) = text
            .strip_prefix('-')
            .and_then(|name| variables.get(name.trim()))
        {
            return Some(Self::Number(-x));
        }
        let spaceless: String = text.split_whitespace().collect();
        if let Some(found) = variables.get(&spaceless) {
            return Some(found.clone());
        }
        let (name, field) = spaceless.split_once('.')?;
        variables.get(name)?.field(field).cloned()
    }

    fn fields(inside: &str, variables: &BTreeMap<String, Self>, depth: usize) -> Option<Self> {
        if depth >= DEEPEST {
            return None;
        }
        let inside = match inside.split_once(':') {
            Some((kind, rest)) if !kind.contains(['{', ' ', ',']) => rest,
            Some((kind, rest)) if kind.trim().chars().all(|c| c.is_ascii_alphanumeric()) => rest,
            _ => inside,
        };
        let mut fields = Vec::new();
        for part in cut(inside) {
            let part = part.trim();
            let (name, value) = part.split_once([' ', '{', '\t'])?;
            let behind = part[name.len()..].trim();
            let value = if behind.starts_with('{') {
                behind
            } else {
                value
            };
            fields.push((name.to_string(), Self::parse(value, variables, depth + 1)?));
            if fields.len() > MOST {
                return None;
            }
        }
        Some(Self::Fields(fields))
    }

    pub(super) fn field(&self, name: &str) -> Option<&Self> {
        let Self::Fields(fields) = self else {
            return None;
        };
        let found = fields.iter().find(|field| field.0 == name);
        found.map(|field| &field.1)
    }

    pub(super) fn number(&self, name: &str) -> Option<f64> {
        match self.field(name) {
            Some(Self::Number(x)) => Some(*x),
            _ => None,
        }
    }

    /// Joint angles rather than a frame.
    pub(super) fn is_axes(&self) -> bool {
        self.field("A1").is_some()
    }

    /// Whether every field is a number and one of a position, in mm and degrees.
    pub(super) fn is_position(&self) -> bool {
        let Self::Fields(fields) = self else {
            return false;
        };
        let known = |name: &str| POSITION.contains(&name);
        let number = |value: &Self| matches!(value, Self::Number(_));
        fields
            .iter()
            .all(|(name, value)| known(name) && (number(value) || STATUS.contains(&name.as_str())))
    }
}

const POSITION: &[&str] = &[
    "X", "Y", "Z", "A", "B", "C", "S", "T", "E1", "E2", "E3", "E4", "E5", "E6",
];
const STATUS: &[&str] = &["S", "T"];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_and_structures_are_read() {
        let none = BTreeMap::new();
        let frame = Value::of(
            "{E6POS: X 1.5,Y -2,Z .5, A 0,B 90.0,C 0,S 2,T 'B110'}",
            &none,
        );
        assert_eq!(frame, None);
        let frame = Value::of("{E6POS: X 1.5,Y -2,Z .5, A 0,B 90.0,C 0,S 2,T 10}", &none).unwrap();
        assert_eq!(
            (frame.number("X"), frame.number("B")),
            (Some(1.5), Some(90.0))
        );
        assert!(frame.is_position() && !frame.is_axes());
        let nested = Value::of(
            "{TOOL_NO 1,IPO_FRAME #BASE,POINT2[] \" \",M {CM {X 1}}}",
            &none,
        )
        .unwrap();
        assert_eq!(nested.number("TOOL_NO"), Some(1.0));
        assert!(nested.field("M").is_some());
        let deep = "{A ".repeat(50) + "1" + &"}".repeat(50);
        assert_eq!(Value::of(&deep, &none), None);
    }
}
