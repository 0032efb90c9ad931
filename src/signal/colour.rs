//! The colour of measurement noise: its variance over frequency, from residuals.
//!
//! Laser noise is not white: an interval that assumes white noise is too narrow. The spectrum is
//! chosen by likelihood among white, pink and first-order autoregressive families, in the cosine
//! domain where each is a diagonal.

/// A noise spectrum over the indices of an orthonormal cosine transform.
#[derive(Debug, Clone, PartialEq)]
pub struct Colour {
    /// Standard deviation of every cosine coefficient.
    pub sigma: Vec<f64>,
    /// Standard deviation of one sample.
    pub rms: f64,
    /// Which family fitted, as a word: `white`, `pink`, `autoregressive`.
    pub family: &'static str,
    /// Its shape: exponent and corner, or the correlation of neighbours.
    pub shape: [f64; 2],
}

/// Families within this many nats of the best are as good; the one with most low-frequency noise
/// is taken, because the fitted curve hides low frequencies from the estimate.
const AS_GOOD: f64 = 0.7;

impl Colour {
    /// White noise of a known size.
    pub fn white(n: usize, rms: f64) -> Self {
        Self {
            sigma: vec![rms; n],
            rms,
            family: "white",
            shape: [0.0, 0.0],
        }
    }

    /// Chooses colour and size from cosine coefficients of a residual. `freedom[k]` in 0..=1 is the
    /// share of coefficient k that the fit left free (1: untouched by the fit).
    pub fn estimate(coefficients: &[f64], freedom: &[f64]) -> Self {
        let chosen = scored(coefficients, freedom, AS_GOOD)
            .into_iter()
            .max_by(|a, b| a.2.low_share().total_cmp(&b.2.low_share()));
        match chosen {
            Some((_, size, candidate)) => candidate.into_colour(size),
            None => Self::white(coefficients.len(), 0.0),
        }
    }

    /// Standard deviation per sample of the least noisy tenth of the band: where white noise shows.
    pub fn floor(&self) -> f64 {
        let mut sorted = self.sigma.clone();
        sorted.sort_by(f64::total_cmp);
        sorted.get(sorted.len() / 10).copied().unwrap_or(0.0)
    }

    /// Relative standard error of a mean square over noise of this colour: √(2Σσ⁴)/Σσ².
    pub fn relative_error(&self) -> f64 {
        let (squares, fourth) = self
            .sigma
            .iter()
            .fold((0.0, 0.0), |(a, b), s| (a + s * s, b + s.powi(4)));
        if squares > 0.0 {
            (2.0 * fourth).sqrt() / squares
        } else {
            0.0
        }
    }

    /// Divides cosine coefficients by their noise.
    pub fn whiten(&self, coefficients: &mut [f64]) {
        for (c, s) in coefficients.iter_mut().zip(&self.sigma) {
            *c /= s;
        }
    }

    /// Noise in words.
    pub fn describe(&self) -> String {
        match self.family {
            "pink" => format!("pink (1/f^{:.1})", self.shape[0]),
            "autoregressive" => format!("correlated (neighbours {:.2})", self.shape[0]),
            other => other.to_string(),
        }
    }
}

/// Log likelihood, size and family of the candidates within `nats` of the best.
fn scored(coefficients: &[f64], freedom: &[f64], nats: f64) -> Vec<(f64, f64, Candidate)> {
    let score = |candidate: Candidate| {
        let (likelihood, size) = candidate.score(coefficients, freedom);
        (likelihood, size, candidate)
    };
    let mut all: Vec<_> = candidates(coefficients.len())
        .into_iter()
        .map(score)
        .collect();
    let best = all.iter().map(|s| s.0).fold(f64::MIN, f64::max);
    all.retain(|s| s.0 >= best - nats);
    all
}

struct Candidate {
    family: &'static str,
    shape: [f64; 2],
    relative: Vec<f64>,
}

fn candidates(n: usize) -> Vec<Candidate> {
    let mut all = vec![Candidate {
        family: "white",
        shape: [0.0; 2],
        relative: vec![1.0; n],
    }];
    for correlation in [
        0.12, 0.22, 0.32, 0.42, 0.52, 0.6, 0.68, 0.76, 0.83, 0.89, 0.93, 0.96, 0.985,
    ] {
        for floor in [0.0, 0.08, 0.4] {
            // a white floor as high as this share of the whole variance
            let level = floor / (1.0 - correlation * correlation);
            all.push(Candidate {
                family: "autoregressive",
                shape: [correlation, floor],
                relative: (0..n)
                    .map(|k| level + autoregressive(k, n, correlation))
                    .collect(),
            });
        }
    }
    for exponent in [0.7, 1.0, 1.3, 1.7] {
        for corner in [0.003, 0.01, 0.03, 0.08, 0.2, 0.5, 1.5] {
            all.push(Candidate {
                family: "pink",
                shape: [exponent, corner],
                relative: (0..n).map(|k| pink(k, n, exponent, corner)).collect(),
            });
        }
    }
    all
}

/// Spectrum of x[i] = ρ x[i−1] + e[i] at DCT index k, with unit innovation.
fn autoregressive(k: usize, n: usize, rho: f64) -> f64 {
    let w = std::f64::consts::PI * (k as f64 + 0.5) / n as f64;
    1.0 / (1.0 - 2.0 * rho * w.cos() + rho * rho)
}

/// 1 + (corner/f)^exponent with f from 0 to 1 (Nyquist).
fn pink(k: usize, n: usize, exponent: f64, corner: f64) -> f64 {
    let f = (k as f64 + 0.5) / n as f64;
    1.0 + (corner / f).powf(exponent)
}

impl Candidate {
    /// Whittle likelihood profiled over the size, with the fit's lost freedom taken out.
    fn score(&self, coefficients: &[f64], freedom: &[f64]) -> (f64, f64) {
        let (mut chi, mut free, mut logs) = (0.0, 0.0, 0.0);
        for ((c, f), r) in coefficients.iter().zip(freedom).zip(&self.relative) {
            chi += c * c / r;
            free += f;
            logs += f * r.ln();
        }
        let size = (chi / free.max(1.0)).max(f64::MIN_POSITIVE);
        (-0.5 * (free * size.ln() + logs), size)
    }

    /// Share of the variance in the lowest twentieth of the band.
    fn low_share(&self) -> f64 {
        let low = (self.relative.len() / 20).max(1);
        self.relative.iter().take(low).sum::<f64>() / self.relative.iter().sum::<f64>()
    }

    fn into_colour(self, size: f64) -> Colour {
        let variance = size * self.relative.iter().sum::<f64>() / self.relative.len().max(1) as f64;
        Colour {
            sigma: self.relative.iter().map(|r| (size * r).sqrt()).collect(),
            rms: variance.sqrt(),
            family: self.family,
            shape: self.shape,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;
    use crate::signal::cosine::Cosine;

    #[test]
    fn finds_the_correlation_of_autoregressive_noise() {
        let (n, rho) = (1500, 0.8);
        let mut random = Random::new(3);
        let mut x = vec![0.0; n];
        for i in 1..n {
            x[i] = rho * x[i - 1] + random.normal();
        }
        let truth = (x.iter().map(|v| v * v).sum::<f64>() / n as f64).sqrt();
        Cosine::new(n).transform(&mut x);
        let colour = Colour::estimate(&x, &vec![1.0; n]);
        assert!(
            (colour.rms / truth - 1.0).abs() < 0.1,
            "{} {truth}",
            colour.rms
        );
        assert_ne!(colour.family, "white");
    }
}
