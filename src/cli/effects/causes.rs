//! Causes of the whole robot, listed and explained beside the effects of one axis.

use crate::causes::{CAUSES, Cause, Sight};
use serde_json::{Value, json};

fn sight(sight: Sight) -> &'static str {
    match sight {
        Sight::Workspace => "workspace tests",
        Sight::Hammer => "hammer tests",
    }
}

/// Every cause as a row: name, family, where it shows, what it is.
pub fn rows() -> Vec<[String; 4]> {
    let row = |cause: &&dyn Cause| {
        let card = cause.card();
        let shows: Vec<&str> = card.shows.iter().map(|s| sight(s.0)).collect();
        [
            card.name.to_string(),
            cause.card().family.name().to_string(),
            shows.join(", "),
            card.summary.to_string(),
        ]
    };
    CAUSES.iter().map(row).collect()
}

/// The causes of this name: what the workspace test calls so and what the hammer test does.
pub fn all_named(name: &str) -> Vec<&'static dyn Cause> {
    let own = |cause: &&&'static dyn Cause| cause.card().name == name;
    CAUSES.iter().filter(own).copied().collect()
}

/// The card of a cause, as text.
pub fn card(cause: &dyn Cause) -> String {
    let card = cause.card();
    let mut lines = vec![
        format!(
            "{} ({}): {}",
            card.name,
            cause.card().family.name(),
            card.summary
        ),
        format!("equation  {}", card.equation),
        format!("source    {}", card.source),
    ];
    for (kind, how) in card.shows {
        lines.push(format!("in {}: {how}", sight(*kind)));
    }
    lines.push(String::new());
    for amount in card.amounts {
        let (name, unit, meaning) = (amount.name, amount.unit, amount.meaning);
        lines.push(format!("  {name} in {unit}: {meaning}"));
    }
    lines.join("\n") + "\n"
}

/// The card of a cause, as JSON.
pub fn value(cause: &dyn Cause) -> Value {
    let card = cause.card();
    let amount =
        |a: &crate::causes::Amount| json!({"name": a.name, "unit": a.unit, "meaning": a.meaning});
    let shows = card
        .shows
        .iter()
        .map(|(kind, how)| json!({"in": sight(*kind), "as": how}));
    json!({
        "name": card.name,
        "family": cause.card().family.name(),
        "summary": card.summary,
        "equation": card.equation,
        "source": card.source,
        "shows": shows.collect::<Vec<_>>(),
        "parameters": card.amounts.iter().map(amount).collect::<Vec<_>>(),
    })
}
