//! `ident robot map`: how stiff the robot is at its tool over a plane of its workspace.

use super::report::{angles, results};
use crate::cli::Ending;
use crate::cli::output::{print, print_result};
use crate::experiments::stiffness_map::{Asked, Cell, StiffnessMap, map};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::DEGREE;
use crate::report::folder::write_as;
use crate::report::json::{number, numbers};
use crate::robot::load::{Loaded, load};
use crate::sheet::number::{fixed, significant};
use crate::sheet::page::{Block, Page};
use crate::sheet::table::Table;
use clap::{Args, ValueEnum};
use serde_json::{Value, json};
use std::path::Path;

/// Arguments of `ident robot map`.
#[derive(Debug, Args)]
pub struct Map {
    /// Built-in name (kr210, kr300) or a robot file, TOML or URDF
    robot: String,
    /// Joint angles in degrees, A1 first: the tool keeps this orientation and the arm this posture, and the
    /// plane goes through this place of the tool
    #[arg(
        long,
        value_name = "Q1,..,Q6",
        value_delimiter = ',',
        allow_hyphen_values = true,
        required = true
    )]
    joints_deg: Vec<f64>,
    /// The plane of the map, by axes of the base
    #[arg(long, value_enum, default_value_t = Plane::Xz)]
    plane: Plane,
    /// Side of a cell
    #[arg(long = "step-mm", value_name = "MM", default_value_t = 50.0)]
    step_mm: f64,
    /// Print one JSON document instead of text
    #[arg(long)]
    json: bool,
    /// Write no report
    #[arg(long)]
    dry_run: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Plane {
    Xy,
    Xz,
    Yz,
}

impl Plane {
    fn axes(self) -> [usize; 2] {
        match self {
            Self::Xy => [0, 1],
            Self::Xz => [0, 2],
            Self::Yz => [1, 2],
        }
    }
}

const NEWTON_PER_MICROMETRE: f64 = 1e-6;

impl Map {
    /// Runs it.
    pub fn run(&self) -> Outcome<Ending> {
        let loaded = load(&self.robot, None)?;
        if !loaded.robot.is_elastic() {
            let what = "nothing in this robot is elastic";
            let remedy = "add stiffnesses: `ident robot convert FILE` makes an editable copy";
            return Err(Problem::new(what, remedy).in_text(Path::new(&loaded.path)));
        }
        let asked = Asked {
            joints: angles(&self.joints_deg, loaded.robot.dof())?,
            plane: self.plane.axes(),
            step: self.step()?,
        };
        let map = map(&loaded.robot, &asked)?;
        let written = match self.dry_run {
            true => None,
            false => write_as(&results(&loaded), "map.html", &page(&loaded, &map))?.pop(),
        };
        match self.json {
            true => print_result(
                "robot map",
                &[loaded.input()],
                body(&loaded, &map, written.as_deref()),
            )?,
            false => print(&text(&loaded, &map, written.as_deref()))?,
        }
        Ok(Ending::Done)
    }

    fn step(&self) -> Outcome<f64> {
        let good = self.step_mm >= 1.0 && self.step_mm.is_finite();
        let problem = || Problem::new("is no side of a cell", "give 1 mm or more");
        let metres = 1e-3 * self.step_mm;
        good.then_some(metres)
            .ok_or_else(|| problem().in_column("--step-mm"))
    }
}

/// In which plane, how and how much of it.
fn sentence(map: &StiffnessMap) -> String {
    let names = map.asked.plane.map(|k| ["x", "y", "z"][k]).concat();
    let across = (0..3).find(|k| !map.asked.plane.contains(k)).unwrap_or(0);
    let at = 1e3 * map.cells[0].at[across];
    let degrees: Vec<String> = map
        .asked
        .joints
        .iter()
        .map(|q| fixed(q / DEGREE, 1))
        .collect();
    format!(
        "Plane {names} at {} = {} mm, cells of {} mm, tool orientation and arm as at joints {} °: {} places are reached.",
        ["x", "y", "z"][across],
        fixed(at, 0),
        significant(1e3 * map.asked.step, 3),
        degrees.join(", "),
        map.cells.len()
    )
}

fn table(map: &StiffnessMap) -> Table {
    let header = ["", "tool at mm", "least N/µm", "along", "greatest N/µm"];
    let mut table = Table::new("Softest and stiffest place", header).numeric([2, 4]);
    for (name, cell) in ["softest", "stiffest"].into_iter().zip(map.ends()) {
        let list = |v: [f64; 3], decimals| v.map(|x| fixed(x, decimals)).join(", ");
        let stiffness = cell
            .least_greatest
            .map(|k| significant(NEWTON_PER_MICROMETRE * k, 3));
        table.push([
            name.to_string(),
            list(cell.at.map(|x| 1e3 * x), 0),
            stiffness[0].clone(),
            list(cell.softest, 2),
            stiffness[1].clone(),
        ]);
    }
    table
}

fn page(loaded: &Loaded, map: &StiffnessMap) -> Page {
    let robot = &loaded.robot;
    let least = map.chart(
        robot,
        "map-least",
        "Least stiffness at the tool, over all directions of a force",
        |cell| cell.least_greatest[0],
    );
    let greatest = map.chart(
        robot,
        "map-greatest",
        "Greatest stiffness at the tool, over all directions of a force",
        |cell| cell.least_greatest[1],
    );
    Page::new(
        format!("Stiffness of {} over its workspace", robot.name),
        sentence(map),
    )
    .with(Block::text(format!("Source: {}", robot.source)))
    .with(Block::Table(table(map)))
    .with(Block::Chart(least))
    .with(Block::Chart(greatest))
}

fn text(loaded: &Loaded, map: &StiffnessMap, written: Option<&Path>) -> String {
    let text = format!(
        "{}: {}\n\n{}",
        loaded.robot.name,
        sentence(map),
        crate::report::text::table(&table(map))
    );
    written.map_or(text.clone(), |path| {
        text + &format!("written: {}\n", path.display())
    })
}

fn body(loaded: &Loaded, map: &StiffnessMap, written: Option<&Path>) -> Value {
    let cell = |cell: &Cell| {
        json!({
            "at_m": numbers(&cell.at),
            "joints_rad": numbers(&cell.joints),
            "least_N_m": number(cell.least_greatest[0]),
            "greatest_N_m": number(cell.least_greatest[1]),
            "softest_direction": numbers(&cell.softest),
            "along_xyz_N_m": numbers(&cell.along),
        })
    };
    json!({
        "name": loaded.robot.name,
        "step_m": number(map.asked.step),
        "cells": map.cells.iter().map(cell).collect::<Value>(),
        "not_reached": map.blank,
        "report": written.map(|path| path.display().to_string()),
    })
}
