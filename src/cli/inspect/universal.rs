//! The account of a universal file: its hammer test, if it holds one, and every data set in it.

use super::{Account, hammer, title};
use crate::fit::suitability::Doubt;
use crate::fit::suitability::hammer::doubts;
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::measurement::hammer::HammerRecord;
use crate::measurement::hammer_uff::read_hammer;
use crate::measurement::uff::{
    self, Abscissa, Dof, Function, Kind, Quantity, UniversalFile, Values,
};
use crate::report::json;
use serde_json::{Value, json};
use std::path::Path;

/// Functions that are listed one by one.
const LISTED: usize = 30;

/// Reads and tells.
pub fn account(path: &Path) -> Outcome<Account> {
    let file = uff::read(path)?;
    let mut account = match read_hammer(path) {
        Ok(record) if record.given.is_some() => responses(path, &record),
        Ok(_) => hammer::account(path)?,
        Err(problem) => Account {
            lines: title(
                path,
                &format!("universal file, no hammer test ({})", problem.what),
                false,
            ),
            json: json::head(
                "inspect",
                &[(path, &files::sha256(&files::read_bytes(path)?))],
            ),
            odd: Vec::new(),
        },
    };
    account.lines.extend(lines(&file));
    let kind = json!("universal");
    account.json.entry("kind").or_insert(kind);
    let sets: Vec<Value> = file.functions.iter().map(set_json).collect();
    account.json.insert("functions".into(), json!(sets));
    account.json.insert("nodes".into(), json!(file.nodes.len()));
    account
        .json
        .insert("trace_lines".into(), json!(file.traces.len()));
    account.json.insert("skipped".into(), json!(file.skipped));
    Ok(account)
}

/// The frequency responses that a file holds in place of hits.
fn responses(path: &Path, record: &HammerRecord) -> Account {
    let given = record.given.clone().unwrap_or_default();
    let mut json = json::head("inspect", &[(path, &record.sha256)]);
    json.insert("inputs_of_frfs".into(), json!(given.inputs));
    json.insert("responses".into(), json!(record.outputs));
    json.insert("lines".into(), json!(given.frequency_hz.len()));
    json.insert("averages".into(), json!(given.averages));
    let mut lines = title(
        path,
        "frequency responses in a universal file",
        record.synthetic,
    );
    let last = given.frequency_hz.last().copied().unwrap_or(0.0);
    lines.push(format!(
        "forces: {}; responses: {}; {} lines up to {last} Hz",
        given.inputs.join(", "),
        record.outputs.join(", "),
        given.frequency_hz.len()
    ));
    let doubts = doubts(record);
    Account {
        lines,
        json,
        odd: given
            .remarks
            .into_iter()
            .chain(doubts.iter().map(Doubt::sentence))
            .collect(),
    }
}

fn lines(file: &UniversalFile) -> Vec<String> {
    let mut said = Vec::new();
    if let Some(header) = &file.header {
        said.push(format!("written by {}", header.program.trim()));
    }
    said.push(match &file.units {
        Some(units) => format!("units: {}", units.description.trim()),
        None => "units: none stated (data set 164), taken as SI".into(),
    });
    if !file.nodes.is_empty() {
        let (nodes, wires) = (file.nodes.len(), file.traces.len());
        said.push(format!(
            "{nodes} nodes (data sets 15, 2411), {wires} trace lines (82)"
        ));
    }
    said.extend(file.functions.iter().take(LISTED).map(set_line));
    let more = file.functions.len().saturating_sub(LISTED);
    if more > 0 {
        said.push(format!("... and {more} more"));
    }
    let skipped = file.skipped.iter();
    said.extend(
        skipped.map(|(set, n)| format!("data set {set}: {n} skipped, not of this kind of work")),
    );
    said
}

/// `FRF, acceleration 1:+x over force 1:+x: 401 complex values from 0 by 0.125`.
fn set_line(function: &Function) -> String {
    let over = match function.kind {
        Kind::Time => String::new(),
        _ => format!(" over {}", place(&function.reference)),
    };
    let values = match function.values {
        Values::Real(_) => "real",
        Values::Complex(_) => "complex",
    };
    let at = match function.abscissa {
        Abscissa::Even { start, step } => format!("from {start} by {step}"),
        Abscissa::Uneven(_) => "unevenly spaced".into(),
    };
    let (kind, quantity) = (kind(function.kind), quantity(function.quantity()));
    format!(
        "{kind}, {quantity} at {}{over}: {} {values} values {at}",
        place(&function.response),
        function.values.len()
    )
}

fn set_json(function: &Function) -> Value {
    json!({
        "kind": kind(function.kind),
        "quantity": quantity(function.quantity()),
        "response": place(&function.response),
        "reference": place(&function.reference),
        "values": function.values.len(),
        "complex": matches!(function.values, Values::Complex(_)),
        "id": function.id[0].trim(),
    })
}

fn kind(kind: Kind) -> String {
    match kind {
        Kind::Time => "time record".into(),
        Kind::FrequencyResponse => "FRF".into(),
        Kind::Coherence => "coherence".into(),
        Kind::Other(code) => format!("function of type {code}"),
    }
}

fn quantity(quantity: Quantity) -> String {
    match quantity {
        Quantity::Acceleration => "acceleration".into(),
        Quantity::ExcitationForce | Quantity::ReactionForce => "force".into(),
        other => format!("quantity of type {}", other.code()),
    }
}

/// `3:-y`: node and direction.
fn place(dof: &Dof) -> String {
    let axis = ["scalar", "x", "y", "z", "rx", "ry", "rz"];
    let axis = axis.get(dof.direction.unsigned_abs() as usize).copied();
    let sign = match dof.direction {
        0 => "",
        d if d < 0 => "-",
        _ => "+",
    };
    format!("{}:{sign}{}", dof.node, axis.unwrap_or("unknown"))
}
