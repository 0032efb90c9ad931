//! What the titles of other programs mean: `Kraft [N]`, `Weg in µm`, `Force (N)`, `Zeit / s`.

use crate::ground::units::{Dimension, UNITS, Unit, split_name};

/// A quantity as columns are called here, what it measures, and how others call it (lower case).
type Quantity = (&'static str, Option<Dimension>, &'static [&'static str]);

/// Every quantity; a new word is one entry here.
const QUANTITIES: &[Quantity] = &[
    (
        "time",
        Some(Dimension::Time),
        &[
            "time",
            "zeit",
            "t",
            "x_value",
            "timestamp",
            "zeitstempel",
            "elapsed time",
            "messzeit",
            "relative time",
        ],
    ),
    (
        "force",
        Some(Dimension::Force),
        &[
            "force",
            "kraft",
            "f",
            "last",
            "load",
            "prüfkraft",
            "load cell",
            "kraftmessdose",
            "hammer",
            "hammerkraft",
        ],
    ),
    (
        "displacement",
        Some(Dimension::Length),
        &[
            "displacement",
            "weg",
            "s",
            "verschiebung",
            "auslenkung",
            "laser",
            "deflection",
            "taster",
            "messtaster",
            "wegaufnehmer",
            "laser 1",
            "weg 1",
            "sensor",
            "sensor 1",
        ],
    ),
    (
        "displacement2",
        Some(Dimension::Length),
        &[
            "displacement2",
            "displacement 2",
            "weg 2",
            "laser 2",
            "taster 2",
            "sensor 2",
            "verschiebung 2",
        ],
    ),
    (
        "moment",
        Some(Dimension::Moment),
        &["moment", "drehmoment", "torque", "m"],
    ),
    (
        "angle",
        Some(Dimension::Angle),
        &["angle", "winkel", "verdrehung", "twist"],
    ),
    (
        "ax",
        Some(Dimension::Acceleration),
        &[
            "ax",
            "a_x",
            "acceleration x",
            "beschleunigung x",
            "acc x",
            "x acceleration",
        ],
    ),
    (
        "ay",
        Some(Dimension::Acceleration),
        &[
            "ay",
            "a_y",
            "acceleration y",
            "beschleunigung y",
            "acc y",
            "y acceleration",
        ],
    ),
    (
        "az",
        Some(Dimension::Acceleration),
        &[
            "az",
            "a_z",
            "acceleration z",
            "beschleunigung z",
            "acc z",
            "z acceleration",
        ],
    ),
    (
        "fx",
        Some(Dimension::Force),
        &["fx", "f_x", "force x", "kraft x"],
    ),
    (
        "fy",
        Some(Dimension::Force),
        &["fy", "f_y", "force y", "kraft y"],
    ),
    (
        "fz",
        Some(Dimension::Force),
        &["fz", "f_z", "force z", "kraft z"],
    ),
    (
        "mx",
        Some(Dimension::Moment),
        &["mx", "m_x", "moment x", "torque x"],
    ),
    (
        "my",
        Some(Dimension::Moment),
        &["my", "m_y", "moment y", "torque y"],
    ),
    (
        "mz",
        Some(Dimension::Moment),
        &["mz", "m_z", "moment z", "torque z"],
    ),
    (
        "dx",
        Some(Dimension::Length),
        &["dx", "weg x", "displacement x", "verschiebung x"],
    ),
    (
        "dy",
        Some(Dimension::Length),
        &["dy", "weg y", "displacement y", "verschiebung y"],
    ),
    (
        "dz",
        Some(Dimension::Length),
        &["dz", "weg z", "displacement z", "verschiebung z"],
    ),
    (
        "target",
        Some(Dimension::Length),
        &["target", "soll", "sollposition", "target position"],
    ),
    (
        "actual",
        Some(Dimension::Length),
        &["actual", "ist", "istposition", "actual position"],
    ),
    ("point", None, &["point", "punkt", "messpunkt"]),
    ("direction", None, &["direction", "richtung"]),
    ("cycle", None, &["cycle", "zyklus"]),
    ("hit", None, &["hit", "schlag"]),
    ("run", None, &["run", "lauf"]),
];

/// Spellings of units beside those of [`UNITS`].
const SPELLINGS: &[(&str, &str)] = &[
    ("µm", "um"),
    ("μm", "um"),
    ("µs", "us"),
    ("μs", "us"),
    ("sec", "s"),
    ("sek", "s"),
    ("seconds", "s"),
    ("newton", "N"),
    ("n", "N"),
    ("kn", "kN"),
    ("n·m", "Nm"),
    ("n*m", "Nm"),
    ("n m", "Nm"),
    ("nm", "Nm"),
    ("µrad", "urad"),
    ("μrad", "urad"),
    ("°", "deg"),
    ("grad", "deg"),
    ("°/s", "deg_s"),
    ("m/s²", "m_s2"),
    ("m/s^2", "m_s2"),
    ("m/s2", "m_s2"),
    ("m/s", "m_s"),
    ("mm/s", "mm_s"),
    ("°c", "degC"),
];

/// The unit of a spelling.
pub fn unit(text: &str) -> Option<Unit> {
    let text = text.trim().trim_matches(['[', ']', '(', ')']).trim();
    let by = |name: &str| UNITS.iter().find(|u| u.name == name).copied();
    let other = || {
        let lower = text.to_lowercase();
        SPELLINGS
            .iter()
            .find(|s| s.0 == text || s.0 == lower)
            .and_then(|s| by(s.1))
    };
    by(text).or_else(other)
}

/// The name that a title has here, as `force_N`; a unit from the row below where the title has none.
/// `None`: no quantity, no unit, or one that does not measure it.
pub fn name_of(title: &str, below: Option<&str>) -> Option<String> {
    let title = title.trim().trim_matches('"').trim();
    if split_name(title).is_some() && !is_foreign(title) {
        return Some(title.to_string());
    }
    let (words, inside) = parts(title);
    let own = inside.and_then(unit).or_else(|| below.and_then(unit));
    let words = words.to_lowercase();
    let (stem, dimension, _) = QUANTITIES.iter().find(|q| q.2.contains(&words.as_str()))?;
    match (dimension, own) {
        (None, None) => Some((*stem).to_string()),
        (Some(wanted), Some(unit)) if unit.dimension == *wanted => {
            Some(format!("{stem}_{}", unit.name))
        }
        // The text files of LabVIEW name their axis so, in seconds, and write no unit.
        (Some(_), None) if words == "x_value" => Some("time_s".into()),
        _ => None,
    }
}

/// Whether a title in the form of a name here has the word of another language or program: `Kraft_N`.
fn is_foreign(title: &str) -> bool {
    let (words, _) = parts(title);
    let words = words.to_lowercase();
    let means = |q: &&Quantity| q.0 != words && q.2.contains(&words.as_str());
    words.chars().count() > 1 && QUANTITIES.iter().any(|q| means(&q))
}

/// Words and unit of a title.
fn parts(title: &str) -> (&str, Option<&str>) {
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((head, tail)) = title.split_once(open) {
            return (head.trim(), tail.split(close).next());
        }
    }
    for mark in [" in ", " / ", ", ", "/"] {
        if let Some((head, tail)) = title.split_once(mark)
            && unit(tail).is_some()
        {
            return (head.trim(), Some(tail));
        }
    }
    match title.rsplit_once(['_', ' ']) {
        Some((head, tail)) if unit(tail).is_some() && !head.is_empty() => (head.trim(), Some(tail)),
        _ => (title, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_of_laboratories_are_understood() {
        let known = [
            ("Kraft [N]", None, "force_N"),
            ("Weg in µm", None, "displacement_um"),
            ("Force (kN)", None, "force_kN"),
            ("Zeit / s", None, "time_s"),
            ("Force_N", None, "Force_N"),
            ("Kraft_N", None, "force_N"),
            ("Zeit_s", None, "time_s"),
            ("s_mm", None, "s_mm"),
            ("Weg 2", Some("[mm]"), "displacement2_mm"),
            ("Beschleunigung X [m/s²]", None, "ax_m_s2"),
            ("Richtung", None, "direction"),
        ];
        for (title, below, wanted) in known {
            assert_eq!(name_of(title, below).as_deref(), Some(wanted), "{title}");
        }
        for title in ["Kraft", "Kraft [mm]", "Kommentar", "Weg [N]", ""] {
            assert_eq!(name_of(title, None), None, "{title}");
        }
    }
}
