//! A joint with two masses, stepped through time; it shares no formula with the diagnosis. The motor
//! side follows its path, the link hangs on a spring under gravity, the motor pays for everything.

use ident::ground::random::Random;

/// What is hidden in a record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hidden {
    pub name: &'static str,
    /// Delay of the link encoder, s.
    pub delay: f64,
    /// Width of a gap, rad.
    pub gap: f64,
    /// Jenkins elements in parallel to the spring: yield torque, N·m.
    pub slider: f64,
    /// Dry and viscous friction of the drive, N·m and N·m·s/rad.
    pub dry: f64,
    pub viscous: f64,
    /// Stiffness over the nominal one.
    pub stiffer: f64,
    /// Amplitude, rad, and order of a ripple: per turn of the link, or (negative) of the motor.
    pub ripple: (f64, f64),
    /// Jump of the zero, rad, and its instant as a share of the record.
    pub jump: (f64, f64),
    /// Constant difference of the zeros, rad.
    pub zero: f64,
    /// What no cause of the library makes: a drift of a zero, rad, a spring stiffer by this share under load, a slow
    /// error over the joint angle, rad, and a ripple that grows with the speed, rad.
    pub strange: [f64; 4],
}

pub const NAMES: [&str; 9] = [
    "clean",
    "time_skew",
    "backlash",
    "hysteresis",
    "coulomb_friction",
    "viscous_friction",
    "stiffness",
    "encoder_ripple",
    "sensor_offset",
];

/// What no cause of the library makes.
pub const STRANGE: [&str; 4] = ["drift", "stiffening", "gear_error", "teeth"];

/// A joint and its motion.
struct Plant {
    k: f64,
    inertia: f64,
    rotor: f64,
    gravity: f64,
    /// What the other axes load on this one: torque, rad/s and phase of each tone.
    coupling: Vec<[f64; 3]>,
    ratio: f64,
    noise: f64,
    torque_noise: f64,
    quantum: f64,
    step: f64,
    tones: Vec<[f64; 3]>,
    moves: Vec<f64>,
}

const SECONDS: f64 = 12.0;

impl Plant {
    fn draw(r: &mut Random, needs_reversal: bool) -> Self {
        let k = r.log_uniform(1.5e6, 6e6);
        let gravity = if needs_reversal {
            r.uniform(1500.0, 2500.0)
        } else {
            r.uniform(2000.0, 4000.0)
        };
        let tones = (0..3)
            .map(|i| {
                [
                    r.uniform(0.25, 0.5) / f64::from(i + 1),
                    r.uniform(0.7, 1.3) * f64::from(i + 1),
                    r.uniform(0.0, 6.2),
                ]
            })
            .collect();
        Self {
            k,
            inertia: r.uniform(150.0, 500.0),
            rotor: r.uniform(80.0, 250.0),
            gravity,
            coupling: (0..3)
                .map(|_| {
                    [
                        gravity * r.uniform(0.12, 0.3),
                        r.uniform(0.8, 3.0),
                        r.uniform(0.0, 6.2),
                    ]
                })
                .collect(),
            ratio: r.uniform(120.0, 270.0),
            noise: r.uniform(2e-6, 8e-6),
            torque_noise: r.uniform(0.005, 0.02),
            quantum: r.log_uniform(1e-7, 4e-6),
            step: if r.unit() < 0.5 { 0.004 } else { 0.008 },
            tones,
            moves: (0..5).map(|_| r.uniform(-0.9, 0.9)).collect(),
        }
    }

    /// Path of the motor side: quintic moves with rests, and tones on top that fade in and out.
    fn path(&self, t: f64) -> f64 {
        let leg = SECONDS / (self.moves.len() - 1) as f64;
        let i = ((t / leg).max(0.0) as usize).min(self.moves.len() - 2);
        let s = ((t - i as f64 * leg) / (0.85 * leg)).clamp(0.0, 1.0);
        let blend = s * s * s * (10.0 + s * (6.0 * s - 15.0));
        let fade = (std::f64::consts::PI * (t / SECONDS).clamp(0.0, 1.0))
            .sin()
            .powi(2);
        let wave: f64 = self
            .tones
            .iter()
            .map(|[a, w, p]| a * (w * t + p).sin())
            .sum();
        self.moves[i] + (self.moves[i + 1] - self.moves[i]) * blend + 0.5 * fade * wave
    }

    fn speed(&self, t: f64) -> f64 {
        (self.path(t + 5e-4) - self.path(t - 5e-4)) / 1e-3
    }
}

/// Torque of the spring with a gap and sliders, for a twist.
struct Spring {
    k: f64,
    half_gap: f64,
    stiffer: f64,
    load: f64,
    sliders: [(f64, f64, f64); 4],
}

impl Spring {
    fn new(k: f64, gap: f64, yields: f64, (stiffer, load): (f64, f64)) -> Self {
        // sliders that yield one after the other: a smooth loop
        let at = |share: f64| (yields * share, 0.3 * k, 0.0);
        Self {
            k,
            half_gap: 0.5 * gap,
            stiffer,
            load,
            sliders: [at(0.1), at(0.2), at(0.3), at(0.4)],
        }
    }

    fn torque(&mut self, twist: f64, change: f64) -> f64 {
        let beyond = twist - twist.clamp(-self.half_gap, self.half_gap);
        let most = self.k * beyond / self.load;
        let mut torque = self.k * beyond * (1.0 + self.stiffer * most * most);
        for (most, stiffness, force) in &mut self.sliders {
            if *most > 0.0 {
                *force = (*force + *stiffness * change).clamp(-*most, *most);
                torque += *force;
            }
        }
        torque
    }
}

/// A hidden effect of a size that can be seen.
pub fn hidden(name: &'static str, r: &mut Random, k: f64, load: f64) -> Hidden {
    let none = Hidden {
        name,
        delay: 0.0,
        gap: 0.0,
        slider: 0.0,
        dry: 0.0,
        viscous: 0.0,
        stiffer: 1.0,
        ripple: (0.0, 0.0),
        jump: (0.0, 0.5),
        zero: 0.0,
        strange: [0.0; 4],
    };
    let size = r.log_uniform(3e-5, 2e-4);
    let sign = if r.unit() < 0.5 { -1.0 } else { 1.0 };
    match name {
        "time_skew" => Hidden {
            delay: if r.unit() < 0.8 {
                r.uniform(5e-4, 4e-3)
            } else {
                -r.uniform(5e-4, 3e-3)
            },
            ..none
        },
        "backlash" => Hidden {
            gap: 2.0 * size,
            ..none
        },
        "hysteresis" => Hidden {
            slider: 0.6 * load * r.uniform(0.15, 0.4),
            ..none
        },
        "coulomb_friction" => Hidden {
            dry: k * size,
            ..none
        },
        "viscous_friction" => Hidden {
            viscous: k * size * 1.5,
            ..none
        },
        "stiffness" => Hidden {
            stiffer: (sign * r.uniform(0.25, 0.6)).exp(),
            ..none
        },
        "encoder_ripple" => {
            let order = match r.below(3) {
                0 => f64::from(16 + r.below(40) as i32),
                1 => -f64::from(1 + r.below(2) as i32),
                _ => f64::from(64 << r.below(3)),
            };
            Hidden {
                ripple: (size, order),
                ..none
            }
        }
        "sensor_offset" if r.unit() < 0.5 => Hidden {
            zero: sign * r.uniform(3e-3, 1e-2),
            ..none
        },
        "sensor_offset" => Hidden {
            jump: (sign * size, r.uniform(0.25, 0.75)),
            ..none
        },
        _ => Hidden {
            strange: std::array::from_fn(|i| match (STRANGE[i] == name, i) {
                (false, _) => 0.0,
                (true, 1) => r.uniform(0.5, 2.0),
                (true, _) => sign * size,
            }),
            ..none
        },
    }
}

/// The text of a record with one joint in which `name` is hidden.
pub fn record(name: &'static str, seed: u64) -> (String, Hidden) {
    let mut r = Random::new(seed);
    let plant = Plant::draw(&mut r, name == "backlash");
    let hidden = hidden(name, &mut r, plant.k, plant.gravity);
    let (rows, k) = simulate(&plant, &hidden, &mut r);
    let nominal = k * r.uniform(0.97, 1.03) / hidden.stiffer;
    let mut text = format!(
        "# kind = \"joint-motion\"\n# synthetic = true\n# gear_ratio = [{}]\n# nominal_stiffness_Nm_rad = {nominal:.1}\n# encoder_zero_std_deg = 0.02\ntime_s,motor_angle_deg_2,link_angle_deg_2,motor_torque_Nm_2,motor_speed_deg_s_2\n",
        plant.ratio
    );
    for [t, motor, link, torque, speed] in rows {
        text += &format!(
            "{t:.4},{:.7},{:.7},{torque:.5},{:.5}\n",
            motor.to_degrees(),
            link.to_degrees(),
            speed.to_degrees()
        );
    }
    (text, hidden)
}

/// The readings, and the stiffness of the straight line through the twist.
fn simulate(plant: &Plant, hidden: &Hidden, r: &mut Random) -> (Vec<[f64; 5]>, f64) {
    let fine = 1e-4;
    let mut spring = Spring::new(
        plant.k * (1.0 - hidden.slider / plant.gravity),
        hidden.gap,
        hidden.slider,
        (hidden.strange[1], plant.gravity),
    );
    let weight = |q: f64| {
        plant.gravity
            * (q + 0.2).cos()
            * if hidden.gap > 0.0 {
                (3.0 * q).sin()
            } else {
                1.0
            }
    };
    let others = |t: f64| -> f64 {
        plant
            .coupling
            .iter()
            .map(|[a, w, p]| a * (w * t + p).sin())
            .sum()
    };
    let (mut q, mut w) = (plant.path(-0.5) - weight(plant.path(-0.5)) / plant.k, 0.0);
    let damping = 0.08 * (plant.k * plant.inertia).sqrt();
    let lead = 5000;
    let total = lead + (SECONDS / fine) as usize;
    let mut history: Vec<[f64; 2]> = Vec::with_capacity(total);
    let mut before = plant.path(-0.5) - q;
    for i in 0..total {
        let t = (i as f64 - lead as f64) * fine;
        let (theta, dtheta) = (plant.path(t), plant.speed(t));
        let twist = theta - q;
        let torque = spring.torque(twist, twist - before) + damping * (dtheta - w);
        before = twist;
        history.push([q, torque]);
        w += fine * (torque - weight(q) - others(t)) / plant.inertia;
        q += fine * w;
    }
    let twist = |i: usize| plant.path((i as f64 - lead as f64) * fine) - history[i][0];
    let pairs: Vec<[f64; 2]> = (lead..total)
        .step_by(40)
        .map(|i| [history[i][1], twist(i)])
        .collect();
    let middle = |k: usize| pairs.iter().map(|p| p[k]).sum::<f64>() / pairs.len() as f64;
    let (mt, my) = (middle(0), middle(1));
    let (tt, ty) = pairs.iter().fold((0.0, 0.0), |(a, b), [t, y]| {
        (a + (t - mt).powi(2), b + (t - mt) * (y - my))
    });
    let line = if hidden.slider > 0.0 {
        tt / ty
    } else {
        plant.k
    };
    (sampled(plant, hidden, r, &history, (fine, lead)), line)
}

fn sampled(
    plant: &Plant,
    hidden: &Hidden,
    r: &mut Random,
    history: &[[f64; 2]],
    (fine, lead): (f64, usize),
) -> Vec<[f64; 5]> {
    let (mut slow, mut held) = (0.0, 0.0);
    let rough = |value: f64| (value / plant.quantum).round() * plant.quantum;
    let count = (SECONDS / plant.step) as usize - 2;
    let at = |t: f64, channel: usize| {
        let x = (t / fine + lead as f64).clamp(0.0, history.len() as f64 - 2.0);
        let (i, part) = (x as usize, x.fract());
        (1.0 - part) * history[i][channel] + part * history[i + 1][channel]
    };
    (0..count)
        .map(|i| {
            let t = i as f64 * plant.step;
            let v = plant.speed(t);
            let acceleration = (plant.speed(t + 1e-3) - plant.speed(t - 1e-3)) / 2e-3;
            if v.abs() > 2e-3 {
                held = v.signum();
            }
            let dry = hidden.dry
                * if v.abs() > 2e-3 {
                    v.signum()
                } else {
                    0.6 * held
                };
            let torque = at(t, 1) + plant.rotor * acceleration + dry + hidden.viscous * v;
            let torque = torque + plant.torque_noise * plant.gravity * r.normal();
            slow = 0.9 * slow + 0.44 * plant.noise * r.normal();
            let motor = plant.path(t);
            let mut link = at(t - hidden.delay, 0);
            let (size, order) = hidden.ripple;
            link += size
                * (order.abs()
                    * if order < 0.0 {
                        plant.ratio * motor
                    } else {
                        link
                    }
                    + 0.7)
                    .sin();
            link += hidden.zero
                + if t > hidden.jump.1 * SECONDS {
                    hidden.jump.0
                } else {
                    0.0
                };
            let [drift, _, gear, teeth] = hidden.strange;
            link += drift * (-t / (0.3 * SECONDS)).exp() + gear * (2.6 * motor + 0.4).sin();
            link += teeth * v.abs() * (0.77 * plant.ratio * motor).sin();
            link += slow + 0.3 * plant.noise * r.normal();
            [t, rough(motor), rough(link), torque / plant.ratio, v]
        })
        .collect()
}
