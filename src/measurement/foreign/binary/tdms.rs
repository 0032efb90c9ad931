//! TDMS of LabVIEW (National Instruments, "TDMS File Format Internal Structure"): one table per group.
//! Channels with `wf_increment` and no channel of time get one.

mod segment;

use super::Sheet;
use super::grid::{Column, sheets};
use crate::ground::problem::Outcome;
use segment::Segments;

/// Properties that name the unit of a channel.
const UNITS: &[&str] = &["unit_string", "NI_UnitDescription", "Unit"];

pub(super) fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(b"TDSm")
}

pub(super) fn read(bytes: &[u8]) -> Outcome<Vec<Sheet>> {
    let mut segments = Segments::new(bytes);
    while segments.advance()? {}
    let channels: Vec<Channel> = segments.objects.into_iter().filter_map(channel).collect();
    let mut groups: Vec<&str> = Vec::new();
    for channel in &channels {
        if !groups.contains(&channel.group.as_str()) {
            groups.push(&channel.group);
        }
    }
    let of = |group: &&str| {
        let own: Vec<&Channel> = channels.iter().filter(|c| c.group == **group).collect();
        sheets(group, columns(&own))
    };
    Ok(groups.iter().flat_map(of).collect())
}

/// A channel with numbers.
struct Channel {
    group: String,
    column: Column,
    /// Start and step of its time, s.
    wave: Option<[f64; 2]>,
}

fn channel(object: segment::Object) -> Option<Channel> {
    let [group, name] = names(&object.path)?;
    let unit = UNITS.iter().filter_map(|key| object.property(key));
    let unit = unit
        .map(segment::Property::text)
        .find(|unit| !unit.is_empty());
    let number = |key: &str| object.property(key).and_then(segment::Property::number);
    let start = number("wf_start_offset").unwrap_or(0.0);
    let wave = number("wf_increment").filter(|step| *step > 0.0);
    let wave = wave.map(|step| [start, step]);
    let title = match unit {
        Some(unit) if !name.contains(['[', '(']) => format!("{name} [{unit}]"),
        _ => name,
    };
    (!object.values.is_empty()).then_some(Channel {
        group,
        column: Column {
            title,
            values: object.values,
        },
        wave,
    })
}

/// The channels of a group, their time first where only their wave form states it.
fn columns(channels: &[&Channel]) -> Vec<Column> {
    let mut all: Vec<Column> = Vec::new();
    let timed = channels.iter().any(|c| is_time(&c.column.title));
    for channel in channels {
        let rows = channel.column.values.len();
        let first = !all.iter().any(|c| c.values.len() == rows);
        if let Some([start, step]) = channel.wave.filter(|_| first && !timed) {
            all.push(Column {
                title: "time_s".into(),
                values: (0..rows).map(|k| start + k as f64 * step).collect(),
            });
        }
        all.push(channel.column.clone());
    }
    all
}

fn is_time(title: &str) -> bool {
    let title = title.to_lowercase();
    ["time", "zeit"].iter().any(|word| title.starts_with(word))
}

/// Group and channel of `/'group'/'channel'`.
fn names(path: &str) -> Option<[String; 2]> {
    let inside = path.strip_prefix("/'")?.strip_suffix('\'')?;
    let (group, channel) = inside.split_once("'/'")?;
    Some([group, channel].map(|name| name.replace("''", "'")))
}
