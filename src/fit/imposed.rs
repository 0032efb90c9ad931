//! Tests that move instead of press: force over an imposed displacement.
//!
//! A friction damper slips at constant force, so its displacement is no function of its load
//! history. The ports are swapped: the observation's "load" is the displacement, its reading the
//! force, and the law a clearance in series with a stuck spring and a dry slider.

use super::least_squares::{Problem, minimise};
use super::observation::{MOST_ROWS, Observation, reduce};
use super::parameter::{Identified, Status};
use super::solution::{Solution, conclude_with, noise_of};
use super::starts::starts;
use super::suitability::agreement::slope;
use super::suitability::relation::{Relation, halved, ramps};
use crate::effects::{CLEARANCE_SLIDER, Composite, Effect, named};
use crate::experiments::load_cycle::enclosed;
use crate::ground::stats::ends;
use crate::inference::descent::Stop;
use crate::measurement::cycles::Cycles;
use crate::measurement::load_cycle::LoadCycle;
use crate::signal::colour::Colour;

/// Share of the deflection's variance that a straight line must explain for a test to count as
/// pressed; below, the load hardly sets the deflection.
const PRESSED: f64 = 0.75;

/// Whether the displacement was imposed: the load saturates while the deflection goes on.
pub fn is_imposed(file: &LoadCycle) -> bool {
    let n = file.load.len() as f64;
    let mean = |v: &[f64]| v.iter().sum::<f64>() / n;
    let (ml, md) = (mean(&file.load), mean(&file.deflection));
    let (mut ll, mut dd, mut ld) = (0.0, 0.0, 0.0);
    for (l, d) in file.load.iter().zip(&file.deflection) {
        ll += (l - ml).powi(2);
        dd += (d - md).powi(2);
        ld += (l - ml) * (d - md);
    }
    let pressed = ld * ld >= PRESSED * ll * dd || is_one_sided(&file.load);
    ll > 0.0
        && dd > 0.0
        && !pressed
        && enclosed(&file.load, &file.deflection) > 0.0
        && saturates(&file.deflection, &file.load)
}

/// Least share of a force's larger extreme that its smaller one, of the other sign, reaches where a contact slips both
/// ways.
const OTHER_SIDE: f64 = 0.1;

/// Whether the load keeps its sign. A contact that slips answers a reversed motion with a reversed force.
fn is_one_sided(load: &[f64]) -> bool {
    let (low, high) = ends(load);
    (-low).min(high) < OTHER_SIDE * (-low).max(high)
}

/// Share of the slope at the beginning of a stroke that may be left on its second half.
const SATURATED: f64 = 0.5;
/// Share of the strokes that must saturate.
const MOST_STROKES: f64 = 0.7;

/// Evidence of its own for an imposed displacement: the force answers the displacement stroke by
/// stroke beyond chance, and rises on the first half of a stroke far more than on the second.
fn saturates(displacement: &[f64], force: &[f64]) -> bool {
    if !Relation::of(displacement, force).is_real() {
        return false;
    }
    let strokes = ramps(displacement);
    let flat = |stroke: &&(usize, usize)| {
        let halves = halved(**stroke, displacement);
        let slopes: Vec<f64> = halves
            .iter()
            .map(|h| slope(*h, displacement, force).0)
            .collect();
        matches!(slopes[..], [first, second] if first > 0.0 && second < SATURATED * first)
    };
    strokes.iter().filter(flat).count() as f64 > MOST_STROKES * strokes.len() as f64
}

/// The fit of a test under imposed displacement.
pub struct Imposed {
    /// Displacement as the scene's load, force as the reading.
    pub data: Observation,
    /// Clearance, stuck spring and slider.
    pub solution: Solution,
}

/// Displacement and force of a file, ports swapped.
pub fn observe(file: &LoadCycle, most: usize) -> Observation {
    // the slider's state is known only where the motion has turned under slip
    let from = Cycles::find(&file.deflection)
        .turning
        .first()
        .copied()
        .unwrap_or(0);
    let block = (file.load.len() - from).div_ceil(most).max(1);
    let part = |v: &[f64]| reduce(&v[from..], block);
    Observation::from_channels(
        part(&file.time),
        part(&file.deflection),
        part(&file.load),
        block,
    )
}

/// Fits clearance, stuck spring and slider.
pub fn fit_imposed(file: &LoadCycle) -> Imposed {
    let data = observe(file, MOST_ROWS);
    let solution = solve(&[CLEARANCE_SLIDER], &data);
    Imposed { data, solution }
}

/// Fits laws of imposed displacement beside an offset of the force.
///
/// The laws' own error is far above the noise: plain least squares from every curve finds the
/// optimum, then the residual's colour widens the intervals about it.
pub fn solve(effects: &[&'static dyn Effect], data: &Observation) -> Solution {
    let all: Vec<&'static dyn Effect> = effects
        .iter()
        .copied()
        .chain(named("sensor_offset"))
        .collect();
    let model = Composite::new(&all);
    let ignored = vec![false; data.rows()];
    let white = Colour::white(data.rows(), data.scene.deflection_scale * 0.1);
    let problem = Problem {
        model: &model,
        data,
        colour: &white,
        ignored: &ignored,
    };
    let fits = starts(&model, data, STARTS)
        .into_iter()
        .map(|s| minimise(&problem, &s, Stop::default()));
    let best = fits.min_by(|a, b| a.chi2.total_cmp(&b.chi2));
    let start = best.map_or_else(|| model.start(&data.scene), |b| b.p);
    let optimum = minimise(&problem, &start, Stop::default());
    let colour = noise_of(&problem, &optimum);
    conclude_with(&problem, optimum, colour)
}

/// Starting points of the search.
const STARTS: usize = 12;

/// Loss of each full cycle by numerical integration, J, with the cycle's displacement range.
pub fn losses(data: &Observation) -> Vec<(f64, f64)> {
    let starts = &data.cycles.starts;
    let pairs = starts.windows(2).map(|w| (w[0], w[1]));
    pairs
        .map(|(a, b)| {
            let (x, force) = (&data.scene.load[a..b], &data.reading[a..b]);
            let (low, high) = ends(x);
            (enclosed(force, x), high - low)
        })
        .collect()
}

impl Imposed {
    /// What was identified: stuck stiffness, clearance, friction, loss at the largest amplitude.
    pub fn parameters(&self, file: &LoadCycle) -> Vec<Identified> {
        let site = file.site();
        let at = |name: &str| {
            self.solution
                .model
                .slots()
                .iter()
                .position(|s| s.parameter.name == name)
        };
        let value = |name: &str| {
            at(name).map_or((f64::NAN, f64::NAN), |j| {
                (self.solution.p[j], self.solution.stderr(j))
            })
        };
        let ((force, force_error), (stick, stick_error), (gap, gap_error)) =
            (value("friction"), value("stick"), value("gap"));
        let stuck = force / stick;
        let relative = ((force_error / force).powi(2) + (stick_error / stick).powi(2)).sqrt();
        let port = file.port;
        let mut list = vec![
            known(
                "stiffness",
                &site,
                stuck,
                port.stiffness_unit(),
                stuck * relative,
                "slope of the stuck branch, from contact to slip",
            ),
            known(
                "backlash",
                &site,
                gap,
                port.deflection_unit(),
                gap_error,
                "clearance crossed without force after each reversal",
            ),
            known(
                "friction",
                &site,
                force,
                port.load_unit(),
                force_error,
                "force at which the contact slips",
            ),
        ];
        list.push(self.loss(&site));
        list
    }

    /// Mean measured loss of the cycles of the largest amplitude.
    fn loss(&self, site: &str) -> Identified {
        let all = losses(&self.data);
        let largest = all.iter().fold(0.0_f64, |m, l| m.max(l.1));
        let full: Vec<f64> = all
            .iter()
            .filter(|l| l.1 > 0.95 * largest)
            .map(|l| l.0)
            .collect();
        let n = full.len() as f64;
        let mean = full.iter().sum::<f64>() / n;
        let spread =
            (full.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0) / n).sqrt();
        let meaning = "work lost per cycle at the largest amplitude, integrated from the readings";
        known(
            "hysteresis_loss",
            site,
            mean,
            "J",
            if n > 1.0 { spread } else { 0.05 * mean },
            meaning,
        )
    }
}

fn known(name: &str, site: &str, value: f64, unit: &str, stderr: f64, meaning: &str) -> Identified {
    let parameter = Identified::new(name, site, value, unit, stderr, meaning);
    let supported = value.is_finite() && stderr.is_finite() && stderr < 0.5 * value.abs();
    if supported {
        parameter
    } else {
        parameter.without_value(Status::NotIdentifiable)
    }
}
