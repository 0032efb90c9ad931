//! The sensor reads something where there is nothing: on one axis, or on all channels.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place, together};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "sensor_offset",
    summary: "The sensor reads a constant where there is no load.",
    mechanism: "offset",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        let axis = |k: usize| {
            Place::new(
                ["sensor-x", "sensor-y", "sensor-z"][k],
                vec![member(case, &[k]), member(case, &[k + 3])],
            )
        };
        let all = Place::new(
            "sensor",
            vec![
                member(case, &[0, 1, 2, 3, 4, 5]),
                member(case, &[0, 1, 2]),
                member(case, &[3, 4, 5]),
            ],
        );
        (0..3).map(axis).chain([all]).collect()
    },
    parameters: |_, blamed| {
        const NAMES: [(&str, &str); 6] = [
            ("offset_fx", "N"),
            ("offset_fy", "N"),
            ("offset_fz", "N"),
            ("offset_mx", "N·m"),
            ("offset_my", "N·m"),
            ("offset_mz", "N·m"),
        ];
        let own = blamed.shape.iter().zip(&blamed.amounts);
        own.map(|(c, amount)| (NAMES[*c as usize].0, *amount, NAMES[*c as usize].1))
            .collect()
    },
    would_tell: "read the sensor without the tool",
};

fn member(case: &Case, channels: &[usize]) -> Member {
    let one = |own: &usize| case.column(|_, c| f64::from(u8::from(c == *own)));
    let shape: Vec<f64> = channels.iter().map(|c| *c as f64).collect();
    together(channels.iter().map(one).collect(), &shape)
}
