//! The verdict in sentences that an engineer can act on.

use super::answer::{Answer, Cause, Group, Verdict};
use super::gain::Gain;
use crate::sheet::number::{engineering, significant};

/// What the answer says, in one paragraph.
pub fn sentence(answer: &Answer) -> String {
    sentences(answer).join(" ")
}

/// The same, one entry for the error, for each cause, for each open question and for what remains.
///
/// Where the data cannot carry an answer, what makes them so stands alone.
pub fn sentences(answer: &Answer) -> Vec<String> {
    if answer.is_withheld() {
        let head = "These data cannot carry a diagnosis.".to_string();
        return [head].into_iter().chain(doubts(answer)).collect();
    }
    let mut said = vec![opening(answer)];
    let count = answer.causes.len();
    let numbered = |i: usize| match count {
        1 => "Cause".to_string(),
        _ => format!("Cause {}", i + 1),
    };
    let causes = answer.causes.iter().enumerate();
    said.extend(causes.map(|(i, c)| of_cause(c, &numbered(i), answer.unit)));
    said.extend(answer.groups.iter().map(|g| of_group(g, answer.unit)));
    said.extend(closing(answer));
    said.extend(doubts(answer));
    said
}

/// What is odd about the data, one sentence each.
pub fn doubts(answer: &Answer) -> Vec<String> {
    let said = answer.doubts.iter().map(|doubt| doubt.sentence());
    said.map(|said| format!("Odd: {said}.")).collect()
}

/// A probability as it is spoken: never a certainty.
pub fn probability(p: f64) -> String {
    match p {
        p if p > 0.99 => "> 99 %".into(),
        p if p < 0.01 => "< 1 %".into(),
        p => format!("{:.0} %", 100.0 * p),
    }
}

/// Candidates that cannot be told apart: `lever arm or cosine error at A3`, `joint damping at A3 or A5`.
pub fn candidates(group: &Group) -> String {
    let same = |all: &[&str]| all.windows(2).all(|pair| pair[0] == pair[1]);
    let sites: Vec<&str> = group.sites.iter().map(String::as_str).collect();
    let effects: Vec<String> = group.effects.iter().map(|e| spoken(e)).collect();
    let places: Vec<String> = sites.iter().map(|s| place(s)).collect();
    match (same(&group.effects), same(&sites), places.first()) {
        (true, false, _) => format!("{} at {}", effects[0], either(&places)),
        (_, true, Some(site)) => format!("{} at {site}", either(&effects)),
        _ => {
            let pairs = effects.iter().zip(&places);
            either(
                &pairs
                    .map(|(e, s)| format!("{e} at {s}"))
                    .collect::<Vec<_>>(),
            )
        }
    }
}

/// `a`, `a or b`, `a, b or c`.
fn either(all: &[String]) -> String {
    match all {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}

/// How much is left, and what the noise is like.
pub fn left(answer: &Answer) -> String {
    let percent = 100.0 * answer.unexplained.share_of_variance;
    let share = match percent {
        p if p < 0.1 => "Less than 0.1".into(),
        p => significant(p, 2),
    };
    format!(
        "{share} % of the error's variance is left above the noise. The noise is {}.",
        answer.noise
    )
}

/// An error this many times the noise is more than noise.
const NOISY: f64 = 1.5;

fn opening(answer: &Answer) -> String {
    let found = &answer.discrepancy;
    let simulation = match answer.unstated {
        true => "No stiffness is stated; a straight spring fitted to these readings",
        false => "The simulation",
    };
    let size = engineering(found.rms, 3, answer.unit);
    let noise = engineering(found.noise_rms, 2, answer.unit);
    if answer.verdict == Verdict::Sufficient {
        let within = match found.rms < NOISY * found.noise_rms {
            true => "the noise",
            false => "the noise and what is not known better (springs, set-up, instruments)",
        };
        return format!(
            "{simulation} is right to within {within}: it misses the readings by {size} rms, and the readings scatter by {noise}."
        );
    }
    let times = match found.rms / found.noise_rms {
        ratio if ratio > 1e4 => "far above the noise".into(),
        ratio if ratio.is_finite() && ratio >= NOISY => {
            format!(
                "{} times the noise of {noise}",
                significant(ratio, if ratio < 10.0 { 2 } else { 1 })
            )
        }
        _ => format!("with a noise of {noise}"),
    };
    format!(
        "{simulation} misses the readings by {size} rms, {times}; the error is {}.",
        found.place
    )
}

fn of_cause(cause: &Cause, numbered: &str, unit: &str) -> String {
    format!(
        "{numbered}: {} at {}{} ({} probable). {} In the model, it {}.",
        spoken(cause.effect),
        place(&cause.site),
        size_of(cause).unwrap_or_default(),
        probability(cause.probability),
        cause.summary,
        of_gain(&cause.gain, unit)
    )
}

/// Share of the largest amount of a unit below which an amount is zero but for rounding.
const ROUNDING: f64 = 1e-9;

/// How large it is: its first amount that is not zero, for zero says nothing where another amount acts; of one along or about all axes the
/// largest.
fn size_of(cause: &Cause) -> Option<String> {
    let first = cause.parameters.first()?;
    if let ((name, 0.0, unit), Some(limit)) = (first, cause.limit()) {
        let (name, limit) = (spoken(name), amount(limit, unit));
        return Some(format!(", {name} smaller than {limit}"));
    }
    let most = |unit: &str| {
        let same = cause.parameters.iter().filter(|p| p.2 == unit);
        same.fold(0.0_f64, |most, p| most.max(p.1.abs()))
    };
    let mut amounts = cause.parameters.iter();
    let acting = amounts.find(|p| p.1 != 0.0 && p.1.abs() > ROUNDING * most(p.2));
    let (name, value, unit) = acting.map_or(first, |acting| largest(cause, acting));
    let within = cause.interval(name).map(|[low, high]| {
        let ends = [low, high].map(|end| amount(end, unit));
        format!(" (95 % interval {} to {})", ends[0], ends[1])
    });
    let (name, value) = (spoken(name), amount(*value, unit));
    Some(format!(", {name} {value}{}", within.unwrap_or_default()))
}

/// Amount with its name and unit.
type Amount = (&'static str, f64, &'static str);

/// Names of amounts that are deviations, but for their axis: of a stiffness the largest is where least gives way.
const DEVIATIONS: [&str; 3] = ["about_", "rotation_", "base_tilt_"];

/// The largest of the amounts whose names differ by their axis alone.
fn largest<'a>(cause: &'a Cause, acting: &'a Amount) -> &'a Amount {
    let stem = |name: &'static str| {
        let stem = name.strip_suffix(['x', 'y', 'z']);
        stem.filter(|stem| DEVIATIONS.contains(stem))
    };
    let Some(own) = stem(acting.0) else {
        return acting;
    };
    let kin = cause.parameters.iter().filter(|p| stem(p.0) == Some(own));
    kin.fold(
        acting,
        |most, p| if p.1.abs() > most.1.abs() { p } else { most },
    )
}

fn of_group(group: &Group, unit: &str) -> String {
    // one alone: its rival is nothing that is wrong, but what nobody stated
    let (asked, any) = match group.effects.len() {
        1 => ("whether it is", "it"),
        _ => ("which it is:", "any of them"),
    };
    format!(
        "These data cannot tell {asked} {}; {any} {}. What would tell: {}.",
        candidates(group),
        of_gain(&group.gain, unit),
        group.would_tell
    )
}

fn of_gain(gain: &Gain, unit: &str) -> String {
    let does = match gain.is_real() {
        true => "cuts",
        false => "does not plainly cut",
    };
    format!(
        "{does} the error on data held out of the fit from {} to {} ({:.0} % less, 95 % interval {:.0} to {:.0} %)",
        engineering(gain.before, 3, unit),
        engineering(gain.after, 3, unit),
        gain.reduction_percent,
        gain.ci95_percent[0],
        gain.ci95_percent[1]
    )
}

fn closing(answer: &Answer) -> Option<String> {
    let seen = answer.unexplained.description.trim_end_matches('.');
    match answer.verdict {
        Verdict::UnknownCause => Some(format!(
            "No effect in the library explains it; what is seen is {seen}."
        )),
        Verdict::PartlyExplained => {
            Some(format!("More is wrong than that; what remains is {seen}."))
        }
        Verdict::Explained => Some("Nothing is left above the noise.".into()),
        Verdict::Sufficient | Verdict::CannotTell => None,
    }
}

fn amount(value: f64, unit: &str) -> String {
    engineering(value, 3, if unit == "1" { "" } else { unit })
}

/// A site as words: the axes have names, the rest are things.
pub fn place(site: &str) -> String {
    let name = site.trim_end_matches(|c: char| c.is_ascii_digit());
    match (site.starts_with(char::is_lowercase), &site[name.len()..]) {
        (true, "") => format!("the {site}"),
        (true, number) => format!("{name} {number}"),
        (false, _) => site.to_string(),
    }
}

/// A name of the table as words.
pub fn spoken(name: &str) -> String {
    name.replace('_', " ")
}

#[cfg(test)]
mod tests {
    use super::{Cause, Gain, size_of};

    fn said(parameters: &[(&'static str, f64, &'static str)]) -> String {
        let cause = Cause {
            effect: "accelerometer_misalignment",
            site: "sensor".into(),
            probability: 0.9,
            summary: "",
            alternatives: Vec::new(),
            parameters: parameters.to_vec(),
            ci95: Vec::new(),
            gain: Gain::of(1.0, 0.1, 0.1),
        };
        size_of(&cause).unwrap()
    }

    #[test]
    fn of_amounts_about_all_axes_the_largest_is_said() {
        let turned = [
            ("about_x", -0.003, "rad"),
            ("about_y", -0.17, "rad"),
            ("about_z", 0.09, "rad"),
        ];
        assert_eq!(said(&turned), ", about y -170 mrad");
        let springs = [
            ("stiffness_x", 1e6, "N·m/rad"),
            ("stiffness_y", 1e8, "N·m/rad"),
        ];
        assert_eq!(said(&springs), ", stiffness x 1.00 MN·m/rad");
        assert_eq!(
            said(&[("gap", 1e-4, "rad"), ("play", 1.0, "rad")]),
            ", gap 100 µrad"
        );
    }
}
