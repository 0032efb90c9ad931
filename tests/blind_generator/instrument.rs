//! Joint, levers and lasers: what the file states and what is really there.

use super::random::Random;
use std::fmt::Write;

/// Stated value and what is really there.
#[derive(Clone, Copy)]
pub struct Stated {
    pub stated: f64,
    pub real: f64,
}

impl Stated {
    fn ratio(self) -> f64 {
        self.real / self.stated
    }
}

/// The measuring set-up.
pub struct Instrument {
    pub joint: usize,
    pub tilt: bool,
    pub force: f64,
    pub stiffness: Stated,
    pub stiffness_rel_std: f64,
    pub lever_rel_std: f64,
    pub load_lever: Stated,
    /// One per laser; none when the file gives moment and angle.
    pub lasers: Vec<Stated>,
}

/// What a case asks of its instrument.
pub struct Wishes {
    pub fewest_lasers: usize,
    pub two_lasers: f64,
    /// Largest stated uncertainties, so that a weak scale effect still stands out.
    pub lever_rel_std: f64,
    pub stiffness_rel_std: f64,
}

impl Instrument {
    pub fn draw(wishes: &Wishes, random: &mut Random) -> Self {
        let lever_rel_std = random.uniform(0.002, wishes.lever_rel_std);
        let stiffness_rel_std = random.uniform(0.01, wishes.stiffness_rel_std);
        let lever = |stated: f64, random: &mut Random| Stated {
            stated,
            real: stated * (1.0 + lever_rel_std * 0.5 * random.normal_within(2.0)),
        };
        let load_lever = lever(milli(random.uniform(0.5, 1.6)), random);
        let first = random.uniform(0.3, 1.2);
        let second = if first > 0.75 {
            first * random.uniform(0.45, 0.85)
        } else {
            first * random.uniform(1.2, 1.6)
        };
        let count = match random.unit() {
            x if x < wishes.two_lasers => 2,
            x if x < wishes.two_lasers + 0.6 * (1.0 - wishes.two_lasers) => 1,
            _ => wishes.fewest_lasers,
        };
        let lasers = [first, second].into_iter().take(count);
        let lasers = lasers.map(|x| lever(milli(x), random)).collect();
        let spread = 0.5 * stiffness_rel_std * random.normal_within(3.0);
        Self {
            joint: random.integer(1, 6),
            tilt: random.chance(0.3),
            force: random.uniform(600.0, 1500.0),
            stiffness: Stated {
                stated: 1.0,
                real: 1.0 + spread,
            },
            stiffness_rel_std,
            lever_rel_std,
            load_lever,
            lasers,
        }
    }

    /// Largest moment as the file states it, N·m.
    pub fn stated_moment(&self) -> f64 {
        self.force * self.load_lever.stated
    }

    /// Gives the joint a stiffness (stated, N·m/rad) for which a laser's noise stays believable when
    /// the largest deflection is `range` times the noise. `factor` replaces the harmless deviation.
    pub fn choose_stiffness(&mut self, range: f64, factor: Option<f64>, random: &mut Random) {
        const LEAST_NOISE: f64 = 2e-8; // m
        let lever = self.lasers.first().map_or(1.0, |l| l.stated);
        let most = self.stated_moment() * lever / (range * LEAST_NOISE);
        let stated = three_digits(random.log_uniform(3e5, most.clamp(4e5, 2.6e7)));
        let ratio = factor.unwrap_or(self.stiffness.real);
        self.stiffness = Stated {
            stated,
            real: stated * ratio,
        };
    }

    /// Laser 1's lever is really this multiple of the stated one.
    pub fn misplace_laser(&mut self, gain: f64) {
        if let Some(laser) = self.lasers.first_mut() {
            laser.real = laser.stated * gain;
        }
    }

    /// Angle of the plain spring at full load, rad. With moment and angle in the file the moment is
    /// measured, so no load lever can be wrong.
    pub fn peak_angle(&self) -> f64 {
        let ratio = match self.lasers.is_empty() {
            true => 1.0,
            false => self.load_lever.ratio(),
        };
        self.stated_moment() * ratio / self.stiffness.real
    }

    /// Reading of laser `index` as an angle over the true angle.
    pub fn gain(&self, index: usize) -> f64 {
        self.lasers.get(index).map_or(1.0, |l| l.ratio())
    }

    /// The lines of front matter; `noise` is the data sheet's figure in metres.
    pub fn front_matter(&self, rest: Option<f64>, noise: f64) -> String {
        let mut text = String::from("# kind = \"load-cycle\"\n# robot = \"kr210\"\n");
        let axis = if self.tilt { "tilt" } else { "rotation" };
        let mut add = |name: &str, value: String| {
            let _ = writeln!(text, "# {name} = {value}");
        };
        add("joint", self.joint.to_string());
        add("axis", format!("\"{axis}\""));
        if !self.lasers.is_empty() {
            add("load_lever_m", format!("{:?}", self.load_lever.stated));
            for (laser, name) in self
                .lasers
                .iter()
                .zip(["sensor_lever_m", "sensor2_lever_m"])
            {
                add(name, format!("{:?}", laser.stated));
            }
            add("lever_rel_std", format!("{:.5}", self.lever_rel_std));
            add("sensor_noise_mm", format!("{:.3e}", noise * 1e3));
        }
        if let Some(seconds) = rest {
            add("rest_s", format!("{seconds:.4}"));
        }
        add(
            "nominal_stiffness_Nm_rad",
            format!("{:?}", self.stiffness.stated),
        );
        add(
            "nominal_stiffness_rel_std",
            format!("{:.5}", self.stiffness_rel_std),
        );
        text
    }
}

fn milli(x: f64) -> f64 {
    (x * 1e3).round() / 1e3
}

fn three_digits(x: f64) -> f64 {
    let unit = 10f64.powf(x.log10().floor() - 2.0).round();
    (x / unit).round() * unit
}
