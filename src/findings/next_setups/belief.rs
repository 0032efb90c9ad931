//! What is known of the compliances: a Gaussian, in relative values.

use nalgebra::{DMatrix, DVector};

/// Mean and covariance of every unknown.
#[derive(Debug, Clone, PartialEq)]
pub struct Belief {
    /// Names of the sites.
    pub sites: Vec<String>,
    /// Compliance over its reference.
    pub mean: DVector<f64>,
    /// Covariance of these.
    pub covariance: DMatrix<f64>,
    /// Standard deviation before anything was measured.
    pub prior: DVector<f64>,
}

impl Belief {
    /// Takes in readings: rows with unit noise, and what they read. Returns the information gained,
    /// nats; zero if the rows are not numbers.
    pub fn learn(&mut self, rows: &DMatrix<f64>, readings: &DVector<f64>) -> f64 {
        let carried = rows * &self.covariance;
        let spread = &carried * rows.transpose() + DMatrix::identity(rows.nrows(), rows.nrows());
        let Some(root) = spread.cholesky() else {
            return 0.0;
        };
        let surprise = readings - rows * &self.mean;
        self.mean += carried.transpose() * root.solve(&surprise);
        let less = carried.transpose() * root.solve(&carried);
        self.covariance -= less;
        let even = 0.5 * (&self.covariance + self.covariance.transpose());
        self.covariance = even;
        root.l_dirty().diagonal().iter().map(|d| d.ln()).sum()
    }

    /// What [`Belief::learn`] makes of rows whose readings are not known yet: the mean stays.
    pub fn expect(&mut self, rows: &DMatrix<f64>) -> f64 {
        let readings = rows * &self.mean;
        self.learn(rows, &readings)
    }

    /// Index of a site.
    pub fn index(&self, site: &str) -> Option<usize> {
        self.sites.iter().position(|name| name == site)
    }

    /// Standard deviation of an unknown, of its reference.
    pub fn std(&self, i: usize) -> f64 {
        self.covariance[(i, i)].max(0.0).sqrt()
    }

    /// Correlation between two unknowns.
    pub fn correlation(&self, i: usize, j: usize) -> f64 {
        let size = self.std(i) * self.std(j);
        match size > 0.0 {
            true => self.covariance[(i, j)] / size,
            false => 0.0,
        }
    }

    /// The directions in which pairs of places differ. A place of several axes (`base`, `link2`)
    /// takes part with the axis that is hardest to tell from the other place.
    pub fn pairs(&self, places: &[(String, String)]) -> Vec<DVector<f64>> {
        let pair = |(a, b): &(String, String)| {
            let (a, b) = (self.axes(a), self.axes(b));
            let all = a.iter().flat_map(|i| b.iter().map(move |j| (*i, *j)));
            let apart = all.filter(|(i, j)| i != j);
            let tied = |pair: &(usize, usize)| self.correlation(pair.0, pair.1).abs();
            apart.max_by(|p, q| tied(p).total_cmp(&tied(q)))
        };
        let pairs = places.iter().filter_map(pair);
        pairs.map(|(i, j)| self.difference(i, j)).collect()
    }

    fn axes(&self, place: &str) -> Vec<usize> {
        let axis = ["-x", "-y", "-z"].map(|end| format!("{place}{end}"));
        let own = |name: &String| name == place || axis.contains(name);
        (0..self.sites.len())
            .filter(|i| own(&self.sites[*i]))
            .collect()
    }

    /// The difference of two unknowns, each in units of its spread before anything was measured.
    fn difference(&self, i: usize, j: usize) -> DVector<f64> {
        let mut direction = DVector::zeros(self.sites.len());
        direction[i] = 1.0 / self.prior[i];
        direction[j] = -1.0 / self.prior[j];
        direction
    }
}
