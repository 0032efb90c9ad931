//! ident's side of `beside_lobes.py`: `cargo bench --bench beside_lobes -- CASE PASSES`.
//!
//! CASE is text: a line `diameter teeth width side Kt Kr` (m, N/m²), a line of speeds (rev/min), a line of depths
//! (m), then modes `x y hertz damping stiffness`. The answer is the spectral radius of every depth at every
//! speed. PASSES rounds are timed, the fastest counts; the processor's time is that of all threads.

use ident::cutting::directional::Directional;
use ident::cutting::mean::engagement;
use ident::cutting::stability::{Passing, TipMode};
use ident::cutting::wave::{Cut, Side};
use ident::cutting::{Material, Tool};
use rayon::prelude::*;
use serde_json::json;
use std::f64::consts::TAU;
use std::time::Instant;

fn main() {
    // `--bench` comes from cargo
    let typed: Vec<String> = std::env::args()
        .skip(1)
        .filter(|argument| argument != "--bench")
        .collect();
    let [case, passes] = typed.as_slice() else {
        println!("usage: beside_lobes CASE PASSES (see benches/peers/README.md)");
        return;
    };
    let case = Case::read(&std::fs::read_to_string(case).unwrap());
    let (mut clock, mut radii) = (f64::INFINITY, Vec::new());
    for _ in 0..passes.parse().unwrap() {
        let start = Instant::now();
        radii = case.radii();
        clock = clock.min(start.elapsed().as_secs_f64());
    }
    println!("{}", json!({ "radii": radii, "s": clock }));
}

struct Case {
    tool: Tool,
    cut: Cut,
    material: Material,
    speeds: Vec<f64>,
    depths: Vec<f64>,
    modes: Vec<TipMode>,
}

impl Case {
    fn read(text: &str) -> Self {
        let mut lines = text.lines().map(|l| l.split_whitespace());
        let head: Vec<&str> = lines.next().unwrap().collect();
        let number = |i: usize| head[i].parse::<f64>().unwrap();
        let mut row = || -> Vec<f64> {
            let line = lines.next().unwrap();
            line.map(|w| w.parse().unwrap()).collect()
        };
        let (speeds, depths) = (row(), row());
        let mode = |m: Vec<f64>| TipMode {
            direction: [m[0], m[1], 0.0],
            omega: TAU * m[2],
            damping_ratio: m[3],
            stiffness: m[4],
        };
        let modes = lines.map(|l| mode(l.map(|w| w.parse().unwrap()).collect()));
        let side = match head[3] {
            "up" => Side::Up,
            "down" => Side::Down,
            _ => Side::Slot,
        };
        Self {
            tool: Tool::square(0.5 * number(0), number(1) as usize, 0.0),
            cut: Cut {
                spindle_rad_s: 1.0,
                feed_m_s: 0.0,
                depth_m: 1e-3,
                width_m: number(2),
                side,
            },
            material: Material::linear_edge([
                1e-6 * number(4),
                1e-6 * number(5),
                0.0,
                0.0,
                0.0,
                0.0,
            ]),
            speeds,
            depths,
            modes: modes.collect(),
        }
    }

    fn radii(&self) -> Vec<Vec<f64>> {
        let angles = engagement(&self.cut, self.tool.radius_m);
        let cut = Directional::new(&self.tool, &self.material, angles, 1e-3, 5e-5);
        let at = |rpm: &f64| -> Vec<f64> {
            let passing_s = 60.0 / rpm / self.tool.teeth as f64;
            let passing = Passing::new(&self.modes, &cut, passing_s, 1.0);
            let radius = |depth: &f64| passing.radius(*depth);
            self.depths.iter().map(radius).collect()
        };
        self.speeds.par_iter().map(at).collect()
    }
}
