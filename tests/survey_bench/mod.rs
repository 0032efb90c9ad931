//! A laboratory's survey made by formulas of its own: chains of masses whose modes are known in closed form,
//! solved line by line as one would solve the statics, and a writer of universal files by the columns of the
//! SDRC text.

use ident::ground::random::Random;
use rustfft::num_complex::Complex64;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

/// Storeys of the structure, points around each; one more point stands on top.
pub const STOREYS: usize = 12;
pub const AROUND: usize = 9;
pub const LINES: usize = 440;
pub const STEP_HZ: f64 = 0.25;
const MASS: f64 = 20.0;
/// Rayleigh damping: of the mass, 1/s, and of the stiffness, s.
const ALPHA: f64 = 3.0;
const BETA: f64 = 5e-5;
/// Lowest frequencies of the three chains, Hz.
const LOWEST: [f64; 3] = [12.0, 19.0, 24.0];
/// Directions of the three chains: columns of a rotation, so that every accelerometer sees all of them.
const FRAME: [[f64; 3]; 3] = [
    [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0],
    [2.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0],
    [-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0],
];

/// A mode as the closed form has it.
pub struct Truth {
    pub hz: f64,
    pub damping: f64,
    chain: usize,
    /// Movement of storey j.
    storey: Vec<f64>,
}

/// A point: its node, storey, place in m, and by how much the lever under it enlarges the movement.
#[derive(Clone)]
pub struct Point {
    pub node: i64,
    pub storey: usize,
    pub at: [f64; 3],
    pub lever: f64,
}

/// 109 points around a tower of 2.4 m.
pub fn points() -> Vec<Point> {
    let mut all: Vec<Point> = (0..STOREYS * AROUND)
        .map(|k| {
            let (storey, a) = (k / AROUND, k % AROUND);
            let angle = TAU * a as f64 / AROUND as f64;
            Point {
                node: 100 * (storey as i64 + 1) + a as i64,
                storey,
                at: [
                    0.4 * angle.cos(),
                    0.4 * angle.sin(),
                    0.2 * (storey + 1) as f64,
                ],
                lever: 1.0 + 0.3 * angle.sin(),
            }
        })
        .collect();
    all.push(Point {
        node: 7000,
        storey: STOREYS - 1,
        at: [0.0, 0.0, 2.6],
        lever: 1.5,
    });
    all
}

fn stiffness(chain: usize) -> f64 {
    let sine = (PI / (2.0 * (2 * STOREYS + 1) as f64)).sin();
    MASS * (TAU * LOWEST[chain] / (2.0 * sine)).powi(2)
}

/// The modes below `to_hz`: `ω = 2√(k/m)·sin((2r−1)π/(2(2n+1)))`, shape `sin((2r−1)πj/(2n+1))`.
pub fn truth(to_hz: f64) -> Vec<Truth> {
    let n = (2 * STOREYS + 1) as f64;
    let mut all = Vec::new();
    for chain in 0..3 {
        for r in 1..=STOREYS {
            let odd = (2 * r - 1) as f64 * PI;
            let w = 2.0 * (stiffness(chain) / MASS).sqrt() * (odd / (2.0 * n)).sin();
            all.push(Truth {
                hz: w / TAU,
                damping: 0.5 * (ALPHA / w + BETA * w),
                chain,
                storey: (1..=STOREYS).map(|j| (odd * j as f64 / n).sin()).collect(),
            });
        }
    }
    all.retain(|mode| mode.hz < to_hz);
    all.sort_by(|a, b| a.hz.total_cmp(&b.hz));
    all
}

impl Truth {
    /// Movement of a point along an axis.
    pub fn at(&self, point: &Point, axis: usize) -> f64 {
        FRAME[axis][self.chain] * point.lever * self.storey[point.storey]
    }
}

/// Movement of every storey of a chain per newton at the storey `hit`, by elimination along the chain.
fn receptance(chain: usize, hit: usize, w: f64) -> Vec<Complex64> {
    let k = stiffness(chain) * Complex64::new(1.0, BETA * w);
    let inertia = Complex64::new(-MASS * w * w, ALPHA * MASS * w);
    let diagonal = |j: usize| inertia + if j + 1 == STOREYS { k } else { 2.0 * k };
    // (b_j) x_j − k x_{j+1} = r_j from the foot up, then back.
    let (mut b, mut r) = (Vec::new(), Vec::new());
    for j in 0..STOREYS {
        let own = Complex64::from(f64::from(u8::from(j == hit)));
        match j {
            0 => {
                b.push(diagonal(0));
                r.push(own);
            }
            _ => {
                let share = k / b[j - 1];
                b.push(diagonal(j) - share * k);
                r.push(own + share * r[j - 1]);
            }
        }
    }
    let mut x = vec![Complex64::default(); STOREYS];
    for j in (0..STOREYS).rev() {
        let above = if j + 1 < STOREYS {
            k * x[j + 1]
        } else {
            Complex64::default()
        };
        x[j] = (r[j] + above) / b[j];
    }
    x
}

/// A degree of freedom: point and axis.
pub type Dof = (usize, usize);

/// Accelerances `[force][response][line]`, (m/s²)/N.
pub fn accelerances(
    points: &[Point],
    forces: &[Dof],
    responses: &[Dof],
) -> Vec<Vec<Vec<Complex64>>> {
    let circular = |line: usize| TAU * STEP_HZ * line as f64;
    let of = |(hit, i): &Dof| -> Vec<Vec<Complex64>> {
        let storey = points[*hit].storey;
        let answers: Vec<[Vec<Complex64>; 3]> = (1..LINES)
            .map(|line| [0, 1, 2].map(|chain| receptance(chain, storey, circular(line))))
            .collect();
        let response = |(point, o): &Dof| -> Vec<Complex64> {
            let levers = points[*hit].lever * points[*point].lever;
            let at = |(k, x): (usize, &[Vec<Complex64>; 3])| {
                let part = |chain: usize| {
                    FRAME[*i][chain] * FRAME[*o][chain] * x[chain][points[*point].storey]
                };
                let sum: Complex64 = (0..3).map(part).sum();
                -sum * levers * circular(k + 1).powi(2)
            };
            let nothing = std::iter::once(Complex64::default());
            nothing.chain(answers.iter().enumerate().map(at)).collect()
        };
        responses.iter().map(response).collect()
    };
    forces.iter().map(of).collect()
}

/// Noise of this share of the rms of every response.
pub fn spoil(all: &mut [Vec<Vec<Complex64>>], share: f64, seed: u64) {
    let mut random = Random::new(seed);
    for response in all.iter_mut().flatten() {
        let square: f64 = response.iter().map(Complex64::norm_sqr).sum();
        let by = share * (0.5 * square / response.len() as f64).sqrt();
        for value in response.iter_mut() {
            *value += by * Complex64::new(random.normal(), random.normal());
        }
    }
}

/// Data set 164: length in mm, force in N.
pub const MILLIMETRES: &str = "    -1\n   164\n         9USER DEFINED                 2\n  1.00000000000000000E+03  1.00000000000000000E+00  1.00000000000000000E+00\n  2.73149999999999977E+02\n    -1\n";

/// A node as data set 15 has it, mm.
pub fn node_15(point: &Point) -> String {
    let [x, y, z] = point.at.map(|v| 1e3 * v);
    format!(
        "{:>10}{:>10}{:>10}{:>10}{x:>13.5E}{y:>13.5E}{z:>13.5E}\n",
        point.node, 0, 0, 11
    )
}

/// A node as data set 2411 has it, mm, with the D of FORTRAN.
pub fn node_2411(point: &Point) -> String {
    let place = point.at.map(|v| {
        format!(
            "{:>25}",
            format!("{:.16E}", 1e3 * v)
                .replace('E', "D+0")
                .replace("D+0-", "D-0")
        )
    });
    format!(
        "{:>10}{:>10}{:>10}{:>10}\n{}\n",
        point.node,
        0,
        0,
        11,
        place.concat()
    )
}

/// A block of a data set.
pub fn block(set: u32, body: &str) -> String {
    format!("    -1\n{set:>6}\n{body}    -1\n")
}

/// Nodes (half of them as 15, half as 2411), rings and columns as trace lines.
pub fn geometry(points: &[Point]) -> String {
    let (first, second) = points.split_at(points.len() / 2);
    let mut text = block(15, &first.iter().map(node_15).collect::<String>());
    text += &block(2411, &second.iter().map(node_2411).collect::<String>());
    for storey in 0..STOREYS {
        let ring = (0..=AROUND).map(|a| points[storey * AROUND + a % AROUND].node);
        text += &trace(storey as i64 + 1, &ring.collect::<Vec<_>>());
    }
    let column = |a: usize| (0..STOREYS).map(move |s| s * AROUND + a);
    let mut columns = Vec::new();
    for a in 0..AROUND {
        columns.extend(column(a).map(|k| points[k].node));
        columns.extend([points[points.len() - 1].node, 0]);
    }
    text + &trace(99, &columns)
}

/// A trace line, eight labels to a record.
pub fn trace(number: i64, nodes: &[i64]) -> String {
    let mut body = format!("{number:>10}{:>10}{:>10}\nwires\n", nodes.len(), 3);
    for row in nodes.chunks(8) {
        row.iter().for_each(|node| {
            let _ = write!(body, "{node:>10}");
        });
        body.push('\n');
    }
    block(82, &body)
}

/// A frequency response in mm/s² per N, data set 58 of function type 4, single precision text. A direction
/// may point against its axis: the values are then turned too.
pub fn response(ends: [(i64, i64); 2], values: &[Complex64]) -> String {
    let [(out, od), (hit, hd)] = ends;
    let sign = (od.signum() * hd.signum()) as f64;
    let mut body = String::from("FRF\nNONE\n22-Nov-26\nNONE\nNONE\n");
    let _ = writeln!(
        body,
        "{:>5}{:>10}{:>5}{:>10} {:<10}{out:>10}{od:>4} {:<10}{hit:>10}{hd:>4}",
        4, 1, 0, 0, "NONE", "NONE"
    );
    let _ = writeln!(
        body,
        "{:>10}{:>10}{:>10}{:>13.5E}{:>13.5E}{:>13.5E}",
        5,
        values.len(),
        1,
        0.0,
        STEP_HZ,
        0.0
    );
    for (code, name) in [(18, "Hz"), (12, "mm/s^2"), (13, "N"), (0, "NONE")] {
        let _ = writeln!(
            body,
            "{code:>10}{:>5}{:>5}{:>5} {:<20} {name:<20}",
            0, 0, 0, "NONE"
        );
    }
    for row in values.chunks(3) {
        for v in row {
            let v = v * 1e3 * sign;
            let _ = write!(body, "{:>13.5E}{:>13.5E}", v.re, v.im);
        }
        body.push('\n');
    }
    block(58, &body)
}

/// The whole file.
pub fn file(
    points: &[Point],
    forces: &[Dof],
    responses: &[Dof],
    all: &[Vec<Vec<Complex64>>],
) -> String {
    let mut text = MILLIMETRES.to_string() + &geometry(points);
    for (f, force) in forces.iter().enumerate() {
        for (r, place) in responses.iter().enumerate() {
            let end = |(point, axis): &Dof| (points[*point].node, *axis as i64 + 1);
            let mut out = end(place);
            // Every seventh accelerometer was glued on upside down.
            if r % 7 == 3 {
                out.1 = -out.1;
            }
            text += &response([out, end(force)], &all[f][r]);
        }
    }
    text
}

/// All directions of all points.
pub fn everywhere(points: &[Point]) -> Vec<Dof> {
    (0..points.len())
        .flat_map(|p| (0..3).map(move |axis| (p, axis)))
        .collect()
}
