//! From one load-cycle file to its stiffness account.

use super::bootstrap;
use super::derived::derived;
use super::imposed::{self, fit_imposed, is_imposed};
use super::law_error;
use super::observation::{MOST_ROWS, Observation};
use super::other_law::weigh_gap;
use super::parameter::{Identified, Status, Z95};
use super::solution::Solution;
use super::supported::{simpler, unsaid};
use super::time_course::fit_beside;
use crate::effects::{Composite, EFFECTS, shapes};
use crate::experiments::load_cycle::{enclosed, settled_cycle, straight_line};
use crate::fit::candidates::Candidates;
use crate::fit::screen::screen;
use crate::fit::second::log_ratio;
use crate::fit::suitability::load_cycle::doubts;
use crate::fit::suitability::{Doubt, is_fatal, is_odd};
use crate::ground::stats::mean;
use crate::measurement::load_cycle::{LEVER_REL_STD, LoadCycle};

/// What is identified when nothing else is asked for.
pub const DEFAULT_EFFECTS: &[&str] = &["backlash", "hysteresis"];

/// How to identify.
pub struct Request {
    /// The model.
    pub model: Composite,
    /// Number of bootstrap draws; 0: intervals by linearisation.
    pub bootstrap: usize,
    /// Seed of the bootstrap.
    pub seed: u64,
}

/// The identified joint.
pub struct Account {
    /// Reduced data.
    pub data: Observation,
    /// The fit.
    pub solution: Solution,
    /// All parameters: fitted first, then what follows from them.
    pub parameters: Vec<Identified>,
    /// One settled cycle of the model at full load: load and deflection. `None` for a test under
    /// imposed displacement.
    pub branches: Option<(Vec<f64>, Vec<f64>)>,
    /// Whether the displacement was imposed: `data` then holds it as the load, and predicts force.
    pub imposed: bool,
    /// Measured loss of each cycle by numerical integration, J.
    pub losses: Vec<f64>,
    /// Noise of the readings, independent of the model, in the deflection's unit.
    pub noise_rms: f64,
    /// Noise in words.
    pub noise: String,
    /// Straight-line stiffness.
    pub straight: f64,
    /// Logarithm of the second sensor's deflection over the first's; its standard error.
    pub second: Option<(f64, f64)>,
    /// Effects over time that are no part of the joint and were taken off the readings.
    pub courses: Vec<&'static str>,
    /// The cause that does as well as a gap, or better; none is told then.
    pub rival: Option<&'static str>,
    /// What needs attention, one sentence each.
    pub warnings: Vec<String>,
    /// What is odd about the data.
    pub doubts: Vec<Doubt>,
}

/// A ratio above this says no more than "far".
const FAR_BEYOND: f64 = 1e4;

/// A model that leaves so many times the noise is another curve.
const MISSED: f64 = 1.5;

/// Share of the deflection that a straight line may miss before it counts as no description.
const NOT_STRAIGHT: f64 = 0.08;

/// Identifies one file: a joint that was pressed, or one that was moved.
pub fn identify(file: &LoadCycle, request: &Request) -> Account {
    let mut account = match is_imposed(file) {
        true => moved(file),
        false => pressed(file, request),
    };
    account.take_levers(file);
    account.doubts = doubts(file);
    if is_fatal(&account.doubts) {
        account.withhold();
    } else {
        account.warnings = warnings(&account, file);
    }
    let said = account.doubts.iter().map(Doubt::sentence);
    account.warnings.splice(0..0, said);
    account
}

impl Account {
    /// Widens what stands over both levers by what is known of them.
    fn take_levers(&mut self, file: &LoadCycle) {
        let spread = file.facts.lever_spread();
        let widened = |p: &Identified| match p.unit == file.port.stiffness_unit() && spread > 0.0 {
            true => p.clone().with_levers(spread),
            false => p.clone(),
        };
        self.parameters = self.parameters.iter().map(widened).collect();
    }

    /// Takes back every number: the data cannot carry one.
    fn withhold(&mut self) {
        let none = |p: &Identified| p.clone().without_value(Status::NotIdentifiable);
        self.parameters = self.parameters.iter().map(none).collect();
        self.parameters.iter_mut().for_each(|p| p.limit95 = None);
        self.branches = None;
        self.straight = f64::NAN;
        self.second = None;
        self.losses.clear();
    }

    /// Whether a stiffness is supported and nothing is odd about the data.
    pub fn is_fine(&self) -> bool {
        self.parameters[0].status == Status::Identified && !is_odd(&self.doubts)
    }
}

/// The account of a test under imposed displacement.
fn moved(file: &LoadCycle) -> Account {
    let fitted = fit_imposed(file);
    Account {
        parameters: fitted.parameters(file),
        branches: None,
        imposed: true,
        losses: imposed::losses(&fitted.data).iter().map(|l| l.0).collect(),
        noise_rms: crate::signal::smooth::noise(&file.load),
        noise: "from fourth differences".into(),
        straight: straight_line(&file.load, &file.deflection),
        second: None,
        courses: Vec::new(),
        rival: None,
        warnings: Vec::new(),
        doubts: Vec::new(),
        data: fitted.data,
        solution: fitted.solution,
    }
}

/// The account of a test under imposed load.
fn pressed(file: &LoadCycle, request: &Request) -> Account {
    let mut data = Observation::of(file, MOST_ROWS);
    let (mut solution, courses) = fit_beside(&request.model, &mut data);
    let gap = weigh_gap(&mut solution, &data);
    if solution.status[0] != Status::Identified
        && let Some(simpler) = simpler(&solution, &data)
    {
        solution = simpler;
    }
    let candidates = Candidates::new(&shapes(EFFECTS), &data);
    let noise = screen(&data, &candidates);
    law_error::widen(&mut solution, &data, &noise);
    law_error::widen_by_flanks(&mut solution, &data);
    let (low, high) = data.load_range();
    let branches = settled_cycle(&solution.model, &solution.p, &data.scene, low, high);
    let site = file.site();
    let mut parameters = solution.parameters(&site, file.port);
    if request.bootstrap > 0 {
        let intervals = bootstrap::intervals(&solution, &data, request.bootstrap, request.seed);
        widen(&mut parameters, &intervals, &mut solution);
    }
    parameters.extend(unsaid(&request.model, &solution.model, &site, file.port));
    for own in parameters
        .iter_mut()
        .filter(|p| p.name == "gap" && p.value.is_none())
    {
        own.limit95 = own.limit95.or(gap.as_ref().and_then(|gap| gap.limit));
    }
    rename(&mut parameters);
    let fits = solution.rms <= MISSED * noise.rms;
    parameters.extend(derived(&solution, &data, file, fits));
    let straight = straight_line(&file.load, &file.deflection);
    let second = log_ratio(file);
    Account {
        noise_rms: noise.rms,
        noise: noise.describe(),
        losses: measured_losses(&data),
        data,
        solution,
        parameters,
        branches: Some(branches),
        imposed: false,
        straight,
        second,
        courses,
        rival: gap.and_then(|gap| gap.rival),
        warnings: Vec::new(),
        doubts: Vec::new(),
    }
}

fn widen(parameters: &mut [Identified], intervals: &[[f64; 2]], solution: &mut Solution) {
    let slots = solution.model.slots();
    for (j, (parameter, interval)) in parameters.iter_mut().zip(intervals).enumerate() {
        if parameter.status != Status::Identified {
            continue;
        }
        let stderr = (interval[1] - interval[0]) / (2.0 * Z95);
        parameter.ci95 = Some(*interval);
        parameter.stderr = Some(stderr);
        solution.covariance[(j, j)] = stderr * stderr;
        if slots[j].may_vanish() && parameter.may_be_zero() {
            *parameter = parameter
                .clone()
                .limited(Status::NotIdentifiable, interval[1]);
        }
    }
}

/// The field's name for the gap of a joint is its backlash.
fn rename(parameters: &mut [Identified]) {
    for parameter in parameters.iter_mut().filter(|p| p.name == "gap") {
        parameter.name = "backlash".into();
    }
}

fn warnings(account: &Account, file: &LoadCycle) -> Vec<String> {
    let mut said = Vec::new();
    if account.imposed {
        said.push(
            "the displacement was imposed and the force saturates: fitted as clearance, stuck spring and dry slider; \
             one linear stiffness does not describe this curve"
                .into(),
        );
        return said;
    }
    let scale = account.data.scene.deflection_scale;
    let line: f64 = {
        let k = account.straight;
        let (ml, md) = (mean(&file.load), mean(&file.deflection));
        let square = |(l, d): (&f64, &f64)| (d - md - (l - ml) / k).powi(2);
        (file
            .load
            .iter()
            .zip(&file.deflection)
            .map(square)
            .sum::<f64>()
            / file.load.len() as f64)
            .sqrt()
    };
    if line > NOT_STRAIGHT * scale && line > 3.0 * account.noise_rms {
        said.push(format!(
            "one linear stiffness does not describe this curve: a straight line misses it by {:.0} % of its deflection",
            100.0 * line / scale
        ));
    }
    if !account.courses.is_empty() {
        said.push(format!(
            "beside the joint the record holds what follows the time, not the load, and was taken off: {} \
             (`ident diagnose {}` weighs it)",
            account.courses.join(", "),
            file.path.display()
        ));
    }
    if let Some(rival) = account.rival {
        said.push(format!(
            "{rival} explains these data as well as a gap, or better: no gap is told (`ident diagnose {}` weighs both)",
            file.path.display()
        ));
    }
    if account.solution.rms > MISSED * account.noise_rms {
        let times = account.solution.rms / account.noise_rms;
        said.push(format!(
            "the model misses the readings by {} their noise: `ident diagnose {}` names the cause",
            match times < FAR_BEYOND {
                true => format!("{times:.1} times"),
                false => "far more than".into(),
            },
            file.path.display()
        ));
    }
    if let Some((excess, stderr)) = account.second {
        let stated = file.facts.lever_rel_std.unwrap_or(LEVER_REL_STD) * std::f64::consts::SQRT_2;
        if excess.abs() > 3.0 * (stated * stated + stderr * stderr).sqrt() {
            said.push(format!(
                "the two sensors disagree by {:+.1} %: a lever or an inclined laser is wrong (`ident diagnose`)",
                100.0 * excess
            ));
        }
    }
    if account.parameters[0].status != Status::Identified {
        said.push("these data do not support a stiffness".into());
    }
    said
}

/// Measured loss of each cycle by numerical integration, J.
fn measured_losses(data: &Observation) -> Vec<f64> {
    let starts = &data.cycles.starts;
    let ends = starts.iter().skip(1).copied().chain([data.rows()]);
    starts
        .iter()
        .zip(ends)
        .map(|(a, b)| enclosed(&data.scene.load[*a..b], &data.reading[*a..b]))
        .collect()
}
