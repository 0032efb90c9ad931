//! Files from which nobody can have a stiffness.

use super::habit::Habit;
use super::hidden::Hidden;
use super::noise::Noise;
use super::programme::Programme;
use super::{readings, text};
use ident::ground::random::Random;

/// What went wrong in the laboratory.
pub const UNFIT: [&str; 9] = [
    "never loaded",
    "dead sensor",
    "another day",
    "frozen sensor",
    "clipped",
    "reversed",
    "wrong unit",
    "copied channel",
    "five rows",
];

/// A file, with its true stiffness and the stated one.
pub fn unfit(seed: u64) -> (&'static str, String, f64) {
    let mut random = Random::new(seed ^ 0x10ad_bad0);
    let name = UNFIT[(seed % UNFIT.len() as u64) as usize];
    let mut p = Programme::draw(&mut random);
    while p.standing {
        p = Programme::draw(&mut random);
    }
    let mut habit = Habit::draw(&mut random);
    habit.nominal = (name == "wrong unit").then_some(habit.stiffness);
    let noise = Noise::draw(&p, &mut random);
    let hidden = Hidden {
        added: Vec::new(),
        gains: [1.0; 2],
        raster: None,
        scale: 1.0,
        truths: Vec::new(),
    };
    let (mut own, mut loads) = readings(&p, &habit, &noise, &hidden, &mut random);
    for sensor in &mut own {
        spoil(name, &p, &noise, sensor, &mut random);
    }
    if name == "never loaded" {
        own.iter_mut().for_each(|s| *s = noise.sample(&mut random));
        loads = loads.iter().map(|_| noise.base * random.normal()).collect();
    }
    if name == "five rows" {
        let count = p.rows.len();
        p.rows = (0..5).map(|i| p.rows[i * (count - 1) / 4]).collect();
    }
    let mut file = text(&p, &habit, &noise, None, &own, &loads);
    if name == "copied channel" {
        file = copied(&file, habit.delimiter);
    }
    (name, file, habit.stiffness)
}

fn spoil(name: &str, p: &Programme, noise: &Noise, sensor: &mut [f64], random: &mut Random) {
    let error = noise.sample(random);
    let size = sensor.len();
    match name {
        "dead sensor" => sensor.copy_from_slice(&error),
        "another day" => {
            let other = Programme::draw(random);
            let last = other.u.len() - 1;
            (0..size).for_each(|i| sensor[i] = other.u[i * last / (size - 1)] + error[i]);
        }
        "frozen sensor" => {
            let at = (0..size).find(|i| p.u[p.rows[*i]].abs() > 0.3).unwrap_or(0);
            let stuck = sensor[at];
            sensor[at..].iter_mut().for_each(|s| *s = stuck);
        }
        "clipped" => sensor.iter_mut().for_each(|s| *s = s.clamp(-0.35, 0.35)),
        "reversed" => sensor.iter_mut().for_each(|s| *s = -*s),
        "wrong unit" => sensor.iter_mut().for_each(|s| *s *= 1e3),
        _ => {}
    }
}

/// The column of the load exported again under the title of the deflection.
fn copied(file: &str, delimiter: char) -> String {
    let numbers = |line: &str| line.starts_with(|c: char| c.is_ascii_digit());
    let twice = |line: &str| {
        let cells: Vec<&str> = line.split(delimiter).collect();
        let again = vec![cells[1]; cells.len() - 1];
        [&cells[..1], &again[..]]
            .concat()
            .join(&delimiter.to_string())
    };
    let lines = file
        .lines()
        .map(|l| if numbers(l) { twice(l) } else { l.to_string() });
    lines.collect::<Vec<_>>().join("\n") + "\n"
}
