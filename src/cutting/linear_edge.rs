use super::law::{Coefficient, Law, LawCard};
use crate::ground::dual::Scalar;

/// Force linear in the chip, with a share of the edge that does not depend on it.
pub struct LinearEdge;

const fn cutting(name: &'static str, key: &'static str, meaning: &'static str) -> Coefficient {
    Coefficient {
        name,
        key,
        unit: "N/mm²",
        factor: 1e6,
        meaning,
    }
}

const fn edge(name: &'static str, key: &'static str, meaning: &'static str) -> Coefficient {
    Coefficient {
        name,
        key,
        unit: "N/mm",
        factor: 1e3,
        meaning,
    }
}

impl Law for LinearEdge {
    const CARD: LawCard = LawCard {
        name: "linear_edge",
        summary: "Shearing in proportion to the chip's area, rubbing in proportion to the edge in cut.",
        equation: "dF = (K_c h + K_e) da, tangential, radial, axial",
        source: "Altintas 2000, Manufacturing Automation, eq. 2.78; source 001, eq. 2",
        coefficients: &[
            cutting("Ktc", "Ktc_N_mm2", "tangential force per area of chip"),
            cutting("Krc", "Krc_N_mm2", "radial force per area of chip"),
            cutting("Kac", "Kac_N_mm2", "axial force per area of chip"),
            edge("Kte", "Kte_N_mm", "tangential force per length of edge"),
            edge("Kre", "Kre_N_mm", "radial force per length of edge"),
            edge("Kae", "Kae_N_mm", "axial force per length of edge"),
        ],
    };

    fn per_length<S: Scalar>(p: &[S], chip: S) -> [S; 3] {
        std::array::from_fn(|k| p[k] * chip + p[k + 3])
    }
}
