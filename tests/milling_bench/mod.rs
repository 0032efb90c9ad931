//! A dynamometer by other means: each tooth's surface by root finding on its trochoid, slices of the
//! tool one by one, the low pass integrated through time. Nothing of the program is used but its noise.
#![allow(dead_code)]

pub mod hidden;

use ident::ground::random::Random;
use std::f64::consts::{PI, TAU};

/// The cutter, m and rad.
#[derive(Debug, Clone)]
pub struct Cutter {
    pub radius: f64,
    pub teeth: usize,
    pub helix: f64,
    pub runout: f64,
    pub runout_angle: f64,
    /// By how much tooth 1 is shorter, m.
    pub chip: f64,
}

/// A cut: rev/min, mm/min, mm, mm, side.
#[derive(Debug, Clone, Copy)]
pub struct Pass {
    pub rpm: f64,
    pub feed: f64,
    pub depth: f64,
    pub width: f64,
    pub side: &'static str,
}

/// How it is recorded.
#[derive(Debug, Clone)]
pub struct Recording {
    pub rate_hz: f64,
    pub turns: f64,
    pub bandwidth_hz: Option<f64>,
    pub noise: f64,
    /// First-order colour of the noise, 0: white.
    pub colour: f64,
    /// Chips clipped at the border of the stock along their ray, or cut off at the nominal angle.
    pub clipped: bool,
    /// A resonance of the sensor: Hz, damping ratio, axis (3: all).
    pub ring: Option<[f64; 3]>,
}

const SLICES: usize = 12;
const AROUND: usize = 1440;

/// Force on the tool around one revolution, N; coefficients in N/mm² and N/mm.
pub fn around(cutter: &Cutter, pass: &Pass, k: &[f64; 6], clipped: bool) -> Vec<[f64; 3]> {
    let slice = pass.depth * 1e-3 / SLICES as f64;
    (0..AROUND)
        .map(|i| {
            let spindle = TAU * i as f64 / AROUND as f64;
            let mut f = [0.0; 3];
            for s in 0..SLICES {
                let z = (s as f64 + 0.5) * slice;
                for tooth in 0..cutter.teeth {
                    let add = edge(cutter, pass, k, clipped, spindle, z, tooth);
                    (0..3).for_each(|a| f[a] += add[a] * slice);
                }
            }
            f
        })
        .collect()
}

fn lag(cutter: &Cutter, z: f64) -> f64 {
    z * cutter.helix.tan() / cutter.radius
}

fn real_radius(cutter: &Cutter, tooth: usize, z: f64) -> f64 {
    let own = TAU * tooth as f64 / cutter.teeth as f64 - lag(cutter, z);
    let chip = if tooth == 0 { cutter.chip } else { 0.0 };
    cutter.radius + cutter.runout * (cutter.runout_angle - own).cos() - chip
}

fn edge(
    cutter: &Cutter,
    pass: &Pass,
    k: &[f64; 6],
    clipped: bool,
    spindle: f64,
    z: f64,
    tooth: usize,
) -> [f64; 3] {
    let phi = spindle + TAU * tooth as f64 / cutter.teeth as f64 - lag(cutter, z);
    let (s, c) = phi.sin_cos();
    if s < -0.1 {
        return [0.0; 3];
    }
    let own = real_radius(cutter, tooth, z);
    let border = cutter.radius - pass.width * 1e-3;
    let ahead = match pass.side {
        "up" => own * c - border,
        "down" => -own * c - border,
        _ => 1.0,
    };
    if ahead < 0.0 {
        return [0.0; 3];
    }
    let mut chip = own - surface(cutter, pass, tooth, z, phi);
    let into = if pass.side == "up" { c } else { -c };
    if clipped && pass.side != "slot" && border > 0.0 && into > 0.0 {
        chip = chip.min(own - border / into);
    }
    if chip <= 0.0 {
        return [0.0; 3];
    }
    let per = |a: usize| k[a] * 1e6 * chip + k[a + 3] * 1e3;
    let (t, r, a) = (per(0), per(1), per(2));
    [-t * c - r * s, t * s - r * c, a]
}

/// Distance along the ray at φ to the farthest surface that an earlier passage left.
fn surface(cutter: &Cutter, pass: &Pass, tooth: usize, z: f64, phi: f64) -> f64 {
    let omega = pass.rpm * TAU / 60.0;
    let v = pass.feed * 1e-3 / 60.0;
    let (s, c) = phi.sin_cos();
    let mut far = f64::MIN;
    for before in 1..=2 * cutter.teeth {
        let radius = real_radius(cutter, (tooth + before) % cutter.teeth, z);
        let pitch = TAU * before as f64 / cutter.teeth as f64;
        // position of that tooth `back` seconds ago, seen from the axis now
        let place = |back: f64| {
            let angle = phi + pitch - omega * back;
            [-v * back + radius * angle.sin(), radius * angle.cos()]
        };
        let off = |back: f64| {
            let [x, y] = place(back);
            x * c - y * s
        };
        let (mut a, mut b) = (pitch / omega, (pitch + 1e-3) / omega);
        for _ in 0..12 {
            let (fa, fb) = (off(a), off(b));
            if (fb - fa).abs() < 1e-18 {
                break;
            }
            (a, b) = (b, b - fb * (b - a) / (fb - fa));
            if (b - a).abs() * omega < 1e-12 {
                break;
            }
        }
        let [x, y] = place(b);
        far = far.max(x * s + y * c);
    }
    far
}

/// A record: rows of cut, time, force on the workpiece.
pub fn record(
    cutter: &Cutter,
    passes: &[Pass],
    k: &[f64; 6],
    recording: &Recording,
    random: &mut Random,
) -> Vec<[f64; 5]> {
    let mut rows = Vec::new();
    let mut clock = 0.0;
    let mut noise = [0.0; 3];
    for (number, pass) in passes.iter().enumerate() {
        let wave = around(cutter, pass, k, recording.clipped);
        let rate = pass.rpm / 60.0;
        let first = random.uniform(0.0, 1.0);
        let at = |turns: f64| {
            let x = turns.rem_euclid(1.0) * AROUND as f64;
            let (i, u) = (x as usize % AROUND, x.fract());
            let (a, b) = (wave[i], wave[(i + 1) % AROUND]);
            [0, 1, 2].map(|q| a[q] + u * (b[q] - a[q]))
        };
        let step = 1.0 / recording.rate_hz;
        let samples = (recording.turns / rate / step) as usize;
        let mut filter = Filter::new(recording.bandwidth_hz, step);
        let mut ring = Ring::new(recording.ring, step);
        let warm = (2.0 / rate / step) as usize;
        for i in 0..warm + samples {
            let t = i as f64 * step;
            let f = filter.next(|u| ring.next(u, at(first + rate * (t + u))));
            if i < warm {
                continue;
            }
            let keep = (1.0 - recording.colour.powi(2)).sqrt();
            for n in &mut noise {
                *n = recording.colour * *n + keep * recording.noise * random.normal();
            }
            rows.push([
                number as f64 + 1.0,
                clock + (i - warm) as f64 * step,
                -(f[0] + noise[0]),
                -(f[1] + noise[1]),
                -(f[2] + noise[2]),
            ]);
        }
        clock += (samples as f64 + 1.0) * step + 0.1;
    }
    rows
}

/// The low pass through time, in small steps of the trapezoidal rule.
struct Filter {
    corner: Option<f64>,
    step: f64,
    state: [[f64; 2]; 3],
}

const FINE: usize = 12;

impl Filter {
    fn new(corner: Option<f64>, step: f64) -> Self {
        Self {
            corner,
            step,
            state: [[0.0; 2]; 3],
        }
    }

    /// The output now; then it moves on by one step.
    fn next(&mut self, mut input: impl FnMut(f64) -> [f64; 3]) -> [f64; 3] {
        let Some(corner) = self.corner else {
            return input(0.0);
        };
        let out = self.state.map(|s| s[0]);
        let (w, h) = (TAU * corner, self.step / FINE as f64);
        for i in 0..FINE {
            let u = input((i as f64 + 0.5) * h);
            for (s, u) in self.state.iter_mut().zip(u) {
                // midpoint rule: y'' = w² (u - y) - √2 w y'
                let rate = |y: f64, d: f64| w * w * (u - y) - 2.0_f64.sqrt() * w * d;
                let (y, d) = (s[0] + 0.5 * h * s[1], s[1] + 0.5 * h * rate(s[0], s[1]));
                (s[0], s[1]) = (s[0] + h * d, s[1] + h * rate(y, d));
            }
        }
        out
    }
}

/// A resonance in front of the low pass; called at times that only go forward.
struct Ring {
    of: Option<[f64; 3]>,
    step: f64,
    state: [[f64; 2]; 3],
}

impl Ring {
    fn new(of: Option<[f64; 3]>, step: f64) -> Self {
        Self {
            of,
            step: step / FINE as f64,
            state: [[0.0; 2]; 3],
        }
    }

    /// What it shows after one more small step (an ideal sensor reads a whole step at once).
    fn next(&mut self, within: f64, input: [f64; 3]) -> [f64; 3] {
        let Some([hz, damping, axis]) = self.of else {
            return input;
        };
        let w = TAU * hz;
        let count = if within == 0.0 { FINE } else { 1 };
        let mut out = input;
        for k in (0..3).filter(|k| axis == 3.0 || *k as f64 == axis) {
            let [x, v] = &mut self.state[k];
            for _ in 0..count * 4 {
                let h = 0.25 * self.step;
                *v += h * (w * w * (input[k] - *x) - 2.0 * damping * w * *v);
                *x += h * *v;
            }
            out[k] = *x;
        }
        out
    }
}

/// The file of a record.
pub fn csv(cutter: &Cutter, passes: &[Pass], recording: &Recording, rows: &[[f64; 5]]) -> String {
    let cuts: Vec<String> = passes
        .iter()
        .map(|p| {
            format!(
                "{{ spindle_rpm = {:?}, feed_mm_min = {:?}, depth_mm = {:?}, width_mm = {:?}, cut = \"{}\" }}",
                p.rpm, p.feed, p.depth, p.width, p.side
            )
        })
        .collect();
    let bandwidth = recording
        .bandwidth_hz
        .map_or(String::new(), |b| format!("# bandwidth_Hz = {b:?}\n"));
    let mut text = format!(
        "# kind = \"milling-force\"\n# synthetic = true\n# diameter_mm = {:?}\n# teeth = {}\n# helix_deg = {:?}\n# cuts = [{}]\n# sensor_noise_N = {:?}\n{bandwidth}cut,time_s,fx_N,fy_N,fz_N\n",
        2e3 * cutter.radius,
        cutter.teeth,
        cutter.helix * 180.0 / PI,
        cuts.join(", "),
        recording.noise,
    );
    for r in rows {
        text += &format!("{},{:.7},{:.4},{:.4},{:.4}\n", r[0], r[1], r[2], r[3], r[4]);
    }
    text
}
