//! Whether the FRF depends on the force of the hit: play and friction do that, a linear robot does not.

use super::data::Grid;
use crate::experiments::hammer_frf::{HammerFrf, InputFrf};
use crate::ground::random::Random;
use crate::motion::frf::C64;

/// Random exchanges of the levels.
const EXCHANGES: usize = 999;
/// Largest probability of chance that is believed, least share of the scatter that the level must
/// explain, least change of the FRF from soft to hard.
const CHANCE: f64 = 0.01;
const SHARE: f64 = 0.6;
const CHANGE: f64 = 0.02;

/// What the level of the hits does to the FRF.
#[derive(Debug, Clone, PartialEq)]
pub struct Linearity {
    /// Probability that exchanged levels explain as much.
    pub p_value: f64,
    /// Share of the scatter of the hits that a straight line over ln(level) explains.
    pub share: f64,
    /// Relative change of the FRF over the range of levels.
    pub change: f64,
    /// Factor from the softest to the hardest hit.
    pub range: f64,
    /// Direction in which the change is largest.
    pub direction: String,
}

impl Linearity {
    /// Whether the FRF depends on the force.
    pub fn broken(&self) -> bool {
        self.p_value <= CHANCE && self.share > SHARE && self.change > CHANGE
    }

    /// What is seen, in words.
    pub fn description(&self) -> String {
        format!(
            "an FRF that changes with the force: by {:.0} % from the softest to the hardest hit ({:.1} times the force), most along {}: play, friction or a stiffness that depends on the amplitude. What would tell: three levels of ten hits each, and load cycles of the axes that swing there",
            100.0 * self.change,
            self.range,
            self.direction
        )
    }
}

/// One direction: how the FRFs of its hits deviate from their mean, and the levels from theirs.
struct Family {
    input: String,
    levels: Vec<f64>,
    /// Inner products of the hits' deviations, relative to the size of the mean.
    products: Vec<Vec<f64>>,
}

/// Tests the hits of all directions together; none where no direction has three hits of different level.
pub fn linearity(frf: &HammerFrf, grid: Grid) -> Option<Linearity> {
    let families: Vec<Family> = frf
        .inputs
        .iter()
        .filter_map(|i| family(frf, i, grid))
        .collect();
    if families.is_empty() {
        return None;
    }
    let explained = |orders: &[Vec<usize>]| -> f64 {
        families
            .iter()
            .zip(orders)
            .map(|(f, order)| f.along(order))
            .sum()
    };
    let mut orders: Vec<Vec<usize>> = families
        .iter()
        .map(|f| (0..f.levels.len()).collect())
        .collect();
    let own = explained(&orders);
    let mut random = Random::new(5);
    let mut as_good = 0;
    for _ in 0..EXCHANGES {
        orders
            .iter_mut()
            .for_each(|order| shuffle(order, &mut random));
        as_good += usize::from(explained(&orders) >= own * (1.0 - 1e-9));
    }
    let total: f64 = families.iter().map(Family::total).sum();
    let largest = families
        .iter()
        .max_by(|a, b| a.change().total_cmp(&b.change()))?;
    Some(Linearity {
        p_value: (as_good + 1) as f64 / (EXCHANGES + 1) as f64,
        share: own / total.max(f64::MIN_POSITIVE),
        change: largest.change(),
        range: largest.range().exp(),
        direction: largest.input.clone(),
    })
}

fn shuffle(order: &mut [usize], random: &mut Random) {
    for i in (1..order.len()).rev() {
        order.swap(i, random.below(i + 1));
    }
}

fn family(frf: &HammerFrf, input: &InputFrf, grid: Grid) -> Option<Family> {
    let inside = |k: &usize| (grid.from_hz..=grid.to_hz).contains(&frf.frequency_hz[*k]);
    let lines: Vec<usize> = (1..frf.frequency_hz.len()).filter(inside).collect();
    let level = |hit: &crate::signal::frf::HitSpectra| {
        let power: f64 = lines.iter().take(8).map(|k| hit.force[*k].norm_sqr()).sum();
        0.5 * power.ln()
    };
    let levels: Vec<f64> = input.hits.iter().map(level).collect();
    let mean = levels.iter().sum::<f64>() / levels.len() as f64;
    let levels: Vec<f64> = levels.iter().map(|l| l - mean).collect();
    let spread = levels.iter().map(|l| l * l).sum::<f64>();
    if levels.len() < 3 || spread < 0.02 {
        return None;
    }
    let row = |hit: &crate::signal::frf::HitSpectra| -> Vec<C64> {
        let outputs = 0..hit.responses.len();
        let all = outputs.flat_map(|o| lines.iter().map(move |k| (o, *k)));
        all.map(|(o, k)| hit.responses[o][k] / hit.force[k])
            .collect()
    };
    let rows: Vec<Vec<C64>> = input.hits.iter().map(row).collect();
    let count = rows.len() as f64;
    let mean: Vec<C64> = (0..rows[0].len())
        .map(|i| rows.iter().map(|r| r[i]).sum::<C64>() / count)
        .collect();
    let size: f64 = mean.iter().map(|h| h.norm_sqr()).sum();
    let product = |a: &Vec<C64>, b: &Vec<C64>| -> f64 {
        let each = a.iter().zip(b).zip(&mean);
        each.map(|((a, b), m)| ((a - m) * (b - m).conj()).re)
            .sum::<f64>()
            / size
    };
    let products = rows
        .iter()
        .map(|a| rows.iter().map(|b| product(a, b)).collect());
    Some(Family {
        input: input.input.clone(),
        levels,
        products: products.collect(),
    })
}

impl Family {
    /// Squared size of the slope over the levels taken in `order`, times their spread.
    fn along(&self, order: &[usize]) -> f64 {
        let mut sum = 0.0;
        for (i, a) in order.iter().enumerate() {
            for (j, b) in order.iter().enumerate() {
                sum += self.levels[*a] * self.levels[*b] * self.products[i][j];
            }
        }
        sum / self.spread()
    }

    fn spread(&self) -> f64 {
        self.levels.iter().map(|l| l * l).sum()
    }

    /// Scatter of the hits.
    fn total(&self) -> f64 {
        (0..self.products.len()).map(|i| self.products[i][i]).sum()
    }

    fn range(&self) -> f64 {
        let top = self
            .levels
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max);
        top - self.levels.iter().copied().fold(f64::INFINITY, f64::min)
    }

    fn change(&self) -> f64 {
        let order: Vec<usize> = (0..self.levels.len()).collect();
        (self.along(&order) / self.spread()).sqrt() * self.range()
    }
}
