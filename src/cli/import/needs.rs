//! What a kind needs to know of a raw file: columns and facts, each with the question that asks for it.

use toml::Table;

/// A column that a kind reads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Column {
    /// Any of these stems will do.
    pub stems: &'static [&'static str],
    /// What it becomes where nothing else is said.
    pub name: &'static str,
    /// What it measures.
    pub what: &'static str,
}

/// A fact that is missing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fact {
    /// Its key.
    pub key: &'static str,
    /// What it means, and how it is written.
    pub what: &'static str,
}

const fn column(stems: &'static [&'static str], name: &'static str, what: &'static str) -> Column {
    Column { stems, name, what }
}

const fn fact(key: &'static str, what: &'static str) -> Fact {
    Fact { key, what }
}

const KIND: Fact = fact("kind", "kind of the measurement");
const ROBOT: Fact = fact(
    "robot",
    "built-in robot (kr210, kr300) or robot file beside the measurement",
);
const ANGLES: Fact = fact(
    "joint_angles_deg",
    "angles of the joints, degrees, A1 first, as [0, -90, 90, 0, 0, 0]",
);

/// The columns of a kind by which it is read.
pub fn columns(kind: &str) -> &'static [Column] {
    const LOAD_CYCLE: &[Column] = &[
        column(&["time"], "time_s", "time"),
        column(&["force", "moment"], "force_N", "load"),
        column(&["displacement", "angle"], "displacement_mm", "deflection"),
    ];
    const HAMMER: &[Column] = &[
        column(&["time"], "time_s", "time"),
        column(&["force"], "force_N", "force of the hammer"),
        column(&["ax", "ay", "az"], "ax_m_s2", "acceleration"),
    ];
    const SCREW: &[Column] = &[
        column(&["target"], "target_mm", "commanded position"),
        column(&["actual"], "actual_mm", "measured position"),
    ];
    match kind {
        "load-cycle" => LOAD_CYCLE,
        "hammer" => HAMMER,
        "screw" => SCREW,
        _ => &[],
    }
}

/// The facts that are missing, all at once; `names` are those of the columns.
pub fn missing(facts: &Table, names: &[String]) -> Vec<Fact> {
    let kind = facts.get("kind").and_then(|kind| kind.as_str());
    let needed: Vec<Fact> = match kind {
        None => vec![KIND],
        Some("load-cycle") => load_cycle(facts, names),
        Some("workspace" | "hammer" | "cubes") => vec![ROBOT, ANGLES],
        Some("milling-force") => vec![
            fact("diameter_mm", "diameter of the tool, mm"),
            fact("teeth", "number of teeth"),
            fact("cuts", "list of cuts, as in measurements/README.md"),
        ],
        Some("milled-part") => vec![fact("job", "the job file that milled it, beside this file")],
        Some(_) => Vec::new(),
    };
    let absent = |fact: &Fact| !facts.contains_key(fact.key);
    needed.into_iter().filter(absent).collect()
}

/// Those of a turning joint; a linear spring needs none.
fn load_cycle(facts: &Table, names: &[String]) -> Vec<Fact> {
    let has = |stem: &str| {
        names
            .iter()
            .any(|name| name.split('_').next() == Some(stem))
    };
    let levers = ["load_lever_m", "sensor_lever_m", "sensor2_lever_m"];
    let said = ["joint", "axis"]
        .iter()
        .chain(&levers)
        .any(|key| facts.contains_key(*key));
    if !said && !has("moment") && !has("angle") {
        return Vec::new();
    }
    let mut needed = vec![
        fact("joint", "the joint that was loaded, 1 to 6"),
        fact(
            "axis",
            "rotation (about the axis of the drive) or tilt (across it)",
        ),
    ];
    if has("force") {
        needed.push(fact("load_lever_m", "lever of the force about the axis, m"));
    }
    if has("displacement") {
        needed.push(fact(
            "sensor_lever_m",
            "lever of the displacement sensor about the axis, m",
        ));
    }
    needed
}
