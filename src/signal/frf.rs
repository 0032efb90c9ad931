//! Estimators of the frequency response function of one input and several outputs over several hits.

use super::spectrum::Transform;
use rustfft::num_complex::Complex64;

/// Which estimator of the FRF.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Estimator {
    /// `Sfx/Sff`: unbiased under noise on the response, low under noise on the force.
    #[default]
    H1,
    /// `Sxx/Sxf`: unbiased under noise on the force, high under noise on the response.
    H2,
    /// Total least squares with equal noise in SI units on both channels.
    Hv,
}

/// The spectra of one hit, lines 0 to some highest line.
#[derive(Debug, Clone, PartialEq)]
pub struct HitSpectra {
    /// Force, N·samples.
    pub force: Vec<Complex64>,
    /// One spectrum per response, (m/s²)·samples.
    pub responses: Vec<Vec<Complex64>>,
}

impl HitSpectra {
    /// Transforms the (windowed) records of one hit and keeps the first `keep` lines.
    pub fn new(force: Vec<f64>, responses: Vec<Vec<f64>>, keep: usize) -> Self {
        let transform = Transform::new(force.len());
        Self {
            force: transform.of(force, keep),
            responses: responses
                .into_iter()
                .map(|r| transform.of(r, keep))
                .collect(),
        }
    }

    /// The FRF of this hit alone, `X/F`, for one output.
    pub fn ratio(&self, output: usize) -> Vec<Complex64> {
        let pairs = self.force.iter().zip(&self.responses[output]);
        pairs.map(|(f, x)| x / f).collect()
    }
}

/// Auto and cross spectra of one input and one output, summed over hits.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Line {
    /// `Sff = Σ|F|²`
    pub ff: f64,
    /// `Sxx = Σ|X|²`
    pub xx: f64,
    /// `Sfx = Σ conj(F)·X`
    pub fx: Complex64,
}

impl Line {
    /// Adds one hit.
    pub fn add(&mut self, f: Complex64, x: Complex64) {
        self.ff += f.norm_sqr();
        self.xx += x.norm_sqr();
        self.fx += f.conj() * x;
    }

    /// Takes one hit out again (for the jackknife).
    pub fn without(mut self, f: Complex64, x: Complex64) -> Self {
        self.ff -= f.norm_sqr();
        self.xx -= x.norm_sqr();
        self.fx -= f.conj() * x;
        self
    }

    /// `H1 = Sfx/Sff` (Bendat and Piersol 2010, eq. 6.37).
    pub fn h1(&self) -> Complex64 {
        self.fx / self.ff
    }

    /// `H2 = Sxx/Sxf`.
    pub fn h2(&self) -> Complex64 {
        self.xx / self.fx.conj()
    }

    /// `Hv = (Sxx − Sff + √((Sxx − Sff)² + 4|Sfx|²)) / (2·Sxf)` (Rocklin, Crowley and Vold 1985),
    /// written without the cancellation where the force outweighs the response.
    pub fn hv(&self) -> Complex64 {
        let difference = self.xx - self.ff;
        let root = difference.hypot(2.0 * self.fx.norm());
        if difference > 0.0 {
            (difference + root) / (2.0 * self.fx.conj())
        } else {
            2.0 * self.fx / (root - difference)
        }
    }

    /// The chosen estimate.
    pub fn estimate(&self, estimator: Estimator) -> Complex64 {
        match estimator {
            Estimator::H1 => self.h1(),
            Estimator::H2 => self.h2(),
            Estimator::Hv => self.hv(),
        }
    }

    /// Ordinary coherence `γ² = |Sfx|²/(Sff·Sxx)`; 1 for a single hit, whatever the noise.
    pub fn coherence(&self) -> f64 {
        self.fx.norm_sqr() / (self.ff * self.xx)
    }
}

/// Spectra of one input and several outputs, accumulated hit by hit: `lines[output][line]`.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossSpectra {
    /// Hits added so far.
    pub hits: usize,
    /// Sums per output and line.
    pub lines: Vec<Vec<Line>>,
}

impl CrossSpectra {
    /// Nothing added yet.
    pub fn new(outputs: usize, lines: usize) -> Self {
        Self {
            hits: 0,
            lines: vec![vec![Line::default(); lines]; outputs],
        }
    }

    /// The sums over `hits`.
    pub fn of<'a>(hits: impl IntoIterator<Item = &'a HitSpectra>) -> Self {
        let mut hits = hits.into_iter().peekable();
        let (outputs, lines) = hits
            .peek()
            .map_or((0, 0), |hit| (hit.responses.len(), hit.force.len()));
        let mut sums = Self::new(outputs, lines);
        hits.for_each(|hit| sums.add(hit));
        sums
    }

    /// Adds one hit.
    pub fn add(&mut self, hit: &HitSpectra) {
        for (sums, response) in self.lines.iter_mut().zip(&hit.responses) {
            for ((line, f), x) in sums.iter_mut().zip(&hit.force).zip(response) {
                line.add(*f, *x);
            }
        }
        self.hits += 1;
    }

    /// The chosen estimate of one output, one value per line. The DC line is not a number: an
    /// accelerometer and a piezo hammer do not see it.
    pub fn estimate(&self, output: usize, estimator: Estimator) -> Vec<Complex64> {
        let mut frf: Vec<_> = self.lines[output]
            .iter()
            .map(|line| line.estimate(estimator))
            .collect();
        if let Some(dc) = frf.first_mut() {
            *dc = Complex64::new(f64::NAN, f64::NAN);
        }
        frf
    }

    /// The coherence of one output; not a number at DC, and nowhere one for a single hit.
    pub fn coherence(&self, output: usize) -> Vec<f64> {
        let known = |k: usize| k > 0 && self.hits > 1;
        let lines = self.lines[output].iter().enumerate();
        lines
            .map(|(k, line)| if known(k) { line.coherence() } else { f64::NAN })
            .collect()
    }
}

/// The sums over hits given as (force, responses), without keeping their spectra; the first `keep`
/// lines. Buffers are reused: the work is the transforms.
pub fn accumulate(hits: &[(Vec<f64>, Vec<Vec<f64>>)], keep: usize) -> CrossSpectra {
    let Some((force, responses)) = hits.first() else {
        return CrossSpectra::new(0, 0);
    };
    let transform = Transform::new(force.len());
    let mut record = vec![0.0; force.len()];
    let mut scratch = transform.scratch();
    let mut lines = vec![Complex64::new(0.0, 0.0); transform.lines()];
    let mut force_lines = lines.clone();
    let mut sums = CrossSpectra::new(responses.len(), keep);
    for (force, responses) in hits {
        record.copy_from_slice(force);
        transform.process(&mut record, &mut force_lines, &mut scratch);
        for (sums, response) in sums.lines.iter_mut().zip(responses) {
            record.copy_from_slice(response);
            transform.process(&mut record, &mut lines, &mut scratch);
            for ((line, f), x) in sums.iter_mut().zip(&force_lines).zip(&lines) {
                line.add(*f, *x);
            }
        }
        sums.hits += 1;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn estimators_agree_without_noise_and_keep_the_phase() {
        let h = Complex64::new(-0.3, 1.2);
        let mut line = Line::default();
        for f in [Complex64::new(1.0, -2.0), Complex64::new(0.2, 3.0)] {
            line.add(f, h * f);
        }
        for estimator in [Estimator::H1, Estimator::H2, Estimator::Hv] {
            assert!((line.estimate(estimator) - h).norm() < 1e-12);
        }
        assert!((line.coherence() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn one_hit_has_no_coherence() {
        let hit = HitSpectra::new(vec![1.0, 0.0, 0.0, 0.0], vec![vec![0.0, 1.0, 0.5, 0.0]], 3);
        let sums = CrossSpectra::of([&hit]);
        assert!(sums.coherence(0).iter().all(|g| g.is_nan()));
        assert!(sums.estimate(0, Estimator::H1)[0].re.is_nan());
    }
}
