//! What of the stock is gone although no tooth cut it.

use super::run::Outcome;
use crate::sheet::number::significant;

/// Share of what is taken away from which on it is told that no tooth cut it.
const TOLD: f64 = 0.01;

/// Volume of which nobody need be told, m³: a tenth of a cubic millimetre, less than cells of the stock hold.
const LEAST_M3: f64 = 1e-10;

impl Outcome {
    /// Material that is gone without a force, in sentences.
    pub fn not_cut(&self) -> Vec<String> {
        let all = self.removed_m3 + self.stood_in_m3;
        let counts = |volume: f64| volume > (TOLD * all).max(LEAST_M3);
        let mm3 = |volume: f64| significant(1e9 * volume, 3);
        let drilled = counts(self.drilled_m3).then(|| {
            let volume = mm3(self.drilled_m3);
            format!("{volume} mm³ {DRILLED}")
        });
        let stood_in = counts(self.stood_in_m3).then(|| {
            let volume = mm3(self.stood_in_m3);
            format!("the tool begins within {volume} mm³ of stock: {STOOD_IN}")
        });
        drilled.into_iter().chain(stood_in).collect()
    }
}

const DRILLED: &str = "are taken without a force: where a tool plunges its flat end drills, and no law here says what that takes";
const STOOD_IN: &str =
    "they are gone without a cut, and not counted; begin the path beside the stock";
