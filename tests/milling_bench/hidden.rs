//! Cuts that hide something: random tools, cuts, sensors and faults for the test bench.

use super::{Cutter, Pass, Recording, csv, record};
use ident::ground::random::Random;
use std::f64::consts::TAU;

/// Faults of the contract, in the order of its table.
pub const FAULTS: [&str; 13] = [
    "cutting_coefficients",
    "edge_coefficients",
    "runout",
    "chipped_tooth",
    "width_of_cut",
    "depth_of_cut",
    "spindle_speed",
    "force_gain",
    "cross_talk",
    "sensor_offset",
    "thermal_drift",
    "sensor_resonance",
    "chatter",
];

/// What no effect of the contract makes.
pub const STRANGERS: [&str; 5] = ["softening", "saturation", "quadratic", "fading", "gap"];

const MATERIALS: [[f64; 6]; 4] = [
    [1319.41, 788.83, 48.75, 19.65, 26.77, 2.05],
    [951.365, 262.597, 323.33, 11.115, 11.314, 1.105],
    [767.01, 168.8, 222.0, 27.7, 26.6, 0.7],
    [631.0, 99.0, 273.0, 13.0, 10.0, 2.8],
];

/// A file that hides some faults.
#[derive(Debug, Clone)]
pub struct Hidden {
    /// What was hidden.
    pub faults: Vec<&'static str>,
    /// How much of each, in words.
    pub told: Vec<String>,
    /// The file.
    pub text: String,
    /// The tool.
    pub teeth: usize,
}

struct Bench<'a> {
    cutter: Cutter,
    done: Vec<Pass>,
    truth: [f64; 6],
    recording: Recording,
    after: Vec<After<'a>>,
    random: Random,
    told: Vec<String>,
}

type After<'a> = Box<dyn Fn(&mut Vec<[f64; 5]>) + 'a>;

/// A case with these faults.
pub fn hidden(seed: u64, faults: &[&'static str]) -> Hidden {
    let mut random = Random::new(seed);
    let teeth = 2 + random.below(3);
    let diameter = [8.0, 12.0, 16.0, 20.0][random.below(4)];
    let cutter = Cutter {
        radius: 0.5e-3 * diameter,
        teeth,
        helix: [0.0, 0.35, 0.5235987755982988, 0.7][random.below(4)],
        runout: 0.0,
        runout_angle: random.uniform(-3.0, 3.0),
        chip: 0.0,
    };
    let nominal = MATERIALS[random.below(4)];
    let rel_std = [0.02, 0.04, 0.06][random.below(3)];
    let truth = nominal.map(|k| k * (1.0 + rel_std * random.normal().clamp(-2.0, 2.0)));
    let said = passes(&mut random, diameter);
    let recording = Recording {
        rate_hz: [16_000.0, 20_000.0, 25_600.0][random.below(3)],
        turns: random.uniform(4.0, 8.0),
        bandwidth_hz: [None, Some(1500.0), Some(3000.0)][random.below(3)],
        noise: random.log_uniform(1.0, 5.0),
        colour: 0.0,
        clipped: true,
        ring: None,
    };
    let mut bench = Bench {
        cutter: cutter.clone(),
        done: said.clone(),
        truth,
        recording: recording.clone(),
        after: Vec::new(),
        random,
        told: Vec::new(),
    };
    for fault in faults {
        bench.hide(fault);
    }
    let mut rows = record(
        &bench.cutter,
        &bench.done,
        &bench.truth,
        &bench.recording,
        &mut bench.random,
    );
    bench.after.iter().for_each(|change| change(&mut rows));
    let names = [
        "Ktc_N_mm2",
        "Krc_N_mm2",
        "Kac_N_mm2",
        "Kte_N_mm",
        "Kre_N_mm",
        "Kae_N_mm",
    ];
    let stated: Vec<String> = names
        .iter()
        .zip(nominal)
        .map(|(name, k)| format!("{name} = {k:?}"))
        .collect();
    let nominal = format!(
        "# nominal = {{ {}, rel_std = {rel_std} }}\ncut,time_s",
        stated.join(", ")
    );
    Hidden {
        faults: faults.to_vec(),
        text: csv(&cutter, &said, &recording, &rows).replace("cut,time_s", &nominal),
        told: bench.told,
        teeth,
    }
}

fn passes(random: &mut Random, diameter: f64) -> Vec<Pass> {
    let rpm = random.uniform(4000.0, 10_000.0).round();
    let depth = random.uniform(1.0, 2.0);
    let pass = |fz: f64, depth: f64, width: f64, side: &'static str| Pass {
        rpm,
        feed: (fz * rpm * 2.0).round(),
        depth: (depth * 100.0).round() / 100.0,
        width: (width * 100.0).round() / 100.0,
        side,
    };
    let mut all = vec![
        pass(random.uniform(0.06, 0.1), depth, diameter, "slot"),
        pass(random.uniform(0.12, 0.18), depth, diameter, "slot"),
        pass(
            random.uniform(0.08, 0.15),
            1.5 * depth,
            random.uniform(0.25, 0.45) * diameter,
            "down",
        ),
        pass(
            random.uniform(0.08, 0.15),
            1.3 * depth,
            random.uniform(0.4, 0.6) * diameter,
            "up",
        ),
    ];
    if random.below(2) == 0 {
        all.push(pass(
            random.uniform(0.08, 0.15),
            depth,
            0.2 * diameter,
            "down",
        ));
    }
    all
}

impl Bench<'_> {
    fn sign(&mut self) -> f64 {
        if self.random.below(2) == 0 { 1.0 } else { -1.0 }
    }

    fn hide(&mut self, fault: &str) {
        let told = match fault {
            "cutting_coefficients" => self.coefficients(0, [1.2, 1.5]),
            "edge_coefficients" => self.coefficients(3, [1.6, 2.6]),
            "runout" => {
                self.cutter.runout = self.random.log_uniform(6e-6, 40e-6);
                format!("{:.1} µm", 1e6 * self.cutter.runout)
            }
            "chipped_tooth" => {
                self.cutter.chip = self.random.log_uniform(10e-6, 80e-6);
                format!("{:.1} µm", 1e6 * self.cutter.chip)
            }
            "width_of_cut" => {
                let by = self.sign() * self.random.uniform(0.3, 0.9);
                let most = 2e3 * self.cutter.radius;
                self.done
                    .iter_mut()
                    .filter(|p| p.side != "slot")
                    .for_each(|p| p.width = (p.width + by).min(most));
                format!("{by:.2} mm")
            }
            "depth_of_cut" => {
                let by = self.sign() * self.random.uniform(0.15, 0.4);
                self.done.iter_mut().for_each(|p| p.depth += by);
                format!("{by:.2} mm")
            }
            "spindle_speed" => {
                let by = self.sign() * self.random.log_uniform(0.003, 0.03);
                self.done.iter_mut().for_each(|p| p.rpm *= 1.0 + by);
                format!("{by:.4}")
            }
            "force_gain" => {
                let (k, by) = (
                    self.random.below(3),
                    self.sign() * self.random.uniform(0.08, 0.3),
                );
                self.each(move |r| r[2 + k] *= 1.0 + by);
                format!("{k} {by:.2}")
            }
            "cross_talk" => {
                let (k, by) = (
                    self.random.below(3),
                    self.sign() * self.random.uniform(0.06, 0.2),
                );
                let to = (k + 1 + self.random.below(2)) % 3;
                self.each(move |r| r[2 + to] += by * r[2 + k]);
                format!("{k} to {to} {by:.2}")
            }
            "sensor_offset" => {
                let (k, by) = (
                    self.random.below(3),
                    self.sign() * self.random.uniform(6.0, 30.0),
                );
                self.each(move |r| r[2 + k] += by);
                format!("{k} {by:.1} N")
            }
            "thermal_drift" => {
                let (k, by) = (
                    self.random.below(3),
                    self.sign() * self.random.uniform(20.0, 60.0),
                );
                self.rows(move |rows| {
                    let (first, last) = (rows[0][1], rows[rows.len() - 1][1]);
                    rows.iter_mut()
                        .for_each(|r| r[2 + k] += by * (r[1] - first) / (last - first));
                });
                format!("{k} {by:.1} N")
            }
            "sensor_resonance" => {
                let ring = [
                    self.random.log_uniform(700.0, 2500.0),
                    self.random.log_uniform(0.02, 0.12),
                    [0.0, 1.0, 3.0][self.random.below(3)],
                ];
                self.recording.ring = Some(ring);
                format!("{:.0} Hz {:.3} axis {}", ring[0], ring[1], ring[2])
            }
            "chatter" => {
                let cut = 1.0 + self.random.below(self.done.len()) as f64;
                let hz = self.done[0].rpm / 60.0 * (4.0 + 8.0 * self.random.unit()).floor()
                    + self.done[0].rpm / 60.0 * self.random.uniform(0.25, 0.75);
                let size = self.random.uniform(15.0, 50.0);
                let phase = self.random.uniform(0.0, TAU);
                self.each(move |r| {
                    if r[0] == cut {
                        r[2] += size * (TAU * hz * r[1]).sin();
                        r[3] += 0.8 * size * (TAU * hz * r[1] + phase).sin();
                    }
                });
                format!("cut {cut} {hz:.0} Hz {size:.0} N")
            }
            "softening" => {
                self.each(|r| {
                    (2..5)
                        .for_each(|k| r[k] = r[k].signum() * 20.0 * (r[k].abs() / 20.0).powf(0.75))
                });
                String::new()
            }
            "saturation" => {
                self.rows(|rows| {
                    for k in 2..4 {
                        let top = rows.iter().fold(0.0_f64, |a, r| a.max(r[k].abs()));
                        rows.iter_mut()
                            .for_each(|r| r[k] = r[k].clamp(-0.55 * top, 0.55 * top));
                    }
                });
                String::new()
            }
            "quadratic" => {
                self.rows(|rows| {
                    let top = rows.iter().fold(0.0_f64, |a, r| a.max(r[3].abs()));
                    rows.iter_mut()
                        .for_each(|r| r[3] += 0.35 * r[3].abs() * r[3] / top);
                });
                String::new()
            }
            "fading" => {
                // the edge wears within each cut
                self.rows(|rows| {
                    let first: Vec<f64> = (1..10)
                        .map(|c| {
                            rows.iter()
                                .find(|r| r[0] as usize == c)
                                .map_or(0.0, |r| r[1])
                        })
                        .collect();
                    rows.iter_mut().for_each(|r| {
                        let t = r[1] - first[r[0] as usize - 1];
                        (2..5).for_each(|k| r[k] *= 1.0 + 12.0 * t);
                    });
                });
                String::new()
            }
            "gap" => {
                // a hole in the workpiece: half of every record cuts little
                let share = self.random.uniform(0.3, 0.5);
                self.rows(move |rows| {
                    for cut in 1..10 {
                        let own: Vec<usize> = (0..rows.len())
                            .filter(|i| rows[*i][0] as usize == cut)
                            .collect();
                        for i in own.iter().skip(own.len() / 3).take(own.len() / 3) {
                            (2..5).for_each(|k| rows[*i][k] *= share);
                        }
                    }
                });
                String::new()
            }
            _ => unreachable!("{fault}"),
        };
        self.told.push(format!("{fault} {told}"));
    }

    fn coefficients(&mut self, first: usize, [low, high]: [f64; 2]) -> String {
        let factor = self.random.uniform(low, high);
        (first..first + 3).for_each(|j| self.truth[j] *= factor);
        format!("x {factor:.2}")
    }

    fn each(&mut self, change: impl Fn(&mut [f64; 5]) + 'static) {
        self.rows(move |rows| rows.iter_mut().for_each(&change));
    }

    fn rows(&mut self, change: impl Fn(&mut Vec<[f64; 5]>) + 'static) {
        self.after.push(Box::new(change));
    }
}
