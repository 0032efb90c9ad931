//! Points (CSV of kind `path`): corner points in order, or the control points of a NURBS.

mod curve;

use super::draft::Draft;
use super::source::Source;
use super::{Move, Orientation};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::Dimension;
use crate::ground::vector::{V3, norm, roll_pitch_yaw, unit};
use crate::measurement::table::Table;
use curve::curve;

/// Facts of the kind, beside those that every kind has.
pub(in crate::measurement) const FACTS: &[&str] = &[
    "job", "inputs", "version", "method", "curve", "degree", "knots",
];
/// How far the length of `i, j, k` may be from one.
const UNIT_TOLERANCE: f64 = 1e-3;

pub(super) fn recognises(head: &str) -> bool {
    let mut lines = head.lines().map(|line| line.trim_start_matches('\u{feff}'));
    lines.any(|line| line.starts_with('#') && line.contains("kind") && line.contains("path"))
}

pub(super) fn read(source: &Source) -> Outcome<Draft> {
    let bytes = source.bytes.as_slice();
    let table = Table::from_reader(&source.path, bytes, bytes.len() as u64)?;
    table.front.expect_kind("path")?;
    table.front.only(FACTS)?;
    let columns = Columns::of(&table)?;
    let mut draft = Draft {
        synthetic: table.front.synthetic(),
        corrected: table.front.text("method")?.is_some(),
        ..Draft::default()
    };
    for row in 0..table.rows {
        let line = table.line_of(row);
        let place = |problem: Problem| problem.at_line(line);
        let before = draft.moves.last().map(|last| last.orientation);
        let next = columns.point(row, before, line).map_err(place)?;
        draft.push(next).map_err(place)?;
    }
    match table.front.text("curve")? {
        None => Ok(draft),
        Some("nurbs") => {
            draft.curve = Some(curve(&table, &columns, std::mem::take(&mut draft.moves))?);
            Ok(draft)
        }
        Some(other) => Err(table.front.problem(
            "curve",
            format!("is `{other}`, which is not known"),
            "write `# curve = \"nurbs\"`, or leave it out for corner points",
        )),
    }
}

/// The columns of the kind.
struct Columns<'a> {
    place: [&'a [f64]; 3],
    turn: Turn<'a>,
    feed: Option<&'a [f64]>,
    rapid: Option<&'a [f64]>,
    weight: Option<&'a [f64]>,
    blend: Option<&'a [f64]>,
    station: Option<&'a [f64]>,
}

/// How a file states orientations.
enum Turn<'a> {
    /// Not at all: the spindle stands along z.
    Upright,
    Axis([&'a [f64]; 3]),
    Angles([&'a [f64]; 3]),
}

/// Columns of the kind by their stems.
const STEMS: &[&str] = &[
    "x", "y", "z", "a", "b", "c", "i", "j", "k", "feed", "rapid", "weight", "blend", "s", "point",
];

impl<'a> Columns<'a> {
    fn of(table: &'a Table) -> Outcome<Self> {
        let header = table.first_line - 1;
        if let Some(column) = table
            .columns
            .iter()
            .find(|c| !STEMS.contains(&c.stem.as_str()))
        {
            let remedy = "a path has `x_mm,y_mm,z_mm`, then `a_deg,b_deg,c_deg` or `i,j,k`, `feed_mm_min`, `rapid`, `weight`, `blend_mm`, `s_mm`";
            let problem = Problem::new("is a column that a path does not have", remedy);
            return Err(problem.in_column(&column.name).at_line(header));
        }
        let place = triple(table, ["x", "y", "z"], Some(Dimension::Length))?;
        let angles = triple(table, ["a", "b", "c"], Some(Dimension::Angle))?;
        let axis = triple(table, ["i", "j", "k"], None)?;
        let turn = match (angles, axis) {
            (None, None) => Turn::Upright,
            (Some(angles), None) => Turn::Angles(angles),
            (None, Some(axis)) => Turn::Axis(axis),
            (Some(_), Some(_)) => {
                let what = "states orientations twice, as angles and as axes";
                let remedy = "leave out `a_deg,b_deg,c_deg` or `i,j,k`";
                return Err(Problem::new(what, remedy).at_line(header));
            }
        };
        let missing = || {
            let remedy = "give the columns `x_mm,y_mm,z_mm`";
            Problem::new("has no points", remedy).at_line(header)
        };
        Ok(Self {
            place: place.ok_or_else(missing)?,
            turn,
            feed: column(table, "feed", Some(Dimension::Speed))?,
            rapid: column(table, "rapid", None)?,
            weight: column(table, "weight", None)?,
            blend: column(table, "blend", Some(Dimension::Length))?,
            station: column(table, "s", Some(Dimension::Length))?,
        })
    }

    fn point(&self, row: usize, before: Option<Orientation>, line: usize) -> Outcome<Move> {
        let to = self.place.map(|column| column[row]);
        if to.iter().any(|x| x.is_nan()) {
            let remedy = "write all three coordinates of every point";
            return Err(Problem::new("a coordinate is missing", remedy));
        }
        let cell = |column: Option<&[f64]>| column.map(|c| c[row]).filter(|x| !x.is_nan());
        let feed = cell(self.feed);
        if feed.is_some_and(|feed| feed <= 0.0) {
            let remedy = "write a feed above zero, or leave the cell empty";
            return Err(Problem::new("the feed is not above zero", remedy).in_column("feed"));
        }
        Ok(Move {
            feed,
            rapid: rapid(cell(self.rapid))?,
            own_blend: cell(self.blend),
            station: cell(self.station),
            ..Move::line(to, self.turn.at(row, before)?, line)
        })
    }
}

fn rapid(cell: Option<f64>) -> Outcome<bool> {
    match cell {
        None => Ok(false),
        Some(flag) if flag == 0.0 || flag == 1.0 => Ok(flag == 1.0),
        Some(other) => {
            let remedy = "write 1 for a rapid motion, 0 for a feed";
            Err(Problem::new(format!("{other} is neither 0 nor 1"), remedy).in_column("rapid"))
        }
    }
}

impl Turn<'_> {
    /// The orientation of a row; empty cells: as before.
    fn at(&self, row: usize, before: Option<Orientation>) -> Outcome<Orientation> {
        let (columns, names) = match self {
            Self::Upright => return Ok(Orientation::Axis([0.0, 0.0, 1.0])),
            Self::Axis(columns) => (columns, "i, j, k"),
            Self::Angles(columns) => (columns, "a_deg, b_deg, c_deg"),
        };
        let cells = columns.map(|column| column[row]);
        let empty = cells.iter().filter(|x| x.is_nan()).count();
        match (empty, before) {
            (0, _) => self.orientation(cells),
            (3, Some(before)) => Ok(before),
            _ => {
                let what = "a part of the orientation is missing";
                let remedy = format!(
                    "write {names}, or leave all three empty to keep the orientation of the point before"
                );
                Err(Problem::new(what, remedy))
            }
        }
    }

    fn orientation(&self, cells: V3) -> Outcome<Orientation> {
        if let Self::Angles(_) = self {
            let [a, b, c] = cells;
            return Ok(Orientation::Full(roll_pitch_yaw(c, b, a)));
        }
        axis(cells).map(Orientation::Axis)
    }
}

/// A spindle axis as a unit vector, from three components that make nearly one.
///
/// # Errors
/// Another length.
pub(super) fn axis(components: V3) -> Outcome<V3> {
    let length = norm(components);
    let long = (length - 1.0).abs() <= UNIT_TOLERANCE;
    let exact = (length - 1.0).abs() <= 2.0 * f64::EPSILON;
    match unit(components).filter(|_| long) {
        Some(_) if exact => Ok(components),
        Some(axis) => Ok(axis),
        None => Err(Problem::new(
            format!("the spindle axis has length {length}"),
            "i, j, k is a unit vector from the tip into the spindle",
        )),
    }
}

fn triple<'a>(
    table: &'a Table,
    stems: [&str; 3],
    wanted: Option<Dimension>,
) -> Outcome<Option<[&'a [f64]; 3]>> {
    let found = [
        column(table, stems[0], wanted)?,
        column(table, stems[1], wanted)?,
        column(table, stems[2], wanted)?,
    ];
    match found {
        [None, None, None] => Ok(None),
        [Some(x), Some(y), Some(z)] => Ok(Some([x, y, z])),
        _ => {
            let what = format!("has only a part of the columns {}", stems.join(", "));
            let remedy = "give all three, or none";
            Err(Problem::new(what, remedy).at_line(table.first_line - 1))
        }
    }
}

fn column<'a>(
    table: &'a Table,
    stem: &str,
    wanted: Option<Dimension>,
) -> Outcome<Option<&'a [f64]>> {
    let Some(column) = table.column(stem) else {
        return Ok(None);
    };
    match (column.numbers(), wanted) {
        (Some(values), wanted) if wanted == column.dimension => Ok(Some(values)),
        (_, Some(wanted)) => Err(column.misplaced(wanted, table.first_line - 1)),
        (_, None) => {
            let remedy = format!("call the column `{stem}`, without a unit");
            let problem = Problem::new("has a unit", remedy).in_column(&column.name);
            Err(problem.at_line(table.first_line - 1))
        }
    }
}
