//! Kind `milled-part`: what a probe found on a part that was milled by a job (`formats.md`, section 5.5).

use super::facts::measured;
use super::front::Front;
use super::table::Table;
use super::test::{Kind, Test};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;
use crate::ground::units::Dimension;

/// The facts of a measured part, SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Facts {
    /// The job that milled it: a file beside the measurement.
    pub job: String,
    /// Noise of the probe, standard deviation, m.
    pub probe_noise: Option<f64>,
    /// How well the part was found again on the probe's table, standard deviation per axis, m.
    pub datum_std: Option<f64>,
    /// Where the machined wall stands, seen along the feed: +1 left, −1 right; none where no wall was probed.
    pub side: Option<f64>,
    /// True when the file says that it was simulated.
    pub synthetic: bool,
}

/// A place of the part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum At {
    /// Arc length of the programmed path, m.
    Along(f64),
    /// Its nominal coordinates, workpiece frame, m.
    Place(V3),
}

/// One probed place, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Where.
    pub at: At,
    /// Measured less nominal, workpiece frame, m; NaN where a component was not probed.
    pub deviation: V3,
    /// Line of the file.
    pub line: usize,
}

/// A measured part, SI.
pub type PartTest = Test<Facts>;

const AXES: [&str; 3] = ["x", "y", "z"];
const DEVIATIONS: [&str; 3] = ["dx", "dy", "dz"];

impl Kind for Facts {
    const NAME: &'static str = "milled-part";
    const KEYS: &'static [&'static str] = &["job", "probe_noise_mm", "datum_std_mm", "side"];
    const NEEDS: &'static str = "every row needs a place (s_mm, or x_mm, y_mm, z_mm) and at least one of dx_mm, dy_mm, dz_mm";
    type Reading = Reading;

    fn of(front: &Front) -> Outcome<Self> {
        let job = front.text("job")?.ok_or_else(|| {
            Problem::new(
                "the fact `job` is missing",
                "add `# job = \"job.toml\"`: the job that milled the part, beside this file",
            )
            .at_line(1)
        })?;
        let mm = |value: Option<f64>| value.map(|mm| mm * 1e-3);
        Ok(Self {
            job: job.to_string(),
            probe_noise: mm(front.positive("probe_noise_mm")?),
            datum_std: mm(front.not_negative("datum_std_mm")?),
            side: side(front)?,
            synthetic: front.synthetic(),
        })
    }

    fn readings(&self, table: &Table) -> Outcome<Vec<Reading>> {
        let along = measured(table, "s", Dimension::Length)?;
        let place = columns(table, AXES)?;
        let deviation = columns(table, DEVIATIONS)?;
        let told = along.is_some() || place.iter().all(Option::is_some);
        if !told || deviation.iter().all(Option::is_none) {
            let what = "the columns of a measured part are missing";
            let remedy =
                "write the header `s_mm,dx_mm,dy_mm,dz_mm`, or `x_mm,y_mm,z_mm` in place of `s_mm`";
            return Err(Problem::new(what, remedy).at_line(table.first_line));
        }
        let cell = |column: Option<&[f64]>, row: usize| column.map_or(f64::NAN, |c| c[row]);
        let reading = |row: usize| Reading {
            at: match along {
                Some(s) => At::Along(s[row]),
                None => At::Place(place.map(|column| cell(column, row))),
            },
            deviation: deviation.map(|column| cell(column, row)),
            line: table.line_of(row),
        };
        let usable = |r: &Reading| {
            let place = match r.at {
                At::Along(s) => s.is_finite(),
                At::Place(p) => p.iter().all(|x| x.is_finite()),
            };
            place && r.deviation.iter().any(|d| d.is_finite())
        };
        Ok((0..table.rows).map(reading).filter(usable).collect())
    }
}

fn columns<'a>(table: &'a Table, stems: [&str; 3]) -> Outcome<[Option<&'a [f64]>; 3]> {
    let mut found = [None; 3];
    for (column, stem) in found.iter_mut().zip(stems) {
        *column = measured(table, stem, Dimension::Length)?;
    }
    Ok(found)
}

fn side(front: &Front) -> Outcome<Option<f64>> {
    Ok(match front.text("side")? {
        None => None,
        Some("left") => Some(1.0),
        Some("right") => Some(-1.0),
        Some(other) => {
            let what = format!("is `{other}`");
            let remedy =
                "write `left` or `right`: where the machined wall stands, seen along the feed";
            return Err(front.problem("side", what, remedy));
        }
    })
}
