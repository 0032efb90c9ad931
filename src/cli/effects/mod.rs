//! `ident effects`: the library of effects, and the card of one.

mod causes;
mod kinds;

use super::output::print;
use super::{Ending, Verb, arguments, parsed};
use crate::causes::{CAUSES, Cause};
use crate::effects::{EFFECTS, Effect};
use crate::findings::kinds::{Known, known};
use crate::findings::load_cycle::look_alikes::{Picture, look_alikes, picture};
use crate::fit::solution::unit_of;
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::stats::largest;
use crate::measurement::load_cycle::Port;
use crate::report::{json, svg, text};
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::table::Table;
use clap::{ArgMatches, Args};
use serde_json::{Value, json};
use std::path::PathBuf;

/// The verb.
pub const VERB: Verb = Verb {
    name: "effects",
    about: "List the effects that ident knows, or explain one",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Effect to explain
    name: Option<String>,
    /// Write the figure of how it looks to this file
    #[arg(long, value_name = "SVG", requires = "name")]
    figure: Option<PathBuf>,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    match &arguments.name {
        None => print(&if arguments.json { list_json() } else { list() })?,
        Some(name) => {
            let robot = causes::all_named(name);
            let others = kinds::all_named(name);
            let elsewhere = !robot.is_empty() || !others.is_empty();
            let effect = match crate::effects::named(name) {
                None if elsewhere && arguments.figure.is_none() => None,
                _ => Some(named(name)?),
            };
            if let (Some(path), Some(effect)) = (&arguments.figure, effect) {
                files::replace(path, svg::ink(&chart(effect))?.as_bytes())?;
            }
            print(&match arguments.json {
                true => card_json(effect, &robot, &others),
                false => cards(effect, &robot, &others),
            })?;
        }
    }
    Ok(Ending::Done)
}

fn named(name: &str) -> Outcome<&'static dyn Effect> {
    crate::effects::named(name).ok_or_else(|| {
        let of_axis = EFFECTS.iter().map(|e| e.card().name);
        let of_robot = CAUSES.iter().map(|c| c.card().name);
        let of_kinds = known().into_iter().map(|k| k.name);
        let mut known: Vec<_> = of_axis.chain(of_robot).chain(of_kinds).collect();
        known.sort_unstable();
        known.dedup();
        Problem::new(
            format!("no effect is called `{name}`"),
            format!("choose among: {}", known.join(", ")),
        )
    })
}

fn list() -> String {
    let header = ["effect", "family", "what it is"];
    let mut table = Table::new("Effects in load cycles of one axis", header);
    for effect in EFFECTS {
        table.push([
            effect.card().name,
            effect.card().family.name(),
            effect.card().summary,
        ]);
    }
    let header = ["cause", "family", "shows in", "what it is"];
    let mut robot = Table::new("Causes in tests of the whole robot", header);
    causes::rows().into_iter().for_each(|row| robot.push(row));
    let others = kinds::table().noted("`ident effects NAME` explains one");
    [&table, &robot, &others].map(text::table).join("\n")
}

fn list_json() -> String {
    let mut map = json::head("effects", &[]);
    map.insert(
        "effects".into(),
        Value::Array(EFFECTS.iter().map(|e| value(*e)).collect()),
    );
    let robot = CAUSES.iter().map(|c| causes::value(*c));
    map.insert("causes".into(), Value::Array(robot.collect()));
    map.insert("kinds".into(), json!(known()));
    json::print(map)
}

fn card_json(
    effect: Option<&'static dyn Effect>,
    robot: &[&'static dyn Cause],
    others: &[Known],
) -> String {
    let mut map = json::head("effects", &[]);
    if let Some(effect) = effect {
        map.insert("effect".into(), value(effect));
        let confused: Vec<Value> = look_alikes(effect)
            .iter()
            .map(|l| json!({"effect": l.effect, "left_unexplained": l.left}))
            .collect();
        map.insert("confused_with".into(), Value::Array(confused));
    }
    if !robot.is_empty() {
        let cards = robot.iter().map(|c| causes::value(*c));
        map.insert("causes".into(), Value::Array(cards.collect()));
    }
    if !others.is_empty() {
        map.insert("kinds".into(), json!(others));
    }
    json::print(map)
}

fn value(effect: &dyn Effect) -> Value {
    let card = effect.card();
    let parameters: Vec<Value> = card
        .parameters
        .iter()
        .map(|p| json!({"name": p.name, "unit": unit_of(p.scale, Port::Rotational), "meaning": p.meaning}))
        .collect();
    json!({
        "name": card.name,
        "cause": card.cause,
        "family": effect.card().family.name(),
        "summary": card.summary,
        "equation": card.equation,
        "source": card.source,
        "signature": card.signature,
        "parameters": parameters,
    })
}

/// The card of an effect of one axis, then those of the causes of that name, then those of other kinds of data.
fn cards(
    effect: Option<&'static dyn Effect>,
    robot: &[&'static dyn Cause],
    others: &[Known],
) -> String {
    let axis = effect.map(card).into_iter();
    let robot = robot.iter().map(|c| causes::card(*c));
    let all: Vec<String> = axis
        .chain(robot)
        .chain(others.iter().map(kinds::card))
        .collect();
    all.join("\n")
}

fn card(effect: &'static dyn Effect) -> String {
    let card = effect.card();
    let mut lines = vec![
        format!(
            "{} ({}): {}",
            card.name,
            effect.card().family.name(),
            card.summary
        ),
        format!("equation  {}", card.equation),
        format!("source    {}", card.source),
        format!("shows as  {}", card.signature),
        String::new(),
    ];
    for p in card.parameters {
        lines.push(format!(
            "  {} in {}: {}",
            p.name,
            unit_of(p.scale, Port::Rotational),
            p.meaning
        ));
    }
    lines.push(String::new());
    lines.push(sketch(&picture(effect)));
    let alike = look_alikes(effect);
    lines.push(
        "confused with (share of its variance that the other leaves, constant cycles):".into(),
    );
    for other in alike.iter().take(4) {
        lines.push(format!("  {}: {:.1} %", other.effect, 100.0 * other.left));
    }
    lines.join("\n") + "\n"
}

/// The misfit of a straight line over load, drawn with characters.
fn sketch(picture: &Picture) -> String {
    const WIDTH: usize = 61;
    const HEIGHT: usize = 13;
    let largest = largest(&picture.misfit).max(f64::MIN_POSITIVE);
    let mut rows = vec![vec![' '; WIDTH]; HEIGHT];
    rows[HEIGHT / 2] = vec!['·'; WIDTH];
    for (u, y) in picture.load.iter().zip(&picture.misfit) {
        let column = ((u + 1.0) * 0.5 * (WIDTH - 1) as f64).round() as usize;
        let row = ((1.0 - y / largest) * 0.5 * (HEIGHT - 1) as f64).round() as usize;
        rows[row.min(HEIGHT - 1)][column.min(WIDTH - 1)] = 'o';
    }
    let drawn: Vec<String> = rows
        .into_iter()
        .map(|r| format!("  |{}", r.into_iter().collect::<String>().trim_end()))
        .collect();
    format!(
        "misfit of a straight line over load (synthetic, constant cycles)\n{}",
        drawn.join("\n")
    )
}

fn chart(effect: &'static dyn Effect) -> Chart {
    let p = picture(effect);
    let pairs = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(a, b)| [*a, *b]).collect::<Vec<_>>();
    Chart::new(
        effect.card().name,
        format!("How {} looks", effect.card().name),
        format!(
            "Three cycles of constant amplitude. {}",
            effect.card().equation
        ),
    )
    .synthetic(true)
    .with(
        Panel::new(
            Axis::new("Deflection over its elastic range", ""),
            Axis::new("Load over the largest", ""),
        )
        .with(Series::line(
            "with the effect",
            pairs(&p.deflection, &p.load),
        ))
        .with(Series::dashed("spring alone", pairs(&p.load, &p.load))),
    )
    .with(
        Panel::new(
            Axis::new("Load over the largest", ""),
            Axis::new("Misfit of a straight line", ""),
        )
        .with(Series::line("with the effect", pairs(&p.load, &p.misfit))),
    )
}
