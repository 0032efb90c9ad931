//! The verdict as a sentence that an engineer can act on.

use super::diagnosis::{Diagnosis, Verdict};
use crate::effects;
use crate::sheet::number::engineering;

/// What the diagnosis says, in one to three sentences.
pub fn sentence(diagnosis: &Diagnosis) -> String {
    let unit = diagnosis.unit;
    let size = format!(
        "The simulation misses the readings by {} (noise {})",
        engineering(diagnosis.discrepancy.rms, 3, unit),
        engineering(diagnosis.discrepancy.noise_rms, 2, unit)
    );
    match diagnosis.verdict {
        Verdict::Sufficient => format!(
            "The simulation is right to within the noise: it misses the readings by {}, of which {} is noise.",
            engineering(diagnosis.discrepancy.rms, 3, unit),
            engineering(diagnosis.discrepancy.noise_rms, 2, unit)
        ),
        Verdict::UnknownCause => format!(
            "{size}, {}. No effect in the library explains it: {}",
            diagnosis.discrepancy.place, diagnosis.unexplained.description
        ),
        _ => format!(
            "{size}, {}. {}",
            diagnosis.discrepancy.place,
            reasons(diagnosis)
        ),
    }
}

fn reasons(diagnosis: &Diagnosis) -> String {
    let mut parts: Vec<String> = diagnosis
        .causes
        .iter()
        .map(|cause| {
            let summary = effects::named(cause.effect).map_or("", |e| e.card().summary);
            format!(
                "Cause: {} at {} ({:.0} % probable); naming it cuts the error on unseen cycles by {:.0} %. {summary}",
                cause.effect,
                cause.site,
                100.0 * cause.probability,
                cause.gain.reduction_percent
            )
        })
        .collect();
    for group in &diagnosis.groups {
        parts.push(format!(
            "These data cannot tell {} apart; {} would.",
            group.effects.join(" from "),
            group.would_tell
        ));
    }
    if diagnosis.verdict == Verdict::PartlyExplained {
        parts.push(format!(
            "Structure remains: {}",
            diagnosis.unexplained.description
        ));
    }
    parts.join(" ")
}
