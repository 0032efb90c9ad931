//! A structure as a sum of modes whose residue matrices have rank one.

use nalgebra::DMatrix;
use rustfft::num_complex::Complex64;

/// Sparse derivatives of one parameter: its index, and per column of the basis the factor.
pub type Row = (usize, Vec<(usize, f64)>);

/// Poles and shapes. Either the residue of output o and input i is `left[o]·right[i]`, or, by
/// reciprocity, `(T·ψ)[o]·ψ[driven[i]]` with one real matrix T for the gains and directions of
/// hammer and sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// Poles in the upper half plane, 1/s.
    pub poles: Vec<Complex64>,
    /// Shapes: at the outputs, and at the inputs unless reciprocal.
    pub shapes: Vec<[Vec<Complex64>; 2]>,
    /// Reciprocal: T, and which output each input drives.
    pub tie: Option<(DMatrix<f64>, Vec<usize>)>,
    /// Whether T is fitted too.
    pub loose: bool,
    /// Number of outputs.
    pub outputs: usize,
}

impl Structure {
    /// Number of modes.
    pub fn modes(&self) -> usize {
        self.poles.len()
    }

    /// Parameters of one mode as they are stepped.
    pub fn per_mode(&self) -> usize {
        let shape = |s: &[Vec<Complex64>; 2]| 2 * (s[0].len() + s[1].len());
        2 + self.shapes.first().map_or(0, shape)
    }

    /// All parameters as they are stepped.
    pub fn parameters(&self) -> usize {
        let mixing = if self.loose { self.outputs.pow(2) } else { 0 };
        self.modes() * self.per_mode() + mixing
    }

    /// What the data must pay for: without the scales that may move between factors.
    pub fn paid(&self) -> usize {
        let scales = match &self.tie {
            Some(_) => usize::from(self.loose),
            None => 2 * self.modes(),
        };
        self.parameters() - scales
    }

    /// Parameters that share their scale with the shapes at the outputs: T, or shapes at the inputs.
    pub fn scales(&self) -> Vec<usize> {
        let size = self.per_mode();
        let right = self
            .shapes
            .iter()
            .enumerate()
            .flat_map(|(r, [left, right])| {
                let start = r * size + 2 + 2 * left.len();
                start..start + 2 * right.len()
            });
        right
            .chain(self.modes() * size..self.parameters())
            .collect()
    }

    /// Output and input of a channel.
    pub fn ends(&self, channel: usize) -> (usize, usize) {
        (channel % self.outputs, channel / self.outputs)
    }

    /// The two factors of the residue of mode `r` in `channel`.
    fn factors(&self, r: usize, channel: usize) -> (Complex64, Complex64) {
        let (o, i) = self.ends(channel);
        let [left, right] = &self.shapes[r];
        match &self.tie {
            Some((t, driven)) => {
                let mixed = left.iter().enumerate().map(|(m, v)| v * t[(o, m)]).sum();
                (mixed, left[driven[i]])
            }
            None => (left[o], right[i]),
        }
    }

    /// The residue of mode `r` in `channel`.
    pub fn residue(&self, r: usize, channel: usize) -> Complex64 {
        let (a, b) = self.factors(r, channel);
        a * b
    }

    /// Derivatives of `channel` in the parameters that it sees, over the columns of the basis: per
    /// mode residue (real, imaginary), then slope (real, imaginary).
    pub fn rows(&self, channel: usize) -> Vec<Row> {
        let mut rows = Vec::new();
        for r in 0..self.modes() {
            self.pole_rows(r, channel, &mut rows);
            self.shape_rows(r, channel, &mut rows);
        }
        self.mixing_rows(channel, &mut rows);
        rows
    }

    /// The pole moves by `ln(−Re p)` and `Im p`.
    fn pole_rows(&self, r: usize, channel: usize, rows: &mut Vec<Row>) {
        let (start, at) = (r * self.per_mode(), 4 * r);
        let a = self.residue(r, channel);
        let real = self.poles[r].re;
        rows.push((start, vec![(at + 2, a.re * real), (at + 3, a.im * real)]));
        rows.push((start + 1, vec![(at + 2, -a.im), (at + 3, a.re)]));
    }

    fn shape_rows(&self, r: usize, channel: usize, rows: &mut Vec<Row>) {
        let start = r * self.per_mode() + 2;
        let (o, i) = self.ends(channel);
        let (a, b) = self.factors(r, channel);
        match &self.tie {
            Some((t, driven)) => {
                for m in 0..self.outputs {
                    let own = if m == driven[i] {
                        a
                    } else {
                        Complex64::new(0.0, 0.0)
                    };
                    complex_rows(start + 2 * m, r, b * t[(o, m)] + own, rows);
                }
            }
            None => {
                complex_rows(start + 2 * o, r, b, rows);
                complex_rows(start + 2 * (self.outputs + i), r, a, rows);
            }
        }
    }

    fn mixing_rows(&self, channel: usize, rows: &mut Vec<Row>) {
        let (Some((_, driven)), true) = (&self.tie, self.loose) else {
            return;
        };
        let (o, i) = self.ends(channel);
        let start = self.modes() * self.per_mode() + o * self.outputs;
        for m in 0..self.outputs {
            let parts = self.shapes.iter().enumerate().flat_map(|(r, [shape, _])| {
                let factor = shape[m] * shape[driven[i]];
                [(4 * r, factor.re), (4 * r + 1, factor.im)]
            });
            rows.push((start + m, parts.collect()));
        }
    }

    /// The structure after a step; none if a pole leaves the left half plane.
    pub fn stepped(&self, step: &[f64]) -> Option<Self> {
        let mut moved = self.clone();
        let size = self.per_mode();
        for (r, step) in step.chunks(size).take(self.modes()).enumerate() {
            let pole = self.poles[r];
            let decay = step[0].clamp(-1.0, 1.0).exp();
            moved.poles[r] = Complex64::new(pole.re * decay, pole.im + step[1]);
            let shape = moved.shapes[r].iter_mut().flatten();
            for (value, step) in shape.zip(step[2..].chunks(2)) {
                *value += Complex64::new(step[0], step[1]);
            }
        }
        if let (Some((t, _)), true) = (&mut moved.tie, self.loose) {
            for (k, step) in step[self.modes() * size..].iter().enumerate() {
                t[(k / self.outputs, k % self.outputs)] += step;
            }
        }
        let stable = |p: &Complex64| p.im > 0.0 && p.is_finite();
        moved.poles.iter().all(stable).then_some(moved)
    }

    /// The structure with one more mode of this shape.
    pub fn with(&self, pole: Complex64, shape: [Vec<Complex64>; 2]) -> Self {
        let mut more = self.clone();
        more.poles.push(pole);
        more.shapes.push(shape);
        more
    }

    /// The structure without mode `r`.
    pub fn without(&self, r: usize) -> Self {
        let mut less = self.clone();
        less.poles.remove(r);
        less.shapes.remove(r);
        less
    }
}

/// Rows of the real and imaginary part of a complex factor of a residue, whose other factor is `by`.
fn complex_rows(start: usize, r: usize, by: Complex64, rows: &mut Vec<Row>) {
    rows.push((start, vec![(4 * r, by.re), (4 * r + 1, by.im)]));
    rows.push((start + 1, vec![(4 * r, -by.im), (4 * r + 1, by.re)]));
}
