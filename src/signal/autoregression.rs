//! Noise as an autoregression: its colour from residuals, and the filter that whitens it.

/// e_t = r_t - Σ a_k r_(t-k), e white with standard deviation `deviation`.
#[derive(Debug, Clone, PartialEq)]
pub struct Autoregression {
    /// a_1, a_2 ...
    pub coefficients: Vec<f64>,
    /// Standard deviation of what is left.
    pub deviation: f64,
}

impl Autoregression {
    /// White noise.
    pub fn white(deviation: f64) -> Self {
        Self {
            coefficients: Vec::new(),
            deviation,
        }
    }

    /// Fits pieces of one noise (Yule 1927, Walker 1931; Levinson's recursion), the order up to `most`
    /// by Akaike's criterion (1974).
    pub fn fit(pieces: &[Vec<f64>], most: usize) -> Self {
        let rows: usize = pieces.iter().map(Vec::len).sum();
        let lag = |k: usize| -> f64 {
            let of = |p: &Vec<f64>| p.iter().skip(k).zip(p).map(|(a, b)| a * b).sum::<f64>();
            pieces.iter().map(of).sum::<f64>() / rows.max(1) as f64
        };
        let most = most.min(rows / 20);
        let lags: Vec<f64> = (0..=most).map(lag).collect();
        let (mut a, mut error) = (Vec::new(), lags[0].max(f64::MIN_POSITIVE));
        let mut best = Self::white(error.sqrt());
        let mut least = rows as f64 * error.ln();
        for order in 1..=most {
            let known: f64 = a
                .iter()
                .enumerate()
                .map(|(k, v)| v * lags[order - 1 - k])
                .sum();
            let reflection = (lags[order] - known) / error;
            let turned: Vec<f64> = a.iter().rev().map(|v| reflection * v).collect();
            for (v, t) in a.iter_mut().zip(turned) {
                *v -= t;
            }
            a.push(reflection);
            error *= (1.0 - reflection * reflection).max(1e-12);
            let criterion = rows as f64 * error.ln() + 2.0 * order as f64;
            if criterion < least {
                least = criterion;
                best = Self {
                    coefficients: a.clone(),
                    deviation: error.sqrt(),
                };
            }
        }
        best
    }

    /// Whitens a piece in place, in units of the deviation; the first rows, which lack a past, become 0.
    pub fn whiten(&self, piece: &mut [f64]) {
        let order = self.coefficients.len().min(piece.len());
        for t in (order..piece.len()).rev() {
            let past = self.coefficients.iter().enumerate();
            let known: f64 = past.map(|(k, a)| a * piece[t - 1 - k]).sum();
            piece[t] = (piece[t] - known) / self.deviation;
        }
        piece[..order].fill(0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    #[test]
    fn a_coloured_noise_comes_out_white() {
        let mut random = Random::new(3);
        let mut piece = vec![0.0; 4000];
        for t in 1..piece.len() {
            piece[t] = 0.8 * piece[t - 1] + 0.1 * random.normal();
        }
        let found = Autoregression::fit(&[piece.clone()], 8);
        assert!(
            (found.coefficients[0] - 0.8).abs() < 0.05 && (found.deviation - 0.1).abs() < 0.005
        );
        found.whiten(&mut piece);
        let lag = |k: usize| {
            piece
                .iter()
                .skip(k)
                .zip(&piece)
                .map(|(a, b)| a * b)
                .sum::<f64>()
        };
        assert!((lag(1) / lag(0)).abs() < 0.05);
    }
}
