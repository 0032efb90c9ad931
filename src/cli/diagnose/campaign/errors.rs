//! The error of every experiment of a campaign in one figure.

use crate::findings::Answer;
use crate::findings::campaign::DiagnosedFile;
use crate::sheet::chart::{Axis, Chart, Panel, Series};

/// Beyond this ratio to the noise the small errors would vanish on a linear axis.
const LINEAR: f64 = 40.0;

/// Error over noise, experiment by experiment, without and with what was named; `None` where no noise
/// gives a measure.
pub fn figure(files: &[DiagnosedFile], synthetic: bool) -> Option<Chart> {
    let noisy = |one: &&DiagnosedFile| one.found.answer().discrepancy.noise_rms > 0.0;
    let known: Vec<&DiagnosedFile> = files.iter().filter(noisy).collect();
    if known.is_empty() {
        return None;
    }
    let answers = || known.iter().map(|one| one.found.answer());
    let before: Vec<f64> = answers().map(|a| ratio(a, a.discrepancy.rms)).collect();
    let after: Vec<f64> = answers()
        .map(|a| held_out(a).map_or(f64::NAN, |rms| ratio(a, rms)))
        .collect();
    let noise = vec![[-0.5, 1.0], [known.len() as f64 - 0.5, 1.0]];
    let mut axis = Axis::new("Error over noise", "");
    axis.log = before.iter().fold(0.0_f64, |m, v| m.max(*v)) > LINEAR;
    let panel = Panel::new(Axis::default(), axis)
        .over(known.iter().map(|one| one.stem()))
        .with(Series::bars("present simulation", &before))
        .with(Series::bars(
            "with the named causes, on held-out data",
            &after,
        ))
        .with(Series::dashed("noise", noise));
    let caption = "Root mean square of measured − simulated, of the noise that the readings show. What the \
                   named causes explain comes down to the noise; what stands above it is unexplained.";
    let title = "What the simulation misses, experiment by experiment";
    Some(
        Chart::new("campaign-errors", title, caption)
            .with(panel)
            .synthetic(synthetic),
    )
}

fn ratio(answer: &Answer, rms: f64) -> f64 {
    rms / answer.discrepancy.noise_rms
}

/// Error on held-out data with everything named; `None` where nothing was.
pub fn held_out(answer: &Answer) -> Option<f64> {
    let causes = answer.causes.iter().map(|cause| cause.gain);
    let all = causes.chain(answer.groups.iter().map(|group| group.gain));
    all.map(|gain| gain.after).reduce(f64::min)
}
