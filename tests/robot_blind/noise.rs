//! Noise of displacement sensors and accelerometers, made in the time domain.

use crate::blind_generator::random::Random;

/// White, or a first-order autoregression with coefficient `rho`; standard deviation `size`.
#[derive(Clone, Copy)]
pub struct Noise {
    pub size: f64,
    pub rho: f64,
}

impl Noise {
    pub fn draw(size: f64, coloured: f64, random: &mut Random) -> Self {
        let rho = if random.chance(coloured) {
            random.uniform(0.2, 0.7)
        } else {
            0.0
        };
        Self { size, rho }
    }

    pub fn name(self) -> &'static str {
        if self.rho > 0.0 { "ar1" } else { "white" }
    }

    /// A stretch of noise, begun in its stationary state.
    pub fn stretch(self, count: usize, random: &mut Random) -> Vec<f64> {
        let fresh = (1.0 - self.rho * self.rho).sqrt();
        let mut state = random.normal();
        let mut next = || {
            state = self.rho * state + fresh * random.normal();
            self.size * state
        };
        (0..count).map(|_| next()).collect()
    }
}
