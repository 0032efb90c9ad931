//! Kind `force-sensor`: what a force-torque sensor at the flange reads while the robot turns it, without
//! touching anything (source 002, section 2.6).

use super::facts::{measured, missing, needed};
use super::front::Front;
use super::table::Table;
use super::test::{Kind, Test};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::stats::length;
use crate::ground::units::Dimension;

/// Farthest centre of mass of a tool from its sensor, m: as far as a whole robot reaches. Beyond, millimetres were meant.
const FARTHEST: f64 = 3.0;

const HEADER: &str = "point,qw,qx,qy,qz,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm";
/// Names of the six channels in the header.
pub const CHANNELS: [(&str, &str); 6] = [
    ("fx", "N"),
    ("fy", "N"),
    ("fz", "N"),
    ("mx", "Nm"),
    ("my", "Nm"),
    ("mz", "Nm"),
];

/// The facts of a force-sensor file, SI.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Facts {
    /// Robot name, or a robot file beside the measurement.
    pub robot: Option<String>,
    /// Weight that the present model has, N.
    pub nominal_weight: Option<f64>,
    /// Its centre of mass, sensor frame, m.
    pub nominal_com: Option<[f64; 3]>,
    /// Relative standard deviation of both.
    pub nominal_rel_std: Option<f64>,
    /// Noise of the forces, N, and of the moments, N·m.
    pub noise: [Option<f64>; 2],
    /// True when the file says that it was simulated.
    pub synthetic: bool,
}

/// One reading, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Number of the point as the file gives it; none without such a column.
    pub point: Option<i64>,
    /// When, s; NaN where it is not told.
    pub time: f64,
    /// Unit quaternion w, x, y, z: turns sensor axes into base axes.
    pub quaternion: [f64; 4],
    /// Force, N, then moment, N·m: the load on the sensor, sensor frame.
    pub load: [f64; 6],
    /// 1-based line of the file.
    pub line: usize,
}

/// A force-sensor file, SI.
pub type SensorTest = Test<Facts>;

impl Kind for Facts {
    const NAME: &'static str = "force-sensor";
    const KEYS: &'static [&'static str] = &[
        "robot",
        "nominal_weight_N",
        "nominal_com_m",
        "nominal_rel_std",
        "sensor_noise_N",
        "sensor_noise_Nm",
    ];
    const NEEDS: &'static str =
        "every reading needs an orientation, three forces and three moments";
    type Reading = Reading;

    fn of(front: &Front) -> Outcome<Self> {
        let com = front.numbers("nominal_com_m")?;
        if let Some(far) = com.iter().flatten().find(|x| x.abs() > FARTHEST) {
            let what = format!("is {far} m from the sensor, farther than any tool reaches");
            let remedy = "write metres: 140 mm are 0.14";
            return Err(front.problem("nominal_com_m", what, remedy));
        }
        let three = |list: Vec<f64>| {
            <[f64; 3]>::try_from(list).map_err(|_| {
                front.problem(
                    "nominal_com_m",
                    "is not a list of three numbers",
                    "write `# nominal_com_m = [0.0, 0.0, 0.05]`",
                )
            })
        };
        Ok(Self {
            robot: front.text("robot")?.map(str::to_string),
            nominal_weight: front.positive("nominal_weight_N")?,
            nominal_com: com.map(three).transpose()?,
            nominal_rel_std: front.positive("nominal_rel_std")?,
            noise: [
                front.positive("sensor_noise_N")?,
                front.positive("sensor_noise_Nm")?,
            ],
            synthetic: front.synthetic(),
        })
    }

    fn readings(&self, table: &Table) -> Outcome<Vec<Reading>> {
        readings(table)
    }
}

/// How the file writes an orientation.
enum Turn<'a> {
    Quaternion([&'a [f64]; 4]),
    Angles([&'a [f64]; 3]),
}

impl<'a> Turn<'a> {
    fn of(table: &'a Table) -> Outcome<Self> {
        let plain = |name: &str| table.column(name).and_then(|column| column.numbers());
        if let (Some(w), Some(x), Some(y), Some(z)) =
            (plain("qw"), plain("qx"), plain("qy"), plain("qz"))
        {
            return Ok(Self::Quaternion([w, x, y, z]));
        }
        let angle = |name: &str| measured(table, name, Dimension::Angle);
        match (angle("a")?, angle("b")?, angle("c")?) {
            (Some(a), Some(b), Some(c)) => Ok(Self::Angles([a, b, c])),
            _ => Err(missing(
                table,
                "qw",
                &format!("{HEADER}`, or with `a_deg,b_deg,c_deg` in place of the quaternion; `"),
            )),
        }
    }

    /// The quaternion of a row; none where a cell is empty.
    fn at(&self, row: usize) -> Outcome<Option<[f64; 4]>> {
        match self {
            Self::Angles(columns) => {
                let [a, b, c] = columns.map(|column| column[row]);
                let whole = !(a + b + c).is_nan();
                Ok(whole.then(|| quaternion(a, b, c)))
            }
            Self::Quaternion(columns) => {
                let q = columns.map(|column| column[row]);
                if q.iter().any(|x| x.is_nan()) {
                    return Ok(None);
                }
                unit(q).map(Some)
            }
        }
    }
}

/// Quaternions shorter or longer than 1 by more than this are refused.
const LENGTH: f64 = 0.01;

fn unit(q: [f64; 4]) -> Outcome<[f64; 4]> {
    let length = length(&q);
    match (length - 1.0).abs() <= LENGTH {
        true => Ok(q.map(|x| x / length)),
        false => Err(Problem::new(
            format!("the quaternion has length {length:.4}, not 1"),
            "write the unit quaternion that turns sensor axes into base axes, scalar first",
        )
        .in_column("qw")),
    }
}

/// Quaternion w, x, y, z of Rz(a) Ry(b) Rx(c), rad (source 002, equation 16, derived: its print repeats one
/// row four times).
pub fn quaternion(a: f64, b: f64, c: f64) -> [f64; 4] {
    let [(sa, ca), (sb, cb), (sc, cc)] = [a, b, c].map(|angle| (0.5 * angle).sin_cos());
    [
        ca * cb * cc + sa * sb * sc,
        ca * cb * sc - sa * sb * cc,
        ca * sb * cc + sa * cb * sc,
        sa * cb * cc - ca * sb * sc,
    ]
}

fn readings(table: &Table) -> Outcome<Vec<Reading>> {
    let turn = Turn::of(table)?;
    let channel = |(name, unit): (&str, &str)| {
        let wanted = if unit == "N" {
            Dimension::Force
        } else {
            Dimension::Moment
        };
        needed(table, name, wanted, HEADER)
    };
    let channels = CHANNELS
        .iter()
        .map(|c| channel(*c))
        .collect::<Outcome<Vec<_>>>()?;
    let point = table.column("point").and_then(|column| column.numbers());
    let time = measured(table, "time", Dimension::Time)?;
    let mut readings = Vec::with_capacity(table.rows);
    for row in 0..table.rows {
        let line = table.line_of(row);
        let load: [f64; 6] = std::array::from_fn(|c| channels[c][row]);
        let quaternion = turn.at(row).map_err(|problem| problem.at_line(line))?;
        let point = point.map(|p| p[row]);
        let empty = load.iter().any(|x| x.is_nan()) || point.is_some_and(f64::is_nan);
        if let Some(quaternion) = quaternion.filter(|_| !empty) {
            let time = time.map_or(f64::NAN, |t| t[row]);
            readings.push(Reading {
                point: point.map(|p| p as i64),
                time,
                quaternion,
                load,
                line,
            });
        }
    }
    Ok(readings)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::spatial::{of_quaternion, roll_pitch_yaw};

    #[test]
    fn quaternion_and_matrix_of_kuka_angles_agree() {
        for (a, b, c) in [(0.3, -0.7, 1.1), (-2.9, 1.5, 3.0), (0.0, 0.0, 0.0)] {
            let (found, wanted) = (of_quaternion(quaternion(a, b, c)), roll_pitch_yaw(c, b, a));
            let pairs = found.as_flattened().iter().zip(wanted.as_flattened());
            assert!(pairs.fold(0.0_f64, |worst, (x, y)| worst.max((x - y).abs())) < 1e-14);
        }
    }
}
