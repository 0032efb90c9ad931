//! Hammer tests as laboratories do them: an arm on springs and oil that is struck at the tool, by a dynamics of this
//! judge's own, and what differs from the robot file or from sound instruments.

mod bench;
mod build;
mod check;
mod drawn;
mod dynamics;
mod habit;
mod hidden;
mod line;
mod records;
mod rival;
mod robot;
mod sight;

pub use check::checked;

use super::chosen::{USUAL, chosen};
use super::{Case, Truth};
use bench::Bench;
use dynamics::World;
use hidden::{EFFECTS, Hidden, OUTSIDE};
use ident::ground::random::Random;
use records::{Record, records};

impl Bench {
    fn text(&self, all: &[Record], random: &mut Random, decay: f64) -> String {
        let angles: Vec<String> = self
            .world
            .joints
            .iter()
            .map(|q| format!("{:.1}", q.to_degrees()))
            .collect();
        let mut text = format!(
            "# kind = \"hammer\"\n# synthetic = true\n# robot = \"robot.toml\"\n# joint_angles_deg = [{}]\n",
            angles.join(", ")
        );
        text += &records::facts(&self.habit, &self.spread, self.tells, self.habit.window);
        text += &records::rows(all, &self.habit, decay, random);
        text
    }

    fn case(
        &self,
        seed: u64,
        all: &[Record],
        truths: Vec<Truth>,
        decay: f64,
        random: &mut Random,
    ) -> Case {
        let told = self.within.then_some(self.spread.stiffness);
        let text = self.text(all, random, decay);
        Case {
            seed,
            truths,
            habit: self.described(),
            files: vec![
                ("hits.csv".to_string(), text),
                ("robot.toml".to_string(), self.told.document(told)),
            ],
        }
    }

    fn described(&self) -> String {
        let h = &self.habit;
        let slow = if h.noise.slow > 0.0 { " slow" } else { "" };
        let hum = if h.noise.hum > 0.0 { " hum" } else { "" };
        format!(
            "{}, {} hinges, {:.0} Hz {:.1} s, {} hits {}, {} responses, window {:?}, noise {:.1e}{slow}{hum}, first decay {:.1}, k {:.2} d {:.2} told {:?}",
            self.told.build,
            self.told.hinges.len(),
            1.0 / h.interval,
            h.samples as f64 * h.interval,
            h.hits.len(),
            h.shape,
            h.responses.len(),
            h.window,
            h.noise.white,
            self.world.plant().slowest(),
            self.spread.stiffness,
            self.spread.damping,
            self.tells
        )
    }
}

/// A clean file of the very robot of its file, with perfect instruments but for noise.
pub fn exact(seed: u64) -> Case {
    let mut random = Random::new(seed ^ 0x4a3e_0000);
    let mut bench = Bench::draw(&mut random);
    let decay = bench.world.decay;
    bench.world = World::new(bench.told.clone(), bench.world.joints);
    bench.world.decay = decay;
    let all = records(&bench.world, &bench.habit);
    bench.case(seed, &all, Vec::new(), decay, &mut random)
}

/// A case.
pub fn draw(seed: u64) -> Case {
    let mut random = Random::new(seed ^ 0x4a3e_0000);
    let bench = Bench::draw(&mut random);
    let missing = (1..=6).any(|j| bench.told.group("tilt", &format!("A{j}")).is_empty());
    let tilts = !bench.told.group("tilt", "").is_empty();
    let names = chosen(
        &mut random,
        USUAL,
        [&EFFECTS, &OUTSIDE],
        |name| match name {
            "missing_tilt" => missing,
            "tilt_stiffness" => tilts,
            _ => true,
        },
    );
    let plain = records(&bench.world, &bench.habit);
    let hidden: Vec<(Hidden, f64)> = names
        .iter()
        .map(|n| bench.sized(n, &plain, &mut random))
        .collect();
    let truths = bench.truths(&hidden, &plain);
    let world = bench.with(&hidden, None);
    let all = match hidden.is_empty() {
        true => plain,
        false => records(&world, &bench.habit),
    };
    bench.case(seed, &all, truths, world.decay, &mut random)
}
