use super::law::{Coefficient, Law, LawCard};
use crate::ground::dual::Scalar;

/// Force as a power of the chip.
pub struct Kienzle;

const fn pressure(name: &'static str, key: &'static str, meaning: &'static str) -> Coefficient {
    Coefficient {
        name,
        key,
        unit: "N/mm²",
        factor: 1e6,
        meaning,
    }
}

const fn exponent(name: &'static str, meaning: &'static str) -> Coefficient {
    Coefficient {
        name,
        key: name,
        unit: "1",
        factor: 1.0,
        meaning,
    }
}

/// The chip to which the specific forces refer, m.
const REFERENCE: f64 = 1e-3;
/// Below this chip, m, the power goes on straight: its slope has no bound at nothing.
const LEAST_CHIP: f64 = 1e-9;

impl Law for Kienzle {
    const CARD: LawCard = LawCard {
        name: "kienzle",
        summary: "Specific cutting force that grows as the chip gets thinner.",
        equation: "dF = k_1.1 h₀ (h/h₀)^(1-m) da, h₀ = 1 mm, tangential, radial, axial",
        source: "Kienzle 1952, VDI-Z 94; Victor and Kienzle 1957",
        coefficients: &[
            pressure(
                "kt11",
                "kt11_N_mm2",
                "tangential force per area of a chip of 1 mm",
            ),
            pressure(
                "kr11",
                "kr11_N_mm2",
                "radial force per area of a chip of 1 mm",
            ),
            pressure(
                "ka11",
                "ka11_N_mm2",
                "axial force per area of a chip of 1 mm",
            ),
            exponent(
                "mt",
                "fall of the specific tangential force with the chip's thickness",
            ),
            exponent(
                "mr",
                "fall of the specific radial force with the chip's thickness",
            ),
            exponent(
                "ma",
                "fall of the specific axial force with the chip's thickness",
            ),
        ],
    };

    fn per_length<S: Scalar>(p: &[S], chip: S) -> [S; 3] {
        let relative = chip.max(S::constant(LEAST_CHIP)) / REFERENCE;
        let logarithm = relative.chain(relative.value().ln(), 1.0 / relative.value());
        std::array::from_fn(|k| {
            let power = ((S::constant(1.0) - p[k + 3]) * logarithm).exp();
            p[k] * power * REFERENCE
        })
    }
}
