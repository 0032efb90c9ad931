//! Coloured measuring noise, made in the time domain.

use super::random::Random;

/// The colour of the noise and its parameters.
#[derive(Clone, Copy)]
pub enum Colour {
    White,
    /// Power spectrum 1 + (corner / f)^exponent, corner in cycles per sample.
    Pink {
        exponent: f64,
        corner: f64,
    },
    /// First-order autoregression with this coefficient.
    Ar1 {
        rho: f64,
    },
}

impl Colour {
    pub fn draw(random: &mut Random) -> Self {
        match random.integer(0, 2) {
            0 => Self::White,
            1 => Self::Pink {
                exponent: random.uniform(0.7, 1.3),
                corner: random.log_uniform(0.005, 0.08),
            },
            _ => Self::Ar1 {
                rho: random.uniform(0.3, 0.9),
            },
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::White => "white",
            Self::Pink { .. } => "pink",
            Self::Ar1 { .. } => "ar1",
        }
    }

    /// A realisation scaled to exactly unit rms, so that strengths hold for this very file.
    pub fn realise(self, count: usize, random: &mut Random) -> Vec<f64> {
        let mut noise = match self {
            Self::White => (0..count).map(|_| random.normal()).collect(),
            Self::Pink { exponent, corner } => pink(count, exponent, corner, random),
            Self::Ar1 { rho } => autoregressive(count, rho, random),
        };
        let rms = (noise.iter().map(|x| x * x).sum::<f64>() / count as f64).sqrt();
        noise.iter_mut().for_each(|x| *x /= rms);
        noise
    }
}

/// White noise plus fractionally integrated noise, h_k = h_{k-1} (k - 1 + a/2) / k (Kasdin, 1995),
/// equal in power at the corner.
fn pink(count: usize, exponent: f64, corner: f64, random: &mut Random) -> Vec<f64> {
    const MEMORY: usize = 600;
    let mut filter = vec![1.0; MEMORY];
    for k in 1..MEMORY {
        filter[k] = filter[k - 1] * (k as f64 - 1.0 + exponent / 2.0) / k as f64;
    }
    let drive: Vec<f64> = (0..count + MEMORY).map(|_| random.normal()).collect();
    let gain = (std::f64::consts::TAU * corner).powf(exponent / 2.0);
    (0..count)
        .map(|i| {
            let past = drive[i..i + MEMORY].iter().rev();
            let slow: f64 = past.zip(&filter).map(|(x, h)| x * h).sum();
            random.normal() + gain * slow
        })
        .collect()
}

/// x_i = rho x_{i-1} + sqrt(1 - rho^2) w_i, started in its stationary state.
fn autoregressive(count: usize, rho: f64, random: &mut Random) -> Vec<f64> {
    let fresh = (1.0 - rho * rho).sqrt();
    let mut x = random.normal();
    (0..count)
        .map(|_| {
            x = rho * x + fresh * random.normal();
            x
        })
        .collect()
}
