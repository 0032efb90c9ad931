//! The causes of a fit, in the units of their kind.

use super::bank::{Bank, Fit};
use super::materiality::raw_parts;
use super::statement::Blamed;

/// Of every member, in the order of the fit.
pub(super) fn blamed(bank: &Bank, fit: &Fit) -> Vec<Blamed> {
    let mut at = 0;
    let variance = fit.posterior.noise_variance;
    let each = fit
        .members
        .iter()
        .zip(raw_parts(bank, fit))
        .map(|(member, part)| {
            let (entry, suspect, own) = (
                &bank.entries[*member],
                bank.suspect(*member),
                bank.member(*member),
            );
            let (first, count) = (at, own.columns.len());
            at += count;
            let covariance = fit
                .posterior
                .covariance
                .view((first, first), (count, count));
            Blamed {
                effect: suspect.effect,
                site: suspect.site.clone(),
                shape: own.shape.clone(),
                amounts: (0..count)
                    .map(|k| fit.posterior.mean[first + k] * entry.scale)
                    .collect(),
                covariance: covariance * (variance * entry.scale * entry.scale),
                part,
            }
        });
    each.collect()
}
