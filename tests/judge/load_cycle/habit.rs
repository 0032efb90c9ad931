//! How the laboratory clamps, reads and writes.

use super::super::{chance, pick};
use ident::ground::random::Random;

/// Unit of a column: ending of its title, and how many of it are one SI unit.
pub type Unit = (&'static str, f64);

/// A sensor: its true lever (m) if it reads a displacement, and what the file says of it.
#[derive(Debug, Clone)]
pub struct Sensor {
    pub lever: Option<f64>,
    pub told: Option<f64>,
}

/// One laboratory.
#[derive(Debug, Clone)]
pub struct Habit {
    pub joint: usize,
    pub tilt: bool,
    /// A turning joint, not a spring along a line.
    pub turning: bool,
    /// True stiffness, N·m/rad or N/m.
    pub stiffness: f64,
    /// Largest load, N·m or N.
    pub top: f64,
    pub load_lever: Option<f64>,
    pub told_load_lever: Option<f64>,
    pub sensors: Vec<Sensor>,
    pub load: Unit,
    pub response: Unit,
    pub milliseconds: bool,
    pub nominal: Option<f64>,
    pub nominal_std: f64,
    pub lever_std: f64,
    pub tells_std: bool,
    pub tells_rest: bool,
    pub tells_noise: bool,
    pub comma: bool,
    pub delimiter: char,
}

impl Habit {
    /// One by chance.
    pub fn draw(random: &mut Random) -> Self {
        let turning = chance(random, 0.85);
        let by_angle = turning && chance(random, 0.25);
        let levers = turning && !by_angle;
        let tells_std = chance(random, 0.6);
        let lever_std = if tells_std {
            *pick(random, &[0.001, 0.002, 0.005])
        } else {
            0.003
        };
        let about = |lever: f64, random: &mut Random| {
            lever * (1.0 + lever_std * random.normal().clamp(-2.0, 2.0))
        };
        let sensors = if levers {
            1 + usize::from(chance(random, 0.4))
        } else {
            1
        };
        let sensor = |random: &mut Random| {
            let lever = levers.then(|| (random.uniform(0.1, 0.9) * 1e3).round() / 1e3);
            Sensor {
                told: lever,
                lever: lever.map(|l| about(l, random)),
            }
        };
        let sensors = (0..sensors).map(|_| sensor(random)).collect();
        let told_load_lever = levers.then(|| (random.uniform(0.25, 1.4) * 1e3).round() / 1e3);
        let stiffness = if turning {
            random.log_uniform(1e5, 8e6)
        } else {
            random.log_uniform(8e5, 4e7)
        };
        let comma = chance(random, 0.2);
        Self {
            joint: 1 + random.below(6),
            tilt: chance(random, 0.4),
            turning,
            stiffness,
            top: random.log_uniform(250.0, 2500.0),
            load_lever: told_load_lever.map(|l| about(l, random)),
            told_load_lever,
            sensors,
            load: if by_angle {
                *pick(random, &[("moment_Nm", 1.0), ("moment_kNm", 1e-3)])
            } else {
                *pick(
                    random,
                    &[("force_N", 1.0), ("force_N", 1.0), ("force_kN", 1e-3)],
                )
            },
            response: if by_angle {
                *pick(
                    random,
                    &[
                        ("angle_rad", 1.0),
                        ("angle_mrad", 1e3),
                        ("angle_urad", 1e6),
                        ("angle_deg", 180.0 / std::f64::consts::PI),
                    ],
                )
            } else {
                *pick(
                    random,
                    &[
                        ("displacement_mm", 1e3),
                        ("displacement_mm", 1e3),
                        ("displacement_um", 1e6),
                        ("displacement_m", 1.0),
                    ],
                )
            },
            milliseconds: chance(random, 0.15),
            nominal: None,
            nominal_std: *pick(random, &[0.02, 0.05, 0.05, 0.1]),
            lever_std,
            tells_std,
            tells_rest: chance(random, 0.6),
            tells_noise: chance(random, 0.4),
            comma,
            delimiter: if comma {
                *pick(random, &[';', '\t'])
            } else {
                *pick(random, &[',', ',', ';', '\t'])
            },
        }
    }

    /// Deflection under the largest load, rad or m, times what sensor `i` makes of it in its unit.
    pub fn full(&self, i: usize) -> f64 {
        self.top / self.stiffness * self.sensors[i].lever.unwrap_or(1.0) * self.response.1
    }

    /// The largest load in the unit of its column.
    pub fn full_load(&self) -> f64 {
        self.top / self.load_lever.unwrap_or(1.0) * self.load.1
    }

    /// Deviation of the stiffness that levers and the stated one leave open.
    pub fn open(&self) -> f64 {
        let levers = if self.load_lever.is_some() {
            2.0 * self.lever_std.powi(2)
        } else {
            0.0
        };
        (self.nominal_std.powi(2) + levers).sqrt()
    }

    /// Front matter and titles.
    pub fn head(&self, rest: f64, noise: f64) -> String {
        let mut all = String::from("# kind = \"load-cycle\"\n# notes = { place = \"cell 4\" }\n");
        let mut say = |key: &str, value: String| all += &format!("# {key} = {value}\n");
        if self.turning {
            say("joint", self.joint.to_string());
            say(
                "axis",
                if self.tilt {
                    "\"tilt\""
                } else {
                    "\"rotation\""
                }
                .to_string(),
            );
        }
        if let Some(lever) = self.told_load_lever {
            say("load_lever_m", format!("{lever:?}"));
        }
        for (sensor, key) in self
            .sensors
            .iter()
            .zip(["sensor_lever_m", "sensor2_lever_m"])
        {
            if let Some(lever) = sensor.told {
                say(key, format!("{lever:.6}"));
            }
        }
        if let Some(nominal) = self.nominal {
            say(
                if self.turning {
                    "nominal_stiffness_Nm_rad"
                } else {
                    "nominal_stiffness_N_m"
                },
                format!("{nominal:.1}"),
            );
            say(
                "nominal_stiffness_rel_std",
                format!("{:?}", self.nominal_std),
            );
        }
        if self.tells_std && self.load_lever.is_some() {
            say("lever_rel_std", format!("{:?}", self.lever_std));
        }
        if self.tells_rest {
            say("rest_s", format!("{rest:.3}"));
        }
        if self.tells_noise && self.response.0.starts_with("displacement") {
            say(
                "sensor_noise_mm",
                format!("{:.7}", noise * self.full(0) / self.response.1 * 1e3),
            );
        }
        all + &self.titles() + "\n"
    }

    fn titles(&self) -> String {
        let time = if self.milliseconds {
            "time_ms"
        } else {
            "time_s"
        };
        let mut titles = vec![
            time.to_string(),
            self.load.0.to_string(),
            self.response.0.to_string(),
        ];
        if self.sensors.len() > 1 {
            titles.push(self.response.0.replacen("displacement", "displacement2", 1));
        }
        titles.join(&self.delimiter.to_string())
    }
}

/// Raster of one significant digit nearest below.
pub fn even_raster(raster: f64) -> f64 {
    let ten = 10.0_f64.powf(raster.log10().floor());
    let lead = raster / ten;
    ten * if lead >= 5.0 {
        5.0
    } else if lead >= 2.0 {
        2.0
    } else {
        1.0
    }
}

/// A number on a raster, with as many digits as that needs.
pub fn on_raster(value: f64, raster: f64) -> String {
    let digits = (-raster.log10().floor()).max(0.0) as usize;
    format!("{:.digits$}", (value / raster).round() * raster)
}
