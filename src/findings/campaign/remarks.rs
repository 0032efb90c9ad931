//! What a reader of a campaign should know beside the causes.

use super::DiagnosedFile;
use crate::fit::axis_tests::AxisTest;
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::measurement::hammer_uff::without_hits;
use crate::measurement::workspace::Place;
use crate::sheet::number::engineering;

/// Gaps that are listed by name; of the others only the number.
const LISTED: usize = 4;

/// That tests of the whole robot were simulated with the gaps of the axis tests closed, and whether one of
/// them shows lost motion all the same.
pub fn closed_gaps(files: &[DiagnosedFile], tests: &[AxisTest]) -> Option<String> {
    let whole: Vec<&DiagnosedFile> = files
        .iter()
        .filter(|one| one.found.robot().is_some())
        .collect();
    let mut gaps: Vec<(&str, f64)> = tests
        .iter()
        .filter_map(|test| Some((test.site.as_str(), test.backlash?.0)))
        .filter(|(_, gap)| *gap > 0.0)
        .collect();
    if whole.is_empty() || gaps.is_empty() {
        return None;
    }
    gaps.sort_by(|a, b| b.1.total_cmp(&a.1));
    let largest = gaps.iter().take(LISTED);
    let mut listed: Vec<String> = largest
        .map(|(site, gap)| format!("{site} {}", engineering(*gap, 3, "rad")))
        .collect();
    if gaps.len() > LISTED {
        listed.push(format!("{} smaller ones", gaps.len() - LISTED));
    }
    let stems = |all: &[&DiagnosedFile]| {
        all.iter()
            .map(|one| one.stem())
            .collect::<Vec<_>>()
            .join(", ")
    };
    let loose: Vec<&DiagnosedFile> = whole
        .iter()
        .filter(|one| has_backlash(one))
        .copied()
        .collect();
    let seen = match loose.is_empty() {
        true => "none of these tests shows lost motion".to_string(),
        false => format!("lost motion shows in {}", stems(&loose)),
    };
    Some(format!(
        "The gaps that the axis tests found ({}) are left closed in the simulation of {}: weight can press a \
         joint to one side of its gap, and only such a test can say whether it does; {seen}.",
        listed.join(", "),
        stems(&whole)
    ))
}

/// Hammer tests of which the campaign has no hits, and who reads them.
///
/// # Errors
/// A folder that cannot be read.
pub fn passed_over(place: &Place) -> Outcome<Option<String>> {
    let files = place.files_of("hammer")?.into_iter();
    let names = files
        .filter(|path| without_hits(path))
        .map(|path| files::name(&path));
    let names: Vec<String> = names.collect();
    Ok((!names.is_empty()).then(|| {
        format!(
            "Frequency responses without their hits are not diagnosed ({}): `ident damping` and `ident frf` read them.",
            names.join(", ")
        )
    }))
}

fn has_backlash(one: &DiagnosedFile) -> bool {
    let answer = one.found.answer();
    let causes = answer.causes.iter().map(|cause| cause.effect);
    let groups = answer
        .groups
        .iter()
        .flat_map(|group| group.effects.iter().copied());
    causes.chain(groups).any(|effect| effect == "backlash")
}
