//! Causes that are no shape: wrong scales, and the raster of a converter.

use super::super::chance;
use super::habit::Habit;
use super::hidden::{Draft, Hidden};
use super::noise::Noise;
use ident::ground::random::Random;

/// Those that change the scale of a reading only.
pub const SCALES: [&str; 3] = ["lever_arm", "cosine_error", "stiffness"];

/// A cause that is not a shape: scale, or raster.
pub fn scaled(
    name: &'static str,
    habit: &Habit,
    hidden: &mut Hidden,
    noise: &Noise,
    random: &mut Random,
) -> Draft {
    let times = random.uniform(5.0, 14.0);
    let mut draft = Draft {
        effect: name,
        law: String::new(),
        column: None,
        sight: times,
        strength: times,
        twins: Vec::new(),
    };
    let sign = if chance(random, 0.5) { 1.0 } else { -1.0 };
    let two = habit.sensors.len() > 1;
    match name {
        "quantization" => {
            // Rasters are round numbers of the unit: down to two fifths of what is drawn.
            draft.strength = 1.8 * times;
            hidden.raster = Some(draft.strength * noise.base);
            draft.law = "raster of the readings".into();
        }
        "stiffness" => {
            hidden.scale = 1.0 + sign * (times * habit.open()).min(0.45);
            draft.law = format!("{:.3} of the stated", hidden.scale);
            draft.twins = SCALES.to_vec();
        }
        _ => {
            // Two sensors that disagree show it by their levers alone; one by the stated stiffness.
            let open = if two {
                (1.5 * habit.lever_std).max(0.002)
            } else {
                habit.open()
            };
            let e = (times * open).min(0.3);
            let gain = if name == "cosine_error" {
                1.0 - e
            } else {
                1.0 + sign * e
            };
            hidden.gains[0] = gain;
            draft.law = format!("sensor 1 of {} reads {gain:.3}", habit.sensors.len());
            draft.twins = if two {
                vec!["lever_arm", "cosine_error"]
            } else {
                SCALES.to_vec()
            };
            draft.sight = e / open;
        }
    }
    draft
}

/// Whether a cause shows by the stated stiffness alone.
pub fn by_stiffness(name: &str, habit: &Habit) -> bool {
    name == "stiffness" || SCALES.contains(&name) && habit.sensors.len() == 1
}
