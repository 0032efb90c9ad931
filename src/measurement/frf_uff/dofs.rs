//! Degrees of freedom: node and direction, by their columns, else by the name of the entity.

use super::refuse;
use crate::ground::problem::Outcome;
use crate::measurement::uff::{Dof, Function};

/// A translation at a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Node.
    pub node: i64,
    /// 0, 1, 2: x, y, z.
    pub axis: usize,
    /// Whether it points against the axis.
    pub reversed: bool,
}

/// Where a response was taken and where its force acted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ends {
    /// The response.
    pub output: Place,
    /// The force.
    pub input: Place,
}

impl Ends {
    /// One over the other has this sign along the axes.
    pub fn sign(&self) -> f64 {
        match self.output.reversed == self.input.reversed {
            true => 1.0,
            false => -1.0,
        }
    }
}

/// The ends of a function; `None` for a rotation.
///
/// # Errors
/// A direction that is stated nowhere.
pub fn ends(function: &Function, line: usize) -> Outcome<Option<Ends>> {
    let place = |dof: &Dof, what: &str| {
        if dof.direction.abs() > 3 {
            return Ok(None);
        }
        let found = by_columns(dof).or_else(|| by_name(&dof.entity));
        found.map(Some).ok_or_else(|| {
            let said = format!("the direction of the {what} is not stated");
            let remedy = "export with directions (1, 2, 3 for X, Y, Z in record 6)";
            refuse(line, said, remedy)
        })
    };
    let output = place(&function.response, "response")?;
    let input = place(&function.reference, "force")?;
    Ok(output
        .zip(input)
        .map(|(output, input)| Ends { output, input }))
}

fn by_columns(dof: &Dof) -> Option<Place> {
    let axis = usize::try_from(dof.direction.abs()).ok()?.checked_sub(1)?;
    Some(Place {
        node: dof.node,
        axis,
        reversed: dof.direction < 0,
    })
}

/// Names such as `.56.Z-` or `12:+X`.
fn by_name(entity: &str) -> Option<Place> {
    let is_axis = |c: char| matches!(c.to_ascii_uppercase(), 'X' | 'Y' | 'Z');
    let at = entity.rfind(is_axis)?;
    let (before, after) = entity.split_at(at);
    let axis = "XYZ".find(after.chars().next()?.to_ascii_uppercase())?;
    let sign = |c: &char| matches!(c, '+' | '-');
    let behind: Vec<char> = after.chars().skip(1).collect();
    if behind.iter().any(|c| !sign(c)) || before.chars().any(char::is_alphabetic) {
        return None;
    }
    let digits: String = before.chars().filter(char::is_ascii_digit).collect();
    Some(Place {
        node: digits.parse().unwrap_or(0),
        axis,
        reversed: behind.contains(&'-') || before.ends_with('-'),
    })
}

/// Names of places: `x` where all are at one node, else `12z`.
pub fn names(places: &[Place]) -> Vec<String> {
    let axis = |place: &Place| ["x", "y", "z"][place.axis];
    let one = places.windows(2).all(|pair| pair[0].node == pair[1].node);
    let name = |place: &Place| match one {
        true => axis(place).to_string(),
        false => format!("{}{}", place.node, axis(place)),
    };
    places.iter().map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_hide_a_direction() {
        let place = |node, axis, reversed| Place {
            node,
            axis,
            reversed,
        };
        assert_eq!(by_name(".56.Z"), Some(place(56, 2, false)));
        assert_eq!(by_name(".1.Z-"), Some(place(1, 2, true)));
        assert_eq!(by_name("12:+X"), Some(place(12, 0, false)));
        assert_eq!(by_name("NONE"), None);
        assert_eq!(by_name("Mic 01"), None);
        assert_eq!(by_name("Spindle y"), None);
    }
}
