//! Kind `cubes`: measuring cubes on the structure of a robot, loaded less unloaded (source 002,
//! section 2.5).

use super::facts::{measured, missing, needed};
use super::front::Front;
use super::table::Table;
use super::test::{Kind, Test};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;
use crate::ground::units::{DEGREE, Dimension, ON_A_ROBOT_M};
use toml::Value;

const HEADER: &str =
    "test,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,cube,dx_mm,dy_mm,dz_mm,rx_mrad,ry_mrad,rz_mrad";

/// One cube.
#[derive(Debug, Clone, PartialEq)]
pub struct Cube {
    /// Its name.
    pub name: String,
    /// 0: on the foundation; i: on the link that axis i moves.
    pub after: usize,
    /// The last elastic axis of that link before it; none: it sits before all of them.
    pub beyond: Option<String>,
    /// Its centre in the base frame at the pose of the test, m.
    pub centre: V3,
}

/// The facts of a cubes file, SI.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Facts {
    /// Robot name, or a robot file beside the measurement.
    pub robot: String,
    /// Joint angles, rad.
    pub joint_angles: Vec<f64>,
    /// The cubes, in the order of the file.
    pub cubes: Vec<Cube>,
    /// Where the load acts, base frame, m; none: the tool centre point.
    pub load_point: Option<V3>,
    /// Noise of displacements, m, and of rotations, rad.
    pub noise: [Option<f64>; 2],
    /// Motion of the measuring frame: one translation per test and direction, standard deviation, m.
    pub frame_std: Option<f64>,
    /// True when the file says that it was simulated.
    pub synthetic: bool,
}

/// One reading: a cube under a load, SI, base frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Number of the test.
    pub test: i64,
    /// Force on the robot at the load point, N.
    pub force: V3,
    /// Moment on the robot, N·m.
    pub moment: V3,
    /// Index of the cube.
    pub cube: usize,
    /// Displacement of its centre, m, then its rotation vector, rad; NaN where not measured.
    pub moved: [f64; 6],
}

/// A cubes file, SI.
pub type CubeTest = Test<Facts>;

impl Kind for Facts {
    const NAME: &'static str = "cubes";
    const KEYS: &'static [&'static str] = &[
        "robot",
        "joint_angles_deg",
        "cubes",
        "load_point_m",
        "sensor_noise_mm",
        "sensor_noise_mrad",
        "frame_std_mm",
    ];
    const NEEDS: &'static str =
        "every row needs test, load, cube and at least one displacement or rotation";
    type Reading = Reading;

    fn of(front: &Front) -> Outcome<Self> {
        let lacking = |key: &str, remedy: &str| {
            Problem::new(format!("the fact `{key}` is missing"), remedy.to_string()).at_line(1)
        };
        let robot = front.text("robot")?.ok_or_else(|| {
            lacking(
                "robot",
                "add `# robot = \"kr300\"`: a built-in robot, or a robot file beside this one",
            )
        })?;
        let angles = joint_angles(front)?.ok_or_else(|| {
            lacking(
                "joint_angles_deg",
                "add the pose in degrees: `# joint_angles_deg = [0, -90, 90, 0, 0, 0]`",
            )
        })?;
        let noise = [("sensor_noise_mm", 1e-3), ("sensor_noise_mrad", 1e-3)];
        let [displacement, rotation] =
            noise.map(|(key, si)| front.positive(key).map(|x| x.map(|x| x * si)));
        let point = front.numbers("load_point_m")?.map(|list| {
            V3::try_from(list).map_err(|_| {
                front.problem(
                    "load_point_m",
                    "is not a list of three numbers",
                    "write `# load_point_m = [2.0, 0.0, 1.8]`",
                )
            })
        });
        Ok(Self {
            robot: robot.to_string(),
            joint_angles: angles.iter().map(|a| a * DEGREE).collect(),
            cubes: cubes(front)?,
            load_point: point.transpose()?,
            noise: [displacement?, rotation?],
            frame_std: front.not_negative("frame_std_mm")?.map(|mm| mm * 1e-3),
            synthetic: front.synthetic(),
        })
    }

    fn readings(&self, table: &Table) -> Outcome<Vec<Reading>> {
        readings(table, &self.cubes)
    }
}

/// One pose: a list, or a list with one row.
fn joint_angles(front: &Front) -> Outcome<Option<Vec<f64>>> {
    let single = |rows: &Vec<Value>| match &rows[..] {
        [Value::Array(row)] => Some(row.iter().map(number).collect::<Option<Vec<f64>>>()),
        _ => None,
    };
    match front
        .facts
        .get("joint_angles_deg")
        .and_then(Value::as_array)
        .and_then(single)
    {
        Some(Some(row)) => Ok(Some(row)),
        _ => front.numbers("joint_angles_deg"),
    }
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Float(x) => x.is_finite().then_some(*x),
        Value::Integer(i) => Some(*i as f64),
        _ => None,
    }
}

fn cubes(front: &Front) -> Outcome<Vec<Cube>> {
    const REMEDY: &str = "write `# cubes = [{ name = \"base\", after = 0, centre_m = [0.3, 0.0, 0.1] }, ...]`; `beyond = \"axis\"` where an elastic axis of the link lies before the cube";
    let refuse = |what: String| front.problem("cubes", what, REMEDY);
    let list = match front.facts.get("cubes") {
        Some(Value::Array(list)) if !list.is_empty() => list,
        Some(_) => return Err(refuse("is not a list of cubes".into())),
        None => return Err(Problem::new("the fact `cubes` is missing", REMEDY).at_line(1)),
    };
    let mut found: Vec<Cube> = Vec::new();
    for (i, value) in list.iter().enumerate() {
        let cube = cube(value).map_err(|what| refuse(format!("cube {}: {what}", i + 1)))?;
        if found.iter().any(|other| other.name == cube.name) {
            return Err(refuse(format!("two cubes are called `{}`", cube.name)));
        }
        found.push(cube);
    }
    Ok(found)
}

fn cube(value: &Value) -> Result<Cube, String> {
    let table = value.as_table().ok_or("is no table")?;
    const KNOWN: [&str; 4] = ["name", "after", "beyond", "centre_m"];
    if let Some(key) = table.keys().find(|key| !KNOWN.contains(&key.as_str())) {
        return Err(format!("`{key}` is not known ({} are)", KNOWN.join(", ")));
    }
    let name = table
        .get("name")
        .and_then(Value::as_str)
        .ok_or("has no `name`")?;
    let after = table
        .get("after")
        .and_then(Value::as_integer)
        .ok_or("has no whole number `after`")?;
    let after = usize::try_from(after).map_err(|_| "`after` is below zero")?;
    let centre = table
        .get("centre_m")
        .and_then(Value::as_array)
        .ok_or("has no `centre_m`")?;
    let centre: Option<Vec<f64>> = centre.iter().map(number).collect();
    let centre = centre
        .and_then(|c| V3::try_from(c).ok())
        .ok_or("`centre_m` is not a list of three numbers")?;
    let near = -ON_A_ROBOT_M..=ON_A_ROBOT_M;
    if !centre.iter().all(|x| near.contains(x)) {
        return Err(format!(
            "`centre_m` lies more than {ON_A_ROBOT_M} m away; millimetres?"
        ));
    }
    let beyond = match table.get("beyond") {
        None => None,
        Some(Value::String(name)) => Some(name.clone()),
        Some(_) => return Err("`beyond` is no name of an elastic axis".into()),
    };
    Ok(Cube {
        name: name.into(),
        after,
        beyond,
        centre,
    })
}

fn readings(table: &Table, cubes: &[Cube]) -> Outcome<Vec<Reading>> {
    let test = table.column("test").and_then(|column| column.numbers());
    let test = test.ok_or_else(|| missing(table, "test", HEADER))?;
    let words = table.column("cube").and_then(|column| column.words());
    let (codes, words) = words.ok_or_else(|| missing(table, "cube", HEADER))?;
    let load = ["fx", "fy", "fz"].map(|n| needed(table, n, Dimension::Force, HEADER));
    let [fx, fy, fz] = load;
    let force = [fx?, fy?, fz?];
    let absent_is_none = |n: &str| measured(table, n, Dimension::Moment);
    let moment = [
        absent_is_none("mx")?,
        absent_is_none("my")?,
        absent_is_none("mz")?,
    ];
    let shift = |n: &str| measured(table, n, Dimension::Length);
    let turn = |n: &str| measured(table, n, Dimension::Angle);
    let moved = [
        shift("dx")?,
        shift("dy")?,
        shift("dz")?,
        turn("rx")?,
        turn("ry")?,
        turn("rz")?,
    ];
    if moved.iter().all(Option::is_none) {
        return Err(missing(table, "dx", HEADER));
    }
    let mut readings = Vec::with_capacity(table.rows);
    for row in 0..table.rows {
        let word = &words[usize::from(codes[row])];
        let reading = Reading {
            test: test[row] as i64,
            force: force.map(|f| f[row]),
            moment: moment.map(|m| m.map_or(0.0, |m| m[row])),
            cube: 0,
            moved: moved.map(|m| m.map_or(f64::NAN, |m| m[row])),
        };
        let loads = reading.force.iter().chain(&reading.moment).sum::<f64>();
        let unmeasured = reading.moved.iter().all(|m| m.is_nan());
        if word.is_empty() || (test[row] + loads).is_nan() || unmeasured {
            continue;
        }
        let cube = cubes
            .iter()
            .position(|cube| cube.name == *word)
            .ok_or_else(|| {
                let known: Vec<&str> = cubes.iter().map(|cube| cube.name.as_str()).collect();
                Problem::new(
                    format!("`{word}` is no cube of this file"),
                    format!("the front matter names {}", known.join(", ")),
                )
                .in_column("cube")
                .at_line(table.line_of(row))
            })?;
        readings.push(Reading { cube, ..reading });
    }
    Ok(readings)
}
