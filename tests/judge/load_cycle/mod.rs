//! Load cycles of one axis as laboratories drive them: what an arm, its gear, its bearing and its bolts do under a crane, a
//! cylinder or weights, by laws that engineers use elsewhere than in the textbook of this program.

mod course;
mod curve;
mod habit;
mod hidden;
mod known;
mod memory;
mod noise;
mod programme;
mod rival;
mod scale;
mod sight;
mod table;
mod unfit;

pub use known::stiffness;
pub use table::table;
pub use unfit::{UNFIT, unfit};

use super::Case;
use habit::{Habit, even_raster, on_raster};
use hidden::{Hidden, hide};
use ident::ground::random::Random;
use noise::Noise;
use programme::Programme;

/// A case.
pub fn draw(seed: u64) -> Case {
    let mut random = Random::new(seed ^ 0x10ad_c7c1);
    let p = Programme::draw(&mut random);
    let mut habit = Habit::draw(&mut random);
    let noise = Noise::draw(&p, &mut random);
    let hidden = hide(&p, &mut habit, &noise, &mut random);
    let (readings, loads) = readings(&p, &habit, &noise, &hidden, &mut random);
    let text = text(&p, &habit, &noise, hidden.raster, &readings, &loads);
    let said = format!(
        "{}, {:.0} s, noise {} {:.2} % of the whole, {}{}{}",
        p.name,
        p.last(),
        noise.name,
        100.0 * noise.base,
        habit.response.0,
        if habit.sensors.len() > 1 {
            " twice"
        } else {
            ""
        },
        habit
            .nominal
            .map(|_| format!(", stated to {:.3}", habit.nominal_std))
            .unwrap_or_default(),
    );
    Case {
        seed,
        truths: hidden.truths,
        habit: said,
        files: vec![("axis.csv".into(), text)],
    }
}

/// What every sensor reads and what the load cell does, in parts of the deflection under the largest load.
fn readings(
    p: &Programme,
    habit: &Habit,
    noise: &Noise,
    hidden: &Hidden,
    random: &mut Random,
) -> (Vec<Vec<f64>>, Vec<f64>) {
    let spring = p.read(&p.u);
    let bare: Vec<f64> = (0..spring.len())
        .map(|i| spring[i] / hidden.scale + hidden.added.iter().map(|a| a[i]).sum::<f64>())
        .collect();
    let sensor = |s: usize, random: &mut Random| -> Vec<f64> {
        let error = noise.sample(random);
        bare.iter()
            .zip(error)
            .map(|(b, e)| hidden.gains[s] * b + e)
            .collect()
    };
    let all = (0..habit.sensors.len())
        .map(|s| sensor(s, random))
        .collect();
    let cell = noise.of_cell(random);
    (all, spring.iter().zip(cell).map(|(u, c)| u + c).collect())
}

/// The file.
fn text(
    p: &Programme,
    habit: &Habit,
    noise: &Noise,
    raster: Option<f64>,
    readings: &[Vec<f64>],
    loads: &[f64],
) -> String {
    let coarse = raster.unwrap_or(noise.raster * noise.base);
    let load = even_raster(0.05 * noise.base * habit.full_load());
    let mut all = habit.head(p.rest, noise.base);
    for (i, row) in p.rows.iter().enumerate() {
        let time = if habit.milliseconds {
            format!("{:.2}", 1e3 * p.t[*row])
        } else {
            format!("{:.5}", p.t[*row])
        };
        let mut cells = vec![time, on_raster(loads[i] * habit.full_load(), load)];
        for (s, own) in readings.iter().enumerate() {
            let step = even_raster(coarse * habit.full(s).abs());
            cells.push(on_raster(own[i] * habit.full(s), step));
        }
        let line = cells.join(&habit.delimiter.to_string());
        all += &if habit.comma {
            line.replace('.', ",")
        } else {
            line
        };
        all.push('\n');
    }
    all
}
