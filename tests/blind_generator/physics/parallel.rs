//! Friction elements in parallel with a spring, driven by the load: the load is given, so the common
//! deflection is found by Newton in every step.

/// One friction element's law between two deflections.
#[derive(Clone, Copy)]
pub enum Slider {
    /// Elastic until it slips at its threshold (Jenkins, 1962).
    Jenkins,
    /// df/dx = k (1 - f sgn(dx) / c), integrated exactly over the step (Dahl, 1968).
    Dahl,
}

/// A friction element: stiffness, threshold and its present force.
pub struct Element {
    pub stiffness: f64,
    pub threshold: f64,
    pub force: f64,
}

impl Element {
    /// Force and tangent after moving by `dx`.
    fn after(&self, dx: f64, slider: Slider) -> (f64, f64) {
        match slider {
            Slider::Jenkins => {
                let force = self.force + self.stiffness * dx;
                if force.abs() < self.threshold {
                    (force, self.stiffness)
                } else {
                    (self.threshold.copysign(force), 0.0)
                }
            }
            Slider::Dahl => {
                let limit = self.threshold.copysign(dx);
                let decay = (-self.stiffness * dx.abs() / self.threshold).exp();
                let force = limit + (self.force - limit) * decay;
                let tangent = self.stiffness * (1.0 - force / limit);
                (force, tangent)
            }
        }
    }
}

/// The common deflection under a load history: u = spring x + sum of the elements' forces.
pub fn deflection(load: &[f64], spring: f64, elements: &mut [Element], slider: Slider) -> Vec<f64> {
    let mut x = 0.0;
    let mut last = 0.0;
    load.iter()
        .map(|&u| {
            if u != last {
                x += solve(u, x, u - last, spring, elements, slider);
                last = u;
            }
            x
        })
        .collect()
}

/// Newton for the step in deflection that balances the load; the elements move along.
fn solve(u: f64, x: f64, du: f64, spring: f64, elements: &mut [Element], slider: Slider) -> f64 {
    let total: f64 = spring + elements.iter().map(|e| e.stiffness).sum::<f64>();
    let mut dx = du / total;
    for _ in 0..40 {
        let (mut force, mut tangent) = (spring * (x + dx), spring);
        for element in elements.iter() {
            let (f, k) = element.after(dx, slider);
            force += f;
            tangent += k;
        }
        let step = (u - force) / tangent;
        dx += step;
        if step.abs() < 1e-13 {
            break;
        }
    }
    for element in elements.iter_mut() {
        element.force = element.after(dx, slider).0;
    }
    dx
}
