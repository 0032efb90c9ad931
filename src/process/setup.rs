//! A job made ready to be milled: the planned motion, the tool in its stock, the robot.

use super::pose::Carrier;
use super::rigid::Rigid;
use super::run::{Outcome as Milled, Settings, mill};
use super::springs::Springs;
use super::structure::Structure;
use super::swinging::Swinging;
use super::way::{Row, Way};
use crate::cutting::cutter::{Cutter, Fineness};
use crate::cutting::dexel::Stock;
use crate::cutting::{Material, Tool};
use crate::ground::files::read_bytes;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{M3, rotate};
use crate::measurement::job::{self, Job};
use crate::measurement::stl;
use crate::motion::elastic;
use crate::planning::Plan;
use crate::robot::Robot;
use std::f64::consts::TAU;

/// What carries the tool.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Support {
    /// Nothing gives way.
    Rigid,
    /// Springs only.
    Static,
    /// Robot and cut coupled in time.
    Coupled,
}

impl Support {
    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rigid => "rigid",
            Self::Static => "static",
            Self::Coupled => "coupled",
        }
    }
}

/// Everything that a run needs.
#[derive(Debug, Clone)]
pub struct Setup {
    /// The programmed motion.
    pub way: Way,
    /// The tool.
    pub tool: Tool,
    /// What is cut.
    pub material: Material,
    /// The stock before the first cut.
    pub stock: Stock,
    /// How finely the cut is resolved.
    pub fineness: Fineness,
    /// Speed of the spindle, rad/s.
    pub spindle_rad_s: f64,
    /// The robot.
    pub robot: Robot,
    /// Axes of the workpiece as columns, base frame.
    pub workpiece: M3,
}

/// Most and fewest steps per tooth passing.
const STEPS: [usize; 2] = [12, 20_000];

/// Share of the distance of the rays that the tool may go before it is looked again what it stands in, where a run is coarse. A
/// choice for time: a third of the looks on usual feeds changes force and volume along a wall and a corner by less than three
/// thousandths (`cutting/cutter/motion`).
const PATIENCE: f64 = 0.25;

impl Setup {
    /// A planned job. `spindle_rad_s` is the path's own speed, used where the job states none;
    /// `step_s` the step of time, if it is not to be chosen.
    ///
    /// # Errors
    /// A job without tool, material, stock or speed, with what to add.
    pub fn of(
        job: &Job,
        plan: &Plan,
        spindle_rad_s: Option<f64>,
        step_s: Option<f64>,
    ) -> Outcome<Self> {
        Self::of_parts(job, plan, spindle_rad_s, step_s).map_err(|p| p.in_file(&job.path))
    }

    fn of_parts(
        job: &Job,
        plan: &Plan,
        spindle_rad_s: Option<f64>,
        step_s: Option<f64>,
    ) -> Outcome<Self> {
        let cutter = job.cutter.ok_or_else(|| {
            missing(
                "[tool]",
                "add [tool] with diameter_mm, teeth, flute_mm and spindle_rpm",
            )
        })?;
        let spindle_rad_s = cutter
            .spindle
            .or(spindle_rad_s)
            .ok_or_else(|| missing("the speed of the spindle", "add spindle_rpm to [tool]"))?;
        let tool = tool(&cutter)?;
        if spindle_rad_s <= 0.0 {
            return Err(Problem::new(
                "the spindle turns to the left (M4): teeth would cut with their backs",
                "write a positive spindle_rpm",
            ));
        }
        let fineness = fineness(&tool, spindle_rad_s, step_s)?;
        Ok(Self {
            way: way(plan)?,
            material: material(job)?,
            stock: stock(job, fineness.spacing_m)?,
            tool,
            fineness,
            spindle_rad_s,
            robot: plan.cell.robot.clone(),
            workpiece: plan.cell.workpiece.rotation,
        })
    }

    /// The same job with the cut resolved `times` more coarsely, as far as the passing of a tooth is still resolved: for
    /// runs of which the difference or the direction is asked.
    pub fn coarser(&self, times: f64) -> Self {
        let Fineness {
            spacing_m, steps, ..
        } = self.fineness;
        let now = steps / self.tool.teeth;
        let per_tooth = (now as f64 / times).ceil() as usize;
        Self {
            stock: self.stock.coarser(times),
            fineness: Fineness {
                spacing_m: times * spacing_m,
                steps: per_tooth.max(STEPS[0].min(now)) * self.tool.teeth,
                patience_m: PATIENCE * times * spacing_m,
            },
            ..self.clone()
        }
    }

    /// The same job in so many steps per tooth, or fewer where it has fewer.
    #[must_use]
    pub fn with_steps(mut self, per_tooth: usize) -> Self {
        let most = per_tooth * self.tool.teeth;
        self.fineness.steps = self.fineness.steps.min(most);
        self
    }

    /// The tool beside its stock.
    pub fn cutter(&self) -> Cutter {
        let axis = self.way.rows()[0].axis;
        Cutter::new(
            &self.tool,
            &self.material,
            self.stock.clone(),
            self.fineness,
            axis,
        )
    }

    /// What carries the tool.
    ///
    /// # Errors
    /// A robot in which nothing is elastic.
    pub fn structure(&self, support: Support) -> Outcome<Box<dyn Structure>> {
        Ok(match support {
            Support::Rigid => Box::new(Rigid),
            Support::Static => Box::new(self.springs()?),
            Support::Coupled => Box::new(Swinging::new(
                self.carrier(),
                &self.way.at(self.way.span()[0]),
                self.spindle_rad_s,
                self.fineness.steps,
            )?),
        })
    }

    /// The elastic robot, seen from the workpiece.
    pub fn carrier(&self) -> Carrier {
        Carrier::new(elastic(&self.robot), self.workpiece)
    }

    /// The robot as springs at the tool.
    ///
    /// # Errors
    /// A robot in which nothing is elastic.
    pub fn springs(&self) -> Outcome<Springs> {
        Springs::new(self.carrier(), &self.way.at(self.way.span()[0]))
    }

    /// Mills the part; the cutter keeps what is left of the stock.
    ///
    /// # Errors
    /// As [`mill`].
    pub fn run(&self, support: Support, progress: impl FnMut(f64)) -> Outcome<(Milled, Cutter)> {
        let mut cutter = self.cutter();
        let mut structure = self.structure(support)?;
        let settings = Settings {
            spindle_rad_s: self.spindle_rad_s,
        };
        let out = mill(
            &self.way,
            &mut cutter,
            structure.as_mut(),
            &settings,
            progress,
        )?;
        Ok((out, cutter))
    }
}

fn missing(what: &str, remedy: &str) -> Problem {
    Problem::new(format!("{what} is missing: milling needs it"), remedy)
}

fn tool(cutter: &job::Cutter) -> Outcome<Tool> {
    let tool = Tool {
        radius_m: 0.5 * cutter.diameter,
        teeth: cutter.teeth,
        helix_rad: cutter.helix,
        corner_radius_m: cutter.corner_radius,
        flute_m: cutter.flute.unwrap_or(f64::INFINITY),
        runout_m: cutter.runout,
        runout_angle_rad: cutter.runout_angle,
    };
    match tool.is_possible() {
        true => Ok(tool),
        false => Err(Problem::new(
            "[tool] states a tool that the force model does not know",
            "give a right-handed helix below 90 degrees and at least one tooth",
        )),
    }
}

fn fineness(tool: &Tool, spindle_rad_s: f64, step_s: Option<f64>) -> Outcome<Fineness> {
    let usual = Fineness::usual(tool);
    let Some(step_s) = step_s else {
        return Ok(usual);
    };
    let per_tooth = (TAU / (spindle_rad_s * tool.teeth as f64 * step_s)).round();
    let [least, most] = STEPS.map(|s| s as f64);
    if !(least..=most).contains(&per_tooth) {
        let longest = 1e6 * TAU / (spindle_rad_s * tool.teeth as f64 * least);
        return Err(Problem::new(
            "the step does not resolve the passing of a tooth, or is finer than sense",
            format!("give `--step-us` at most {longest:.1}, or leave it out"),
        ));
    }
    Ok(Fineness {
        steps: per_tooth as usize * tool.teeth,
        ..usual
    })
}

fn material(job: &Job) -> Outcome<Material> {
    let material = job.material.as_ref().ok_or_else(|| {
        missing(
            "[material]",
            "add [material], or `material = \"fits/<campaign>/...toml\"`",
        )
    })?;
    Ok(Material::of(material.law, &material.coefficients))
}

fn stock(job: &Job, spacing: f64) -> Outcome<Stock> {
    match &job.workpiece.stock {
        None => Err(missing(
            "the stock",
            "add stock_min_mm and stock_max_mm to [workpiece]",
        )),
        Some(job::Stock::Box { min, max }) => Stock::block(*min, *max, spacing),
        Some(job::Stock::Stl(file)) => {
            job.expect_file("stock", file)?;
            let triangles = stl::triangles(&read_bytes(file)?).map_err(|p| p.in_file(file))?;
            Stock::within(&triangles, spacing).map_err(|p| p.in_file(file))
        }
    }
}

fn way(plan: &Plan) -> Outcome<Way> {
    let rows = plan.rows.iter().map(|row| Row {
        time_s: row.t,
        s_m: row.s,
        tip: row.point,
        axis: rotate(&row.orientation.matrix(), plan.cell.spindle),
        joints: row.q.to_vec(),
    });
    Way::new(rows.collect()).ok_or_else(|| missing("a motion", "give a path with two points"))
}
