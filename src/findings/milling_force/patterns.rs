//! Forces that no cause of the library makes. They compete with the causes and are never named.

use super::Case;
use super::channels::{bends, leaks};
use super::lines::Line;
use super::setting::Places;
use crate::findings::engine::Member;
use crate::findings::table::{self, Pattern};
use crate::signal::mains::{HARMONICS, MAINS_HZ};
use std::f64::consts::TAU;

/// All of them.
pub(super) const PATTERNS: &[Pattern<Case>] = &[
    Pattern {
        name: "uneven",
        summary: "the whole force waxes and wanes within the cuts",
        members: uneven,
    },
    Pattern {
        name: "hum",
        summary: "a channel hums with the mains",
        members: hums,
    },
    Pattern {
        name: "bend",
        summary: "a channel is not in proportion to its force",
        members: bends,
    },
    Pattern {
        name: "sway",
        summary: "the spindle runs unevenly: the angle of the teeth swings within the cuts",
        members: sways,
    },
    Pattern {
        name: "swing",
        summary: "the spindle runs unevenly: the angle of the teeth swings at a frequency of its own",
        members: swings,
    },
    Pattern {
        name: "rattle",
        summary: "an oscillation comes and goes: something knocks and rings",
        members: rattles,
    },
    Pattern {
        name: "leak",
        summary: "the charge of the sensor leaks away: channels forget a force that lasts",
        members: leaks,
    },
    Pattern {
        name: "law",
        summary: "the force is not in proportion to the thickness of the chip",
        members: laws,
    },
];

/// Pieces of the record whose force may be more or less than simulated.
const PIECES: usize = 24;
/// Nats from which a hum, a swing or a leak is worth a comparison.
pub(super) const SEEN: f64 = 12.0;
/// Highest lines beside which a swing is sought, and swings that are compared: beside a large cause the best is not always the first.
/// Choices: every swing costs the columns of all cuts.
const LINES: usize = 4;
const MEMBERS: usize = 3;

/// Within the cuts: what differs from cut to cut is what causes do.
fn uneven(case: &Case) -> Vec<Member> {
    pieces(case, &case.forces())
}

/// What a milliradian of the spindle changes.
fn turned(case: &Case) -> Vec<f64> {
    let places = case.places();
    case.along(&places.of_every_cut(Places::phase, |_| 1e-3))
}

/// The angle of the teeth, in the same pieces.
fn sways(case: &Case) -> Vec<Member> {
    pieces(case, &turned(case))
}

/// The angle of the teeth at frequencies that make a line of the spectrum beside a harmonic of the spindle or of its teeth, in every cut
/// with a phase of its own.
fn swings(case: &Case) -> Vec<Member> {
    let turned = turned(case);
    let swung = |hz: f64| {
        waves(case, hz, |c, i, k| {
            turned[3 * (case.cuts()[c].first + i) + k]
        })
    };
    let mut lines: Vec<&Line> = case.lines().iter().collect();
    lines.sort_by(|a, b| b.height.total_cmp(&a.height));
    let beside = lines.iter().take(LINES).flat_map(|l| apart(case, l));
    best(case, MEMBERS, beside.map(swung))
}

/// Distances of a line from harmonics of the spindle and of its teeth, Hz.
fn apart(case: &Case, line: &Line) -> impl Iterator<Item = f64> {
    let spindle = case.cuts()[line.cut].present.scene.cut.spindle_rad_s / TAU;
    let hz = line.frequency_hz;
    [1, case.places().teeth].into_iter().flat_map(move |teeth| {
        let harmonic = spindle * teeth as f64;
        let nearest = (hz / harmonic).round();
        [-1.0, 0.0, 1.0].map(|beside| (hz - (nearest + beside) * harmonic).abs())
    })
}

/// The columns that suit the readings best, where they are worth a comparison.
fn best(case: &Case, most: usize, tried: impl Iterator<Item = Vec<Vec<f64>>>) -> Vec<Member> {
    let gains = tried.map(|w| (case.aim().fitted(&w).1, w));
    let mut worth: Vec<(f64, Vec<Vec<f64>>)> = gains.filter(|(gain, _)| *gain > SEEN).collect();
    worth.sort_by(|a, b| b.0.total_cmp(&a.0));
    worth.dedup_by(|a, b| a.0 == b.0);
    let first = worth.into_iter().take(most);
    first.flat_map(|(_, w)| table::flexible(w)).collect()
}

/// A column at a frequency, in every cut with a phase of its own.
fn waves(case: &Case, hz: f64, of: impl Fn(usize, usize, usize) -> f64) -> Vec<Vec<f64>> {
    let phases = (0..case.cuts().len()).flat_map(|cut| [0.0, 0.25].map(|q| (cut, q)));
    let one = |(cut, quarter): (usize, f64)| {
        case.column(|c, i, k| match c == cut {
            true => of(c, i, k) * (TAU * (hz * case.cuts()[c].time[i] - quarter)).cos(),
            false => 0.0,
        })
    };
    phases.map(one).collect()
}

/// Periods of an oscillation in a piece of it, and pieces at most: choices, the first for what rings a few times (no other was tried),
/// the second for time. With 12, 16 and 40 pieces on three axes the knocks of one file by strangers are no chatter; with 12 on two they
/// were.
const RINGS: f64 = 8.0;
const SPELLS: usize = 12;

/// The highest line, if it is no sharp one, with a phase and a size of its own in every piece of its cut: what knocks again and again
/// makes no steady oscillation.
fn rattles(case: &Case) -> Vec<Member> {
    let lines = case.lines().iter();
    let highest = lines.max_by(|a, b| a.height.total_cmp(&b.height));
    let Some(highest) = highest.filter(|line| !line.is_sharp) else {
        return Vec::new();
    };
    let hz = highest.frequency_hz;
    let time = &case.cuts()[highest.cut].time;
    let begin = time.first().copied().unwrap_or(0.0);
    let length = time.last().map_or(0.0, |end| end - begin);
    let spells = ((length * hz / RINGS) as usize).clamp(2, SPELLS);
    let spell = |t: f64| ((t - begin) / length * spells as f64) as usize;
    let column = |(number, axis, quarter): (usize, usize, f64)| {
        case.column(|c, i, k| {
            let t = case.cuts()[c].time[i];
            match c == highest.cut && k == axis && spell(t).min(spells - 1) == number {
                true => (TAU * (hz * t - quarter)).cos(),
                false => 0.0,
            }
        })
    };
    let each = (0..spells).flat_map(|s| (0..3).flat_map(move |k| [0.0, 0.25].map(|q| (s, k, q))));
    table::flexible(each.map(column).collect())
}

/// A column in every piece of the file.
fn pieces(case: &Case, column: &[f64]) -> Vec<Member> {
    let own = (0..PIECES).map(|piece| within(case, piece, column));
    table::flexible(own.collect())
}

/// A column in a piece of the file, less its share of every cut.
fn within(case: &Case, piece: usize, column: &[f64]) -> Vec<f64> {
    let near = |c: usize, i: usize| {
        let apart = case.progress(c, i) * (PIECES - 1) as f64 - piece as f64;
        (1.0 - apart.abs()).max(0.0)
    };
    let means = case.cuts().iter().enumerate().map(|(c, cut)| {
        let count = cut.time.len();
        (0..count).map(|i| near(c, i)).sum::<f64>() / count.max(1) as f64
    });
    let means: Vec<f64> = means.collect();
    case.column(|c, i, k| (near(c, i) - means[c]) * column[3 * (case.cuts()[c].first + i) + k])
}

/// Thickness of a chip in which its logarithm is counted, m: what a power makes of it is a coefficient as well.
const CHIP: f64 = 5e-5;
/// Powers of the logarithm: a force by a power of the chip (Kienzle 1952) is their sum.
const POWERS: [i32; 2] = [1, 2];

/// Tangential, radial and axial force over the chip's thickness times its logarithm.
fn laws(case: &Case) -> Vec<Member> {
    let columns = POWERS.iter().flat_map(|power| {
        let bent = move |h: f64| h * (h.max(1e-9) / CHIP).ln().powi(*power);
        (0..3).map(move |own| case.of_chips(own, bent))
    });
    table::flexible(columns.collect())
}

/// One channel at the frequency that suits it best, in every cut with a phase of its own.
fn hums(case: &Case) -> Vec<Member> {
    let tried = |axis: usize| {
        let harmonics = HARMONICS.iter().flat_map(|n| MAINS_HZ.map(|hz| n * hz));
        harmonics.map(move |hz| waves(case, hz, |_, _, k| f64::from(u8::from(k == axis))))
    };
    (0..3).flat_map(|axis| best(case, 1, tried(axis))).collect()
}

#[cfg(test)]
mod tests {
    use super::PATTERNS;

    #[test]
    fn every_pattern_stands_once() {
        let mut names: Vec<&str> = PATTERNS.iter().map(|pattern| pattern.name).collect();
        names.sort_unstable();
        assert!(names.windows(2).all(|w| w[0] != w[1]), "{names:?}");
    }
}
