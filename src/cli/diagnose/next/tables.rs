//! The plan in words and tables.

use crate::findings::next_setups::{Chosen, FOOT_LEVER, Plan, Seat, Tells};
use crate::ground::units::DEGREE;
use crate::measurement::workspace_test::DIRECTIONS;
use crate::sheet::number::{engineering, fixed, significant};
use crate::sheet::table::Table;

/// What the plan is worth, in a sentence or two.
pub fn sentence(plan: &Plan, open: usize) -> String {
    if plan.chosen.is_empty() {
        return "No set-up that [rig] of campaign.toml allows would tell anything: widen it."
            .into();
    }
    let gain: f64 = plan.chosen.iter().map(|one| one.gain).sum();
    let origin = match plan.noise.measured {
        true => "the readings' own scatter",
        false => "an assumed scatter",
    };
    let towards = match open {
        0 => "",
        1 => ", the pair that the diagnosis left open first",
        _ => ", the pairs that the diagnosis left open first",
    };
    let count = match plan.chosen.len() {
        1 => "This set-up is".to_string(),
        n => format!("These {n} set-ups are"),
    };
    format!(
        "{count} expected to bring {} nats about the compliances of the robot, chosen out of {}{towards}. \
         Reckoned with {origin} of {} per kN and {} % from set-up to set-up; each gain counts after those before it.",
        significant(gain, 3),
        plan.compared,
        engineering(1e3 * plan.noise.slope, 2, "m"),
        significant(100.0 * plan.noise.repeatability, 2),
    )
}

/// The set-ups, one a line.
pub fn setups(plan: &Plan) -> Table {
    let header = [
        "rank",
        "joint angles in °",
        "load",
        "tool",
        "sensor",
        "gain in nats",
        "mainly tells",
    ];
    let mut table = Table::new("Set-ups to measure next", header).numeric([5]);
    for (i, one) in plan.chosen.iter().enumerate() {
        table.push([
            (i + 1).to_string(),
            angles(one),
            DIRECTIONS[one.setting.direction].to_string(),
            one.setting.reach.word().to_string(),
            seat(one.setting.seat),
            fixed(one.gain, 2),
            told(&one.tells),
        ]);
    }
    table.noted("load: force at the tool, base frame; in brackets the correlation between what the two give way, or the spread, before and after")
}

/// How well every place is known, before and after.
pub fn spreads(plan: &Plan) -> Table {
    let header = ["place", "prior", "now", "with the plan"];
    let title = "Spread of each compliance, of the model's or the neighbouring drive's";
    let mut table = Table::new(title, header).numeric([1, 2, 3]);
    for (i, site) in plan.before.sites.iter().enumerate() {
        let percent = |std: f64| format!("{} %", significant(100.0 * std, 2));
        table.push([
            words(site),
            percent(plan.before.prior[i]),
            percent(plan.before.std(i)),
            percent(plan.after.std(i)),
        ]);
    }
    table.noted("one standard deviation; what the model does not have may be half as soft as the drive before it")
}

fn angles(one: &Chosen) -> String {
    let degrees = one.setting.angles.iter().map(|q| {
        let text = fixed(q / DEGREE, 1);
        text.strip_suffix(".0").map_or(text.clone(), str::to_string)
    });
    degrees.collect::<Vec<_>>().join(", ")
}

/// Where the sensor goes, in words.
pub fn seat(seat: Seat) -> String {
    match seat {
        Seat::Tool => "tool, 3 components".into(),
        Seat::Link(i) => format!("end of link {i}, 3 components"),
        Seat::Foot => format!("foot, 3 rotations over {FOOT_LEVER} m"),
    }
}

fn told(tells: &Tells) -> String {
    match tells {
        Tells::Apart { sites, correlation } => format!(
            "{} from {} ({} → {})",
            words(&sites[1]),
            words(&sites[0]),
            fixed(correlation[0], 2),
            fixed(correlation[1], 2)
        ),
        Tells::Size { site, std } => format!(
            "how soft: {} ({} % → {} %)",
            words(site),
            significant(100.0 * std[0], 2),
            significant(100.0 * std[1], 2)
        ),
    }
}

/// A site as a place in words: `A1 drive`, `foundation about z`, `link 2 about x`.
fn words(site: &str) -> String {
    let Some((place, end)) = site.rsplit_once('-') else {
        return format!("{site} drive");
    };
    match (place, place.strip_prefix("link"), end) {
        (_, _, "tilt") => format!("{place} tilt"),
        ("base", _, axis @ ("x" | "y" | "z")) => format!("foundation about {axis}"),
        ("tool", _, axis @ ("x" | "y" | "z")) => format!("tool about {axis}"),
        ("tool-across", _, axis @ ("x" | "y" | "z")) => format!("tool across its length, {axis}"),
        (_, Some(i), axis @ ("x" | "y" | "z")) => format!("link {i} about {axis}"),
        _ => site.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::words;

    #[test]
    fn places_have_names() {
        let said = [
            "A1",
            "A6-tilt",
            "base-z",
            "link2-x",
            "tool-across-x",
            "spindle-holder",
        ]
        .map(words);
        let wanted = [
            "A1 drive",
            "A6 tilt",
            "foundation about z",
            "link 2 about x",
            "tool across its length, x",
            "spindle-holder",
        ];
        assert_eq!(said, wanted);
    }
}
